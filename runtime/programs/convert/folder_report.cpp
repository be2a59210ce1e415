// runtime/programs/convert/folder_report.cpp: what became of the files of a folder, as text and
// JSON.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "runtime/base/file_extension.h"
#include "runtime/programs/convert/folder_p.h"

namespace kinora {

namespace {

using Json = nlohmann::ordered_json;

// By Outcome.
constexpr const char* kOutcomes[] = {"converted", "failed", "crashed", "not tried"};

std::string json_text(const Json& json, int indent = -1) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

Json json_of(const ReportedFinding& f) {
    Json json = {{"code", f.code}, {"severity", f.severity}, {"message", f.message}};
    if (!f.place.empty()) json["place"] = f.place;
    return json;
}

ReportedFinding finding_of(const Json& json) {
    return {json.value("code", ""), json.value("severity", ""), json.value("message", ""),
            json.value("place", "")};
}

Json json_of(const FileRecord& r) {
    Json json = {{"input", r.file.input},
                 {"output", r.file.output},
                 {"outcome", kOutcomes[size_t(r.outcome)]}};
    if (r.outcome == Outcome::Failed) json["exit"] = r.code;
    if (r.outcome == Outcome::Crashed) json["signal"] = r.code;
    if (r.outcome == Outcome::Converted) json["bytes"] = r.bytes;
    Json lost = Json::array(), others = Json::array();
    for (const ReportedFinding& f : r.findings)
        (f.code == "CONVERT_LOST" ? lost : others).push_back(json_of(f));
    json["lost"] = lost;
    json["findings"] = others;
    if (!r.said.empty()) json["said"] = r.said;
    return json;
}

struct Totals {
    std::array<size_t, std::size(kOutcomes)> of{};
    size_t kept = 0, lossy = 0;

    explicit Totals(const std::vector<FileRecord>& records) {
        for (const FileRecord& r : records) {
            ++of[size_t(r.outcome)];
            kept += r.kept;
            lossy += r.outcome == Outcome::Converted && r.lost() > 0;
        }
    }
};

std::string text_of(const FileRecord& r) {
    std::string text = fmt::format("{} -> {}: ", r.file.input, r.file.output);
    if (r.outcome == Outcome::Converted)
        text += fmt::format("{} bytes, {} lost\n", r.bytes, r.lost());
    else if (r.outcome == Outcome::NotTried)
        text += "not tried\n";
    else
        text += fmt::format("{} ({} {})\n", kOutcomes[size_t(r.outcome)],
                            r.outcome == Outcome::Failed ? "exit" : "signal", r.code);
    for (const ReportedFinding& f : r.findings)
        text += fmt::format("    {}{}{}: {} [{}]\n", f.place, f.place.empty() ? "" : ": ",
                            f.severity, f.message, f.code);
    if (!r.said.empty()) text += "    " + r.said + "\n";
    return text;
}

}  // namespace

size_t FileRecord::lost() const {
    return size_t(std::ranges::count(findings, "CONVERT_LOST", &ReportedFinding::code));
}

std::string folder_report(const ConvertOptions& options, const std::vector<FileRecord>& records) {
    Totals totals(records);
    if (!has_extension(options.report, {".json"})) {
        std::string text;
        for (const FileRecord& r : records) text += text_of(r);
        return text + fmt::format(
                          "{} files: {} converted, {} of them with losses; {} failed, "
                          "{} crashed, {} not tried\n",
                          records.size(), totals.of[0], totals.lossy, totals.of[1], totals.of[2],
                          totals.of[3]);
    }
    Json files = Json::array();
    for (const FileRecord& r : records) files.push_back(json_of(r));
    Json summary = {{"files", records.size()},     {"converted", totals.of[0]},
                    {"with_losses", totals.lossy}, {"failed", totals.of[1]},
                    {"crashed", totals.of[2]},     {"not_tried", totals.of[3]}};
    return json_text({{"input", options.input},
                      {"output", options.output},
                      {"to", options.to},
                      {"summary", summary},
                      {"files", files}},
                     1) +
           "\n";
}

std::string record_line(const FileRecord& record, const std::string& settings) {
    Json json = json_of(record);
    json["size"] = record.file.size;
    json["changed"] = record.file.changed;
    json["settings"] = settings;
    return json_text(json);
}

std::optional<FileRecord> parse_record(const std::string& line, const std::string& settings) {
    Json json = Json::parse(line, nullptr, false);
    if (!json.is_object() || json.value("settings", "") != settings) return std::nullopt;
    FileRecord record;
    record.file = {json.value("input", ""), json.value("output", ""),
                   json.value("size", uint64_t(0)), json.value("changed", int64_t(0))};
    auto outcome = std::ranges::find(kOutcomes, json.value("outcome", ""));
    if (outcome == std::end(kOutcomes)) return std::nullopt;
    record.outcome = Outcome(outcome - std::begin(kOutcomes));
    record.bytes = json.value("bytes", uint64_t(0));
    for (const char* list : {"lost", "findings"})
        for (const Json& f : json.value(list, Json::array()))
            record.findings.push_back(finding_of(f));
    return record;
}

std::string findings_text(const Diagnostics& diagnostics) {
    Json list = Json::array();
    for (const Finding& f : diagnostics.findings()) {
        bool is_loss = std::string_view(f.info->code).starts_with("CONVERT_");
        if (f.severity < Severity::Warning && !(is_loss && f.severity > Severity::Off)) continue;
        ReportedFinding finding{f.info->code, severity_name(f.severity), f.message, ""};
        if (f.where.file != kNoFile) {
            LineColumn at = diagnostics.files.line_column(f.where.file, f.where.begin);
            finding.place =
                fmt::format("{}:{}:{}", diagnostics.files.name(f.where.file), at.line, at.column);
        }
        list.push_back(json_of(finding));
    }
    return json_text(list);
}

std::vector<ReportedFinding> parse_findings(const std::string& text) {
    std::vector<ReportedFinding> findings;
    Json list = Json::parse(text, nullptr, false);
    if (list.is_array())
        for (const Json& f : list) findings.push_back(finding_of(f));
    return findings;
}

}  // namespace kinora
