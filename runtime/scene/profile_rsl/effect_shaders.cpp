// runtime/scene/profile_rsl/effect_shaders.cpp: from an effect's code to the shader a pass runs.
#include "runtime/scene/profile_rsl/effect_shaders.h"

#include <fmt/format.h>

#include <algorithm>

#include "rsl/text/findings.h"
#include "runtime/base/regular_file.h"
#include "runtime/scene/profile_rsl/findings.h"
#include "runtime/scene/profile_rsl/joined_code.h"

namespace kinora {

namespace {

struct Stage {
    const char* name;
    rsl::ShaderKind kind;
};
constexpr Stage kStages[] = {
    {"SURFACE", rsl::ShaderKind::Surface},
    {"DISPLACEMENT", rsl::ShaderKind::Displacement},
    {"LIGHT", rsl::ShaderKind::Light},
    {"VOLUME", rsl::ShaderKind::Volume},
    {"TRANSFORMATION", rsl::ShaderKind::Transformation},
    {"IMAGER", rsl::ShaderKind::Imager},
    {"COSHADER", rsl::ShaderKind::Surface},  // of any kind: fits_stage()
};

bool has_kind(const rsl::Shader& shader, rsl::ShaderKind kind) {
    return shader.kind == kind || (kind == rsl::ShaderKind::Displacement && shader.displacement);
}

// A co-shader may be any shader, by its name; without one it is what nothing else can be.
bool fits_stage(const rsl::Shader& shader, const collada::RslShader& from) {
    if (from.stage != collada::RslStage::CoShader)
        return has_kind(shader, stage_kind(from.stage)) && !shader.definition->co_shader;
    return !from.name.empty() || shader.definition->co_shader;
}

const char* word_for(collada::RslStage stage) {
    return stage == collada::RslStage::CoShader ? "co-shader"
                                                : rsl::shader_kind_name(stage_kind(stage));
}

bool fits(const rsl::Type& type, size_t count) {
    size_t needed = size_t(rsl::component_count(type.base)) *
                    size_t(type.is_array() ? std::max(type.array_length, 1) : 1);
    return count == needed || (rsl::is_triple(type) && (count == 1 || count == 4));
}

}  // namespace

const char* stage_name(collada::RslStage stage) {
    return kStages[size_t(stage)].name;
}

rsl::ShaderKind stage_kind(collada::RslStage stage) {
    return kStages[size_t(stage)].kind;
}

std::shared_ptr<const rsl::Shader> as_kind(std::shared_ptr<const rsl::Shader> shader,
                                           rsl::ShaderKind kind) {
    if (!shader || shader->kind == kind) return shader;
    return kind == rsl::ShaderKind::Displacement ? shader->displacement : nullptr;
}

EffectShaders compile_effect(const collada::Effect& effect, const rsl::CompileOptions& options,
                             Diagnostics& diagnostics) {
    rsl::ShaderSource source;
    std::string text = joined_code(*effect.rsl, source.map);
    source.text = text;
    EffectShaders shaders;
    for (auto& shader : rsl::compile(source, options, diagnostics))
        shaders.push_back(std::move(shader));
    return shaders;
}

std::shared_ptr<const rsl::Shader> choose_shader(const EffectShaders& shaders,
                                                 const collada::RslShader& from,
                                                 Diagnostics& diagnostics) {
    std::shared_ptr<const rsl::Shader> chosen;
    int candidates = 0;
    for (const auto& shader : shaders) {
        if (!fits_stage(*shader, from)) continue;
        if (!from.name.empty() && shader->name != from.name) continue;
        chosen = shader;
        ++candidates;
    }
    bool co_shader = from.stage == collada::RslStage::CoShader;
    if (candidates == 1) return co_shader ? chosen : as_kind(chosen, stage_kind(from.stage));
    if (candidates > 1)
        diagnostics.report(Code::RSL_SHADER_AMBIGUOUS, from.where, word_for(from.stage));
    else
        diagnostics.report(Code::RSL_SHADER_MISSING, from.where, word_for(from.stage),
                           from.name.empty() ? "" : fmt::format(" named '{}'", from.name));
    return nullptr;
}

const rsl::ShaderParameter* find_parameter(const rsl::Shader& shader, std::string_view name) {
    for (const rsl::ShaderParameter& parameter : shader.parameters)
        if (parameter.name == name) return &parameter;
    return nullptr;
}

const rsl::ShaderParameter* bound_parameter(const rsl::Shader& shader, const collada::RslBind& bind,
                                            Diagnostics& diagnostics) {
    if (const rsl::ShaderParameter* parameter = find_parameter(shader, bind.symbol))
        return parameter;
    std::vector<std::string_view> names;
    for (const rsl::ShaderParameter& p : shader.parameters) names.push_back(p.name);
    Finding& finding =
        diagnostics.report(Code::RSL_BIND_UNKNOWN, bind.where, shader.name, bind.symbol);
    if (std::string_view near = nearest_name(bind.symbol, names); !near.empty())
        finding.help = fmt::format("did you mean '{}'?", near);
    return nullptr;
}

std::string_view volume_side(const collada::Material& material, size_t nth) {
    constexpr std::string_view kSpace = " \t\r\n";
    std::string_view rest = material.volume_target, side;
    for (size_t k = 0; k <= nth; ++k) {
        size_t begin = rest.find_first_not_of(kSpace);
        if (begin == rest.npos) break;
        size_t end = std::min(rest.find_first_of(kSpace, begin), rest.size());
        side = rest.substr(begin, end - begin);
        rest.remove_prefix(end);
    }
    return side;
}

bool takes(const rsl::ShaderParameter& parameter, const collada::ParamValue& value) {
    bool is_string = parameter.type.base == rsl::BaseType::String;
    if (is_string || value.type == collada::ParamType::String)
        return is_string && value.type == collada::ParamType::String;
    return fits(parameter.type, value.numbers.size());
}

void check_named_files(const collada::ParamValue& value, const AllowedPaths& files, Location where,
                       Diagnostics& diagnostics) {
    if (value.image != collada::kNone) return;
    for (const std::string& text : value.strings)  // many are no names of files at all
        if (files.find(text).outside && is_regular_file(text))
            diagnostics.report(rsl::Code::RSL_FILE_OUTSIDE, where, text);
}

std::string value_text(const collada::ParamValue& value) {
    if (value.type == collada::ParamType::String) return "a string";
    return fmt::format("{} of {} number(s)", collada::param_type_name(value.type),
                       value.numbers.size());
}

}  // namespace kinora
