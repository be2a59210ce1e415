// runtime/programs/common/list_scene.cpp: cameras, clips, materials and so on, as text and as JSON.
#include "runtime/programs/common/list_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "runtime/kinora/contents.h"
#include "runtime/scene/aovs/aovs.h"
#include "runtime/scene/description/play_range.h"
#include "runtime/scene/names.h"
#include "runtime/scene/scene.h"

namespace kinora {

namespace {

using Json = nlohmann::ordered_json;

Json cameras(const Scene& scene) {
    Json list = Json::array();
    for (const ListedCamera& camera : listed_cameras(scene))
        list.push_back({{"name", camera.name},
                        {"camera", camera.camera},
                        {"node", camera.node},
                        {"orthographic", camera.orthographic},
                        {"chosen", camera.chosen}});
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
    for (const ListedClip& clip : listed_clips(scene))
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
    for (const ListedMaterial& material : listed_materials(scene)) {
        Json layers = Json::array();
        for (const ListedLayer& layer : material.layers)
            layers.push_back({{"kind", layer.kind}, {"shader", layer.shader}});
        list.push_back(
            {{"name", material.name}, {"layers", layers}, {"opacity", material.opacity}});
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

Json shaders(const Scene& scene) {
    Json list = Json::array();
    for (const ListedShader& shader : listed_shaders(scene)) {
        Json parameters = Json::array();
        for (const ListedParameter& p : shader.parameters)
            parameters.push_back({{"name", p.name}, {"type", p.type}});
        list.push_back({{"name", shader.name}, {"kind", shader.kind}, {"parameters", parameters}});
    }
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
    for (const ListedShader& shader : listed_library_shaders())
        list.push_back({{"name", shader.name}, {"kind", shader.kind}});
    return list;
}

std::string our_line(const Json& row) {
    return fmt::format("ours: {} {}\n", row["kind"].get<std::string>(),
                       row["name"].get<std::string>());
}

Json rows_of(const std::vector<ListedParameter>& parameters) {
    Json list = Json::array();
    for (const ListedParameter& p : parameters)
        list.push_back({{"name", p.name}, {"type", p.type}, {"shader", p.shader}});
    return list;
}

// What --param takes.
Json params(const Scene& scene) {
    return rows_of(listed_parameters(scene));
}

std::string param_line(const Json& row) {
    return fmt::format("param {} ({}, of {})\n", row["name"].get<std::string>(),
                       row["type"].get<std::string>(), row["shader"].get<std::string>());
}

// What --aov takes: of the scene's shaders.
Json aovs(const Scene& scene) {
    return rows_of(listed_aovs(scene));
}

std::string aov_line(const Json& row) {
    return fmt::format("aov {} ({}, of {})\n", row["name"].get<std::string>(),
                       row["type"].get<std::string>(), row["shader"].get<std::string>());
}

// And of every material.
Json built_in_aovs(const Scene& scene) {
    Json list = Json::array();
    std::vector<AovRow> rows(aov_rows().begin(), aov_rows().end());
    const std::vector<std::string> lights = light_aov_names(scene, scene);
    for (const std::string& name : lights)
        rows.push_back({name, "R G B", AovSource::Light, "", raytrace::AovFilter::Mean, 0,
                        "what this light adds"});
    for (const AovRow& row : rows)
        list.push_back({{"name", row.name},
                        {"channels", channel_names(row)},
                        {"filter", word_of(row.filter)},
                        {"premultiplied", row.filter == raytrace::AovFilter::Mean},
                        {"background", row.background},
                        {"what", row.what}});
    return list;
}

std::string built_in_aov_line(const Json& row) {
    const size_t channels = row["channels"].size();
    return fmt::format("built in: aov {} ({} {}; {}; {}{})\n", row["name"].get<std::string>(),
                       channels, channels == 1 ? "channel" : "channels",
                       row["what"].get<std::string>(), row["filter"].get<std::string>(),
                       row["premultiplied"].get<bool>() ? ", premultiplied" : "");
}

Json lights(const Scene& scene) {
    Json list = Json::array();
    for (const ListedLight& light : listed_lights(scene))
        list.push_back({{"name", light.name},
                        {"node", light.node},
                        {"shader", light.shader},
                        {"area", light.area}});
    return list;
}

std::string light_line(const Json& row) {
    return fmt::format("light {} on {} ({}{})\n", row["name"].get<std::string>(),
                       row["node"].get<std::string>(), row["shader"].get<std::string>(),
                       row["area"].get<bool>() ? ", on its surface" : "");
}

// What --hide and --only are for.
Json nodes(const Scene& scene) {
    Json list = Json::array();
    for (const ListedNode& node : listed_nodes(scene))
        list.push_back({{"path", node.path},
                        {"id", node.id},
                        {"name", node.name},
                        {"meshes", node.meshes},
                        {"lights", node.lights},
                        {"cameras", node.cameras},
                        {"hidden", node.hidden}});
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
    {"builtins", built_in_aovs, built_in_aov_line},
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
    {"indirect light", "what other surfaces reflect; --gi"},
};

std::string_view meaning_of(std::string_view added) {
    for (const Added& row : kAdded)
        if (row.name == added) return row.meaning;
    return "";
}

// "shaders" are the scene's and what may take their place, "aovs" those of its shaders and of every
// material; "all" is of the scene alone.
bool is_wanted(std::string_view row, std::string_view kind) {
    if (row == "builtins") return kind == row || kind == "aovs";
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
