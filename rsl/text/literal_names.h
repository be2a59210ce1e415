// rsl/text/literal_names.h: names that stand in string literals and are known without a scene.
#pragma once

#include <string_view>
#include <vector>

namespace kinora::rsl {

// Color spaces, in any letter case.
bool is_color_space(std::string_view name);
std::vector<std::string_view> color_space_names();

// Bases of splines, with "solve" before them or not, and their other spellings.
bool is_spline_basis(std::string_view name);
std::vector<std::string_view> spline_basis_names();

}  // namespace kinora::rsl
