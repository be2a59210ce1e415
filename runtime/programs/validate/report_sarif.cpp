// runtime/programs/validate/report_sarif.cpp: SARIF 2.1.0 (OASIS standard), one run.
#include <fmt/format.h>

#include "runtime/base/display_path.h"
#include "runtime/programs/validate/escaped_text.h"
#include "runtime/programs/validate/report.h"
#include "runtime/programs/validate/rules.h"

namespace kinora {

namespace {

// SARIF 3.27.10: what is no warning and no error is a note.
const char* level(Severity severity) {
    constexpr const char* kLevels[] = {"none", "note", "note", "warning", "error"};
    return kLevels[size_t(severity)];
}

std::string message_json(std::string_view text) {
    return fmt::format("{{\"text\": {}}}", json_string(text));
}

std::string rule_json(const FindingInfo& row) {
    std::string text = fmt::format(
        "{{\"id\": {}, \"shortDescription\": {}, \"defaultConfiguration\": {{\"enabled\": {}, "
        "\"level\": \"{}\"}}",
        json_string(row.code), message_json(rule_text(row)), row.severity != Severity::Off,
        level(row.severity));
    if (*row.explanation)
        text += fmt::format(", \"fullDescription\": {}", message_json(row.explanation));
    if (*row.fix) text += fmt::format(", \"help\": {}", message_json(row.fix));
    return text + "}";
}

std::string sarif_head(const ValidateSettings&) {
    std::string text = fmt::format(
        "{{\"$schema\": \"https://json.schemastore.org/sarif-2.1.0.json\", \"version\": "
        "\"2.1.0\",\n\"runs\": [{{\"tool\": {{\"driver\": {{\"name\": \"kinora-validate\", "
        "\"version\": {}, \"semanticVersion\": {}, \"rules\": [\n",
        json_string(KINORA_VERSION), json_string(KINORA_VERSION));
    for (const FindingInfo* row : validate_rules())
        text += rule_json(*row) + (row == validate_rules().back() ? "\n" : ",\n");
    return text + "]}},\n\"columnKind\": \"unicodeCodePoints\",\n\"results\": [\n";
}

// The location of a finding without one is its file as a whole.
std::string location_json(const std::string& file, Location where, const SourceFiles& files,
                          std::string_view id_path, std::string_view message = {}) {
    std::string uri = where.file == kNoFile ? file : display_path(files.name(where.file));
    std::string text =
        fmt::format("{{\"physicalLocation\": {{\"artifactLocation\": {{\"uri\": {}}}",
                    json_string(uri_of_path(uri)));
    if (where.file != kNoFile) {
        TextRegion r = text_region(where, files);
        text += fmt::format(
            ", \"region\": {{\"startLine\": {}, \"startColumn\": {}, \"endLine\": {}, "
            "\"endColumn\": {}}}",
            r.line, r.column, r.end_line, r.end_column);
    }
    text += "}";
    if (!id_path.empty())
        text += fmt::format(
            ", \"logicalLocations\": [{{\"fullyQualifiedName\": {}, \"kind\": \"element\"}}]",
            json_string(id_path));
    if (!message.empty()) text += ", \"message\": " + message_json(message);
    return text + "}";
}

std::string result_json(const FileResult& result, const Finding& finding) {
    std::string message = finding.message;
    if (!finding.help.empty()) message += "; " + finding.help;
    std::string text = fmt::format("{{\"ruleId\": {}", json_string(finding.info->code));
    if (auto index = rule_index(*finding.info)) text += fmt::format(", \"ruleIndex\": {}", *index);
    text += fmt::format(", \"level\": \"{}\", \"message\": {}, \"locations\": [{}]",
                        level(finding.severity), message_json(message),
                        location_json(result.name, finding.where, result.files(), finding.id_path));
    if (!finding.notes.empty()) {
        text += ", \"relatedLocations\": [";
        for (const Note& note : finding.notes)
            text += (&note == &finding.notes.front() ? "" : ", ") +
                    location_json(result.name, note.where, result.files(), {}, note.message);
        text += "]";
    }
    return text + "}";
}

std::string sarif_file(const FileResult& result, const ValidateSettings&) {
    std::string text;
    for (const Finding& finding : result.findings)
        text += (text.empty() ? "" : ",\n") + result_json(result, finding);
    return text;
}

std::string sarif_tail(const ValidateTotals& totals, const ValidateSettings&) {
    return fmt::format(
        "\n],\n\"invocations\": [{{\"executionSuccessful\": {}, \"exitCode\": {}}}]}}]}}\n",
        totals.unreadable == 0, totals.exit_code());
}

}  // namespace

const ReportFormat kSarifReport{"sarif", sarif_head, sarif_file, ",\n", sarif_tail};

}  // namespace kinora
