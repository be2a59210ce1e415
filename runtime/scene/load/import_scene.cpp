// runtime/scene/load/import_scene.cpp: chooses the reader of a scene file.
#include "runtime/scene/load/import_scene.h"

#include <cstdio>
#include <cstring>

#include "runtime/base/file_extension.h"
#include "runtime/base/regular_file.h"
#include "runtime/scene/dae/import.h"
#include "runtime/scene/description/shader_library.h"
#include "runtime/scene/gltf/import/import.h"
#include "runtime/scene/load/face_normals.h"
#include "runtime/scene/load/smooth_normals.h"
#include "runtime/scene/load/target_normals.h"
#include "runtime/scene/load/twin_faces.h"
#include "runtime/scene/ri/import/import.h"

namespace kinora {

namespace {

// Shaders of ours stand for the materials that are no RSL of the file.
void leave_out_tints(SceneDescription& description) {
    description.tints = false;
    for_each_shader_use(description, [](ShaderUse& use) {
        use.untinted = use.shader == library_shader(use.shader->name);
    });
}

bool has_gltf_name(const std::string& path) {
    return has_extension(path, {".gltf", ".glb"});
}

}  // namespace

bool is_gltf(const std::string& path) {
    if (has_gltf_name(path)) return true;
    OpenFile file = open_regular_file(path);
    char magic[4] = {};
    return file && std::fread(magic, 1, 4, file.get()) == 4 && std::memcmp(magic, "glTF", 4) == 0;
}

std::optional<SceneDescription> import_scene(const SceneSource& source,
                                             const ImportOptions& options,
                                             Diagnostics& diagnostics) {
    if (is_rib(source)) return import_rib(source, options, diagnostics);
    bool gltf = source.bytes ? has_gltf_name(source.path) || source.bytes->starts_with("glTF")
                             : is_gltf(source.path);
    std::optional<SceneDescription> description =
        gltf ? import_gltf(source, options, diagnostics)
             : import_collada(source, options, diagnostics);
    if (!description) return std::nullopt;
    give_faces_their_normals(*description);
    if (!options.vertex_colors) leave_out_tints(*description);
    // Without normals a group is flat: nothing is to be made for 0 degrees.
    double degrees = options.smooth.value_or(gltf ? 0 : kCreaseDegrees);
    if (degrees > 0) smooth_normals(*description, degrees);
    part_normals_by_targets(*description);
    if (!gltf) part_twin_faces(*description);  // glTF's materials say which sides are seen
    return description;
}

}  // namespace kinora
