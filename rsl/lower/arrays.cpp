// rsl/lower/arrays.cpp: arrays: as slots, as memory, or as inputs that are only read.
#include "rsl/lower/arrays.h"

#include <algorithm>
#include <array>

#include "jit/ir/kernel.h"
#include "rsl/lower/values.h"
#include "runtime/base/check.h"

namespace kinora::rsl {

namespace {

// Of all arrays of a module together: each thread has this memory, and nested rays once more.
constexpr int64_t kMostArrayBytes = 16 << 20;

int64_t array_bytes(Type type) {
    return int64_t(type.array_length) * component_count(type.base) * 4 * jit::kMaxLanes;
}

}  // namespace

bool Arrays::check_size(const Symbol& symbol, Type type) {
    constexpr int64_t kMost = 1 << 20;  // docs/decisions.md#strings-and-arrays
    int64_t bytes = array_bytes(type);
    if (bytes > kMost) {
        context_.error(Code::RSL_ARRAY_TOO_LARGE, symbol.span.where, symbol.name, bytes >> 10);
        return false;
    }
    // Of a function that calls itself as many activations as may be.
    if (state_.recursive) bytes *= b_.module().call_depth;
    bool fitted = bytes_ <= kMostArrayBytes;
    bytes_ += bytes;
    if (fitted && bytes_ > kMostArrayBytes)
        context_.error(Code::RSL_ARRAYS_TOO_LARGE, symbol.span.where, symbol.name, bytes_ >> 10,
                       kMostArrayBytes >> 10);
    return bytes_ <= kMostArrayBytes;
}

// A loop over all elements ends by itself, never by the budget: one that stopped halfway would
// leave elements that count as stored and hold anything.
void Arrays::let_loops_reach(int length) {
    int32_t& budget = b_.module().loop_budget;
    budget = std::max(budget, int32_t(length));
}

int Arrays::add_in_memory(const Symbol& symbol, Type type, int cleared) {
    bool fits = check_size(symbol, type);
    Array array;
    array.element = type.base;
    array.length = fits ? std::max(type.array_length, 1) : 1;
    let_loops_reach(array.length);
    for (int c = 0; c < component_count(type.base); ++c)
        array.memory.push_back(
            b_.declare_array(std::string(symbol.name), ir_type(type.base), array.length, cleared));
    arrays_.push_back(std::move(array));
    return int(arrays_.size()) - 1;
}

int Arrays::add(const Symbol& symbol, Type type, bool in_memory) {
    if (in_memory) return add_in_memory(symbol, type, std::max(type.array_length, 1));
    bool fits = check_size(symbol, type);
    Array array;
    array.element = type.base;
    array.length = fits ? std::max(type.array_length, 1) : 1;
    for (int k = 0; k < array.length; ++k) {
        int slot = slots_.add(zero(e_, type.base));
        if (k == 0) array.first_slot = slot;
    }
    arrays_.push_back(std::move(array));
    return int(arrays_.size()) - 1;
}

// Its elements are stored before their number says that they are there. The first is read where
// there is none.
int Arrays::add_resizable(const Symbol& symbol, BaseType element, int capacity) {
    int array = add_in_memory(symbol, {element, std::max(capacity, 1)}, 1);
    arrays_[size_t(array)].count_slot = slots_.add(lowered(BaseType::Float, b_.f(0)));
    return array;
}

Value Arrays::count(int array) {
    const Array& a = arrays_[size_t(array)];
    if (a.count_slot < 0) return b_.f(float(a.length));
    return slots_.live(a.count_slot) ? slots_.read(a.count_slot).c[0] : b_.f(0);
}

bool Arrays::known_count(int array, int* count) {
    float known;
    if (!b_.constant_f(this->count(array), &known)) return false;
    *count = int(known);
    return true;
}

void Arrays::set_count(int array, Value count) {
    slots_.write(arrays_[size_t(array)].count_slot, lowered(BaseType::Float, count));
}

Value Arrays::limited(int array, Value count, Location where) {
    int room = length(array);
    Value whole = b_.floor(count);
    Value fits = b_.logical_and(b_.le(b_.f(0), whole), b_.le(whole, b_.f(float(room))));
    bool known;
    if (!b_.constant_m(fits, &known) || !known)
        b_.fault(b_.fault_site(where, fmt::format("an array of more than {} elements; reserve() "
                                                  "makes room where it is given a number",
                                                  room)),
                 b_.and_not(e_.running, fits));
    return b_.min(b_.max(whole, b_.f(0)), b_.f(float(room)));
}

// body(index) for the elements from `first` up to `end`, floats that may differ between points.
template <class Body>
void Arrays::for_range(Value first, Value end, Location where, Body&& body) {
    constexpr float kUnrolled = 16;
    float from, to;
    if (b_.constant_f(first, &from) && b_.constant_f(end, &to) && to - from <= kUnrolled) {
        for (int k = int(from); k < int(to); ++k) body(b_.i(k));
        return;
    }
    Value last = b_.ftoi(end), begin = b_.ftoi(first);
    Value enter = b_.logical_and(e_.running, b_.op(jit::Op::ILt, begin, last));
    Value inside = b_.begin_loop(enter, b_.fault_site(where, "too many elements of an array"));
    Value index = b_.loop_var(begin);
    Value outer = std::exchange(e_.running, inside);
    body(index);
    Value next = b_.iadd(index, b_.i(1));
    b_.end_loop(b_.logical_and(inside, b_.op(jit::Op::ILt, next, last)), std::array{next});
    e_.running = outer;
}

void Arrays::resize(int array, Value count, Location where) {
    Value old = this->count(array), now = limited(array, count, where);
    for_range(old, now, where, [&](Value k) { store(array, k, zero(e_, element(array))); });
    set_count(array, now);
}

void Arrays::push(int array, const Lowered& value, Location where) {
    Value old = count(array), wanted = b_.add(old, b_.f(1));
    Value now = limited(array, wanted, where);
    Value outer = e_.running;
    e_.running = b_.logical_and(outer, b_.lt(old, now));
    store(array, b_.ftoi(old), value);
    e_.running = outer;
    set_count(array, now);
}

Lowered Arrays::pop(int array, Location where) {
    Value old = count(array), some = b_.lt(b_.f(0), old);
    bool known;
    if (!b_.constant_m(some, &known) || !known)
        b_.fault(b_.fault_site(where, "pop() of an array without elements"),
                 b_.and_not(e_.running, some));
    Value now = b_.max(b_.sub(old, b_.f(1)), b_.f(0));
    Lowered result = load(array, b_.ftoi(now)), none = zero(e_, element(array));
    for (size_t c = 0; c < size_t(result.size()); ++c)
        result.c[c] = b_.select(some, result.c[c], none.c[c]);
    set_count(array, now);
    return result;
}

void Arrays::fill(int array, Value count, Location where,
                  const std::function<Lowered(Value index)>& element) {
    Value now = limited(array, count, where);
    for_range(b_.f(0), now, where, [&](Value k) { store(array, k, element(k)); });
    set_count(array, now);
}

void Arrays::copy(int to, int from, Location where) {
    if (to == from) return;
    Value count = this->count(from);
    Value now = resizable(to) ? limited(to, count, where) : b_.min(count, b_.f(float(length(to))));
    for_range(b_.f(0), now, where, [&](Value k) { store(to, k, load(from, k)); });
    if (resizable(to)) set_count(to, now);
}

int Arrays::add_inputs(Type type, std::vector<int> first_inputs) {
    let_loops_reach(type.array_length);
    arrays_.push_back({type.base, type.array_length, -1, -1, {}, std::move(first_inputs)});
    return int(arrays_.size()) - 1;
}

Lowered Arrays::load(int array, Value index) {
    const Array& a = arrays_[size_t(array)];
    Lowered result{a.element, {}};
    int32_t known = 0;
    bool constant = b_.constant_i(index, &known);
    known = std::clamp(known, 0, a.length - 1);
    if (a.first_slot >= 0) {
        CHECK(constant);
        return slots_.read(a.first_slot + known);
    }
    for (size_t c = 0; c < size_t(result.size()); ++c) {
        if (a.memory.empty() && constant)
            result.c[c] = b_.input(b_.module().inputs[size_t(a.inputs[c] + known)]);
        else if (a.memory.empty())
            result.c[c] = b_.input_gather(a.inputs[c], a.length, index);
        else
            result.c[c] = b_.op(jit::Op::ArrayLoad, index, jit::kNone, jit::kNone, a.memory[c]);
    }
    return result;
}

void Arrays::store(int array, Value index, const Lowered& value) {
    const Array& a = arrays_[size_t(array)];
    int32_t known = 0;
    if (a.first_slot >= 0) {
        CHECK(b_.constant_i(index, &known));
        Lowered element = value;
        element.type = a.element;
        return slots_.write(a.first_slot + std::clamp(known, 0, a.length - 1), element);
    }
    for (size_t c = 0; c < a.memory.size(); ++c)
        b_.op(jit::Op::ArrayStore, index, value.c[c], e_.running, a.memory[c]);
}

}  // namespace kinora::rsl
