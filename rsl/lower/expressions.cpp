// rsl/lower/expressions.cpp: expressions and calls as IR values.
#include <fmt/format.h>

#include "rsl/lower/lower_p.h"
#include "rsl/model/pairs.h"

namespace kinora::rsl {

namespace {

// Positions of instructions: an expression's own is back after its operands are written.
class PositionScope {
  public:
    PositionScope(Lowering& low, Location where, Location& current)
        : low_(low), current_(current), before_(current) {
        low_.b.set_location(current_ = where);
    }
    ~PositionScope() { low_.b.set_location(current_ = before_); }

  private:
    Lowering& low_;
    Location& current_;
    Location before_;
};

}  // namespace

Lowered Lowering::expr(const Expr& e) {
    PositionScope position(*this, e.span.where, where_);
    switch (e.kind) {
        case ExprKind::Number:
            return lowered(BaseType::Float, b.f(float(as<NumberExpr>(e).value)));
        case ExprKind::String:
            return lowered(BaseType::String, b.i(intern(as<StringExpr>(e).value)));
        case ExprKind::Variable:
            return read(*as<VariableExpr>(e).symbol);
        case ExprKind::Index:
            return load(target(e));
        case ExprKind::Component: {
            auto& node = as<ComponentExpr>(e);
            V3 v = expr(*node.operand).v3();
            return lowered(BaseType::Float, pick(v, index(value(*node.index), 3)));
        }
        case ExprKind::Unary: {
            auto& node = as<UnaryExpr>(e);
            Lowered x = expr(*node.operand);
            for (int c = 0; c < x.size(); ++c)
                x.c[size_t(c)] =
                    node.op == Op::Not ? b.logical_not(x.c[size_t(c)]) : b.neg(x.c[size_t(c)]);
            return x;
        }
        case ExprKind::Binary:
            return sum(as<BinaryExpr>(e));
        case ExprKind::Select:
            return select_expr(as<SelectExpr>(e));
        case ExprKind::Assign:
            return assign(as<AssignExpr>(e));
        case ExprKind::Call:
            return as<CallExpr>(e).function ? call_function(as<CallExpr>(e))
                                            : call_builtin(as<CallExpr>(e));
        case ExprKind::Cast:
            return cast(as<CastExpr>(e));
        case ExprKind::Triple: {
            Lowered x{e.type.base, {}};
            for (size_t c = 0; c < 3; ++c) x.c[c] = value(*as<TripleExpr>(e).items[c]);
            return x;
        }
        case ExprKind::Sixteen: {
            Lowered x{BaseType::Matrix, {}};
            for (size_t c = 0; c < 16; ++c) x.c[c] = value(*as<SixteenExpr>(e).items[c]);
            return x;
        }
        case ExprKind::ArrayLiteral:
            break;  // only an initialiser: fill_array
    }
    CHECK(false);
    return {};
}

// ---- conversions --------------------------------------------------------------------------------

Lowered Lowering::convert(const Lowered& x, BaseType to) {
    if (x.type == to) return x;
    if (to == BaseType::Bool) return lowered(to, b.ne(x.c[0], b.f(0)));
    Value s = x.type == BaseType::Bool ? flag(x.c[0]) : x.c[0];
    if (to == BaseType::Matrix) {
        Lowered m = zero(BaseType::Matrix);
        for (size_t k = 0; k < 4; ++k) m.c[k * 5] = s;
        return m;
    }
    if (is_triple(to) && is_triple(x.type)) return lowered(to, x.v3());
    if (is_triple(to)) return lowered(to, V3{s, s, s});
    return lowered(to, s);
}

Lowered Lowering::cast(const CastExpr& e) {
    Lowered x = convert(expr(*e.operand), e.to);
    if (!e.space) return x;
    Value name = value(*e.space);
    if (e.to != BaseType::Color) return to_current(x, space(name, e.space->span.where));
    if (const std::string* text = constant_text(name))
        return color_space(x, *text, "rgb", e.space->span.where);
    error(Code::RSL_STRING_NOT_CONSTANT, e.space->span.where, "color");
    return x;
}

const std::string* Lowering::constant_text(Value string_id) {
    int32_t id;
    return b.constant_i(string_id, &id) ? &interned(id) : nullptr;
}

// ---- arithmetic ---------------------------------------------------------------------------------

Value Lowering::compare(Op op, const Lowered& x, const Lowered& y) {
    if (x.type == BaseType::String) {
        Value same = b.op(jit::Op::IEq, x.c[0], y.c[0]);
        return op == Op::NotEqual ? b.logical_not(same) : same;
    }
    if (x.type == BaseType::Bool) {
        Value differ = b.op(jit::Op::MXor, x.c[0], y.c[0]);
        return op == Op::NotEqual ? differ : b.logical_not(differ);
    }
    Value all = b.m(true);
    for (size_t c = 0; c < size_t(x.size()); ++c) {
        Value one = op == Op::Less           ? b.lt(x.c[c], y.c[c])
                    : op == Op::LessEqual    ? b.le(x.c[c], y.c[c])
                    : op == Op::Greater      ? b.gt(x.c[c], y.c[c])
                    : op == Op::GreaterEqual ? b.ge(x.c[c], y.c[c])
                                             : b.eq(x.c[c], y.c[c]);
        all = b.logical_and(all, one);
    }
    return op == Op::NotEqual ? b.logical_not(all) : all;
}

Lowered Lowering::binary(Op op, const Lowered& x, const Lowered& y) {
    if (op == Op::And) return lowered(BaseType::Bool, b.logical_and(x.c[0], y.c[0]));
    if (op == Op::Or) return lowered(BaseType::Bool, b.logical_or(x.c[0], y.c[0]));
    if (op >= Op::Less && op <= Op::NotEqual) return lowered(BaseType::Bool, compare(op, x, y));
    if (op == Op::Dot) return lowered(BaseType::Float, dot(x.v3(), y.v3()));
    if (op == Op::Cross) return lowered(BaseType::Vector, cross(x.v3(), y.v3()));
    if (x.type == BaseType::Matrix && op == Op::Multiply) return multiply(x, y);
    if (x.type == BaseType::Matrix && op == Op::Divide) return multiply(x, invert(y));
    Lowered r = x;
    for (size_t c = 0; c < size_t(x.size()); ++c)
        r.c[c] = op == Op::Add        ? b.add(x.c[c], y.c[c])
                 : op == Op::Subtract ? b.sub(x.c[c], y.c[c])
                 : op == Op::Multiply ? mul(x.c[c], y.c[c])
                                      : div(x.c[c], y.c[c]);
    return r;
}

// Is `e` a product of floats or triples (perhaps a float one, spread to `type`)? Then its factors.
bool Lowering::as_product(const Expr& e, BaseType type, Lowered& x, Lowered& y) {
    if (auto* c = as_if<CastExpr>(&e); c && c->implicit && !c->space) {
        if (!as_product(*c->operand, c->operand->type.base, x, y)) return false;
        x = convert(x, type);
        y = convert(y, type);
        return true;
    }
    auto* product = as_if<BinaryExpr>(&e);
    if (!product || product->op != Op::Multiply || type == BaseType::Matrix) return false;
    x = expr(*product->left);
    y = expr(*product->right);
    return true;
}

// a * b + c of one expression rounds once (docs/decisions.md#exact-arithmetic).
Lowered Lowering::sum(const BinaryExpr& e) {
    if (e.op == Op::And || e.op == Op::Or) return logical_expr(e);
    bool sums = e.op == Op::Add || e.op == Op::Subtract;
    Lowered x, y;
    if (sums && as_product(*e.left, e.type.base, x, y)) {
        Lowered z = expr(*e.right), r{e.type.base, {}};
        for (size_t c = 0; c < size_t(r.size()); ++c)
            r.c[c] = fma(x.c[c], y.c[c], e.op == Op::Add ? z.c[c] : b.neg(z.c[c]));
        return r;
    }
    Lowered left = expr(*e.left);
    Lowered r = sums ? sum_of(e.op, left, *e.right) : binary(e.op, left, expr(*e.right));
    if (is_triple(e.type.base) && is_triple(r.type)) r.type = e.type.base;
    return r;
}

// left + right or left - right, where right may be a product.
Lowered Lowering::sum_of(Op op, const Lowered& left, const Expr& right) {
    Lowered x, y;
    if (!as_product(right, left.type, x, y)) return binary(op, left, expr(right));
    Lowered r = left;
    for (size_t c = 0; c < size_t(r.size()); ++c)
        r.c[c] = fma(op == Op::Add ? x.c[c] : b.neg(x.c[c]), y.c[c], left.c[c]);
    return r;
}

// Sides that call functions run only for their lanes; other sides are cheaper computed for all.
bool Lowering::runs_apart(std::initializer_list<const Expr*> sides, uint32_t effects) const {
    ChangeFinder finder(ast());
    for (const Expr* side : sides) finder.add(side);
    const Changes& changes = finder.changes;
    return !changes.symbols.empty() || (changes.effects & effects) || changes.calls;
}

// && and ||: the right side is asked for where the left one does not tell.
Lowered Lowering::logical_expr(const BinaryExpr& e) {
    bool asked_when = e.op == Op::And;
    Value left = value(*e.left);
    bool known;
    if (b.constant_m(left, &known))
        return known == asked_when ? expr(*e.right) : lowered(BaseType::Bool, left);
    if (!runs_apart({e.right}, kService | kLights | kTraces | kPrints)) {
        Value right = asking(left, asked_when, [&] { return value(*e.right); });
        return binary(e.op, lowered(BaseType::Bool, left), lowered(BaseType::Bool, right));
    }
    int slot = new_slot(lowered(BaseType::Bool, left));
    Value asked = asked_when ? b.logical_and(running, left) : b.and_not(running, left);
    guarded(asked, [&] { write_slot(slot, lowered(BaseType::Bool, value(*e.right))); });
    free_slot(slot);
    return read_slot(slot);
}

Lowered Lowering::select_expr(const SelectExpr& e) {
    Value condition = value(*e.condition);
    bool known;
    if (b.constant_m(condition, &known)) return expr(known ? *e.yes : *e.no);
    Lowered r = zero(e.type.base);
    if (!runs_apart({e.yes, e.no}, ~0u)) {
        Lowered yes = asking(condition, true, [&] { return expr(*e.yes); });
        Lowered no = asking(condition, false, [&] { return expr(*e.no); });
        for (size_t c = 0; c < size_t(r.size()); ++c)
            r.c[c] = b.select(condition, yes.c[c], no.c[c]);
        return r;
    }
    int slot = new_slot(r);
    Value before = running;
    guarded(b.logical_and(before, condition), [&] { write_slot(slot, expr(*e.yes)); });
    guarded(b.and_not(before, condition), [&] { write_slot(slot, expr(*e.no)); });
    free_slot(slot);
    return read_slot(slot);
}

Lowered Lowering::assign(const AssignExpr& e) {
    if (e.target->type.is_array()) {
        auto values = array_values(*e.value);
        int array = array_of(*as<VariableExpr>(*e.target).symbol);
        for (size_t k = 0; k < values.size(); ++k) store_element(array, b.i(int(k)), values[k]);
        return zero(e.target->type.base);
    }
    Lowered result;
    if (e.op == Op::None) {
        result = expr(*e.value);
        store(target(*e.target), result);
        return result;
    }
    Target t = target(*e.target);
    Lowered before = load(t);  // a += b is a = a + b, from left to right
    bool sums = e.op == Op::Add || e.op == Op::Subtract;
    result = sums ? sum_of(e.op, before, *e.value) : binary(e.op, before, expr(*e.value));
    store(t, result);
    return result;
}

// ---- calls --------------------------------------------------------------------------------------

void Lowering::report_idle_pair(std::string_view callee, std::string_view name,
                                const Lowered& value, Location where) {
    const std::string* text = value.type == BaseType::String ? constant_text(value.c[0]) : nullptr;
    if (is_idle_option(callee, name, text)) report(Code::RSL_PAIR_IDLE, where, name, callee);
}

Lowered Lowering::call_builtin(const CallExpr& e) {
    LowerCall call{
        *this, b,  e,  {},
        {},    {}, {}, zero(e.type.base == BaseType::Void ? BaseType::Float : e.type.base)};
    size_t plain = e.signature->pairs ? std::min<size_t>(e.pairs, e.args.size()) : e.args.size();
    auto& declared = e.signature->arguments;
    for (size_t k = 0; k < plain; ++k) {
        bool output = k < declared.size() && declared[k].output;
        bool array = e.args[k]->type.is_array();
        call.targets.push_back(output && !array ? target(*e.args[k]) : Target{});
        call.args.push_back(array    ? Lowered{}
                            : output ? load(call.targets.back())
                                     : expr(*e.args[k]));
    }
    for (size_t k = plain; k + 1 < e.args.size(); k += 2) {
        const std::string* name = constant_text(value(*e.args[k]));
        if (name && is_output_pair(e, k + 1))
            call.output_pairs.push_back({*name, target(*e.args[k + 1])});
        else if (name && !e.args[k + 1]->type.is_array()) {
            call.pairs.push_back({*name, expr(*e.args[k + 1])});
            report_idle_pair(e.name, *name, call.pairs.back().second, e.args[k]->span.where);
        }
    }
    e.builtin->lower(call);
    return call.result;
}

void LowerCall::set_output(int i, const Lowered& value) {
    low.store(targets[size_t(i)], value);
}

const std::string* LowerCall::text(int i) const {
    const std::string* text = low.constant_text(args[size_t(i)].c[0]);
    if (!text)
        low.error(Code::RSL_STRING_NOT_CONSTANT, call.args[size_t(i)]->span.where, call.name);
    return text;
}

bool LowerCall::has_pair(std::string_view name) const {
    for (auto& [key, value] : pairs)
        if (key == name) return true;
    return false;
}

Value LowerCall::pair(std::string_view name, float otherwise) const {
    CHECK(takes_option(call.name, name));
    for (auto& [key, value] : pairs)
        if (key == name && value.type != BaseType::String) return value.c[0];
    return b.f(otherwise);
}

Value LowerCall::text_pair(std::string_view name) const {
    CHECK(takes_option(call.name, name));
    for (auto& [key, value] : pairs)
        if (key == name && value.type == BaseType::String) return value.c[0];
    return b.i(0);
}

void LowerCall::report_unknown_pairs() const {
    for (size_t k = call.pairs; k + 1 < call.args.size(); k += 2) {
        std::string_view key = pair_name(call.args, k + 1);
        if (!takes_option(call.name, key) && !is_output_pair(call, k + 1))
            low.report(Code::RSL_PAIR_UNKNOWN, call.args[k]->span.where, key, call.name);
    }
}

Target* LowerCall::output_pair(std::string_view name) {
    for (auto& [key, target] : output_pairs)
        if (key == name) return &target;
    return nullptr;
}

// Whether there is room for one more body in place of a call: functions that call others twice
// double at each level.
bool Lowering::may_grow(const CallExpr& e) {
    constexpr size_t kMostOperations = 1 << 18;
    size_t operations = 0;
    for (const jit::Function& function : b.module().functions) operations += function.insts.size();
    if (operations > kMostOperations && !failed)
        error(Code::RSL_TOO_LARGE, e.span.where, kMostOperations);
    return !failed;
}

// The body in place of the call. A variable that is an output argument is the parameter while the
// body runs; elements and components are copied in and out. Other parameters are values.
Lowered Lowering::call_function(const CallExpr& e) {
    const Function& f = *e.function;
    if (!may_grow(e)) return zero(e.type.base == BaseType::Void ? BaseType::Float : e.type.base);
    CallArguments arguments{std::vector<Lowered>(e.args.size()), std::vector<Target>(e.args.size()),
                            std::vector<int>(e.args.size(), -1)};
    auto& [values, targets, arrays] = arguments;
    for (size_t k = 0; k < e.args.size(); ++k) {
        const Symbol& parameter = *f.parameters[k];
        if (parameter.type.is_array()) {
            arrays[k] =
                f.recursive ? array_of(*as<VariableExpr>(*e.args[k]).symbol) : array_argument(e, k);
        } else if (parameter.output) {
            targets[k] = target(*e.args[k]);
            values[k] = load(targets[k]);
        } else {
            values[k] = expr(*e.args[k]);
        }
    }
    if (f.recursive) return call_recursive(e, arguments);
    for (size_t k = 0; k < e.args.size(); ++k) {
        const Symbol& parameter = *f.parameters[k];
        if (arrays[k] >= 0) {
            array_of_[parameter.id] = arrays[k];
        } else if (targets[k].lends(parameter)) {
            lent_slot_[parameter.id] = targets[k].slot;
        } else {
            values[k].type = parameter.type.base;
            write_slot(slot_of(parameter), values[k]);
        }
    }
    uint32_t path = inline_path, factor = path_factor;
    enter_path(e.site);
    Lowered result = run_function(f);
    inline_path = path;
    path_factor = factor;
    for (size_t k = 0; k < e.args.size(); ++k) {
        const Symbol& parameter = *f.parameters[k];
        if (arrays[k] >= 0) {
            array_of_[parameter.id] = -1;
        } else if (lent_slot_[parameter.id] >= 0) {
            lent_slot_[parameter.id] = -1;
        } else {
            Slot& slot = slots_[size_t(slot_of(parameter))];
            if (parameter.output) store(targets[k], slot.value);
            slot.live = false;
        }
    }
    return result;
}

// An array handed to a function: itself, or a copy where the function writes to a value parameter
// or to the same array by another name.
int Lowering::array_argument(const CallExpr& e, size_t k) {
    auto symbol = [&](const Expr* argument) {
        auto* variable = as_if<VariableExpr>(argument);
        return variable ? variable->symbol : nullptr;
    };
    const Expr& argument = *e.args[k];
    const Symbol& parameter = *e.function->parameters[k];
    bool written = parameter.assigned;
    for (size_t i = 0; i < e.args.size(); ++i)
        written |= e.function->parameters[i]->output && symbol(e.args[i]) == symbol(&argument);
    int array = array_of(*symbol(&argument));
    if (parameter.output || !written) return array;
    std::vector<Lowered> values = array_values(argument);
    int copy = make_array(parameter, {parameter.type.base, int(values.size())});
    for (size_t i = 0; i < values.size(); ++i) store_element(copy, b.i(int(i)), values[i]);
    return copy;
}

Lowered Lowering::run_function(const Function& f) {
    Value entered = running;
    FunctionFrame frame{&f, new_slot(lowered(BaseType::Bool, b.m(false))), -1};
    if (f.result.base != BaseType::Void) frame.result = new_slot(zero(f.result.base));
    frames_.push_back(frame);
    std::vector<Loop> outer_loops;
    outer_loops.swap(loops_);  // jumps do not leave a function
    block(f.body->body);
    outer_loops.swap(loops_);
    frames_.pop_back();
    running = entered;
    free_slot(frame.returned);
    if (frame.result < 0) return zero(BaseType::Float);
    free_slot(frame.result);
    return read_slot(frame.result);
}

}  // namespace kinora::rsl
