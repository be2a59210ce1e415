// rsl/lower/lower.cpp: a stack of checked shaders to one module of IR: layers, outputs, opacity.
#include "rsl/lower/lower.h"

#include <algorithm>

#include "rsl/lower/lower_p.h"

namespace kinora::rsl {

namespace {

// Writes the whole kernel: the layers in order, then the outputs.
class Stack {
  public:
    Stack(Lowering& lowering, std::span<const Layer> layers) : low_(lowering), layers_(layers) {}

    void run() {
        for (const Layer& layer : layers_) layer.done ? declare_layer(layer) : run_layer(layer);
        if (low_.failed) return;
        if (layers_.back().shader->kind == ShaderKind::Light)
            low_.light_outputs();
        else
            write_outputs();
        write_named_outputs();
    }

  private:
    void declare_layer(const Layer& layer) {
        low_.layer_index = size_t(&layer - layers_.data());
        low_.declare_layer(layer);
    }

    // Displacements pass P and N on among themselves; surfaces see N as it was left, and the
    // original P: bent normals, not moved points (docs/decisions.md#joined-layers).
    void run_layer(const Layer& layer) {
        bool displacement = layer.shader->kind == ShaderKind::Displacement ||
                            layer.shader->kind == ShaderKind::Transformation;
        for (size_t g = 0; g < size_t(Global::Count); ++g) low_.kill(Global(g));
        if (!displacement) bring_back();
        low_.layer = &layer;
        low_.layer_index = size_t(&layer - layers_.data());
        if (have_N_) low_.write_slot(int(Global::N), N_);
        if (have_P_ && displacement) low_.write_slot(int(Global::P), P_);
        // Volumes and imagers go on with what the one before them left.
        bool behind = low_.kind() == ShaderKind::Volume || low_.kind() == ShaderKind::Imager;
        if (behind && have_surface_) {
            low_.write_slot(int(Global::Ci), lowered(BaseType::Color, Ci_));
            low_.write_slot(int(Global::Oi), lowered(BaseType::Color, Oi_));
            if (low_.kind() == ShaderKind::Imager)
                low_.write_slot(int(Global::alpha), lowered(BaseType::Float, alpha_));
            have_surface_ = false;
        }
        low_.run_layer(layer);
        if (low_.failed) return;
        left_N_ = low_.read_global(Global::N);
        if (displacement) {
            N_ = left_N_, P_ = low_.read_global(Global::P);
            have_N_ = have_P_ = true;
            bends_ = low_.bends_normals() ? &layer : nullptr;
        } else if (layer.shader->kind != ShaderKind::Light) {
            composite();
        }
    }

    // N and P of displacements that bend normals, for the surfaces: in the kernel's current.
    void bring_back() {
        if (!bends_) return;
        const Layer* surface = std::exchange(low_.layer, std::exchange(bends_, nullptr));
        bool same_N = N_.c == low_.given_N.c, same_P = P_.c == low_.given_P.c;
        if (same_N && !same_P) {  // as true displacement: N of what has moved
            N_ = lowered(BaseType::Normal, low_.normalize(low_.normal_of(P_.v3())));
            same_N = false;
        }
        if (!same_N) {
            V3 N = low_.out_of_layer(N_).v3();
            Value as_long = low_.div(low_.length(N_.v3()), low_.length(N));
            N_ = lowered(BaseType::Normal, low_.scale(N, as_long));
        }
        if (!same_P) P_ = low_.out_of_layer(P_);
        low_.layer = surface;
        have_N_ = !same_N, have_P_ = !same_P;
    }

    // The new layer over those before: Ci is premultiplied by Oi.
    void composite() {
        V3 Ci = low_.read_global(Global::Ci).v3(), Oi = low_.read_global(Global::Oi).v3();
        if (have_surface_) {
            for (size_t c = 0; c < 3; ++c) {
                Value through = low_.b.sub(low_.f(1), Oi[c]);
                Ci[c] = low_.fma(through, Ci_[c], Ci[c]);
                Oi[c] = low_.fma(through, Oi_[c], Oi[c]);
            }
        }
        if (low_.kind() == ShaderKind::Imager) alpha_ = low_.read_global(Global::alpha).c[0];
        Ci_ = Ci, Oi_ = Oi, have_surface_ = true;
    }

    void output(const std::string& name, BaseType type, const Lowered& value) {
        for (int c = 0; c < component_count(type); ++c)
            low_.b.output({name + component_suffix(type, c),
                           type == BaseType::String ? jit::Type::I : jit::Type::F},
                          value.c[size_t(c)]);
    }

