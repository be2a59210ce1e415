// jit/passes/passes.h: the passes, and the order in which they run.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "jit/ir/ir.h"

namespace kinora::jit {

// The passes, one file each, in the order optimize() runs them; hoist() comes before schedule(),
// dce again between. Each takes a verified module and leaves a verified one with the same meaning.
// docs/ir.md has the comments below (scripts/docs_ir.py).
//
// replaces Du and Dv by dual numbers for the values that reach them
void differentiate(Module& module);
// Values that it made derivatives of, since the process began.
size_t derivative_values();
// inlines functions with one call site or under 40 instructions
void inline_calls(Module& module);
// removes what nothing needs
void dce(Module& module);
// evaluates constants and exact identities
void fold(Module& module);
// removes the mask of loops with a known trip count that all lanes enter
void unmask_uniform_loops(Module& module);
// computes equal pure values once, and loop-invariant ones before the loop
void cse(Module& module);
// joins loops over the same records, and neighboring Ifs of one mask; true if there were any
bool fuse(Module& module);
// computes what a loop's next round begins with as early as possible
void schedule(Module& module);
// splits frame-rate work off into the frame kernel, which it returns: frame inputs to slots of the
// frame block, which `module` then reads as FrameLoads
Module hoist(Module& module);

// All of them in order. With `frame` given, frame-rate work is split off into it. `dumps`, if
// given, receives a (stage, text) pair after each pass.
void optimize(Module& module, Module* frame,
              std::vector<std::pair<std::string, std::string>>* dumps = nullptr);

}  // namespace kinora::jit
