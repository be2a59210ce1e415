// rsl/check/aovs.h: writeaov() and readaov(): outputs that a shader has without declaring them.
#pragma once

#include <map>
#include <string_view>

#include "rsl/check/assignments.h"
#include "rsl/check/tree_reporter.h"
#include "rsl/syntax/ast.h"

namespace kinora::rsl {

// The calls become assignments to and from varying output parameters of those names.
class NamedOutputs {
  public:
    NamedOutputs(Ast& ast, TreeReporter& reporter, Assignments& assignments)
        : ast_(ast), reporter_(reporter), assignments_(assignments) {}

    static bool is_call(std::string_view name) { return name == "writeaov" || name == "readaov"; }
    // The outputs that shaders declare themselves.
    void begin();
    // In place of a call whose arguments are checked.
    void bind(Expr*& slot, CallExpr& e);
    // Gives the shader what has been written so far.
    void end(ShaderDefinition& shader);

  private:
    Expr* named(Symbol& symbol, const SourceSpan& span);
    Expr* assign(Expr* target, Expr* value, const SourceSpan& span);

    Ast& ast_;
    TreeReporter& reporter_;
    Assignments& assignments_;
    std::map<std::string_view, Symbol*> outputs_;
};

}  // namespace kinora::rsl
