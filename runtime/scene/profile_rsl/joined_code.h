// runtime/scene/profile_rsl/joined_code.h: the code of a profile_RSL technique as one translation
// unit.
#pragma once

#include <string>

#include "collada/scene/scene.h"

namespace kinora {

// The texts in order, with the map from their offsets to locations in the file. A code that comes
// from another file than the first enters by #include, so that each keeps its own locations.
std::string joined_code(const collada::RslShading& shading, SourceMap& map);

}  // namespace kinora
