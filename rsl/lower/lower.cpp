// rsl/lower/lower.cpp: a stack of checked shaders to one module of IR: layers, outputs, opacity.
#include "rsl/lower/lower.h"

#include <algorithm>

#include "jit/ir/gate.h"
#include "rsl/lower/builtin_call.h"
#include "rsl/lower/calls.h"
#include "rsl/lower/expressions.h"
#include "rsl/lower/gather.h"
#include "rsl/lower/lights.h"
#include "rsl/lower/messages.h"
#include "rsl/lower/statements.h"
#include "rsl/lower/values.h"
#include "rsl/model/changes.h"

namespace kinora::rsl {

namespace {

// Writes one layer: its parameters, then its body.
class LayerWriter {
  public:
    LayerWriter(LoweringContext& context, SampleSeeds& seeds, Slots& slots, Spaces& spaces,
                Globals& globals, Variables& variables, Messages& messages, Recursion& recursion,
                LightShader& light_shader, TreeWalk& tree)
        : context_(context),
          seeds_(seeds),
          slots_(slots),
          spaces_(spaces),
          globals_(globals),
          variables_(variables),
          messages_(messages),
          recursion_(recursion),
          light_shader_(light_shader),
          tree_(tree) {}

    void run(const Layer& next);
    void declare(const Layer& next);  // a layer that is done: its parameters only

    // What displacements that bend normals were given, to tell whether they changed it.
    const Lowered& given_N() const { return given_N_; }
    const Lowered& given_P() const { return given_P_; }

  private:
    void enter();  // slots for the symbols of the context's layer
    void first_values(const Shader& shader);
    void leave_messages(const Shader& shader);
    void leave_named_outputs(const Shader& shader);

    LoweringContext& context_;
    SampleSeeds& seeds_;
    Slots& slots_;
    Spaces& spaces_;
    Globals& globals_;
    Variables& variables_;
    Messages& messages_;
    Recursion& recursion_;
    LightShader& light_shader_;
    TreeWalk& tree_;
    Lowered given_N_, given_P_;
};

void LayerWriter::enter() {
    variables_.enter_layer();
    seeds_.enter_layer();
    recursion_.enter_layer();
}

void LayerWriter::declare(const Layer& next) {
    for (size_t g = 0; g < size_t(Global::Count); ++g) globals_.forget(Global(g));
    context_.layer = &next;
    enter();
    for (const ShaderParameter& p : next.shader->parameters)
        if (!p.type.is_array())
            messages_.add({next.shader->kind, std::string(p.name), p.type,
                           variables_.parameter(*p.symbol), -1, context_.layer_index});
}

void LayerWriter::run(const Layer& next) {
    enter();
    first_values(*next.shader);
    tree_.block(next.shader->definition->body->body);
    leave_messages(*next.shader);
}

void LayerWriter::first_values(const Shader& shader) {
    ChangeFinder finder(context_.ast());
    finder.add(shader.definition->body);
    for (const ShaderParameter& parameter : shader.parameters) finder.add(parameter.default_value);
    if (context_.bends_normals() && !globals_.written(Global::P)) {
        given_N_ = globals_.input(Global::N);
        given_P_ = globals_.smooth_P(given_N_);
        globals_.write(Global::N, given_N_);
        globals_.write(Global::P, given_P_);
    }
    // What is written has a value from the start, so that every If can merge it.
    for (const Symbol* symbol : finder.changes.symbols)
        if (symbol->global && !globals_.written(symbol->global->id))
            globals_.write(symbol->global->id, globals_.input(symbol->global->id));
    if (shader.kind == ShaderKind::Light) light_shader_.begin(finder.changes);
    for (const ShaderParameter& parameter : shader.parameters) {
        bool used = std::find(finder.used.begin(), finder.used.end(), parameter.symbol) !=
                    finder.used.end();
        if (!used && !parameter.output) continue;
        if (parameter.type.is_array())
            variables_.array_of(*parameter.symbol);
        else
            slots_.write(variables_.slot_of(*parameter.symbol),
                         variables_.parameter(*parameter.symbol));
    }
}

void LayerWriter::leave_messages(const Shader& shader) {
    for (const ShaderParameter& parameter : shader.parameters) {
        Messages::Message message{shader.kind, std::string(parameter.name), parameter.type, {},
                                  -1,          context_.layer_index};
        bool last = context_.layer == &context_.layers.back() &&
                    context_.options.messages.empty() && context_.options.aovs.empty();
        if (!parameter.type.is_array()) {
            Lowered value = variables_.read(*parameter.symbol);
            message.value = parameter.output ? value : spaces_.out_of_layer(value);
        } else if (last) {
            continue;  // nobody is left to ask
        } else {
            message.array = variables_.array_of(*parameter.symbol);
        }
        messages_.add(std::move(message));
    }
    leave_named_outputs(shader);
}

// Those that are wanted, from the tables of what the shader named at run time.
void LayerWriter::leave_named_outputs(const Shader& shader) {
    for (const std::string& name : context_.options.aovs) {
        auto declared = [&](const ShaderParameter& p) { return p.name == name; };
        std::optional<BaseType> type = named_output(shader, name);
        if (!type || std::ranges::any_of(shader.parameters, declared)) continue;
        for (const NamedTable& table : shader.definition->named_tables)
            if (table.values->type.base == *type)
                messages_.add({shader.kind,
                               name,
                               {*type, -1},
                               variables_.find_named(table, name),
                               -1,
                               context_.layer_index});
    }
}

// Writes the whole kernel: the layers in order, then the outputs.
class Stack {
  public:
    Stack(Emitter& emitter, LoweringContext& context, Spaces& spaces, Globals& globals,
          Messages& messages, LightShader& light_shader, LayerWriter& writer)
        : e_(emitter),
          b_(emitter.b),
          context_(context),
          spaces_(spaces),
          globals_(globals),
          messages_(messages),
          light_shader_(light_shader),
          writer_(writer) {}

