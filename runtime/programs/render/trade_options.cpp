// runtime/programs/render/trade_options.cpp: --tradeoff, --target-ms, --target-error.
#include "runtime/programs/render/trade_options.h"

#include <charconv>

namespace kinora {

namespace {

constexpr double kLeastTarget_ms = 0.01, kMostTarget_ms = 1e8;

// "120s", "2m", "1h" or seconds.
double parse_budget(const std::string& text) {
    constexpr double kLeastSeconds = 1, kMostBudget = 1e6;
    double seconds = 0;
    const char* last = text.data() + text.size();
    auto [end, error] = std::from_chars(text.data(), last, seconds);
    std::string_view unit(end, size_t(last - end));
    if (unit == "m") seconds *= 60;
    if (unit == "h") seconds *= 3600;
    bool known = unit.empty() || unit == "s" || unit == "m" || unit == "h";
    if (error != std::errc() || !known || !(seconds >= kLeastSeconds && seconds <= kMostBudget))
        throw CLI::ValidationError("--budget",
                                   "takes seconds or 120s, 5m, 1h, from 1s on; not '" + text + "'");
    return seconds;
}

void interpret_tradeoff(RenderOptions& o) {
    if (o.tradeoff.empty()) return;
    if (!o.output.empty() || !o.contact_sheet.empty())
        throw CLI::ValidationError("--tradeoff",
                                   "writes its own files: leave -o and "
                                   "--contact-sheet out");
    if (o.session) throw CLI::ValidationError("--tradeoff", "takes a scene, not a session");
}

void interpret_target(const TradeGiven& given, RenderOptions& o) {
    if (!given.target_error.empty()) {
        std::optional<FrameTarget> target = parse_target_error(given.target_error);
        if (!target)
            throw CLI::ValidationError("--target-error",
                                       "takes a FLIP of 0.01 or flip:0.01, or rmse:0.01, above 0 "
                                       "and below 1; not '" +
                                           given.target_error + "'");
        o.frame_target = *target;
    }
    if (!o.frame_target.any()) return;
    const std::string option = o.frame_target.ms > 0 ? "--target-ms" : "--target-error";
    if (given.samples->count() > 0)
        throw CLI::ValidationError(option, "chooses the samples: leave --spp out");
    if (o.session) throw CLI::ValidationError(option, "takes a scene, not a session");
    if (o.output.empty() && o.contact_sheet.empty())
        throw CLI::ValidationError(option, "is of frames that are rendered: give -o FILE");
}

}  // namespace

void declare_trade(CLI::App& app, TradeGiven& given, RenderOptions& o) {
    given.samples = app.get_option("--spp");
    auto* trade = app.add_option("--tradeoff", o.tradeoff,
                                 "FOLDER: renders no frames, but measures what each setting of "
                                 "--knobs costs and gets wrong: tradeoff.html, .json and .csv");
    app.add_option("--budget", given.budget, "wall time of --tradeoff: 120s, 5m (120s)")
        ->needs(trade);
    add_list(app, "--assert", o.asserts,
             "preset=final:flip<0.01: exit 1 where --tradeoff measures otherwise (repeatable)")
        ->needs(trade);
    auto* ms = app.add_option("--target-ms", o.frame_target.ms,
                              "chooses settings and samples so that frames take this wall time in "
                              "the mean, without writing")
                   ->check(CLI::Range(kLeastTarget_ms, kMostTarget_ms))
                   ->excludes(trade);
    app.add_option("--target-error", given.target_error,
                   "0.01 or rmse:0.01: chooses settings and each frame's samples so "
                   "that it is no further from reference (FLIP, or RMSE)")
        ->excludes(trade)
        ->excludes(ms);
    app.add_option("--measured", o.measured,
                   "tradeoff.json or its folder, from which --target-ms and --target-error take "
                   "their settings if it is of the same scene and options")
        ->excludes(trade);
}

void interpret_trade(const TradeGiven& given, RenderOptions& o) {
    if (!given.budget.empty()) o.budget = parse_budget(given.budget);
    interpret_tradeoff(o);
    interpret_target(given, o);
    if (!o.measured.empty() && !o.frame_target.any())
        throw CLI::ValidationError("--measured", "goes with --target-ms or --target-error");
}

}  // namespace kinora
