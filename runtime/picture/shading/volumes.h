// runtime/picture/shading/volumes.h: volume shaders, run on the way of each ray between two
// surfaces.
#pragma once

#include <span>

#include "runtime/picture/shading/lighting/light_records.h"

namespace kinora {

// RayBatch::medium of a ray that goes on behind hit k.
uint32_t medium_behind(const ShadingFrame& frame, const raytrace::HitBatch& hits, size_t k);
// Of a ray that a shader sends from hit k: through the surface, or back into where it came from.
uint32_t nested_medium(const ShadingFrame& frame, const raytrace::HitBatch& hits, size_t k,
                       vec3 dir);

class Volumes {
  public:
    Volumes(const ShadingFrame& frame, KernelRunner& kernels, LightRecords& lights)
        : frame_(frame), kernels_(kernels), lights_(lights) {}

    // What the volume before each hit makes of the hit's Ci and Oi. `ray`: of the hits.
    void apply(const raytrace::HitBatch& hits, const RayTag& ray, LightShadows& shadows,
               ThreadMemory& memory, raytrace::ShadeResult& result);
    // What the insides of objects take from shadow rays on the way to each hit; the atmosphere and
    // exteriors take nothing, for a sun would never reach the ground through an endless fog.
    void pass(const raytrace::HitBatch& hits, const RayTag& ray, ThreadMemory& memory, vec3* Oi);

  private:
    struct Order;
    Order sort(const raytrace::HitBatch& hits, const RayTag& ray, Arena& arena,
               bool fills_only) const;
    template <class F>
    void for_each_grid(const Order& order, F&& f) const;
    void shade(Grid& grid, const BoundKernel& bound, const RayTag& ray, LightShadows* shadows,
               raytrace::ShadeResult& result);

    const ShadingFrame& frame_;
    KernelRunner& kernels_;
    LightRecords& lights_;
};

}  // namespace kinora
