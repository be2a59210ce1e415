// runtime/picture/frame/planes_p.h: the planes of a frame's film, for frame.cpp only.
#pragma once

#include "raytrace/film.h"
#include "runtime/picture/shading/frame/insight.h"
#include "runtime/scene/shaders.h"

namespace kinora {

// The film's planes become those of the scene's outputs.
void prepare_planes(const SceneShaders& scene, raytrace::Film& film);

bool has_plane_of(const SceneShaders& scene, AovSource source);

// The plane of costs, of a film that is done: a camera ray each sample, and what came of it.
void fill_costs(const SceneShaders& scene, const PixelCosts& costs, int samples,
                raytrace::Film& film);

}  // namespace kinora
