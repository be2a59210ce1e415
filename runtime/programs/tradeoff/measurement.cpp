// runtime/programs/tradeoff/measurement.cpp: renders the references, then each variant between two
// renders of its base, so that what else the machine does changes both.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <string_view>

#include "runtime/base/check.h"
#include "runtime/base/parallel.h"
#include "runtime/base/stats.h"
#include "runtime/programs/tradeoff/frames.h"
#include "runtime/programs/tradeoff/probes.h"
#include "runtime/programs/tradeoff/renders.h"
#include "runtime/programs/tradeoff/thumbnails.h"
#include "runtime/programs/tradeoff/tradeoff.h"
#include "runtime/programs/tradeoff/trial.h"

namespace kinora {

namespace {

constexpr size_t kPreviewRow = 1, kFinalRow = 2, kReferenceRow = 3;
constexpr size_t kMostRounds = 5;
constexpr size_t kMostVerticesCompared = 1 << 14;  // of a shape
constexpr std::string_view kSamplesOption = "spp";
constexpr double kFramesShare = 0.05;  // of the budget, to find the fastest frame

// A scene and what its frames were without noise.
struct Posed {
    std::vector<float> hits;
    std::vector<std::vector<dvec3>> vertices;
    raytrace::Film centres;
};

struct Base {
    size_t row;
    std::unique_ptr<Scene> scene{};
    std::vector<raytrace::Film> films{};        // by frame
    std::vector<PictureErrors> errors{};        // by frame
    std::vector<std::vector<double>> cpu_ms{};  // by frame, all renders
};

// What a row is made of while it is measured.
struct Work {
    TradeRow* row = nullptr;
    Scene* scene = nullptr;
    std::unique_ptr<Scene> own{};  // where no base has the same
    std::vector<double> ratios{}, wall_ms{};
    std::array<double, kStageCount> stage_shares{};
    std::vector<PictureErrors> errors{};
    bool same = true;
    raytrace::Film film{};
};

PictureView view_of(const raytrace::Film& film) {
    return {film.width, film.height, film.rgba};
}

bool same_bits(const raytrace::Film& a, const raytrace::Film& b) {
    return a.rgba.size() == b.rgba.size() &&
           std::memcmp(a.rgba.data(), b.rgba.data(), a.rgba.size() * sizeof(vec4)) == 0;
}

double median_of(std::vector<double> values) {
    return median_interval(std::move(values)).median;
}

class Measurement {
  public:
    Measurement(const TradeoffRequest& request, Diagnostics& diagnostics, TradeResults& results)
        : request_(request), renders_(request, diagnostics), results_(results) {}

    bool run() {
        results_.budget_s = request_.budget_s;
        for (Variant& variant : trade_variants(request_.combinations))
            results_.rows.push_back({.variant = std::move(variant)});
        if (!build_bases() || !make_plan() || !make_reference() || !measure_bases()) return false;
        measure_variants();
        if (renders_.stopped()) return false;
        finish();
        return true;
    }

  private:
    bool build_bases();
    bool make_plan();
    bool make_reference();
    bool reference_frame(size_t f, std::vector<double>& ratios, Work& work);
    bool measure_bases();
    void measure_variants();
    void measure_some(std::vector<size_t> rows, size_t rounds);
    bool prepare(Work& work);
    void measure_frame(std::vector<Work>& works, Base& base, size_t f, size_t round);
    void compare(Work& work, Base& base, size_t f, bool thumbnail);
    void probe(Work& work, size_t f);
    Posed posed(Scene& scene, const Quality& quality, size_t f);
    void conclude(Work& work);
    void finish();
    double base_ms(size_t base);
    void lower_final();
    Base& base_of(size_t row) { return row == preview_.row ? preview_ : final_; }
    const Quality& quality_of(const Base& base) const {
        return results_.rows[base.row].variant.quality;
    }
    double left_ms() const { return 1e3 * request_.budget_s - watch_.ms(); }
    void tell(const std::string& text) const {
        if (request_.tell) std::fprintf(stderr, "%s\n", text.c_str());
    }

