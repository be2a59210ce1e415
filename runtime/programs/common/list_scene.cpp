// runtime/programs/common/list_scene.cpp: cameras, clips, materials and so on, as text and as JSON.
#include "runtime/programs/common/list_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "runtime/scene/description/play_range.h"
#include "runtime/scene/description/shader_library.h"
#include "runtime/scene/shaders/shader_instance.h"

namespace kinora {

namespace {

using Json = nlohmann::ordered_json;

const std::string& shown(const std::string& id, const std::string& name) {
    return id.empty() ? name : id;
}

std::string node_path(const Scene& scene, uint32_t node) {
    std::string path;
    for (uint32_t n = node; n != kNone; n = scene.nodes[n].parent) {
        const NodeDefinition& step = scene.description->nodes[scene.nodes[n].definition];
        path = shown(step.id, step.name) + (path.empty() ? "" : "/" + path);
    }
    return path;
}

Json cameras(const Scene& scene) {
    Json list = Json::array();
    for (size_t c = 0; c < scene.cameras.size(); ++c) {
        const CameraDefinition& camera = scene.description->cameras[scene.cameras[c].definition];
        list.push_back({{"name", scene.cameras[c].name},
                        {"camera", shown(camera.id, camera.name)},
                        {"node", node_path(scene, scene.cameras[c].node)},
                        {"orthographic", camera.orthographic},
                        {"chosen", c == scene.start.camera}});
    }
    return list;
}

std::string camera_line(const Json& row) {
    return fmt::format("camera {} ({}{}){}\n", row["name"].get<std::string>(),
                       row["camera"].get<std::string>(),
                       row["orthographic"].get<bool>() ? ", orthographic" : "",
                       row["chosen"].get<bool>() ? " *" : "");
}

// The first row is the range that is played without --clip.
Json clips(const Scene& scene) {
    PlayRange range = play_range(*scene.description);
    Json list = Json::array(
        {{{"range", true}, {"start", range.start}, {"end", range.end}, {"rate", range.rate}}});
    for (const ClipDefinition& clip : scene.description->clips)
        list.push_back(
            {{"name", clip.name}, {"id", clip.id}, {"start", clip.start}, {"end", clip.end}});
    return list;
}

std::string clip_line(const Json& row) {
    double start = row["start"].get<double>(), end = row["end"].get<double>();
    if (row.contains("range"))
        return fmt::format("range {:.6g} to {:.6g} s at {:.6g} frames/s\n", start, end,
                           row["rate"].get<double>());
    return fmt::format("clip {} {:.6g} to {:.6g} s\n", row["name"].get<std::string>(), start, end);
}

Json materials(const Scene& scene) {
    Json list = Json::array();
    std::set<std::string> seen;
    for (const auto& look : scene.shader_instances) {
        if (look->kind != ShaderInstanceKind::Surface || !seen.insert(look->name).second) continue;
        constexpr const char* kOpacity[] = {"opaque", "constant opacity", "computed opacity"};
        Json layers = Json::array();
        for (const ShaderUse& use : look->layers)
            layers.push_back(
                {{"kind", rsl::shader_kind_name(use.shader->kind)}, {"shader", use.shader->name}});
        list.push_back({{"name", look->name},
                        {"layers", layers},
                        {"opacity", kOpacity[size_t(look->lowered.opacity)]}});
    }
    return list;
}

std::string material_line(const Json& row) {
    std::string layers;
    for (const Json& layer : row["layers"])
        layers += fmt::format("{}{} {}", layers.empty() ? "" : " + ",
                              layer["kind"].get<std::string>(), layer["shader"].get<std::string>());
    return fmt::format("material {} ({}; {})\n", row["name"].get<std::string>(), layers,
                       row["opacity"].get<std::string>());
}

// Calls f(Shader&) once for each shader that the scene runs.
template <class F>
void for_each_shader(const Scene& scene, F&& f) {
    std::set<const rsl::Shader*> seen;
    for (const auto* looks : {&scene.shader_instances, &scene.vertex_instances})
        for (const auto& look : *looks)
            for (const ShaderUse& use : look->layers)
                if (seen.insert(use.shader.get()).second) f(*use.shader);
}

Json shaders(const Scene& scene) {
    Json list = Json::array();
    for_each_shader(scene, [&](const rsl::Shader& shader) {
        Json parameters = Json::array();
        for (const rsl::ShaderParameter& p : shader.parameters)
            parameters.push_back({{"name", p.name}, {"type", rsl::type_name(p.type)}});
        list.push_back({{"name", shader.name},
                        {"kind", rsl::shader_kind_name(shader.kind)},
                        {"parameters", parameters}});
    });
    return list;
}

std::string shader_line(const Json& row) {
    std::string lines = fmt::format("shader {} {}\n", row["kind"].get<std::string>(),
                                    row["name"].get<std::string>());
    for (const Json& p : row["parameters"])
        lines +=
            fmt::format("    {} {}\n", p["type"].get<std::string>(), p["name"].get<std::string>());
    return lines;
}

// What --shader, --atmosphere and --imager take by name.
Json ours(const Scene&) {
    Json list = Json::array();
    for (std::string_view name : library_shader_names())
        list.push_back(
            {{"name", name}, {"kind", rsl::shader_kind_name(library_shader(name)->kind)}});
    return list;
}

std::string our_line(const Json& row) {
    return fmt::format("ours: {} {}\n", row["kind"].get<std::string>(),
                       row["name"].get<std::string>());
}

// What --param takes: NAME.PARAMETER of the materials, lights, atmospheres and imagers, added
// lights too.
Json params(const Scene& scene) {
    const SceneDescription& description = *scene.description;
    Json list = Json::array();
    std::set<std::string> seen;
    auto add = [&](const std::string& of, const ShaderUse& use) {
        for (const rsl::ShaderParameter& p : use.shader->parameters) {
            std::string name = fmt::format("{}.{}", of, p.name);
            if (!seen.insert(name).second) continue;
            list.push_back(
                {{"name", name}, {"type", rsl::type_name(p.type)}, {"shader", use.shader->name}});
        }
    };
    for (const MaterialDefinition& m : description.materials)
        for (const auto* layers : {&m.transformations, &m.displacements, &m.surfaces, &m.interior,
                                   &m.exterior, &m.lights})
            for (const ShaderUse& use : *layers) add(shown(m.id, m.name), use);
    for (const LightDefinition& light : description.lights)
        add(shown(light.id, light.name), light.shader);
    auto of_picture = [&](const PictureShaders& picture) {
        for (const auto* stack : {&picture.atmosphere, &picture.imagers})
            for (const ShaderUse& use : *stack) add(std::string(use.shader->name), use);
    };
    of_picture(description.picture);
    for (const CameraDefinition& camera : description.cameras) of_picture(camera.picture);
    return list;
}

std::string param_line(const Json& row) {
    return fmt::format("param {} ({}, of {})\n", row["name"].get<std::string>(),
                       row["type"].get<std::string>(), row["shader"].get<std::string>());
}

// What --aov takes: output parameters of surfaces.
Json aovs(const Scene& scene) {
    Json list = Json::array();
    std::set<std::string> seen;
    for (const auto& look : scene.shader_instances) {
        if (look->kind != ShaderInstanceKind::Surface) continue;
        for (const ShaderUse& use : look->layers) {
            auto add = [&](std::string_view name, rsl::Type type) {
                if (seen.insert(std::string(name)).second)
                    list.push_back({{"name", name},
                                    {"type", rsl::type_name(type)},
                                    {"shader", use.shader->name}});
            };
            for (const rsl::ShaderParameter& p : use.shader->parameters)
                if (rsl::is_aov(p)) add(p.name, p.type);
            for (const rsl::NamedOutput& o : use.shader->named_outputs)
                add(o.pattern, {o.type, -1});
        }
    }
    return list;
}

std::string aov_line(const Json& row) {
    return fmt::format("aov {} ({}, of {})\n", row["name"].get<std::string>(),
                       row["type"].get<std::string>(), row["shader"].get<std::string>());
}

Json lights(const Scene& scene) {
    Json list = Json::array();
    for (const LightSource& source : scene.lights) {
        const LightDefinition& light = scene.description->lights[source.definition];
        const NodeDefinition& node = scene.description->nodes[scene.nodes[source.node].definition];
        list.push_back({{"name", shown(light.id, light.name)},
                        {"node", shown(node.id, node.name)},
                        {"shader", light.shader.shader->name},
                        {"area", source.surface != kNone}});
    }
    return list;
}

std::string light_line(const Json& row) {
    return fmt::format("light {} on {} ({}{})\n", row["name"].get<std::string>(),
                       row["node"].get<std::string>(), row["shader"].get<std::string>(),
                       row["area"].get<bool>() ? ", on its surface" : "");
}

// What --hide and --only are for: nodes that bear something.
Json nodes(const Scene& scene) {
    const SceneDescription& description = *scene.description;
    Json list = Json::array();
    for (uint32_t n = 0; n < scene.nodes.size(); ++n) {
        const NodeDefinition& node = description.nodes[scene.nodes[n].definition];
        Json meshes = Json::array(), lights = Json::array(), cameras = Json::array();
        for (const MeshUse& use : node.meshes) {
            const MeshDefinition& mesh = description.meshes[use.mesh];
            meshes.push_back(shown(mesh.id, mesh.name));
        }
        for (uint32_t l : node.lights)
            lights.push_back(shown(description.lights[l].id, description.lights[l].name));
        for (uint32_t c : node.cameras)
            cameras.push_back(shown(description.cameras[c].id, description.cameras[c].name));
        if (meshes.empty() && lights.empty() && cameras.empty()) continue;
        list.push_back({{"path", node_path(scene, n)},
                        {"id", node.id},
                        {"name", node.name},
                        {"meshes", meshes},
                        {"lights", lights},
                        {"cameras", cameras},
                        {"hidden", scene.nodes[n].hidden || !scene.nodes[n].chosen}});
    }
    return list;
}

std::string node_line(const Json& row) {
    std::string bears;
    for (const char* kind : {"meshes", "lights", "cameras"})
        for (const Json& name : row[kind])
            bears += fmt::format("{}{}", bears.empty() ? "" : ", ", name.get<std::string>());
    return fmt::format("node {} ({}){}\n", row["path"].get<std::string>(), bears,
                       row["hidden"].get<bool>() ? " hidden" : "");
}

struct Kind {
    std::string_view name;
    Json (*rows)(const Scene&);
    std::string (*line)(const Json& row);
};
constexpr Kind kKinds[] = {
    {"cameras", cameras, camera_line},
    {"clips", clips, clip_line},
    {"materials", materials, material_line},
    {"shaders", shaders, shader_line},
    {"ours", ours, our_line},
    {"params", params, param_line},
    {"aovs", aovs, aov_line},
    {"lights", lights, light_line},
    {"nodes", nodes, node_line},
};

// docs/format.md#cameras; runtime/scene/build/defaults.cpp.
struct Added {
    std::string_view name, meaning;
};
constexpr Added kAdded[] = {
    {"default camera",
     "frames all over the range played; yfov 37 from (1, 0.6, 1) as the up axis has right, up and "
     "back, if --camera and --look-from do not say otherwise"},
    {"default key light", "0.85, from over the camera's left shoulder; --lights scene: none"},
    {"default fill light", "0.22, wide, from the camera's right; no shadows, no highlights"},
    {"default rim light", "0.35, from behind, above; no shadows, no highlights"},
    {"grey world", "0.05 from all sides, as Blender's; no shadows; --lights scene: none"},
};

std::string_view meaning_of(std::string_view added) {
    for (const Added& row : kAdded)
        if (row.name == added) return row.meaning;
    return "";
}

// "shaders" are the scene's and what may take their place; "all" is of the scene alone.
bool is_wanted(std::string_view row, std::string_view kind) {
    if (row == "ours") return kind == row || kind == "shaders";
    return kind == "all" || kind == row;
}

}  // namespace

const std::vector<std::string_view>& list_kinds() {
    static const std::vector<std::string_view> names = [] {
        std::vector<std::string_view> all;
        for (const Kind& kind : kKinds) all.push_back(kind.name);
        all.push_back("all");
        return all;
    }();
    return names;
}

std::string list_scene(const Scene& scene, const std::string& kind) {
    std::string lines;
    for (const Kind& row : kKinds)
        if (is_wanted(row.name, kind))
            for (const Json& thing : row.rows(scene)) lines += row.line(thing);
    if (lines.empty()) lines = fmt::format("no {}\n", kind);
    for (const std::string& added : scene.added)
        lines += fmt::format("added: {} ({})\n", added, meaning_of(added));
    return lines;
}

std::string list_scene_json(const Scene& scene, const std::string& kind) {
    Json all = Json::object();
    for (const Kind& row : kKinds)
        if (is_wanted(row.name, kind)) all[std::string(row.name)] = row.rows(scene);
    Json added = Json::array();
    for (const std::string& name : scene.added)
        added.push_back({{"name", name}, {"meaning", meaning_of(name)}});
    all["added"] = added;
    // Names may hold bytes that are no UTF-8.
    return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace kinora
