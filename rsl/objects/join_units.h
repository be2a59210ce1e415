// rsl/objects/join_units.h: a shader and its co-shaders as one shader.
#pragma once

#include <set>
#include <vector>

#include "rsl/objects/units.h"

namespace kinora::rsl {

// Puts the co-shaders `order` before the shader's body: their members, their methods, and calls of
// construct() and begin() in that order. `nested` are further functions that name these; those of
// `behind_members` name members of the shader itself. The shader gets their parameters. All must
// have been rewritten.
void join_units(Ast& ast, const std::vector<Unit>& units, const std::vector<size_t>& order,
                const std::vector<Function*>& nested,
                const std::set<const Function*>& behind_members);

}  // namespace kinora::rsl
