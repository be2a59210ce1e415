// runtime/shading/print.h: the text of a shader's printf.
#pragma once

#include <string>

#include "jit/ir/kernel.h"

namespace kinora {

// The format (argument 0, an interned string) with the values of one lane. RSL's letters: %f %d
// floats, %c %p %v %n triples, %m a matrix, %s a string (RISpec 3.2, printf).
std::string print_text(const jit::ServiceCall& call, int lane);

}  // namespace kinora
