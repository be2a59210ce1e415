// runtime/scene/profile_rsl/effect_shaders.h: the shaders of an effect's profile_RSL, and whether
// its <bind>s fit them. Each function reports what is wrong at its location in the document.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "collada/scene/scene.h"
#include "rsl/compile.h"

namespace kinora {

const char* stage_name(collada::RslStage stage);  // "SURFACE"
rsl::ShaderKind stage_kind(collada::RslStage stage);

// The shader if it is of this kind, or as a displacement where its class has displacement() too;
// else null.
std::shared_ptr<const rsl::Shader> as_kind(std::shared_ptr<const rsl::Shader> shader,
                                           rsl::ShaderKind kind);

using EffectShaders = std::vector<std::shared_ptr<const rsl::Shader>>;

// All shaders of the effect's code (effect.rsl must be there); none if it has errors.
EffectShaders compile_effect(const collada::Effect& effect, const rsl::CompileOptions& options,
                             Diagnostics& diagnostics);

// The one that a <shader> of a pass runs; null if there is none, or no telling which.
std::shared_ptr<const rsl::Shader> choose_shader(const EffectShaders& shaders,
                                                 const collada::RslShader& from,
                                                 Diagnostics& diagnostics);

// Null if the shader has none of that name.
const rsl::ShaderParameter* find_parameter(const rsl::Shader& shader, std::string_view name);

// The parameter a <bind> names; null (with a suggestion) if there is none.
const rsl::ShaderParameter* bound_parameter(const rsl::Shader& shader, const collada::RslBind& bind,
                                            Diagnostics& diagnostics);

// The side of its object that the nth VOLUME shader of an effect fills, as the material says it:
// the nth word of its target, the last for all further ones; "" if it is silent.
std::string_view volume_side(const collada::Material& material, size_t nth);

// Whether the parameter can take the value: strings for strings, numbers where the count fits (its
// own, or one or four for a triple).
bool takes(const rsl::ShaderParameter& parameter, const collada::ParamValue& value);

// Reports texts that name a file outside `files` (RSL_FILE_OUTSIDE); of an <image> the reader has.
void check_named_files(const collada::ParamValue& value, const AllowedPaths& files, Location where,
                       Diagnostics& diagnostics);

std::string value_text(const collada::ParamValue& value);  // "float3 of 3 number(s)"

}  // namespace kinora
