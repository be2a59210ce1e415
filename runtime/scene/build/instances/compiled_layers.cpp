// runtime/scene/build/instances/compiled_layers.cpp: shader stacks lowered and compiled, each shape
// once.
#include "runtime/scene/build/instances/compiled_layers.h"

#include <type_traits>
#include <utility>

namespace kinora {

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

rsl::LowerOptions lower_options(const ShaderInstance& look, const ShaderInstanceOptions& options) {
    rsl::LowerOptions lower;
    lower.math = options.quality.math;
    lower.spaces = options.spaces;
    lower.skip_transparent = true;
    lower.opacity_threshold = float(options.quality.opacity_threshold);
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
    return lower;
}

// Whether shadow rays ask for the opacity: of what is not opaque, and of what fills an object.
bool shades_shadows(const ShaderInstance& look, const rsl::LoweredShader& lowered) {
    return look.kind == ShaderInstanceKind::Volume
               ? look.volume != 0 && !look.exterior
               : look.kind == ShaderInstanceKind::Surface &&
                     lowered.opacity != rsl::LoweredShader::Opacity::Opaque;
}

// Nothing where a shader cannot be compiled.
std::optional<CompiledLayers> compile_layers(const ShaderInstance& look,
                                             std::span<const rsl::Layer> layers,
                                             const ShaderInstanceOptions& options,
                                             Diagnostics& diagnostics) {
    rsl::LowerOptions lower = lower_options(look, options);
    jit::CompileOptions compile;
    compile.target = options.target;
    compile.dumps = options.dumps;
    compile.files = &diagnostics.files;
    compile.own_lines = options.own_lines;
    std::optional<rsl::LoweredShader> lowered =
        lower_layers(layers, lower, options.quality.derivatives, diagnostics);
    if (!lowered) return std::nullopt;
    CompiledLayers made;
    made.lowered = std::move(*lowered);
    made.full = jit::compile(std::move(made.lowered.module), compile);
    made.lowered.module = {};
    if (shades_shadows(look, made.lowered)) {
        lower.want_Ci = false;
        lower.want_N = false;
        lower.aovs.clear();
        compile.dumps = nullptr;
        std::optional<rsl::LoweredShader> opacity =
            lower_layers(layers, lower, options.quality.derivatives, diagnostics);
        if (!opacity) return std::nullopt;
        made.opacity = jit::compile(std::move(opacity->module), compile);
    }
    return made;
}

// Texts with their lengths and numbers with their bits, one behind another: a key.
class KeyText {
  public:
    template <class T>
    requires std::is_trivially_copyable_v<T>
    void add(const T& value) { text_.append(reinterpret_cast<const char*>(&value), sizeof(T)); }
    void add(const std::string& text) {
        add(text.size());
        text_ += text;
    }
    std::string take() { return std::move(text_); }

  private:
    std::string text_;
};

// All that compile_layers() reads of an instance.
std::string key_of(const ShaderInstance& look, std::span<const rsl::Layer> layers) {
    KeyText key;
    key.add(look.kind);
    key.add(look.area_light);
    key.add(look.volume != 0 && !look.exterior);
    for (const rsl::Layer& layer : layers) {
        key.add(layer.shader);
        key.add(layer.done);
        key.add(layer.space);
        key.add(layer.params.size());
        for (const rsl::ParamBinding& param : layer.params) {
            key.add(param.name);
            key.add(param.kind);
            key.add(param.plain);
            key.add(param.below);
            key.add(param.variable);
            key.add(param.constant.size());
            for (float number : param.constant) key.add(number);
            key.add(param.strings.size());
            for (const std::string& text : param.strings) key.add(text);
        }
    }
    return key.take();
}

}  // namespace

const CompiledLayers* find_or_compile(const ShaderInstance& look,
                                      std::span<const rsl::Layer> layers,
                                      const ShaderInstanceOptions& options, KnownLayers& known,
                                      Diagnostics& diagnostics) {
    std::string key = key_of(look, layers);
    if (auto found = known.find(key); found != known.end()) return &found->second;
    std::optional<CompiledLayers> made = compile_layers(look, layers, options, diagnostics);
    if (!made) return nullptr;
    return &known.emplace(std::move(key), std::move(*made)).first->second;
}

}  // namespace kinora
