// runtime/build/lights.cpp: the lights of a scene.
#include "runtime/build/lights.h"

#include <algorithm>

#include "runtime/build/area_lights.h"
#include "runtime/build/defaults.h"
#include "runtime/build/light_watts.h"
#include "runtime/scene/values.h"

namespace kinora {

namespace {

// Whether one of them shines from somewhere: ambient light alone shows no form.
bool add_lights_of_nodes(Scene& scene, const NodeTree& tree) {
    bool lit = false;
    for (uint32_t n = 0; n < scene.nodes.size(); ++n)
        for (uint32_t light : tree.definition(n).lights) {
            if (scene.nodes[n].hidden) continue;
            scene.lights.push_back({light, n, kNone, kNone});
            lit |= !scene.description->lights[light].ambient;
        }
    return lit;
}

// Its shader gives one colour whatever the light.
bool is_constant(const SceneDescription& description, const MeshUse& use,
                 const std::string& symbol) {
    bool constant = false;
    for (const MaterialUse& material : use.materials)
        if (material.symbol == symbol && material.material != kNone) {
            const auto& surfaces = description.materials[material.material].surfaces;
            constant = surfaces.size() == 1 && (surfaces[0].shader->name == "collada_constant" ||
                                                surfaces[0].shader->name == "gltf_unlit");
        }
    return constant;
}

bool needs_no_light(const Scene& scene, std::span<const SurfaceUse> uses) {
    if (scene.surfaces.empty()) return false;
    for (size_t s = 0; s < scene.surfaces.size(); ++s) {
        const Surface& surface = scene.surfaces[s];
        const Mesh& mesh = scene.meshes[scene.shapes[surface.shape].mesh];
        const std::string& symbol = mesh.groups[surface.group].symbol;
        if (!is_constant(*scene.description, *uses[s].mesh, symbol)) return false;
    }
    return true;
}

void add_default_light(Scene& scene, LightDefinition definition, uint32_t node) {
    SceneDescription& description = *scene.description;
    take_added_values(scene);
    description.lights.push_back(std::move(definition));
    scene.lights.push_back({uint32_t(description.lights.size() - 1), node, kNone, kNone});
    scene.added.push_back(description.lights.back().name);
}

}  // namespace

void add_lights(Scene& scene, NodeTree& tree, std::span<const SurfaceUse> uses,
                Diagnostics& diagnostics) {
    LightSet wanted = scene.options.lights;
    bool lit = false;
    if (wanted != LightSet::Default) {
        bool by_area = add_area_lights(scene, uses);
        lit = add_lights_of_nodes(scene, tree) || by_area;
        scale_watts(scene, diagnostics);
    }
    if (wanted == LightSet::Scene) return;
    scene.watch_dark = wanted == LightSet::Auto && lit;
    if (wanted == LightSet::Auto && (lit || needs_no_light(scene, uses))) return;
    std::vector<double>& values = scene.description->values;
    // Before NodeTree::add, which takes the description's values over into the scene.
    std::vector<LightDefinition> lights = scene.description->default_lights;
    if (lights.empty()) lights = default_lights(values, diagnostics);
    uint32_t node = tree.add(default_light_node(values), scene.cameras[scene.camera].node);
    for (LightDefinition& light : lights) add_default_light(scene, std::move(light), node);
}

}  // namespace kinora
