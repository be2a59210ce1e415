// runtime/kinora/contents.cpp: cameras, clips, materials and so on of a built scene.
#include "runtime/kinora/contents.h"

#include <fmt/format.h>

#include <set>

#include "runtime/scene/description/shader_library.h"
#include "runtime/scene/names.h"
#include "runtime/scene/scene.h"
#include "runtime/scene/shaders/shader_instance.h"

namespace kinora {

namespace {

// Ids or names of a node and those above it; "" where a node has none.
std::string path_of_names(const SceneNodes& scene, uint32_t node) {
    std::string path;
    for (uint32_t n = node; n != kNone; n = scene.nodes[n].parent) {
        const NodeDefinition& step = scene.description->nodes[scene.nodes[n].definition];
        path = shown_name(step.id, step.name) + (path.empty() ? "" : "/" + path);
    }
    return path;
}

// Calls f(Shader&) once for each shader that the scene runs.
template <class F>
void for_each_shader(const SceneShaders& scene, F&& f) {
    std::set<const rsl::Shader*> seen;
    for (const auto* instances : {&scene.shader_instances, &scene.vertex_instances})
        for (const auto& instance : *instances)
            for (const ShaderUse& use : instance->layers)
                if (seen.insert(use.shader.get()).second) f(*use.shader);
}

}  // namespace

std::vector<ListedCamera> listed_cameras(const Scene& scene) {
    std::vector<ListedCamera> list;
    for (size_t c = 0; c < scene.cameras.size(); ++c) {
        const CameraDefinition& camera = scene.description->cameras[scene.cameras[c].definition];
        list.push_back({scene.cameras[c].name, shown_name(camera.id, camera.name),
                        path_of_names(scene, scene.cameras[c].node), camera.orthographic,
                        c == scene.start.camera});
    }
    return list;
}

std::vector<ListedClip> listed_clips(const Scene& scene) {
    std::vector<ListedClip> list;
    for (const ClipDefinition& clip : scene.description->clips)
        list.push_back({clip.name, clip.id, clip.start, clip.end});
    return list;
}

std::vector<ListedMaterial> listed_materials(const Scene& scene) {
    constexpr const char* kOpacity[] = {"opaque", "constant opacity", "computed opacity"};
    std::vector<ListedMaterial> list;
    std::set<std::string> seen;
    for (const auto& instance : scene.shader_instances) {
        if (instance->kind != ShaderInstanceKind::Surface || !seen.insert(instance->name).second)
            continue;
        ListedMaterial& material = list.emplace_back();
        material.name = instance->name;
        material.opacity = kOpacity[size_t(instance->lowered.opacity)];
        for (const ShaderUse& use : instance->layers)
            material.layers.push_back({std::string(rsl::shader_kind_name(use.shader->kind)),
                                       std::string(use.shader->name)});
    }
    return list;
}

std::vector<ListedShader> listed_shaders(const Scene& scene) {
    std::vector<ListedShader> list;
    for_each_shader(scene, [&](const rsl::Shader& shader) {
        ListedShader& listed = list.emplace_back();
        listed.name = shader.name;
        listed.kind = rsl::shader_kind_name(shader.kind);
        for (const rsl::ShaderParameter& p : shader.parameters)
            listed.parameters.push_back(
                {std::string(p.name), std::string(rsl::type_name(p.type)), listed.name});
    });
    return list;
}

std::vector<ListedShader> listed_library_shaders() {
    std::vector<ListedShader> list;
    for (std::string_view name : library_shader_names())
        list.push_back({std::string(name),
                        std::string(rsl::shader_kind_name(library_shader(name)->kind)),
                        {}});
    return list;
}

std::vector<ListedParameter> listed_parameters(const Scene& scene) {
    const SceneDescription& description = *scene.description;
    std::vector<ListedParameter> list;
    std::set<std::string> seen;
    auto add = [&](const std::string& of, const ShaderUse& use) {
        for (const rsl::ShaderParameter& p : use.shader->parameters) {
            std::string name = fmt::format("{}.{}", of, p.name);
            if (seen.insert(name).second)
                list.push_back({std::move(name), std::string(rsl::type_name(p.type)),
                                std::string(use.shader->name)});
        }
    };
    for (const MaterialDefinition& m : description.materials)
        for (const auto* layers : {&m.transformations, &m.displacements, &m.surfaces, &m.interior,
                                   &m.exterior, &m.lights})
            for (const ShaderUse& use : *layers) add(shown_name(m.id, m.name), use);
    for (const LightDefinition& light : description.lights)
        add(shown_name(light.id, light.name), light.shader);
    auto of_picture = [&](const PictureShaders& picture) {
        for (const auto* stack : {&picture.atmosphere, &picture.imagers})
            for (const ShaderUse& use : *stack) add(std::string(use.shader->name), use);
    };
    of_picture(description.picture);
    for (const auto& atmosphere : description.atmospheres)
        for (const ShaderUse& use : atmosphere) add(std::string(use.shader->name), use);
    for (const CameraDefinition& camera : description.cameras) of_picture(camera.picture);
    return list;
}

std::vector<ListedParameter> listed_aovs(const Scene& scene) {
    std::vector<ListedParameter> list;
    std::set<std::string> seen;
    for (const auto& instance : scene.shader_instances) {
        if (instance->kind != ShaderInstanceKind::Surface) continue;
        for (const ShaderUse& use : instance->layers) {
            auto add = [&](std::string_view name, rsl::Type type) {
                if (seen.insert(std::string(name)).second)
                    list.push_back({std::string(name), std::string(rsl::type_name(type)),
                                    std::string(use.shader->name)});
            };
            for (const rsl::ShaderParameter& p : use.shader->parameters)
                if (rsl::is_aov(p)) add(p.name, p.type);
            for (const rsl::NamedOutput& o : use.shader->named_outputs)
                add(o.pattern, {o.type, -1});
        }
    }
    return list;
}

std::vector<ListedLight> listed_lights(const Scene& scene) {
    std::vector<ListedLight> list;
    for (const LightSource& source : scene.lights) {
        const LightDefinition& light = scene.description->lights[source.definition];
        const NodeDefinition& node = scene.description->nodes[scene.nodes[source.node].definition];
        list.push_back({shown_name(light.id, light.name), shown_name(node.id, node.name),
                        std::string(light.shader.shader->name), source.surface != kNone});
    }
    return list;
}

std::vector<ListedNode> listed_nodes(const Scene& scene) {
    const SceneDescription& description = *scene.description;
    std::vector<ListedNode> list;
    for (uint32_t n = 0; n < scene.nodes.size(); ++n) {
        const NodeDefinition& node = description.nodes[scene.nodes[n].definition];
        ListedNode listed{path_of_names(scene, n),
                          node.id,
                          node.name,
                          {},
                          {},
                          {},
                          scene.nodes[n].hidden || !scene.nodes[n].chosen};
        for (const MeshUse& use : node.meshes) {
            const MeshDefinition& mesh = description.meshes[use.mesh];
            listed.meshes.push_back(shown_name(mesh.id, mesh.name));
        }
        for (uint32_t l : node.lights)
            listed.lights.push_back(
                shown_name(description.lights[l].id, description.lights[l].name));
        for (uint32_t c : node.cameras)
            listed.cameras.push_back(
                shown_name(description.cameras[c].id, description.cameras[c].name));
        if (listed.meshes.empty() && listed.lights.empty() && listed.cameras.empty()) continue;
        list.push_back(std::move(listed));
    }
    return list;
}

}  // namespace kinora
