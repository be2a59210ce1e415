// runtime/scene/kernels/light_categories.h: which lights a category of illuminance() means.
#pragma once

#include <string_view>

namespace kinora {

// Whether a light whose __category is `own`, a list with commas, is among the wanted: "a", "a,b"
// (any of them), "a|b", "a&-b"; & binds closer than |, and - stands before a name.
bool has_category(std::string_view own, std::string_view wanted);

}  // namespace kinora
