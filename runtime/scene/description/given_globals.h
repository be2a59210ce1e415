// runtime/scene/description/given_globals.h: globals that come like parameters.
#pragma once

#include <string_view>

namespace kinora {

// Cs or Os, which a mesh or a material may give like a parameter; else they are 1. They stay when
// the material gets another shader.
inline bool is_given_global(std::string_view name) {
    return name == "Cs" || name == "Os";
}

}  // namespace kinora
