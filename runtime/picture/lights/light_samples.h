// runtime/picture/lights/light_samples.h: lights with sample methods: what their kernels are
// asked, and the samples that they answer with.
#pragma once

#include <cstdint>
#include <span>

#include "jit/ir/kernel_call.h"
#include "rsl/model/renderer_services.h"
#include "runtime/base/arena.h"

namespace kinora {

// What is asked of a light at its lit points.
struct LightQuestion {
    rsl::SampleWish wish = rsl::SampleWish::Generate;
    const float* along[3] = {};  // of Evaluate: a direction in current space, by point
    int32_t domain = 0;          // interned
};

// One sample of a light at each of its lit points, in current space. Where a point has no such
// sample, all is 0.
struct LightSampleRows {
    float* D[3];      // of length 1, to the light
    float* distance;  // 1e30: endless
    float* Cl[3];     // radiance, before shadows
    float* pdf;       // by solid angle
    LightSampleRows* next = nullptr;
};

// A run of a light's kernel.
class LightAnswer {
  public:
    // For `points` lit points; rows have `padded` of them.
    LightAnswer(const LightQuestion& question, size_t points, Arena& arena);

    // The services samplewish and lightsample.
    void tell(const jit::ServiceCall& call) const;
    void take(const jit::ServiceCall& call);

    // Samples in the order that the light sent them; null: none.
    const LightSampleRows* first() const { return first_; }
    // How many the light says there are, by point.
    const float* counts() const { return counts_.data(); }

  private:
    LightSampleRows* add_rows();

    LightQuestion question_;
    Arena& arena_;
    std::span<float> counts_;
    LightSampleRows* first_ = nullptr;
    LightSampleRows** next_ = &first_;  // of the lane group that is answering
    int32_t group_ = -1;                // its first lane
};

// The share that a sample of one kind has beside those of another (E. Veach and L. Guibas 1995), of
// the densities of both; 1 for a power of 0.
float sample_weight(float own, float other, float power);

}  // namespace kinora