    const TradeoffRequest& request_;
    TradeRenders renders_;
    TradeResults& results_;
    Stopwatch watch_;
    Base preview_{kPreviewRow}, final_{kFinalRow};
    std::unique_ptr<Scene> reference_scene_;
    std::vector<raytrace::Film> references_;  // by frame: the mean of two
    std::vector<Posed> reference_posed_;      // by frame
    PlanInput input_;
    double build_ms_ = 0;
};

bool Measurement::build_bases() {
    Stopwatch watch;
    final_.scene = renders_.build(results_.rows[kFinalRow].variant.quality);
    build_ms_ = watch.ms();
    preview_.scene = renders_.build(results_.rows[kPreviewRow].variant.quality);
    reference_scene_ = renders_.build(results_.rows[kReferenceRow].variant.quality);
    if (!final_.scene || !preview_.scene || !reference_scene_) return false;
    FrameSettings settings = renders_.settings_of(*final_.scene);
    renders_.set_settings(settings);
    results_.asked_width = settings.width;
    results_.asked_height = settings.height;
    return !renders_.stopped();
}

bool Measurement::make_plan() {
    ChosenFrames chosen = choose_trade_frames(request_.frames, renders_, *final_.scene,
                                              kFramesShare * 1e3 * request_.budget_s);
    results_.frames = std::move(chosen.frames);
    results_.fastest_step = chosen.fastest_step;
    input_.costs = trial_costs(renders_, *final_.scene, *reference_scene_, results_.frames[0],
                               results_.asked_width, results_.asked_height);
    input_.costs.build = build_ms_;
    if (renders_.stopped()) return false;
    input_.width = results_.asked_width;
    input_.height = results_.asked_height;
    input_.frames = results_.frames.size();
    input_.budget_ms = 1e3 * request_.budget_s;
    input_.used_ms = watch_.ms();
    input_.reference_samples = qualities()[kReferenceRow].samples_per_pixel;
    for (const TradeRow& row : results_.rows)
        input_.variants.push_back({.samples = row.variant.quality.samples_per_pixel,
                                   .base_samples = qualities()[row.variant.base].samples_per_pixel,
                                   .final_base = row.variant.base == kFinalRow,
                                   .follows = row.variant.base == kFinalRow &&
                                              row.variant.kind == VariantKind::Knob &&
                                              row.variant.knob->option != kSamplesOption});
    input_.needed = size_t(std::ranges::count_if(results_.rows, [](const TradeRow& row) {
        return row.variant.kind != VariantKind::Combination;
    }));
    const Plan& plan = results_.plan = choose_plan(input_);
    if (!plan.fits && input_.used_ms + plan.least_ms > input_.budget_ms) {
        std::fprintf(stderr,
                     "kinora-render: error: --budget: %g s are too little: the references and the "
                     "presets alone take some %.0f s at %dx%d pixels\n",
                     request_.budget_s, 1e-3 * (input_.used_ms + plan.least_ms), plan.width,
                     plan.height);
        return false;
    }
    if (plan.final_samples > 0) lower_final();
    results_.frames.resize(plan.frames);
    renders_.set_size(plan.width, plan.height);
    tell("tradeoff: " + plan_text(results_));
    return true;
}

// Final's knobs are measured with fewer samples: the row of --spp is their base.
void Measurement::lower_final() {
    const auto at = std::ranges::find_if(results_.rows, [&](const TradeRow& row) {
        return row.variant.base == kFinalRow && row.variant.knob &&
               row.variant.knob->option == kSamplesOption &&
               row.variant.quality.samples_per_pixel == results_.plan.final_samples;
    });
    CHECK(at != results_.rows.end());
    final_.row = size_t(at - results_.rows.begin());
    for (size_t r = 0; r < results_.rows.size(); ++r) {
        Variant& variant = results_.rows[r].variant;
        if (variant.base != kFinalRow) continue;
        variant.base = final_.row;
        variant.quality.samples_per_pixel = in_plan(input_.variants[r], results_.plan).samples;
    }
}

Posed Measurement::posed(Scene& scene, const Quality& quality, size_t f) {
    Posed result;
    renders_.centres(scene, quality, results_.frames[f], result.centres);
    result.hits = hit_distances(scene);
    result.vertices = vertex_positions(scene, kMostVerticesCompared);
    return result;
}

// Two references, each beside a render of `final`; their mean is what all is compared with.
bool Measurement::reference_frame(size_t f, std::vector<double>& ratios, Work& work) {
    Quality quality = work.row->variant.quality;
    raytrace::Film films[2], scrap;
    for (uint32_t seed = 0; seed < 2; ++seed) {
        TimedFrame base =
            renders_.frame(*final_.scene, quality_of(final_), results_.frames[f], 0, scrap);
        TimedFrame timed =
            renders_.frame(*reference_scene_, quality, results_.frames[f], seed + 1, films[seed]);
        if (!timed.whole || !base.whole) return false;
        final_.cpu_ms[f].push_back(base.cpu_ms);
        ratios.push_back(timed.cpu_ms / base.cpu_ms);
        work.wall_ms.push_back(timed.wall_ms);
        for (size_t s = 0; s < kStageCount; ++s)
            work.stage_shares[s] += timed.stages[s] / timed.cpu_ms;
    }
    work.errors.push_back(picture_errors(view_of(films[1]), view_of(films[0])));
    raytrace::Film mean = films[0];
    for (size_t i = 0; i < mean.rgba.size(); ++i)
        mean.rgba[i] = 0.5f * (films[0].rgba[i] + films[1].rgba[i]);
    if (f == 0) results_.reference_png = picture_thumbnail(mean, request_.scene.color);
    references_.push_back(std::move(mean));
    reference_posed_.push_back(posed(*reference_scene_, quality, f));
    return true;
}

bool Measurement::make_reference() {
    TradeRow& row = results_.rows[kReferenceRow];
    Quality& quality = row.variant.quality;
    if (quality.samples_per_pixel != results_.plan.reference_samples)
        row.variant.name += fmt::format(" of {} samples", results_.plan.reference_samples);
    quality.samples_per_pixel = results_.plan.reference_samples;
    Work work{.row = &row, .scene = reference_scene_.get()};
    work.same = false;
    for (Base* base : {&preview_, &final_}) base->cpu_ms.resize(results_.frames.size());
    Stopwatch watch;
    for (size_t f = 0; f < results_.frames.size(); ++f)
        if (!reference_frame(f, work.ratios, work)) return false;
    results_.reference_s = 1e-3 * watch.ms();
    row.errors.picture = mean_errors(work.errors);
    row.errors.vertex_units = row.errors.vertex_pixels = 0;
    results_.floor = row.errors;
    row.picture_png = results_.reference_png;
    conclude(work);
    tell(fmt::format("tradeoff: noise floor FLIP {:.4f}, RMSE {:.5f}; {:.1f} s",
                     results_.floor.picture.flip, results_.floor.picture.rmse, 1e-3 * watch_.ms()));
    return true;
}

void Measurement::compare(Work& work, Base& base, size_t f, bool thumbnail) {
    bool same = !base.films.empty() && f < base.films.size() && same_bits(work.film, base.films[f]);
    work.same = work.same && same;
    if (same && !thumbnail) {
        work.errors.push_back(base.errors[f]);
        return;
    }
    Plane map;
    work.errors.push_back(picture_errors(view_of(work.film), view_of(references_[f]), &map));
    if (!thumbnail) return;
    work.row->picture_png = picture_thumbnail(work.film, request_.scene.color);
    work.row->flip_png = flip_thumbnail(map);
}

// What needs no noise: vertices, distances, and colours at pixels' centres.
void Measurement::probe(Work& work, size_t f) {
    const Posed& reference = reference_posed_[f];
    Posed own = posed(*work.scene, work.row->variant.quality, f);
    TradeErrors& errors = work.row->errors;
    auto at_least = [](std::optional<double>& most, std::optional<double> value) {
        most = value ? std::optional(std::max(most.value_or(0), *value)) : most;
    };
    at_least(errors.vertex_units, largest_step(own.vertices, reference.vertices));
    at_least(errors.vertex_pixels,
             largest_step_pixels(*work.scene, own.vertices, reference.vertices));
    HitErrors hits = hit_errors(own.hits, reference.hits);
    errors.hit_distance = std::max(errors.hit_distance, hits.distance);
    errors.hit_mismatch = std::max(errors.hit_mismatch, hits.mismatch);
    UlpErrors ulps =
        ulp_errors(view_of(own.centres), view_of(reference.centres), own.hits, reference.hits);
    errors.ulp_max = std::max(errors.ulp_max, ulps.max);
    errors.ulp_p99 = std::max(errors.ulp_p99, ulps.p99);
}

// Where nothing of the two renders differs but the noise of the machine.
bool Measurement::measure_bases() {
    for (Base* measured : {&preview_, &final_}) {
        Base& base = *measured;
        Work work{.row = &results_.rows[base.row], .scene = base.scene.get()};
        for (size_t f = 0; f < results_.frames.size(); ++f) {
            raytrace::Film scrap;
            renders_.centres(*base.scene, work.row->variant.quality, results_.frames[f], scrap);
            for (size_t round = 0; round < results_.plan.rounds; ++round) {
                TimedFrame timed = renders_.frame(*base.scene, work.row->variant.quality,
                                                  results_.frames[f], 0, work.film);
                if (!timed.whole) return false;
                base.cpu_ms[f].push_back(timed.cpu_ms);
                work.wall_ms.push_back(timed.wall_ms);
                for (size_t s = 0; s < kStageCount; ++s)
                    work.stage_shares[s] += timed.stages[s] / timed.cpu_ms;
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

bool Measurement::prepare(Work& work) {
    const Quality& quality = work.row->variant.quality;
    for (const Base* base : {&preview_, &final_})
        if (scene_key(quality) == scene_key(quality_of(*base))) work.scene = base->scene.get();
    if (!work.scene) {
        Stopwatch watch;
        work.own = renders_.build(quality);
        work.row->times.build_ms = watch.ms();
        work.scene = work.own.get();
    }
    if (!work.scene) work.row->not_measured = "its scene could not be built";
    return work.scene != nullptr;
}

void Measurement::measure_frame(std::vector<Work>& works, Base& base, size_t f, size_t round) {
    const Quality& base_quality = quality_of(base);
    raytrace::Film scrap;
    auto time_base = [&] {
        double ms = renders_.frame(*base.scene, base_quality, results_.frames[f], 0, scrap).cpu_ms;
        base.cpu_ms[f].push_back(ms);
        return ms;
    };
    double before = time_base();
    std::vector<double> cpu_ms(works.size());
    std::vector<char> done(works.size());
    for (size_t w = 0; w < works.size() && !renders_.stopped(); ++w) {
        Work& work = works[w];
        const Quality& quality = work.row->variant.quality;
        if (round > 0 && quality.samples_per_pixel > kDearSamples) continue;
        if (round == 0) probe(work, f);
        TimedFrame timed = renders_.frame(*work.scene, quality, results_.frames[f], 0, work.film);
        cpu_ms[w] = timed.cpu_ms;
        done[w] = timed.whole;
        work.wall_ms.push_back(timed.wall_ms);
        for (size_t s = 0; s < kStageCount; ++s)
            work.stage_shares[s] += timed.stages[s] / timed.cpu_ms;
    }
    double mean = 0.5 * (before + time_base());
    if (renders_.stopped()) return;
    for (size_t w = 0; w < works.size(); ++w)
        if (done[w]) works[w].ratios.push_back(cpu_ms[w] / mean);
    if (round > 0) return;
    parallel_for(0, works.size(), 1, [&](size_t begin, size_t end) {
        for (size_t w = begin; w < end; ++w)
            if (done[w]) compare(works[w], base, f, f == 0);
    });
}

double Measurement::base_ms(size_t base) {
    double sum = 0;
    const auto& frames = base_of(base).cpu_ms;
    for (const std::vector<double>& of_frame : frames) sum += median_of(of_frame);
    return sum / double(frames.size());
}

void Measurement::conclude(Work& work) {
    TradeRow& row = *work.row;
    TradeTimes& times = row.times;
    const bool is_base = work.ratios.empty();
    row.same_picture = work.same;
    if (!work.errors.empty()) row.errors.picture = mean_errors(work.errors);
    times.count = is_base ? work.wall_ms.size() : work.ratios.size();
    times.wall_ms = median_of(work.wall_ms);
    times.ms = is_base ? MedianInterval{1, 1, 1, 0} : median_interval(work.ratios);
    times.ratio = times.ms.median;
    for (size_t s = 0; s < kStageCount; ++s)
        times.stages[s] = work.stage_shares[s] / double(work.wall_ms.size());
}

void Measurement::measure_some(std::vector<size_t> rows, size_t rounds) {
    std::vector<Work> works;
    for (size_t r : rows) {
        Work work{.row = &results_.rows[r]};
        if (prepare(work)) works.push_back(std::move(work));
    }
    if (works.empty()) return;
    Base& base = base_of(works[0].row->variant.base);
    for (size_t round = 0; round < rounds; ++round)
        for (size_t f = 0; f < results_.frames.size() && !renders_.stopped(); ++f)
            measure_frame(works, base, f, round);
    if (renders_.stopped()) return;
    for (Work& work : works) {
        if (work.errors.size() < results_.frames.size())
            work.row->not_measured = "its scene gives no picture";
        else
            conclude(work);
    }
}

// Chunks of variants of one base. Those that come last are left out where time has run out, and all
// get more rounds where there is some left.
void Measurement::measure_variants() {
    std::vector<std::vector<size_t>> chunks;
    double planned = 0;
    for (size_t base : {final_.row, preview_.row})
        for (size_t r = 0; r < results_.rows.size(); ++r) {
            TradeRow& row = results_.rows[r];
            bool done = r == preview_.row || r == final_.row || r == kReferenceRow;
            if (done || row.variant.base != base) continue;
            if (row.variant.quality.samples_per_pixel > results_.plan.reference_samples) {
                row.not_measured = "more samples than the budget's reference has";
                continue;
            }
            bool fresh = chunks.empty() || chunks.back().size() == kVariantsBetweenBases ||
                         results_.rows[chunks.back()[0]].variant.base != base;
            if (fresh) chunks.emplace_back();
            chunks.back().push_back(r);
            planned += variant_ms(input_, results_.plan, r);
        }
    // What is left out first is what is asked for last.
    std::ranges::stable_sort(chunks, std::less<>(), [&](const std::vector<size_t>& chunk) {
        return results_.rows[chunk[0]].variant.kind;
    });
    const double begin = watch_.ms();
    double done = 0;
    for (const std::vector<size_t>& chunk : chunks) {
        double cost = 0;
        for (size_t r : chunk) cost += variant_ms(input_, results_.plan, r);
        const double spent = watch_.ms() - begin;
        const double pace = done > 0 ? spent / done : 1;
        const double room = left_ms() - 0.02 * 1e3 * request_.budget_s;
        if (renders_.stopped() || room < pace * cost / double(results_.plan.rounds)) {
            for (size_t r : chunk) results_.rows[r].not_measured = "the budget was used up";
            continue;
        }
        const double share = room / std::max(pace * (planned - done), 1e-9);
        const double wanted = std::floor(share * double(results_.plan.rounds));
        measure_some(chunk, size_t(std::clamp(wanted, 1.0, double(kMostRounds))));
        done += cost;
    }
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
    for (const Base* base : {&preview_, &final_}) {
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

}  // namespace

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
