// runtime/scene/build/lights.cpp: the lights of a scene.
#include "runtime/scene/build/lights.h"

#include <algorithm>

#include "runtime/scene/build/area_lights.h"
#include "runtime/scene/build/defaults.h"
#include "runtime/scene/build/emission.h"
#include "runtime/scene/build/environment.h"
#include "runtime/scene/build/instances/instances.h"
#include "runtime/scene/build/light_watts.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/description/shader_library.h"
#include "runtime/scene/scene.h"
#include "runtime/scene/transforms.h"
#include "runtime/scene/values.h"

namespace kinora {

namespace {

// Counting what is black costs some 0.3 % of a frame, so it ends after these.
constexpr uint32_t kWatchedFrames = 4;

// Whether one of them shines from somewhere: ambient light alone shows no form.
bool add_lights_of_nodes(Scene& scene, const NodeTree& tree) {
    bool lit = false;
    for (uint32_t n = 0; n < scene.nodes.size(); ++n)
        for (uint32_t light : tree.definition(n).lights) {
            if (scene.nodes[n].hidden) continue;
            scene.lights.push_back({light, n, kNone, kNone, light});
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
    take_added_values(description, scene.start);
    description.lights.push_back(std::move(definition));
    scene.lights.push_back({uint32_t(description.lights.size() - 1), node, kNone, kNone, kNone});
    scene.added.push_back(description.lights.back().name);
}

bool is_hidden(const SceneDescription& description, std::string_view light) {
    return std::ranges::count(description.hidden_default_lights, light) > 0;
}

// The default lights but for those that are hidden. Options may have changed them.
std::vector<LightDefinition> lights_to_add(Scene& scene) {
    SceneDescription& description = *scene.description;
    std::vector<LightDefinition> lights = description.default_lights;
    if (lights.empty()) lights = default_lights(description.values);
    std::erase_if(lights, [&](const auto& light) { return is_hidden(description, light.name); });
    return lights;
}

// Blender shows what its lamps leave dark under its grey world, which its exporters leave out.
void add_grey_world(Scene& scene, std::span<const SurfaceUse> uses, Diagnostics& diagnostics) {
    if (!scene.options.decode_textures) return;  // --color legacy: as the file says
    if (is_hidden(*scene.description, kGreyWorld)) return;
    auto lamp = std::ranges::find_if(scene.lights, [&](const LightSource& light) {
        return scene.description->lights[light.definition].blender;
    });
    if (lamp == scene.lights.end() || needs_no_light(scene, uses)) return;
    uint32_t node = lamp->node;
    diagnostics.report(Code::LIGHTS_WORLD, scene.description->lights[lamp->definition].where);
    for (LightDefinition& light : lights_to_add(scene))
        if (light.name == kGreyWorld) add_default_light(scene, std::move(light), node);
    scene.world_light = kGreyWorldLight;
}

}  // namespace

bool has_default_lights(const SceneDescription& description) {
    return !is_hidden(description, kKeyLight) || !is_hidden(description, kFillLight) ||
           !is_hidden(description, kRimLight);
}

bool add_default_lights(Scene& scene, Diagnostics& diagnostics) {
    std::erase_if(scene.lights, [&](const LightSource& light) {
        return scene.description->lights[light.definition].name == kGreyWorld;
    });
    std::erase(scene.added, kGreyWorld);
    scene.world_light = 0;
    scene.watch_dark = 0;
    scene.options.lights = LightSet::Both;
    std::vector<LightDefinition> lights = lights_to_add(scene);
    NodeDefinition carrier = default_light_node(scene.description->values);
    uint32_t node =
        add_node(scene, scene.start, std::move(carrier), scene.cameras[scene.start.camera].node);
    for (LightDefinition& light : lights)
        if (light.name != kGreyWorld) add_default_light(scene, std::move(light), node);
    find_moving_parts(scene, scene);
    return add_light_instances(scene, diagnostics);
}

namespace {

// The lights that shine from somewhere.
void add_shining_lights(Scene& scene, NodeTree& tree, std::span<const SurfaceUse> uses,
                        Diagnostics& diagnostics) {
    LightSet wanted = scene.options.lights;
    bool lit = false;
    if (wanted != LightSet::Default) {
        bool by_area = add_area_lights(*scene.description, scene, scene, uses);
        lit = add_lights_of_nodes(scene, tree) || by_area;
        scale_watts(scene, diagnostics);
    }
    if (wanted == LightSet::Scene) return;
    if (wanted == LightSet::Auto && has_environment(*scene.description)) return;
    if (wanted == LightSet::Auto && lit) {
        scene.watch_dark = kWatchedFrames;
        add_grey_world(scene, uses, diagnostics);
        return;
    }
    if (wanted == LightSet::Auto && needs_no_light(scene, uses)) return;
    if (!has_default_lights(*scene.description)) return;
    // Before NodeTree::add, which takes the description's values over into the scene.
    std::vector<LightDefinition> lights = lights_to_add(scene);
    NodeDefinition carrier = default_light_node(scene.description->values);
    uint32_t node = tree.add(carrier, scene.cameras[scene.start.camera].node);
    for (LightDefinition& light : lights)
        if (light.name != kGreyWorld) add_default_light(scene, std::move(light), node);
}

// After the lights of the scene, which it carries on. It stands nowhere, so any node will do.
void add_indirect_light(Scene& scene) {
    LightDefinition light;
    light.id = light.name = kIndirectLight;
    light.shader.shader = library_shader("indirectlight");
    light.indirect = true;
    add_default_light(scene, std::move(light), scene.cameras[scene.start.camera].node);
}

}  // namespace

bool add_lights(Scene& scene, NodeTree& tree, std::span<const SurfaceUse> uses,
                Diagnostics& diagnostics) {
    add_shining_lights(scene, tree, uses, diagnostics);
    if (!add_environment(scene, tree, diagnostics)) return false;
    if (scene.options.indirect > 0 && !is_hidden(*scene.description, kIndirectLight)) {
        add_indirect_light(scene);
        add_emission_lights(scene, uses);
    }
    return true;
}

}  // namespace kinora
