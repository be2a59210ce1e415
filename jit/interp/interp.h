// jit/interp/interp.h: the target "interp": executes the IR in plain C++, and so defines what it
// means.
#pragma once

#include <memory>

#include "jit/ir/kernel.h"

namespace kinora::jit {

// A kernel that walks the module's instructions for 16 points at a time. Needs no executable
// memory; never null. Keeps a copy of the module.
std::shared_ptr<Kernel> emit_interp(const Module& module, std::string* assembly);

}  // namespace kinora::jit
