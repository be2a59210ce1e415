// rsl/syntax/copy_tree.h: copies of expressions.
#pragma once

#include "rsl/syntax/ast.h"

namespace kinora::rsl {

// The same expression in nodes of its own, checked if the original is; its calls are other sites.
// `nodes`, if given, grows by their number.
Expr* copy_tree(Ast& ast, const Expr& e, size_t* nodes = nullptr);

}  // namespace kinora::rsl