    void run() {
        for (const Layer& layer : context_.layers)
            layer.done ? declare_layer(layer) : run_layer(layer);
        if (context_.failed) return;
        if (context_.layers.back().shader->kind == ShaderKind::Light)
            light_shader_.outputs();
        else
            write_outputs();
        write_named_outputs();
    }

  private:
    void declare_layer(const Layer& layer) {
        context_.layer_index = size_t(&layer - context_.layers.data());
        writer_.declare(layer);
    }

    // Displacements pass P and N on among themselves; surfaces see N as it was left, and the
    // original P: bent normals, not moved points (docs/decisions.md#joined-layers).
    void run_layer(const Layer& layer) {
        bool displacement = layer.shader->kind == ShaderKind::Displacement ||
                            layer.shader->kind == ShaderKind::Transformation;
        for (size_t g = 0; g < size_t(Global::Count); ++g) globals_.forget(Global(g));
        if (!displacement) bring_back();
        context_.layer = &layer;
        context_.layer_index = size_t(&layer - context_.layers.data());
        if (have_N_) globals_.write(Global::N, N_);
        if (have_P_ && displacement) globals_.write(Global::P, P_);
        // Volumes and imagers go on with what the one before them left.
        bool behind =
            context_.kind() == ShaderKind::Volume || context_.kind() == ShaderKind::Imager;
        if (behind && have_surface_) {
            globals_.write(Global::Ci, lowered(BaseType::Color, Ci_));
            globals_.write(Global::Oi, lowered(BaseType::Color, Oi_));
            if (context_.kind() == ShaderKind::Imager)
                globals_.write(Global::alpha, lowered(BaseType::Float, alpha_));
            have_surface_ = false;
        }
        writer_.run(layer);
        if (context_.failed) return;
        left_N_ = globals_.read(Global::N);
        left_P_ = globals_.read(Global::P);
        if (displacement) {
            N_ = left_N_, P_ = globals_.read(Global::P);
            have_N_ = have_P_ = true;
            bends_ = context_.bends_normals() ? &layer : nullptr;
        } else if (layer.shader->kind != ShaderKind::Light) {
            composite();
        }
    }

