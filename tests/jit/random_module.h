// tests/jit/random_module.h: random well-formed modules for differential tests.
#pragma once

#include <cstdint>
#include <random>

#include "jit/ir/ir.h"

namespace kinora::jit::test {

// Chances out of 100 of what comes next; the rest are pure ops.
struct RandomPolicy {
    const char* name;
    int ifs;
    int loops;
    int calls;
    int services;
    int arrays;
    int records;
    int masks;      // pure ops that give or take masks
    int hashed;     // values that the output hash keeps alive to the end
    int functions;  // besides the kernel
};
extern const RandomPolicy kPolicies[];
extern const int kPolicyCount;

// The same module for the same arguments on every machine. About `size` instructions in the kernel.
// Obeys the rules of ir.h: masks of effects are subsets of the running mask, NaNs reach no int op,
// results of calls are used in the lanes of their mask only. Uses the inputs, services and record
// sets of a World (world.h).
Module random_module(uint64_t seed, const RandomPolicy& policy, int size);

// The same program with Du and Dv of values all over it, two of which become the outputs "du" and
// "dv" after the others; inputs have partials.
Module with_derivatives(const Module& module, uint64_t seed);

// Floats at the edges: zeros, denormals, limits, infinities, NaN, halves, powers of two.
extern const float kEdgeFloats[];
extern const int kEdgeFloatCount;
extern const int32_t kEdgeInts[];
extern const int kEdgeIntCount;

}  // namespace kinora::jit::test
