// runtime/scene/description/scene_source.h: where a scene is read from.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace kinora {

// A file, or the bytes of one. `path` names it in findings, and its folder is where relative
// references begin. With bytes there need be no such file.
struct SceneSource {
    SceneSource(std::string file) : path(std::move(file)) {}  // NOLINT: a path is a source
    SceneSource(const char* file) : path(file) {}             // NOLINT
    SceneSource(std::string name, std::string_view content)
        : path(std::move(name)), bytes(content) {}

    std::string path;
    std::optional<std::string_view> bytes;  // nothing: the file's; they outlive the import
};

}  // namespace kinora
