// runtime/programs/tradeoff/measurement.cpp: the plan, the references, the bases, the end.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string_view>

#include "runtime/base/check.h"
#include "runtime/base/parallel.h"
#include "runtime/programs/tradeoff/frames.h"
#include "runtime/programs/tradeoff/measurement_p.h"
#include "runtime/programs/tradeoff/survey.h"
#include "runtime/programs/tradeoff/thumbnails.h"
#include "runtime/programs/tradeoff/trial.h"

namespace kinora {

namespace {

constexpr std::string_view kSamplesOption = "spp";
constexpr double kFramesShare = 0.05;  // of the budget, to find the fastest frame
constexpr int kCalibrationPart = 8;    // of a reference's samples
constexpr double kMostCorrection = 8;  // more is the clock's fault
constexpr double kSurveyShare = 0.1;   // likewise, to find settings that do nothing

}  // namespace

double median_of(std::vector<double> values) {
    return median_interval(std::move(values)).median;
}

void add_stage_shares(TradeWork& work, const TimedFrame& timed) {
    for (size_t s = 0; s < kStageCount; ++s) work.stage_shares[s] += timed.stages[s] / timed.cpu_ms;
}

void Measurement::tell(const std::string& text) const {
    if (request_.tell) std::fprintf(stderr, "%s\n", text.c_str());
}

bool Measurement::run() {
    results_.budget_s = request_.budget_s;
    if (!build_bases() || !look_ahead() || !make_plan()) return false;
    if (!make_reference() || !measure_bases()) return false;
    measure_variants();
    if (renders_.stopped()) return false;
    finish();
    return true;
}

bool Measurement::build_bases() {
    Stopwatch watch;
    final_.scene = renders_.build(variants_[kFinalRow].quality);
    input_.costs.build = watch.ms();
    preview_.scene = renders_.build(variants_[kPreviewRow].quality);
    reference_scene_ = renders_.build(variants_[kReferenceRow].quality);
    if (!final_.scene || !preview_.scene || !reference_scene_) return false;
    FrameSettings settings = renders_.settings_of(final_.scene);
    renders_.set_settings(settings);
    results_.asked_width = settings.width;
    results_.asked_height = settings.height;
    return !renders_.stopped();
}

// The frames, what renders cost, and what the variants do.
bool Measurement::look_ahead() {
    const double budget_ms = 1e3 * request_.budget_s;
    ChosenFrames chosen =
        choose_trade_frames(request_.frames, renders_, final_.scene, kFramesShare * budget_ms);
    results_.frames = std::move(chosen.frames);
    results_.fastest_step = chosen.fastest_step;
    const double build_ms = input_.costs.build;
    input_.costs = trial_costs(renders_, {.final_scene = final_.scene,
                                          .reference_scene = reference_scene_,
                                          .frame = results_.frames[0],
                                          .width = results_.asked_width,
                                          .height = results_.asked_height,
                                          .budget_ms = budget_ms});
    input_.costs.build = build_ms;
    survey();
    calibrate();
    return !renders_.stopped();
}

// A longer render of the size to come tells better what a sample takes than the trial's few.
void Measurement::calibrate() {
    fill_plan_input();
    const Plan plan = choose_plan(input_);
    Quality quality = variants_[kReferenceRow].quality;
    quality.samples_per_pixel = std::max(1, plan.reference_samples / kCalibrationPart);
    renders_.set_size(plan.width, plan.height);
    raytrace::Film scrap;
    const double ms =
        renders_.frame(reference_scene_, quality, results_.frames[0], 1, scrap).wall_ms;
    TrialCosts& costs = input_.costs;
    const double estimated = costs.reference_sample * double(quality.samples_per_pixel) *
                             double(plan.width) * double(plan.height);
    if (!(estimated > 0) || !(ms > costs.frame)) return;
    const double scale =
        std::clamp((ms - costs.frame) / estimated, 1 / kMostCorrection, kMostCorrection);
    costs.sample *= scale;
    costs.reference_sample *= scale;
}

void Measurement::survey() {
    const std::vector<SurveyedVariant> found =
        survey_variants(renders_,
                        {.variants = variants_,
                         .frames = results_.frames,
                         .preview_scene = &preview_.scene,
                         .final_scene = &final_.scene,
                         .width = results_.asked_width,
                         .height = results_.asked_height,
                         .most_ms = kSurveyShare * 1e3 * request_.budget_s},
                        surveyed_);
    for (size_t v = 0; v < variants_.size(); ++v) {
        const Variant& variant = variants_[v];
        const bool of_final = variant.base == kFinalRow;
        input_.variants.push_back(
            {.samples = variant.quality.samples_per_pixel,
             .base_samples = qualities()[variant.base].samples_per_pixel,
             .final_base = of_final,
             .follows = variant.knob && variant.knob->option != kSamplesOption,
             .preset = variant.kind == VariantKind::Preset,
             // The reference and the bases are estimated by themselves.
             .same = found[v].same || v == kReferenceRow,
             .weight = found[v].weight,
             .base_weight = of_final ? 1 : found[kPreviewRow].weight});
    }
}

void Measurement::fill_plan_input() {
    input_.width = results_.asked_width;
    input_.height = results_.asked_height;
    input_.frames = results_.frames.size();
    input_.budget_ms = 1e3 * request_.budget_s;
    input_.used_ms = watch_.ms();
    input_.reference_samples = qualities()[kReferenceRow].samples_per_pixel;
    input_.combinations = request_.combinations;
    input_.sample_settings.clear();
    const Knob& spp = *find_knob(kSamplesOption);
    for (std::string_view setting : spp.settings)
        input_.sample_settings.push_back(int(*knob_value(spp, setting)));
}

bool Measurement::make_plan() {
    fill_plan_input();
    const Plan& plan = results_.plan = choose_plan(input_);
    if (!plan.fits && input_.used_ms + plan.least_ms > input_.budget_ms) {
        std::fprintf(stderr,
                     "kinora-render: error: --budget: %g s are too little: the references and the "
                     "presets alone take some %.0f s at %dx%d pixels\n",
                     request_.budget_s, 1e-3 * (input_.used_ms + plan.least_ms), plan.width,
                     plan.height);
        return false;
    }
    make_rows();
    if (plan.final_samples > 0) lower(final_, plan.final_samples);
    if (plan.preview_samples > 0) lower(preview_, plan.preview_samples);
    results_.frames.resize(plan.frames);
    renders_.set_size(plan.width, plan.height);
    tell("tradeoff: " + plan_text(results_));
    return true;
}

// All variants and the combinations of the plan, of settings that do something.
void Measurement::make_rows() {
    CombinationRequest request{.count = results_.plan.combinations,
                               .most_samples = results_.plan.combination_samples};
    for (const Knob& knob : knobs()) {
        bool same = true;
        for (size_t v = 0; v < variants_.size(); ++v)
            if (variants_[v].knob == &knob) same = same && input_.variants[v].same;
        if (same) request.fixed.push_back(&knob);
    }
    add_combinations(variants_, request);
    for (size_t v = 0; v < variants_.size(); ++v) {
        Variant& variant = variants_[v];
        if (v >= input_.variants.size())
            input_.variants.push_back({.samples = variant.quality.samples_per_pixel,
                                       .base_samples = qualities()[variant.base].samples_per_pixel,
                                       .final_base = variant.base == kFinalRow});
        TradeRow row{.variant = std::move(variant)};
        row.as_base = v != kReferenceRow && input_.variants[v].same;
        if (row.as_base) row.not_measured = "the same bits and counts as its base in " + surveyed_;
        results_.rows.push_back(std::move(row));
    }
}

// The knobs of a preset are measured with fewer samples: the row of --spp is their base.
void Measurement::lower(TradeBase& base, int samples) {
    const size_t preset = base.row;
    const auto at = std::ranges::find_if(results_.rows, [&](const TradeRow& row) {
        return row.variant.base == preset && row.variant.knob &&
               row.variant.knob->option == kSamplesOption &&
               row.variant.quality.samples_per_pixel == samples;
    });
    CHECK(at != results_.rows.end());
    base.row = size_t(at - results_.rows.begin());
    for (size_t r = 0; r < results_.rows.size(); ++r) {
        Variant& variant = results_.rows[r].variant;
        if (variant.base != preset) continue;
        variant.base = base.row;
        variant.quality.samples_per_pixel = in_plan(input_.variants[r], results_.plan).samples;
    }
}

// Two references, each beside a render of `final`; their mean is what all is compared with.
bool Measurement::reference_frame(size_t f, TradeWork& work) {
    const Quality& quality = work.row->variant.quality;
    raytrace::Film films[2], scrap;
    for (uint32_t seed = 0; seed < 2; ++seed) {
        TimedFrame base =
            renders_.frame(final_.scene, quality_of(final_), results_.frames[f], 0, scrap);
        TimedFrame timed =
            renders_.frame(reference_scene_, quality, results_.frames[f], seed + 1, films[seed]);
        if (!timed.whole || !base.whole) return false;
        final_.cpu_ms[f].push_back(base.cpu_ms);
        work.ratios.push_back(timed.cpu_ms / base.cpu_ms);
        work.wall_ms.push_back(timed.wall_ms);
        add_stage_shares(work, timed);
    }
    work.errors.push_back(picture_errors(view_of(films[1]), view_of(films[0])));
    raytrace::Film mean = films[0];
    for (size_t i = 0; i < mean.rgba.size(); ++i)
        mean.rgba[i] = 0.5f * (films[0].rgba[i] + films[1].rgba[i]);
    if (f == 0) results_.reference_png = picture_thumbnail(mean, encoding_of(request_.scene));
    references_.emplace_back(view_of(mean));
    reference_posed_.push_back(posed(reference_scene_, quality, f, true));
    return true;
}

// Where the references take longer than the trial said, later frames are left out.
void Measurement::keep_frames(size_t count) {
    Plan& plan = results_.plan;
    plan.rounds = (plan.frames * plan.rounds + count - 1) / count;
    plan.preset_rounds = (plan.frames * plan.preset_rounds + count - 1) / count;
    plan.frames = count;
    results_.frames.resize(count);
    for (TradeBase* base : {&preview_, &final_}) base->cpu_ms.resize(count);
    tell(fmt::format("tradeoff: the references take longer than estimated: {} frames are measured",
                     count));
}

bool Measurement::make_reference() {
    TradeRow& row = results_.rows[kReferenceRow];
    Quality& quality = row.variant.quality;
    if (quality.samples_per_pixel != results_.plan.reference_samples)
        row.variant.name += fmt::format(" of {} samples", results_.plan.reference_samples);
    quality.samples_per_pixel = results_.plan.reference_samples;
    TradeWork work{.row = &row, .index = kReferenceRow, .scene = &reference_scene_};
    work.same = false;
    for (TradeBase* base : {&preview_, &final_}) base->cpu_ms.resize(results_.frames.size());
    Stopwatch watch;
    const double most_ms = kReferenceShare * 1e3 * request_.budget_s;
    for (size_t f = 0; f < results_.frames.size(); ++f) {
        if (!reference_frame(f, work)) return false;
        const double next_ms = watch.ms() / double(f + 1) * double(f + 2);
        if (f + 1 < results_.frames.size() && next_ms > most_ms) keep_frames(f + 1);
    }
    results_.reference_s = 1e-3 * watch.ms();
    row.errors.picture = mean_errors(work.errors);
    row.errors.vertex_units = row.errors.vertex_pixels = 0;
    results_.floor = row.errors;
    row.picture_png = results_.reference_png;
    conclude(work);
    tell(fmt::format(
        "tradeoff: noise floor FLIP {:.4f}, RMSE {:.5f}; references {:.1f} s, all {:.1f} s",
        results_.floor.picture.flip, results_.floor.picture.rmse, results_.reference_s,
        1e-3 * watch_.ms()));
    return true;
}

// Where nothing of the two renders differs but the noise of the machine.
bool Measurement::measure_bases() {
    for (TradeBase* measured : {&preview_, &final_}) {
        TradeBase& base = *measured;
        TradeWork work{.row = &results_.rows[base.row], .index = base.row, .scene = &base.scene};
        const Quality& quality = work.row->variant.quality;
        for (size_t f = 0; f < results_.frames.size(); ++f) {
            renders_.frame(base.scene, quality, results_.frames[f], 0, work.film);  // warms up
            for (size_t round = 0; round < results_.plan.rounds; ++round) {
                TimedFrame timed =
                    renders_.frame(base.scene, quality, results_.frames[f], 0, work.film);
                if (!timed.whole) return false;
                base.cpu_ms[f].push_back(timed.cpu_ms);
                work.wall_ms.push_back(timed.wall_ms);
                add_stage_shares(work, timed);
            }
            compare(work, base, f, f == 0);
            base.films.push_back(work.film);
            base.errors.push_back(work.errors.back());
            probe(work, f);
        }
        work.same = true;
        conclude(work);
    }
    return true;
}

double Measurement::base_ms(size_t base) {
    double sum = 0;
    const auto& frames = base_of(base).cpu_ms;
    for (const std::vector<double>& of_frame : frames) sum += median_of(of_frame);
    return sum / double(frames.size());
}

void Measurement::finish() {
    for (TradeRow& row : results_.rows) {
        if (!row.measured()) continue;
        const double ms = base_ms(row.variant.base);
        MedianInterval& interval = row.times.ms;
        interval = {interval.median * ms, interval.low * ms, interval.high * ms, interval.cover};
        for (double& stage : row.times.stages) stage *= interval.median;
    }
    // The bases' own: of their renders, which are the most.
    for (const TradeBase* base : {&preview_, &final_}) {
        std::vector<double> ratios;
        for (const std::vector<double>& of_frame : base->cpu_ms)
            for (double ms : of_frame) ratios.push_back(ms / median_of(of_frame));
        TradeTimes& times = results_.rows[base->row].times;
        MedianInterval spread = median_interval(ratios);
        times.count = ratios.size();
        times.ms = {times.ms.median, times.ms.median * spread.low, times.ms.median * spread.high,
                    spread.cover};
    }
    results_.used_s = 1e-3 * watch_.ms();
    mark_front(results_);
}

bool measure_tradeoff(const TradeoffRequest& request, Diagnostics& diagnostics,
                      TradeResults& results) {
    results.scene = request.scene.scene;
    results.fingerprint = request.fingerprint;
    const jit::Target* target = request.scene.target;
    results.target = target ? target->name : jit::best_target().name;
    results.threads = thread_count();
    return Measurement(request, diagnostics, results).run();
}

}  // namespace kinora
