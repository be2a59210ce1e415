// rsl/objects/paths.h: names of members, as "a->b->c".
#pragma once

#include <string_view>

namespace kinora::rsl {

constexpr std::string_view kArrow = "->";

inline bool is_member(std::string_view path) {
    return path.find(kArrow) != std::string_view::npos;
}
inline std::string_view first_name(std::string_view path) {
    return path.substr(0, path.find(kArrow));
}
// What stands behind the last arrow, and what before it.
inline std::string_view last_name(std::string_view path) {
    return is_member(path) ? path.substr(path.rfind(kArrow) + kArrow.size()) : path;
}
inline std::string_view last_path(std::string_view path) {
    return path.substr(0, path.rfind(kArrow));
}

}  // namespace kinora::rsl
