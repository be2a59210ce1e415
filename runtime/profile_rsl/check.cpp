// runtime/profile_rsl/check.cpp: effects, then the materials, lights and instances that use them.
#include "runtime/profile_rsl/check.h"

#include <algorithm>
#include <set>
#include <unordered_map>

#include "rsl/compile.h"
#include "rsl/lower/lower.h"
#include "runtime/profile_rsl/effect_shaders.h"
#include "runtime/profile_rsl/findings.h"

namespace kinora {

namespace {

using collada::kNone;
using collada::RslStage;

// A shader of a pass and what runs for it; `shader` is null where that was reported.
struct PassShader {
    const collada::RslShader* from = nullptr;
    std::shared_ptr<const rsl::Shader> shader;
    std::unordered_map<std::string_view, const rsl::ShaderParameter*> parameters;  // of shader
    std::unordered_multimap<uint32_t, const collada::RslBind*> binds;  // by the effect's parameter

    PassShader(const collada::RslShader& pass, std::shared_ptr<const rsl::Shader> chosen)
        : from(&pass), shader(std::move(chosen)) {
        if (!shader) return;
        for (const rsl::ShaderParameter& p : shader->parameters) parameters.try_emplace(p.name, &p);
        for (const collada::RslBind& bind : from->binds)
            if (bind.param != kNone) binds.emplace(bind.param, &bind);
    }
    const rsl::ShaderParameter* parameter(std::string_view name) const {
        auto found = parameters.find(name);
        return found == parameters.end() ? nullptr : found->second;
    }
};

struct CheckedEffect {
    bool has_rsl = false;
    bool compiled = false;
    std::vector<PassShader> passes;
};

class Check {
  public:
    Check(const collada::SceneData& scene, const rsl::CompileOptions& options,
          Diagnostics& diagnostics)
        : scene_(scene), diagnostics_(diagnostics), compile_options_(options) {
        for (const collada::Node& node : scene.nodes)
            if (!node.id.empty()) spaces_.push_back(node.id);
    }

    void run() {
        for (const collada::Effect& effect : scene_.effects) effects_.push_back(checked(effect));
        for (const collada::Material& material : scene_.materials) check_setparams(material);
        for (const collada::Light& light : scene_.lights)
            check_user(light.rsl_material, "a light", {RslStage::Light});
        check_pictures(scene_.rsl_materials);
        for (const collada::Camera& camera : scene_.cameras) check_pictures(camera.rsl_materials);
        for (const collada::Node& node : scene_.nodes)
            for (const collada::MeshInstance& mesh : node.meshes)
                for (const collada::MaterialBinding& binding : mesh.materials)
                    check_binding(binding);
    }

  private:
    CheckedEffect checked(const collada::Effect& effect) {
        CheckedEffect result;
        if (!effect.rsl) return result;
        result.has_rsl = true;
        if (effect.rsl->codes.empty()) return result;  // reported
        EffectShaders shaders = compile_effect(effect, compile_options_, diagnostics_);
        if (shaders.empty()) return result;
        result.compiled = true;
        for (const collada::RslShader& from : effect.rsl->shaders) {
            PassShader pass(from, choose_shader(shaders, from, diagnostics_));
            if (pass.shader) check_binds(effect, pass);
            result.passes.push_back(std::move(pass));
        }
        for (const auto& shader : shaders) check_shader(effect, *shader, result);
        check_unused_params(effect);
        return result;
    }

    // Lowering finds what only it knows: unknown spaces, arrays too large.
    void check_shader(const collada::Effect& effect, const rsl::Shader& shader,
                      const CheckedEffect& checked) {
        bool runs = std::any_of(checked.passes.begin(), checked.passes.end(),
                                [&](const PassShader& p) { return p.shader.get() == &shader; });
        if (!runs && !effect.rsl->shaders.empty())
            diagnostics_.report(Code::RSL_SHADER_UNUSED, effect.rsl->where,
                                rsl::shader_kind_name(shader.kind), shader.name);
        rsl::Layer layer{&shader, {}};
        rsl::LowerOptions options;
        options.spaces = &spaces_;
        if (runs) rsl::lower({&layer, 1}, options, diagnostics_);
    }

    void check_binds(const collada::Effect& effect, const PassShader& pass) {
        std::set<std::string_view> seen;
        for (const collada::RslBind& bind : pass.from->binds) {
            if (!seen.insert(bind.symbol).second)
                diagnostics_.report(Code::RSL_BIND_TWICE, bind.where, bind.symbol);
            const rsl::ShaderParameter* parameter = pass.parameter(bind.symbol);
            if (!parameter) {
                bound_parameter(*pass.shader, bind, diagnostics_);
                continue;
            }
            const collada::ParamValue& value =
                bind.param == kNone ? bind.literal : effect.params[bind.param].value;
            if (!takes(*parameter, value))
                diagnostics_.report(Code::RSL_BIND_TYPE, bind.where, bind.symbol,
                                    rsl::type_name(parameter->type), value_text(value));
            check_named_files(value, compile_options_.pictures, bind.where, diagnostics_);
        }
    }

