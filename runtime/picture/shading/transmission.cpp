// runtime/picture/shading/transmission.cpp: rays through transparent surfaces.
#include "runtime/picture/shading/transmission.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "raytrace/hits.h"
#include "runtime/picture/shading/lane_rays.h"

namespace kinora {

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
    for (size_t k = 0; rays.spreads && k < 3; ++k) {
        rays.dDdx[k][i] /= scale;
        rays.dDdy[k][i] /= scale;
    }
}

// Closest hits on what is not opaque, each round shaded as grids; `through` is what passes. The
// round after the last only asks whether anything is left: that lets nothing through.
void Transmission::pass_transparent(raytrace::RayBatch& rays, const RayTag& tag,
                                    ThreadMemory& memory, vec3* through) {
    Arena::Mark mark = memory.arena.mark();
    for (int round = 0; rays.count > 0; ++round) {
        NestedWavefront nested(memory);
        nested->hits.reserve(kGridPoints);
        const raytrace::HitBatch& hits =
            raytrace::trace(frame_.pose.accel, rays, raytrace::kMaskNotOpaque, 1, nested->hits,
                            memory.counters.trace);
        if (!frame_.shaders.volumes.empty()) pass_ends(rays, hits, tag, memory, through);
        if (hits.count == 0) break;
        if (round == frame_.max_layers) {
            for (size_t h = 0; h < hits.count; ++h) through[rays.slot[hits.ray[h]]] = vec3(0.0f);
            memory.counters.too_deep += hits.count;
            break;
        }
        Arena::Mark round_mark = memory.arena.mark();
        std::span<vec3> Oi = memory.arena.allocate_span<vec3>(hits.count);
        opacity(hits, tag, memory, Oi.data());
        if (!frame_.shaders.volumes.empty()) volumes_.pass(hits, tag, memory, Oi.data());
        size_t kept = 0;
        for (size_t h = 0; h < hits.count; ++h) {
            uint32_t r = hits.ray[h];
            vec3& light = through[rays.slot[r]];
            light *= vec3(1.0f) - Oi[h];
            if (light == vec3(0.0f)) continue;
            vec3 end = triple(rays.org, r) + triple(rays.dir, r) * rays.tfar[r];
            uint32_t medium = medium_behind(frame_, hits, h);
            raytrace::pass_through(frame_.pose.accel, rays, kept, hits, h);
            if (std::isfinite(rays.tfar[kept])) aim_at(rays, kept, end);
            rays.medium[kept++] = medium;
        }
        rays.passing = true;
        rays.count = kept;
        memory.arena.release(round_mark);
    }
    rays.passing = false;
    memory.arena.release(mark);
}

// Rays that reach their light inside an object: the last part of their way.
void Transmission::pass_ends(const raytrace::RayBatch& rays, const raytrace::HitBatch& hits,
                             const RayTag& ray, ThreadMemory& memory, vec3* through) {
    Arena::Mark mark = memory.arena.mark();
    NestedWavefront nested(memory);
    nested->hits.reserve(kGridPoints);
    const raytrace::HitBatch& ends =
        raytrace::missed(rays, hits, frame_.far_distance, nested->hits);
    std::span<vec3> Oi = memory.arena.allocate_span<vec3>(ends.count);
    std::fill(Oi.begin(), Oi.end(), vec3(0.0f));
    volumes_.pass(ends, ray, memory, Oi.data());
    for (size_t k = 0; k < ends.count; ++k) through[rays.slot[ends.ray[k]]] *= vec3(1.0f) - Oi[k];
    memory.arena.release(mark);
}

void Transmission::pass(raytrace::RayBatch& rays, const RayTag& tag, ThreadMemory& memory,
                        std::span<vec3> through) {
    uint8_t blocked[kGridPoints];
    uint32_t all[kGridPoints];
    std::fill(through.begin(), through.end(), vec3(1.0f));
    std::iota(all, all + rays.count, 0u);
    std::span<const uint32_t> which(all, rays.count);
    // Most rays meet nothing at all. Where objects have volumes, such a ray may run through one.
    if (frame_.any_transparent && frame_.shaders.volumes.empty()) {
        raytrace::occluded(frame_.pose.accel, rays, raytrace::kMaskAll, blocked,
                           memory.counters.trace);
        size_t met = 0;
        for (uint32_t r = 0; r < rays.count; ++r) {
            all[met] = r;
            met += blocked[r];
        }
        which = which.first(met);
    }
    pass_blocked(rays, which, tag, memory, through);
}

void Transmission::pass_blocked(raytrace::RayBatch& rays, std::span<const uint32_t> which,
                                const RayTag& tag, ThreadMemory& memory, std::span<vec3> through) {
    uint8_t blocked[kGridPoints];
    raytrace::occluded(frame_.pose.accel, rays, which, raytrace::kMaskOpaque, blocked,
                       memory.counters.trace);
    size_t kept = 0;
    for (size_t i = 0; i < which.size(); ++i) {
        if (blocked[i])
            through[rays.slot[which[i]]] = vec3(0.0f);
        else if (frame_.any_transparent)
            raytrace::move_ray(rays, kept++, which[i]);
    }
    rays.count = kept;
    if (kept > 0) pass_transparent(rays, tag, memory, through.data());
}

// ---- opacity of what rays meet ------------------------------------------------------------------

void Transmission::opacity(const raytrace::HitBatch& hits, const RayTag& ray, ThreadMemory& memory,
                           vec3* Oi) {
    Arena::Mark mark = memory.arena.mark();
    for (const LookRun& run : runs_by_look(frame_, hits, memory.arena)) {
        if (!run.look->opacity) {
            for (uint32_t h : run.hits) Oi[h] = vec3(1.0f);
            continue;
        }
        for (size_t at = 0; at < run.hits.size(); at += kGridPoints)
            run_opacity(hits, run.hits.subspan(at, std::min(kGridPoints, run.hits.size() - at)),
                        *run.look, ray, memory, Oi);
    }
    memory.arena.release(mark);
}

void Transmission::run_opacity(const raytrace::HitBatch& hits, std::span<const uint32_t> points,
                               const ShaderInstance& look, const RayTag& ray, ThreadMemory& memory,
                               vec3* Oi) {
    Arena::Mark mark = memory.arena.mark();
    Grid grid(frame_, memory, hits, points, &look);
    kernels_.prepare(grid, ray);
    want_columns(grid, look.opacity->columns);
    if (look.lowered.uses_lights) lights_.want_columns(grid);
    gather(grid);
    if (look.lowered.uses_lights) lights_.run(grid);
    std::span<float*> out = kernels_.run(*look.opacity, grid);
    memory.counters.opacity_points += grid.count();
    float* columns[3];
    find_color(look.opacity->kernel(), out, rsl::Global::Oi, columns);
    for (size_t i = 0; i < points.size(); ++i) {
        vec3 given(1.0f);
        for (int k = 0; k < 3; ++k)
            if (columns[k]) given[k] = columns[k][i];
        Oi[points[i]] = stopped_by(given);
    }
    memory.arena.release(mark);
}

}  // namespace kinora
