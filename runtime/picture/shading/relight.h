// runtime/picture/shading/relight.h: AOVs of shaders that run once more in other light.
#pragma once

#include "raytrace/wavefront.h"
#include "runtime/picture/shading/kernel_runner.h"

namespace kinora {

struct Grid;

// Whether a plane is of albedo or emission.
bool wants_relight(const SceneShaders& shaders);

// Fills those planes at the grid's points, whose kernel has run: emission is its Ci without lights
// and rays, albedo what one white light along N adds to that, as seen by the eye.
void relight(Grid& grid, const KernelRunner& kernels, const raytrace::ShadeResult& result);

}  // namespace kinora
