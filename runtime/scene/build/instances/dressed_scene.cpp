// runtime/scene/build/instances/dressed_scene.cpp: instances of the other shader in place of a
// material's.
#include "runtime/scene/build/instances/dressed_scene.h"

#include <algorithm>
#include <map>
#include <utility>

#include "runtime/scene/build/instances/instance_compiler.h"
#include "runtime/scene/build/instances/material_instance.h"
#include "runtime/scene/build/instances/output_planes.h"
#include "runtime/scene/build/instances/shader_swap.h"
#include "runtime/scene/build/instances/vertex_inputs.h"

namespace kinora {

namespace {

// How the file puts the material on the surface; null: it does not say.
const MaterialUse* use_of(const Scene& scene, const Surface& surface) {
    const Shape& shape = scene.shapes[surface.shape];
    const Mesh& mesh = scene.meshes[shape.mesh];
    const std::string& symbol = mesh.groups[surface.group].symbol;
    const uint32_t definition = scene.nodes[shape.node].definition;
    for (const MeshUse& use : scene.description->nodes[definition].meshes)
        for (const MaterialUse& material : use.materials)
            if (use.mesh == mesh.definition && material.symbol == symbol) return &material;
    return nullptr;
}

bool is_below(const Scene& scene, uint32_t node, uint32_t ancestor) {
    while (node != ancestor && node != kNone) node = scene.nodes[node].parent;
    return node == ancestor;
}

std::unique_ptr<ShaderInstance> with_shader(const ShaderInstance& worn, const Dress& dress) {
    auto instance = std::make_unique<ShaderInstance>();
    instance->name = worn.name;
    instance->node = worn.node;
    instance->hide_backfaces = worn.hide_backfaces;
    instance->done_layers = worn.done_layers;
    for (size_t l = 0; l < worn.layers.size(); ++l)
        if (l < worn.done_layers || worn.layers[l].shader->kind == rsl::ShaderKind::Displacement)
            instance->layers.push_back(worn.layers[l]);
    instance->layers.emplace_back().shader = dress.shader;
    return instance;
}

// Puts the shader on surfaces; surfaces that read the same inputs share an instance.
class Dresser {
  public:
    Dresser(const Scene& scene, Scene& made, const Dress& dress, Diagnostics& diagnostics)
        : scene_(scene), made_(made), dress_(dress), compiler_(made, diagnostics) {}

    bool put_on(Surface& surface) {
        auto instance = with_shader(*scene_.shader_instances[surface.look], dress_);
        const MeshGroup& group =
            scene_.meshes[scene_.shapes[surface.shape].mesh].groups[surface.group];
        VertexInputs inputs =
            find_vertex_inputs(*group.definition, use_of(scene_, surface), instance->layers);
        instance->varying = std::move(inputs.varying);
        surface.st = inputs.st;
        surface.varying = std::move(inputs.attributes);
        const auto number = uint32_t(made_.shader_instances.size());
        const auto [entry, is_new] =
            looks_.try_emplace({surface.look, varying_key(*instance)}, number);
        surface.look = entry->second;
        if (!is_new) return true;
        instance->index = number;
        if (!compiler_.compile(*instance)) return false;
        bind_planes(made_.outputs, *instance);
        made_.shader_instances.push_back(std::move(instance));
        return true;
    }

  private:
    const Scene& scene_;
    Scene& made_;
    const Dress& dress_;
    InstanceCompiler compiler_;
    std::map<std::pair<uint32_t, std::string>, uint32_t> looks_;
};

}  // namespace

std::unique_ptr<Scene> dressed_scene(const Scene& scene, const Dress& dress,
                                     Diagnostics& diagnostics) {
    std::unique_ptr<Scene> made = scene_beside(scene);
    const std::vector<Surface>& surfaces = scene.surfaces;
    const std::vector<raytrace::Geometry>& rows = scene.rows;
    made->surfaces = surfaces;
    made->rows = rows;
    made->still_tree.reset();  // its triangles are others
    Dresser dresser(scene, *made, dress, diagnostics);
    for (size_t s = 0; s < surfaces.size(); ++s) {
        Surface& surface = made->surfaces[s];
        raytrace::Geometry& row = made->rows[s];
        if (dress.alone != kNone &&
            !is_below(scene, scene.shapes[surface.shape].node, dress.alone)) {
            row.triangles = {};
        } else if (surface.material == dress.material) {
            if (!dresser.put_on(surface)) return nullptr;
            row.opaque = made->shader_instances[surface.look]->opaque();
        }
    }
    return made;
}

}  // namespace kinora
