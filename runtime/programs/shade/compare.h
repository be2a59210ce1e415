// runtime/programs/shade/compare.h: a run's outputs against another way to get them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "runtime/programs/shade/kernel.h"

namespace kinora {

// Prints how far the outputs of `kernel` are from the interpreter's, bit for bit.
void compare_with_interpreter(const ShadeStack& stack, const Patch& patch,
                              const ShadeKernel& kernel, Diagnostics& diagnostics);

// What rsl/reference/reference.h gives in double precision, at no more than 4096 points spread over
// the patch.
struct ReferencePoint {
    size_t index = 0;                      // of the patch
    std::map<std::string, double> values;  // by kernel output name
};
struct ReferenceRun {
    std::string missing;                  // a built-in without a reference; then nothing was run
    std::vector<ReferencePoint> points;   // where float and double decide alike
    size_t undecided = 0;                 // points where they branch or floor differently
    std::vector<std::string> unfiltered;  // services that it reads without a filter
};
ReferenceRun run_over_reference(const ShadeStack& stack, const Patch& patch,
                                const ShadeKernel& kernel);

// Prints how far the outputs are from that; points that are undecided are counted apart.
void compare_with_reference(const ShadeStack& stack, const Patch& patch, const ShadeKernel& kernel);

}  // namespace kinora
