// jit/ir/normalize.h: puts a just-built function into the order that verify() demands.
#pragma once

#include "jit/ir/ir.h"

namespace kinora::jit {

// Params first, then constants and Inputs (each once), then the rest in order, with every Merge
// moved to its EndIf, LoopVar to its Loop, LoopOut to its EndLoop. Linear time.
void normalize(Function& function);

}  // namespace kinora::jit
