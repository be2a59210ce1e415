// runtime/shading/transmission.h: what light is left behind transparent surfaces and objects.
#pragma once

#include <span>

#include "runtime/shading/light_records.h"
#include "runtime/shading/volumes.h"

namespace kinora {

// Each wavefront runs on the calling thread; no task is started.
class Transmission {
  public:
    Transmission(const ShadingFrame& frame, KernelRunner& kernels, LightRecords& lights,
                 Volumes& volumes)
        : frame_(frame), kernels_(kernels), lights_(lights), volumes_(volumes) {}

    // What passes of each ray; consumes the rays. Their slots are 0, 1, 2, ... `from`: the tag of
    // the grid that sends them.
    void pass(raytrace::RayBatch& rays, const RayTag& from, ThreadMemory& memory,
              std::span<vec3> through);
    // The same of rays that meet nothing opaque.
    void pass_transparent(raytrace::RayBatch& rays, const RayTag& from, ThreadMemory& memory,
                          vec3* through);

  private:
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

// Rays from lit points to their light.
class ShadowRays final : public LightShadows {
  public:
    ShadowRays(const ShadingFrame& frame, Transmission& transmission)
        : frame_(frame), transmission_(transmission) {}
    // What is opaque takes all of Cl; the rays it lets by go on through what is transparent.
    void cast(const Grid& grid, const LightPoints& at, const SentLight& light) const override;

  private:
    const ShadingFrame& frame_;
    Transmission& transmission_;
};

// A nested ray without footprint of its own.
void set_nested_ray(raytrace::RayBatch& rays, size_t i, vec3 org, vec3 dir, float tfar,
                    const raytrace::HitBatch& from, uint32_t hit);

}  // namespace kinora
