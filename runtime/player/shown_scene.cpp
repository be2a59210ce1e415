// runtime/player/shown_scene.cpp: what lists say of a scene.
#include "runtime/player/shown_scene.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "anim/animation.h"
#include "runtime/player/display.h"
#include "runtime/player/session/shader_places.h"
#include "runtime/scene/description/shader_library.h"
#include "runtime/scene/shaders/shader_instance.h"

namespace kinora {

namespace {

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

// `values`: those of the scene by now, or the description's own.
ShaderParamInfo param_info(const SceneDescription& description, std::span<const double> values,
                           const ShaderUse& use, const rsl::ShaderParameter& parameter) {
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
        auto numbers = values.subspan(source.value.offset, source.value.count);
        info.numbers.assign(numbers.begin(), numbers.end());
        info.animated = description.animated[source.value.offset];
    }
    return info;
}

std::vector<NodeInfo> node_infos(const Scene& scene) {
    std::vector<NodeInfo> infos;
    for (uint32_t n = 0; n < scene.nodes.size(); ++n) {
        const Node& node = scene.nodes[n];
        NodeInfo& info = infos.emplace_back();
        if (node.definition != kNone) {
            const NodeDefinition& definition = scene.description->nodes[node.definition];
            info.name = definition.name.empty() ? definition.id : definition.name;
        }
        if (info.name.empty()) info.name = number_name(n);
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

std::vector<std::string> light_names(const Scene& scene) {
    std::vector<std::string> names;
    for (const LightSource& source : scene.lights) {
        const LightDefinition& light = scene.description->lights[source.definition];
        std::string name = light.name.empty() ? light.id : light.name;
        if (name.empty()) name = "light";
        const std::string base = name;
        for (int k = 2; std::ranges::find(names, name) != names.end(); ++k)
            name = base + " " + std::to_string(k);
        names.push_back(std::move(name));
    }
    return names;
}

// A parameter whose value keys move.
struct Animated {
    ShaderParamInfo* info;
    ValueSlot slot;
};

// Their curves from one time to another, in seconds. The animation is asked itself: the scene
// stays at its time.
void add_curves(const SceneDescription& description, double begin, double end,
                std::span<const Animated> params) {
    if (params.empty()) return;
    std::vector<double> values = description.values;
    values.resize(std::max(values.size(), size_t(description.animation.slot_count)));
    std::vector<uint64_t> changed(anim::changed_words(description.animation.owner_count));
    for (size_t k = 0; k < kCurvePoints; ++k) {
        const double share = double(k) / double(kCurvePoints - 1);
        anim::evaluate(description.animation, begin + share * (end - begin), values, changed);
        for (const Animated& param : params)
            for (uint32_t c = 0; c < param.slot.count; ++c)
                param.info->curve.push_back(float(values[param.slot.offset + c]));
    }
}

void add_curves(const Scene& scene, std::span<const ShaderPlace> places,
                std::vector<MaterialInfo>& materials) {
    std::vector<Animated> params;
    for (size_t m = 0; m < materials.size(); ++m)
        for (ShaderParamInfo& info : materials[m].params) {
            if (!info.animated) continue;
            for (const ParamSource& source : places[m].use->params)
                if (source.name == info.name) params.push_back({&info, source.value});
        }
    add_curves(*scene.description, scene.options.start_time, scene.options.end_time, params);
}

// The text that the shader of a place was read from; null where there was none.
const rsl::Shader* as_read(const SceneDescription& description,
                           std::span<const ShaderPlace> further, const ShaderPlace& place,
                           size_t index, size_t materials) {
    if (index < materials)
        return index < description.materials.size() ? shown_surface(description.materials[index])
                                                    : nullptr;
    auto found = std::ranges::find(further, place.id, &ShaderPlace::id);
    return found == further.end() ? nullptr : found->use->shader.get();
}

std::vector<MaterialInfo> material_infos(const Scene& scene, const SceneRead& read) {
    const std::vector<ShaderPlace> places = shader_places(*scene.description),
                                   further = further_places(read.description);
    const size_t materials = scene.description->materials.size();
    std::vector<MaterialInfo> infos;
    for (size_t k = 0; k < places.size(); ++k) {
        const ShaderPlace& place = places[k];
        MaterialInfo& info = infos.emplace_back();
        info.id = place.id;
        info.name = place.name;
        info.target = place.target;
        info.further = k >= materials;
        if (!place.use || !place.use->shader) continue;
        info.shader = place.use->shader->name;
        for (const rsl::ShaderParameter& parameter : place.use->shader->parameters)
            info.params.push_back(
                param_info(*scene.description, scene.start.values, *place.use, parameter));
        if (const rsl::Shader* shader = as_read(read.description, further, place, k, materials))
            info.source = std::make_shared<const ShaderSourceText>(source_of(*shader, read.files));
    }
    add_curves(scene, places, infos);
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

std::shared_ptr<SceneInfo> swapped_info(const SceneInfo& before, const SceneDescription& edited) {
    auto info = std::make_shared<SceneInfo>(before);
    ++info->serial;
    for (size_t m = 0; m < std::min(info->materials.size(), edited.materials.size()); ++m) {
        const MaterialDefinition& material = edited.materials[m];
        const rsl::Shader* shader = shown_surface(material);
        if (!shader) continue;
        MaterialInfo& changed = info->materials[m];
        std::vector<ShaderParamInfo> params;
        for (const rsl::ShaderParameter& parameter : shader->parameters) {
            params.push_back(
                param_info(edited, edited.values, material.surfaces.back(), parameter));
            auto old =
                std::ranges::find(changed.params, params.back().name, &ShaderParamInfo::name);
            if (params.back().animated && old != changed.params.end()) params.back() = *old;
        }
        changed.shader = shader->name;
        changed.params = std::move(params);
    }
    return info;
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
    info->camera = scene.start.camera;
    info->lights = light_names(scene);
    for (const ClipDefinition& clip : description.clips)
        info->clips.push_back(
            {clip.name, clip.start * rate.value(), clip.end * rate.value(), clip.id});
    info->nodes = node_infos(scene);
    info->materials = material_infos(scene, read);
    std::vector<raytrace::AovPlane> planes;
    for (const OutputPlane& plane : scene.outputs)
        planes.push_back({.name = plane.name, .values = {}, .in_file = plane.in_file});
    info->aovs = shown_names(planes);
    for (double time : anim::key_times(description.animation))
        info->keys.push_back(time * rate.value());
    return info;
}

}  // namespace kinora
