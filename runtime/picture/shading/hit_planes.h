// runtime/picture/shading/hit_planes.h: numbers of the camera's hits that no kernel makes.
#pragma once

#include "raytrace/wavefront.h"
#include "runtime/picture/shading/frame/frame.h"

namespace kinora {

// Sets what the frame has of Cryptomatte, if an AOV is to have it.
void hash_names(const Scene& scene, ShadingFrame& frame);

// Fills the planes of the scene's outputs whose AovSource is of hits. Numbers of surfaces, objects
// and materials count from 1.
void fill_hit_planes(const ShadingFrame& frame, const raytrace::HitBatch& hits,
                     const raytrace::ShadeResult& result);

}  // namespace kinora
