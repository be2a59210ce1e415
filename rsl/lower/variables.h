// rsl/lower/variables.h: the variables of the layer that is written: which slot or array each has,
// and what assignments reach.
#pragma once

#include <span>
#include <vector>

#include "rsl/lower/arrays.h"
#include "rsl/lower/context.h"
#include "rsl/lower/inputs.h"
#include "rsl/lower/slots.h"

namespace kinora::rsl {

// Where an l-value is: a slot, or an element of an array; perhaps one component of it.
struct LValue {
    BaseType type = BaseType::Void;  // of the slot or element
    int slot = -1;                   // -1: an element of `array`
    int array = -1;                  // index in Arrays
    Value index = jit::kNone;        // element, int
    Value component = jit::kNone;    // int 0..2, or none: all

    // Is it a whole variable that may stand for this parameter?
    bool lends(const Symbol& parameter) const {
        return slot >= 0 && component == jit::kNone && type == parameter.type.base;
    }
};

class Variables {
  public:
    Variables(Emitter& emitter, LoweringContext& context, Slots& slots, Regions& regions,
              Arrays& arrays, BoundParameters& parameters, Globals& globals, TreeWalk& tree)
        : e_(emitter),
          b_(emitter.b),
          context_(context),
          slots_(slots),
          regions_(regions),
          arrays_(arrays),
          parameters_(parameters),
          globals_(globals),
          tree_(tree) {}

    void enter_layer();  // slots for the symbols of the context's layer

    Lowered read(const Symbol& symbol);
    Lowered parameter(const Symbol& symbol);  // a shader parameter's first value
    // A vertex input that the layer reads and no parameter of it declares.
    Lowered vertex_input(const ParamBinding& bound, BaseType type) {
        return parameters_.bound_value(bound, bound.name, {type, -1}, 0);
    }
    void declare(const Symbol& symbol);
    void end_scope(std::span<Stmt* const> body);
    int slot_of(const Symbol& symbol) const;

    LValue target(const Expr& expr);
    Lowered load(const LValue& t);
    void store(const LValue& t, const Lowered& value);

    int array_of(const Symbol& symbol);
    // Of an array's name whose length may change; -1 for what else an argument may be.
    int resizable_array(const Expr& e);
    Arrays& arrays() { return arrays_; }
    // The value beside a name in a table; 0 if the name is not there.
    Lowered find_named(const NamedTable& table, const std::string& name);
    // How many elements a resizable array has room for.
    int room_for(const Symbol& symbol) const {
        return symbol.type.array_length > 0 ? symbol.type.array_length : capacities_[symbol.id];
    }
    // target = value, both arrays.
    void assign_array(const Symbol& target, const Expr& value);
    int known_array(const Symbol& symbol) const { return state_.array_of[symbol.id]; }  // or -1
    int make_array(const Symbol& symbol, Type type);
    // Room for a resizable argument that a function changes for itself: given back behind the
    // call, and taken again by the next.
    int take_copy(const Symbol& parameter);
    void give_back_copy(const Symbol& parameter, int array);
    std::vector<Lowered> array_values(const Expr& array);  // all elements
    void set_array(const Expr& array, std::span<const Lowered> values);

    // A function's parameter that stands for the caller's variable while its body runs.
    void lend_array(const Symbol& parameter, int array) { state_.array_of[parameter.id] = array; }
    void lend_slot(const Symbol& parameter, int slot) { state_.lent_slot[parameter.id] = slot; }
    bool is_lent(const Symbol& parameter) const { return state_.lent_slot[parameter.id] >= 0; }

    struct State {
        std::vector<int> array_of;   // by Symbol::id, -1: none yet
        std::vector<int> copy_of;    // by Symbol::id, -1: none that is free
        std::vector<int> lent_slot;  // by Symbol::id: an output parameter's argument; -1: its own
    };
    State enter_function();
    void leave_function(State&& outer) { state_ = std::move(outer); }

  private:
    void fill_array(int array, const Expr* initial);
    int parameter_array(const Symbol& symbol);
    void check_index(Value inside, Location where);
    Value element_index(int array, const IndexExpr& e);
    void declare_resizable(const Symbol& symbol);

    Emitter& e_;
    jit::Builder& b_;
    LoweringContext& context_;
    Slots& slots_;
    Regions& regions_;
    Arrays& arrays_;
    BoundParameters& parameters_;
    Globals& globals_;
    TreeWalk& tree_;
    int symbol_base_ = int(Global::Count);  // slot of symbol 0 of this layer's Ast
    std::vector<uint8_t> in_memory_;        // by Symbol::id
    std::vector<int> capacities_;           // by Symbol::id: of resizable arrays
    State state_;
};

}  // namespace kinora::rsl
