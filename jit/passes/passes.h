// jit/passes/passes.h: the passes, and the order in which they run.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "jit/ir/ir.h"

namespace kinora::jit {

// The passes, one file each, in the order optimize() runs them; hoist() comes before schedule(),
// dce again between. Each takes a verified module and leaves a verified one with the same meaning.
void differentiate(Module& module);         // Du, Dv -> dual numbers for the values that reach them
void inline_calls(Module& module);          // one call site or under 40 instructions
void dce(Module& module);                   // what nothing needs
void fold(Module& module);                  // constants and exact identities
void unmask_uniform_loops(Module& module);  // loops of a known trip count that all lanes enter
void cse(Module& module);       // equal pure values once; loop-invariant ones before loops
bool fuse(Module& module);      // loops over the same records, Ifs of one mask; true if any
void schedule(Module& module);  // what a loop's next round begins with, as soon as it can be
// Splits frame-rate work off: returns the frame kernel (all its outputs are frame block slots, all
// its inputs frame inputs), leaving `module` with FrameLoads and point inputs only.
Module hoist(Module& module);

// All of them in order. With `frame` given, frame-rate work is split off into it. `dumps`, if
// given, receives a (stage, text) pair after each pass.
void optimize(Module& module, Module* frame,
              std::vector<std::pair<std::string, std::string>>* dumps = nullptr);

}  // namespace kinora::jit
