// runtime/scene/profile_rsl/effect_linker.cpp: which co-shaders a shader sees, and what they make
// together.
#include "runtime/scene/profile_rsl/effect_linker.h"

#include <fmt/format.h>

#include <algorithm>

#include "collada/document/findings.h"
#include "runtime/scene/profile_rsl/findings.h"
#include "runtime/scene/profile_rsl/joined_code.h"

namespace kinora {

using collada::kNone;
using collada::RslStage;

const collada::ParamValue& bound_value(const collada::SceneData& scene, const BoundShader& shader,
                                       const collada::RslBind& bind) {
    if (bind.param == kNone) return bind.literal;
    if (shader.material != kNone)
        for (const collada::SetParam& set : scene.materials[shader.material].setparams)
            if (set.param == bind.param) return set.value;
    return scene.effects[shader.effect].params[bind.param].value;
}

EffectLinker::EffectLinker(const collada::SceneData& scene, rsl::CompileOptions options,
                           Diagnostics& diagnostics)
    : scene_(scene), options_(std::move(options)), diagnostics_(diagnostics) {
    list_library();
}

void EffectLinker::list_library() {
    for (uint32_t material : scene_.rsl_materials) {
        uint32_t effect = scene_.materials[material].effect;
        if (effect == kNone || !scene_.effects[effect].rsl) continue;
        for (const collada::RslShader& from : scene_.effects[effect].rsl->shaders) {
            if (from.stage != RslStage::CoShader) continue;
            auto same = std::ranges::find_if(library_, [&](const BoundShader& other) {
                return other.from->handle == from.handle;
            });
            if (same == library_.end())
                library_.push_back({&from, effect, material});
            else
                diagnostics_.report(collada::Code::RSL_HANDLE_TWICE, from.handle_where, from.handle)
                    .notes.push_back({same->from->handle_where, "the first is here"});
        }
    }
}

bool EffectLinker::has_co_shaders(const collada::Effect& effect) const {
    return !library_.empty() ||
           std::ranges::any_of(effect.rsl->shaders, [](const collada::RslShader& from) {
               return from.stage == RslStage::CoShader;
           });
}

// Where there are co-shaders, linking reports what the code does wrong: by itself it lacks them.
EffectLinker::EffectCode& EffectLinker::code(uint32_t index) {
    auto [known, fresh] = codes_.try_emplace(index);
    EffectCode& code = known->second;
    const collada::Effect& effect = scene_.effects[index];
    if (!fresh || !effect.rsl || effect.rsl->codes.empty()) return code;
    code.text = joined_code(*effect.rsl, code.map);
    if (has_co_shaders(effect)) {
        Diagnostics alone;
        alone.files = diagnostics_.files;
        code.shaders = compile_effect(effect, options_, alone);
        bool linkable = std::ranges::any_of(
            code.shaders, [](const auto& shader) { return rsl::knows_co_shaders(*shader); });
        if (linkable) return code;
    }
    code.shaders = compile_effect(effect, options_, diagnostics_);
    return code;
}

const EffectShaders& EffectLinker::shaders(uint32_t effect) {
    return code(effect).shaders;
}

std::shared_ptr<const rsl::Shader> EffectLinker::chosen(const BoundShader& shader) {
    auto [known, fresh] = chosen_.try_emplace(shader.from);
    if (fresh && !shaders(shader.effect).empty())
        known->second = choose_shader(shaders(shader.effect), *shader.from, diagnostics_);
    return known->second ? with_lengths(shader, known->second) : nullptr;
}

// The shader compiled for arrays as long as what is bound.
std::shared_ptr<const rsl::Shader> EffectLinker::with_lengths(
    const BoundShader& shader, const std::shared_ptr<const rsl::Shader>& alone) {
    if (alone->definition->open_arrays.empty()) return alone;
    rsl::LinkCounts bound = counts(shader);
    if (!rsl::other_lengths(*alone, bound)) return alone;
    std::string key = fmt::format("{}", static_cast<const void*>(shader.from));
    for (const auto& [symbol, count] : bound) key += fmt::format("\n{}={}", symbol, count);
    auto [known, fresh] = lengths_.try_emplace(key);
    if (!fresh) return known->second;
    const EffectCode& own = code(shader.effect);
    size_t before = diagnostics_.findings().size();
    known->second =
        as_kind(rsl::compile_linked({{"", {own.text, own.map}, alone->name, texts(shader), bound}},
                                    options_, diagnostics_),
                alone->kind);
    diagnostics_.drop_repeats(before);
    return known->second;
}

std::vector<BoundShader> EffectLinker::in_scope(const BoundShader& shader) const {
    std::vector<BoundShader> found;
    for (const collada::RslShader& from : scene_.effects[shader.effect].rsl->shaders)
        if (from.stage == RslStage::CoShader && from.pass == shader.from->pass)
            found.push_back({&from, shader.effect, shader.material});
    size_t own = found.size();
    for (const BoundShader& other : library_) {
        bool hidden =
            std::any_of(found.begin(), found.begin() + ptrdiff_t(own),
                        [&](const BoundShader& b) { return b.from->handle == other.from->handle; });
        if (!hidden) found.push_back(other);
    }
    return found;
}

rsl::LinkTexts EffectLinker::texts(const BoundShader& shader) const {
    rsl::LinkTexts texts;
    for (const collada::RslBind& bind : shader.from->binds) {
        const collada::ParamValue& value = bound_value(scene_, shader, bind);
        if (value.type != collada::ParamType::String || value.image != kNone) continue;
        texts[bind.symbol] = value.strings;
    }
    return texts;
}

rsl::LinkCounts EffectLinker::counts(const BoundShader& shader) const {
    rsl::LinkCounts counts;
    for (const collada::RslBind& bind : shader.from->binds) {
        const collada::ParamValue& value = bound_value(scene_, shader, bind);
        bool text = value.type == collada::ParamType::String;
        counts[bind.symbol] = text ? value.strings.size() : value.numbers.size();
    }
    return counts;
}

// Only those that can be meant: a library may be large.
std::vector<BoundShader> EffectLinker::co_shaders(const BoundShader& shader) {
    std::vector<BoundShader> scope = in_scope(shader), open{shader};
    std::vector<bool> meant(scope.size());
    while (!open.empty()) {
        BoundShader caller = open.back();
        open.pop_back();
        auto code = chosen(caller);
        if (!code || !rsl::knows_co_shaders(*code)) continue;
        std::vector<std::string> bound;
        for (const auto& [symbol, strings] : texts(caller)) {
            std::vector<std::string> handles = rsl::handles_in(strings);
            bound.insert(bound.end(), handles.begin(), handles.end());
        }
        for (size_t k = 0; k < scope.size(); ++k) {
            const std::string& handle = scope[k].from->handle;
            bool named = rsl::may_mean(*code, handle) || std::ranges::count(bound, handle);
            if (meant[k] || !named || !chosen(scope[k])) continue;
            meant[k] = true;
            open.push_back(scope[k]);
        }
    }
    std::vector<BoundShader> found;
    for (size_t k = 0; k < scope.size(); ++k)
        if (meant[k]) found.push_back(scope[k]);
    return found;
}

rsl::LinkedSource EffectLinker::source(const BoundShader& shader, const std::string& handle) {
    const EffectCode& own = code(shader.effect);
    rsl::LinkTexts bound = texts(shader);
    auto alone = chosen(shader);
    for (auto& [symbol, strings] : bound)
        if (rsl::find_handle_parameter(*alone, symbol)) strings = rsl::handles_in(strings);
    return {handle, {own.text, own.map}, alone->name, std::move(bound), counts(shader)};
}

std::shared_ptr<const rsl::Shader> EffectLinker::linked(const BoundShader& shader) {
    auto alone = chosen(shader);
    if (!alone || !has_co_shaders(scene_.effects[shader.effect]) || !rsl::knows_co_shaders(*alone))
        return alone;
    std::vector<rsl::LinkedSource> sources{source(shader, "")};
    std::string key = fmt::format("{}", static_cast<const void*>(shader.from));
    for (const BoundShader& other : co_shaders(shader)) {
        sources.push_back(source(other, other.from->handle));
        key += fmt::format("\n{}", static_cast<const void*>(other.from));
    }
    for (const rsl::LinkedSource& one : sources) {
        for (const auto& [symbol, strings] : one.texts)
            key += fmt::format("\n{}.{}={}", one.handle, symbol, fmt::join(strings, "\x1f"));
        for (const auto& [symbol, count] : one.counts)
            key += fmt::format("\n{}.{}:{}", one.handle, symbol, count);
    }
    auto [known, fresh] = linked_.try_emplace(key);
    if (!fresh) return known->second;
    size_t before = diagnostics_.findings().size();
    known->second = as_kind(rsl::compile_linked(sources, options_, diagnostics_), alone->kind);
    diagnostics_.drop_repeats(before);
    return known->second;
}

}  // namespace kinora
