// rsl/lower/variables.cpp: variables as SSA values in slots, arrays, and what assignments reach.
#include <algorithm>

#include "rsl/lower/lower_p.h"

namespace kinora::rsl {

int Lowering::slot_of(const Symbol& symbol) const {
    if (int lent = lent_slot_[symbol.id]; lent >= 0) return lent;
    return symbol.global ? int(symbol.global->id) : symbol_base_ + int(symbol.id);
}

int Lowering::new_slot(const Lowered& value) {
    slots_.push_back({true, value});
    return int(slots_.size()) - 1;
}

void Lowering::write_slot(int slot, const Lowered& value) {
    trail_.push_back({slot, slots_[size_t(slot)]});
    slots_[size_t(slot)] = {true, value};
}

// Ends an If: each slot changed since `mark` becomes inner or outer value by the If's mask. The
// first trail entry of a slot holds the outer value; a slot that had none was declared inside.
void Lowering::merge_changes(size_t mark, Value mask, Value outer_running) {
    ++merge_number_;
    seen_.resize(slots_.size(), 0);
    for (size_t k = mark; k < trail_.size(); ++k) {
        const Undo undo = trail_[k];
        if (seen_[size_t(undo.slot)] == merge_number_) continue;
        seen_[size_t(undo.slot)] = merge_number_;
        Slot& slot = slots_[size_t(undo.slot)];
        if (!undo.old.live) slot.live = false;
        if (!slot.live) continue;
        for (int c = 0; c < slot.value.size(); ++c)
            slot.value.c[size_t(c)] = b.merge(slot.value.c[size_t(c)], undo.old.value.c[size_t(c)]);
    }
    bool none;
    if (running == mask)
        running = outer_running;
    else if (b.constant_m(running, &none) && !none)
        running = b.and_not(outer_running, mask);
    else
        running = b.merge(running, outer_running);
}

Lowered Lowering::zero(BaseType type) {
    Lowered result{type, {}};
    Value none = type == BaseType::String ? b.i(0) : type == BaseType::Bool ? b.m(false) : b.f(0);
    for (int c = 0; c < result.size(); ++c) result.c[size_t(c)] = none;
    return result;
}

Lowered Lowering::read_global(Global id) {
    const Slot& slot = slots_[size_t(id)];
    return slot.live ? slot.value : global_input(id);
}

Lowered Lowering::read(const Symbol& symbol) {
    if (symbol.global) return read_global(symbol.global->id);
    const Slot& slot = slots_[size_t(slot_of(symbol))];
    if (slot.live) return slot.value;
    return symbol.kind == SymbolKind::Parameter ? parameter(symbol) : zero(symbol.type.base);
}

void Lowering::declare(const Symbol& symbol) {
    if (!symbol.type.is_array()) {
        Lowered first = symbol.initial ? expr(*symbol.initial) : zero(symbol.type.base);
        first.type = symbol.type.base;
        write_slot(slot_of(symbol), first);
        return;
    }
    bool fresh = array_of_[symbol.id] < 0;
    int array = fresh ? make_array(symbol, symbol.type) : array_of_[symbol.id];
    if (!fresh || in_loop_ || symbol.initial) fill_array(array, symbol.initial);
}

// Locals end with their block, so that no loop carries them and no If merges them.
void Lowering::end_scope(std::span<Stmt* const> body) {
    for (const Stmt* stmt : body) {
        auto* declare = as_if<DeclareStmt>(stmt);
        if (!declare) continue;
        for (const Symbol* symbol : declare->symbols) {
            int& array = array_of_[symbol->id];
            if (!symbol->type.is_array()) {
                free_slot(slot_of(*symbol));
            } else if (array >= 0 && arrays_[size_t(array)].first_slot >= 0) {
                for (int k = 0; k < arrays_[size_t(array)].length; ++k)
                    free_slot(arrays_[size_t(array)].first_slot + k);
                array = -1;
            }
        }
    }
}

// ---- arrays -------------------------------------------------------------------------------------

namespace {

// Of all arrays of a module together: each thread has this memory, and nested rays once more.
constexpr int64_t kMostArrayBytes = 16 << 20;

int64_t array_bytes(Type type) {
    return int64_t(type.array_length) * component_count(type.base) * 4 * jit::kMaxLanes;
}

}  // namespace

bool Lowering::check_size(const Symbol& symbol, Type type) {
    constexpr int64_t kMost = 1 << 20;  // docs/decisions.md#strings-and-arrays
    int64_t bytes = array_bytes(type);
    if (bytes > kMost) {
        error(Code::RSL_ARRAY_TOO_LARGE, symbol.span.where, symbol.name, bytes >> 10);
        return false;
    }
    // Of a function that calls itself as many activations as may be.
    if (call_depth_ != jit::kNone) bytes *= b.module().call_depth;
    bool fitted = array_bytes_ <= kMostArrayBytes;
    array_bytes_ += bytes;
    if (fitted && array_bytes_ > kMostArrayBytes)
        error(Code::RSL_ARRAYS_TOO_LARGE, symbol.span.where, symbol.name, array_bytes_ >> 10,
              kMostArrayBytes >> 10);
    return array_bytes_ <= kMostArrayBytes;
}

int Lowering::make_array(const Symbol& symbol, Type type) {
    bool fits = check_size(symbol, type);
    Array array;
    array.element = type.base;
    array.length = fits ? std::max(type.array_length, 1) : 1;
    if (in_memory_[symbol.id]) {
        for (int c = 0; c < component_count(type.base); ++c)
            array.memory.push_back(
                b.declare_array(std::string(symbol.name), ir_type(type.base), array.length));
    } else {
        array.first_slot = int(slots_.size());
        for (int k = 0; k < array.length; ++k) new_slot(zero(type.base));
    }
    arrays_.push_back(std::move(array));
    return array_of_[symbol.id] = int(arrays_.size()) - 1;
}

void Lowering::fill_array(int array, const Expr* initial) {
    auto* literal = as_if<ArrayLiteralExpr>(initial);
    std::vector<Lowered> values;
    if (initial && !literal) values = array_values(*initial);
    if (literal)
        for (const Expr* item : literal->items) values.push_back(expr(*item));
    for (int k = 0; k < arrays_[size_t(array)].length; ++k)
        store_element(
            array, b.i(k),
            size_t(k) < values.size() ? values[size_t(k)] : zero(arrays_[size_t(array)].element));
}

// A shader parameter: its inputs where it is only read, else an array filled with them.
int Lowering::parameter_array(const Symbol& symbol) {
    const ParamBinding* bound = binding(symbol.name);
    bool inputs = bound && (bound->kind == ParamBinding::Kind::Frame ||
                            bound->kind == ParamBinding::Kind::Varying);
    Type type = symbol.type;
    if (inputs && !symbol.assigned && in_memory_[symbol.id]) {
        Array array;
        array.element = type.base;
        array.length = type.array_length;
        for (int c = 0; c < component_count(type.base); ++c)
            for (int k = 0; k < array.length; ++k) {
                int declared = b.declare_input(element_input(symbol.name, type.base, *bound, k, c));
                if (k == 0) array.inputs.push_back(declared);
            }
        arrays_.push_back(std::move(array));
        return array_of_[symbol.id] = int(arrays_.size()) - 1;
    }
    int array = make_array(symbol, type);
    if (!bound || bound->kind == ParamBinding::Kind::Default) {
        if (symbol.initial) fill_array(array, symbol.initial);
        return array;
    }
    for (int k = 0; k < arrays_[size_t(array)].length; ++k)
        store_element(array, b.i(k), bound_value(*bound, symbol.name, symbol.type, k));
    return array;
}

int Lowering::array_of(const Symbol& symbol) {
    if (array_of_[symbol.id] >= 0) return array_of_[symbol.id];
    if (symbol.kind == SymbolKind::Parameter) return parameter_array(symbol);
    return make_array(symbol, symbol.type);
}

Lowered Lowering::load_element(int array, Value index) {
    const Array& a = arrays_[size_t(array)];
    Lowered result{a.element, {}};
    int32_t known = 0;
    bool constant = b.constant_i(index, &known);
    known = std::clamp(known, 0, a.length - 1);
    if (a.first_slot >= 0) {
        CHECK(constant);
        return read_slot(a.first_slot + known);
    }
    for (size_t c = 0; c < size_t(result.size()); ++c) {
        if (a.memory.empty() && constant)
            result.c[c] = b.input(b.module().inputs[size_t(a.inputs[c] + known)]);
        else if (a.memory.empty())
            result.c[c] = b.input_gather(a.inputs[c], a.length, index);
        else
            result.c[c] = b.op(jit::Op::ArrayLoad, index, jit::kNone, jit::kNone, a.memory[c]);
    }
    return result;
}

void Lowering::store_element(int array, Value index, const Lowered& value) {
    const Array& a = arrays_[size_t(array)];
    int32_t known = 0;
    if (a.first_slot >= 0) {
        CHECK(b.constant_i(index, &known));
        Lowered element = value;
        element.type = a.element;
        return write_slot(a.first_slot + std::clamp(known, 0, a.length - 1), element);
    }
    for (size_t c = 0; c < a.memory.size(); ++c)
        b.op(jit::Op::ArrayStore, index, value.c[c], running, a.memory[c]);
}

std::vector<Lowered> Lowering::array_values(const Expr& e) {
    std::vector<Lowered> values;
    if (auto* literal = as_if<ArrayLiteralExpr>(&e)) {
        for (const Expr* item : literal->items) values.push_back(expr(*item));
        return values;
    }
    int array = array_of(*as<VariableExpr>(e).symbol);
    for (int k = 0; k < arrays_[size_t(array)].length; ++k)
        values.push_back(load_element(array, b.i(k)));
    return values;
}

void Lowering::set_array(const Expr& e, std::span<const Lowered> values) {
    int array = array_of(*as<VariableExpr>(e).symbol);
    for (size_t k = 0; k < values.size(); ++k) store_element(array, b.i(int(k)), values[k]);
}

// docs/numerics.md#indices: one message for the source line; the access itself is clamped.
void Lowering::check_index(Value x, int length, Location where) {
    Value inside = b.logical_and(b.le(b.f(0), x), b.lt(x, b.f(float(length))));
    Value outside = b.and_not(running, inside);
    for (const Asked& asked : asked_)
        outside = asked.when ? b.logical_and(outside, asked.condition)
                             : b.and_not(outside, asked.condition);
    bool known;
    if (b.constant_m(outside, &known) && !known) return;
    b.fault(b.fault_site(where, "array index out of range"), outside);
}

// ---- targets ------------------------------------------------------------------------------------

Target Lowering::target(const Expr& e) {
    Target t;
    t.type = e.type.base;
    if (auto* variable = as_if<VariableExpr>(&e)) {
        if (variable->symbol->type.is_array()) {
            t.array = array_of(*variable->symbol);
        } else {
            t.slot = slot_of(*variable->symbol);
            // A slot first written under a mask needs its outer value.
            if (!slots_[size_t(t.slot)].live) write_slot(t.slot, read(*variable->symbol));
        }
        return t;
    }
    if (auto* element = as_if<IndexExpr>(&e)) {
        t.array = array_of(*as<VariableExpr>(*element->array).symbol);
        Value x = value(*element->index);
        int length = arrays_[size_t(t.array)].length;
        t.index = index(x, length);
        check_index(x, length, e.span.where);
        return t;
    }
    auto& component = as<ComponentExpr>(e);
    t = target(*component.operand);
    t.component = index(value(*component.index), 3);
    return t;
}

Lowered Lowering::load(const Target& t) {
    Lowered whole = t.slot >= 0 ? slots_[size_t(t.slot)].value : load_element(t.array, t.index);
    if (t.component == jit::kNone) return whole;
    return lowered(BaseType::Float, pick(whole.v3(), t.component));
}

Value Lowering::pick(const V3& v, Value component) {
    int32_t known;
    if (b.constant_i(component, &known)) return v[size_t(std::clamp(known, 0, 2))];
    Value last = b.select(b.op(jit::Op::IEq, component, b.i(1)), v[1], v[2]);
    return b.select(b.op(jit::Op::IEq, component, b.i(0)), v[0], last);
}

void Lowering::store(const Target& t, const Lowered& value) {
    Lowered whole = value;
    whole.type = t.type;
    if (t.component != jit::kNone) {
        Target all = t;
        all.component = jit::kNone;
        whole = load(all);
        for (int c = 0; c < 3; ++c)
            whole.c[size_t(c)] =
                b.select(b.op(jit::Op::IEq, t.component, b.i(c)), value.c[0], whole.c[size_t(c)]);
    }
    if (t.slot >= 0)
        write_slot(t.slot, whole);
    else
        store_element(t.array, t.index, whole);
}

}  // namespace kinora::rsl
