// runtime/programs/convert/rsl_profile_p.h: profile_RSL in the text of an effect.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "collada/document/document.h"
#include "rsl/compile.h"

namespace kinora {

// What --shader names.
struct GivenShaders {
    std::string code;       // included files are in it: they may not be where the document is read
    std::string bare_code;  // after preprocessing: for beside other code, whose macros differ
    std::vector<std::shared_ptr<const rsl::Shader>> shaders;
};

// "SURFACE".
const char* stage_word(rsl::ShaderKind kind);

// <profile_RSL> with these shaders. `params` are its <newparam>s, `binds` those that each shader
// takes where it has the parameter; `old` is an effect whose parameters bind by name, or null.
struct OldParams {
    std::string params;
    std::vector<std::pair<std::string, std::string>> binds;  // symbol, <bind>
};
std::string rsl_profile(std::span<const rsl::Shader* const> shaders, const std::string& code,
                        const OldParams& old);

// What the effect's parameters and its profile_RSL give to shaders.
OldParams old_params(std::string_view text, const collada::Element& effect);

// The effect's bytes with the shaders in place of those of their stages. Other stages stay, with
// the code they need; `includes` is where #include looks. Nothing: the codes contradict each other.
std::optional<std::string> with_shaders(std::string_view text, std::string_view prefix,
                                        const collada::Element& effect, const GivenShaders& given,
                                        std::span<const rsl::Shader* const> shaders,
                                        const std::string& path,
                                        const rsl::CompileOptions& compile);

}  // namespace kinora
