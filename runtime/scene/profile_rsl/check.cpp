// runtime/scene/profile_rsl/check.cpp: effects, then the materials, lights and instances that use
// them.
#include "runtime/scene/profile_rsl/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <unordered_map>

#include "rsl/compile.h"
#include "rsl/link.h"
#include "rsl/lower/lower.h"
#include "runtime/scene/profile_rsl/effect_linker.h"
#include "runtime/scene/profile_rsl/findings.h"

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
        : scene_(scene),
          diagnostics_(diagnostics),
          compile_options_(options),
          linker_(scene, options, diagnostics) {
        for (const collada::Node& node : scene.nodes)
            if (!node.id.empty()) spaces_.push_back(node.id);
    }

    void run() {
        for (uint32_t e = 0; e < scene_.effects.size(); ++e) effects_.push_back(checked(e));
        for (uint32_t e = 0; e < scene_.effects.size(); ++e) check_linked(e);
        for (const collada::Material& material : scene_.materials) check_setparams(material);
        for (const collada::Light& light : scene_.lights)
            check_user(light.rsl_material, "a light", {RslStage::Light});
        check_pictures(scene_.rsl_materials, true);
        for (const collada::Camera& camera : scene_.cameras)
            check_pictures(camera.rsl_materials, false);
        for (const collada::Node& node : scene_.nodes)
            for (const collada::MeshInstance& mesh : node.meshes)
                for (const collada::MaterialBinding& binding : mesh.materials)
                    check_binding(binding);
    }

  private:
    CheckedEffect checked(uint32_t index) {
        const collada::Effect& effect = scene_.effects[index];
        CheckedEffect result;
        if (!effect.rsl) return result;
        result.has_rsl = true;
        if (effect.rsl->codes.empty()) return result;  // reported
        const EffectShaders& shaders = linker_.shaders(index);
        if (shaders.empty()) return result;
        result.compiled = true;
        for (const collada::RslShader& from : effect.rsl->shaders) {
            PassShader pass(from, linker_.chosen({&from, index}));
            if (pass.shader) check_binds(index, pass);
            result.passes.push_back(std::move(pass));
        }
        for (const auto& shader : shaders) check_shader(effect, *shader, result);
        check_unused_params(effect);
        return result;
    }

    void check_shader(const collada::Effect& effect, const rsl::Shader& shader,
                      const CheckedEffect& checked) {
        bool runs = std::any_of(
            checked.passes.begin(), checked.passes.end(),
            [&](const PassShader& p) { return p.shader && p.shader->name == shader.name; });
        if (!runs && !effect.rsl->shaders.empty())
            diagnostics_.report(Code::RSL_SHADER_UNUSED, effect.rsl->where,
                                rsl::shader_kind_name(shader.kind), shader.name);
    }

    // With the values of each material that has the effect, or its own if none has.
    void check_linked(uint32_t effect) {
        std::vector<uint32_t> materials;
        for (uint32_t m = 0; m < scene_.materials.size(); ++m)
            if (scene_.materials[m].effect == effect) materials.push_back(m);
        if (materials.empty()) materials.push_back(kNone);
        std::set<const collada::RslShader*> used;
        for (const PassShader& pass : effects_[effect].passes)
            for (uint32_t material : pass.shader ? materials : std::vector<uint32_t>()) {
                BoundShader bound{pass.from, effect, material};
                auto linked = linker_.linked(bound);
                for (const BoundShader& other : linker_.co_shaders(bound)) used.insert(other.from);
                if (linked && pass.from->stage != RslStage::CoShader) check_lowered(*linked);
            }
        bool in_library = std::ranges::any_of(
            linker_.library(), [&](const BoundShader& shader) { return shader.effect == effect; });
        for (const PassShader& pass : effects_[effect].passes)
            if (pass.from->stage == RslStage::CoShader && !in_library && !used.contains(pass.from))
                diagnostics_.report(Code::RSL_COSHADER_UNUSED, pass.from->handle_where,
                                    pass.from->handle);
    }

    // Lowering finds what only it knows: unknown spaces, arrays too large.
    void check_lowered(const rsl::Shader& shader) {
        if (!lowered_.insert(&shader).second) return;
        rsl::Layer layer{&shader, {}};
        rsl::LowerOptions options;
        options.spaces = &spaces_;
        size_t before = diagnostics_.findings().size();
        rsl::lower({&layer, 1}, options, diagnostics_);
        diagnostics_.drop_repeats(before);
    }

    // Texts that name no co-shader, and other values, do not fit a parameter of type shader.
    void check_handles(const rsl::Symbol& parameter, const BoundShader& shader,
                       const collada::ParamValue& value, Location where) {
        if (value.type != collada::ParamType::String) {
            std::string type = parameter.type.is_array() ? "shader[]" : "shader";
            diagnostics_.report(Code::RSL_BIND_TYPE, where, parameter.name, type,
                                value_text(value));
            return;
        }
        std::vector<std::string_view> known;
        for (const BoundShader& other : linker_.in_scope(shader))
            known.push_back(other.from->handle);
        for (const std::string& handle : rsl::handles_in(value.strings)) {
            if (std::ranges::count(known, handle)) continue;
            std::string_view near = nearest_name(handle, known);
            diagnostics_.report(Code::RSL_HANDLE_UNBOUND, where, handle, parameter.name).help =
                !near.empty()   ? fmt::format("did you mean '{}'?", near)
                : known.empty() ? "write a <shader stage=\"COSHADER\"> with this handle in the pass"
                                : fmt::format("there are {}", fmt::join(known, ", "));
        }
    }

    void check_binds(uint32_t index, const PassShader& pass) {
        std::set<std::string_view> seen;
        BoundShader shader{pass.from, index};
        for (const collada::RslBind& bind : pass.from->binds) {
            if (!seen.insert(bind.symbol).second)
                diagnostics_.report(Code::RSL_BIND_TWICE, bind.where, bind.symbol);
            const collada::ParamValue& value = bound_value(scene_, shader, bind);
            if (const rsl::Symbol* handle = rsl::find_handle_parameter(*pass.shader, bind.symbol)) {
                check_handles(*handle, shader, value, bind.where);
                continue;
            }
            const rsl::ShaderParameter* parameter = pass.parameter(bind.symbol);
            if (!parameter) {
                bound_parameter(*pass.shader, bind, diagnostics_);
                continue;
            }
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
                    for (; first != last; ++first)
                        check_setparam(set, *first->second, pass, material.effect);
                }
    }

    void check_setparam(const collada::SetParam& set, const collada::RslBind& bind,
                        const PassShader& pass, uint32_t effect) {
        if (!pass.shader) return;
        if (const rsl::Symbol* handle = rsl::find_handle_parameter(*pass.shader, bind.symbol))
            return check_handles(*handle, {pass.from, effect}, set.value, set.where);
        const rsl::ShaderParameter* parameter = pass.parameter(bind.symbol);
        if (parameter && !takes(*parameter, set.value))
            diagnostics_.report(Code::RSL_SETPARAM_TYPE, set.where, set.ref, bind.symbol,
                                pass.shader->name, rsl::type_name(parameter->type),
                                value_text(set.value));
    }

    // What uses the material gives only some stages a meaning: one of them must be there.
    void check_user(uint32_t material, const char* user, std::vector<RslStage> wanted,
                    bool takes_library = false) {
        const CheckedEffect* effect = effect_of(material);
        if (!effect || !effect->compiled) return;
        bool found = false;
        for (const PassShader& pass : effect->passes) {
            if (pass.from->stage == RslStage::CoShader) {
                found = found || takes_library;
                continue;
            }
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

    void check_pictures(const std::vector<uint32_t>& materials, bool of_scene) {
        for (uint32_t m : materials)
            check_user(m, "a scene or camera", {RslStage::Volume, RslStage::Imager}, of_scene);
    }

    void check_binding(const collada::MaterialBinding& binding) {
        const CheckedEffect* effect = effect_of(binding.material);
        if (!effect || !effect->compiled) return;
        const collada::Material& material = scene_.materials[binding.material];
        size_t volumes = 0;
        for (const PassShader& pass : effect->passes)
            check_surface_stage(*pass.from, material, volumes);
        auto some_has = [&](const std::string& name) {
            return std::ranges::any_of(effect->passes, [&](const PassShader& p) {
                auto linked = linker_.linked({p.from, material.effect, binding.material});
                return p.parameter(name) || (linked && find_parameter(*linked, name));
            });
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
    EffectLinker linker_;
    std::vector<CheckedEffect> effects_;  // as scene_.effects
    std::set<const rsl::Shader*> lowered_;
};

}  // namespace

void check_profile_rsl(const collada::SceneData& scene, const rsl::CompileOptions& options,
                       Diagnostics& diagnostics) {
    bool any = std::any_of(scene.effects.begin(), scene.effects.end(),
                           [](const collada::Effect& effect) { return effect.rsl.has_value(); });
    if (any) Check(scene, options, diagnostics).run();
}

}  // namespace kinora
