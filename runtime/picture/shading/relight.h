// runtime/picture/shading/relight.h: AOVs of shaders that run once more under one white light.
#pragma once

#include "raytrace/wavefront.h"
#include "runtime/picture/shading/kernel_runner.h"

namespace kinora {

struct Grid;

// Whether a plane is of albedo.
bool wants_relight(const SceneShaders& shaders);

// Fills those planes at the grid's points, whose kernel has run: what one white light along N adds
// to its Ci without lights and rays, as seen by the eye.
void relight(Grid& grid, const KernelRunner& kernels, const raytrace::ShadeResult& result);

}  // namespace kinora
