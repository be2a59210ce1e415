// jit/x64/x64_check.h: for tests: the register allocation of a module, proven.
#pragma once

#include <string>

#include "jit/ir.h"

namespace kinora::jit {

// Runs check_allocation over the functions of a verified module; "" if all are right.
std::string check_x64_allocation(const Module& module, bool avx512);

}  // namespace kinora::jit
