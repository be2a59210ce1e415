// runtime/scene/build/instances/output_planes.cpp: the planes that surfaces' outputs fill.
#include "runtime/scene/build/instances/output_planes.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <optional>

#include "rsl/model/globals.h"
#include "rsl/model/kernel_keys.h"
#include "runtime/scene/description/findings.h"

namespace kinora {

namespace {

using raytrace::AovFilter;

std::string plane_name(const std::string& value, rsl::BaseType type, int component) {
    if (rsl::component_count(type) == 1) return value;
    const char* letters = type == rsl::BaseType::Color ? "RGB" : "XYZ";
    return fmt::format("{}.{}", value, letters[component]);
}

// Where a surface has the parameter as a float and others as a colour, all components take it.
bool fills(const rsl::KernelKey& output, const OutputPlane& plane) {
    using rsl::ComponentForm;
    if (plane.parameter.empty() || output.kind != rsl::KeyKind::Aov) return false;
    if (output.element != plane.element) return false;
    if (rsl::name_of(output) != plane.parameter || output.form == ComponentForm::Matrix)
        return false;
    return output.form == ComponentForm::Single || output.component == plane.component;
}

// The type of the output of that name of the topmost layer that has one: a parameter, or what the
// shader may name so at run time.
std::optional<rsl::Type> find_output(const ShaderInstance& instance, std::string_view name) {
    for (auto layer = instance.layers.rbegin(); layer != instance.layers.rend(); ++layer) {
        for (const rsl::ShaderParameter& p : layer->shader->parameters)
            if (rsl::is_aov(p) && p.name == name) return p.type;
        if (std::optional<rsl::BaseType> type = rsl::named_output(*layer->shader, name))
            return rsl::Type{*type, -1};
    }
    return {};
}

// Of the first surface that has one.
std::optional<rsl::Type> find_output(const SceneShaders& scene, std::string_view name) {
    for (const auto& instance : scene.shader_instances)
        if (instance->kind == ShaderInstanceKind::Surface)
            if (std::optional<rsl::Type> found = find_output(*instance, name)) return found;
    return {};
}

std::optional<rsl::Type> find_global_output(std::string_view name) {
    std::optional<rsl::BaseType> type = rsl::global_output(name);
    return type ? std::optional(rsl::Type{*type, -1}) : std::nullopt;
}

// Those that "all" means: of shaders, whose names are known before they run.
std::vector<std::string> all_outputs(const SceneShaders& scene) {
    std::vector<std::string> names;
    for (const auto& instance : scene.shader_instances) {
        if (instance->kind != ShaderInstanceKind::Surface) continue;
        for (const ShaderUse& use : instance->layers) {
            for (const rsl::ShaderParameter& p : use.shader->parameters)
                if (rsl::is_aov(p)) names.emplace_back(p.name);
            for (const rsl::NamedOutput& o : use.shader->named_outputs)
                if (o.pattern.find('%') == o.pattern.npos) names.emplace_back(o.pattern);
        }
    }
    return names;
}

// The component of its output that channel c of a row is.
uint32_t component_of(size_t c, size_t channels, size_t outputs) {
    return channels == outputs ? 0 : uint32_t(c);
}

}  // namespace

OutputPlanes::OutputPlanes(SceneShaders& scene, std::span<const std::string> wanted,
                           std::span<const LightGroup> lights, std::span<const LightGroup> groups,
                           std::span<const FileDisplay> displays,
                           std::span<const ShaderUse> imagers, Diagnostics& diagnostics)
    : scene_(scene), lights_(lights), groups_(groups) {
    for (const std::string& text : wanted) add_wanted(text, diagnostics);
    for (const LightGroup& group : groups_) {
        if (find_aov_row(group.aov) || find_output(scene_, group.aov))
            diagnostics.report(Code::LIGHT_GROUP_FORM, Location{}, group.aov);
        else if (!is_there(group.aov))
            add_group(group, {group.aov});
    }
    for (const FileDisplay& display : displays) add_display(display, diagnostics);
    for (const ShaderUse& use : imagers)
        for (const rsl::ShaderParameter& p : use.shader->parameters)
            if (!p.type.is_array() && p.type.base != rsl::BaseType::String)
                add_output({std::string(p.name)}, Reader::Imager);
}

void OutputPlanes::add_wanted(const std::string& text, Diagnostics& diagnostics) {
    const std::optional<WantedAov> wanted = parse_aov(text);
    if (!wanted)
        diagnostics.report(Code::AOV_FILTER_UNKNOWN, Location{}, text);
    else if (wanted->name == kAllAovs)
        add_all(*wanted, diagnostics);
    else if (is_there(wanted->name))
        diagnostics.report(Code::AOV_REPEATED, Location{}, wanted->name);
    else if (!add_built_in(*wanted, diagnostics) && !add_lights(*wanted) &&
             !add_output(*wanted, Reader::File))
        diagnostics.report(Code::AOV_UNKNOWN, Location{}, wanted->name);
}

void OutputPlanes::add_all(const WantedAov& wanted, Diagnostics& diagnostics) {
    for (const AovRow& row : aov_rows())
        add_built_in({std::string(row.name), wanted.filter, wanted.half && !is_exact(row)},
                     diagnostics);
    for (const std::string& name : all_outputs(scene_))
        add_output({name, wanted.filter, wanted.half}, Reader::File);
}

void OutputPlanes::add_display(const FileDisplay& display, Diagnostics& diagnostics) {
    const DisplayContent content = content_of(display);
    if (content.depth) add_output({std::string(rsl::kDepthOutput)}, Reader::Display);
    if (!content.variable.empty() && !add_output({content.variable}, Reader::Display))
        diagnostics.report(Code::RI_OUTPUT_UNKNOWN, display.where, display.name, content.variable);
}

// False where there is none, or where a shader's output of that name goes before it.
bool OutputPlanes::add_built_in(const WantedAov& wanted, Diagnostics& diagnostics) {
    const AovRow* row = find_aov_row(wanted.name);
    if (!row || is_there(wanted.name)) return row;
    if (find_output(scene_, wanted.name)) {
        diagnostics.report(Code::AOV_OF_SHADER, Location{}, wanted.name);
        return false;
    }
    const std::vector<std::string> outputs = parted_words(row->outputs);
    const std::vector<std::string> channels = channel_names(*row);
    OutputPlane plane;
    plane.layer = wanted.name;
    plane.source = row->source;
    plane.half = wanted.half;
    plane.exact = is_exact(*row);
    plane.filter = wanted.filter.value_or(row->filter);
    if (plane.filter != AovFilter::Mean) plane.background = row->background;
    for (size_t c = 0; c < channels.size(); ++c) {
        plane.name = channels[c];
        plane.component = uint32_t(c);
        if (!outputs.empty()) {
            plane.parameter = outputs[std::min(c, outputs.size() - 1)];
            plane.component = component_of(c, channels.size(), outputs.size());
            want_output(plane.parameter);
        }
        scene_.outputs.push_back(plane);
    }
    return true;
}

// Lights and groups whose AOVs the name matches; false: there are none.
bool OutputPlanes::add_lights(const WantedAov& wanted) {
    bool any = false;
    for (const std::span<const LightGroup> all : {groups_, lights_})
        for (const LightGroup& group : all) {
            if (fnmatch(wanted.name.c_str(), group.aov.c_str(), 0) != 0) continue;
            any = true;
            if (!is_there(group.aov)) add_group(group, wanted);
        }
    return any;
}

void OutputPlanes::add_group(const LightGroup& group, const WantedAov& wanted) {
    OutputPlane plane;
    plane.layer = group.aov;
    plane.source = AovSource::Light;
    plane.lights = group.lights;
    plane.half = wanted.half;
    plane.filter = wanted.filter.value_or(AovFilter::Mean);
    for (uint32_t c = 0; c < 3; ++c) {
        plane.name = fmt::format("{}.{}", group.aov, "RGB"[c]);
        plane.component = c;
        scene_.outputs.push_back(plane);
    }
}

// False where no surface has that output.
bool OutputPlanes::add_output(const WantedAov& wanted, Reader reader) {
    const std::string& name = wanted.name;
    if (is_there(name)) return true;
    std::optional<rsl::Type> found = find_output(scene_, name);
    const bool declared = found.has_value();
    if (!declared && reader != Reader::Imager) found = find_global_output(name);
    if (!found) return false;
    want_output(name);
    const bool depth = !declared && name == rsl::kDepthOutput;
    OutputPlane plane;
    plane.layer = plane.parameter = name;
    plane.in_file = reader == Reader::File;
    plane.half = wanted.half;
    plane.filter = wanted.filter.value_or(depth ? AovFilter::Least : AovFilter::Mean);
    if (depth && plane.filter != AovFilter::Mean) plane.background = raytrace::kNoDepth;
    const rsl::Type type = *found;
    for (int element = 0; element < std::max(type.array_length, 1); ++element) {
        std::string value = type.is_array() ? fmt::format("{}.{}", name, element) : name;
        plane.element = type.is_array() ? element : -1;
        for (int c = 0; c < rsl::component_count(type.base); ++c) {
            plane.name = plane_name(value, type.base, c);
            plane.component = uint32_t(c);
            scene_.outputs.push_back(plane);
        }
    }
    return true;
}

bool OutputPlanes::is_there(const std::string& layer) const {
    return std::ranges::count(scene_.outputs, layer, &OutputPlane::layer) > 0;
}

void OutputPlanes::want_output(const std::string& output) {
    if (std::ranges::count(outputs_, output) == 0) outputs_.push_back(output);
}

void bind_planes(std::span<const OutputPlane> planes, ShaderInstance& instance) {
    if (instance.kind != ShaderInstanceKind::Surface) return;
    for (const OutputPlane& plane : planes) {
        int& output = instance.aovs.emplace_back(-1);
        const auto& outputs = instance.full.kernel().outputs;
        for (size_t o = 0; o < outputs.size(); ++o)
            if (fills(rsl::key_of(outputs[o]), plane)) output = int(o);
    }
}

}  // namespace kinora
