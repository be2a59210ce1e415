// runtime/picture/shading/nested_rays.cpp: rays that shaders shoot, set up here for all services,
// and what they see.
#include "runtime/picture/shading/nested_rays.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "raytrace/hits.h"
#include "raytrace/sampling.h"
#include "rsl/model/renderer_services.h"
#include "runtime/picture/shading/hit_shader.h"
#include "runtime/picture/shading/transmission.h"
#include "runtime/scene/scene.h"

namespace kinora {

namespace {

constexpr float kLeastLight = 1e-4f;  // of what lies behind them, still worth a ray
// Each call of a point divides its ray's share by its number and 0.29, so that a way of one ray a
// hit still goes 16 deep, and two a hit end at some 400 rays instead of 2^16. Hits near the eye may
// shoot more: what they lack shows.
constexpr float kCallCost = 0.29f, kLeastShare[] = {0, 1.0f / 1024, 1.0f / 128, 1.0f / 64};
constexpr int kUsualDepth = 16;

}  // namespace

RayStart ray_start(const Grid& grid, size_t point, vec3 P) {
    RayStart start;
    const mat3& camera_from_accel = grid.frame.camera_from_accel;
    vec3 eye = grid.frame.eye;
    auto is_at = [&](const raytrace::HitBatch& hits, uint32_t hit) {
        vec3 on_surface = triple(hits.P, hit);
        start.hits = &hits;
        start.hit = hit;
        if (camera_from_accel * (on_surface - eye) != P) return false;
        start.P = on_surface;
        start.error = triple(hits.P_error, hit);
        start.Ng = triple(hits.Ng, hit);
        return true;
    };
    size_t last = std::min(point, grid.count() - 1);
    // A light on geometry has hits of its own: samples of its mesh.
    if (grid.lit && &grid.lit->hits != &grid.hits &&
        is_at(grid.lit->hits, grid.lit->points[grid.lit_first + last]))
        return start;
    if (is_at(grid.hits, grid.points[last])) return start;
    start.P = glm::transpose(camera_from_accel) * P + eye;
    // gamma(4) of the magnitudes bounds a rotation and a sum.
    start.error = (std::abs(P.x) + std::abs(P.y) + std::abs(P.z) + glm::abs(eye)) * 2.4e-7f;
    start.Ng = vec3(0.0f);
    return start;
}

void add_ray(raytrace::RayBatch& rays, const Grid& grid, const RayStart& start, vec3 dir,
             float tfar, float bias, uint32_t path, uint32_t slot, float share) {
    vec3 org;
    if (start.Ng != vec3(0.0f)) {
        org = raytrace::offset_ray_origin(start.P, start.error, start.Ng, dir);
    } else {
        float clear = 2 * std::max(start.error.x, std::max(start.error.y, start.error.z));
        org = start.P + dir * (clear / glm::length(dir));
    }
    size_t i = rays.count++;
    set_nested_ray(rays, i, org, dir, tfar >= kMiss ? std::numeric_limits<float>::infinity() : tfar,
                   *start.hits, start.hit);
    if (bias > 0) rays.tnear[i] = bias;
    if (!grid.scene.volumes.empty())
        rays.medium[i] = nested_medium(grid.scene, *start.hits, start.hit, dir);
    rays.sample[i] = path;
    rays.share[i] = share;
    rays.slot[i] = slot;
}

// Igehy, Tracing ray differentials, 1999: a ray that goes on spreads as itself, turned; one that
// goes back spreads as its mirror image and by the turn of the mirror's normal.
// runtime/picture/rays has the formulas, for sixteen rays.
void spread_ray(raytrace::RayBatch& rays, const Grid& grid, const raytrace::HitBatch& from,
                uint32_t hit) {
    if (!rays.spreads) return;
    size_t i = rays.count - 1;
    vec3 in = triple(from.dir, hit), out = triple(rays.dir, i), Ng = triple(from.Ng, hit);
    float before = glm::length(in), after = glm::length(out);
    if (!(before > 0 && after > 0)) return;
    in /= before;
    out /= after;
    bool back = glm::dot(in, Ng) * glm::dot(out, Ng) < 0;
    vec3 axis = back ? out - in : out + in;
    float square = glm::dot(axis, axis);
    auto turned = [&](vec3 d) {
        vec3 mirrored = square > 1e-12f ? d - axis * (2 * glm::dot(axis, d) / square) : d;
        // Mirrored at in + out and then along out, `in` comes to lie on `out`.
        vec3 result = back ? mirrored : mirrored + out * (2 * glm::dot(in, d));
        return result * (after / before);
    };
    vec3 dx = turned(triple(from.dDdx, hit)), dy = turned(triple(from.dDdy, hit));
    vec3 dNdx, dNdy;
    if (back && square > 1e-12f && on_surface(grid) &&
        SmoothSurface(grid.scene, grid.pose).bend_at(from, hit, dNdx, dNdy)) {
        const vec3 N = axis / std::sqrt(square);
        auto bent = [&](vec3 dN) {
            return (dN * glm::dot(in, N) + N * glm::dot(in, dN)) * (2 * after);
        };
        dx -= bent(dNdx);
        dy -= bent(dNdy);
    }
    set_triple(rays.dDdx, i, dx);
    set_triple(rays.dDdy, i, dy);
}

namespace {

// What a point's next call has for all its rays.
float share_left(Grid& grid, size_t point) {
    uint32_t hit = grid.points[std::min(point, grid.count() - 1)];
    float share = grid.hits.rays ? grid.hits.rays->share[grid.hits.ray[hit]] : 1.0f;
    float calls = 1;
    if (point < grid.calls.size()) {
        uint16_t& before = grid.calls[point];
        if (before < 0xffff) ++before;
        calls = before;
    }
    return share / (calls + kCallCost);
}

// Who asks for deeper rays gets them.
float least_share(const Grid& grid) {
    const float least = kLeastShare[std::min(grid.depth, 3u)];
    const int deeper = int(grid.frame.quality.ray_depth) - kUsualDepth;
    return deeper > 0 ? least * std::pow(1 + kCallCost, -float(deeper)) : least;
}

}  // namespace

float ray_share(Grid& grid, size_t point, int samples) {
    float share = share_left(grid, point) / std::sqrt(float(samples));
    return share < least_share(grid) ? 0 : share;
}

float fit_samples(Grid& grid, size_t point, int& samples) {
    float left = share_left(grid, point), least = least_share(grid);
    if (left < least * std::sqrt(float(samples))) {
        float fitting = left / least;
        samples = std::max(1, int(fitting * fitting));
    }
    return std::max(1e-6f, left / std::sqrt(float(samples)));
}

// ---- budgets ------------------------------------------------------------------------------------

namespace {

constexpr float kLeastRays = 16;  // that any point may shoot

float ray_budget(const Grid& grid, size_t point) {
    const PicturePoints& seen = grid.of_surface();  // a light spends what the lit points have
    const raytrace::HitBatch& hits = seen.hits;
    uint32_t hit = seen.points[point + (grid.lit ? grid.lit_first : 0)];
    float limit = float(grid.frame.quality.ray_limit);
    if (grid.depth == 0 || !hits.rays) return limit;
    return std::max(kLeastRays, limit * hits.rays->share[hits.ray[hit]]);
}

// The account of a point, null where nothing counts.
PointRays* account(Grid& grid, size_t point) {
    return point < grid.rays.size() ? &grid.rays[point] : nullptr;
}

void end_account(Grid& grid, PointRays& rays) {
    grid.memory.counters.out_of_rays += !rays.ended && !is_noting(grid);  // it runs again
    rays.ended = true;
}

}  // namespace

bool spend_rays(Grid& grid, size_t point, int n) {
    PointRays* rays = account(grid, point);
    if (!rays) return true;
    if (float(rays->shot) >= ray_budget(grid, point)) {
        end_account(grid, *rays);
        return false;
    }
    rays->shot += uint32_t(n);
    return true;
}

int spend_samples(Grid& grid, size_t point, int n) {
    PointRays* rays = account(grid, point);
    if (rays && grid.depth > 0) {
        float left = ray_budget(grid, point) - float(rays->shot);
        n = std::min(n, std::max(1, int(left)));
    }
    return spend_rays(grid, point, n) ? n : 0;
}

bool refuse_rays(Grid& grid, size_t point, int n) {
    PointRays* rays = account(grid, point);
    if (!rays) return true;
    bool before = rays->refused < grid.frame.quality.ray_limit;
    rays->refused += before ? uint32_t(n) : 0u;
    return before;
}

void end_loops(Grid& grid, const jit::ServiceCall& call) {
    for (int lane = 0; lane < jit::kMaxLanes; ++lane) {
        bool asks = call.mask >> lane & 1;
        PointRays* rays = asks ? account(grid, size_t(call.first + lane)) : nullptr;
        if (rays && rays->refused >= grid.frame.quality.ray_limit) end_account(grid, *rays);
        call.results[lane] = jit::float_of(int32_t(rays && rays->ended));
    }
}

// ---- one way of two -----------------------------------------------------------------------------

namespace {

constexpr float kLeastWeight = 1.0f / 256;  // of rays that are followed in any case
constexpr uint32_t kWaySalt = 0x3c6ef372u;

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

}  // namespace

TracedRay choose_way(Grid& grid, size_t point, float weight, float through) {
    uint32_t hit = grid.points[std::min(point, grid.count() - 1)];
    const raytrace::RayBatch* rays = grid.hits.rays;
    uint32_t ray = grid.hits.ray[hit];
    float before = rays ? rays->weight[ray] : 1.0f;
    PointRays* own = account(grid, point);
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
    float kept = std::min(1.0f, all / kLeastWeight);
    float reflects = kept * (reflected / all), goes_on = kept * (passing / all);
    float number = number_of_choice(grid.hits, hit, grid.frame.seed);
    if (number < reflects) {
        if (passes) own->onward = 0;
        return {1 / reflects, reflected / reflects};
    }
    if (passes) own->onward = number < reflects + goes_on ? 1 / goes_on : 0.0f;
    return {0, 0};
}

// Points that have a number of their own (steps of a march) have a series of their own, too.
raytrace::SampleSeries series_of(const Grid& grid, const Lanes& lanes, int lane,
                                 const raytrace::HitBatch& hits, uint32_t hit) {
    const bool is_hit = hits.depth == 0 && lanes.own(lane) == random_of(hits, hit, grid.frame.seed);
    return raytrace::series_of(
        is_hit ? series_of(hits, hit, grid.frame.seed) : raytrace::SampleSeries{lanes.own(lane)},
        lanes.site(lane));
}

RayTag deeper(const Grid& grid, RayKind kind, int32_t label) {
    RayTag tag = grid.ray;
    tag.kind = kind;
    tag.label = label;
    (kind == RayKind::Diffuse ? tag.diffuse : tag.specular) += 1;
    return tag;
}

// Rays that meet nothing (more) run through the atmosphere to the scene's end.
void NestedRays::see_beyond(const raytrace::RayBatch& rays, const raytrace::HitBatch& hits,
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

void NestedRays::see(raytrace::RayBatch& rays, uint32_t depth, const RayTag& tag,
                     ThreadMemory& memory, std::span<SeenByRay> seen) {
    const raytrace::Accel& accel = frame_.pose.accel;
    for (size_t r = 0; r < rays.count; ++r) seen[rays.slot[r]] = {};
    Arena::Mark mark = memory.arena.mark();
    for (int layer = 0; rays.count > 0; ++layer) {
        NestedWavefront nested(memory);
        nested->hits.reserve(kGridPoints);
        const raytrace::HitBatch& hits = raytrace::trace(accel, rays, raytrace::kMaskAll, depth,
                                                         nested->hits, memory.counters.trace);
        if (frame_.miss_distance > 0 && hits.count < rays.count)
            see_beyond(rays, hits, tag, memory, seen);
        if (hits.count == 0) break;
        if (layer == frame_.max_layers) {  // what is left is not seen
            for (size_t h = 0; h < hits.count; ++h) seen[rays.slot[hits.ray[h]]].open = vec3(0.0f);
            memory.counters.too_deep += hits.count;
            break;
        }
        Arena::Mark layer_mark = memory.arena.mark();
        raytrace::ShadeResult result = take_colors(memory.arena, hits.count);
        result.passages = memory.arena.allocate_span<raytrace::Passage>(hits.count).data();
        std::fill_n(result.passages, hits.count, raytrace::Passage{});
        hits_.shade(hits, tag, memory, result);
        size_t kept = 0;
        for (size_t h = 0; h < hits.count; ++h) {
            uint32_t r = hits.ray[h], slot = rays.slot[r];
            SeenByRay& at = seen[slot];
            at.color += at.open * triple(result.Ci, h);
            vec3 passing = vec3(1.0f) - stopped_by(triple(result.Oi, h));
            const raytrace::Passage& passage = result.passages[h];
            at.open *= passing * passage.onward;
            at.distance = std::min(at.distance, hits.t[h]);
            if (std::max(at.open.x, std::max(at.open.y, at.open.z)) < kLeastLight) {
                at.open = vec3(0.0f);
                continue;
            }
            uint32_t medium = medium_behind(frame_.scene, hits, h);
            raytrace::pass_through(accel, rays, kept, hits, h);
            rays.weight[kept] *= std::max({passing.x, passing.y, passing.z}) * passage.onward;
            rays.turns[kept] += passage.turns;
            rays.spent[kept] += passage.spent;
            rays.medium[kept++] = medium;
        }
        rays.passing = true;
        rays.count = kept;
        memory.arena.release(layer_mark);
    }
    rays.passing = false;
    memory.arena.release(mark);
}

}  // namespace kinora
