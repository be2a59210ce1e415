// runtime/scene/gltf/import/values.h: numbers added to a description's values, alone or as a
// parameter.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "runtime/scene/description/scene_description.h"

namespace kinora {

// Returns their offset. Zeros pad them to `room`, so that one owner's channels touch no other's.
uint32_t append_values(std::vector<double>& values, std::span<const double> numbers, size_t room);

// Gives a parameter of a shader numbers, whose slot it returns, or a string.
ValueSlot set_number(ShaderUse& use, const std::string& name, std::span<const double> numbers,
                     std::vector<double>& values);
void set_string(ShaderUse& use, const std::string& name, std::string text);

}  // namespace kinora
