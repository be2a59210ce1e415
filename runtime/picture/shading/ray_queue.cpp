// runtime/picture/shading/ray_queue.cpp: the stages of the queue of rays.
#include "runtime/picture/shading/ray_queue.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "raytrace/hits.h"
#include "rsl/model/renderer_services.h"
#include "runtime/picture/shading/dome.h"
#include "runtime/picture/shading/hit_shader.h"
#include "runtime/picture/shading/kernel_runner.h"
#include "runtime/picture/shading/transmission.h"

namespace kinora {

namespace {

constexpr float kLeastLight = 1e-4f;  // of what lies behind them, still worth a ray
constexpr float kLeastRays = 16;      // that any point may shoot

}  // namespace

bool is_too_deep(const RayKindRow& row, const Grid& grid, const ShaderInstance& look) {
    const ShadingFrame& frame = grid.frame;
    return is_too_deep(
        row, {grid.depth, grid.ray.diffuse, frame.quality.ray_depth, frame.bounces[look.index]});
}

void set_kind(raytrace::RayBatch& rays, size_t first, RayKind kind) {
    std::fill(rays.sees + first, rays.sees + rays.count, row_of(kind).sees);
}

PointBudget budget_of(Grid& grid, size_t point) {
    PointBudget budget;
    const uint32_t hit = grid.points[std::min(point, grid.count() - 1)];
    if (const raytrace::RayBatch* rays = grid.hits.rays)
        budget.share = rays->share[grid.hits.ray[hit]];
    budget.depth = grid.depth;
    budget.most_depth = grid.frame.quality.ray_depth;
    budget.most_refused = grid.frame.quality.ray_limit;
    budget.out_of_rays = &grid.memory.counters.out_of_rays;
    budget.thinned = &grid.memory.counters.thinned;
    if (point < grid.calls.size()) budget.calls = &grid.calls[point];
    if (point >= grid.rays.size()) return budget;
    budget.account = &grid.rays[point];
    budget.most = float(grid.frame.quality.ray_limit);
    const PicturePoints& seen = grid.of_surface();  // a light spends what the lit points have
    budget.allowance = budget.most;
    if (!seen.hits.rays) return budget;
    const uint32_t of_seen = seen.hits.ray[seen.points[point + (grid.lit ? grid.lit_first : 0)]];
    budget.allowance *= seen.hits.rays->allowance[of_seen];
    if (grid.depth == 0) return budget;
    const float share = seen.hits.rays->share[of_seen];
    budget.most = std::max(kLeastRays, budget.most * share);
    return budget;
}

// ---- one way of two -----------------------------------------------------------------------------

namespace {

// Of rays that are followed in any case; of those behind rays of many, each of which shows little.
constexpr float kLeastWeight = 1.0f / 256, kLeastScattered = 1.0f / 8;
constexpr uint32_t kWaySalt = 0x3c6ef372u, kPathSalt = 0x78dde6e4u;

// A number in [0, 1) for the choice at a hit: stratified over the samples of a pixel where these
// are known.
float number_of_choice(const raytrace::HitBatch& hits, uint32_t hit, uint32_t frame_seed) {
    if (hits.depth > 0)
        return float(raytrace::unit_interval(
            raytrace::hash(random_of(hits, hit, frame_seed), frame_seed, kWaySalt) & ~0xffu));
    uint32_t pixel = raytrace::hash(hits.pixel_x[hit], hits.pixel_y[hit], hits.layer[hit]);
    uint32_t seed = raytrace::hash(pixel, frame_seed, kWaySalt);
    return std::min(float(raytrace::stratified_sample(hits.sample[hit], seed).x), 0x1.fffffep-1f);
}

// How a ray goes on at a point that reflects `weight` of what a traced ray sees and lets `through`
// pass: both ways at its first hits, at later ones either, at random by its share. What the traced
// ray sees counts `factor` times (0: it is not shot). Below 0: not known; the way is followed.
TracedRay choose_way(Grid& grid, size_t point, PointRays* own, float weight, float through) {
    uint32_t hit = grid.points[std::min(point, grid.count() - 1)];
    const raytrace::RayBatch* rays = grid.hits.rays;
    uint32_t ray = grid.hits.ray[hit];
    float before = rays ? rays->weight[ray] : 1.0f;
    if (!(weight >= 0) || !own || !rays) return {1, before};
    float reflected = before * weight;
    if (!(reflected > 0)) return {0, 0};
    // A second call of the point has its ray alone to choose.
    bool passes = grid.goes_on && !own->reflects && through >= 0;
    own->reflects = true;
    float passing = passes ? before * through : 0.0f;
    float all = reflected + passing;
    bool first = std::max(rays->turns[ray], grid.depth) < grid.frame.quality.split;
    if (first || !std::isfinite(all)) return {1, reflected};
    // Rays that count for little end at random, those that are left count for more.
    float kept = std::min(1.0f, all / (grid.ray.scattered ? kLeastScattered : kLeastWeight));
    float reflects = kept * (reflected / all), goes_on = kept * (passing / all);
    float number = number_of_choice(grid.hits, hit, grid.frame.seed);
    if (number < reflects) {
        if (passes) own->onward = 0;
        return {1 / reflects, reflected / reflects};
    }
    if (passes) own->onward = number < reflects + goes_on ? 1 / goes_on : 0.0f;
    return {0, 0};
}

}  // namespace

// ---- plan ---------------------------------------------------------------------------------------

namespace {

// Whether rays of a kind may leave the points of a grid.
enum class Leave : uint8_t { Yes, TooDeep, Never };

Leave may_leave(const RayKindRow& row, const Grid& grid) {
    if (is_too_deep(row, grid, *grid.look)) return Leave::TooDeep;
    return grid.shadows && !grid.frame.stopped() ? Leave::Yes : Leave::Never;
}

// The rays of one lane.
struct LanePlan {
    int count = 0;
    float share = 0;
    float allowance = 0;
    TracedRay way;
};

LanePlan plan_by_share(Leave leave, Grid& grid, size_t point, const RayWish& wish) {
    LanePlan plan;
    if (!wish.shoots) return {wish.samples, 0, 0, {}};
    const PointBudget budget = budget_of(grid, point);
    auto refuse = [&] {
        const bool more = refuse_rays(budget, wish.samples);
        plan.count = more && wish.unshot ? wish.samples : 0;
        return plan;
    };
    if (leave == Leave::TooDeep || (leave == Leave::Never && wish.turns)) return refuse();
    if (leave == Leave::Never || !wish.aims) return plan;
    const float share = ray_share(budget, wish.samples);
    if (share == 0) return refuse();
    plan.way = choose_way(grid, point, budget.account, wish.weight, wish.through);
    if (!(plan.way.factor > 0)) return plan;
    const AllowedCall allowed = allow_rays(budget, wish.samples);
    if (!spend_rays(budget, allowed.samples)) return plan;
    plan.count = allowed.samples;
    plan.share = share;
    plan.allowance = allowed.each;
    return plan;
}

// Of a point, and each call its own: paths are followed at random by it.
float number_of_call(const Grid& grid, size_t point, const PointBudget& budget) {
    const uint32_t hit = grid.points[std::min(point, grid.count() - 1)];
    const uint32_t call = budget.account ? budget.account->calls : 0u;
    return float(raytrace::unit_interval(
        raytrace::hash(random_of(grid.hits, hit, grid.frame.seed), call, kPathSalt) & ~0xffu));
}

// Bounces that a path from the grid's points may take.
uint32_t bounces_left(const Grid& grid) {
    const ShadingFrame& frame = grid.frame;
    return std::min(frame.quality.ray_depth - grid.depth,
                    frame.bounces[grid.look->index] - grid.ray.diffuse);
}

void fit_to_allowance(const Grid& grid, size_t point, const PointBudget& budget, LanePlan& plan) {
    const AllowedCall allowed =
        allow_path(budget, plan.count, bounces_left(grid), number_of_call(grid, point, budget));
    plan.count = allowed.samples;
    plan.allowance = allowed.each;
    plan.way.factor = allowed.factor;
}

LanePlan plan_by_fit(Leave leave, Grid& grid, size_t point, const RayWish& wish) {
    const PointBudget budget = budget_of(grid, point);
    LanePlan plan{wish.samples, 0, 0, {}};
    const bool shoots = wish.shoots && wish.aims;
    if (leave == Leave::Yes) {
        plan.share = fit_samples(budget, plan.count);
        if (shoots) fit_to_allowance(grid, point, budget, plan);
        if (shoots && !spend_rays(budget, plan.count)) plan.count = 0;
    } else {
        if (shoots) refuse_rays(budget, plan.count);
        if (!wish.unshot) plan.count = 0;
    }
    if (!wish.aims) plan.count = 0;
    return plan;
}

LanePlan plan_by_samples(Leave leave, const PointBudget& budget, const RayWish& wish) {
    const bool shoots = leave == Leave::Yes && wish.aims;
    return {shoots ? spend_samples(budget, wish.samples) : 0, 1, 0, {}};
}

LanePlan plan_lane(const RayKindRow& row, Leave leave, Grid& grid, size_t point,
                   const RayWish& wish) {
    switch (row.budget) {
        case RayBudget::Share:
            return plan_by_share(leave, grid, point, wish);
        case RayBudget::Fit:
            return plan_by_fit(leave, grid, point, wish);
        case RayBudget::Samples:
            return plan_by_samples(leave, budget_of(grid, point), wish);
        case RayBudget::Free:
            break;
    }
    return {wish.samples, 1, 0, {}};
}

}  // namespace

// Calls of kinds that are noted see nothing meanwhile; calls of other kinds send nothing.
bool RayQueue::is_noting(const Grid& grid) {
    return grid.notes && grid.notes->open();
}

RayPlan RayQueue::plan(RayKind kind, Grid& grid, const Lanes& lanes,
                       FunctionRef<RayWish(int lane)> wish_of) const {
    const RayKindRow& row = row_of(kind);
    const Leave leave = may_leave(row, grid);
    const bool waits = !row.noted && is_noting(grid);
    RayPlan plan;
    for (int lane = 0; lane < jit::kMaxLanes; ++lane) {
        if (!lanes.asks(lane)) continue;
        RayWish wish = wish_of(lane);
        if (wish.samples == 0) continue;
        wish.samples = samples_at(grid.ray, wish.samples);
        const LanePlan own = plan_lane(row, leave, grid, lanes.point(lane), wish);
        plan.count[lane] = waits ? 0 : own.count;
        plan.share[lane] = own.share;
        plan.allowance[lane] = own.allowance / float(frame_.quality.ray_limit);
        plan.way[lane] = own.way;
    }
    return plan;
}

// ---- note or trace, shade, sum ------------------------------------------------------------------

namespace {

// Lamps that light the sender are not counted again by its rays of diffuse light, nor is what
// surrounds the scene by rays for its specular samples.
RayTag tag_of(const RayCall& call, int32_t label) {
    const RayKindRow& row = row_of(call.kind);
    RayTag tag = sent_tag(call.grid.ray, row, label);
    const ShaderInstance* sender = call.grid.of_surface().look;
    const bool diffuse = call.diffuse || row.type == RayType::Diffuse;
    const ShadingFrame& frame = call.grid.frame;
    tag.counted = diffuse        ? frame.counted[sender->index]
                  : call.counted ? frame.counted_specular[sender->index]
                                 : 0;
    if (call.scattered & call.lanes.mask()) {
        tag.scattered = true;
        tag.most_samples = frame.quality.samples_behind;
    }
    return tag;
}

RayCall part_of(const RayCall& call, const Lanes& lanes) {
    return {call.kind,  call.grid,      lanes,        call.plan,      call.rows,
            call.label, call.distances, call.diffuse, call.scattered, call.counted};
}

// Calls f with a part of the call for rays that are scattered, and one for those that are not.
template <class F>
void for_each_importance(const RayCall& call, F&& f) {
    const uint32_t all = call.lanes.mask();
    for (uint32_t lanes : {all & call.scattered, all & ~call.scattered})
        if (lanes == all)
            f(call);
        else if (lanes)
            f(part_of(call, Lanes(call.lanes, lanes)));
}

// Calls f with a part of the call for rays of each tag.
template <class F>
void for_each_tag(const RayCall& call, F&& f) {
    if (!call.plan.any()) return;
    for_each_importance(call, [&](const RayCall& alike) {
        if (call.label < 0) return f(alike, tag_of(alike, 0));
        alike.lanes.for_each_text(call.label, [&](const Lanes& lanes) {
            const RayCall part = part_of(alike, lanes);
            f(part, tag_of(part, lanes.integer(call.label, lanes.first())));
        });
    });
}

// Calls f(samples) for the samples of a call, as many at a time as a batch has room for.
template <class F>
void for_each_part(const RayCall& call, F&& f) {
    Arena& arena = call.grid.memory.arena;
    std::span<uint8_t> lane = arena.allocate_span<uint8_t>(kGridPoints);
    std::span<uint32_t> number = arena.allocate_span<uint32_t>(kGridPoints);
    PlannedSamples planned(call.lanes, call.plan);
    while (const size_t n = planned.take(lane.data(), number.data(), kGridPoints))
        f(SampleSpan{lane.first(n), number.first(n)});
}

}  // namespace

void RayQueue::send(const RayCall& call, const AddSamples& add, const SumSamples& sum) {
    for_each_tag(
        call, [&](const RayCall& alike, const RayTag& tag) { send_alike(alike, tag, add, sum); });
}

void RayQueue::send_alike(const RayCall& call, const RayTag& tag, const AddSamples& add,
                          const SumSamples& sum) {
    const RayKindRow& row = row_of(call.kind);
    Grid& grid = call.grid;
    RayNotes* notes = row.noted ? grid.notes : nullptr;
    if (notes && notes->open()) return notes->note(call, tag, add);
    Arena& arena = grid.memory.arena;
    Arena::Mark mark = arena.mark();
    if (auto found = notes ? notes->find(call) : std::nullopt) {
        for_each_part(call, [&](const SampleSpan& samples) {
            sum(samples, found->first(samples.size()));
            found = found->subspan(samples.size());
        });
    } else {
        std::span<SeenByRay> seen = arena.allocate_span<SeenByRay>(kGridPoints);
        NestedWavefront batch(grid.memory);
        raytrace::RayBatch& rays = batch->rays;
        rays.reserve(kGridPoints);
        for_each_part(call, [&](const SampleSpan& samples) {
            rays.count = 0;
            std::fill_n(seen.begin(), samples.size(), SeenByRay{});
            add(rays, samples, 0);
            set_kind(rays, 0, call.kind);
            if (row.finds == RayFinds::Color)
                see(rays, grid.depth + 1, tag, grid.memory, seen.first(samples.size()));
            else
                pass(rays, tag, grid.memory, call.distances, seen);
            sum(samples, seen.first(samples.size()));
        });
    }
    arena.release(mark);
}

void RayQueue::send(const RayCall& call, const AddSamples& add, const MeetSamples& meet) {
    ThreadMemory& memory = call.grid.memory;
    Arena::Mark mark = memory.arena.mark();
    NestedWavefront batch(memory);
    raytrace::RayBatch& rays = batch->rays;
    rays.reserve(kGridPoints);
    for_each_tag(call, [&](const RayCall& alike, const RayTag& tag) {
        for_each_part(alike, [&](const SampleSpan& samples) {
            rays.count = 0;
            add(rays, samples, 0);
            if (rays.count == 0) return;
            set_kind(rays, 0, call.kind);
            Arena::Mark part = memory.arena.mark();
            NestedWavefront below(memory);
            below->hits.reserve(kGridPoints);
            const raytrace::HitBatch& hits =
                raytrace::trace(frame_.pose.accel, rays, raytrace::kMaskAll, call.grid.depth + 1,
                                below->hits, memory.counters.trace);
            if (hits.count > 0 || hits_.dome().stands()) meet(samples, rays, hits, tag);
            memory.arena.release(part);
        });
    });
    memory.arena.release(mark);
}

// Rays that meet nothing (more) run through the atmosphere to the scene's end.
void RayQueue::see_beyond(const raytrace::RayBatch& rays, const raytrace::HitBatch& hits,
                          const RayTag& tag, ThreadMemory& memory, std::span<SeenByRay> seen) {
    Arena::Mark mark = memory.arena.mark();
    NestedWavefront nested(memory);
    nested->hits.reserve(kGridPoints);
    const raytrace::HitBatch& ends =
        raytrace::missed(rays, hits, frame_.miss_distance, nested->hits);
    raytrace::ShadeResult result = take_colors(memory.arena, ends.count);
    hits_.shade_misses(ends, tag, memory, result);
    for (size_t k = 0; k < ends.count; ++k) {
        SeenByRay& at = seen[rays.slot[ends.ray[k]]];
        at.color += at.open * triple(result.Ci, k);
        at.open *= vec3(1.0f) - stopped_by(triple(result.Oi, k));
    }
    memory.arena.release(mark);
}

void RayQueue::dim(const RayTag& tag, std::span<SeenByRay> seen) const {
    if (!tag.scattered || frame_.quality.clamp_indirect == 0) return;
    for (SeenByRay& ray : seen) ray.color = dimmed(ray.color, frame_.quality.clamp_indirect);
}

void RayQueue::see(raytrace::RayBatch& rays, uint32_t depth, const RayTag& tag,
                   ThreadMemory& memory, std::span<SeenByRay> seen) {
    for (size_t r = 0; r < rays.count; ++r) seen[rays.slot[r]] = {};
    Arena::Mark mark = memory.arena.mark();
    for (int layer = 0; rays.count > 0; ++layer) {
        NestedWavefront nested(memory);
        nested->hits.reserve(kGridPoints);
        const raytrace::HitBatch& hits =
            raytrace::trace(frame_.pose.accel, rays, raytrace::kMaskAll, depth, nested->hits,
                            memory.counters.trace);
        if (frame_.miss_distance > 0 && hits.count < rays.count)
            see_beyond(rays, hits, tag, memory, seen);
        if (hits.count == 0) break;
        if (layer == frame_.max_layers) {  // what is left is not seen
            for (size_t h = 0; h < hits.count; ++h) seen[rays.slot[hits.ray[h]]].open = vec3(0.0f);
            memory.counters.too_deep += hits.count;
            break;
        }
        see_layer(rays, hits, tag, memory, seen);
    }
    rays.passing = false;
    dim(tag, seen);
    memory.arena.release(mark);
}

// Adds what hits show; the batch becomes the rays that go on behind them.
void RayQueue::see_layer(raytrace::RayBatch& rays, const raytrace::HitBatch& hits,
                         const RayTag& tag, ThreadMemory& memory, std::span<SeenByRay> seen) {
    Arena::Mark mark = memory.arena.mark();
    raytrace::ShadeResult result = take_colors(memory.arena, hits.count);
    result.passages = memory.arena.allocate_span<raytrace::Passage>(hits.count).data();
    std::fill_n(result.passages, hits.count, raytrace::Passage{});
    hits_.shade(hits, tag, memory, result);
    size_t kept = 0;
    for (size_t h = 0; h < hits.count; ++h) {
        SeenByRay& at = seen[rays.slot[hits.ray[h]]];
        at.color += at.open * triple(result.Ci, h);
        vec3 passing = vec3(1.0f) - stopped_by(triple(result.Oi, h));
        const raytrace::Passage& passage = result.passages[h];
        at.open *= passing * passage.onward;
        at.distance = std::min(at.distance, hits.t[h]);
        if (std::max(at.open.x, std::max(at.open.y, at.open.z)) < kLeastLight) {
            at.open = vec3(0.0f);
            continue;
        }
        uint32_t medium = medium_behind(frame_, hits, h);
        raytrace::pass_through(frame_.pose.accel, rays, kept, hits, h);
        rays.weight[kept] *= std::max({passing.x, passing.y, passing.z}) * passage.onward;
        rays.turns[kept] += passage.turns;
        rays.spent[kept] += passage.spent;
        rays.allowance[kept] *= passage.kept;
        rays.medium[kept++] = medium;
    }
    rays.passing = true;
    rays.count = kept;
    memory.arena.release(mark);
}

// The nearest surface along each ray.
void RayQueue::find_distances(const raytrace::RayBatch& rays, ThreadMemory& memory,
                              std::span<SeenByRay> seen) const {
    NestedWavefront nested(memory);
    nested->hits.reserve(kGridPoints);
    const raytrace::HitBatch& hits = raytrace::trace(frame_.pose.accel, rays, raytrace::kMaskAll, 1,
                                                     nested->hits, memory.counters.trace);
    for (size_t h = 0; h < hits.count; ++h) seen[rays.slot[hits.ray[h]]].distance = hits.t[h];
}

void RayQueue::pass(raytrace::RayBatch& rays, const RayTag& tag, ThreadMemory& memory,
                    bool distances, std::span<SeenByRay> seen) {
    const size_t count = rays.count;
    for (size_t r = 0; r < count; ++r) seen[rays.slot[r]] = {};
    if (distances) find_distances(rays, memory, seen);
    Arena::Mark mark = memory.arena.mark();
    std::span<vec3> through = memory.arena.allocate_span<vec3>(count);
    transmission_.pass(rays, tag, memory, through);
    for (size_t slot = 0; slot < count; ++slot) seen[slot].open = through[slot];
    memory.arena.release(mark);
}

bool sends_noted_rays(const ShaderInstance& look, const Grid& grid) {
    return std::ranges::any_of(ray_kinds(), [&](const RayKindRow& row) {
        return row.noted && !is_too_deep(row, grid, look) && calls_service(look.full, row.kind);
    });
}

}  // namespace kinora