    // N and P of displacements that bend normals, for the surfaces: in the kernel's current.
    void bring_back() {
        if (!bends_) return;
        const Layer* surface = std::exchange(context_.layer, std::exchange(bends_, nullptr));
        bool same_N = N_.c == writer_.given_N().c, same_P = P_.c == writer_.given_P().c;
        if (same_N && !same_P) {  // as true displacement: N of what has moved
            N_ = lowered(BaseType::Normal, e_.normalize(globals_.normal_of(P_.v3())));
            same_N = false;
        }
        if (!same_N) {
            V3 N = spaces_.out_of_layer(N_).v3();
            Value as_long = e_.div(e_.length(N_.v3()), e_.length(N));
            N_ = lowered(BaseType::Normal, e_.scale(N, as_long));
        }
        if (!same_P) P_ = spaces_.out_of_layer(P_);
        context_.layer = surface;
        have_N_ = !same_N, have_P_ = !same_P;
    }

    // The new layer over those before: Ci is premultiplied by Oi.
    void composite() {
        V3 Ci = globals_.read(Global::Ci).v3(), Oi = globals_.read(Global::Oi).v3();
        if (have_surface_) {
            for (size_t c = 0; c < 3; ++c) {
                Value through = b_.sub(e_.f(1), Oi[c]);
                Ci[c] = e_.fma(through, Ci_[c], Ci[c]);
                Oi[c] = e_.fma(through, Oi_[c], Oi[c]);
            }
        }
        if (context_.kind() == ShaderKind::Imager) alpha_ = globals_.read(Global::alpha).c[0];
        Ci_ = Ci, Oi_ = Oi, have_surface_ = true;
    }

    void output(const KernelKey& key, jit::Type type, Value value) {
        b_.output({text(key), type, packed(key)}, value);
    }
    void output(Global id, const Lowered& value) {
        for (int c = 0; c < value.size(); ++c)
            output(global_key(id, c), jit::Type::F, value.c[size_t(c)]);
    }

    void write_outputs() {
        if (have_surface_) {
            context_.out.opacity = opacity();
            if (context_.options.want_Ci) output(Global::Ci, lowered(BaseType::Color, Ci_));
            if (context_.options.want_Oi) output(Global::Oi, lowered(BaseType::Color, Oi_));
        }
        if (alpha_ != jit::kNone) output(global_key(Global::alpha), jit::Type::F, alpha_);
        context_.out.moves_P = have_P_ && !is_input(b_, P_.v3(), Global::P);
        context_.out.bends_N = have_N_ && !is_input(b_, N_.v3(), Global::N);
        if (context_.options.want_N) output(Global::N, left_N_);
        bool left = context_.options.moves_points && have_surface_;
        if (context_.options.want_P)
            output(Global::P, left ? left_P_ : have_P_ ? P_ : globals_.input(Global::P));
    }

    using MakeKey = KernelKey(std::string_view, int, ComponentForm, int);

    // What a surface has under a name of the language, as the topmost layer left it.
    Lowered left_global(Global id) {
        if (id == Global::Ci) return lowered(BaseType::Color, Ci_);
        if (id == Global::Oi) return lowered(BaseType::Color, Oi_);
        return id == Global::N ? left_N_ : globals_.read(id);
    }

    // "z" is the distance from the camera's plane.
    void write_global(MakeKey& key, const std::string& name) {
        const std::optional<BaseType> type = global_output(name);
        if (context_.kind() != ShaderKind::Surface || !type) return;
        const bool is_depth = name == kDepthOutput;
        const Lowered value = left_global(is_depth ? Global::P : find_global(name)->id);
        for (int c = 0; c < component_count(*type); ++c)
            output(key(name, -1, form_of(*type), c), jit::Type::F,
                   value.c[size_t(is_depth ? 2 : c)]);
    }

