// rsl/check/shader_space.h: the space of parameter defaults.
#pragma once

#include "rsl/syntax/ast.h"

namespace kinora::rsl {

// Points, vectors and normals that are written as defaults of a shader's parameters are in "shader"
// space unless they name another, as values given from outside are.
void put_default_in_shader_space(Ast& ast, Symbol& symbol);

}  // namespace kinora::rsl
