// rsl/reference/reference.cpp: shaders and their expressions, at one point.
#include "rsl/reference/reference.h"

#include <algorithm>

#include "rsl/model/changes.h"
#include "rsl/model/pairs.h"
#include "rsl/reference/reference_p.h"
#include "rsl/syntax/chain.h"
#include "runtime/base/check.h"

namespace kinora::rsl {

// ---- variables ----------------------------------------------------------------------------------

template <class Real>
auto Reference<Real>::global(Global id) -> Item& {
    auto found = globals_.find(id);
    if (found != globals_.end()) return found->second;
    auto is = [&](ShaderKind kind) { return layer->shader->kind == kind; };
    if (id == Global::Ps && (is(ShaderKind::Surface) || is(ShaderKind::Volume)))
        return global(Global::P);
    found = globals_.emplace(id, first_value(id)).first;
    return found->second;
}

// The variable that an output parameter stands for, or the variable itself.
template <class Real>
const Symbol& Reference<Real>::means(const Symbol& symbol) const {
    auto found = stands_for_.find(&symbol);
    return found == stands_for_.end() ? symbol : *found->second;
}

template <class Real>
auto Reference<Real>::storage(const Symbol& named) -> Storage& {
    const Symbol& symbol = means(named);
    Storage& items = variables_[&symbol];
    size_t length = symbol.type.is_array() ? size_t(symbol.type.array_length) : 1;
    if (items.size() < length) items.resize(length, Item(symbol.type.base));
    return items;
}

template <class Real>
int RefCall<Real>::resizable_room(size_t i) const {
    const auto* named = as_if<VariableExpr>(call.args[i]);
    if (!named || !named->type.is_array() || named->symbol->type.array_length > 0) return 0;
    return array_capacities(*eval.layer->shader->ast)[named->symbol->id];
}
template int RefCall<float>::resizable_room(size_t) const;
template int RefCall<double>::resizable_room(size_t) const;

template <class Real>
void Reference<Real>::declare(const Symbol& symbol) {
    Storage items;
    if (auto* literal = as_if<ArrayLiteralExpr>(symbol.initial)) {
        for (const Expr* e : literal->items) items.push_back(convert(expr(*e), symbol.type.base));
    } else if (symbol.initial && symbol.type.is_array()) {
        items = storage(*as<VariableExpr>(*symbol.initial).symbol);
    } else if (symbol.initial) {
        items.push_back(convert(expr(*symbol.initial), symbol.type.base));
    }
    if (symbol.length) {
        Real wanted = std::floor(expr(*symbol.length).c[0].x);
        Real room = Real(array_capacities(*layer->shader->ast)[symbol.id]);
        if (!(wanted >= 0 && wanted <= room)) ++result.faults;
        wanted = wanted > 0 ? std::min(wanted, room) : Real(0);
        items.resize(size_t(decide(int(wanted))), Item(symbol.type.base));
    }
    variables_[&symbol] = items;
    storage(symbol);  // the rest is 0
    note(symbol);
}

// A float as an index: truncated, clamped (docs/numerics.md#indices). Where numbers near the end of
// the floats lead to it, one precision has infinity or NaN and the other a number.
template <class Real>
size_t Reference<Real>::index(const Expr& e, size_t length) {
    Real x = expr(e).c[0].x;
    Real last = Real(length - 1);
    if (!(x > -1 && x < last + 1)) ++result.faults;
    if (std::abs(x) > Real(1e30)) no_promise();
    return size_t(decide(int(x > 0 ? std::min(x, last) : Real(0))));
}

// Evaluates the indices of a target, each once.
template <class Real>
auto Reference<Real>::lvalue(const Expr& target) -> LValue {
    if (auto* node = as_if<ComponentExpr>(&target)) {
        LValue whole = lvalue(*node->operand);
        whole.component = int(index(*node->index, 3));
        return whole;
    }
    LValue to;
    if (auto* node = as_if<IndexExpr>(&target)) {
        to.symbol = as<VariableExpr>(*node->array).symbol;
        to.at = index(*node->index, std::max<size_t>(storage(*to.symbol).size(), 1));
    } else {
        to.symbol = &means(*as<VariableExpr>(target).symbol);
    }
    return to;
}

template <class Real>
auto Reference<Real>::item(const LValue& from) -> Item& {
    if (from.symbol->global) return global(from.symbol->global->id);
    Storage& items = storage(*from.symbol);
    if (from.at < items.size()) return items[from.at];
    ++result.faults;
    no_element_ = Item(from.symbol->type.base);
    return no_element_;
}

template <class Real>
auto Reference<Real>::load(const LValue& from) -> Item {
    const Item& whole = item(from);
    if (from.component < 0) return whole;
    return {BaseType::Float, whole.c[size_t(from.component)]};
}

template <class Real>
void Reference<Real>::store(const LValue& to, const Item& value) {
    Item& at = item(to);
    if (to.component >= 0)
        at.c[size_t(to.component)] = value.c[0];
    else
        at.c = value.c;
    note(*to.symbol);
}

// ---- expressions --------------------------------------------------------------------------------

template <class Real>
auto Reference<Real>::evaluate(const Expr& e) -> Item {
    switch (e.kind) {
        case ExprKind::Number:
            return {BaseType::Float, Number(Real(as<NumberExpr>(e).value))};
        case ExprKind::String:
            return {BaseType::String, Number(Real(intern(as<StringExpr>(e).value)))};
        case ExprKind::Variable:
        case ExprKind::Index:
            return item(lvalue(e));
        case ExprKind::Component: {
            auto& node = as<ComponentExpr>(e);
            Item whole = expr(*node.operand);
            return {BaseType::Float, whole.c[index(*node.index, 3)]};
        }
        case ExprKind::Unary: {
            auto& node = as<UnaryExpr>(e);
            Item x = expr(*node.operand);
            if (node.op == Op::Not) return {BaseType::Bool, Number(Real(!x.truth()))};
            for (Number& c : x.c) c = -c;
            return x;
        }
        case ExprKind::Binary: {
            Chain<const Expr> chain = chain_of(e);
            Item left = expr(*chain.first);
            for (const Expr* link : chain.links) {
                auto* node = as_if<BinaryExpr>(link);
                left = node ? operated(*node, left) : convert(left, as<CastExpr>(*link).to);
                if (link != &e) note_nan(*link, left);
            }
            return left;
        }
        case ExprKind::Select: {
            auto& node = as<SelectExpr>(e);
            return expr(decide(expr(*node.condition).truth()) ? *node.yes : *node.no);
        }
        case ExprKind::Assign:
            return assign(as<AssignExpr>(e));
        case ExprKind::Call:
            return as<CallExpr>(e).function ? call_function(as<CallExpr>(e))
                                            : call_builtin(as<CallExpr>(e));
        case ExprKind::Cast:
            return cast(as<CastExpr>(e));
        case ExprKind::Triple: {
            Item x(e.type.base);
            for (size_t k = 0; k < 3; ++k) x.c[k] = expr(*as<TripleExpr>(e).items[k]).c[0];
            return x;
        }
        case ExprKind::Sixteen: {
            Item x(BaseType::Matrix);
            for (size_t k = 0; k < 16; ++k) x.c[k] = expr(*as<SixteenExpr>(e).items[k]).c[0];
            return x;
        }
        case ExprKind::ArrayLiteral:
            break;  // only as an initialiser: declare()
    }
    CHECK(false);
    return {};
}

template <class Real>
auto Reference<Real>::operated(const BinaryExpr& e, const Item& left) -> Item {
    bool logical = e.op == Op::And || e.op == Op::Or;
    if (logical && decide(left.truth()) == (e.op == Op::Or)) return left;
    Item r = binary(e.op, left, expr(*e.right));
    if (is_triple(r.type) && is_triple(e.type.base)) r.type = e.type.base;
    return r;
}

template <class Real>
auto Reference<Real>::convert(const Item& x, BaseType to) const -> Item {
    if (x.type == to) return x;
    if (to == BaseType::Bool) return {to, Number(Real(x.c[0].x != 0))};
    Item r(to);
    if (to == BaseType::Matrix)
        for (size_t k = 0; k < 4; ++k) r.c[k * 5] = x.c[0];
    else
        for (size_t k = 0; k < r.size(); ++k) r.c[k] = x.c[is_triple(x.type) ? k : 0];
    return r;
}

template <class Real>
auto Reference<Real>::cast(const CastExpr& e) -> Item {
    Item x = convert(expr(*e.operand), e.to);
    if (!e.space) return x;
    std::string name = expr(*e.space).text();
    if (e.to != BaseType::Color) return by_matrix(x, space(name, "to_current"));
    Vec<Real> c = color_space(vec(x), name, "rgb");
    return {e.to, c[0], c[1], c[2]};
}

template <class Real>
bool Reference<Real>::compare(Op op, const Item& a, const Item& b) {
    bool all = true;
    for (size_t k = 0; k < a.size(); ++k) {
        Real x = a.c[k].x, y = b.c[k].x;
        all = all && (op == Op::Less           ? x < y
                      : op == Op::LessEqual    ? x <= y
                      : op == Op::Greater      ? x > y
                      : op == Op::GreaterEqual ? x >= y
                                               : x == y);
    }
    return decide(op == Op::NotEqual ? !all : all);
}

template <class Real>
auto Reference<Real>::jittered(Item x) -> Item {
    bool number = is_numeric(x.type);
    for (size_t k = 0; in.jitter != 0 && number && k < x.size(); ++k) {
        Real move = next_move();
        if (x.c[k].x == 0) x.c[k].x = std::copysign(Real(0), move);  // x * 0 is 0 or -0
        if (x.c[k].x != std::floor(x.c[k].x)) x.c[k].x *= 1 + move;
        x.c[k].u *= 1 + move, x.c[k].v *= 1 + move;
    }
    return x;
}

template <class Real>
auto Reference<Real>::binary(Op op, const Item& a, const Item& b) -> Item {
    return jittered(operate(op, a, b));
}
template <class Real>
auto Reference<Real>::operate(Op op, const Item& a, const Item& b) -> Item {
    if (op == Op::And) return {BaseType::Bool, Number(Real(a.truth() && b.truth()))};
    if (op == Op::Or) return {BaseType::Bool, Number(Real(a.truth() || b.truth()))};
    if (op >= Op::Less && op <= Op::NotEqual)
        return {BaseType::Bool, Number(Real(compare(op, a, b)))};
    if (op == Op::Dot) return {BaseType::Float, dot(vec(a), vec(b))};
    if (op == Op::Cross) {
        Vec<Real> r = cross(vec(a), vec(b));
        return {BaseType::Vector, r[0], r[1], r[2]};
    }
    if (a.type == BaseType::Matrix && op == Op::Multiply) return by_matrix(a, b.c);
    if (a.type == BaseType::Matrix && op == Op::Divide) return by_matrix(a, inverse(b.c));
    Item r(a.type);
    for (size_t k = 0; k < a.size(); ++k)
        r.c[k] = op == Op::Add        ? a.c[k] + b.c[k]
                 : op == Op::Subtract ? a.c[k] - b.c[k]
                 : op == Op::Multiply ? a.c[k] * b.c[k]
                                      : a.c[k] / b.c[k];
    return r;
}

template <class Real>
auto Reference<Real>::assign(const AssignExpr& e) -> Item {
    if (e.target->type.is_array()) {
        const Symbol& target = *as<VariableExpr>(*e.target).symbol;
        Storage value = storage(*as<VariableExpr>(*e.value).symbol);
        Storage& items = storage(target);
        size_t length = means(target).type.array_length > 0 ? items.size() : value.size();
        items.resize(length, Item(target.type.base));
        std::copy_n(value.begin(), std::min(length, value.size()), items.begin());
        note(means(target));
        return Item(e.target->type.base);
    }
    if (e.op == Op::None) {
        Item value = expr(*e.value);
        store(*e.target, value);
        return value;
    }
    LValue to = lvalue(*e.target);
    Item before = load(to);  // a += b is a = a + b, from left to right
    Item value = binary(e.op, before, expr(*e.value));
    store(to, value);
    return value;
}

// ---- shaders ------------------------------------------------------------------------------------

template <class Real>
void Reference<Real>::output(const KernelKey& first, const Item& value) {
    KernelKey key = first;
    for (size_t k = 0; k < value.size(); ++k) {
        key.component = uint8_t(k);
        result.values[text(key)] = double(value.c[k].x);
    }
}

// Displacements hand N and P to each other and N to surfaces; surfaces lie over those before.
// For displacements that only bend normals: the slopes of P lie in the plane that N is normal to,
// not in the face.
template <class Real>
void Reference<Real>::smooth_P() {
    Item& P = global(Global::P);
    Vec<Real> n = rsl::normalize(vec(global(Global::N)));
    for (Real Number::*slope : {&Number::u, &Number::v}) {
        Real along = 0;
        for (size_t k = 0; k < 3; ++k) along += n[k].x * (P.c[k].*slope);
        for (size_t k = 0; k < 3; ++k) P.c[k].*slope -= n[k].x * along;
    }
}

template <class Real>
void Reference<Real>::bring_back_N() {
    Item &N = global(Global::N), &P = global(Global::P);
    bool same = true, stays = true;
    for (size_t k = 0; k < 3; ++k) {
        same = same && N.c[k].x == given_N_.c[k].x;
        stays = stays && P.c[k].x == given_P_.c[k].x;
    }
    if (same && stays) return void(globals_.erase(Global::N));
    if (same) {  // as true displacement: N of what has moved
        Vec<Real> n = rsl::normalize(normal_of(vec(P)));
        N = {BaseType::Normal, n[0], n[1], n[2]};
    }
    Vec<Real> n = vec(out_of_layer(N));  // as long as it was
    Number size = length(vec(N)) / length(n);
    N = {BaseType::Normal, n[0] * size, n[1] * size, n[2] * size};
}

template <class Real>
void Reference<Real>::run_layer(const Layer& next) {
    const Shader& shader = *next.shader;
    bool displacement = shader.kind == ShaderKind::Displacement;
    if (!displacement && bends_normals()) bring_back_N();
    std::map<Global, Item> kept;
    for (auto& [id, value] : globals_)
        if (id == Global::N || (id == Global::P && displacement)) kept[id] = value;
    globals_ = std::move(kept);
    layer = &next;
    layer_index = size_t(&next - layers_.data());
    inlined.path = inlined.path * 31 + 7;
    if (shader.kind == ShaderKind::Light)
        for (Global id : {Global::L, Global::Cl, Global::Ol})
            globals_[id] = Item(global_info(id).type.base);
    for (const ShaderParameter& p : shader.parameters)
        variables_[p.symbol] =
            p.type.is_array() ? array_parameter(*p.symbol) : Storage{parameter(*p.symbol, -1)};
    ChangeFinder finder(*shader.ast);
    finder.add(shader.definition->body);
    for (const ShaderParameter& p : shader.parameters) finder.add(p.default_value);
    // One record for each illuminate or solar statement.
    for (const Stmt* source : finder.changes.light_sources)
        sources_.push_back(
            {source, Item(BaseType::Vector), Item(BaseType::Color), Item(BaseType::Color), false});
    if (bends_normals() && !globals_.contains(Global::P)) {
        given_N_ = global(Global::N);
        smooth_P();
        given_P_ = global(Global::P);
    }
    if constexpr (kObserved)
        if (in.observer) tell_inputs();
    block(shader.definition->body->body);
    leave_parameters(shader);
    for (const ShaderParameter& p : shader.parameters)
        if (!p.type.is_array()) {
            const Item& value = variables_[p.symbol][0];
            output(aov_key(p.name, -1, form_of(value.type), 0), value);
            output(message_key(p.name, -1, form_of(value.type), 0), value);
        } else if (p.output) {
            const Storage& items = storage(*p.symbol);
            for (size_t k = 0; k < items.size(); ++k)
                output(aov_key(p.name, int(k), form_of(items[k].type), 0), items[k]);
        }
    for (const NamedTable& table : shader.definition->named_tables) {
        const Storage &names = storage(*table.names), &values = storage(*table.values);
        for (size_t k = 0; k < std::min(names.size(), values.size()); ++k)
            if (names[k].c[0].x >= 0)  // beyond the list's length there is no text
                output(aov_key(names[k].text(), -1, form_of(values[k].type), 0), values[k]);
    }
    if (displacement || shader.kind == ShaderKind::Light) return;
    Vec<Real> Ci = vec(global(Global::Ci)), Oi = vec(global(Global::Oi));
    for (size_t k = 0; k < 3 && left_.surface; ++k) {
        Number through = Number(1) - Oi[k];
        Ci[k] = Ci[k] + through * left_.Ci[k];
        Oi[k] = Oi[k] + through * left_.Oi[k];
    }
    left_.Ci = Ci, left_.Oi = Oi, left_.surface = true;
}

// What layers above may be linked to. Other than outputs it is as all layers have it.
template <class Real>
void Reference<Real>::leave_parameters(const Shader& shader) {
    for (const ShaderParameter& p : shader.parameters) {
        Storage items = storage(*p.symbol);
        for (Item& item : items)
            if (!p.output && !p.type.is_array()) item = out_of_layer(item);
        left_.parameters[{layer_index, std::string(p.name)}] = std::move(items);
    }
}

template <class Real>
void Reference<Real>::light_outputs() {
    Item no_L(BaseType::Vector), black(BaseType::Color);
    if (sources_.empty())
        sources_.push_back({nullptr, no_L, global(Global::Cl), global(Global::Ol), true});
    bool only = sources_.size() == 1 && sources_[0].stmt && sources_[0].lit;
    if (only) sources_[0].Cl = global(Global::Cl), sources_[0].Ol = global(Global::Ol);
    for (size_t k = 0; k < sources_.size(); ++k) {
        Item to_light = sources_[k].L;
        for (size_t c = 0; c < 3; ++c) to_light.c[c] = -to_light.c[c];
        output(light_key(k, kLightL), to_light);
        output(light_key(k, kLightCl), sources_[k].Cl);
        output(light_key(k, kLightOl), sources_[k].Ol);
        result.values[text(light_key(k, kLightLit))] = sources_[k].lit;
        output(light_key(k, kLightSpread), sources_[k].spread);
    }
}

template <class Real>
ReferenceResult Reference<Real>::run() {
    const Shader& last = *layers_.back().shader;
    for (const Layer& l : layers_)
        if (!l.done) run_layer(l);
    if (last.kind == ShaderKind::Light) {
        light_outputs();
        return result;
    }
    if (left_.surface) {
        output(global_key(Global::Ci), {BaseType::Color, left_.Ci[0], left_.Ci[1], left_.Ci[2]});
        output(global_key(Global::Oi), {BaseType::Color, left_.Oi[0], left_.Oi[1], left_.Oi[2]});
    }
    if (last.kind == ShaderKind::Imager) output(global_key(Global::alpha), global(Global::alpha));
    output(global_key(Global::N), global(Global::N));
    output(global_key(Global::P), global(Global::P));
    return result;
}

template <class Real>
ReferenceResult run_reference(std::span<const Layer> layers, const ReferenceInputs& inputs) {
    if (layers.empty()) return {};
    return Reference<Real>(layers, inputs).run();
}

std::optional<ConstantValue> evaluate_constant(const Expr& expr) {
    ReferenceInputs nothing;
    Reference<float> reference({}, nothing);
    RefValue<float> value = reference.expr(expr);
    if (!reference.result.missing.empty()) return {};
    if (value.type == BaseType::String) return ConstantValue{{}, {value.text()}, false};
    ConstantValue constant;
    for (size_t k = 0; k < value.size(); ++k) constant.numbers.push_back(value.c[k].x);
    return constant;
}

#define KINORA_REFERENCE_METHODS(Real)                                         \
    template auto Reference<Real>::evaluate(const Expr&)->Item;                \
    template auto Reference<Real>::convert(const Item&, BaseType) const->Item; \
    template auto Reference<Real>::global(Global)->Item&;                      \
    template auto Reference<Real>::storage(const Symbol&)->Storage&;           \
    template auto Reference<Real>::jittered(Item)->Item;                       \
    template const Symbol& Reference<Real>::means(const Symbol&) const;        \
    template void Reference<Real>::declare(const Symbol&);                     \
    template auto Reference<Real>::lvalue(const Expr&)->LValue;                \
    template void Reference<Real>::store(const LValue&, const Item&);
KINORA_REFERENCE_METHODS(float)
KINORA_REFERENCE_METHODS(double)

template ReferenceResult run_reference<float>(std::span<const Layer>, const ReferenceInputs&);
template ReferenceResult run_reference<double>(std::span<const Layer>, const ReferenceInputs&);

}  // namespace kinora::rsl