    void write_outputs() {
        if (have_surface_) {
            low_.out.opacity = opacity();
            if (low_.options.want_Ci) output("Ci", BaseType::Color, lowered(BaseType::Color, Ci_));
            if (low_.options.want_Oi) output("Oi", BaseType::Color, lowered(BaseType::Color, Oi_));
        }
        if (alpha_ != jit::kNone) low_.b.output({"alpha", jit::Type::F}, alpha_);
        low_.out.moves_P = have_P_ && !low_.is_input(P_.v3(), "P");
        low_.out.bends_N = have_N_ && !low_.is_input(N_.v3(), "N");
        if (low_.options.want_N) output("N", BaseType::Normal, left_N_);
        if (low_.options.want_P)
            output("P", BaseType::Point, have_P_ ? P_ : low_.global_input(Global::P));
    }

    // Output parameters wanted by the film or by lightsource(): the topmost layer's.
    void write_named_outputs() {
        auto write = [&](const std::string& prefix, const std::vector<std::string>& names) {
            for (const std::string& name : names) {
                auto found = std::find_if(low_.messages.rbegin(), low_.messages.rend(),
                                          [&](auto& message) { return message.name == name; });
                if (found == low_.messages.rend()) continue;
                std::vector<Lowered> values = low_.message_values(*found);
                for (size_t k = 0; k < values.size(); ++k)
                    output(prefix + name +
                               (found->type.is_array() ? "[" + std::to_string(k) + "]" : ""),
                           values[k].type, values[k]);
            }
        };
        write("aov:", low_.options.aovs);
        write("message:", low_.options.messages);
    }

    LoweredShader::Opacity opacity() {
        using Opacity = LoweredShader::Opacity;
        std::vector<jit::Rate> rates = value_rates();
        jit::Rate rate = jit::Rate::Constant;
        bool ones = true;
        for (Value v : Oi_) {
            rate = std::max(rate, rates[v]);
            float x;
            ones = ones && low_.b.constant_f(v, &x) && x == 1;
        }
        if (ones) return Opacity::Opaque;
        return rate == jit::Rate::Point ? Opacity::Computed : Opacity::Constant;
    }

    // Rates of all values so far; what a loop carries or a call gives counts as point rate.
    std::vector<jit::Rate> value_rates() {
        const jit::Function& f = low_.b.function();
        std::vector<jit::Rate> rates(f.insts.size(), jit::Rate::Constant);
        for (size_t k = 0; k < f.insts.size(); ++k) {
            const jit::Inst& inst = f.insts[k];
            const jit::OpInfo& info = jit::op_info(inst.op);
            jit::Rate& rate = rates[k];
            if (inst.op == jit::Op::Input || inst.op == jit::Op::InputGather)
                rate = low_.b.module().inputs[size_t(inst.imm)].rate;
            else if (inst.op == jit::Op::Merge)
                rate = rates[f.insts[size_t(inst.imm)].a];
            else if (!(info.flags & jit::kPure))
                rate = jit::Rate::Point;
            for (Value operand : {inst.a, inst.b, inst.c})
                if (operand != jit::kNone && operand < k) rate = std::max(rate, rates[operand]);
        }
        return rates;
    }

