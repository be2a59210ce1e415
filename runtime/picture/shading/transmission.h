// runtime/picture/shading/transmission.h: what light is left behind transparent surfaces and
// objects.
#pragma once

#include <span>

#include "runtime/picture/shading/lighting/light_records.h"
#include "runtime/picture/shading/volumes.h"

namespace kinora {

// Each wavefront runs on the calling thread; no task is started.
class Transmission {
  public:
    Transmission(const ShadingFrame& frame, KernelRunner& kernels, LightRecords& lights,
                 Volumes& volumes)
        : frame_(frame), kernels_(kernels), lights_(lights), volumes_(volumes) {}

    // What passes of each ray; consumes the rays. Their slots are 0, 1, 2, ... `tag`: theirs.
    void pass(raytrace::RayBatch& rays, const RayTag& tag, ThreadMemory& memory,
              std::span<vec3> through);

  private:
    // The same of the rays of these numbers, which ascend; the others pass.
    void pass_blocked(raytrace::RayBatch& rays, std::span<const uint32_t> which, const RayTag& tag,
                      ThreadMemory& memory, std::span<vec3> through);
    // The same of rays that meet nothing opaque; `through` is 1 before.
    void pass_transparent(raytrace::RayBatch& rays, const RayTag& tag, ThreadMemory& memory,
                          vec3* through);
    void pass_ends(const raytrace::RayBatch& rays, const raytrace::HitBatch& hits,
                   const RayTag& ray, ThreadMemory& memory, vec3* through);
    void opacity(const raytrace::HitBatch& hits, const RayTag& ray, ThreadMemory& memory, vec3* Oi);
    void run_opacity(const raytrace::HitBatch& hits, std::span<const uint32_t> points,
                     const ShaderInstance& look, const RayTag& ray, ThreadMemory& memory, vec3* Oi);

    const ShadingFrame& frame_;
    KernelRunner& kernels_;
    LightRecords& lights_;
    Volumes& volumes_;
};

}  // namespace kinora
