// rsl/check/check.h: the checker: names to symbols and callees, types, overloads and conversions.
// It completes the tree in place; expressions that cannot be typed become Invalid after one
// finding, and nothing more is said of what contains them.
#pragma once

#include "rsl/check/assignments.h"
#include "rsl/check/call_graph.h"
#include "rsl/check/expression.h"
#include "rsl/check/scopes.h"
#include "rsl/check/statement.h"
#include "rsl/check/tree_reporter.h"
#include "rsl/check/unknown_names.h"
#include "rsl/syntax/parse_recovery.h"
#include "rsl/text/compile_options.h"
#include "rsl/text/reporter.h"

namespace kinora::rsl {

class Checker {
  public:
    // Names that `recovery` hides are not reported.
    Checker(Ast& ast, Reporter& reporter, const CompileOptions& options,
            const ParseRecovery& recovery);
    void run();

  private:
    void check_shader(ShaderDefinition& shader);
    void warn_of_hidden_outputs(const ShaderDefinition& shader);

    Ast& ast_;
    TreeReporter reporter_;
    Scopes scopes_;
    CallGraph graph_;
    UnknownNames unknown_;
    Assignments assignments_;
    NamedOutputs outputs_;
    ExpressionChecker expressions_;
    StatementChecker statements_;
};

}  // namespace kinora::rsl
