// runtime/scene/gltf/import/import.cpp: a glTF scene as a SceneDescription, part by part.
#include "runtime/scene/gltf/import/import.h"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/gltf/import/animations.h"
#include "runtime/scene/gltf/import/cameras.h"
#include "runtime/scene/gltf/import/extras.h"
#include "runtime/scene/gltf/import/lights.h"
#include "runtime/scene/gltf/import/nodes.h"

namespace kinora {

namespace {

// Per mesh: a node of the scene has it.
std::vector<bool> used_meshes(const tinygltf::Model& model, const GltfNodeTree& tree) {
    std::vector<bool> used(model.meshes.size(), false);
    for (size_t n = 0; n < model.nodes.size(); ++n) {
        int mesh = model.nodes[n].mesh;
        if (tree.shown[n] && mesh >= 0 && size_t(mesh) < used.size()) used[size_t(mesh)] = true;
    }
    return used;
}

// Whether the scene has a node, unless it has none by intention.
bool has_its_nodes(const GltfNodeTree& tree) {
    return tree.roots.empty() || std::ranges::any_of(tree.roots, [](int r) { return r >= 0; });
}

// False where there is nothing of the scene; a finding says why.
bool import_model(GltfFile& file, const ImportOptions& options, Diagnostics& diagnostics,
                  SceneDescription& out) {
    const tinygltf::Model& model = file.model;
    GltfReport report(file, diagnostics);
    ByteBudget budget(file, report);
    UniqueIds ids;
    GltfNodeTree tree = read_node_tree(model, report);
    if (!has_its_nodes(tree)) {
        report.add(Code::GLTF_INVALID, fmt::format("/scenes/{}/nodes", shown_scene(model)),
                   "none of the nodes that its scene names is there");
        return false;
    }
    KinoraAxes axes = find_axes(model, tree.roots).value_or(KinoraAxes());
    out.meter = options.meter.value_or(axes.meter);
    out.up_axis = options.up_axis.value_or(axes.up);

    PointerSlots pointers(model);
    TextureImporter textures(file, pointers, report, budget, out);
    RslExtras rsl(file, options, textures, pointers, report, diagnostics, out);
    MaterialImporter materials(model, textures, rsl, pointers, report, diagnostics, out);
    materials.import_materials(ids);
    import_lights(model, axes.meter, rsl, ids, pointers, report, out);
    import_cameras(model, axes.meter, rsl, ids, pointers, report, out);
    import_scene_shaders(model, rsl, out);

    AccessorReader accessors(model, report, budget);
    MeshImporter meshes(model, accessors, report, budget, out.meshes);
    MorphImporter morphs(model, meshes, accessors, report, budget, out);
    SkinImporter skins(model, meshes, accessors, report, out);
    std::vector<bool> used = used_meshes(model, tree);
    meshes.import_meshes(used, ids);
    for (uint32_t m = 0; m < used.size(); ++m)
        if (used[m]) morphs.import_targets(m);

    std::vector<uint8_t> moving = moving_properties(model);
    NodeImporter nodes(model, tree, moving, axes.node, materials, morphs, skins, report, out);
    nodes.import_nodes(ids);
    AnimationImporter animations(model, tree, nodes.slots(), pointers, accessors, report, budget,
                                 out);
    animations.import_animations(ids);
    import_scene_extras(model, animations.clips(), out);
    report.finish();
    return true;
}

}  // namespace

std::optional<SceneDescription> import_gltf(const SceneSource& source, const ImportOptions& options,
                                            Diagnostics& diagnostics) {
    std::optional<GltfFile> file = read_gltf_file(source, options, diagnostics);
    if (!file) return std::nullopt;
    SceneDescription description;
    description.path = source.path;
    limit_files(description, file->directory, options);
    if (!import_model(*file, options, diagnostics, description)) return std::nullopt;
    description.inputs = std::move(file->files);
    return description;
}

}  // namespace kinora
