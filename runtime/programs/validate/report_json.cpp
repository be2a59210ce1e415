// runtime/programs/validate/report_json.cpp: one JSON object; a line a file.
#include <fmt/format.h>

#include "runtime/base/display_path.h"
#include "runtime/programs/validate/escaped_text.h"
#include "runtime/programs/validate/report.h"

namespace kinora {

namespace {

std::string location_json(Location where, const SourceFiles& files) {
    if (where.file == kNoFile) return {};
    LineColumn at = files.line_column(where.file, where.begin);
    LineColumn end = files.line_column(where.file, std::max(where.begin, where.end));
    return fmt::format(
        ", \"file\": {}, \"line\": {}, \"column\": {}, \"end_line\": {}, \"end_column\": {}, "
        "\"offset\": {}, \"length\": {}",
        json_string(display_path(files.name(where.file))), at.line, at.column, end.line, end.column,
        where.begin, where.end > where.begin ? where.end - where.begin : 0);
}

std::string finding_json(const Finding& finding, const SourceFiles& files) {
    std::string text =
        fmt::format("{{\"code\": {}, \"severity\": {}, \"message\": {}{}",
                    json_string(finding.info->code), json_string(severity_name(finding.severity)),
                    json_string(finding.message), location_json(finding.where, files));
    if (!finding.id_path.empty())
        text += fmt::format(", \"path\": {}", json_string(finding.id_path));
    if (!finding.help.empty()) text += fmt::format(", \"help\": {}", json_string(finding.help));
    if (finding.notes.empty()) return text + "}";
    text += ", \"notes\": [";
    for (const Note& note : finding.notes)
        text += fmt::format("{}{{\"message\": {}{}}}", &note == &finding.notes.front() ? "" : ", ",
                            json_string(note.message), location_json(note.where, files));
    return text + "]}";
}

std::string counts_json(const std::array<size_t, 5>& counts) {
    return fmt::format("\"errors\": {}, \"warnings\": {}, \"infos\": {}, \"hints\": {}", counts[4],
                       counts[3], counts[2], counts[1]);
}

std::string json_head(const ValidateSettings&) {
    return "{\"program\": \"kinora-validate\", \"version\": " + json_string(KINORA_VERSION) +
           ", \"files\": [\n";
}

std::string json_file(const FileResult& result, const ValidateSettings& settings) {
    std::string text = fmt::format(
        "{{\"file\": {}, \"valid\": {}, \"readable\": {}, {}, \"hidden\": {}, \"findings\": [",
        json_string(result.name), !result.unreadable && result.at_least(settings.fail_on) == 0,
        !result.unreadable, counts_json(result.counts), result.hidden);
    for (const Finding& finding : result.findings)
        text += (&finding == &result.findings.front() ? "" : ", ") +
                finding_json(finding, result.files());
    text += "]";
    if (result.info) text += ", \"info\": " + info_json(*result.info);
    return text + "}";
}

std::string json_tail(const ValidateTotals& totals, const ValidateSettings&) {
    return fmt::format(
        "\n], \"summary\": {{\"files\": {}, \"failed\": {}, \"unreadable\": {}, {}, "
        "\"exit_code\": {}}}}}\n",
        totals.files, totals.failed, totals.unreadable, counts_json(totals.counts),
        totals.exit_code());
}

}  // namespace

const ReportFormat kJsonReport{"json", json_head, json_file, ",\n", json_tail};

}  // namespace kinora
