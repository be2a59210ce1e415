// runtime/programs/validate/report_text.cpp: for people and editors: file:line:col: severity.
#include <fmt/format.h>

#include "runtime/programs/validate/report.h"

namespace kinora {

namespace {

std::string text_head(const ValidateSettings&) {
    return {};
}

std::string text_file(const FileResult& result, const ValidateSettings& settings) {
    std::string text;
    for (const Finding& finding : result.findings) {
        if (settings.quiet && finding.severity < Severity::Error) continue;
        text += format_finding(finding, result.files());
        if (settings.verbose && *finding.info->explanation)
            text += fmt::format("    why: {}\n", finding.info->explanation);
    }
    if (result.hidden && !settings.quiet)
        text += fmt::format("{}: {} more not shown (--max-issues {})\n", result.name, result.hidden,
                            settings.max_issues);
    if (settings.verbose) text += fmt::format("{}: {}\n", result.name, counts_text(result.counts));
    if (result.info) text += info_text(result.name, *result.info);
    return text;
}

std::string text_tail(const ValidateTotals& totals, const ValidateSettings& settings) {
    if (settings.quiet) return {};
    std::string text = counted(totals.files, "file");
    if (totals.failed) text += fmt::format(", {} failed", totals.failed);
    if (totals.unreadable) text += fmt::format(", {} unreadable", totals.unreadable);
    return text + ": " + counts_text(totals.counts) + "\n";
}

}  // namespace

const ReportFormat kTextReport{"text", text_head, text_file, "", text_tail};

}  // namespace kinora