    // Outputs wanted by the film or by lightsource(): the topmost layer's parameters, else globals.
    void write_named_outputs() {
        auto write = [&](MakeKey& key, const std::vector<std::string>& names) {
            for (const std::string& name : names) {
                auto found = std::find_if(messages_.list().rbegin(), messages_.list().rend(),
                                          [&](auto& message) { return message.name == name; });
                if (found == messages_.list().rend()) {
                    write_global(key, name);
                    continue;
                }
                std::vector<Lowered> values = messages_.values(*found);
                for (size_t k = 0; k < values.size(); ++k)
                    for (int c = 0; c < values[k].size(); ++c)
                        output(key(name, found->type.is_array() ? int(k) : -1,
                                   form_of(values[k].type), c),
                               values[k].type == BaseType::String ? jit::Type::I : jit::Type::F,
                               values[k].c[size_t(c)]);
            }
        };
        write(aov_key, context_.options.aovs);
        write(message_key, context_.options.messages);
    }

    LoweredShader::Opacity opacity() {
        using Opacity = LoweredShader::Opacity;
        std::vector<jit::Rate> rates = value_rates();
        jit::Rate rate = jit::Rate::Constant;
        bool ones = true;
        for (Value v : Oi_) {
            rate = std::max(rate, rates[v]);
            float x;
            ones = ones && b_.constant_f(v, &x) && x == 1;
        }
        if (ones) return Opacity::Opaque;
        return rate == jit::Rate::Point ? Opacity::Computed : Opacity::Constant;
    }

    // Rates of all values so far; what a loop carries or a call gives counts as point rate.
    std::vector<jit::Rate> value_rates() {
        const jit::Function& f = b_.function();
        std::vector<jit::Rate> rates(f.insts.size(), jit::Rate::Constant);
        for (size_t k = 0; k < f.insts.size(); ++k) {
            const jit::Inst& inst = f.insts[k];
            const jit::OpInfo& info = jit::op_info(inst.op);
            jit::Rate& rate = rates[k];
            if (inst.op == jit::Op::Input || inst.op == jit::Op::InputGather)
                rate = b_.module().inputs[size_t(inst.imm)].rate;
            else if (inst.op == jit::Op::Merge)
                rate = rates[f.insts[size_t(inst.imm)].a];
            else if (!(info.flags & jit::kPure))
                rate = jit::Rate::Point;
            for (Value operand : {inst.a, inst.b, inst.c})
                if (operand != jit::kNone && operand < k) rate = std::max(rate, rates[operand]);
        }
        return rates;
    }

    Emitter& e_;
    jit::Builder& b_;
    LoweringContext& context_;
    Spaces& spaces_;
    Globals& globals_;
    Messages& messages_;
    LightShader& light_shader_;
    LayerWriter& writer_;
    Lowered N_, P_;  // as the displacements left them
    bool have_N_ = false, have_P_ = false;
    Lowered left_N_, left_P_;
    const Layer* bends_ = nullptr;  // the last layer, if it is one whose current is the object's
    V3 Ci_{}, Oi_{};
    Value alpha_ = jit::kNone;  // imagers
    bool have_surface_ = false;
};

// The kernel of surfaces whose opacity a point decides computes it first.
void compute_opacity_first(LoweredShader& shader) {
    if (shader.opacity != LoweredShader::Opacity::Computed) return;
    std::vector<size_t> colors, opacities;
    for (size_t k = 0; k < shader.module.outputs.size(); ++k)
        for (int c = 0; c < 3; ++c) {
            const jit::FrontEndKey& key = shader.module.outputs[k].key;
            if (key == packed(global_key(Global::Ci, c))) colors.push_back(k);
            if (key == packed(global_key(Global::Oi, c))) opacities.push_back(k);
        }
    const jit::Function& kernel = shader.module.kernel();
    std::span<const jit::Value> results = kernel.args_of(kernel.insts.back());
    bool given = std::any_of(opacities.begin(), opacities.end(), [&](size_t k) {
        return kernel.insts[results[k]].op == jit::Op::Input;
    });
    if (colors.size() == 3 && opacities.size() == 3 && !given)
        jit::skip_zero_products(shader.module, colors, opacities);
}

// All objects that write a kernel, in the order of their dependence. Expressions, statements and
// calls recur through it, as a TreeWalk.
class KernelWriter final : public TreeWalk {
  public:
    KernelWriter(jit::Builder& builder, std::span<const Layer> layers, const LowerOptions& options,
                 Diagnostics& diagnostics, LoweredShader& result)
        : emitter_(builder, options.math), context_(layers, options, diagnostics, result) {}

