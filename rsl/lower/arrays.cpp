// rsl/lower/arrays.cpp: arrays: as slots, as memory, or as inputs that are only read.
#include "rsl/lower/arrays.h"

#include <algorithm>

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

int Arrays::add(const Symbol& symbol, Type type, bool in_memory) {
    bool fits = check_size(symbol, type);
    Array array;
    array.element = type.base;
    array.length = fits ? std::max(type.array_length, 1) : 1;
    if (in_memory) {
        for (int c = 0; c < component_count(type.base); ++c)
            array.memory.push_back(
                b_.declare_array(std::string(symbol.name), ir_type(type.base), array.length));
    } else {
        for (int k = 0; k < array.length; ++k) {
            int slot = slots_.add(zero(e_, type.base));
            if (k == 0) array.first_slot = slot;
        }
    }
    arrays_.push_back(std::move(array));
    return int(arrays_.size()) - 1;
}

int Arrays::add_inputs(Type type, std::vector<int> first_inputs) {
    arrays_.push_back({type.base, type.array_length, -1, {}, std::move(first_inputs)});
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