    void check_unused_params(const collada::Effect& effect) {
        std::vector<bool> bound(effect.params.size());
        for (const collada::RslShader& shader : effect.rsl->shaders)
            for (const collada::RslBind& bind : shader.binds)
                if (bind.param != kNone) bound[bind.param] = true;
        for (size_t p = 0; p < effect.params.size(); ++p) {
            const collada::Param& param = effect.params[p];
            bool own = param.scope == collada::ParamScope::ProfileRsl ||
                       (param.scope == collada::ParamScope::Technique && !effect.common);
            if (own && !bound[p])
                diagnostics_.report(Code::RSL_PARAM_UNUSED, param.where, effect.id, param.sid);
        }
    }

    const CheckedEffect* effect_of(uint32_t material) const {
        if (material == kNone) return nullptr;
        uint32_t effect = scene_.materials[material].effect;
        return effect == kNone || !effects_[effect].has_rsl ? nullptr : &effects_[effect];
    }

    void check_setparams(const collada::Material& material) {
        if (material.effect == kNone) return;
        for (const PassShader& pass : effects_[material.effect].passes)
            for (const collada::SetParam& set : material.setparams)
                if (set.param != kNone) {
                    auto [first, last] = pass.binds.equal_range(set.param);
                    for (; first != last; ++first) check_setparam(set, *first->second, pass);
                }
    }

    void check_setparam(const collada::SetParam& set, const collada::RslBind& bind,
                        const PassShader& pass) {
        const rsl::ShaderParameter* parameter = pass.parameter(bind.symbol);
        if (parameter && !takes(*parameter, set.value))
            diagnostics_.report(Code::RSL_SETPARAM_TYPE, set.where, set.ref, bind.symbol,
                                pass.shader->name, rsl::type_name(parameter->type),
                                value_text(set.value));
    }

    // What uses the material gives only some stages a meaning: one of them must be there.
    void check_user(uint32_t material, const char* user, std::vector<RslStage> wanted) {
        const CheckedEffect* effect = effect_of(material);
        if (!effect || !effect->compiled) return;
        bool found = false;
        for (const PassShader& pass : effect->passes) {
            bool fits = std::find(wanted.begin(), wanted.end(), pass.from->stage) != wanted.end();
            if (!fits)
                diagnostics_.report(Code::RSL_STAGE_PLACE, pass.from->where,
                                    stage_name(pass.from->stage), user);
            found = found || fits;
        }
        if (!found)
            diagnostics_.report(Code::RSL_STAGE_NONE, scene_.materials[material].where,
                                scene_.effects[scene_.materials[material].effect].id,
                                stage_name(wanted.front()), user);
    }

    void check_pictures(const std::vector<uint32_t>& materials) {
        for (uint32_t m : materials)
            check_user(m, "a scene or camera", {RslStage::Volume, RslStage::Imager});
    }

    void check_binding(const collada::MaterialBinding& binding) {
        const CheckedEffect* effect = effect_of(binding.material);
        if (!effect || !effect->compiled) return;
        const collada::Material& material = scene_.materials[binding.material];
        size_t volumes = 0;
        for (const PassShader& pass : effect->passes)
            check_surface_stage(*pass.from, material, volumes);
        auto some_has = [&](const std::string& name) {
            return std::any_of(effect->passes.begin(), effect->passes.end(),
                               [&](const PassShader& p) { return p.parameter(name) != nullptr; });
        };
        for (const collada::ParamBinding& param : binding.params)
            if (!some_has(param.semantic))
                diagnostics_.report(Code::RSL_SEMANTIC_UNKNOWN, param.where, material.id,
                                    param.semantic);
        for (const collada::VertexInputBinding& input : binding.vertex_inputs)
            if (!some_has(input.semantic))
                diagnostics_.report(Code::RSL_VERTEX_INPUT_UNKNOWN, input.where, material.id,
                                    input.semantic);
    }

    void check_surface_stage(const collada::RslShader& shader, const collada::Material& material,
                             size_t& volumes) {
        if (shader.stage == RslStage::Imager)
            diagnostics_.report(Code::RSL_STAGE_PLACE, shader.where, "IMAGER", "a surface");
        if (shader.stage != RslStage::Volume) return;
        std::string_view target = volume_side(material, volumes++);
        if (!target.empty() && target != "exterior" && target != "interior")
            diagnostics_.report(Code::RSL_VOLUME_TARGET, shader.where, target);
    }

    const collada::SceneData& scene_;
    Diagnostics& diagnostics_;
    rsl::CompileOptions compile_options_;
    std::vector<std::string> spaces_;
    std::vector<CheckedEffect> effects_;  // as scene_.effects
};

}  // namespace

void check_profile_rsl(const collada::SceneData& scene, const rsl::CompileOptions& options,
                       Diagnostics& diagnostics) {
    bool any = std::any_of(scene.effects.begin(), scene.effects.end(),
                           [](const collada::Effect& effect) { return effect.rsl.has_value(); });
    if (any) Check(scene, options, diagnostics).run();
}

}  // namespace kinora
