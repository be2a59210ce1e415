// runtime/scene/load/override_shader.cpp: shaders of the command line on materials, lights and
// pictures.
#include "runtime/scene/load/override_shader.h"

#include <fmt/format.h>

#include <algorithm>

#include "rsl/model/builtin.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/description/given_globals.h"
#include "runtime/scene/load/override_scene.h"
#include "runtime/scene/profile_rsl/effect_shaders.h"

namespace kinora {

namespace {

using rsl::ShaderKind;
using Kinds = std::initializer_list<ShaderKind>;
using SharedShader = std::shared_ptr<const rsl::Shader>;

std::string names_of(Kinds kinds) {
    std::string names;
    for (ShaderKind kind : kinds)
        names += fmt::format("{}{}", names.empty() ? "" : ", ", rsl::shader_kind_name(kind));
    return names;
}

// A shader that the user gives may read what lies beside it.
SharedShader first_of_file(SceneDescription& description, const ShaderGiven& given, Kinds kinds,
                           Diagnostics& diagnostics) {
    rsl::CompileOptions options;
    options.include_directories = given.include_directories;
    auto shaders = rsl::compile_file(given.shader, options, diagnostics);
    if (shaders.empty()) return nullptr;  // a finding says why
    std::string folder = given.shader.substr(0, given.shader.rfind('/') + 1);
    description.readable.add(folder);
    description.pictures.add(folder);
    for (auto& shader : shaders)
        if (std::find(kinds.begin(), kinds.end(), shader->kind) != kinds.end())
            return std::move(shader);
    diagnostics.report(Code::SHADER_OF_OTHER_KIND, Location{}, given.shader, names_of(kinds));
    return nullptr;
}

SharedShader ours(const ShaderGiven& given, Kinds kinds, Diagnostics& diagnostics) {
    SharedShader shader = named_shader(given.shader, diagnostics);
    if (!shader) return nullptr;
    if (std::find(kinds.begin(), kinds.end(), shader->kind) != kinds.end()) return shader;
    diagnostics.report(Code::SHADER_OF_OTHER_KIND, Location{}, given.shader, names_of(kinds));
    return nullptr;
}

SharedShader find_given(SceneDescription& description, const ShaderGiven& given, Kinds kinds,
                        Diagnostics& diagnostics) {
    return names_shader_file(given.shader) ? first_of_file(description, given, kinds, diagnostics)
                                           : ours(given, kinds, diagnostics);
}

// The shader with what `old` has for parameters of the same name.
ShaderUse with_sources(const SharedShader& shader, std::span<const ShaderUse> old) {
    ShaderUse use{shader, {}};
    for (const ShaderUse& layer : old)
        for (const ParamSource& source : layer.params)
            if (find_parameter(*shader, source.name) || is_given_global(source.name))
                use.params.push_back(source);
    return use;
}

void replace(std::vector<ShaderUse>& stack, const SharedShader& shader) {
    stack.assign(1, with_sources(shader, stack));
}

struct StageRow {
    ShaderKind kind;
    std::vector<ShaderUse> MaterialDefinition::*stack;
};
constexpr StageRow kStages[] = {{ShaderKind::Surface, &MaterialDefinition::surfaces},
                                {ShaderKind::Displacement, &MaterialDefinition::displacements},
                                {ShaderKind::Transformation, &MaterialDefinition::transformations},
                                {ShaderKind::Volume, &MaterialDefinition::interior},
                                {ShaderKind::Light, &MaterialDefinition::lights}};

bool put_on_lights(SceneDescription& description, const std::string& pattern,
                   const SharedShader& shader) {
    bool matched = false;
    for (auto* lights : {&description.lights, &description.default_lights})
        for (LightDefinition& light : *lights) {
            if (!glob_matches(pattern, light.id, light.name)) continue;
            light.shader = with_sources(shader, {&light.shader, 1});
            light.ambient = false;
            matched = true;
        }
    return matched;
}

bool put_on_materials(SceneDescription& description, const std::string& pattern,
                      const SharedShader& shader) {
    bool matched = false;
    for (MaterialDefinition& material : description.materials) {
        if (!glob_matches(pattern, material.id, material.name)) continue;
        for (const StageRow& row : kStages)
            if (row.kind == shader->kind) replace(material.*row.stack, shader);
        matched = true;
    }
    if (pattern != "*" || shader->kind != ShaderKind::Surface) return matched;
    description.default_surface = shader;
    return true;
}

// Sets the scene's own stack and empties those of its cameras, which would win. "none": empties
// all.
bool override_picture(SceneDescription& description, const ShaderGiven& given, ShaderKind kind,
                      std::vector<ShaderUse> PictureShaders::*stack, Diagnostics& diagnostics) {
    SharedShader shader;
    if (given.shader != "none") {
        shader = find_given(description, given, {kind}, diagnostics);
        if (!shader) return false;
    }
    for (CameraDefinition& camera : description.cameras) (camera.picture.*stack).clear();
    (description.picture.*stack).clear();
    if (shader) (description.picture.*stack).push_back({shader, {}});
    return true;
}

}  // namespace

bool names_shader_file(std::string_view shader) {
    return shader.find_first_of("./") != shader.npos;
}

std::shared_ptr<const rsl::Shader> named_shader(const std::string& name, Diagnostics& diagnostics) {
    SharedShader shader = library_shader(name);
    if (shader) return shader;
    std::string_view near = nearest_name(name, library_shader_names());
    diagnostics.report(Code::SHADER_UNKNOWN, Location{}, name).help =
        near.empty() ? "kinora-render SCENE --list shaders shows the names of ours; a file's "
                       "name ends in .sl"
                     : fmt::format("did you mean '{}'?", near);
    return nullptr;
}

bool override_shader(SceneDescription& description, const std::string& pattern,
                     const ShaderGiven& given, Diagnostics& diagnostics) {
    SharedShader shader =
        find_given(description, given,
                   {ShaderKind::Surface, ShaderKind::Displacement, ShaderKind::Transformation,
                    ShaderKind::Volume, ShaderKind::Light},
                   diagnostics);
    if (!shader) return false;
    if (shader->kind == ShaderKind::Light && put_on_lights(description, pattern, shader))
        return true;
    if (put_on_materials(description, pattern, shader)) return true;
    diagnostics.report(Code::MATERIAL_UNKNOWN, Location{}, pattern);
    return false;
}

bool override_atmosphere(SceneDescription& description, const ShaderGiven& given,
                         Diagnostics& diagnostics) {
    if (!override_picture(description, given, ShaderKind::Volume, &PictureShaders::atmosphere,
                          diagnostics))
        return false;
    for (MaterialDefinition& material : description.materials) material.atmosphere = kNone;
    return true;
}

std::shared_ptr<const rsl::Shader> find_environment_shader(SceneDescription& description,
                                                           const ShaderGiven& given,
                                                           Diagnostics& diagnostics) {
    SharedShader shader = find_given(description, given, {ShaderKind::Light}, diagnostics);
    if (!shader) return nullptr;
    const bool samples = std::ranges::any_of(
        shader->functions, [](const auto* f) { return rsl::is_sample_method(f->name); });
    if (samples) return shader;
    diagnostics.report(Code::ENVIRONMENT_SHADER, Location{}, given.shader);
    return nullptr;
}

bool override_imager(SceneDescription& description, const ShaderGiven& given,
                     Diagnostics& diagnostics) {
    return override_picture(description, given, ShaderKind::Imager, &PictureShaders::imagers,
                            diagnostics);
}

}  // namespace kinora
