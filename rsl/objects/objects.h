// rsl/objects/objects.h: structs and classes of RSL 2.0 become what every later stage knows. It
// works on the unchecked tree: a struct's variable becomes one variable for each member, a method a
// function with those among its parameters, and a class a shader whose body calls its methods in
// the order of the pipeline. A shader and its co-shaders become one shader: handles are numbers,
// and calls through them calls of functions. Nothing of them is left for the checker.
#pragma once

#include "rsl/objects/units.h"
#include "rsl/syntax/ast.h"
#include "rsl/text/reporter.h"

namespace kinora::rsl {

// False if the source has errors that the later stages cannot go on after. Units, if given, are the
// shader and its co-shaders: they become one shader, that of units[0]. `counts`: open_arrays.h.
bool expand_objects(Ast& ast, Reporter& reporter, std::vector<Unit> units = {},
                    const BoundCounts& counts = {});

}  // namespace kinora::rsl
