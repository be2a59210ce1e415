// rsl/lower/variables.cpp: the variables of a layer, arrays by name, and what assignments reach.
#include "rsl/lower/variables.h"

#include <algorithm>
#include <utility>

#include "rsl/lower/values.h"
#include "rsl/model/changes.h"

namespace kinora::rsl {

void Variables::enter_layer() {
    symbol_base_ = slots_.add_dead(context_.ast().symbol_count);
    state_.array_of.assign(context_.ast().symbol_count, -1);
    state_.copy_of.assign(context_.ast().symbol_count, -1);
    state_.lent_slot.assign(context_.ast().symbol_count, -1);
    in_memory_ = memory_arrays(context_.ast());
    capacities_ = array_capacities(context_.ast());
}

Variables::State Variables::enter_function() {
    State outer = state_;
    std::fill(state_.array_of.begin(), state_.array_of.end(), -1);
    std::fill(state_.copy_of.begin(), state_.copy_of.end(), -1);
    std::fill(state_.lent_slot.begin(), state_.lent_slot.end(), -1);
    return outer;
}

int Variables::slot_of(const Symbol& symbol) const {
    if (int lent = state_.lent_slot[symbol.id]; lent >= 0) return lent;
    return symbol.global ? int(symbol.global->id) : symbol_base_ + int(symbol.id);
}

Lowered Variables::read(const Symbol& symbol) {
    if (symbol.global) return globals_.read(symbol.global->id);
    int slot = slot_of(symbol);
    if (slots_.live(slot)) return slots_.read(slot);
    return symbol.kind == SymbolKind::Parameter ? parameter(symbol) : zero(e_, symbol.type.base);
}

Lowered Variables::parameter(const Symbol& symbol) {
    const ParamBinding* bound = context_.binding(symbol.name);
    if (bound && bound->kind != ParamBinding::Kind::Default)
        return parameters_.bound_value(*bound, symbol.name, symbol.type, 0);
    if (!symbol.initial) return zero(e_, symbol.type.base);
    Lowered result = tree_.expr(*symbol.initial);
    result.type = symbol.type.base;
    return result;
}

void Variables::declare(const Symbol& symbol) {
    if (!symbol.type.is_array()) {
        Lowered first = symbol.initial ? tree_.expr(*symbol.initial) : zero(e_, symbol.type.base);
        first.type = symbol.type.base;
        slots_.write(slot_of(symbol), first);
        return;
    }
    if (symbol.resizable) return declare_resizable(symbol);
    bool fresh = state_.array_of[symbol.id] < 0;
    int array = fresh ? make_array(symbol, symbol.type) : state_.array_of[symbol.id];
    if (!fresh || regions_.in_loop() || symbol.initial) fill_array(array, symbol.initial);
}

void Variables::declare_resizable(const Symbol& symbol) {
    int array = array_of(symbol);
    arrays_.set_count(array, b_.f(0));
    if (symbol.length) arrays_.resize(array, tree_.value(*symbol.length), symbol.span.where);
    if (symbol.initial) assign_array(symbol, *symbol.initial);
}

void Variables::assign_array(const Symbol& target, const Expr& value) {
    int to = array_of(target);
    if (auto* variable = as_if<VariableExpr>(&value)) {
        int from = array_of(*variable->symbol);
        if (arrays_.resizable(to) || arrays_.resizable(from))
            return arrays_.copy(to, from, value.span.where);
    }
    std::vector<Lowered> values = array_values(value);
    for (size_t k = 0; k < values.size(); ++k) arrays_.store(to, b_.i(int(k)), values[k]);
    if (arrays_.resizable(to)) arrays_.set_count(to, b_.f(float(values.size())));
}

Lowered Variables::find_named(const NamedTable& table, const std::string& name) {
    int names = array_of(*table.names), values = array_of(*table.values);
    Value count = arrays_.count(names), wanted = b_.i(intern(name));
    b_.begin_loop(b_.lt(b_.f(0), count),
                  b_.fault_site(table.names->span.where, "too many outputs of a shader"));
    Value turn = b_.loop_var(b_.i(0));
    Lowered found = zero(e_, arrays_.element(values));
    for (size_t c = 0; c < size_t(found.size()); ++c) found.c[c] = b_.loop_var(found.c[c]);
    std::vector<Value> next{b_.iadd(turn, b_.i(1))};
    Lowered kept = arrays_.load(values, turn);
    Value here = b_.op(jit::Op::IEq, arrays_.load(names, turn).c[0], wanted);
    for (size_t c = 0; c < size_t(found.size()); ++c)
        next.push_back(b_.select(here, kept.c[c], found.c[c]));
    b_.end_loop(b_.lt(b_.itof(next[0]), count), next);
    for (size_t c = 0; c < size_t(found.size()); ++c) found.c[c] = b_.loop_out(found.c[c]);
    return found;
}

// Locals end with their block, so that no loop carries them and no If merges them.
void Variables::end_scope(std::span<Stmt* const> body) {
    for (const Stmt* stmt : body) {
        auto* declare = as_if<DeclareStmt>(stmt);
        if (!declare) continue;
        for (const Symbol* symbol : declare->symbols) {
            if (symbol->kept) continue;
            int& array = state_.array_of[symbol->id];
            if (!symbol->type.is_array()) {
                slots_.kill(slot_of(*symbol));
            } else if (array >= 0 && arrays_.resizable(array)) {
                slots_.kill(arrays_.count_slot(array));
            } else if (array >= 0 && arrays_.first_slot(array) >= 0) {
                for (int k = 0; k < arrays_.length(array); ++k)
                    slots_.kill(arrays_.first_slot(array) + k);
                array = -1;
            }
        }
    }
}

// ---- arrays -------------------------------------------------------------------------------------

int Variables::make_array(const Symbol& symbol, Type type) {
    int capacity = std::max(capacities_[symbol.id], type.array_length);
    bool resizable = symbol.resizable || (type.array_length == 0 && capacities_[symbol.id] > 0);
    return state_.array_of[symbol.id] = resizable
                                            ? arrays_.add_resizable(symbol, type.base, capacity)
                                            : arrays_.add(symbol, type, in_memory_[symbol.id]);
}

int Variables::take_copy(const Symbol& parameter) {
    int free = std::exchange(state_.copy_of[parameter.id], -1);
    return free >= 0 ? free : make_array(parameter, parameter.type);
}

void Variables::give_back_copy(const Symbol& parameter, int array) {
    slots_.kill(arrays_.count_slot(array));
    state_.copy_of[parameter.id] = array;
}

void Variables::fill_array(int array, const Expr* initial) {
    auto* literal = as_if<ArrayLiteralExpr>(initial);
    std::vector<Lowered> values;
    if (initial && !literal) values = array_values(*initial);
    if (literal)
        for (const Expr* item : literal->items) values.push_back(tree_.expr(*item));
    for (int k = 0; k < arrays_.length(array); ++k)
        arrays_.store(
            array, b_.i(k),
            size_t(k) < values.size() ? values[size_t(k)] : zero(e_, arrays_.element(array)));
}

// A shader parameter: its inputs where it is only read, else an array filled with them.
int Variables::parameter_array(const Symbol& symbol) {
    const ParamBinding* bound = context_.binding(symbol.name);
    bool inputs = bound && (bound->kind == ParamBinding::Kind::Frame ||
                            bound->kind == ParamBinding::Kind::Varying);
    Type type = symbol.type;
    if (inputs && !symbol.assigned && in_memory_[symbol.id]) {
        std::vector<int> first_inputs;
        for (int c = 0; c < component_count(type.base); ++c)
            for (int k = 0; k < type.array_length; ++k) {
                int declared = b_.declare_input(
                    parameters_.element_input(symbol.name, type.base, *bound, k, c));
                if (k == 0) first_inputs.push_back(declared);
            }
        return state_.array_of[symbol.id] = arrays_.add_inputs(type, std::move(first_inputs));
    }
    int array = make_array(symbol, type);
    if (!bound || bound->kind == ParamBinding::Kind::Default) {
        if (symbol.initial) fill_array(array, symbol.initial);
        return array;
    }
    for (int k = 0; k < arrays_.length(array); ++k)
        arrays_.store(array, b_.i(k), parameters_.bound_value(*bound, symbol.name, symbol.type, k));
    return array;
}

int Variables::array_of(const Symbol& symbol) {
    if (state_.array_of[symbol.id] >= 0) return state_.array_of[symbol.id];
    if (symbol.kind == SymbolKind::Parameter) return parameter_array(symbol);
    return make_array(symbol, symbol.type);
}

int Variables::resizable_array(const Expr& e) {
    const auto* named = as_if<VariableExpr>(&e);
    if (!named || !e.type.is_array()) return -1;
    int array = array_of(*named->symbol);
    return arrays_.resizable(array) ? array : -1;
}

std::vector<Lowered> Variables::array_values(const Expr& e) {
    std::vector<Lowered> values;
    if (auto* literal = as_if<ArrayLiteralExpr>(&e)) {
        for (const Expr* item : literal->items) values.push_back(tree_.expr(*item));
        return values;
    }
    const Symbol& symbol = *as<VariableExpr>(e).symbol;
    int array = array_of(symbol), count = 0;
    if (!arrays_.known_count(array, &count))
        context_.error(Code::RSL_LENGTH_UNKNOWN, e.span.where, symbol.name);
    for (int k = 0; k < count; ++k) values.push_back(arrays_.load(array, b_.i(k)));
    return values;
}

void Variables::set_array(const Expr& e, std::span<const Lowered> values) {
    int array = array_of(*as<VariableExpr>(e).symbol);
    for (size_t k = 0; k < values.size(); ++k) arrays_.store(array, b_.i(int(k)), values[k]);
}

// docs/numerics.md#indices: one message for the source line; the access itself is clamped.
void Variables::check_index(Value inside, Location where) {
    Value outside = regions_.asking_lanes(b_.and_not(e_.running, inside));
    bool known;
    if (b_.constant_m(outside, &known) && !known) return;
    b_.fault(b_.fault_site(where, "array index out of range"), outside);
}

Value Variables::element_index(int array, const IndexExpr& e) {
    Value x = tree_.value(*e.index);
    Value index;
    if (arrays_.resizable(array)) {
        Value count = arrays_.count(array);
        Value last = b_.max(b_.sub(count, b_.f(1)), b_.f(0));
        index = b_.ftoi(b_.min(b_.max(x, b_.f(0)), last));
        check_index(b_.logical_and(b_.le(b_.f(0), x), b_.lt(x, count)), e.span.where);
    } else {
        float length = float(arrays_.length(array));
        index = e_.index(x, arrays_.length(array));
        check_index(b_.logical_and(b_.le(b_.f(0), x), b_.lt(x, b_.f(length))), e.span.where);
    }
    return index;
}

// ---- targets ------------------------------------------------------------------------------------

LValue Variables::target(const Expr& e) {
    LValue t;
    t.type = e.type.base;
    if (auto* variable = as_if<VariableExpr>(&e)) {
        if (variable->symbol->type.is_array()) {
            t.array = array_of(*variable->symbol);
        } else {
            t.slot = slot_of(*variable->symbol);
            // A slot first written under a mask needs its outer value.
            if (!slots_.live(t.slot)) slots_.write(t.slot, read(*variable->symbol));
        }
        return t;
    }
    if (auto* element = as_if<IndexExpr>(&e)) {
        t.array = array_of(*as<VariableExpr>(*element->array).symbol);
        t.index = element_index(t.array, *element);
        return t;
    }
    auto& component = as<ComponentExpr>(e);
    t = target(*component.operand);
    t.component = e_.index(tree_.value(*component.index), 3);
    return t;
}

Lowered Variables::load(const LValue& t) {
    Lowered whole = t.slot >= 0 ? slots_.read(t.slot) : arrays_.load(t.array, t.index);
    if (t.component == jit::kNone) return whole;
    return lowered(BaseType::Float, pick(e_, whole.v3(), t.component));
}

void Variables::store(const LValue& t, const Lowered& value) {
    Lowered whole = value;
    whole.type = t.type;
    if (t.component != jit::kNone) {
        LValue all = t;
        all.component = jit::kNone;
        whole = load(all);
        for (int c = 0; c < 3; ++c)
            whole.c[size_t(c)] = b_.select(b_.op(jit::Op::IEq, t.component, b_.i(c)), value.c[0],
                                           whole.c[size_t(c)]);
    }
    if (t.slot >= 0)
        slots_.write(t.slot, whole);
    else
        arrays_.store(t.array, t.index, whole);
}

}  // namespace kinora::rsl
