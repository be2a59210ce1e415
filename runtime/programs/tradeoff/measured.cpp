// runtime/programs/tradeoff/measured.cpp: reads tradeoff.json and chooses a row.
#include "runtime/programs/tradeoff/measured.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "runtime/scene/quality/knobs.h"

namespace kinora {

namespace {

using nlohmann::json;

// As report_json.cpp writes it: null is what only a preset says, 0.
bool read_setting(const json& value, const Knob& knob, Quality& quality) {
    if (value.is_string()) return set_knob(knob, value.get<std::string>(), quality);
    if (knob.kind == KnobKind::Choice || !(value.is_null() || value.is_number())) return false;
    const double number = value.is_null() ? 0 : value.get<double>();
    if (!value.is_null() && !(number >= knob.low && number <= knob.high)) return false;
    knob.set(quality, number);
    return true;
}

bool read_row(const json& row, double scale, TargetMetric metric, MeasuredSettings& read) {
    for (const Knob& knob : knobs())
        if (!read_setting(row.at("settings").at(std::string(knob.option)), knob, read.quality))
            return false;
    read.name = row.at("name").get<std::string>();
    read.ms = scale * row.at("times").at("wall_ms").get<double>();
    read.error = row.at("errors").at(target_metric_name(metric)).get<double>();
    return true;
}

std::string misfit(const json& file, const MeasuredQuery& query) {
    if (file.at("format") != "kinora-tradeoff" || file.at("version") != 1)
        return "is no tradeoff.json of this program";
    if (file.at("fingerprint") != query.fingerprint)
        return "is of another scene, other options or another version";
    const bool other_machine =
        file.at("target") != query.target || file.at("threads") != query.threads;
    if (query.wanted.ms > 0 && other_machine)  // errors are those of any machine
        return fmt::format("was measured with {} threads on {}", file.at("threads").get<int>(),
                           file.at("target").get<std::string>());
    return "";
}

bool is_better(const MeasuredSettings& a, const MeasuredSettings& b, const FrameTarget& wanted,
               double floor) {
    if (wanted.error > 0) return a.ms < b.ms;
    const double error_a = std::max(a.error, floor), error_b = std::max(b.error, floor);
    return error_a != error_b ? error_a < error_b : a.ms < b.ms;
}

std::optional<MeasuredSettings> choose_row(const json& file, const MeasuredQuery& query,
                                           std::string& why_not) {
    if (why_not = misfit(file, query); !why_not.empty()) return std::nullopt;
    const FrameTarget& wanted = query.wanted;
    const double scale =
        query.pixels / (file.at("size").at(0).get<double>() * file.at("size").at(1).get<double>());
    const double floor = file.at("noise_floor").at(target_metric_name(wanted.metric)).get<double>();
    std::optional<MeasuredSettings> best;
    for (const json& row : file.at("rows")) {
        if (!row.contains("errors")) continue;
        MeasuredSettings read;
        if (!read_row(row, scale, wanted.metric, read)) continue;
        const bool fits = wanted.ms > 0 ? read.ms <= wanted.ms : read.error <= wanted.error;
        if (fits && (!best || is_better(read, *best, wanted, floor))) best = read;
    }
    if (!best) why_not = "has no settings that reach the target";
    return best;
}

}  // namespace

std::optional<MeasuredSettings> measured_settings(const MeasuredQuery& query,
                                                  std::string& why_not) {
    std::filesystem::path path(query.file);
    std::error_code code;
    if (std::filesystem::is_directory(path, code)) path /= "tradeoff.json";
    std::ifstream in(path);
    if (!in) {
        why_not = "cannot be read";
        return std::nullopt;
    }
    try {
        return choose_row(json::parse(in), query, why_not);
    } catch (const json::exception&) {
        why_not = "is no tradeoff.json of this program";
        return std::nullopt;
    }
}

}  // namespace kinora
