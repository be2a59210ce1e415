// jit/analysis.h: what passes and targets ask about a function.
#pragma once

#include <vector>

#include "jit/ir.h"

namespace kinora::jit {

// Per value: do all lanes that hold points surely hold the same bits whenever it is computed?
// Conservative (false when not known); parameters and results of services count as false.
std::vector<bool> lanes_agree(const Module& module, const Function& function);

// Per instruction: index of the matching end for If and Loop, of the begin for EndIf and EndLoop,
// kNone for others.
std::vector<Value> match_regions(const Function& function);

// Per function of the module: does a call of it do anything but give results? Loop budgets do not
// count; arrays of its own do not.
std::vector<bool> has_effects(const Module& module);

}  // namespace kinora::jit
