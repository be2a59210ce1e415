// runtime/scene/ri/meshes/merge_meshes.h: fewer and larger meshes for what files say primitive by
// primitive.
#pragma once

#include "runtime/scene/description/scene_description.h"

namespace kinora {

// Materials that differ by Cs alone become one, and their meshes have the colour as an attribute.
// Meshes of one node that then have the same material, lights and attributes become one. Those that
// are drawn several times, shine or enclose volumes stay. Pictures stay the same.
void merge_meshes(SceneDescription& description);

}  // namespace kinora
