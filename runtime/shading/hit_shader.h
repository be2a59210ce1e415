// runtime/shading/hit_shader.h: hits grouped by look, shaded in dense grids
// (docs/decisions.md#lanes-and-wavefronts).
#pragma once

#include <span>

#include "runtime/shading/light_records.h"
#include "runtime/shading/volumes.h"

namespace kinora {

// What gather wants of each hit: columns of all components, in the order of the results.
struct HitOutputs {
    std::span<const rsl::LoweredShader::GatherResult> wanted;
    std::span<float* const> columns;  // by hit
};

class HitShader {
  public:
    HitShader(const ShadingFrame& frame, KernelRunner& kernels, LightRecords& lights,
              const LightShadows& shadows, Volumes& volumes)
        : frame_(frame), kernels_(kernels), lights_(lights), shadows_(shadows), volumes_(volumes) {}

    // The colours of hits of rays with that tag, with what volumes before them add. `outputs`:
    // wanted beside Ci and Oi.
    void shade(const raytrace::HitBatch& hits, const RayTag& ray, ThreadMemory& memory,
               raytrace::ShadeResult& result, const HitOutputs* outputs = nullptr);
    // Of the ends of rays that met nothing: the volumes they run through.
    void shade_misses(const raytrace::HitBatch& ends, const RayTag& ray, ThreadMemory& memory,
                      raytrace::ShadeResult& result);

  private:
    void shade_look(const raytrace::HitBatch& hits, std::span<const uint32_t> points,
                    const ShaderInstance& look, const RayTag& ray, ThreadMemory& memory,
                    raytrace::ShadeResult& result, const HitOutputs* outputs);
    void count_dark(const Grid& grid, const raytrace::ShadeResult& result) const;

    const ShadingFrame& frame_;
    KernelRunner& kernels_;
    LightRecords& lights_;
    const LightShadows& shadows_;
    Volumes& volumes_;
};

}  // namespace kinora