    Lowering& low_;
    std::span<const Layer> layers_;
    Lowered N_, P_;  // as the displacements left them
    bool have_N_ = false, have_P_ = false;
    Lowered left_N_;
    const Layer* bends_ = nullptr;  // the last layer, if it is one whose current is the object's
    V3 Ci_{}, Oi_{};
    Value alpha_ = jit::kNone;  // imagers
    bool have_surface_ = false;
};

}  // namespace

void Lowering::enter_layer() {
    symbol_base_ = int(slots_.size());
    slots_.resize(slots_.size() + ast().symbol_count);
    array_of_.assign(ast().symbol_count, -1);
    lent_slot_.assign(ast().symbol_count, -1);
    in_memory_ = memory_arrays(ast());
    inline_path = inline_path * 31 + 7;
    recursive_.clear();
}

void Lowering::declare_layer(const Layer& next) {
    for (size_t g = 0; g < size_t(Global::Count); ++g) kill(Global(g));
    layer = &next;
    enter_layer();
    for (const ShaderParameter& p : next.shader->parameters)
        if (!p.type.is_array())
            messages.push_back(
                {next.shader->kind, std::string(p.name), p.type, parameter(*p.symbol), -1});
}

void Lowering::run_layer(const Layer& next) {
    const Shader& shader = *next.shader;
    enter_layer();

    ChangeFinder finder(ast());
    finder.add(shader.definition->body);
    for (const ShaderParameter& parameter : shader.parameters) finder.add(parameter.default_value);
    if (bends_normals() && !live(Global::P)) {
        given_N = global_input(Global::N);
        given_P = smooth_P(given_N);
        write_slot(int(Global::N), given_N);
        write_slot(int(Global::P), given_P);
    }
    // What is written has a value from the start, so that every If can merge it.
    for (const Symbol* symbol : finder.changes.symbols)
        if (symbol->global && !live(symbol->global->id))
            write_slot(int(symbol->global->id), global_input(symbol->global->id));
    if (shader.kind == ShaderKind::Light) begin_light(finder.changes);
    for (const ShaderParameter& parameter : shader.parameters) {
        bool used = std::find(finder.used.begin(), finder.used.end(), parameter.symbol) !=
                    finder.used.end();
        if (!used && !parameter.output) continue;
        if (parameter.type.is_array())
            array_of(*parameter.symbol);
        else
            write_slot(slot_of(*parameter.symbol), this->parameter(*parameter.symbol));
    }
    block(shader.definition->body->body);
    for (const ShaderParameter& parameter : shader.parameters) {
        Message message{shader.kind, std::string(parameter.name), parameter.type, {}, -1};
        bool last = layer == &layers.back() && options.messages.empty() && options.aovs.empty();
        if (!parameter.type.is_array())
            message.value =
                parameter.output ? read(*parameter.symbol) : out_of_layer(read(*parameter.symbol));
        else if (last)
            continue;  // nobody is left to ask
        else
            message.array = array_of(*parameter.symbol);
        messages.push_back(std::move(message));
    }
}

std::vector<Lowered> Lowering::message_values(const Message& message) {
    if (message.array < 0) return {message.value};
    std::vector<Lowered> values;
    for (int k = 0; k < message.type.array_length; ++k)
        values.push_back(load_element(message.array, b.i(k)));
    return values;
}

std::optional<LoweredShader> lower(std::span<const Layer> layers, const LowerOptions& options,
                                   Diagnostics& diagnostics) {
    if (layers.empty()) return std::nullopt;
    LoweredShader result;
    for (const Layer& layer : layers)
        result.module.name += (result.module.name.empty() ? "" : "+") + layer.shader->name;
    jit::add_function(result.module, "kernel", {});
    jit::Builder builder(result.module, 0);
    Lowering lowering(builder, options, diagnostics, result);
    lowering.layers = layers;
    Stack(lowering, layers).run();
    if (lowering.failed) return std::nullopt;
    builder.finish();
    return result;
}

// ---- what decides a kernel's shape --------------------------------------------------------------

namespace {

// Follows uniform values from parameters into conditions, through the variables between.
class ShapeWalk {
  public:
    explicit ShapeWalk(const Shader& shader) : sources_(shader.ast->symbol_count) {
        visit(shader.definition->body);
        for (const Function* function : shader.functions) visit(function->body);
        std::vector<const Symbol*> open(conditions_.begin(), conditions_.end());
        reached.resize(shader.ast->symbol_count);
        while (!open.empty()) {
            const Symbol* symbol = open.back();
            open.pop_back();
            if (std::exchange(reached[symbol->id], 1)) continue;
            auto& from = sources_[symbol->id];
            open.insert(open.end(), from.begin(), from.end());
        }
    }

    std::vector<uint8_t> reached;  // by Symbol::id

  private:
    template <class F>
    void for_each_variable(const Expr& e, F&& f) {
        if (auto* variable = as_if<VariableExpr>(&e)) f(variable->symbol);
        for_each_operand(e, [&](const Expr* operand) { for_each_variable(*operand, f); });
    }

    void condition(const Expr* e) {
        if (!e || e->rate == Rate::Varying) return;
        for_each_variable(*e, [&](const Symbol* symbol) { conditions_.push_back(symbol); });
    }

    void flows(const Expr& from, const Symbol* to) {
        for_each_variable(from, [&](const Symbol* s) { sources_[to->id].push_back(s); });
    }

    void visit(const Stmt* stmt) {
        for_each_part(
            *stmt, [&](const Expr* e) { visit(e); }, [&](const Stmt* part) { visit(part); });
        if (auto* node = as_if<IfStmt>(stmt)) condition(node->condition);
        if (auto* node = as_if<WhileStmt>(stmt)) condition(node->condition);
        if (auto* node = as_if<ForStmt>(stmt)) condition(node->condition);
        if (auto* node = as_if<DeclareStmt>(stmt))
            for (const Symbol* symbol : node->symbols)
                if (symbol->initial) flows(*symbol->initial, symbol);
    }

    void visit(const Expr* e) {
        for_each_operand(*e, [&](const Expr* operand) { visit(operand); });
        if (auto* node = as_if<SelectExpr>(e)) condition(node->condition);
        if (auto* node = as_if<AssignExpr>(e)) {
            for_each_variable(*node->target,
                              [&](const Symbol* symbol) { flows(*node->value, symbol); });
        }
        auto* call = as_if<CallExpr>(e);
        if (!call || !call->function) return;
        for (size_t k = 0; k < call->args.size(); ++k)
            flows(*call->args[k], call->function->parameters[k]);
    }

    std::vector<std::vector<const Symbol*>> sources_;  // by Symbol::id
    std::vector<const Symbol*> conditions_;
};

}  // namespace

std::vector<bool> shape_parameters(const Shader& shader) {
    ShapeWalk walk(shader);
    std::vector<bool> result;
    for (const ShaderParameter& parameter : shader.parameters)
        result.push_back(parameter.type.base == BaseType::String ||
                         walk.reached[parameter.symbol->id]);
    return result;
}

}  // namespace kinora::rsl
