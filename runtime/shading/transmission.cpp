// runtime/shading/transmission.cpp: rays through transparent surfaces. Each wavefront runs on the
// calling thread; no task is started here.
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "runtime/shading/shading_p.h"

namespace kinora {

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
    rays.share[i] = from.rays ? from.rays->share[from.ray[hit]] : 1.0f;
    rays.medium[i] = from.rays ? from.rays->medium[from.ray[hit]] : 0;
}

// A ray that goes on ends where it was to end, as exactly as it did: the surface that the light
// lies on may be no part of its way.
static void aim_at(raytrace::RayBatch& rays, size_t i, vec3 end) {
    vec3 before = triple(rays.dir, i), org = triple(rays.org, i), dir = end - org;
    if (!(glm::length(dir) > 0)) return;
    float scale = glm::length(before) / glm::length(dir);  // lengths count in directions
    set_triple(rays.dir, i, dir);
    rays.tfar[i] = 1;
    rays.window[i] *= scale;
    rays.t_passed[i] *= scale;
    for (size_t k = 0; k < 3; ++k) {
        rays.dDdx[k][i] /= scale;
        rays.dDdy[k][i] /= scale;
    }
}

// Closest hits on what is not opaque, each round shaded as grids; `through` is what passes. The
// round after the last only asks whether anything is left: that lets nothing through.
void Shading::pass_transparent(int thread_id, raytrace::RayBatch& rays, vec3* through) {
    Thread& own = thread(thread_id);
    for (size_t r = 0; r < rays.count; ++r) through[r] = vec3(1.0f);
    RayTag outer = own.ray;
    own.ray.kind = RayKind::Transmission;
    Arena::Mark mark = own.arena.mark();
    for (int round = 0; rays.count > 0; ++round) {
        NestedWavefront nested(own);
        nested->hits.reserve(kGridPoints);
        const raytrace::HitBatch& hits = raytrace::trace(
            scene_.accel, rays, raytrace::kMaskNotOpaque, 1, nested->hits, own.counters.trace);
        if (!scene_.volumes.empty()) pass_ends(thread_id, rays, hits, through);
        if (hits.count == 0) break;
        if (round == max_layers_) {
            for (size_t h = 0; h < hits.count; ++h) through[rays.slot[hits.ray[h]]] = vec3(0.0f);
            own.counters.too_deep += hits.count;
            break;
        }
        Arena::Mark round_mark = own.arena.mark();
        std::span<vec3> Oi = own.arena.allocate_span<vec3>(hits.count);
        opacity(hits, thread_id, Oi.data());
        if (!scene_.volumes.empty()) pass_volumes(hits, thread_id, Oi.data());
        size_t kept = 0;
        for (size_t h = 0; h < hits.count; ++h) {
            uint32_t r = hits.ray[h];
            vec3& light = through[rays.slot[r]];
            light *= vec3(1.0f) - Oi[h];
            if (light == vec3(0.0f)) continue;
            vec3 end = triple(rays.org, r) + triple(rays.dir, r) * rays.tfar[r];
            uint32_t medium = medium_behind(hits, h);
            raytrace::pass_through(scene_.accel, rays, kept, hits, h);
            if (std::isfinite(rays.tfar[kept])) aim_at(rays, kept, end);
            rays.medium[kept++] = medium;
        }
        rays.passing = true;
        rays.count = kept;
        own.arena.release(round_mark);
    }
    rays.passing = false;
    own.arena.release(mark);
    own.ray = outer;
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

}  // namespace kinora
