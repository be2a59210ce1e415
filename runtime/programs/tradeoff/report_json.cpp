// runtime/programs/tradeoff/report_json.cpp: tradeoff.json and tradeoff.csv.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "runtime/programs/tradeoff/tradeoff.h"

namespace kinora {

namespace {

using TradeJson = nlohmann::ordered_json;

TradeJson finite_json(double value) {
    return std::isfinite(value) ? TradeJson(value) : TradeJson(nullptr);
}
TradeJson optional_json(const std::optional<double>& value) {
    return value ? finite_json(*value) : TradeJson(nullptr);
}

// What an option takes; of light samples the file's own count, which none says, is null.
TradeJson setting_json(const Knob& knob, const Quality& quality) {
    if (knob.kind == KnobKind::Choice) return knob_text(knob, quality);
    double value = knob.get(quality);
    if (value < knob.low) return nullptr;
    if (knob.kind == KnobKind::Whole) return int64_t(value);
    return value;
}

TradeJson errors_json(const TradeErrors& errors) {
    TradeJson json;
    for (const TradeMetric& metric : trade_metrics())
        json[metric.name] = finite_json(metric.get(errors));
    json["vertex_units"] = optional_json(errors.vertex_units);
    json["vertex_pixels"] = optional_json(errors.vertex_pixels);
    json["hit_distance"] = finite_json(errors.hit_distance);
    json["hit_mismatch"] = errors.hit_mismatch;
    json["ulp_max"] = optional_json(errors.ulp_max);
    json["ulp_p99"] = optional_json(errors.ulp_p99);
    return json;
}

TradeJson times_json(const TradeTimes& times) {
    TradeJson json = {{"cpu_ms", times.ms.median},  {"low", times.ms.low},
                      {"high", times.ms.high},      {"cover", times.ms.cover},
                      {"ratio", times.ratio},       {"wall_ms", times.wall_ms},
                      {"build_ms", times.build_ms}, {"count", times.count}};
    for (size_t s = 0; s < kStageCount; ++s)
        if (times.stages[s] > 0) json["stages"][stage_name(Stage(s))] = times.stages[s];
    return json;
}

TradeJson row_json(const TradeRow& row, const TradeResults& results) {
    TradeJson json = {{"name", row.variant.name},
                      {"kind", variant_kind_name(row.variant.kind)},
                      {"base", results.rows[row.variant.base].variant.name}};
    if (row.variant.knob) {
        json["knob"] = row.variant.knob->option;
        json["setting"] = row.variant.setting;
        json["stage"] = row.variant.knob->stage;
    }
    for (const Knob& knob : knobs())
        json["settings"][std::string(knob.option)] = setting_json(knob, row.variant.quality);
    if (!row.measured()) {
        json["not_measured"] = row.not_measured;
        json["same_as_base"] = row.as_base;
        return json;
    }
    json["times"] = times_json(row.times);
    json["errors"] = errors_json(row.errors);
    json["within_floor"] = TradeJson::array();
    for (const TradeMetric& metric : trade_metrics())
        if (within_floor(metric, row.errors, results.floor))
            json["within_floor"].push_back(metric.name);
    json["same_picture_as_base"] = row.same_picture;
    json["on_front"] = row.on_front;
    json["off_front"] = row.off_front;
    return json;
}

}  // namespace

std::string tradeoff_json(const TradeResults& r) {
    TradeJson json = {{"format", "kinora-tradeoff"},
                      {"version", 1},
                      {"program", KINORA_VERSION},
                      {"scene", r.scene},
                      {"fingerprint", r.fingerprint},
                      {"target", r.target},
                      {"threads", r.threads},
                      {"budget_s", r.budget_s},
                      {"used_s", r.used_s},
                      {"asked", {r.asked_width, r.asked_height}},
                      {"size", {r.plan.width, r.plan.height}},
                      {"fastest_step", r.fastest_step}};
    json["final_samples"] = r.plan.final_samples > 0 ? TradeJson(r.plan.final_samples) : nullptr;
    json["reference"] = {{"samples", r.plan.reference_samples}, {"seconds", r.reference_s}};
    for (const TradeFrame& frame : r.frames)
        json["frames"].push_back(
            {{"frame", frame.number}, {"seconds", frame.time}, {"why", frame.why}});
    json["noise_floor"] = errors_json(r.floor);
    json["rows"] = TradeJson::array();
    for (const TradeRow& row : r.rows) json["rows"].push_back(row_json(row, r));
    return json.dump(1) + "\n";
}

std::string tradeoff_csv(const TradeResults& r) {
    std::string text = "name,kind,base,not_measured";
    for (const Knob& knob : knobs()) text += fmt::format(",{}", knob.option);
    text += ",cpu_ms,low,high,count,wall_ms,build_ms";
    for (const TradeMetric& metric : trade_metrics()) text += fmt::format(",{}", metric.name);
    text += ",vertex_units,vertex_pixels,hit_distance,hit_mismatch,ulp_max,ulp_p99,on_front\n";
    auto optional = [](const std::optional<double>& value) {
        return value ? fmt::format("{:.6g}", *value) : std::string();
    };
    for (const TradeRow& row : r.rows) {
        text += fmt::format("{},{},{},{}", row.variant.name, variant_kind_name(row.variant.kind),
                            r.rows[row.variant.base].variant.name, row.not_measured);
        for (const Knob& knob : knobs()) text += "," + knob_text(knob, row.variant.quality);
        if (!row.measured()) {
            text += std::string(6 + trade_metrics().size() + 7, ',') + "\n";
            continue;
        }
        const TradeTimes& t = row.times;
        text += fmt::format(",{:.6g},{:.6g},{:.6g},{},{:.6g},{:.6g}", t.ms.median, t.ms.low,
                            t.ms.high, t.count, t.wall_ms, t.build_ms);
        for (const TradeMetric& metric : trade_metrics())
            text += "," + error_text(metric, row, r.floor);
        const TradeErrors& e = row.errors;
        text += fmt::format(",{},{},{:.6g},{:.6g},{},{},{}\n", optional(e.vertex_units),
                            optional(e.vertex_pixels), e.hit_distance, e.hit_mismatch,
                            optional(e.ulp_max), optional(e.ulp_p99), int(row.on_front));
    }
    return text;
}

}  // namespace kinora
