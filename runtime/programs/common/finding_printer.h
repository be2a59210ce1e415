// runtime/programs/common/finding_printer.h: what a program that makes something of a scene says of
// it: all that spoils the result, and of the rest how much there is.
#pragma once

#include <array>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "runtime/base/diagnostic.h"
#include "runtime/programs/common/finding_lines.h"

namespace kinora {

struct FindingOptions {
    bool quiet = false;                  // errors only
    bool silent = false;                 // none: they are told elsewhere
    bool verbose = false;                // all, hints too
    bool strict = false;                 // what is left out or missing is an error
    Severity fail_on = Severity::Error;  // the least that makes the exit code 1

    Judgement judgement() const { return strict ? Judgement::Strict : Judgement::Rendering; }
};

class FindingPrinter {
  public:
    using Key = std::tuple<std::string_view, FileId, uint32_t, std::string>;
    // What was printed of some scenes that share their files.
    using Told = std::set<Key>;

    // `scene` is what kinora-validate would be called with. Findings of `always` are printed
    // whatever their severity, unless quiet.
    FindingPrinter(const FindingOptions& options, std::string scene,
                   const FindingInfo* always = nullptr)
        : options_(options), scene_(std::move(scene)), always_(always), lines_(options.verbose) {}

    // Prints to stderr what is new: each finding once, as FindingLines has room for it.
    void print(const Diagnostics& diagnostics);
    // What is in `told` is not printed again, and what is printed comes into it.
    void share(Told* told) { told_ = told; }
    // Says how many were not printed since it last did.
    void summarize();

    // A file that the scene names is missing or refused.
    bool misses_assets() const { return missing_; }
    // So it is under options.strict.
    bool lacks_assets() const { return options_.strict && missing_; }
    // 5 where it lacks assets, and 1 where there was another error.
    int exit_code_of_errors() const;
    // The exit code of a program that otherwise comes to `code`: that of errors, and 1 where there
    // was what options.fail_on names. Never 0 beside "error:".
    int exit_code(int code) const;

  private:
    bool admit(const Finding& finding);

    FindingOptions options_;
    std::string scene_;
    const FindingInfo* always_;
    FindingLines lines_;
    size_t seen_ = 0;  // findings looked at so far
    Told own_told_;
    Told* told_ = nullptr;            // of others
    size_t for_validator_ = 0;        // schema, names, style
    std::array<size_t, 5> counts_{};  // by severity
    bool missing_ = false;
};

}  // namespace kinora
