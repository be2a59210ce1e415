// runtime/scene/description/cube_name.h: an environment of six pictures as one path of a texture
// name (texture_name.h).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace kinora {

// Of MakeCubeFaceEnvironment: what cameras of the RenderMan Interface see along +x -x +y -y +z -z.
// Up is y, but -z along +y and z along -y.
struct CubeName {
    std::array<std::string, 6> faces;  // paths
    double fov = 90;                   // degrees, of each picture
};

std::string cube_name_string(const CubeName& name);
// Nothing: the path is that of one file.
std::optional<CubeName> parse_cube_name(std::string_view path);

}  // namespace kinora
