// runtime/programs/tradeoff/variants.cpp: rows of a trade-off, each rendered between two renders of
// its base.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

#include "runtime/base/parallel.h"
#include "runtime/programs/tradeoff/measurement_p.h"
#include "runtime/programs/tradeoff/probes.h"
#include "runtime/programs/tradeoff/thumbnails.h"
#include "runtime/scene/images/image_io.h"

namespace kinora {

namespace {

constexpr size_t kMostRounds = 16;
constexpr size_t kMostVerticesCompared = 1 << 14;  // of a shape
constexpr double kForReports = 0.02;               // of the budget
constexpr std::string_view kUlp = "ULP";           // the error of knobs that change arithmetic

bool same_bits(const raytrace::Film& a, const raytrace::Film& b) {
    return a.rgba.size() == b.rgba.size() &&
           std::memcmp(a.rgba.data(), b.rgba.data(), a.rgba.size() * sizeof(vec4)) == 0;
}

// Of presets, and of knobs that say so.
bool has_ulps(const Variant& variant) {
    return variant.kind == VariantKind::Preset || (variant.knob && variant.knob->error == kUlp);
}

void keep_most(std::optional<double>& most, std::optional<double> value) {
    if (value) most = std::max(most.value_or(0), *value);
}

}  // namespace

Posed Measurement::posed(PosedScene& scene, const Quality& quality, size_t f, bool colours) {
    Posed result;
    if (colours)
        renders_.centres(scene, quality, results_.frames[f], result.centres);
    else
        renders_.pose(scene, results_.frames[f].time);
    result.hits = hit_distances(*scene.pose);
    result.vertices = vertex_positions(*scene.scene, *scene.pose, kMostVerticesCompared);
    return result;
}

void Measurement::compare(TradeWork& work, TradeBase& base, size_t f, bool thumbnail) {
    const PictureDepth depth = work.row->variant.quality.depth;
    bool same = f < base.films.size() && same_bits(work.film, base.films[f]) &&
                depth == quality_of(base).depth;
    work.same = work.same && same;
    if (same && !thumbnail) {
        work.errors.push_back(base.errors[f]);
        return;
    }
    raytrace::Film written = work.film;
    round_to_depth(written, depth);
    Plane map;
    work.errors.push_back(references_[f].errors_of(view_of(written), &map));
    if (!thumbnail) return;
    work.row->picture_png = picture_thumbnail(written, encoding_of(request_.scene));
    work.row->flip_png = flip_thumbnail(map);
}

// What needs no noise: vertices, distances, and colours at pixels' centres.
void Measurement::probe(TradeWork& work, size_t f) {
    const Variant& variant = work.row->variant;
    TradeErrors& errors = work.row->errors;
    const bool colours = has_ulps(variant);
    const Posed& reference = reference_posed_[f];
    const Posed own = posed(*work.scene, variant.quality, f, colours);
    keep_most(errors.vertex_units, largest_step(own.vertices, reference.vertices));
    keep_most(errors.vertex_pixels, largest_step_pixels(*work.scene->scene, *work.scene->pose,
                                                        own.vertices, reference.vertices));
    HitErrors hits = hit_errors(own.hits, reference.hits);
    errors.hit_distance = std::max(errors.hit_distance, hits.distance);
    errors.hit_mismatch = std::max(errors.hit_mismatch, hits.mismatch);
    if (!colours) return;
    UlpErrors ulps =
        ulp_errors(view_of(own.centres), view_of(reference.centres), own.hits, reference.hits);
    keep_most(errors.ulp_max, ulps.max);
    keep_most(errors.ulp_p99, ulps.p99);
}

bool Measurement::prepare(TradeWork& work) {
    const Quality& quality = work.row->variant.quality;
    for (TradeBase* base : {&preview_, &final_})
        if (scene_key(quality) == scene_key(quality_of(*base))) work.scene = &base->scene;
    if (!work.scene) {
        Stopwatch watch;
        work.own = std::make_unique<PosedScene>(renders_.build(quality));
        work.row->times.build_ms = watch.ms();
        work.scene = *work.own ? work.own.get() : nullptr;
    }
    if (!work.scene) work.row->not_measured = "its scene could not be built";
    return work.scene != nullptr;
}

void Measurement::measure_frame(std::vector<TradeWork>& works, TradeBase& base, size_t f,
                                size_t round) {
    const Quality& base_quality = quality_of(base);
    raytrace::Film scrap;
    auto time_base = [&] {
        double ms = renders_.frame(base.scene, base_quality, results_.frames[f], 0, scrap).cpu_ms;
        base.cpu_ms[f].push_back(ms);
        return ms;
    };
    double before = time_base();
    std::vector<double> cpu_ms(works.size());
    std::vector<char> done(works.size());
    for (size_t w = 0; w < works.size() && !renders_.stopped(); ++w) {
        TradeWork& work = works[w];
        const Quality& quality = work.row->variant.quality;
        const PlannedVariant planned = in_plan(input_.variants[work.index], results_.plan);
        if (is_dear(planned) && round >= rounds_of(planned, results_.plan)) continue;
        if (round == 0) probe(work, f);
        TimedFrame timed = renders_.frame(*work.scene, quality, results_.frames[f], 0, work.film);
        cpu_ms[w] = timed.cpu_ms;
        done[w] = timed.whole;
        work.wall_ms.push_back(timed.wall_ms);
        add_stage_shares(work, timed);
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

void Measurement::conclude(TradeWork& work) {
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

double Measurement::row_ms(size_t row) const {
    return pace_ * variant_ms(input_, results_.plan, input_.variants[row]);
}

void Measurement::measure_some(const std::vector<size_t>& rows, size_t rounds) {
    std::vector<TradeWork> works;
    double frame_ms = 0;
    for (size_t r : rows) {
        TradeWork work{.row = &results_.rows[r], .index = r};
        if (prepare(work)) works.push_back(std::move(work));
        frame_ms += row_ms(r) / double(results_.plan.frames * results_.plan.rounds);
    }
    if (works.empty()) return;
    TradeBase& base = base_of(works[0].row->variant.base);
    bool late = false;
    for (size_t round = 0; round < rounds && !late; ++round)
        for (size_t f = 0; f < results_.frames.size() && !renders_.stopped() && !late; ++f) {
            late = (round > 0 || f > 0) && left_ms() < frame_ms;
            if (!late) measure_frame(works, base, f, round);
        }
    if (renders_.stopped()) return;
    for (TradeWork& work : works) {
        if (work.errors.size() == results_.frames.size())
            conclude(work);
        else
            work.row->not_measured = late ? "the budget was used up" : "its scene gives no picture";
    }
}

// Chunks of rows of one base: presets, then knobs, then combinations. What comes last is left out
// first.
std::vector<std::vector<size_t>> Measurement::chunks_of_rows() {
    std::vector<std::vector<size_t>> chunks;
    for (size_t base : {final_.row, preview_.row})
        for (size_t r = 0; r < results_.rows.size(); ++r) {
            TradeRow& row = results_.rows[r];
            bool done = r == preview_.row || r == final_.row || r == kReferenceRow;
            if (done || row.variant.base != base || !row.measured()) continue;
            const PlannedVariant planned = in_plan(input_.variants[r], results_.plan);
            if (is_beyond_reference(planned, results_.plan)) {
                row.not_measured = "more than a quarter of the reference's samples";
                continue;
            }
            auto fits = [&](const std::vector<size_t>& chunk) {
                const Variant& first = results_.rows[chunk[0]].variant;
                return chunk.size() < kVariantsBetweenBases && first.base == base &&
                       first.kind == row.variant.kind;
            };
            if (chunks.empty() || !fits(chunks.back())) chunks.emplace_back();
            chunks.back().push_back(r);
        }
    std::ranges::stable_sort(chunks, std::less<>(), [&](const std::vector<size_t>& chunk) {
        return results_.rows[chunk[0]].variant.kind;
    });
    return chunks;
}

// All rows get more rounds where there is time left.
void Measurement::measure_variants() {
    const Plan& plan = results_.plan;
    const std::vector<std::vector<size_t>> chunks = chunks_of_rows();
    auto cost_of = [&](const std::vector<size_t>& chunk) {
        double cost = 0;
        for (size_t r : chunk) cost += variant_ms(input_, plan, input_.variants[r]);
        return cost;
    };
    double planned = 0, done = 0;
    for (const std::vector<size_t>& chunk : chunks) planned += cost_of(chunk);
    const double begin = watch_.ms();
    for (const std::vector<size_t>& chunk : chunks) {
        const double cost = cost_of(chunk),
                     room = left_ms() - kForReports * 1e3 * request_.budget_s;
        const bool presets = results_.rows[chunk[0]].variant.kind == VariantKind::Preset;
        const double rounds = double(presets ? plan.preset_rounds : plan.rounds);
        if (done > 0) pace_ = (watch_.ms() - begin) / done;
        if (renders_.stopped() || room < pace_ * cost / rounds) {
            for (size_t r : chunk) results_.rows[r].not_measured = "the budget was used up";
            continue;
        }
        const double share = room / std::max(pace_ * (planned - done), 1e-9);
        const double wanted = std::clamp(std::floor(share * rounds), 1.0, double(kMostRounds));
        measure_some(chunk, size_t(wanted));
        done += cost * wanted / rounds;
        planned += cost * (wanted / rounds - 1);
    }
}

}  // namespace kinora
