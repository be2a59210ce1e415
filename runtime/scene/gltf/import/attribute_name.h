// runtime/scene/gltf/import/attribute_name.h: names of vertex attributes as semantics and sets.
#pragma once

#include <string>

#include "runtime/scene/description/scene_description.h"

namespace kinora {

struct AttributeName {
    std::string name;
    uint32_t set = kNone;
};

// "TEXCOORD_2" as name and set; nothing for other names.
AttributeName numbered_attribute(const std::string& semantic);

// The application's own, "_HEAT": colours and coordinates that glTF's own would give a meaning
// have sets, "_COLOR_0"; all else is a name.
AttributeName own_attribute(const std::string& name);

}  // namespace kinora
