// jit/a64/a64.h: the target "neon" (4 lanes), encoded on any CPU, run on AArch64.
#pragma once

#include <memory>
#include <string>

#include "jit/ir/ir.h"
#include "jit/ir/kernel.h"

namespace kinora::jit {

// Is the running CPU an AArch64 one? All of them have NEON.
bool neon_supported();

// Machine code for a verified module; null if executable memory cannot be had. `assembly`, if
// given, receives a listing with the IR beside it. "neon" runs 4 points at a time: a grid of n
// points leaves the points of `out` from n rounded up to 4 on as they are. On other CPUs the kernel
// holds its code but must not be run.
std::shared_ptr<Kernel> emit_neon(const Module& module, std::string* assembly);

// Target::check: runs check_allocation over the functions of a verified module and looks for
// instructions that the encoder refused.
std::string check_neon(const Module& module);

}  // namespace kinora::jit
