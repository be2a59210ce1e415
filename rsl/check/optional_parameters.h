// rsl/check/optional_parameters.h: "name", value pairs behind the arguments of calls and
// statements.
#pragma once

#include <span>
#include <string_view>

#include "rsl/check/tree_reporter.h"
#include "rsl/syntax/ast.h"

namespace kinora::rsl {

// Pairs from args[first] on whose values have the wrong type are reported and left out, so that no
// later stage meets a text where it takes a number.
void drop_unfit_pairs(Ast& ast, TreeReporter& reporter, std::span<Expr*>& args, size_t first,
                      std::string_view callee);

}  // namespace kinora::rsl
