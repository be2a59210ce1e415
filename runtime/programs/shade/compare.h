// runtime/programs/shade/compare.h: a run's outputs against another way to get them.
#pragma once

#include "runtime/programs/shade/kernel.h"

namespace kinora {

// Prints how far the outputs of `kernel` are from the interpreter's, bit for bit.
void compare_with_interpreter(const ShadeStack& stack, const Patch& patch,
                              const ShadeKernel& kernel, Diagnostics& diagnostics);

// Prints how far they are from rsl/reference/reference.h in double precision, at no more than 4096
// points spread over the patch; points where float and double decide differently are counted apart.
void compare_with_reference(const ShadeStack& stack, const Patch& patch, const ShadeKernel& kernel);

}  // namespace kinora
