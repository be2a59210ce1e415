// runtime/scene/names.cpp: names of nodes, materials and surfaces.
#include "runtime/scene/names.h"

#include <cctype>
#include <map>

#include "runtime/scene/aovs/aovs.h"
#include "runtime/scene/description/play_range.h"

namespace kinora {

const std::string& shown_name(const std::string& id, const std::string& name) {
    return id.empty() ? name : id;
}

std::string number_name(uint32_t node) {
    return "#" + std::to_string(node + 1);
}

std::string node_path(const SceneNodes& scene, uint32_t node) {
    std::string path;
    for (uint32_t n = node; n != kNone; n = scene.nodes[n].parent) {
        if (scene.nodes[n].definition == kNone) continue;
        const NodeDefinition& step = scene.description->nodes[scene.nodes[n].definition];
        std::string name = shown_name(step.id, step.name);
        if (name.empty()) name = number_name(n);
        path = name + (path.empty() ? "" : "/" + path);
    }
    return path;
}

std::vector<std::string> light_aov_names(const SceneNodes& nodes, const SceneLights& lights) {
    std::vector<std::string> names;
    std::map<std::string, int> used{{"light_rest", 1}};
    for (const LightSource& source : lights.lights) {
        const NodeDefinition& node = nodes.description->nodes[nodes.nodes[source.node].definition];
        const LightDefinition& light = nodes.description->lights[source.definition];
        const std::string& of_node = shown_name(node.id, node.name);
        std::string name(kLightAov);
        for (char c : of_node.empty() ? shown_name(light.id, light.name) : of_node)
            name += std::isalnum(static_cast<unsigned char>(c)) || c == '-' ? c : '_';
        for (std::string first = name; used[name]++ > 0;)
            name = first + "_" + std::to_string(used[first]);
        names.push_back(std::move(name));
    }
    return names;
}

std::string material_name(const SceneDescription& description, uint32_t material) {
    if (material == kNone) return "default";
    const MaterialDefinition& of = description.materials[material];
    return shown_name(of.id, of.name);
}

double frames_per_second(const SceneResources& scene) {
    const double asked = scene.options.frame_rate;
    return asked > 0 ? asked : play_range(*scene.description).rate;
}

uint32_t object_id(const SceneShapes& shapes, const Surface& surface) {
    return shapes.shapes[surface.shape].node + 1;
}

uint32_t material_id(const Surface& surface) {
    return surface.material == kNone ? 1 : surface.material + 2;
}

namespace {

std::vector<IdName> listed(const std::map<uint32_t, std::string>& names) {
    std::vector<IdName> list;
    for (const auto& [id, name] : names) list.push_back({id, name});
    return list;
}

}  // namespace

std::vector<IdName> surface_names(const SceneNodes& nodes, const SceneShapes& shapes) {
    std::vector<IdName> list;
    for (const Surface& surface : shapes.surfaces)
        list.push_back(
            {uint32_t(list.size() + 1), node_path(nodes, shapes.shapes[surface.shape].node) + " " +
                                            material_name(*nodes.description, surface.material)});
    return list;
}

std::vector<IdName> object_names(const SceneNodes& nodes, const SceneShapes& shapes) {
    std::map<uint32_t, std::string> names;
    for (const Surface& surface : shapes.surfaces)
        names.try_emplace(object_id(shapes, surface),
                          node_path(nodes, shapes.shapes[surface.shape].node));
    return listed(names);
}

std::vector<IdName> material_names(const SceneNodes& nodes, const SceneShapes& shapes) {
    std::map<uint32_t, std::string> names;
    for (const Surface& surface : shapes.surfaces)
        names.try_emplace(material_id(surface),
                          material_name(*nodes.description, surface.material));
    return listed(names);
}

}  // namespace kinora
