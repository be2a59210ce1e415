// jit/ir/analysis.h: what passes and targets ask about a function.
#pragma once

#include <span>
#include <vector>

#include "jit/ir/ir.h"

namespace kinora::jit {

// Does it answer one int for all lanes, such as the handle of a record set?
inline bool gives_handle(const ServiceInfo& service) {
    return service.results.size() == 1 && service.results[0] == Type::I;
}

// Per value: do all lanes that hold points surely hold the same bits whenever it is computed?
// Conservative (false when not known); parameters and results of services count as false.
std::vector<bool> lanes_agree(const Module& module, const Function& function);

// Per instruction: index of the matching end for If and Loop, of the begin for EndIf and EndLoop,
// kNone for others.
std::vector<Value> match_regions(const Function& function);

// Per function of the module: does a call of it do anything but give results? Loop budgets do not
// count; arrays of its own do not.
std::vector<bool> has_effects(const Module& module);

// Per function: does it call itself, directly or through others?
std::vector<bool> cyclic_functions(const Module& module);

// How often the body of `loop` runs for lanes that enter it, where it goes from one constant to
// another in constant steps; 0 where that is not known, or beyond the loop budget. `next`: the
// arguments of its EndLoop at `end`. Counts as the thread's modes of floats have it (IeeeScope).
int32_t trip_count(std::span<const Inst> insts, std::span<const Value> next, Value loop, Value end,
                   int32_t budget);

// What a run of the kernel stacks up at most, where an activation of function k takes frames[k]:
// its deepest chain of calls, Module::call_depth activations of each circle among them.
size_t deepest_stack(const Module& module, std::span<const size_t> frames);

}  // namespace kinora::jit
