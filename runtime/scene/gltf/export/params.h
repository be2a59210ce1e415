// runtime/scene/gltf/export/params.h: what a use of a shader gives its parameters.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/scene/description/scene_description.h"

namespace kinora {

// A parameter's source, or null.
const ParamSource* find_source(const ShaderUse& use, std::string_view name);
// Likewise of a slot's texture, "diffuse_map"; null where that has no name.
const ParamSource* find_map(const ShaderUse& use, const std::string& slot);
// Whether the use is that library shader.
bool is_library_shader(const ShaderUse& use, std::string_view name);

// A slot's numbers at rest; none where it is not present.
std::span<const double> slot_values(const SceneDescription& description, ValueSlot slot);

// The slots of all numbers that the use gives.
std::vector<ValueSlot> slots_of(const ShaderUse& use);

// The parameters that a use of a shader gives, by the values of a time.
struct UsedParams {
    const ShaderUse& use;
    const std::vector<double>& values;

    // One value is grey.
    dvec3 color(std::string_view name, double otherwise) const;
    double number(std::string_view name, double otherwise) const;
    std::string text(std::string_view name) const;
};

double clamp01(double x);  // 0 where it is not finite

}  // namespace kinora
