// rsl/objects/integrators.h: directlighting() and indirectspecular() of a class.
#pragma once

#include "rsl/objects/units.h"
#include "rsl/syntax/ast.h"
#include "rsl/text/reporter.h"

namespace kinora::rsl {

// Calls of directlighting(this, getlights(), ...) and indirectspecular(this, ...) become calls of
// the functions of assets/shaders/include/integrators.h, which become methods of the class. Works
// on the tree as it was parsed, before expand_objects(). Units: a shader and its co-shaders, if any.
void bind_integrators(Ast& ast, Reporter& reporter, std::span<Unit> units);

}  // namespace kinora::rsl
