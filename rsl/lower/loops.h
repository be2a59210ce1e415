// rsl/lower/loops.h: loops and what leaves them: a loop carries the slots that ChangeFinder finds
// in its body, and a jump takes its lanes out of `running`.
#pragma once

#include <functional>
#include <vector>

#include "rsl/lower/context.h"
#include "rsl/lower/services.h"
#include "rsl/lower/slots.h"
#include "rsl/lower/variables.h"
#include "rsl/model/changes.h"

namespace kinora::rsl {

class Loops {
  public:
    bool stratifies() const { return seeds_.stratifies(); }
    // How often the next loop that run() makes turns, an int; none: not known.
    void expect_turns(Value turns) { turns_ = turns; }
    Loops(Emitter& emitter, LoweringContext& context, Slots& slots, Regions& regions,
          Arrays& arrays, Variables& variables, SampleSeeds& seeds)
        : e_(emitter),
          b_(emitter.b),
          context_(context),
          slots_(slots),
          regions_(regions),
          arrays_(arrays),
          variables_(variables),
          seeds_(seeds) {}

    // A loop of the source; condition() gives the lanes that go on.
    void run(const Stmt& stmt, const Changes& changes, const std::function<Value()>& condition,
             const std::function<void()>& body, const std::function<void()>& step);
    // The statement's loop over the records of a set: `turn` lowers its body for one.
    void replay(const Stmt& stmt, Value set, const std::function<void(Value record)>& turn);
    // break (`leaves`) or continue of a loop around.
    void jump(const Stmt* loop_stmt, bool leaves);

    // The body of a function in place: returns inside it end here. Its result, or 0.
    Lowered run_function(const Function& f, const std::function<void()>& body);
    // return; `value` is null if there is none.
    void return_from(const Lowered* value);

    // Slots that a statement, or any call of a recursive function, writes beside variables.
    void add_written(const Stmt* stmt, std::vector<int> slots);
    void set_written_by_calls(int slot) { state_.written_by_calls = slot; }

    struct Loop {
        const Stmt* stmt;
        int broken = -1;  // slots of masks, -1 if the loop has no such jump
        int continued = -1;
    };
    struct FunctionFrame {
        const Function* function = nullptr;
        int returned;  // slot of a mask
        int result;    // slot, -1 for void
    };
    struct Written {
        const Stmt* stmt;
        std::vector<int> slots;
    };
    struct State {
        std::vector<Loop> loops;
        std::vector<FunctionFrame> frames;
        std::vector<Written> written;
        int written_by_calls = -1;
    };
    State enter_function() { return std::exchange(state_, {}); }
    void leave_function(State&& outer) { state_ = std::move(outer); }

  private:
    Value turns_ = jit::kNone;  // of expect_turns()

    // The variables that a loop carries: opened right after begin_loop; close() right before
    // end_loop gives their next values, out() after it leaves the last ones in the slots.
    struct Carried {
        std::vector<int> slots;
        std::vector<Value> vars;
    };
    Carried open_carried(std::vector<int> slots);
    void close_carried(const Carried& carried, std::vector<Value>& next);
    void carried_out(const Carried& carried);
    std::vector<int> carried_slots(const Changes& changes);
    Loop begin_jumps(const Stmt& stmt, const Changes& changes);
    // Can a lane that enters the body of the innermost loop fail to reach its end?
    bool leaves_loop(const Changes& changes);
    // `entered` without the lanes that went further out than the loop just closed.
    Value after_loop(const Changes& changes, Value entered);
    int loop_site(const Stmt& stmt);
    Value out_of_rays();

    Emitter& e_;
    jit::Builder& b_;
    LoweringContext& context_;
    Slots& slots_;
    Regions& regions_;
    Arrays& arrays_;
    Variables& variables_;
    SampleSeeds& seeds_;
    State state_;
};

}  // namespace kinora::rsl
