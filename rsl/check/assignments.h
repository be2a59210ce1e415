// rsl/check/assignments.h: what may be written to, and what is.
#pragma once

#include <string_view>
#include <unordered_set>

#include "rsl/check/tree_reporter.h"
#include "rsl/syntax/ast.h"

namespace kinora::rsl {

// The variable that a Variable, Index or Component expression is (part of); else null.
Symbol* lvalue_symbol(Expr& target);

// All expressions here have been checked.
class Assignments {
  public:
    explicit Assignments(TreeReporter& reporter) : reporter_(reporter) {}

    // The expression is written to. False, with a finding, if it cannot be.
    bool assign(Expr& target);
    // The callee writes argument `index` (from 0), a result among "name", value pairs: it must be a
    // variable.
    void assign_result(Expr& argument, size_t index, std::string_view callee);
    // Sets Symbol::assigned, and warns of parameters that are no outputs.
    void mark(Symbol& symbol, const SourceSpan& span);

  private:
    TreeReporter& reporter_;
    std::unordered_set<const Symbol*> warned_;  // parameters already warned of
};

}  // namespace kinora::rsl
