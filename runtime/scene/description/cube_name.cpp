// runtime/scene/description/cube_name.cpp: "cube\x1efov\x1epath\x1epath...": a byte that no path
// has lies between.
#include "runtime/scene/description/cube_name.h"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/base/numbers.h"

namespace kinora {
namespace {

constexpr char kBetween = '\x1e';
constexpr std::string_view kCube = "cube\x1e";

std::string_view take_part(std::string_view& rest) {
    std::string_view part = rest.substr(0, rest.find(kBetween));
    rest.remove_prefix(std::min(rest.size(), part.size() + 1));
    return part;
}

}  // namespace

std::string cube_name_string(const CubeName& name) {
    std::string text = fmt::format("{}{}", kCube, name.fov);
    for (const std::string& face : name.faces) text += kBetween + face;
    return text;
}

std::optional<CubeName> parse_cube_name(std::string_view path) {
    if (!path.starts_with(kCube)) return std::nullopt;
    path.remove_prefix(kCube.size());
    CubeName name;
    name.fov = number_of<double>(take_part(path)).value_or(90);
    for (std::string& face : name.faces) face = take_part(path);
    return name;
}

}  // namespace kinora
