// jit/codegen/module_code_p.h: what every code generator needs to know of a module as a whole.
#pragma once

#include <chrono>
#include <deque>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "jit/codegen/function_code_p.h"
#include "jit/codegen/unwind.h"
#include "jit/ir/ir.h"
#include "jit/ir/kernel.h"

namespace kinora::jit {

// Functions that the kernel calls, directly or not, callers first; the kernel is the first.
std::vector<size_t> reached_functions(const Module& module);

// What is decided about a module before its code is written.
struct PlannedModule {
    PlannedModule(const Module& module, const CodeRules& rules);

    std::deque<FunctionCode> functions;  // those reached
    bool fits = true;               // false: a frame is too large for code, which is not written
    bool uses_valid_lanes = false;  // something asks which lanes of a group hold points
    size_t stack_bytes = 0;         // of all frames that are in use at once
    // For tests: "" if the register allocations are proven right.
    std::string check() const;
};

// What a code generator has written, and what it takes to run it.
struct FinishedCode {
    std::span<const uint8_t> bytes;  // entry first
    size_t scratch_bytes;
    std::vector<CodeLine> lines;
    UnwindWriter unwind;
    std::chrono::steady_clock::time_point begun;
    bool runs_here;  // false: other machines' code, made to be looked at
};

// The kernel over a copy of the code in executable memory; null if that cannot be had.
std::shared_ptr<Kernel> finish_kernel(const Module& module, const char* target, FinishedCode code);

// An instruction as listings name it.
std::string text_of(const Function& function, Value at, bool fused);

// Code from `offset` on comes from `where`; offsets rise from call to call.
void note_line(std::vector<CodeLine>& lines, size_t offset, const Location& where);

}  // namespace kinora::jit
