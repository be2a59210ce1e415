// runtime/picture/frame/planes_p.h: the planes of a frame's film, for frame.cpp only.
#pragma once

#include "raytrace/film.h"
#include "runtime/picture/shading/frame/insight.h"
#include "runtime/scene/shaders.h"

namespace kinora {

// Gives the film a plane for each output of the scene.
void prepare_planes(const SceneShaders& scene, raytrace::Film& film);

bool has_plane_of(const SceneShaders& scene, AovSource source);

// The plane of costs, of a film that is done: a camera ray each sample, and what came of it.
void fill_costs(const SceneShaders& scene, const PixelCosts& costs, int samples,
                raytrace::Film& film);

}  // namespace kinora
