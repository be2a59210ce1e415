// runtime/scene/load/face_normals.h: what stands for normals that are no directions.
#pragma once

#include "runtime/scene/description/scene_description.h"

namespace kinora {

// A corner whose normal is zero or not finite has the normal of its face: the picture and every
// writer see the same one. Morph targets stay; those that are relative may well be zero.
void give_faces_their_normals(SceneDescription& description);

}  // namespace kinora
