// tests/jit/module_difference.h: one module through the interpreter, the passes and every target:
// do they agree?
#pragma once

#include <string>

#include "jit/target.h"
#include "tests/jit/world.h"

namespace kinora::jit::test {

// Inputs, services and records for a seed, on 1 to 37 points.
World world_of(uint64_t seed);

// A loop that nobody needs may go, and its budget's fault (site 0) with it.
void forgive_loop_fault(RunResult& before, const RunResult& after);

// Each gives "" or what is wrong. Code of one target against the interpreter, bit for bit:
std::string target_difference(const Module& module, const Target& target, uint64_t seed);
// The module after all passes, split, on a target, against itself without passes on interp:
std::string optimized_difference(const Module& module, const Target& target, uint64_t seed);
// All of these on all targets the CPU has, and that compiling twice gives the same bytes.
std::string module_difference(const Module& module, uint64_t seed);

}  // namespace kinora::jit::test
