// runtime/play/shown_scene.cpp: edits put on a scene, and what lists say of it.
#include "runtime/play/shown_scene.h"

#include <algorithm>
#include <cmath>

#include "anim/animation.h"
#include "rsl/compile.h"
#include "runtime/description/shader_library.h"
#include "runtime/load/override_scene.h"
#include "runtime/play/display.h"
#include "runtime/shading/shader_instance.h"

namespace kinora {

namespace {

// The first shader of the text that can stand for the material's surface.
std::shared_ptr<const rsl::Shader> surface_of(const SceneEdits::Text& edit,
                                              const SceneRequest& request,
                                              Diagnostics& diagnostics) {
    rsl::CompileOptions options;
    options.include_directories = request.include_directories;
    rsl::ShaderSource source;
    source.map.file = diagnostics.files.add(edit.file, edit.text);
    source.text = edit.text;
    for (auto& shader : rsl::compile(source, options, diagnostics))
        if (shader->kind == rsl::ShaderKind::Surface) return std::move(shader);
    return nullptr;
}

bool has_parameter(const rsl::Shader& shader, const std::string& name) {
    return std::ranges::any_of(shader.parameters,
                               [&](const rsl::ShaderParameter& p) { return p.name == name; });
}

// The last layer, which is seen, with the sources of parameters that the new text still has.
void replace_surface(MaterialDefinition& material, std::shared_ptr<const rsl::Shader> shader) {
    if (material.surfaces.empty()) material.surfaces.emplace_back();
    ShaderUse& use = material.surfaces.back();
    std::erase_if(use.params,
                  [&](const ParamSource& p) { return !has_parameter(*shader, p.name); });
    use.shader = std::move(shader);
}

const rsl::Shader* shown_surface(const MaterialDefinition& material) {
    return material.surfaces.empty() ? nullptr : material.surfaces.back().shader.get();
}

// Materials whose shaders stand at one place of a file change together; those that wear one of ours
// do not.
bool shares_text(const rsl::Shader* a, const rsl::Shader* b) {
    if (!a || !b || !a->definition || !b->definition || a->name != b->name) return false;
    Location p = a->definition->span.where, q = b->definition->span.where;
    return p.file == q.file && p.begin == q.begin && library_shader_text(a->name).empty();
}

bool apply_text(SceneDescription& description, const SceneEdits::Text& edit,
                const SceneRequest& request, Diagnostics& diagnostics) {
    auto shader = surface_of(edit, request, diagnostics);
    if (!shader) return false;
    std::shared_ptr<const rsl::Shader> before;
    for (const MaterialDefinition& material : description.materials)
        if (material.id == edit.material && shown_surface(material))
            before = material.surfaces.back().shader;
    for (MaterialDefinition& material : description.materials)
        if (material.id == edit.material || shares_text(shown_surface(material), before.get()))
            replace_surface(material, shader);
    return true;
}

ParamKind kind_of(rsl::BaseType type) {
    switch (type) {
        case rsl::BaseType::Color:
            return ParamKind::Color;
        case rsl::BaseType::Point:
            return ParamKind::Point;
        case rsl::BaseType::Vector:
            return ParamKind::Vector;
        case rsl::BaseType::Normal:
            return ParamKind::Normal;
        case rsl::BaseType::Matrix:
            return ParamKind::Matrix;
        case rsl::BaseType::String:
            return ParamKind::Text;
        case rsl::BaseType::Float:
        case rsl::BaseType::Bool:
        case rsl::BaseType::Void:
        case rsl::BaseType::Invalid:
            break;
    }
    return ParamKind::Float;
}

ShaderParamInfo param_info(const Scene& scene, const ShaderUse& use,
                           const rsl::ShaderParameter& parameter) {
    ShaderParamInfo info;
    info.name = parameter.name;
    info.kind = kind_of(parameter.type.base);
    info.output = parameter.output;
    info.varying = parameter.detail == rsl::Detail::Varying;
    info.length = parameter.type.is_array() ? uint32_t(parameter.type.array_length) : 0;
    if (parameter.constant) {
        info.numbers.assign(parameter.constant->numbers.begin(), parameter.constant->numbers.end());
        if (!parameter.constant->strings.empty()) info.text = parameter.constant->strings.front();
    }
    for (const ParamSource& source : use.params) {
        if (source.name != parameter.name) continue;
        if (!source.strings.empty()) info.text = source.strings.front();
        if (!source.value.present()) continue;
        auto first = scene.values.begin() + ptrdiff_t(source.value.offset);
        info.numbers.assign(first, first + ptrdiff_t(source.value.count));
        info.animated = scene.description->animated[source.value.offset];
    }
    return info;
}

std::string shown_name(const NodeDefinition& node) {
    return node.name.empty() ? node.id : node.name;
}

const std::string& id_of(const NodeDefinition& node) {
    return node.id.empty() ? node.name : node.id;
}

std::vector<NodeInfo> node_infos(const Scene& scene) {
    std::vector<NodeInfo> infos;
    for (uint32_t n = 0; n < scene.nodes.size(); ++n) {
        const Node& node = scene.nodes[n];
        NodeInfo& info = infos.emplace_back();
        if (node.definition != kNone)
            info.name = shown_name(scene.description->nodes[node.definition]);
        info.path = node_path(scene, n);
        info.parent = node.parent;
        info.depth = node.parent == kNone ? 0 : infos[node.parent].depth + 1;
        info.moves = node.can_move;
    }
    for (const Surface& surface : scene.surfaces) {
        const Shape& shape = scene.shapes[surface.shape];
        if (shape.node >= infos.size()) continue;
        NodeInfo& info = infos[shape.node];
        info.deforms |= shape.kind == raytrace::GeometryKind::Deforming;
        info.triangles +=
            uint32_t(scene.meshes[shape.mesh].groups[surface.group].triangles.size() / 3);
        if (surface.material != kNone)
            info.materials.push_back(scene.description->materials[surface.material].id);
    }
    return infos;
}

std::vector<MaterialInfo> material_infos(const Scene& scene, const SceneRead& read) {
    std::vector<MaterialInfo> infos;
    for (const MaterialDefinition& material : scene.description->materials) {
        MaterialInfo& info = infos.emplace_back();
        info.id = material.id;
        info.name = material.name.empty() ? material.id : material.name;
        const rsl::Shader* shader = shown_surface(material);
        if (!shader) continue;
        info.shader = shader->name;
        for (const rsl::ShaderParameter& parameter : shader->parameters)
            info.params.push_back(param_info(scene, material.surfaces.back(), parameter));
        size_t at = infos.size() - 1;
        if (at >= read.description.materials.size()) continue;
        if (const rsl::Shader* as_read = shown_surface(read.description.materials[at]))
            info.source = std::make_shared<const ShaderSourceText>(source_of(*as_read, read.files));
    }
    return infos;
}

}  // namespace

FindingText finding_text(const Finding& finding, const SourceFiles& files) {
    FindingText text;
    text.severity = severity_name(finding.severity);
    text.code = finding.info->code;
    text.message = finding.message;
    text.help = finding.help;
    text.printed = format_finding(finding, files);
    if (finding.where.file == kNoFile) return text;
    text.file = files.name(finding.where.file);
    LineColumn at = files.line_column(finding.where.file, finding.where.begin);
    text.line = at.line;
    text.column = at.column;
    text.begin = finding.where.begin;
    text.end = finding.where.end;
    return text;
}

FindingText plain_finding(const std::string& code, const std::string& message) {
    FindingText text;
    text.severity = "error";
    text.code = code;
    text.message = message;
    text.printed = "kinora: error: " + message + " [" + code + "]\n";
    return text;
}

std::vector<FindingText> take_findings(Diagnostics& diagnostics) {
    std::vector<FindingText> texts;
    for (const Finding& finding : diagnostics.findings())
        if (finding.severity != Severity::Off)
            texts.push_back(finding_text(finding, diagnostics.files));
    diagnostics.clear();
    return texts;
}

std::string node_path(const Scene& scene, uint32_t node) {
    std::string path;
    for (uint32_t n = node; n != kNone; n = scene.nodes[n].parent) {
        if (scene.nodes[n].definition == kNone) continue;
        const std::string& step = id_of(scene.description->nodes[scene.nodes[n].definition]);
        path = step + (path.empty() ? "" : "/" + path);
    }
    return path;
}

uint32_t find_node(const Scene& scene, const std::string& wanted) {
    for (uint32_t n = 0; n < scene.nodes.size(); ++n) {
        if (scene.nodes[n].definition == kNone) continue;
        const NodeDefinition& node = scene.description->nodes[scene.nodes[n].definition];
        if (wanted == node.id || wanted == node.name || wanted == node_path(scene, n)) return n;
    }
    return kNone;
}

std::shared_ptr<SceneInfo> scene_info(const Scene& scene, const SceneRead& read,
                                      const SceneRequest& request, FrameRate rate) {
    auto info = std::make_shared<SceneInfo>();
    const SceneDescription& description = *scene.description;
    info->path = request.scene;
    info->frame_rate = rate.value();
    info->first = std::round(scene.options.start_time * rate.value());
    info->last = std::max(std::round(scene.options.end_time * rate.value()), info->first);
    info->up_axis = description.up_axis;
    info->low = scene.low;
    info->high = scene.high;
    for (const CameraSource& camera : scene.cameras) info->cameras.push_back(camera.name);
    for (const ClipDefinition& clip : description.clips)
        info->clips.push_back({clip.name, clip.start * rate.value(), clip.end * rate.value()});
    info->nodes = node_infos(scene);
    info->materials = material_infos(scene, read);
    std::vector<raytrace::AovPlane> planes;
    for (const OutputPlane& plane : scene.outputs)
        planes.push_back({plane.name, raytrace::AovFilter::Mean, {}, plane.in_file});
    info->aovs = shown_names(planes);
    for (double time : anim::key_times(description.animation))
        info->keys.push_back(time * rate.value());
    return info;
}

bool apply_edits(ImportedScene& imported, const SceneEdits& edits, const SceneRequest& request,
                 Diagnostics& diagnostics) {
    bool good = true;
    for (const SceneEdits::Text& text : edits.texts)
        good &= apply_text(imported.description, text, request, diagnostics);
    for (const auto& [target, value] : edits.params)
        good &= override_param(imported.description, target, value, diagnostics);
    if (!edits.hidden.empty()) {
        std::vector<std::string> hidden = request.hide;
        hidden.insert(hidden.end(), edits.hidden.begin(), edits.hidden.end());
        good &= override_visibility(imported.description, hidden, request.only, diagnostics);
    }
    return good;
}

}  // namespace kinora
