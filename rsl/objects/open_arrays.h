// rsl/objects/open_arrays.h: parameters of open length, as "float a[] = {1, 2}".
#pragma once

#include "rsl/objects/units.h"
#include "rsl/syntax/ast.h"

namespace kinora::rsl {

// A parameter of open length gets that of what it is bound to, else that of its default. One that
// then has no elements becomes a variable, an empty array that the shader may resize.
void set_open_arrays(Ast& ast, std::span<const Unit> units);

}  // namespace kinora::rsl
