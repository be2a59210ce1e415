// rsl/text/reporter.cpp: the limit on errors, and notes about macros.
#include "rsl/text/reporter.h"

namespace kinora::rsl {

namespace {
constexpr int kMostNotes = 8;  // of one finding; deeper macro nests are cut

const FindingInfo* const kRows[] = {
#define FINDING(code, ...) &Code::code,
#include "rsl/text/findings.def"
#undef FINDING
};
}  // namespace

std::span<const FindingInfo* const> finding_rows() {
    return kRows;
}

bool Reporter::admit(const FindingInfo& info, Location where) {
    if (full()) return false;
    if (info.severity < Severity::Error) return true;
    if (++errors_ <= max_errors_) return true;
    diagnostics_.report(Code::RSL_TOO_MANY_ERRORS, where, max_errors_);
    return false;
}

void Reporter::add_notes(Finding& finding, uint32_t macro, Location spelling) {
    for (int n = 0; macro != 0 && n < kMostNotes; ++n) {
        const MacroUse& use = tokens_.macros[macro];
        Location where = n == 0 && spelling.file != kNoFile ? spelling : use.definition;
        finding.notes.push_back({where, fmt::format("in expansion of macro '{}'", use.name)});
        macro = use.parent;
    }
}

}  // namespace kinora::rsl
