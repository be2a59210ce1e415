// runtime/picture/shading/frame/insight.h: what a frame may be asked to show of its own making.
// Measured by HitShader.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/picture/shading/first_hits/first_hits.h"
#include "runtime/scene/description/scene_description.h"

namespace kinora {

struct ThreadMemory;

// What shading each pixel of a picture took, summed over its samples; rows from the top. Points of
// one look in a block of pixels are shaded together and share what they cost equally.
struct PixelCosts {
    int width = 0, height = 0;
    std::vector<float> ns;      // with all that its points shot
    std::vector<float> rays;    // shot by its points, those of reflected points included
    std::vector<float> points;  // shaded: of the camera's own rays
    // Of the lanes of kernels that ran for its points, those that held a point and those there
    // were.
    std::vector<float> filled, lanes;

    bool empty() const { return ns.empty(); }
    void start(int picture_width, int picture_height);  // all 0
};

struct ShadingInsight {
    uint32_t only_light = kNone;  // of Scene::lights: the others send nothing
    PixelCosts* costs = nullptr;  // started for the picture; null: nobody asks
    FirstHits* first = nullptr;   // likewise
};

// Measures a part of the work of one thread, for its scope, and shares it out to the pixels of
// these hits. Without `costs` it does nothing.
class CostScope {
  public:
    CostScope(PixelCosts* costs, const ThreadMemory& memory, const raytrace::HitBatch& hits,
              std::span<const uint32_t> which);
    ~CostScope();
    CostScope(const CostScope&) = delete;

  private:
    struct Reading {
        int64_t ns = 0;
        uint64_t rays = 0, filled = 0, lanes = 0;
    };
    Reading read() const;

    PixelCosts* costs_;
    const ThreadMemory& memory_;
    const raytrace::HitBatch& hits_;
    std::span<const uint32_t> which_;
    Reading begin_;
};

}  // namespace kinora
