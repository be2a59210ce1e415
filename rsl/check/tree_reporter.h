// rsl/check/tree_reporter.h: findings about nodes of the tree.
#pragma once

#include "rsl/syntax/ast.h"
#include "rsl/text/reporter.h"

namespace kinora::rsl {

class TreeReporter {
  public:
    TreeReporter(const Ast& ast, Reporter& reporter) : ast_(ast), reporter_(reporter) {}

    // The reference lives until the next report.
    template <class... Args>
    Finding& report(const FindingInfo& info, const SourceSpan& span, const Args&... args) {
        const Token& token = ast_.tokens.tokens[span.token];
        return reporter_.report(info, span.where, token.macro, token.spelling, args...);
    }
    // Nothing more is reported: the source is another language.
    void stop() { reporter_.stop(); }

  private:
    const Ast& ast_;
    Reporter& reporter_;
};

}  // namespace kinora::rsl
