// rsl/lower/calls.h: calls of the source's functions: a body in place of the call, or, for
// functions that call themselves, a function of the IR.
#pragma once

#include <vector>

#include "rsl/lower/arrays.h"
#include "rsl/lower/context.h"
#include "rsl/lower/inputs.h"
#include "rsl/lower/loops.h"
#include "rsl/lower/messages.h"
#include "rsl/lower/records.h"
#include "rsl/lower/services.h"
#include "rsl/lower/slots.h"
#include "rsl/lower/variables.h"

namespace kinora::rsl {

struct CallArguments {
    std::vector<Lowered> values;
    std::vector<LValue> targets;  // of output parameters
    std::vector<int> arrays;      // of array parameters, else -1
};

// Functions that call themselves are functions of the IR (recursion.cpp).
class Recursion {
  public:
    Recursion(Emitter& emitter, LoweringContext& context, SampleSeeds& seeds, Slots& slots,
              Regions& regions, Arrays& arrays, Globals& globals, Variables& variables,
              Loops& loops, LightRecords& lights, Messages& messages, TreeWalk& tree)
        : e_(emitter),
          b_(emitter.b),
          context_(context),
          seeds_(seeds),
          slots_(slots),
          regions_(regions),
          arrays_(arrays),
          globals_(globals),
          variables_(variables),
          loops_(loops),
          lights_(lights),
          messages_(messages),
          tree_(tree) {}

    void enter_layer() { functions_.clear(); }
    Lowered call(const CallExpr& e, const CallArguments& arguments);

  private:
    struct Outside {
        const Symbol* symbol;  // null: a global that no name in the function means
        Global id;             // then
        int array_length;      // -1: no array
        bool written;
    };
    struct Recursive {
        const Function* function;
        std::vector<int> lengths;  // of array parameters, else -1
        bool lit;                  // called from inside illuminance
        size_t index;              // in the module
        std::vector<Outside> outside;
        bool random, record;
    };
    class Activation;

    size_t function_for(const CallExpr& e, const CallArguments& arguments);
    void write(const Recursive& r);
    std::vector<Lowered> read_parameters(BaseType type, int length);
    void find_outside(Recursive& r, const CallExpr& e);
    Lowered read_outside(const Outside& outside);
    int outside_slot(const Outside& outside) const;
    void store_outside(const Outside& outside, const std::vector<Lowered>& values);
    std::vector<Lowered> outside_values(const Outside& outside);
    void set_calls_left(int slot);

    Emitter& e_;
    jit::Builder& b_;
    LoweringContext& context_;
    SampleSeeds& seeds_;
    Slots& slots_;
    Regions& regions_;
    Arrays& arrays_;
    Globals& globals_;
    Variables& variables_;
    Loops& loops_;
    LightRecords& lights_;
    Messages& messages_;
    TreeWalk& tree_;
    std::vector<Recursive> functions_;
    Value depth_ = jit::kNone;  // calls of recursive functions around; none outside them
    int calls_left_ = -1;       // slot: how many more such calls this one may make
};

class Calls {
  public:
    Calls(Emitter& emitter, LoweringContext& context, SampleSeeds& seeds, Slots& slots,
          Arrays& arrays, Variables& variables, Loops& loops, Recursion& recursion, TreeWalk& tree)
        : e_(emitter),
          b_(emitter.b),
          context_(context),
          seeds_(seeds),
          slots_(slots),
          arrays_(arrays),
          variables_(variables),
          loops_(loops),
          recursion_(recursion),
          tree_(tree) {}

    Lowered lower(const CallExpr& e);

  private:
    bool may_grow(const CallExpr& e);
    int array_argument(const CallExpr& e, size_t k);
    void refuse_resizable(const Expr& argument);
    CallArguments evaluate(const CallExpr& e);

    Emitter& e_;
    jit::Builder& b_;
    LoweringContext& context_;
    SampleSeeds& seeds_;
    Slots& slots_;
    Arrays& arrays_;
    Variables& variables_;
    Loops& loops_;
    Recursion& recursion_;
    TreeWalk& tree_;
};

}  // namespace kinora::rsl
