// tests/jit/reduce.h: makes a failing module small while it still fails.
#pragma once

#include <functional>

#include "jit/ir/ir.h"

namespace kinora::jit::test {

// Replaces values by constants, drops effects and empties regions as long as `fails` holds and the
// module verifies.
Module reduce(Module module, const std::function<bool(const Module&)>& fails);

}  // namespace kinora::jit::test
