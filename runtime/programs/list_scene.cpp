// runtime/programs/list_scene.cpp: cameras, clips, materials, shaders and lights as text.
#include "runtime/programs/list_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace kinora {

namespace {

std::string cameras(const Scene& scene) {
    std::string text;
    for (size_t c = 0; c < scene.cameras.size(); ++c) {
        const CameraDefinition& camera = scene.description->cameras[scene.cameras[c].definition];
        text +=
            fmt::format("camera {} ({}{}){}\n", scene.cameras[c].name,
                        camera.id.empty() ? camera.name : camera.id,
                        camera.orthographic ? ", orthographic" : "", c == scene.camera ? " *" : "");
    }
    return text;
}

std::string clips(const Scene& scene) {
    PlayRange range = play_range(*scene.description);
    std::string text = fmt::format("range {:.6g} to {:.6g} s at {:.6g} frames/s\n", range.start,
                                   range.end, range.rate);
    for (const ClipDefinition& clip : scene.description->clips)
        text += fmt::format("clip {} {:.6g} to {:.6g} s\n", clip.name, clip.start, clip.end);
    return text;
}

std::string stack_text(const std::vector<ShaderUse>& layers) {
    std::string text;
    for (const ShaderUse& use : layers)
        text += fmt::format("{}{} {}", text.empty() ? "" : " + ",
                            rsl::shader_kind_name(use.shader->kind), use.shader->name);
    return text;
}

std::string materials(const Scene& scene) {
    std::string text;
    std::set<std::string> seen;
    for (const auto& look : scene.looks) {
        if (look->kind != LookKind::Surface || !seen.insert(look->name).second) continue;
        constexpr const char* kOpacity[] = {"opaque", "constant opacity", "computed opacity"};
        text += fmt::format("material {} ({}; {})\n", look->name, stack_text(look->layers),
                            kOpacity[size_t(look->lowered.opacity)]);
    }
    return text;
}

std::string shaders(const Scene& scene) {
    std::string text;
    std::set<const rsl::Shader*> seen;
    for (const auto& look : scene.looks)
        for (const ShaderUse& use : look->layers) {
            if (!seen.insert(use.shader.get()).second) continue;
            text += fmt::format("shader {} {}\n", rsl::shader_kind_name(use.shader->kind),
                                use.shader->name);
            for (const rsl::ShaderParameter& p : use.shader->parameters)
                text += fmt::format("    {} {}\n", rsl::type_name(p.type), p.name);
        }
    return text;
}

std::string lights(const Scene& scene) {
    std::string text;
    for (const LightSource& source : scene.lights) {
        const LightDefinition& light = scene.description->lights[source.definition];
        const NodeDefinition& node = scene.description->nodes[scene.nodes[source.node].definition];
        text += fmt::format("light {} on {} ({})\n", light.id.empty() ? light.name : light.id,
                            node.id.empty() ? node.name : node.id, light.shader.shader->name);
    }
    return text;
}

struct Row {
    const char* kind;
    std::string (*text)(const Scene&);
};
constexpr Row kRows[] = {{"cameras", cameras},
                         {"clips", clips},
                         {"materials", materials},
                         {"shaders", shaders},
                         {"lights", lights}};

}  // namespace

std::string list_scene(const Scene& scene, const std::string& kind) {
    std::string text;
    for (const Row& row : kRows)
        if (kind == "all" || kind == row.kind) text += row.text(scene);
    for (const std::string& added : scene.added) text += fmt::format("added: {}\n", added);
    return text;
}

}  // namespace kinora