    bool write() {
        stack_.run();
        return !context_.failed;
    }
    Lowered expr(const Expr& e) override { return expressions_.expr(e); }
    void statement(const Stmt& stmt) override { statements_.statement(stmt); }
    void block(std::span<Stmt* const> body) override { statements_.block(body); }

  private:
    Emitter emitter_;
    LoweringContext context_;
    Spaces spaces_{emitter_, context_};
    Services services_{emitter_, context_, spaces_};
    SampleSeeds seeds_{emitter_, context_};
    Slots slots_{emitter_.b};
    Regions regions_{emitter_, slots_};
    Arrays arrays_{emitter_, context_, slots_};
    Messages messages_{emitter_.b, arrays_};
    BoundParameters parameters_{emitter_, context_, spaces_, messages_};
    Globals globals_{emitter_, context_, spaces_, parameters_, slots_};
    Variables variables_{emitter_, context_,    slots_,   regions_,
                         arrays_,  parameters_, globals_, *this};
    Loops loops_{emitter_, context_, slots_, regions_, arrays_, variables_, seeds_};
    LightRecords lights_{emitter_, context_, services_};
    LightShader light_shader_{emitter_, context_, slots_, regions_, globals_, loops_, *this};
    Illuminance illuminance_{emitter_,   context_, slots_,  regions_,
                             variables_, loops_,   lights_, *this};
    Gather gather_{emitter_, context_, services_, seeds_, regions_, variables_, loops_, *this};
    Recursion recursion_{emitter_, context_,   seeds_, slots_,  regions_,  arrays_,
                         globals_, variables_, loops_, lights_, messages_, *this};
    Calls calls_{emitter_,   context_, seeds_,     slots_, arrays_,
                 variables_, loops_,   recursion_, *this};
    BuiltinTools tools_{emitter_,   context_, spaces_,       services_, seeds_, globals_,
                        variables_, lights_,  light_shader_, messages_, *this};
    Expressions expressions_{tools_, slots_, regions_, arrays_, calls_};
    Statements statements_{emitter_,     context_,      regions_, variables_, loops_,
                           illuminance_, light_shader_, gather_,  *this};
    LayerWriter writer_{context_,   seeds_,    slots_,     spaces_,       globals_,
                        variables_, messages_, recursion_, light_shader_, *this};
    Stack stack_{emitter_, context_, spaces_, globals_, messages_, light_shader_, writer_};
};

}  // namespace

std::optional<LoweredShader> lower(std::span<const Layer> layers, const LowerOptions& options,
                                   Diagnostics& diagnostics) {
    if (layers.empty()) return std::nullopt;
    LoweredShader result;
    for (const Layer& layer : layers)
        result.module.name += (result.module.name.empty() ? "" : "+") + layer.shader->name;
    result.module.loop_budget = options.loop_budget;
    jit::add_function(result.module, "kernel", {});
    jit::Builder builder(result.module, 0);
    if (!KernelWriter(builder, layers, options, diagnostics, result).write()) return std::nullopt;
    builder.finish();
    bool surface = layers.back().shader->kind == ShaderKind::Surface;
    if (surface && options.skip_transparent) compute_opacity_first(result);
    return result;
}

}  // namespace kinora::rsl
