// runtime/programs/validate/report_junit.cpp: JUnit's XML as build servers read it: a suite a file,
// a case a finding that fails, or one case that passes.
#include <fmt/format.h>

#include "runtime/programs/validate/escaped_text.h"
#include "runtime/programs/validate/report.h"

namespace kinora {

namespace {

std::string junit_head(const ValidateSettings&) {
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"kinora-validate\">\n";
}

std::string failing_case(const FileResult& result, const Finding& finding) {
    return fmt::format(
        "    <testcase classname=\"{}\" name=\"{}\">\n"
        "      <{} type=\"{}\" message=\"{}\">{}</{}>\n    </testcase>\n",
        xml_text(result.name), xml_text(fmt::format("{} {}", finding.info->code, finding.id_path)),
        result.unreadable ? "error" : "failure", finding.info->code, xml_text(finding.message),
        xml_text(format_finding(finding, result.files())), result.unreadable ? "error" : "failure");
}

// Why a file fails beyond the findings shown: --max-issues and --only may leave none of them.
std::string hidden_case(const FileResult& result, size_t hidden) {
    std::string what = hidden ? counted(hidden, "more finding") + " not shown (--max-issues)"
                              : "the file cannot be read";
    const char* kind = result.unreadable ? "error" : "failure";
    return fmt::format(
        "    <testcase classname=\"{}\" name=\"{}\">\n"
        "      <{} message=\"{}\"/>\n    </testcase>\n",
        xml_text(result.name), hidden ? "not shown" : "unreadable", kind, what);
}

std::string junit_file(const FileResult& result, const ValidateSettings& settings) {
    std::string cases, remarks;
    size_t failing = 0;
    for (const Finding& finding : result.findings) {
        if (finding.severity < settings.fail_on) {
            remarks += format_finding(finding, result.files());
            continue;
        }
        ++failing;
        cases += failing_case(result, finding);
    }
    size_t hidden = result.at_least(settings.fail_on) - failing;
    if (hidden || (result.unreadable && !failing)) {
        ++failing;
        cases += hidden_case(result, hidden);
    }
    if (cases.empty())
        cases =
            fmt::format("    <testcase classname=\"{}\" name=\"valid\"/>\n", xml_text(result.name));
    if (!remarks.empty())
        cases += fmt::format("    <system-out>{}</system-out>\n", xml_text(remarks));
    return fmt::format(
        "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\">\n{}  </testsuite>\n",
        xml_text(result.name), failing ? failing : 1, result.unreadable ? 0 : failing,
        result.unreadable ? failing : 0, cases);
}

std::string junit_tail(const ValidateTotals&, const ValidateSettings&) {
    return "</testsuites>\n";
}

}  // namespace

const ReportFormat kJunitReport{"junit", junit_head, junit_file, "", junit_tail};

}  // namespace kinora
