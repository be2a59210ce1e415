// jit/module_code_p.h: what every code generator needs to know of a module as a whole.
#pragma once

#include <vector>

#include "jit/ir.h"
#include "jit/target.h"

namespace kinora::jit {

// Functions that the kernel calls, directly or not, callers first; the kernel is the first.
std::vector<size_t> reached_functions(const Module& module);

// Tells callers of the kernel about the module; everything but the code.
void describe(const Module& module, const char* target, Kernel& kernel);

// Code from `offset` on comes from `where`; offsets rise from call to call.
void note_place(std::vector<CodePlace>& places, size_t offset, const Location& where);

}  // namespace kinora::jit
