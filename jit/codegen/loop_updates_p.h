// jit/codegen/loop_updates_p.h: the order in which a loop's variables get their next values.
#pragma once

#include <vector>

#include "jit/codegen/function_code_p.h"

namespace kinora::jit {

// A step of giving a loop's variables their next values.
struct LoopUpdate {
    Value variable;
    Value next;        // kNone: keep the variable's old value in a swap row instead
    int swap_row = 0;  // 0 or 1
};

// What the EndLoop of `loop` does to its variables. All change at once, and the mask with them: a
// variable is written when no other still reads it, and a cycle is broken by keeping one old value
// in memory.
std::vector<LoopUpdate> loop_updates(const FunctionCode& code, Value loop);

}  // namespace kinora::jit
