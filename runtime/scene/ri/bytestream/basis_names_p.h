// runtime/scene/ri/bytestream/basis_names_p.h: what RIB calls the bases of ri.h.
#pragma once

#include <span>
#include <string_view>

namespace kinora::ri {

// 16 numbers; null: no basis has that name.
const float* basis_named(std::string_view name);
// "": they are of no basis that has a name.
std::string_view basis_name(std::span<const float> numbers);

}  // namespace kinora::ri
