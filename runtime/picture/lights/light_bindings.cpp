// runtime/picture/lights/light_bindings.cpp: from the names in lights' and surfaces' shaders to
// columns.
#include "runtime/picture/lights/light_bindings.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <string_view>

#include "rsl/model/kernel_keys.h"
#include "runtime/scene/description/shader_library.h"
#include "runtime/scene/kernels/light_categories.h"
#include "runtime/scene/lights.h"
#include "runtime/scene/nodes.h"
#include "runtime/scene/pose.h"
#include "runtime/scene/resources.h"
#include "runtime/scene/shaders.h"

namespace kinora {

namespace {

int find_output(const jit::Kernel& kernel, const rsl::KernelKey& key) {
    for (size_t o = 0; o < kernel.outputs.size(); ++o)
        if (rsl::key_of(kernel.outputs[o]) == key) return int(o);
    return -1;
}

// The light's __category: a comma separated list.
std::string categories_of(const ShaderInstance& light) {
    for (const ParamSource& source : light.layers[0].params)
        if (source.name == "__category" && !source.strings.empty()) return source.strings[0];
    for (const rsl::ShaderParameter& p : light.shader().parameters)
        if (p.name == "__category" && p.constant && !p.constant->strings.empty())
            return p.constant->strings[0];
    return "";
}

// A light's float parameter: bound to a value, which may be animated, or its constant default.
LightNumber number_of(const ShaderInstance& light, std::string_view name) {
    for (const ParamSource& source : light.layers[0].params)
        if (source.name == name && source.value.present()) return {source.value.offset, 0};
    for (const rsl::ShaderParameter& p : light.shader().parameters)
        if (p.name == name && p.constant && !p.constant->numbers.empty())
            return {kNone, p.constant->numbers[0]};
    return {};
}

LightOutputs statement_of(const ShaderInstance& look, size_t index,
                          const LightDefinition& definition, ShadowMode mode) {
    const jit::Kernel& kernel = look.full.kernel();
    const rsl::LightStatement& from = look.lowered.light_statements[index];
    LightOutputs statement;
    statement.kind = from.kind;
    statement.sampled = from.sampled;
    auto find = [&](rsl::LightColumn column, int k) {
        return find_output(kernel, rsl::light_key(index, column, k));
    };
    for (int k = 0; k < 3; ++k) {
        statement.L[k] = find(rsl::kLightL, k);
        statement.Cl[k] = find(rsl::kLightCl, k);
        statement.Ol[k] = find(rsl::kLightOl, k);
    }
    statement.lit = find(rsl::kLightLit, 0);
    statement.spread = find(rsl::kLightSpread, 0);
    statement.casts_shadow = from.casts_shadow;
    if (definition.shadows && mode != ShadowMode::All) statement.casts_shadow = *definition.shadows;
    if (mode == ShadowMode::Explicit) statement.casts_shadow = definition.shadows.value_or(false);
    if (mode == ShadowMode::Off || from.kind == rsl::kLightAmbient) statement.casts_shadow = false;
    return statement;
}

// Has the light a parameter that a variable of the type can take?
bool parameter_fits(const ShaderInstance& light, std::string_view name, rsl::Type type) {
    for (const rsl::ShaderParameter& p : light.shader().parameters) {
        if (p.name != name) continue;
        bool triples = rsl::is_triple(p.type.base) && rsl::is_triple(type.base);
        return (p.type.base == type.base || triples) && p.type.array_length == type.array_length;
    }
    return false;
}

// Triples are read as any triple.
int find_component(const jit::Kernel& kernel, const std::string& name, int element,
                   rsl::BaseType type, int k) {
    using rsl::ComponentForm;
    auto find = [&](ComponentForm form) {
        return find_output(kernel, rsl::message_key(name, element, form, k));
    };
    if (!rsl::is_triple(type)) return find(rsl::form_of(type));
    int output = find(ComponentForm::Triple);
    return output >= 0 ? output : find(ComponentForm::Color);
}

// Whether some loop of the surface asks for lights of these categories' bits.
bool asks_for(const rsl::LoweredShader& surface, const rsl::LoweredShader& light, uint32_t bits) {
    bool ambient = false, directed = false;
    for (const rsl::LightStatement& statement : light.light_statements)
        (statement.kind == rsl::kLightAmbient ? ambient : directed) = true;
    const bool named = (bits & surface.lit_categories) != 0 || (~bits & surface.lit_without) != 0;
    return (ambient && surface.lit_by_ambient) || (directed && (surface.lit_by_all || named));
}

bool is_lit_by(const ShaderInstance& surface, const LightSource& light) {
    return !surface.lights || light.listed == kNone ||
           std::ranges::binary_search(*surface.lights, light.listed);
}

// Whether its own kernel asks for diffuse light that other surfaces reflect.
bool gathers_indirect(const ShaderInstance& surface) {
    return std::ranges::any_of(surface.full.kernel().services, [](const auto& service) {
        return service.name == "indirectdiffuse";
    });
}

// `indirect`: the light is what other surfaces reflect. What a surface reads of a light: its
// categories' bits, the outputs behind its messages.
LightBinding binding_of(const ShaderInstance& surface, const LightSource& source,
                        const ShaderInstance& light, bool indirect) {
    LightBinding binding;
    std::string own = categories_of(light);
    for (size_t c = 0; c < surface.lowered.categories.size(); ++c)
        binding.categories |= int32_t(has_category(own, surface.lowered.categories[c])) << c;
    binding.seen = asks_for(surface.lowered, light.lowered, uint32_t(binding.categories)) &&
                   is_lit_by(surface, source) && !(indirect && gathers_indirect(surface));
    binding.nondiffuse = number_of(light, "__nondiffuse");
    binding.nonspecular = number_of(light, "__nonspecular");
    const jit::Kernel& kernel = light.full.kernel();
    for (size_t m = 0; m < surface.lowered.light_messages.size(); ++m) {
        rsl::Type type = surface.lowered.light_message_types[m];
        const std::string& name = surface.lowered.light_messages[m];
        int length = std::max(type.array_length, 1);
        bool known = parameter_fits(light, name, type);
        for (int e = 0; e < length; ++e)
            for (int k = 0; k < rsl::component_count(type.base); ++k)
                binding.messages.push_back(
                    known ? find_component(kernel, name, type.is_array() ? e : -1, type.base, k)
                          : -1);
        binding.known.push_back(known);
    }
    return binding;
}

// Shaders of the library whose light ends: the parameters that say where; "" for none.
struct BoundedShader {
    const char* name;
    const char* angle;
    double half_radians;  // that one unit of the angle is
    const char* range;    // in the light's units, of which `unit` is the length
};
constexpr BoundedShader kBounded[] = {
    {"collada_spot", "falloff_angle", 0.5 * kPi / 180, ""},
    {"gltf_spot", "outer_angle", 1, "range"},
    {"gltf_point", "", 0, "range"},
};

// Shaders of the library whose light is lightcolor times intensity, times what falls off.
constexpr std::string_view kColored[] = {"collada_ambient", "collada_directional", "collada_point",
                                         "collada_spot",    "gltf_point",          "gltf_spot"};

// Whether a light of the library sends nothing in a pose: its color or its
// intensity is 0.
bool is_black(const Pose& pose, const ShaderInstance& look) {
    const std::string& name = look.shader().name;
    if (std::ranges::find(kColored, name) == std::end(kColored) ||
        &look.shader() != library_shader(name).get())
        return false;
    bool black = false;
    for (const ParamSource& source : look.layers[0].params) {
        const bool color = source.name == "lightcolor";
        if ((!color && source.name != "intensity") || !source.value.present()) continue;
        const double* value = &pose.values[source.value.offset];
        black |= std::all_of(value, value + (color ? 3 : 1), [](double x) { return x == 0; });
    }
    return black;
}

}  // namespace

LightReach LightBindings::reach(const SceneNodes& scene, const Pose& pose,
                                const ShaderInstance& look) {
    LightReach reach;
    reach.black = is_black(pose, look);
    if (look.area_light) return reach;  // its light does not come from its node
    for (const BoundedShader& row : kBounded) {
        if (look.shader().name != row.name || &look.shader() != library_shader(row.name).get())
            continue;
        auto number = [&](const char* name) { return double(number_of(look, name).in(pose)); };
        const dmat4 current = kinora::current_from_space(scene, pose, "shader", look.space_owner());
        reach.apex = dvec3(current[3]);
        reach.axis = glm::normalize(dvec3(current[2]));
        if (*row.angle) reach.set_cone(std::abs(number(row.angle)) * row.half_radians);
        if (const double range = *row.range ? number(row.range) : 0; range > 0)
            reach.range = range * number("unit");
    }
    return reach;
}

float LightNumber::in(const Pose& pose) const {
    return value == kNone ? fixed : float(pose.values[value]);
}

LightBindings::LightBindings(const SceneResources& resources, const SceneLights& sources,
                             const SceneShaders& shaders) {
    for (const LightSource& light : sources.lights) {
        const ShaderInstance& look = *shaders.shader_instances[light.look];
        auto& statements = statements_.emplace_back();
        for (size_t s = 0; s < look.lowered.light_statements.size(); ++s)
            statements.push_back(statement_of(look, s,
                                              resources.description->lights[light.definition],
                                              resources.options.quality.shadows));
    }
    for (const auto& look : shaders.shader_instances) {
        auto& row = bindings_.emplace_back();
        if (look->kind == ShaderInstanceKind::Light) continue;
        for (size_t l = 0; l < sources.lights.size(); ++l) {
            const LightSource& light = sources.lights[l];
            row.push_back(binding_of(*look, light, *shaders.shader_instances[light.look],
                                     resources.description->lights[light.definition].indirect));
            row.back().light = int32_t(l);
        }
    }
    asked_.resize(sources.lights.size());
    for (const auto& row : bindings_)
        for (size_t l = 0; l < row.size(); ++l)
            if (row[l].seen) asked_[l] = true;
}

bool LightBindings::directed(size_t light) const {
    return std::any_of(statements_[light].begin(), statements_[light].end(),
                       [](const auto& s) { return s.kind != rsl::kLightAmbient; });
}

}  // namespace kinora
