// rsl/objects/tree_parts.h: what a node of the unchecked tree holds.
#pragma once

#include <vector>

#include "rsl/syntax/ast.h"

namespace kinora::rsl {

std::vector<Expr*> operands_of(const Expr& e);
std::vector<Expr*> expressions_of(const Stmt& stmt);  // of declarations: their values and lengths
std::vector<Stmt*> statements_of(const Stmt& stmt);   // without the bodies of functions

}  // namespace kinora::rsl
