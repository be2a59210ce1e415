// rsl/objects/open_arrays.h: parameters of open length, as "float a[] = {1, 2}".
#pragma once

#include <optional>

#include "rsl/objects/units.h"
#include "rsl/syntax/ast.h"

namespace kinora::rsl {

// Elements of a parameter of open length that so many numbers or texts are bound to; nothing where
// they do not come to whole elements. One number spreads over a triple.
std::optional<int> open_length(const Symbol& parameter, size_t count);

// A parameter of open length gets that of what it is bound to, else that of its default. One that
// then has no elements becomes a variable, an empty array that the shader may resize. `counts` are
// for sources that are not linked: those of units count else.
void set_open_arrays(Ast& ast, std::span<const Unit> units, const BoundCounts& counts);

}  // namespace kinora::rsl
