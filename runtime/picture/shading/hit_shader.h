// runtime/picture/shading/hit_shader.h: hits grouped by look, shaded in dense grids
// (docs/decisions.md#lanes-and-wavefronts).
#pragma once

#include <span>

#include "runtime/picture/shading/lighting/lamp_rays.h"
#include "runtime/picture/shading/volumes.h"

namespace kinora {

// What gather wants of each hit: columns of all components, in the order of the results.
struct HitOutputs {
    std::span<const rsl::LoweredShader::GatherResult> wanted;
    std::span<float* const> columns;  // by hit
};

class Dome;
class Lamps;

class HitShader {
  public:
    HitShader(const ShadingFrame& frame, KernelRunner& kernels, LightRecords& lights,
              Transmission& transmission, Volumes& volumes, Lamps& lamps, Dome& dome)
        : frame_(frame),
          kernels_(kernels),
          lights_(lights),
          queue_(frame, *this, transmission),
          shadows_(frame, queue_),
          volumes_(volumes),
          lamps_(lamps),
          dome_(dome) {}

    // The colours of hits of rays with that tag, with what volumes before them add. `outputs`:
    // wanted beside Ci and Oi.
    void shade(const raytrace::HitBatch& hits, const RayTag& ray, ThreadMemory& memory,
               raytrace::ShadeResult& result, const HitOutputs* outputs = nullptr);
    // Of the ends of rays that met nothing: what surrounds the scene, and the volumes they run
    // through.
    void shade_misses(const raytrace::HitBatch& ends, const RayTag& ray, ThreadMemory& memory,
                      raytrace::ShadeResult& result);

    // What surrounds the scene.
    const Dome& dome() const { return dome_; }

    // The queue of the rays that kernels and lights send.
    RayQueue& queue() { return queue_; }

  private:
    // One call of shade().
    struct Call;
    Grid& make_grid(const Call& call, const LookRun& run, std::span<const uint32_t> points);
    void light_grids(std::span<Grid* const> grids, LampRays& shadows, RayNotes& notes);
    void note_rays(std::span<Grid* const> grids, LampRays& shadows, RayNotes& notes);
    void shade_grid(const Call& call, Grid& grid);
    void count_dark(const Grid& grid, const raytrace::ShadeResult& result) const;

    const ShadingFrame& frame_;
    KernelRunner& kernels_;
    LightRecords& lights_;
    RayQueue queue_;
    LampRaysAtOnce shadows_;
    Volumes& volumes_;
    Lamps& lamps_;
    Dome& dome_;
};

}  // namespace kinora
