// runtime/scene/gltf/export/params.cpp: what a use of a shader gives its parameters.
#include "runtime/scene/gltf/export/params.h"

#include <algorithm>
#include <cmath>

#include "runtime/scene/description/shader_library.h"

namespace kinora {

const ParamSource* find_source(const ShaderUse& use, std::string_view name) {
    for (const ParamSource& source : use.params)
        if (source.name == name) return &source;
    return nullptr;
}

const ParamSource* find_map(const ShaderUse& use, const std::string& slot) {
    const ParamSource* source = find_source(use, slot + "_map");
    return source && !source->strings.empty() && !source->strings[0].empty() ? source : nullptr;
}

bool is_library_shader(const ShaderUse& use, std::string_view name) {
    if (!use.shader || use.shader->name != name) return false;
    return library_shader(name).get() == use.shader.get();
}

std::vector<ValueSlot> slots_of(const ShaderUse& use) {
    std::vector<ValueSlot> slots;
    for (const ParamSource& p : use.params)
        if (p.value.present()) slots.push_back(p.value);
    return slots;
}

std::span<const double> slot_values(const SceneDescription& description, ValueSlot slot) {
    if (!slot.present()) return {};
    return std::span(description.values).subspan(slot.offset, slot.count);
}

dvec3 UsedParams::color(std::string_view name, double otherwise) const {
    const ParamSource* p = find_source(use, name);
    if (!p || !p->value.present() || p->value.count < 1) return dvec3(otherwise);
    const double* v = &values[p->value.offset];
    return p->value.count < 3 ? dvec3(v[0]) : dvec3(v[0], v[1], v[2]);
}

double UsedParams::number(std::string_view name, double otherwise) const {
    return color(name, otherwise).x;
}

double clamp01(double x) {
    return std::clamp(std::isfinite(x) ? x : 0.0, 0.0, 1.0);
}

std::string UsedParams::text(std::string_view name) const {
    const ParamSource* p = find_source(use, name);
    return p && !p->strings.empty() ? p->strings[0] : "";
}

}  // namespace kinora
