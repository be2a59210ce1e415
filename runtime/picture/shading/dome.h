// runtime/picture/shading/dome.h: what lies around the scene: rays that leave it see what the
// environment's light sends (docs/lights.md).
#pragma once

#include "runtime/picture/shading/grid.h"

namespace kinora {

class KernelRunner;
class LightBindings;

class Dome {
  public:
    // Sets ShadingFrame::dome.
    Dome(ShadingFrame& frame, KernelRunner& kernels);

    // Whether rays leave the scene to see it, and the camera's too.
    bool stands() const { return frame_.dome != kNone; }
    bool is_behind_picture() const;
    // Whether points with the tag see it where rays leave the scene.
    bool is_seen(const RayTag& ray) const;
    // Sets Ci along rays that have left the scene. Oi is 1 for those of the camera; others stay
    // open, for nothing is there.
    void show(const raytrace::HitBatch& ends, const RayTag& ray, ThreadMemory& memory,
              raytrace::ShadeResult& result);

  private:
    void show(Grid& lit, raytrace::ShadeResult& result);

    const ShadingFrame& frame_;
    KernelRunner& kernels_;
};

}  // namespace kinora
