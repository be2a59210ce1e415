// runtime/scene/description/displacements.h: which shaders displace what a material is on.
#pragma once

#include <vector>

#include "runtime/scene/description/scene_description.h"

namespace kinora {

// Whether a surface of the material is of a class that has displacement() too.
bool surface_displaces(const MaterialDefinition& material);

// Bottom first: that displacement() in place of all others, or the material's displacements.
std::vector<ShaderUse> displacements_of(const MaterialDefinition& material);

bool displaces(const MaterialDefinition& material);

}  // namespace kinora
