// runtime/scene/load/override_scene.cpp: parameters and visibility as a command line wants them.
#include "runtime/scene/load/override_scene.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "runtime/base/regular_file.h"
#include "runtime/scene/description/default_lights.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/description/texture_name.h"
#include "runtime/scene/profile_rsl/effect_shaders.h"

namespace kinora {

namespace {

// Calls f(ShaderUse&) for all shaders of a material.
template <class F>
void for_each_layer(MaterialDefinition& m, F&& f) {
    for (auto* layers :
         {&m.transformations, &m.displacements, &m.surfaces, &m.interior, &m.exterior, &m.lights})
        for (ShaderUse& use : *layers) f(use);
}

// One value for one parameter name, put wherever a shader has it.
class ParamOverride {
  public:
    ParamOverride(SceneDescription& description, std::string name, std::string value)
        : description_(description), name_(std::move(name)), value_(std::move(value)) {}

    void apply(ShaderUse& use) {
        for (const rsl::ShaderParameter& p : use.shader->parameters) known_.push_back(p.name);
        const rsl::ShaderParameter* parameter = find_parameter(*use.shader, name_);
        if (!parameter || !error_.empty()) return;
        found_ = true;
        ParamSource source;
        source.name = name_;
        if (parameter->type.base == rsl::BaseType::String)
            name_text(source);
        else if (!set_numbers(parameter->type, source))
            return;
        std::erase_if(use.params, [&](const ParamSource& s) { return s.name == name_; });
        use.params.push_back(std::move(source));
    }

    bool found() const { return found_; }
    const std::string& error() const { return error_; }
    std::string help() const {
        std::vector<std::string_view> names = known_;
        std::string_view near = nearest_name(name_, names);
        if (!near.empty()) return fmt::format("did you mean '{}'?", near);
        std::sort(names.begin(), names.end());
        names.erase(std::unique(names.begin(), names.end()), names.end());
        return names.empty() ? "there are no parameters"
                             : fmt::format("there are {}", fmt::join(names, ", "));
    }

  private:
    // A picture that the user names is read wherever it lies.
    void name_text(ParamSource& source) {
        source.strings = {value_};
        std::string path = parse_texture_name(value_).path;
        if (is_regular_file(path)) description_.pictures.add_file(path);
    }

    bool set_numbers(const rsl::Type& type, ParamSource& source) {
        std::optional<std::vector<double>> numbers = parse_numbers(value_);
        size_t wanted = size_t(rsl::component_count(type.base)) *
                        (type.is_array() ? size_t(std::max(type.array_length, 1)) : 1);
        if (numbers && numbers->size() == 1 && rsl::is_triple(type))
            numbers->resize(3, numbers->front());
        if (!numbers || numbers->size() != wanted) {
            error_ = fmt::format("a {} takes {} number{}, not '{}'", rsl::type_name(type), wanted,
                                 wanted == 1 ? "" : "s", value_);
            return false;
        }
        source.value = {uint32_t(description_.values.size()), uint32_t(wanted)};
        description_.values.insert(description_.values.end(), numbers->begin(), numbers->end());
        description_.animated.resize(description_.values.size(), false);
        return true;
    }

