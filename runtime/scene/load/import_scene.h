// runtime/scene/load/import_scene.h: a scene file of any format to a SceneDescription.
#pragma once

#include <optional>
#include <string>

#include "runtime/base/diagnostic.h"
#include "runtime/scene/description/import_options.h"
#include "runtime/scene/description/scene_source.h"

namespace kinora {

// By the first bytes ("glTF": a .glb), else the name (.gltf, .glb), else COLLADA. As
// import_collada and import_gltf say; then meshes without normals get those of ImportOptions.
std::optional<SceneDescription> import_scene(const SceneSource& source,
                                             const ImportOptions& options,
                                             Diagnostics& diagnostics);

// Whether import_scene takes the file for glTF.
bool is_gltf(const std::string& path);

}  // namespace kinora
