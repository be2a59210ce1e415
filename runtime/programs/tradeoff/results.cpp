// runtime/programs/tradeoff/results.cpp: metrics by name; means over frames; the front.
#include "runtime/programs/tradeoff/results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace kinora {

namespace {

#define ERROR_OF(member) [](const TradeErrors& e) { return double(e.picture.member); }
constexpr TradeMetric kMetrics[] = {
    {"non_finite", "non-finite pixels", ERROR_OF(non_finite), false, false},
    {"mask_mismatch", "mask mismatch", ERROR_OF(mask_mismatch)},
    {"rmse", "RMSE", ERROR_OF(rmse)},
    {"relative_mse", "relative MSE", ERROR_OF(relative_mse)},
    {"psnr", "PSNR, dB", ERROR_OF(psnr), true},
    {"ssim", "SSIM", ERROR_OF(ssim), true},
    {"flip", "FLIP", ERROR_OF(flip)},
    {"flip_p99", "FLIP, 99 %", ERROR_OF(flip_p99)},
    {"hdr_flip", "HDR-FLIP", ERROR_OF(hdr_flip)},
    {"max_error", "largest", ERROR_OF(max_error)},
};
#undef ERROR_OF

// Whether a setting kept the bits of its base's pictures though its knob trades them: this scene
// has nothing that it loses, such as shadows. What it saves here is no reason to choose it for
// others.
bool is_lucky(const TradeRow& row) {
    return row.same_picture && row.variant.knob && row.variant.knob->error != "none";
}

// Whether a row owes its time to such a setting, alone or with others.
bool is_lucky(const TradeRow& row, const std::vector<TradeRow>& rows) {
    if (row.variant.kind == VariantKind::Preset) return false;
    const Quality& base = rows[row.variant.base].variant.quality;
    return std::any_of(rows.begin(), rows.end(), [&](const TradeRow& other) {
        if (!is_lucky(other)) return false;
        const auto get = other.variant.knob->get;
        const double setting = get(other.variant.quality);
        return get(row.variant.quality) == setting && get(base) != setting;
    });
}

// Few times have an interval that holds less than it should.
bool is_sure(const MedianInterval& interval) {
    return interval.cover >= kSureCover;
}

}  // namespace

std::span<const TradeMetric> trade_metrics() {
    return kMetrics;
}

const TradeMetric* find_trade_metric(std::string_view name) {
    for (const TradeMetric& metric : kMetrics)
        if (metric.name == name) return &metric;
    return nullptr;
}

bool within_floor(const TradeMetric& metric, const TradeErrors& errors, const TradeErrors& floor) {
    if (!metric.has_floor) return false;
    double error = metric.get(errors), least = metric.get(floor);
    return metric.more_is_better ? error >= least : error <= least;
}

PictureErrors mean_errors(std::span<const PictureErrors> errors) {
    PictureErrors mean;
    if (errors.empty()) return mean;
    double share = 1 / double(errors.size()), encoded = 0;
    mean.ssim = 0;
    for (const PictureErrors& e : errors) {
        mean.non_finite += e.non_finite;
        mean.mask_mismatch += share * e.mask_mismatch;
        mean.rmse += share * e.rmse;
        mean.relative_mse += share * e.relative_mse;
        encoded += share * std::pow(10, -0.1 * e.psnr);
        mean.ssim += share * e.ssim;
        mean.flip += share * e.flip;
        mean.flip_p99 += share * e.flip_p99;
        mean.hdr_flip += share * e.hdr_flip;
        mean.max_error = std::max(mean.max_error, e.max_error);
    }
    mean.psnr = encoded > 0 ? -10 * std::log10(encoded) : std::numeric_limits<double>::infinity();
    return mean;
}

void mark_front(TradeResults& results) {
    std::vector<TradePoint> points, slowest;  // by the upper ends of the intervals
    std::vector<TradeRow*> rows;
    for (TradeRow& row : results.rows) {
        if (!row.measured()) continue;
        rows.push_back(&row);
        points.push_back({row.times.ms.median, row.errors.picture.flip});
        if (is_sure(row.times.ms) && !is_lucky(row, results.rows))
            slowest.push_back({row.times.ms.high, row.errors.picture.flip});
    }
    const double floor = results.floor.picture.flip;
    std::vector<bool> front = pareto_front(points, floor);
    for (size_t i = 0; i < rows.size(); ++i) {
        rows[i]->on_front = front[i];
        TradePoint surely{rows[i]->times.ms.low, points[i].error};
        rows[i]->off_front = is_sure(rows[i]->times.ms) ? off_front(surely, slowest, floor) : 0;
    }
}

std::string frames_text(const TradeResults& r) {
    std::string text;
    for (const TradeFrame& frame : r.frames)
        text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", frame.number, frame.why);
    return text;
}

std::string plan_text(const TradeResults& r) {
    const Plan& plan = r.plan;
    std::string text = fmt::format("{}x{} pixels", plan.width, plan.height);
    if (plan.width < r.asked_width)
        text += fmt::format(" (asked {}x{})", r.asked_width, r.asked_height);
    text += fmt::format(", frame {}; reference of {} samples, estimated {:.0f} s; ", frames_text(r),
                        plan.reference_samples, 1e-3 * plan.reference_ms);
    size_t as_base = 0, combinations = 0;
    for (const TradeRow& row : r.rows) {
        as_base += row.as_base;
        combinations += row.variant.kind == VariantKind::Combination;
    }
    text += fmt::format(
        "{} variants, of which {} do nothing here and {} are combinations, {} times each",
        r.rows.size(), as_base, combinations, plan.frames * plan.rounds);
    if (plan.final_samples > 0)
        text += fmt::format(", final's knobs with {} sample{}", plan.final_samples,
                            plan.final_samples == 1 ? "" : "s");
    text += fmt::format(", estimated {:.0f} s; budget {:g} s{}", 1e-3 * plan.variants_ms,
                        r.budget_s, plan.fits ? "" : ", which is too little for all");
    return text;
}

std::string error_text(const TradeMetric& metric, const TradeRow& row, const TradeErrors& floor) {
    if (within_floor(metric, row.errors, floor)) return "<= floor";
    return fmt::format("{:.4g}", metric.get(row.errors));
}

}  // namespace kinora
