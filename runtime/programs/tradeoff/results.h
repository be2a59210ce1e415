// runtime/programs/tradeoff/results.h: what was measured, as the reports read it.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/base/stage_clock.h"
#include "runtime/picture/compare/errors.h"
#include "runtime/picture/trade/front.h"
#include "runtime/picture/trade/variants.h"
#include "runtime/programs/tradeoff/plan.h"

namespace kinora {

// Against the reference; pictures: means over the frames, but for counts and maxima.
struct TradeErrors {
    PictureErrors picture;
    // Of the same vertices, where there are as many: the largest, in units and in pixels.
    std::optional<double> vertex_units, vertex_pixels;
    double hit_distance = 0;  // largest, of rays through pixels' centres that both hit; units
    double hit_mismatch = 0;  // share of such rays that one of them hits alone
    // Of colours at pixels' centres: how many floats lie between. Over the pixels that hit the
    // same. Measured of presets and of knobs that change arithmetic.
    std::optional<double> ulp_max, ulp_p99;
};

// An error by its name: a column of the reports.
struct TradeMetric {
    const char* name;   // "flip": in JSON and --assert
    const char* title;  // "FLIP"
    double (*get)(const TradeErrors&);
    bool more_is_better = false;
    bool has_floor = true;  // two references with other seeds differ in it
};
std::span<const TradeMetric> trade_metrics();
const TradeMetric* find_trade_metric(std::string_view name);
// Whether the error is no larger than the difference of two references.
bool within_floor(const TradeMetric& metric, const TradeErrors& errors, const TradeErrors& floor);
PictureErrors mean_errors(std::span<const PictureErrors> errors);

struct TradeTimes {
    double ratio = 1;                          // of the CPU time to the base's, the median
    MedianInterval ms;                         // CPU time of a frame: the ratio times the base's
    double wall_ms = 0;                        // of a frame on the threads given, the median
    double build_ms = 0;                       // of its scene; 0: the base's
    size_t count = 0;                          // times that the median is of
    std::array<double, kStageCount> stages{};  // CPU ms; they sum to ms.median
};

struct TradeRow {
    Variant variant{};
    std::string not_measured{};  // why; "": it was
    bool as_base = false;        // not measured, since a survey found no difference to its base
    bool same_picture = false;   // the bits of its base's picture in all frames
    TradeTimes times{};
    TradeErrors errors{};
    bool on_front = false;
    double off_front = 0;
    std::vector<uint8_t> picture_png{}, flip_png{};  // of the first frame, small

    bool measured() const { return not_measured.empty(); }
};

struct TradeFrame {
    int64_t number = 0;
    double time = 0;    // seconds
    double before = 0;  // the time of the frame before, from which it is posed
    std::string why;    // "first", "fastest": why it was chosen
};

struct TradeResults {
    std::string scene, fingerprint, target;
    int threads = 1;
    double budget_s = 0, used_s = 0, reference_s = 0;
    double fastest_step = 0;  // of a vertex, between two frames; units
    int asked_width = 0, asked_height = 0;
    Plan plan;
    std::vector<TradeFrame> frames;  // the first is that of the thumbnails
    TradeErrors floor;               // one reference against another
    std::vector<TradeRow> rows;      // the presets first
    std::vector<uint8_t> reference_png;
};

// A preset that is further off the front is worth changing.
inline constexpr double kMostOffFront = 0.05;
// What the intervals must hold before they decide that: six times or more have it.
inline constexpr double kSureCover = 0.95;

// Fills on_front and off_front: time against FLIP. The former by medians; the latter by what the
// intervals are sure of, from this one's lower end to the upper ends of others. It is 0 for a row
// whose interval holds less than kSureCover, and such rows are compared with none. Nor are rows
// with a setting that keeps the base's picture here though its knob trades pictures: chance of a
// scene.
void mark_front(TradeResults& results);

std::string frames_text(const TradeResults& results);  // "24 (fastest), 1 (first)"
// The size, frames and samples that were chosen for the budget, in a line.
std::string plan_text(const TradeResults& results);
// "0.0123", or "<= floor".
std::string error_text(const TradeMetric& metric, const TradeRow& row, const TradeErrors& floor);

}  // namespace kinora
