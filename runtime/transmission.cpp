// runtime/transmission.cpp: rays that shaders ask for: through transparent surfaces to a light, and
// reflections. Each wavefront runs on the calling thread; no task is started here.
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "runtime/shading_p.h"

namespace kinora {

namespace {

constexpr float kMiss = 1e30f;          // distance of a ray that met nothing
constexpr int kTransparentRounds = 16;  // DESIGN.md decision 6

// gamma(4) of the magnitudes: a point that came from current space through a rotation and a sum.
vec3 transform_error(vec3 P, vec3 eye) {
    return (std::abs(P.x) + std::abs(P.y) + std::abs(P.z) + glm::abs(eye)) * 2.4e-7f;
}

}  // namespace

void set_nested_ray(raytrace::RayBatch& rays, size_t i, vec3 org, vec3 dir, float tfar,
                    const raytrace::HitBatch& from, uint32_t hit) {
    set_ray(rays, i, org, dir, tfar);
    for (size_t k = 0; k < 3; ++k) {
        rays.dOdx[k][i] = from.dPdx[k][hit];
        rays.dOdy[k][i] = from.dPdy[k][hit];
        rays.dDdx[k][i] = rays.dDdy[k][i] = 0;
        rays.first_org[k][i] = org[int(k)];
    }
    rays.t_passed[i] = 0;
    rays.pixel_x[i] = from.pixel_x[hit];
    rays.pixel_y[i] = from.pixel_y[hit];
    rays.sample[i] = from.sample[hit];
    rays.layer[i] = 0;
    rays.medium[i] = from.rays ? from.rays->medium[from.ray[hit]] : 0;
}

// Closest hits on what is not opaque, each round shaded as grids; `through` is what passes.
void Shading::pass_transparent(int thread_id, raytrace::RayBatch& rays, vec3* through) {
    Thread& own = thread(thread_id);
    for (size_t r = 0; r < rays.count; ++r) through[r] = vec3(1.0f);
    Arena::Mark mark = own.arena.mark();
    for (int round = 0; round < kTransparentRounds && rays.count > 0; ++round) {
        NestedWavefront nested(own);
        nested->hits.reserve(kGridPoints);
        const raytrace::HitBatch& hits = raytrace::trace(
            scene_.accel, rays, raytrace::kMaskNotOpaque, 1, nested->hits, own.counters.trace);
        if (!scene_.volumes.empty()) pass_ends(thread_id, rays, hits, through);
        if (hits.count == 0) break;
        std::span<vec3> Oi = own.arena.allocate_span<vec3>(hits.count);
        opacity(hits, thread_id, Oi.data());
        if (!scene_.volumes.empty()) pass_volumes(hits, thread_id, Oi.data());
        size_t kept = 0;
        for (size_t h = 0; h < hits.count; ++h) {
            uint32_t r = hits.ray[h];
            vec3& light = through[rays.slot[r]];
            light *= vec3(1.0f) - Oi[h];
            if (light == vec3(0.0f)) continue;
            // Hits come in the order of their rays, so rays are packed in place.
            vec3 dir = triple(rays.dir, r);
            vec3 end = triple(rays.org, r) + dir * rays.tfar[r];
            vec3 org = raytrace::offset_ray_origin(triple(hits.P, h), triple(hits.P_error, h),
                                                   triple(hits.Ng, h), dir);
            bool bounded = std::isfinite(rays.tfar[r]);
            uint32_t slot = rays.slot[r];
            uint32_t medium = medium_behind(hits, h);
            set_nested_ray(rays, kept, org, bounded ? end - org : dir,
                           bounded ? 1.0f : rays.tfar[r], hits, uint32_t(h));
            rays.medium[kept] = medium;
            rays.slot[kept++] = slot;
        }
        rays.count = kept;
    }
    own.arena.release(mark);
}

// Rays that reach their light inside an object: the last part of their way.
void Shading::pass_ends(int thread_id, const raytrace::RayBatch& rays,
                        const raytrace::HitBatch& hits, vec3* through) {
    Thread& own = thread(thread_id);
    Arena::Mark mark = own.arena.mark();
    NestedWavefront nested(own);
    nested->hits.reserve(kGridPoints);
    const raytrace::HitBatch& ends = raytrace::missed(rays, hits, miss_distance_, nested->hits);
    std::span<vec3> Oi = own.arena.allocate_span<vec3>(ends.count);
    std::fill(Oi.begin(), Oi.end(), vec3(0.0f));
    pass_volumes(ends, thread_id, Oi.data());
    for (size_t k = 0; k < ends.count; ++k) through[rays.slot[ends.ray[k]]] *= vec3(1.0f) - Oi[k];
    own.arena.release(mark);
}

void Shading::transmission(const Grid& grid, uint32_t mask, const vec3* P, const vec3* Q,
                           vec3* result) {
    Thread& own = thread(grid.thread);
    mat3 accel_from_camera = glm::transpose(camera_from_accel_);
    NestedWavefront nested(own);
    raytrace::RayBatch& rays = nested->rays;
    rays.reserve(kGridPoints);
    rays.count = 0;
    uint32_t lanes[jit::kMaxLanes];
    uint8_t blocked[jit::kMaxLanes];
    for (uint32_t i = 0; i < jit::kMaxLanes; ++i) {
        result[i] = vec3(1.0f);
        if (!(mask >> i & 1)) continue;
        vec3 from = accel_from_camera * P[i] + eye_, to = accel_from_camera * Q[i] + eye_;
        vec3 error = transform_error(P[i], eye_);
        vec3 way = to - from;
        float length = glm::length(way);
        // Both ends keep clear of the surfaces they may lie on.
        float clear = 2 * std::max(error.x, std::max(error.y, error.z));
        if (!(length > 2 * clear)) continue;
        set_nested_ray(rays, rays.count, from + way * (clear / length), way, 1 - 2 * clear / length,
                       grid.hits, grid.points[0]);
        rays.slot[rays.count] = uint32_t(rays.count);
        lanes[rays.count++] = i;
    }
    raytrace::occluded_by_opaque(scene_.accel, rays, blocked, own.counters.trace);
    vec3 through[jit::kMaxLanes];
    size_t count = rays.count;
    for (size_t r = 0; r < count; ++r) through[r] = vec3(1.0f);
    if (any_transparent_) pass_transparent(grid.thread, rays, through);
    for (size_t r = 0; r < count; ++r) result[lanes[r]] = blocked[r] ? vec3(0.0f) : through[r];
}

void Shading::trace(const Grid& grid, uint32_t mask, const vec3* P, const vec3* R, vec3* color,
                    float* distance) {
    Thread& own = thread(grid.thread);
    mat3 accel_from_camera = glm::transpose(camera_from_accel_);
    for (int i = 0; i < jit::kMaxLanes; ++i) {
        color[i] = vec3(0.0f);
        distance[i] = kMiss;
    }
    if (!grid.shadows || grid.depth >= kMaxDepth) return;
    NestedWavefront nested(own);
    raytrace::RayBatch& rays = nested->rays;
    rays.reserve(kGridPoints);
    rays.count = 0;
    for (uint32_t i = 0; i < jit::kMaxLanes; ++i) {
        if (!(mask >> i & 1)) continue;
        vec3 dir = accel_from_camera * R[i];
        vec3 from = accel_from_camera * P[i] + eye_;
        vec3 error = transform_error(P[i], eye_);
        float length = glm::length(dir);
        if (!(length > 0)) continue;
        float clear = 2 * std::max(error.x, std::max(error.y, error.z));
        set_nested_ray(rays, rays.count, from + dir * (clear / length), dir,
                       std::numeric_limits<float>::infinity(), grid.hits, grid.points[0]);
        rays.slot[rays.count++] = i;
    }
    nested->hits.reserve(kGridPoints);
    const raytrace::HitBatch& hits = raytrace::trace(
        scene_.accel, rays, raytrace::kMaskAll, grid.depth + 1, nested->hits, own.counters.trace);
    if (hits.count == 0) return;
    Arena::Mark mark = own.arena.mark();
    raytrace::ShadeResult result;
    for (size_t k = 0; k < 3; ++k) {
        result.Ci[k] = own.arena.allocate_span<float>(padded(hits.count)).data();
        result.Oi[k] = own.arena.allocate_span<float>(padded(hits.count)).data();
    }
    shade(hits, grid.thread, result);
    for (size_t h = 0; h < hits.count; ++h) {
        uint32_t lane = rays.slot[hits.ray[h]];
        color[lane] = triple(result.Ci, h);
        distance[lane] = hits.t[h];
    }
    own.arena.release(mark);
}

}  // namespace kinora
