// rsl/text/reporter.h: findings about shader source, with the macros a token came through, at most
// CompileOptions::max_errors of them.
#pragma once

#include "rsl/text/findings.h"
#include "rsl/text/token.h"
#include "runtime/base/diagnostic.h"

namespace kinora::rsl {

class Reporter {
  public:
    Reporter(Diagnostics& diagnostics, const TokenStream& tokens, int max_errors)
        : diagnostics_(diagnostics), tokens_(tokens), max_errors_(max_errors) {}

    // Adds a finding at `where`, with a note for each macro that `macro` (a TokenStream::macros
    // index, 0 = none) stands in. The reference lives until the next report.
    template <class... Args>
    Finding& report(const FindingInfo& info, Location where, uint32_t macro, Location spelling,
                    const Args&... args) {
        if (!admit(info, where)) return muted_ = Finding{};
        Finding& finding = diagnostics_.report(info, where, args...);
        add_notes(finding, macro, spelling);
        return finding;
    }
    template <class... Args>
    Finding& report(const FindingInfo& info, const Token& token, const Args&... args) {
        return report(info, token.where, token.macro, token.spelling, args...);
    }

    int errors() const { return errors_; }
    bool full() const { return stopped_ || errors_ > max_errors_; }
    // Nothing more is reported: what follows is another language.
    void stop() { stopped_ = true; }
    Diagnostics& diagnostics() { return diagnostics_; }

  private:
    bool admit(const FindingInfo& info, Location where);
    void add_notes(Finding& finding, uint32_t macro, Location spelling);

    Diagnostics& diagnostics_;
    const TokenStream& tokens_;
    int max_errors_;
    int errors_ = 0;
    bool stopped_ = false;
    Finding muted_{};
};

}  // namespace kinora::rsl
