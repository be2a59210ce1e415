// rsl/lower/arrays.h: arrays: as slots, as memory, or as inputs that are only read.
#pragma once

#include <functional>
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
    // A new one of no elements yet that may have so many.
    int add_resizable(const Symbol& symbol, BaseType element, int capacity);
    // One that is only read; `first_inputs` holds the first input of each component.
    int add_inputs(Type type, std::vector<int> first_inputs);

    // Of a resizable array: the most it may have.
    int length(int array) const { return arrays_[size_t(array)].length; }
    BaseType element(int array) const { return arrays_[size_t(array)].element; }
    // The slot of element 0; -1 unless all elements are values.
    int first_slot(int array) const { return arrays_[size_t(array)].first_slot; }
    // ---- resizable arrays: memory, and the length in a slot (a float)

    bool resizable(int array) const { return arrays_[size_t(array)].count_slot >= 0; }
    int count_slot(int array) const { return arrays_[size_t(array)].count_slot; }  // or -1
    Value count(int array);                   // elements, as a float; any array
    bool known_count(int array, int* count);  // at compile time
    void set_count(int array, Value count);
    // floor(count), where the array has room for it; else there is a finding at run time.
    Value limited(int array, Value count, Location where);
    void resize(int array, Value count, Location where);  // new elements are 0
    void push(int array, const Lowered& value, Location where);
    Lowered pop(int array, Location where);
    // So many elements, and their values.
    void fill(int array, Value count, Location where,
              const std::function<Lowered(Value index)>& element);
    // All elements of another array; a resizable one gets its length too.
    void copy(int to, int from, Location where);

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
        int count_slot = -1;      // resizable: how many elements there are
        std::vector<int> memory;  // arrays of the IR, one a component
        std::vector<int> inputs;  // first input of each component: a parameter never written
    };
    bool check_size(const Symbol& symbol, Type type);
    void let_loops_reach(int length);
    // The first `cleared` elements are 0 at first.
    int add_in_memory(const Symbol& symbol, Type type, int cleared);
    template <class Body>
    void for_range(Value first, Value end, Location where, Body&& body);

    Emitter& e_;
    jit::Builder& b_;
    LoweringContext& context_;
    Slots& slots_;
    std::vector<Array> arrays_;
    int64_t bytes_ = 0;  // of them all, for 16 points
    State state_;
};

}  // namespace kinora::rsl
