// runtime/picture/shading/lane_rays.cpp: rays that leave hits, one by one; those of a call's lanes,
// made sixteen at a time.
#include "runtime/picture/shading/lane_rays.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "raytrace/hits.h"
#include "runtime/picture/columns/kernels.h"
#include "runtime/picture/shading/rays/smooth_surface.h"
#include "runtime/picture/shading/volumes.h"

namespace kinora {

void inherit(raytrace::RayBatch& rays, size_t first, const raytrace::HitBatch& from,
             std::span<const uint32_t> hits) {
    const size_t count = hits.size();
    auto copy = [&](const auto* column, auto* to) {
        for (size_t i = 0; i < count; ++i) to[first + i] = column[hits[i]];
    };
    auto fill = [&](auto* to, auto value) { std::fill_n(to + first, count, value); };
    for (size_t k = 0; k < 3; ++k) {
        std::copy_n(rays.org[k] + first, count, rays.first_org[k] + first);
        if (!rays.spreads) continue;
        copy(from.dPdx[k], rays.dOdx[k]), copy(from.dPdy[k], rays.dOdy[k]);
        fill(rays.dDdx[k], 0.0f), fill(rays.dDdy[k], 0.0f);
    }
    copy(from.time, rays.time), copy(from.sample, rays.sample);
    copy(from.pixel_x, rays.pixel_x), copy(from.pixel_y, rays.pixel_y);
    fill(rays.t_passed, 0.0f);
    for (uint32_t* column : {rays.layer, rays.turns, rays.spent}) fill(column, 0u);
    auto copy_of_ray = [&](const auto* column, auto* to) {
        for (size_t i = 0; i < count; ++i) to[first + i] = column[from.ray[hits[i]]];
    };
    if (from.rays) {
        copy_of_ray(from.rays->share, rays.share), copy_of_ray(from.rays->weight, rays.weight);
        copy_of_ray(from.rays->medium, rays.medium);
        copy_of_ray(from.rays->allowance, rays.allowance);
    } else {
        fill(rays.share, 1.0f), fill(rays.weight, 1.0f), fill(rays.medium, 0u);
        fill(rays.allowance, 1.0f);
    }
}

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
             float tfar, float bias, uint32_t path, uint32_t slot) {
    vec3 org;
    if (start.Ng != vec3(0.0f)) {
        org = raytrace::offset_ray_origin(start.P, start.error, start.Ng, dir);
    } else {
        float clear = 2 * std::max(start.error.x, std::max(start.error.y, start.error.z));
        org = start.P + dir * (clear / glm::length(dir));
    }
    size_t i = rays.count++;
    set_ray(rays, i, org, dir, tfar >= kMiss ? std::numeric_limits<float>::infinity() : tfar);
    rays.sees[i] = ~0u;
    inherit(rays, i, *start.hits, {&start.hit, 1});
    if (bias > 0) rays.tnear[i] = bias;
    if (!grid.frame.shaders.volumes.empty())
        rays.medium[i] = nested_medium(grid.frame, *start.hits, start.hit, dir);
    rays.sample[i] = path;
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
        SmoothSurface(grid.frame.shapes, grid.pose).bend_at(from, hit, dNdx, dNdy)) {
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

// Points that have a number of their own (steps of a march) have a series of their own, too.
raytrace::SampleSeries series_of(const Grid& grid, const Lanes& lanes, int lane,
                                 const raytrace::HitBatch& hits, uint32_t hit) {
    const bool is_hit = hits.depth == 0 && lanes.own(lane) == random_of(hits, hit, grid.frame.seed);
    return raytrace::series_of(
        is_hit ? series_of(hits, hit, grid.frame.seed) : raytrace::SampleSeries{lanes.own(lane)},
        lanes.site(lane));
}

// ---- sixteen at a time
// ---------------------------------------------------------------------------

static_assert(kSixteen == jit::kMaxLanes);

namespace {

// Rows of RayLanes::carried.
enum Carried {
    kdOdx,
    kdOdy = 3,
    kPixelX = 6,
    kPixelY,
    kShare,
    kAllowance,
    kWeight,
    kMedium,
    kTime,
    kTnear,
    kTfar
};
static_assert(kTfar + 1 == kCarried);

constexpr size_t kRowBytes = kSixteen * sizeof(float);

template <class Row>
void copy_row(const Row& from, void* to) {
    static_assert(sizeof(Row) == kRowBytes);
    std::memcpy(to, from, kRowBytes);
}

}  // namespace

LaneRays::LaneRays(const Grid& grid, const Lanes& lanes, int P, int way, bool by_cosine)
    : grid_(grid), lanes_(lanes), wants_{false, by_cosine, grid.memory.footprints} {
    find_hits(P);
    enter_hits();
    enter_starts(P);
    const mat3 accel_from_camera = glm::transpose(grid.frame.camera_from_accel);
    const float* rows = arguments(way);
    float* const axis[3] = {lane_.axis[0], lane_.axis[1], lane_.axis[2]};
    column_kernels().turn(&accel_from_camera[0][0], {{rows, rows + kSixteen, rows + 2 * kSixteen}},
                          axis);
    for (int lane = 0; lane < kSixteen; ++lane) {
        lane_.straight[lane] = 0;
        lane_.cosine[lane] = 1;
        const raytrace::SampleSeries own = series_of(grid, lanes, lane, *hits_[lane], hit_[lane]);
        lane_.seed[lane] = own.seed;
        part_[lane] = own.part;
        first_[lane] = 0;
    }
}

// The hits that the lanes' rays leave; lanes that do not ask have some hit, too.
void LaneRays::find_hits(int P) {
    for (int lane = 0; lane < kSixteen; ++lane) {
        const size_t point = std::min(lanes_.point(lane), grid_.count() - 1);
        hits_[lane] = &grid_.hits;
        hit_[lane] = grid_.points[point];
        if (!of_light() || !lanes_.asks(lane)) continue;
        const RayStart start = ray_start(grid_, point, lanes_.triple(P, lane));
        hits_[lane] = start.hits;
        hit_[lane] = start.hit;
    }
    dense_ = !of_light();
    for (uint32_t lane = 1; lane < uint32_t(kSixteen); ++lane)
        dense_ &= hit_[lane] == hit_[0] + lane;
}

// A light on geometry has hits of its own.
bool LaneRays::of_light() const {
    return grid_.lit && &grid_.lit->hits != &grid_.hits;
}

void LaneRays::enter_hits() {
    auto enter = [&](auto&& column_of, void* to) {
        if (dense_) {
            std::memcpy(to, column_of(grid_.hits) + hit_[0], kRowBytes);
            return;
        }
        for (size_t i = 0; i < kSixteen; ++i)
            std::memcpy(static_cast<std::byte*>(to) + i * sizeof(float),
                        column_of(*hits_[i]) + hit_[i], sizeof(float));
    };
    using Hits = raytrace::HitBatch;
    for (size_t k = 0; k < 3; ++k) {
        enter([k](const Hits& h) { return h.P[k]; }, lane_.P[k]);
        enter([k](const Hits& h) { return h.P_error[k]; }, lane_.error[k]);
        enter([k](const Hits& h) { return h.Ng[k]; }, lane_.Ng[k]);
        if (!wants_.spreads) continue;
        enter([k](const Hits& h) { return h.Ng[k]; }, lane_.in_Ng[k]);
        enter([k](const Hits& h) { return h.dir[k]; }, lane_.in[k]);
        enter([k](const Hits& h) { return h.dDdx[k]; }, lane_.dDdx[k]);
        enter([k](const Hits& h) { return h.dDdy[k]; }, lane_.dDdy[k]);
        enter([k](const Hits& h) { return h.dPdx[k]; }, lane_.carried[kdOdx + k]);
        enter([k](const Hits& h) { return h.dPdy[k]; }, lane_.carried[kdOdy + k]);
    }
    if (wants_.spreads) enter_bends();
    enter([](const Hits& h) { return h.pixel_x; }, lane_.carried[kPixelX]);
    enter([](const Hits& h) { return h.pixel_y; }, lane_.carried[kPixelY]);
    enter([](const Hits& h) { return h.time; }, lane_.carried[kTime]);
    for (int lane = 0; lane < kSixteen; ++lane) {
        const raytrace::RayBatch* rays = hits_[lane]->rays;
        const uint32_t ray = hits_[lane]->ray[hit_[lane]];
        set_weight(lane, rays ? rays->weight[ray] : 1.0f);
        lane_.carried[kMedium][lane] = rays ? rays->medium[ray] : 0;
    }
}

void LaneRays::enter_bends() {
    SmoothSurface surface(grid_.frame.shapes, grid_.pose);
    for (int lane = 0; lane < kSixteen; ++lane) {
        vec3 x(0.0f), y(0.0f);
        const bool asks = lanes_.asks(lane) && on_surface(grid_);
        if (asks) surface.bend_at(*hits_[lane], hit_[lane], x, y);
        for (int k = 0; k < 3; ++k) lane_.dNdx[k][lane] = x[k], lane_.dNdy[k][lane] = y[k];
    }
}

void LaneRays::enter_starts(int P) {
    if (!of_light()) {
        float at[3][kSixteen];
        std::memcpy(at, arguments(P), sizeof(at));
        ray_kernels().start(&grid_.frame.camera_from_accel[0][0], &grid_.frame.eye.x, at, lane_);
        return;
    }
    for (int lane = 0; lane < kSixteen; ++lane) {
        if (!lanes_.asks(lane)) continue;
        const RayStart start = ray_start(grid_, lanes_.point(lane), lanes_.triple(P, lane));
        for (int k = 0; k < 3; ++k) {
            lane_.P[k][lane] = start.P[k];
            lane_.error[k][lane] = start.error[k];
            lane_.Ng[k][lane] = start.Ng[k];
        }
    }
}

const float* LaneRays::arguments(int row) const {
    return lanes_.call().args + size_t(row) * kSixteen;
}

vec3 LaneRays::way(int lane) const {
    return {lane_.axis[0][lane], lane_.axis[1][lane], lane_.axis[2][lane]};
}

void LaneRays::set_straight(int lane, vec3 unit) {
    for (int k = 0; k < 3; ++k) lane_.axis[k][lane] = unit[k];
    lane_.straight[lane] = 1;
    first_[lane] = part_[lane];
}

void LaneRays::set_cone(int lane, float angle, int samples) {
    first_[lane] = part_[lane] * uint32_t(samples);
    grid_.note_random();
    if (!wants_.cones || angle != angle_)
        cosine_ = Cone(vec3(0, 0, 1), angle, wants_.by_cosine).cosine;
    angle_ = angle;
    wants_.cones = true;
    lane_.cosine[lane] = cosine_;
    lane_.straight[lane] = 0;
}

void LaneRays::set_reach(int lane, float tfar, float bias) {
    if (tfar >= kMiss) tfar = std::numeric_limits<float>::infinity();
    lane_.carried[kTfar][lane] = std::bit_cast<uint32_t>(tfar);
    lane_.carried[kTnear][lane] = std::bit_cast<uint32_t>(bias > 0 ? bias : 0.0f);
}

void LaneRays::set_budget(int lane, float share, float allowance) {
    lane_.carried[kShare][lane] = std::bit_cast<uint32_t>(share);
    lane_.carried[kAllowance][lane] = std::bit_cast<uint32_t>(allowance);
}

void LaneRays::set_weight(int lane, float weight) {
    lane_.carried[kWeight][lane] = std::bit_cast<uint32_t>(weight);
}

void LaneRays::aim() {
    if (!std::exchange(aimed_, true)) ray_kernels().aim(lane_);
}

vec3 LaneRays::direction(int lane, uint32_t k) {
    if (lane_.straight[lane]) return way(lane);
    k += first_[lane];
    if (lane != lane_made_ || k / kSixteen != block_made_) {
        lane_made_ = lane;
        block_made_ = k / kSixteen;
        ray_kernels().directions(cone(lane), block_made_ * kSixteen, lane_.seed[lane], made_);
    }
    const size_t i = k % kSixteen;
    return {made_[0][i], made_[1][i], made_[2][i]};
}

Cone LaneRays::cone(int lane) {
    aim();
    auto at = [lane](const float(&rows)[3][kSixteen]) {
        return vec3(rows[0][lane], rows[1][lane], rows[2][lane]);
    };
    Cone cone;
    cone.x = at(lane_.x), cone.y = at(lane_.y), cone.z = at(lane_.z);
    cone.cosine = lane_.cosine[lane];
    cone.by_cosine = wants_.by_cosine;
    return cone;
}

void LaneRays::add(raytrace::RayBatch& rays, const SampleSpan& samples, uint32_t slot) {
    if (wants_.cones) aim();
    RaySamples sixteen;
    for (size_t first = 0, count; first < samples.size(); first += count) {
        count = std::min(samples.size() - first, size_t(kSixteen));
        for (size_t i = 0; i < kSixteen; ++i) {
            const size_t from = first + std::min(i, count - 1);
            sixteen.lane[i] = samples.lane[from];
            sixteen.number[i] = first_[sixteen.lane[i]] + samples.number[from];
        }
        put(rays, sixteen, count, slot + uint32_t(first));
    }
}

// Whole rows of sixteen; what is written behind the last ray is overwritten by the next ones, or
// padding (RayBatch has room for it).
void LaneRays::put(raytrace::RayBatch& rays, const RaySamples& samples, size_t count,
                   uint32_t slot) {
    SixteenRays made;
    ray_kernels().shoot(lane_, samples, wants_, made);
    const size_t at = rays.count;
    for (size_t k = 0; k < 3; ++k) {
        copy_row(made.dir[k], rays.dir[k] + at);
        copy_row(made.org[k], rays.org[k] + at);
        copy_row(made.org[k], rays.first_org[k] + at);
        if (!wants_.spreads) continue;
        copy_row(made.carried[kdOdx + k], rays.dOdx[k] + at);
        copy_row(made.carried[kdOdy + k], rays.dOdy[k] + at);
        copy_row(made.dDdx[k], rays.dDdx[k] + at);
        copy_row(made.dDdy[k], rays.dDdy[k] + at);
    }
    copy_row(made.path, rays.sample + at);
    copy_row(made.carried[kPixelX], rays.pixel_x + at);
    copy_row(made.carried[kPixelY], rays.pixel_y + at);
    copy_row(made.carried[kShare], rays.share + at);
    copy_row(made.carried[kAllowance], rays.allowance + at);
    copy_row(made.carried[kWeight], rays.weight + at);
    copy_row(made.carried[kMedium], rays.medium + at);
    copy_row(made.carried[kTnear], rays.tnear + at);
    copy_row(made.carried[kTfar], rays.tfar + at);
    copy_row(made.carried[kTime], rays.time + at);
    std::fill_n(rays.t_passed + at, kSixteen, 0.0f);
    std::fill_n(rays.sees + at, kSixteen, ~0u);
    for (uint32_t* column : {rays.layer, rays.turns, rays.spent})
        std::fill_n(column + at, kSixteen, 0u);
    for (uint32_t i = 0; i < uint32_t(kSixteen); ++i) rays.slot[at + i] = slot + i;
    if (!grid_.frame.shaders.volumes.empty())
        for (size_t i = 0; i < count; ++i) {
            const uint32_t lane = samples.lane[i];
            rays.medium[at + i] =
                nested_medium(grid_.frame, *hits_[lane], hit_[lane], triple(rays.dir, at + i));
        }
    rays.count += count;
}

}  // namespace kinora
