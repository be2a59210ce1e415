// rsl/lower/slots.cpp: variables as SSA values in slots, and the lanes that run.
#include "rsl/lower/slots.h"

#include <algorithm>

namespace kinora::rsl {

int Slots::add(const Lowered& value) {
    state_.slots.push_back({true, value});
    return int(state_.slots.size()) - 1;
}

int Slots::add_dead(size_t count) {
    size_t first = state_.slots.size();
    state_.slots.resize(first + count);
    return int(first);
}

void Slots::write(int slot, const Lowered& value) {
    state_.trail.push_back({slot, state_.slots[size_t(slot)]});
    state_.slots[size_t(slot)] = {true, value};
}

// The first trail entry of a slot holds the outer value; a slot that had none was declared inside.
void Slots::merge(size_t mark) {
    ++merge_number_;
    seen_.resize(state_.slots.size(), 0);
    for (size_t k = mark; k < state_.trail.size(); ++k) {
        const Undo undo = state_.trail[k];
        if (seen_[size_t(undo.slot)] == merge_number_) continue;
        seen_[size_t(undo.slot)] = merge_number_;
        Slot& slot = state_.slots[size_t(undo.slot)];
        if (!undo.old.live) slot.live = false;
        if (!slot.live) continue;
        for (int c = 0; c < slot.value.size(); ++c)
            slot.value.c[size_t(c)] =
                b_.merge(slot.value.c[size_t(c)], undo.old.value.c[size_t(c)]);
    }
}

Slots::State Slots::enter_function() {
    State outer = state_;
    for (Slot& slot : state_.slots) slot.live = false;
    state_.trail.clear();
    return outer;
}

void Regions::merge_running(Value mask, Value outer) {
    bool none;
    if (e_.running == mask)
        e_.running = outer;
    else if (e_.b.constant_m(e_.running, &none) && !none)
        e_.running = e_.b.and_not(outer, mask);
    else
        e_.running = e_.b.merge(e_.running, outer);
}

Value Regions::asking_lanes(Value mask) {
    for (const Asked& asked : state_.asked)
        mask = asked.when ? e_.b.logical_and(mask, asked.condition)
                          : e_.b.and_not(mask, asked.condition);
    return mask;
}

}  // namespace kinora::rsl
