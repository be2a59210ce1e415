// runtime/scene/build/instances/compile_instance.cpp: parameters and spaces bound to compiled
// shaders.
#include "runtime/scene/build/instances/compile_instance.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "runtime/base/check.h"
#include "runtime/scene/build/instances/compiled_layers.h"
#include "runtime/scene/description/given_globals.h"

namespace kinora {

namespace {

bool is_animated(const SceneDescription& description, ValueSlot slot) {
    for (uint32_t i = 0; i < slot.count; ++i)
        if (description.animated[slot.offset + i]) return true;
    return false;
}

rsl::ParamBinding layer_binding(const LayerLink& link) {
    rsl::ParamBinding binding;
    binding.name = link.param;
    binding.kind = rsl::ParamBinding::Kind::Layer;
    binding.below = link.below;
    binding.variable = link.variable;
    return binding;
}

rsl::ParamBinding bind_parameter(const rsl::ShaderParameter& parameter, bool shape,
                                 const ShaderUse& use, const ShaderInstance& look, uint32_t layer,
                                 const SceneDescription& description) {
    rsl::ParamBinding binding;
    binding.name = std::string(parameter.name);
    if (const LayerLink* link = use.find_link(parameter.name)) return layer_binding(*link);
    for (const VaryingParam& varying : look.varying)
        if (varying.layer == layer && varying.name == parameter.name) {
            binding.kind = rsl::ParamBinding::Kind::Varying;
            binding.plain = varying.of_displacement();
            return binding;
        }
    const ParamSource* source = use.find(parameter.name);
    if (!source) return binding;
    if (parameter.type.base == rsl::BaseType::String) {
        binding.kind = rsl::ParamBinding::Kind::Constant;
        binding.strings = source->strings;
        return binding;
    }
    if (!source->value.present()) return binding;
    binding.kind = rsl::ParamBinding::Kind::Frame;
    // Shape only (docs/decisions.md#specialise-on-shape-only): floats that are exactly 0 or 1, and
    // whatever decides the control flow. Point-like values stay frame rate: they depend on where
    // the shader's space is.
    if (rsl::is_spatial(parameter.type.base) || parameter.type.base == rsl::BaseType::Matrix ||
        is_animated(description, source->value))
        return binding;
    double first = description.values[source->value.offset];
    bool simple =
        parameter.type == rsl::Type{rsl::BaseType::Float, -1} && (first == 0.0 || first == 1.0);
    if (!shape && !simple) return binding;
    binding.kind = rsl::ParamBinding::Kind::Constant;
    uint32_t needed = uint32_t(rsl::component_count(parameter.type.base)) *
                      uint32_t(std::max(parameter.type.array_length, 1));
    for (uint32_t c = 0; c < needed; ++c)
        binding.constant.push_back(float(description.values[source->value.component(needed, c)]));
    return binding;
}

// Index of a named space among the look's; added when new.
uint32_t space_index(ShaderInstance& look, std::string_view space) {
    auto known = std::find(look.spaces.begin(), look.spaces.end(), space);
    uint32_t index = uint32_t(known - look.spaces.begin());
    if (known == look.spaces.end()) look.spaces.emplace_back(space);
    return index;
}

FrameInput resolve_parameter(ShaderInstance& look, const rsl::KernelKey& key) {
    FrameInput input = parameter_input(look, key);
    if (input.source == FrameInput::Source::Spatial) {
        const std::string& own = look.layers[key.layer].space;
        input.space = space_index(look, own.empty() ? "shader" : std::string_view(own));
    }
    return input;
}

// A frame-rate global; nothing where it is none.
std::optional<FrameInput> resolve_global(const rsl::KernelKey& key) {
    using rsl::Global;
    using Source = FrameInput::Source;
    struct Row {
        Global id;
        Source source;
        float fixed;
    };
    static constexpr Row kRows[] = {
        {Global::time, Source::Time, 0},    {Global::dtime, Source::Shutter, 0},
        {Global::ncomps, Source::Fixed, 3}, {Global::alpha, Source::Fixed, 1},
        {Global::E, Source::Eye, 0},
    };
    for (const Row& row : kRows)
        if (row.id == key.global())
            return FrameInput{.source = row.source, .fixed = row.fixed, .component = key.component};
    return std::nullopt;
}

FrameInput resolve_input(ShaderInstance& look, const rsl::KernelKey& key) {
    using rsl::KeyKind;
    using Source = FrameInput::Source;
    switch (key.kind) {
        case KeyKind::Global:
            if (std::optional<FrameInput> input = resolve_global(key)) return *input;
            break;
        case KeyKind::CameraNear:
            return {.source = Source::Near};
        case KeyKind::CameraFar:
            return {.source = Source::Far};
        case KeyKind::Parameter:
            return resolve_parameter(look, key);
        case KeyKind::SpaceToCurrent:
        case KeyKind::SpaceFromCurrent:
            return {.source = Source::Space,
                    .index = space_index(look, rsl::name_of(key)),
                    .component = key.component,
                    .inverse = key.kind == KeyKind::SpaceFromCurrent};
        case KeyKind::None:
        case KeyKind::One:
        case KeyKind::Rng:
        case KeyKind::LightRecord:
        case KeyKind::Aov:
        case KeyKind::Message:
            break;
    }
    check_failed("runtime/scene/build/instances/compile_instance.cpp", 0,
                 "unknown frame input " + rsl::text(key));
}

uint16_t resolve_column(const ShaderInstance& look, const rsl::KernelKey& key) {
    if (uint16_t column = find_column(key); column != kNoColumn) return column;
    if (key.kind == rsl::KeyKind::Parameter)
        for (const VaryingParam& varying : look.varying)
            if (varying.layer == key.layer && varying.name == rsl::name_of(key))
                return uint16_t(varying.column + uint32_t(key.partial) * varying.components +
                                uint32_t(key.component));
    check_failed("runtime/scene/build/instances/compile_instance.cpp", 0,
                 "unknown point input " + rsl::text(key));
}

void bind_kernel(SceneKernel& bound, jit::KernelPair kernels, ShaderInstance& look) {
    bound.bind(std::move(kernels),
               [&](const rsl::KernelKey& key) { return resolve_column(look, key); });
    if (!bound.pair.frame) return;
    for (const jit::InputInfo& input : bound.pair.frame->inputs)
        bound.inputs.push_back(resolve_input(look, rsl::key_of(input)));
}

void assign_columns(ShaderInstance& look) {
    for (VaryingParam& varying : look.varying) {
        varying.column = varying.array ? kNoColumn : look.column_count;
        if (varying.array) continue;
        look.column_count = uint16_t(look.column_count + 3 * varying.components);
    }
}

}  // namespace

static bool bound(const rsl::Layer& layer, std::string_view name) {
    return std::ranges::any_of(layer.params,
                               [&](const rsl::ParamBinding& param) { return param.name == name; });
}

std::vector<rsl::Layer> bound_layers(const ShaderInstance& look,
                                     const SceneDescription& description) {
    std::vector<rsl::Layer> layers;
    for (uint32_t l = 0; l < look.layers.size(); ++l) {
        const ShaderUse& use = look.layers[l];
        rsl::Layer& layer = layers.emplace_back();
        layer.shader = use.shader.get();
        layer.done = l < look.done_layers;
        layer.space = use.space;
        std::vector<bool> shape = rsl::shape_parameters(*use.shader);
        for (size_t p = 0; p < use.shader->parameters.size(); ++p)
            layer.params.push_back(
                bind_parameter(use.shader->parameters[p], shape[p], use, look, l, description));
        for (const LayerLink& link : use.links)
            if (is_given_global(link.param)) layer.params.push_back(layer_binding(link));
        // Globals that the mesh or the material brings, and inputs that no parameter declares.
        for (const VaryingParam& varying : look.varying)
            if (varying.layer == l && !bound(layer, varying.name) &&
                (is_given_global(varying.name) || varying.name.starts_with('@')))
                layer.params.push_back({varying.name, rsl::ParamBinding::Kind::Varying, {}, {}});
        for (const ParamSource& source : use.params)
            if (is_given_global(source.name) && !bound(layer, source.name))
                layer.params.push_back({source.name, rsl::ParamBinding::Kind::Frame, {}, {}});
    }
    return layers;
}

bool compile_instance(ShaderInstance& look, const SceneDescription& description,
                      const ShaderInstanceOptions& options, Diagnostics& diagnostics) {
    assign_columns(look);
    KnownLayers own;
    const CompiledLayers* made = find_or_compile(look, bound_layers(look, description), options,
                                                 options.known ? *options.known : own, diagnostics);
    if (!made) return false;
    look.lowered = made->lowered;
    bind_kernel(look.full, made->full, look);
    if (made->opacity) bind_kernel(look.opacity.emplace(), *made->opacity, look);
    return true;
}

}  // namespace kinora
