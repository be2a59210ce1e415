// rsl/lower/slots.h: variables as SSA values in slots, and the lanes that run.
//
// A branch (Regions::guarded) runs its body in an If and merges the slots that changed, which a
// trail of old values tells. `running` (Emitter) is the mask of the lanes that execute; break,
// continue and return take lanes out of it, after which the rest of each block stands in an If of
// its own.
#pragma once

#include <utility>
#include <vector>

#include "rsl/lower/math.h"
#include "rsl/model/globals.h"

namespace kinora::rsl {

class Slots {
  public:
    struct Slot {
        bool live = false;
        Lowered value;
    };

    explicit Slots(jit::Builder& builder) : b_(builder) {
        state_.slots.resize(size_t(Global::Count));
    }

    int add(const Lowered& value);
    int add_dead(size_t count);  // the first of so many that hold nothing yet
    const Lowered& read(int slot) const { return state_.slots[size_t(slot)].value; }
    void write(int slot, const Lowered& value);
    bool live(int slot) const { return state_.slots[size_t(slot)].live; }
    void kill(int slot) { state_.slots[size_t(slot)].live = false; }
    // The whole slot, and putting it back: past the trail, so nothing is merged.
    Slot peek(int slot) const { return state_.slots[size_t(slot)]; }
    void restore(int slot, const Slot& old) { state_.slots[size_t(slot)] = old; }

    size_t mark() const { return state_.trail.size(); }
    // Ends an If: each slot changed since `mark` becomes inner or outer value by the If's mask.
    void merge(size_t mark);

    struct Undo {
        int slot;
        Slot old;
    };
    struct State {
        std::vector<Slot> slots;
        std::vector<Undo> trail;
    };
    State enter_function();  // all slots are dead
    void leave_function(State&& outer) { state_ = std::move(outer); }

  private:
    jit::Builder& b_;
    State state_;
    std::vector<int> seen_;  // by slot: the merge that met it last
    int merge_number_ = 0;
};

// The Ifs and Loops around the code that is written.
class Regions {
  public:
    Regions(Emitter& emitter, Slots& slots)
        : e_(emitter), slots_(slots), state_{emitter.running, false, {}} {}

    // Runs body() for the lanes of `mask` (a part of running) and merges what it changed.
    template <class Body>
    void guarded(Value mask, Body&& body);
    // body() where a value is asked for only if `condition` is `when`.
    template <class Body>
    auto asking(Value condition, bool when, Body&& body);
    // The lanes of the mask that ask for the value being computed: only those report faults.
    Value asking_lanes(Value mask);

    bool in_loop() const { return state_.in_loop; }
    // Around a Loop: what enter_loop() gives goes to leave_loop().
    struct Outer {
        Value region;
        bool in_loop;
    };
    Outer enter_loop() { return {state_.region, std::exchange(state_.in_loop, true)}; }
    void set_region(Value mask) { state_.region = mask; }
    void leave_loop(const Outer& outer) {
        state_.in_loop = outer.in_loop;
        state_.region = outer.region;
    }

    // Conditions of ?:, && and || around, whose other side all running lanes compute though not
    // all ask for it.
    struct Asked {
        Value condition;
        bool when;
    };
    struct State {
        // The lanes of the innermost If or Loop. Where a statement begins, running is the same.
        Value region;
        bool in_loop = false;
        std::vector<Asked> asked;
    };
    State enter_function() { return std::exchange(state_, {state_.region, false, {}}); }
    void leave_function(State&& outer) { state_ = std::move(outer); }

  private:
    void merge_running(Value mask, Value outer);

    Emitter& e_;
    Slots& slots_;
    State state_;
};

template <class Body>
void Regions::guarded(Value mask, Body&& body) {
    bool known;
    if (e_.b.constant_m(mask, &known) && !known) return;
    if (mask == state_.region) return body();
    Value outer = e_.running, outer_region = std::exchange(state_.region, mask);
    size_t mark = slots_.mark();
    e_.b.begin_if(mask);
    e_.running = mask;
    body();
    e_.b.end_if();
    state_.region = outer_region;
    slots_.merge(mark);
    merge_running(mask, outer);
}

template <class Body>
auto Regions::asking(Value condition, bool when, Body&& body) {
    state_.asked.push_back({condition, when});
    auto result = body();
    state_.asked.pop_back();
    return result;
}

}  // namespace kinora::rsl
