// runtime/programs/shade/points_kernel.h: shaders compiled and run over the points of --points, and
// what answers them there.
#pragma once

#include "runtime/base/arena.h"
#include "runtime/programs/shade/point_set.h"
#include "runtime/scene/images/texture_store.h"
#include "runtime/scene/kernels/bound_kernel.h"
#include "runtime/scene/shaders/printed_lines.h"

namespace kinora {

class PointsLights;

// A stack of layers, or a light.
struct PointsStack {
    std::vector<rsl::Layer> layers;
    PointsNumbers numbers;
    rsl::LowerOptions lower;
    dmat4 current_from_shader{1.0};
};

class PointsKernel {
  public:
    // False where the shaders cannot be lowered: findings say why.
    bool compile(const PointsStack& stack, const jit::Target* target, Diagnostics& diagnostics);
    // Runs at all points. `lights` may be null.
    void run(const PointSet& points, const PointsStack& stack, TextureStore& textures,
             PointsLights* lights);
    // Runs with rows of the caller's: rows(key, row) fills the input's row of padded(count).
    using FillRow = std::function<void(const rsl::KernelKey& key, std::span<float> row)>;
    std::span<float* const> run(size_t count, const FillRow& fill, KernelHost& host,
                                std::span<const jit::RecordSet> record_sets, Arena& arena);

    // A component of the last run over the points; empty: there is none. Ints bit for bit.
    std::span<const float> output(const rsl::KernelKey& key) const;
    int find_output(const rsl::KernelKey& key) const;  // -1: none
    const rsl::LoweredShader& lowered() const { return lowered_; }
    const BoundKernel& bound() const { return bound_; }
    FrameBlock& frame() { return frame_; }
    // Of the last run over the points: faults, and what was printed beyond the limit.
    void report(Diagnostics& diagnostics) const;

  private:
    rsl::LoweredShader lowered_;
    BoundKernel bound_;
    FrameBlock frame_;
    Arena arena_;
    std::span<float* const> out_;
    size_t count_ = 0;
    std::vector<uint8_t> faults_;
    std::string shader_;  // the last of the stack
    PrintedLines printed_;
};

// The frame-rate inputs of a kernel.
class PointsFrameNumbers : public FrameNumbers {
  public:
    PointsFrameNumbers(const PointSet& points, const PointsStack& stack,
                       const jit::KernelPair& pair)
        : points_(points), stack_(stack), pair_(pair) {}
    float number(size_t index) const override {
        return points_.frame_number(rsl::key_of(pair_.frame->inputs[index]), stack_.numbers,
                                    stack_.current_from_shader);
    }

  private:
    const PointSet& points_;
    const PointsStack& stack_;
    const jit::KernelPair& pair_;
};

}  // namespace kinora
