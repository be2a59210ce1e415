// runtime/shading/shader_instance.cpp: parameters and spaces bound to compiled shaders.
#include "runtime/shading/shader_instance.h"

#include <algorithm>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "runtime/base/check.h"
#include "runtime/scene/scene.h"
#include "runtime/scene/spaces.h"
#include "runtime/shading/grid.h"
#include "runtime/shading/scene_host.h"

namespace kinora {

namespace {

const ParamSource* find_source(const ShaderUse& use, std::string_view name) {
    for (const ParamSource& source : use.params)
        if (source.name == name) return &source;
    return nullptr;
}

bool is_animated(const SceneDescription& description, ValueSlot slot) {
    for (uint32_t i = 0; i < slot.count; ++i)
        if (description.animated[slot.offset + i]) return true;
    return false;
}

// Component `c` of a parameter of `needed` components, from a slot that may hold one number for
// all of a triple.
uint32_t value_index(ValueSlot slot, uint32_t needed, uint32_t c) {
    return slot.offset + (slot.count == 1 && needed > 1 ? 0 : std::min(c, slot.count - 1));
}

rsl::ParamBinding bind_parameter(const rsl::ShaderParameter& parameter, bool shape,
                                 const ShaderUse& use, const ShaderInstance& look, uint32_t layer,
                                 const SceneDescription& description) {
    rsl::ParamBinding binding;
    binding.name = std::string(parameter.name);
    for (const VaryingParam& varying : look.varying)
        if (varying.layer == layer && varying.name == parameter.name) {
            binding.kind = rsl::ParamBinding::Kind::Varying;
            binding.plain = varying.of_displacement();
            return binding;
        }
    const ParamSource* source = find_source(use, parameter.name);
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
        binding.constant.push_back(
            float(description.values[value_index(source->value, needed, c)]));
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
    if (input.source == FrameInput::Source::Spatial) input.space = space_index(look, "shader");
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
    check_failed("runtime/shading/shader_instance.cpp", 0, "unknown frame input " + rsl::text(key));
}

uint16_t resolve_column(const ShaderInstance& look, const rsl::KernelKey& key) {
    if (uint16_t column = find_column(key); column != kNoColumn) return column;
    if (key.kind == rsl::KeyKind::Parameter)
        for (const VaryingParam& varying : look.varying)
            if (varying.layer == key.layer && varying.name == rsl::name_of(key))
                return uint16_t(varying.column + uint32_t(key.partial) * varying.components +
                                uint32_t(key.component));
    check_failed("runtime/shading/shader_instance.cpp", 0, "unknown point input " + rsl::text(key));
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

FrameInput parameter_input(const ShaderInstance& look, const rsl::KernelKey& key) {
    FrameInput input;
    if (key.layer >= look.layers.size()) return input;
    const ShaderUse& use = look.layers[key.layer];
    const std::string& name = rsl::name_of(key);
    const ParamSource* source = find_source(use, name);
    uint32_t element = uint32_t(std::max(key.element, 0)), component = key.component;
    for (const rsl::ShaderParameter& parameter : use.shader->parameters) {
        if (parameter.name != name || !source) continue;
        if (parameter.type.base == rsl::BaseType::String) {
            std::string text =
                element < source->strings.size() ? source->strings[element] : std::string();
            input.fixed = jit::float_of(rsl::intern(text));
            return input;
        }
        uint32_t width = uint32_t(rsl::component_count(parameter.type.base));
        uint32_t needed = width * uint32_t(std::max(parameter.type.array_length, 1));
        bool spatial = rsl::is_spatial(parameter.type.base);
        input.source = spatial ? FrameInput::Source::Spatial : FrameInput::Source::Value;
        input.type = parameter.type.base;
        input.component = key.component;
        uint32_t c = element * width + (spatial ? 0 : component);
        if (source->by_columns && width == 16)
            c = element * width + component % 4 * 4 + component / 4;
        input.index = value_index(source->value, needed, c);
        if (spatial && source->value.count < 3) {  // one number for all three: no point to speak of
            input.source = FrameInput::Source::Value;
            input.index = source->value.offset;
        }
        return input;
    }
    return input;
}

std::vector<rsl::Layer> bound_layers(const ShaderInstance& look,
                                     const SceneDescription& description) {
    std::vector<rsl::Layer> layers;
    for (uint32_t l = 0; l < look.layers.size(); ++l) {
        const ShaderUse& use = look.layers[l];
        rsl::Layer& layer = layers.emplace_back();
        layer.shader = use.shader.get();
        layer.done = l < look.done_layers;
        std::vector<bool> shape = rsl::shape_parameters(*use.shader);
        for (size_t p = 0; p < use.shader->parameters.size(); ++p)
            layer.params.push_back(
                bind_parameter(use.shader->parameters[p], shape[p], use, look, l, description));
        for (const VaryingParam& varying : look.varying)  // globals that the mesh brings
            if (varying.layer == l && varying.name == "Cs")
                layer.params.push_back({"Cs", rsl::ParamBinding::Kind::Varying, {}, {}});
    }
    return layers;
}

namespace {

// Lowers the layers; inputs without partials have none to hand on.
std::optional<rsl::LoweredShader> lower_layers(std::span<const rsl::Layer> layers,
                                               const rsl::LowerOptions& lower, bool derivatives,
                                               Diagnostics& diagnostics) {
    std::optional<rsl::LoweredShader> lowered = rsl::lower(layers, lower, diagnostics);
    if (lowered && !derivatives)
        for (jit::InputInfo& input : lowered->module.inputs) input.du = input.dv = "";
    return lowered;
}

}  // namespace

bool compile_instance(ShaderInstance& look, const SceneDescription& description,
                      const ShaderInstanceOptions& options, Diagnostics& diagnostics) {
    assign_columns(look);
    std::vector<rsl::Layer> layers = bound_layers(look, description);
    rsl::LowerOptions lower;
    lower.math = options.math;
    lower.spaces = options.spaces;
    lower.skip_transparent = true;
    lower.opacity_threshold = options.opacity_threshold;
    lower.messages = options.light_messages;
    lower.aovs = options.aovs;
    for (const std::string& name : options.gathered)
        if (name == "N")
            lower.want_N = true;
        else
            lower.aovs.push_back(name);
    bool of_vertices = look.kind == ShaderInstanceKind::Displacement ||
                       look.kind == ShaderInstanceKind::Transformation;
    lower.of_vertices = of_vertices;
    if (of_vertices) {
        lower.want_Ci = lower.want_Oi = false;
        lower.want_P = lower.want_N = true;
        lower.aovs.clear();
        for (const ShaderUse& use : look.layers)
            for (const rsl::ShaderParameter& p : use.shader->parameters)
                if (p.output) lower.aovs.emplace_back(p.name);
    }
    lower.area_light = look.area_light;
    jit::CompileOptions compile;
    compile.target = options.target;
    compile.dumps = options.dumps;
    compile.files = &diagnostics.files;
    compile.own_lines = options.own_lines;
    std::optional<rsl::LoweredShader> lowered =
        lower_layers(layers, lower, options.derivatives, diagnostics);
    if (!lowered) return false;
    look.lowered = std::move(*lowered);
    bind_kernel(look.full, jit::compile(std::move(look.lowered.module), compile), look);
    // Shadow rays ask what is not opaque, and what fills an object.
    bool shades_shadows = look.kind == ShaderInstanceKind::Surface && !look.opaque();
    bool fills = look.kind == ShaderInstanceKind::Volume && look.volume != 0 && !look.exterior;
    if (shades_shadows || fills) {
        lower.want_Ci = false;
        lower.want_N = false;
        lower.aovs.clear();
        compile.dumps = nullptr;
        std::optional<rsl::LoweredShader> opacity =
            lower_layers(layers, lower, options.derivatives, diagnostics);
        if (!opacity) return false;
        look.opacity.emplace();
        bind_kernel(*look.opacity, jit::compile(std::move(opacity->module), compile), look);
    }
    look.current_from_space.resize(look.spaces.size(), dmat4(1.0));
    return true;
}

void ShaderInstance::update_for_vertices(const FrameContext& context, uint32_t object) {
    for (size_t s = 0; s < spaces.size(); ++s)
        current_from_space[s] = object_from_space(context.scene, spaces[s], object);
    full.update(context, *this);
}

void ShaderInstance::update(const FrameContext& context) {
    for (size_t s = 0; s < spaces.size(); ++s)
        current_from_space[s] = kinora::current_from_space(context.scene, spaces[s], space_owner());
    full.update(context, *this);
    if (opacity) opacity->update(context, *this);
}

dvec3 parameter_in_current(rsl::BaseType type, const dmat4& current_from_shader, const double* v) {
    dvec3 value(v[0], v[1], v[2]);
    if (type == rsl::BaseType::Point) return dvec3(current_from_shader * dvec4(value, 1.0));
    dmat3 linear(current_from_shader);
    if (type == rsl::BaseType::Normal) return glm::transpose(glm::inverse(linear)) * value;
    return linear * value;
}

namespace {

class SceneNumbers : public FrameNumbers {
  public:
    SceneNumbers(const FrameContext& context, const ShaderInstance& look,
                 std::span<const FrameInput> inputs)
        : context_(context), look_(look), inputs_(inputs) {}
    float number(size_t index) const override;

  private:
    // From "current" to a space of the look, inverted once for its sixteen numbers.
    const dmat4& space_from_current(uint32_t space) const;

    const FrameContext& context_;
    const ShaderInstance& look_;
    std::span<const FrameInput> inputs_;
    mutable uint32_t inverted_ = kNone;  // the space of
    mutable dmat4 inverse_{};
};

const dmat4& SceneNumbers::space_from_current(uint32_t space) const {
    if (inverted_ != space) inverse_ = glm::inverse(look_.current_from_space[space]);
    inverted_ = space;
    return inverse_;
}

float SceneNumbers::number(size_t index) const {
    using Source = FrameInput::Source;
    const FrameInput& input = inputs_[index];
    const Scene& scene = context_.scene;
    switch (input.source) {
        case Source::Fixed:
            return input.fixed;
        case Source::Value:
            return float(scene.values[input.index]);
        case Source::Spatial: {
            const dmat4& m = look_.current_from_space[input.space];
            return float(
                parameter_in_current(input.type, m, &scene.values[input.index])[input.component]);
        }
        case Source::Space: {
            int row = input.component / 4, column = input.component % 4;
            return float((input.inverse ? space_from_current(input.index)
                                        : look_.current_from_space[input.index])[column][row]);
        }
        case Source::Time:
            return float(scene.time);
        case Source::Shutter:
            return float(scene.shutter);
        case Source::Near:
            return float(scene.view.znear);
        case Source::Far:
            return float(scene.view.zfar);
        case Source::Eye:
            return float(context_.eye[input.component]);
    }
    return 0;
}

}  // namespace

void SceneKernel::update(const FrameContext& context, const ShaderInstance& look) {
    SceneHost host(context.scene, look);
    run_frame(SceneNumbers(context, look, inputs), host, {}, context.stop);
    host.printed().show();
    prints_asked = host.printed().asked();
    prints_shown = host.printed().shown();
}

}  // namespace kinora
