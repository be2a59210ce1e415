// rsl/lower/arrays.h: arrays: as slots, as memory, or as inputs that are only read.
#pragma once

#include <string>
#include <vector>

#include "rsl/lower/context.h"
#include "rsl/lower/slots.h"

namespace kinora::rsl {

// Arrays are named by their index.
class Arrays {
  public:
    Arrays(Emitter& emitter, LoweringContext& context, Slots& slots)
        : e_(emitter), b_(emitter.b), context_(context), slots_(slots) {}

    // A new one of the type, for the symbol, which findings name.
    int add(const Symbol& symbol, Type type, bool in_memory);
    // One that is only read; `first_inputs` holds the first input of each component.
    int add_inputs(Type type, std::vector<int> first_inputs);

    int length(int array) const { return arrays_[size_t(array)].length; }
    BaseType element(int array) const { return arrays_[size_t(array)].element; }
    // The slot of element 0; -1 unless all elements are values.
    int first_slot(int array) const { return arrays_[size_t(array)].first_slot; }
    Lowered load(int array, Value index);
    void store(int array, Value index, const Lowered& value);

    // Inside a function that calls itself an array counts as often as activations may be.
    struct State {
        bool recursive = false;
    };
    State enter_function() { return std::exchange(state_, {true}); }
    void leave_function(State&& outer) { state_ = outer; }

  private:
    struct Array {
        BaseType element = BaseType::Float;
        int length = 0;
        int first_slot = -1;      // elements as values
        std::vector<int> memory;  // arrays of the IR, one a component
        std::vector<int> inputs;  // first input of each component: a parameter never written
    };
    bool check_size(const Symbol& symbol, Type type);

    Emitter& e_;
    jit::Builder& b_;
    LoweringContext& context_;
    Slots& slots_;
    std::vector<Array> arrays_;
    int64_t bytes_ = 0;  // of them all, for 16 points
    State state_;
};

}  // namespace kinora::rsl
