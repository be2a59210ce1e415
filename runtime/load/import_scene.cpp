// runtime/load/import_scene.cpp: chooses the reader of a scene file.
#include "runtime/load/import_scene.h"

#include <cstdio>
#include <cstring>

#include "runtime/base/file_extension.h"
#include "runtime/base/regular_file.h"
#include "runtime/dae/import.h"
#include "runtime/gltf/import/import.h"
#include "runtime/load/face_normals.h"

namespace kinora {

bool is_gltf(const std::string& path) {
    if (has_extension(path, {".gltf", ".glb"})) return true;
    OpenFile file = open_regular_file(path);
    char magic[4] = {};
    return file && std::fread(magic, 1, 4, file.get()) == 4 && std::memcmp(magic, "glTF", 4) == 0;
}

std::optional<SceneDescription> import_scene(const std::string& path, const ImportOptions& options,
                                             Diagnostics& diagnostics) {
    std::optional<SceneDescription> scene = is_gltf(path)
                                                ? import_gltf(path, options, diagnostics)
                                                : import_collada(path, options, diagnostics);
    if (scene) give_faces_their_normals(*scene);
    return scene;
}

}  // namespace kinora
