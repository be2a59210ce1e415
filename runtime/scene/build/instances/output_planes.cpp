// runtime/scene/build/instances/output_planes.cpp: the planes that surfaces' outputs fill.
#include "runtime/scene/build/instances/output_planes.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "rsl/model/globals.h"
#include "rsl/model/kernel_keys.h"
#include "runtime/scene/description/findings.h"

namespace kinora {

namespace {

std::string plane_name(const std::string& value, rsl::BaseType type, int component) {
    if (rsl::component_count(type) == 1) return value;
    const char* letters = type == rsl::BaseType::Color ? "RGB" : "XYZ";
    return fmt::format("{}.{}", value, letters[component]);
}

// Where a surface has the parameter as a float and others as a colour, all components take it.
bool fills(const rsl::KernelKey& output, const OutputPlane& plane) {
    using rsl::ComponentForm;
    if (output.kind != rsl::KeyKind::Aov || output.element != plane.element) return false;
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

}  // namespace

OutputPlanes::OutputPlanes(SceneShaders& scene, std::span<const std::string> wanted,
                           std::span<const FileDisplay> displays,
                           std::span<const ShaderUse> imagers, Diagnostics& diagnostics)
    : scene_(scene) {
    for (const std::string& name : wanted)
        if (!add(name, true)) diagnostics.report(Code::AOV_UNKNOWN, Location{}, name);
    for (const FileDisplay& display : displays) add_display(display, diagnostics);
    for (const ShaderUse& use : imagers)
        for (const rsl::ShaderParameter& p : use.shader->parameters)
            if (!p.type.is_array() && p.type.base != rsl::BaseType::String)
                add(std::string(p.name), false, false);
}

void OutputPlanes::add_display(const FileDisplay& display, Diagnostics& diagnostics) {
    const DisplayContent content = content_of(display);
    if (content.depth) add(std::string(rsl::kDepthOutput), false);
    if (!content.variable.empty() && !add(content.variable, false))
        diagnostics.report(Code::RI_OUTPUT_UNKNOWN, display.where, display.name, content.variable);
}

// False where no surface has that output.
bool OutputPlanes::add(const std::string& name, bool in_file, bool global) {
    if (std::ranges::find(outputs_, name) != outputs_.end()) return true;
    std::optional<rsl::Type> found = find_output(scene_, name);
    const bool declared = found.has_value();
    if (!declared && global) found = find_global_output(name);
    if (!found) return false;
    outputs_.push_back(name);
    rsl::Type type = *found;
    for (int element = 0; element < std::max(type.array_length, 1); ++element) {
        std::string value = type.is_array() ? fmt::format("{}.{}", name, element) : name;
        for (int c = 0; c < rsl::component_count(type.base); ++c)
            scene_.outputs.push_back({plane_name(value, type.base, c), name, uint32_t(c),
                                      type.is_array() ? element : -1, in_file,
                                      !declared && name == rsl::kDepthOutput});
    }
    return true;
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
