// runtime/scene/ri/state/shader_linker.cpp: which co-shaders a shader can mean, and what they make
// together.
#include "runtime/scene/ri/state/shader_linker.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/matrix.hpp>

namespace kinora::ri {
namespace {

rsl::LinkTexts texts_of(const ShaderBinding& binding) {
    rsl::LinkTexts texts;
    for (const ShaderArgument& argument : binding.arguments)
        if (argument.type == Type::String)
            texts[argument.name] = rsl::find_handle_parameter(*binding.shader, argument.name)
                                       ? rsl::handles_in(argument.strings)
                                       : argument.strings;
    return texts;
}

// Of parameters whose length they decide.
rsl::LinkCounts counts_of(const ShaderBinding& binding) {
    rsl::LinkCounts counts;
    for (const ShaderArgument& argument : binding.arguments)
        for (const rsl::Symbol* open : binding.shader->definition->open_arrays)
            if (open->name == argument.name)
                counts[argument.name] = std::max(argument.numbers.size(), argument.strings.size());
    return counts;
}

bool means(const ShaderBinding& caller, const std::string& handle) {
    if (!rsl::knows_co_shaders(*caller.shader)) return false;
    if (rsl::may_mean(*caller.shader, handle)) return true;
    return std::ranges::any_of(caller.arguments, [&](const ShaderArgument& argument) {
        return std::ranges::count(rsl::handles_in(argument.strings), handle) > 0;
    });
}

// Those that the shader can come to, in their order.
std::vector<CoShader> meant_by(const ShaderBinding& binding, std::span<const CoShader> all) {
    std::vector<const ShaderBinding*> callers{&binding};
    std::vector<bool> meant(all.size());
    while (!callers.empty()) {
        const ShaderBinding& caller = *callers.back();
        callers.pop_back();
        for (size_t k = 0; k < all.size(); ++k) {
            if (meant[k] || !means(caller, all[k].handle)) continue;
            meant[k] = true;
            callers.push_back(all[k].shader.get());
        }
    }
    std::vector<CoShader> found;
    for (size_t k = 0; k < all.size(); ++k)
        if (meant[k]) found.push_back(all[k]);
    return found;
}

// Triples of numbers of a type by a matrix from their space to another.
void transform(ShaderArgument& argument, const dmat4& m) {
    const bool point = argument.type == Type::Point, normal = argument.type == Type::Normal;
    if (!point && !normal && argument.type != Type::Vector) return;
    const dmat3 turned = normal ? glm::transpose(glm::inverse(dmat3(m))) : dmat3(m);
    for (size_t at = 0; at + 2 < argument.numbers.size(); at += 3) {
        double* n = &argument.numbers[at];
        dvec3 moved = turned * dvec3(n[0], n[1], n[2]);
        if (point) moved += dvec3(m[3]);
        for (int k = 0; k < 3; ++k) n[k] = moved[k];
    }
}

void adopt(ShaderBinding& binding, const CoShader& co_shader) {
    const dmat4 moved = glm::inverse(binding.to_camera) * co_shader.shader->to_camera;
    const bool same = binding.to_camera == co_shader.shader->to_camera;
    for (ShaderArgument argument : co_shader.shader->arguments) {
        argument.name = co_shader.handle + '.' + argument.name;
        if (!same) transform(argument, moved);
        binding.arguments.push_back(std::move(argument));
    }
}

}  // namespace

rsl::LinkedSource ShaderLinker::source(const ShaderBinding& binding,
                                       const std::string& handle) const {
    return {handle, search_.source_of(*binding.shader), binding.shader->name, texts_of(binding),
            counts_of(binding)};
}

// Null after an error.
ShaderLinker::Made ShaderLinker::linked(const ShaderBinding& binding,
                                        std::span<const CoShader> meant) {
    std::vector<rsl::LinkedSource> sources{source(binding, "")};
    std::string key = fmt::format("{}", static_cast<const void*>(binding.shader.get()));
    for (const CoShader& co_shader : meant) {
        sources.push_back(source(*co_shader.shader, co_shader.handle));
        key += fmt::format("\n{}", static_cast<const void*>(co_shader.shader->shader.get()));
    }
    for (const rsl::LinkedSource& one : sources) {
        key += fmt::format("\n{}", one.handle);
        for (const auto& [name, texts] : one.texts)
            key += fmt::format("\n{}={}", name, fmt::join(texts, "\x1f"));
        for (const auto& [name, count] : one.counts) key += fmt::format("\n{}:{}", name, count);
    }
    auto [known, is_new] = linked_.try_emplace(key);
    if (!is_new) return known->second;
    size_t before = diagnostics_.findings().size();
    known->second = rsl::compile_linked(sources, search_.options(), diagnostics_);
    diagnostics_.drop_repeats(before);
    return known->second;
}

void ShaderLinker::link(ShaderBinding& binding, std::span<const CoShader> co_shaders) {
    const bool longer = !binding.shader->definition->open_arrays.empty() &&
                        rsl::other_lengths(*binding.shader, counts_of(binding));
    std::vector<CoShader> meant = meant_by(binding, co_shaders);
    if (meant.empty() && !longer) return;
    Made made = linked(binding, meant);
    if (!made || made->kind != binding.shader->kind) return;
    binding.shader = std::move(made);
    for (const CoShader& co_shader : meant) adopt(binding, co_shader);
}

}  // namespace kinora::ri
