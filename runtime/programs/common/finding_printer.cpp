// runtime/programs/common/finding_printer.cpp: which findings count, and what is said of the
// others.
#include "runtime/programs/common/finding_printer.h"

#include <algorithm>
#include <cstdio>

#include "runtime/base/file_extension.h"
#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/common/missing_asset.h"

namespace kinora {

bool FindingPrinter::admit(const Finding& finding) {
    Severity least = options_.quiet     ? Severity::Error
                     : options_.verbose ? Severity::Hint
                                        : Severity::Warning;
    bool asked_for = finding.info == always_ && !options_.quiet;
    bool first =
        (told_ ? *told_ : own_told_)
            .emplace(finding.info->code, finding.where.file, finding.where.begin, finding.message)
            .second;
    if (!first || finding.severity == Severity::Off) return false;
    if (finding.severity < least && !asked_for) {
        for_validator_ += finding.info->severity >= Severity::Warning;
        return false;
    }
    return true;
}

void FindingPrinter::print(const Diagnostics& diagnostics) {
    const auto& findings = diagnostics.findings();
    for (; seen_ < findings.size(); ++seen_) {
        Finding finding = findings[seen_];
        bool missing = is_missing_asset(*finding.info) && finding.severity != Severity::Off;
        missing_ |= missing;
        if (missing && options_.strict) finding.severity = Severity::Error;
        ++counts_[size_t(finding.severity)];
        if (!options_.silent && admit(finding))
            lines_.add(finding.severity, finding.info->code,
                       format_finding(finding, diagnostics.files));
    }
    std::fputs(lines_.take().c_str(), stderr);
}

void FindingPrinter::summarize() {
    if (!options_.quiet && !options_.silent) {
        std::fputs(lines_.take_rest().c_str(), stderr);
        if (for_validator_ > 0 && has_extension(scene_, {".dae", ".zae", ".kmz"}))
            std::fprintf(stderr, "%zu more: kinora-validate %s\n", for_validator_, scene_.c_str());
        else if (for_validator_ > 0)
            std::fprintf(stderr, "%zu more: -v shows them\n", for_validator_);
    }
    for_validator_ = 0;
}

int FindingPrinter::exit_code_of_errors() const {
    if (lacks_assets()) return kExitMissingAsset;
    return counts_[size_t(Severity::Error)] > 0 ? kExitSomeFailed : kExitOk;
}

int FindingPrinter::exit_code(int code) const {
    if (code == kExitOk) code = exit_code_of_errors();
    if (code != kExitOk) return code;
    size_t failing = 0;
    for (size_t s = size_t(options_.fail_on); s < counts_.size(); ++s) failing += counts_[s];
    return failing > 0 ? kExitSomeFailed : kExitOk;
}

}  // namespace kinora
