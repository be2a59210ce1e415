// rsl/check/unknown_names.h: reports of names that mean nothing, each once, with what may be meant.
#pragma once

#include <string_view>
#include <unordered_set>

#include "rsl/check/scopes.h"
#include "rsl/check/tree_reporter.h"
#include "rsl/syntax/parse_recovery.h"

namespace kinora::rsl {

class UnknownNames {
  public:
    // Names that `recovery` hides are not reported.
    UnknownNames(const Ast& ast, TreeReporter& reporter, const ParseRecovery& recovery,
                 Scopes& scopes)
        : ast_(ast), reporter_(reporter), recovery_(recovery), scopes_(scopes) {}

    void variable(const VariableExpr& e);
    void function(const CallExpr& e);
    // Another shader begins: a name that was reported before is news in it.
    void begin_shader();
    // Whether a name in the function was most likely to be "return".
    bool misspells_return(const Function& f) const { return misspelt_returns_.contains(&f); }

  private:
    const Ast& ast_;
    TreeReporter& reporter_;
    const ParseRecovery& recovery_;
    Scopes& scopes_;
    std::unordered_set<std::string_view> variables_;  // already reported
    std::unordered_set<std::string_view> functions_;
    std::unordered_set<const Function*> misspelt_returns_;
};

}  // namespace kinora::rsl