    SceneDescription& description_;
    std::string name_, value_, error_;
    std::vector<std::string_view> known_;
    bool found_ = false;
};

// Binds of an <instance_material> would win over the material's parameter.
void drop_binds(SceneDescription& description, uint32_t material, const std::string& name) {
    for (NodeDefinition& node : description.nodes)
        for (MeshUse& mesh : node.meshes)
            for (MaterialUse& use : mesh.materials)
                if (use.material == material)
                    std::erase_if(use.params, [&](const auto& p) { return p.first == name; });
}

}  // namespace

bool glob_matches(const std::string& pattern, const std::string& id, const std::string& name) {
    return fnmatch(pattern.c_str(), id.c_str(), 0) == 0 ||
           fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

std::optional<std::vector<double>> parse_numbers(std::string_view text) {
    std::vector<double> numbers;
    const char *at = text.data(), *end = at + text.size();
    auto gap = [](char c) { return c == ',' || c == ' '; };
    while (true) {
        at = std::find_if_not(at, end, gap);
        if (at == end) break;
        double number = 0;
        auto [rest, error] = std::from_chars(at, end, number);
        if (error != std::errc() || (rest != end && !gap(*rest)) || !std::isfinite(number))
            return std::nullopt;
        numbers.push_back(number);
        at = rest;
    }
    if (numbers.empty()) return std::nullopt;
    return numbers;
}

namespace {

// Puts the change on what the pattern names; false if that is nothing.
bool change_all(SceneDescription& description, const std::string& pattern, const std::string& name,
                ParamOverride& change) {
    bool matched = false;
    for (uint32_t m = 0; m < description.materials.size(); ++m) {
        MaterialDefinition& material = description.materials[m];
        if (!glob_matches(pattern, material.id, material.name)) continue;
        matched = true;
        for_each_layer(material, [&](ShaderUse& use) { change.apply(use); });
        drop_binds(description, m, name);
    }
    for (auto* lights : {&description.lights, &description.default_lights})
        for (LightDefinition& light : *lights) {
            if (!glob_matches(pattern, light.id, light.name)) continue;
            matched = true;
            change.apply(light.shader);
        }
    auto on_picture = [&](std::vector<ShaderUse>& stack) {
        for (ShaderUse& use : stack) {
            std::string shader(use.shader->name);
            if (!glob_matches(pattern, shader, shader)) continue;
            matched = true;
            change.apply(use);
        }
    };
    auto on_pictures = [&](PictureShaders& picture) {
        on_picture(picture.atmosphere);
        on_picture(picture.imagers);
    };
    on_pictures(description.picture);
    for (CameraDefinition& camera : description.cameras) on_pictures(camera.picture);
    for (auto& atmosphere : description.atmospheres) on_picture(atmosphere);
    return matched;
}

bool some_shader_has(SceneDescription& description, const std::string& name) {
    bool has = false;
    for_each_shader_use(description, [&](ShaderUse& use) {
        has = has || (use.shader && find_parameter(*use.shader, name));
    });
    return has;
}

struct ParamTarget {
    std::string pattern, name;
};

// "MATERIAL.NAME", "MATERIAL.HANDLE.NAME", or "HANDLE.NAME" for every shader that has such a
// co-shader. Ids may hold dots, names and handles do not.
ParamTarget split_target(SceneDescription& description, const std::string& target) {
    size_t last = target.rfind('.');
    ParamTarget plain{target.substr(0, last), target.substr(last + 1)};
    auto matches = [&](const std::string& pattern) {
        auto one = [&](const auto& of) { return glob_matches(pattern, of.id, of.name); };
        return std::ranges::any_of(description.materials, one) ||
               std::ranges::any_of(description.lights, one);
    };
    if (last == target.npos || matches(plain.pattern)) return plain;
    size_t dot = last == 0 ? target.npos : target.rfind('.', last - 1);
    if (dot != target.npos && some_shader_has(description, target.substr(dot + 1)))
        return {target.substr(0, dot), target.substr(dot + 1)};
    if (some_shader_has(description, target)) return {"*", target};
    return plain;
}

}  // namespace

bool override_param(SceneDescription& description, const std::string& target,
                    const std::string& value, Diagnostics& diagnostics) {
    auto [pattern, name] = split_target(description, target);
    ParamOverride change(description, name, value);
    if (!change_all(description, pattern, name, change)) {
        diagnostics.report(Code::MATERIAL_UNKNOWN, Location{}, pattern);
        return false;
    }
    if (!change.error().empty()) {
        diagnostics.report(Code::PARAM_VALUE, Location{}, target, change.error());
        return false;
    }
    if (!change.found())
        diagnostics.report(Code::PARAM_UNKNOWN, Location{}, pattern, name).help = change.help();
    return change.found();
}

namespace {

// The default lights that the glob names; the name of their node stands for the three on it.
std::vector<std::string> matching_default_lights(const std::string& pattern) {
    const bool node = glob_matches(pattern, kDefaultLightNode, kDefaultLightNode);
    std::vector<std::string> names;
    for (const char* name : {kKeyLight, kFillLight, kRimLight})
        if (node || glob_matches(pattern, name, name)) names.push_back(name);
    for (const char* name : {kGreyWorld, kIndirectLight, kEnvironment})
        if (glob_matches(pattern, name, name)) names.push_back(name);
    return names;
}

}  // namespace

bool override_visibility(SceneDescription& description, const std::vector<std::string>& hide,
                         const std::vector<std::string>& only, Diagnostics& diagnostics) {
    bool all_known = true;
    auto mark = [&](const std::vector<std::string>& patterns, bool NodeDefinition::*flag) {
        for (const std::string& pattern : patterns) {
            bool matched = false;
            for (NodeDefinition& node : description.nodes) {
                if (!glob_matches(pattern, node.id, node.name)) continue;
                matched = node.*flag = true;
            }
            if (flag == &NodeDefinition::hidden)
                for (std::string& light : matching_default_lights(pattern)) {
                    description.hidden_default_lights.push_back(std::move(light));
                    matched = true;
                }
            if (!matched) diagnostics.report(Code::NODE_UNKNOWN, Location{}, pattern);
            all_known &= matched;
        }
    };
    mark(hide, &NodeDefinition::hidden);
    mark(only, &NodeDefinition::chosen);
    description.only_chosen = !only.empty();
    return all_known;
}

}  // namespace kinora
