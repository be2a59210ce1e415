// runtime/scene/profile_rsl/effect_linker.h: the shaders of passes, linked with their co-shaders.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "collada/scene/scene.h"
#include "rsl/link.h"
#include "runtime/scene/profile_rsl/effect_shaders.h"

namespace kinora {

// A <shader> of a pass as a material has it.
struct BoundShader {
    const collada::RslShader* from = nullptr;
    uint32_t effect = collada::kNone;
    uint32_t material = collada::kNone;  // kNone: with the values of its effect
};

// What a <bind> gives: the material's <setparam>, else the effect's <newparam>, or a literal.
const collada::ParamValue& bound_value(const collada::SceneData& scene, const BoundShader& shader,
                                       const collada::RslBind& bind);

// Compiles each effect once, and each shader with its co-shaders once for all materials that bind
// the same handles. The scene, the options and the sink outlive it.
class EffectLinker {
  public:
    EffectLinker(const collada::SceneData& scene, rsl::CompileOptions options,
                 Diagnostics& diagnostics);

    // The shaders of an effect with profile_RSL, none of them linked; none after an error.
    const EffectShaders& shaders(uint32_t effect);

    // The one that <shader> names, by itself: its parameters are those that a <bind> can name.
    std::shared_ptr<const rsl::Shader> chosen(const BoundShader& shader);

    // The same, linked with its co-shaders where it uses them. Their parameters are
    // "handle.name". Null after an error.
    std::shared_ptr<const rsl::Shader> linked(const BoundShader& shader);

    // Those that it can find by their handles: of its pass, then of the scene's library. None for a
    // shader that speaks of no other.
    std::vector<BoundShader> co_shaders(const BoundShader& shader);
    // Of these, all that a handle can name, whether or not the shader does.
    std::vector<BoundShader> in_scope(const BoundShader& shader) const;

    // COSHADERs of the effects that the visual scene's <extra> names.
    const std::vector<BoundShader>& library() const { return library_; }

  private:
    struct EffectCode {
        std::string text;
        SourceMap map;
        EffectShaders shaders;
    };
    void list_library();
    bool has_co_shaders(const collada::Effect& effect) const;
    EffectCode& code(uint32_t effect);
    rsl::LinkTexts texts(const BoundShader& shader) const;
    rsl::LinkCounts counts(const BoundShader& shader) const;
    std::shared_ptr<const rsl::Shader> with_lengths(
        const BoundShader& shader, const std::shared_ptr<const rsl::Shader>& alone);
    rsl::LinkedSource source(const BoundShader& shader, const std::string& handle);

    const collada::SceneData& scene_;
    rsl::CompileOptions options_;
    Diagnostics& diagnostics_;
    std::vector<BoundShader> library_;
    std::map<uint32_t, EffectCode> codes_;  // by effect
    std::map<const collada::RslShader*, std::shared_ptr<const rsl::Shader>> chosen_;
    std::map<std::string, std::shared_ptr<const rsl::Shader>> lengths_;  // by what decides it
    std::map<std::string, std::shared_ptr<const rsl::Shader>> linked_;   // by what decides it
};

}  // namespace kinora
