// runtime/shading/transmission.cpp: rays through transparent surfaces, and shadow rays.
#include "runtime/shading/transmission.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "raytrace/hits.h"
#include "raytrace/sampling.h"
#include "runtime/base/stage_clock.h"
#include "runtime/scene/scene.h"
#include "runtime/shading/nested_rays.h"

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
    rays.weight[i] = from.rays ? from.rays->weight[from.ray[hit]] : 1.0f;
    rays.turns[i] = rays.spent[i] = 0;
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
void Transmission::pass_transparent(raytrace::RayBatch& rays, const RayTag& from,
                                    ThreadMemory& memory, vec3* through) {
    const Scene& scene = frame_.scene;
    for (size_t r = 0; r < rays.count; ++r) through[rays.slot[r]] = vec3(1.0f);
    RayTag tag = from;
    tag.kind = RayKind::Transmission;
    Arena::Mark mark = memory.arena.mark();
    for (int round = 0; rays.count > 0; ++round) {
        NestedWavefront nested(memory);
        nested->hits.reserve(kGridPoints);
        const raytrace::HitBatch& hits = raytrace::trace(
            scene.accel, rays, raytrace::kMaskNotOpaque, 1, nested->hits, memory.counters.trace);
        if (!scene.volumes.empty()) pass_ends(rays, hits, tag, memory, through);
        if (hits.count == 0) break;
        if (round == frame_.max_layers) {
            for (size_t h = 0; h < hits.count; ++h) through[rays.slot[hits.ray[h]]] = vec3(0.0f);
            memory.counters.too_deep += hits.count;
            break;
        }
        Arena::Mark round_mark = memory.arena.mark();
        std::span<vec3> Oi = memory.arena.allocate_span<vec3>(hits.count);
        opacity(hits, tag, memory, Oi.data());
        if (!scene.volumes.empty()) volumes_.pass(hits, tag, memory, Oi.data());
        size_t kept = 0;
        for (size_t h = 0; h < hits.count; ++h) {
            uint32_t r = hits.ray[h];
            vec3& light = through[rays.slot[r]];
            light *= vec3(1.0f) - Oi[h];
            if (light == vec3(0.0f)) continue;
            vec3 end = triple(rays.org, r) + triple(rays.dir, r) * rays.tfar[r];
            uint32_t medium = medium_behind(scene, hits, h);
            raytrace::pass_through(scene.accel, rays, kept, hits, h);
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

namespace {

// Leaves those rays for which keep(ray) is true, in their order.
template <class Keep>
void keep_rays(raytrace::RayBatch& rays, Keep&& keep) {
    size_t kept = 0;
    for (size_t r = 0; r < rays.count; ++r)
        if (keep(r)) raytrace::move_ray(rays, kept++, r);
    rays.count = kept;
}

}  // namespace

void Transmission::pass(raytrace::RayBatch& rays, const RayTag& from, ThreadMemory& memory,
                        std::span<vec3> through) {
    uint8_t blocked[kGridPoints];
    std::fill(through.begin(), through.end(), vec3(1.0f));
    // Most rays meet nothing at all. Where objects have volumes, such a ray may run through one.
    if (frame_.any_transparent && frame_.scene.volumes.empty()) {
        raytrace::occluded(frame_.scene.accel, rays, raytrace::kMaskAll, blocked,
                           memory.counters.trace);
        keep_rays(rays, [&](size_t r) { return blocked[r] != 0; });
    }
    pass_blocked(rays, from, memory, through);
}

void Transmission::pass_blocked(raytrace::RayBatch& rays, const RayTag& from, ThreadMemory& memory,
                                std::span<vec3> through) {
    uint8_t blocked[kGridPoints];
    raytrace::occluded(frame_.scene.accel, rays, raytrace::kMaskOpaque, blocked,
                       memory.counters.trace);
    for (size_t r = 0; r < rays.count; ++r)
        if (blocked[r]) through[rays.slot[r]] = vec3(0.0f);
    if (!frame_.any_transparent) return;
    keep_rays(rays, [&](size_t r) { return !blocked[r]; });
    pass_transparent(rays, from, memory, through.data());
}

// ---- opacity of what rays meet ------------------------------------------------------------------

void Transmission::opacity(const raytrace::HitBatch& hits, const RayTag& ray, ThreadMemory& memory,
                           vec3* Oi) {
    const Scene& scene = frame_.scene;
    Arena::Mark mark = memory.arena.mark();
    for (const LookRun& run : runs_by_look(scene, hits, memory.arena)) {
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

// ---- shadow rays --------------------------------------------------------------------------------

namespace {

// How far a light's sample stands off the surface that shines, where the ray to it ends.
vec3 before_sample(const raytrace::HitBatch& samples, size_t i, vec3 P, vec3 to_light) {
    vec3 end = triple(samples.P, i);
    vec3 error = vec3(end_error(P, end)) + triple(samples.P_error, i);
    return raytrace::offset_ray_origin(end, error, triple(samples.Ng, i), -to_light) - end;
}

}  // namespace

ShadowQueue::ShadowQueue(const ShadingFrame& frame, Transmission& transmission,
                         ThreadMemory& memory, const RayTag& tag)
    : frame_(frame),
      transmission_(transmission),
      memory_(memory),
      tag_(tag),
      dims_(frame.any_transparent),
      straight_(frame.scene.volumes.empty()),
      accel_from_camera_(glm::transpose(frame.camera_from_accel)),
      smooth_(frame.scene),
      rest_(memory) {
    rest_->rays.count = 0;
}

void ShadowQueue::cast(const Grid& grid, const LightPoints& at, const SentLight& light) {
    StageScope stage(Stage::Shadows);
    const bool of_surface = grid.look->kind == ShaderInstanceKind::Surface;
    for (uint32_t i = 0; i < at.count; ++i) {
        if (light.lit && jit::bits_of(light.lit[i]) == 0) continue;
        if (light.Cl[0][i] == 0 && light.Cl[1][i] == 0 && light.Cl[2][i] == 0) continue;
        Asked& ray = asked_[filled_];
        ray.target = {{light.Cl[0], light.Cl[1], light.Cl[2]}, i};
        ray.hits = &grid.hits;
        ray.hit = grid.points[at.first + i];
        ray.P = triple(at.accel, i);
        ray.error = triple(at.error, i);
        ray.Ng = triple(at.Ng, i);
        ray.way = accel_from_camera_ * triple(light.L, i);
        ray.up = ray.short_of = vec3(0.0f);
        ray.solar = light.solar;
        if (of_surface && ray.Ng != vec3(0.0f))
            ray.up = smooth_.way_from(grid.hits, ray.hit, ray.way);
        if (light.samples && !light.solar)
            ray.short_of = before_sample(light.samples->hits, i, ray.P, ray.way);
        lifted_ |= uint32_t(ray.up != vec3(0.0f)) << filled_;
        aim(filled_++);
        if (filled_ == raytrace::kPacket) flush();
    }
}

void ShadowQueue::finish() {
    StageScope stage(Stage::Shadows);
    flush();
    pass_rest();
    rest_targets_ = {};
}

// From `up` above the facet.
void ShadowQueue::aim(int lane) {
    const Asked& ray = asked_[lane];
    // A point that is on no known surface leaves its error box along the ray itself.
    vec3 Ng = ray.Ng == vec3(0) ? glm::normalize(ray.way) : ray.Ng;
    bool lifted = ray.up != vec3(0.0f);
    vec3 org = raytrace::offset_ray_origin(lifted ? ray.P + ray.up : ray.P, ray.error, Ng,
                                           lifted ? ray.up : ray.way);
    vec3 dir = ray.solar ? ray.way : ray.P + ray.way - org + ray.short_of;
    packet_.org_x[lane] = org.x;
    packet_.org_y[lane] = org.y;
    packet_.org_z[lane] = org.z;
    packet_.dir_x[lane] = dir.x;
    packet_.dir_y[lane] = dir.y;
    packet_.dir_z[lane] = dir.z;
    packet_.tnear[lane] = packet_.time[lane] = 0;
    packet_.tfar[lane] = ray.solar ? std::numeric_limits<float>::infinity() : 1.0f;
}

// The lanes that something of the mask blocks.
uint32_t ShadowQueue::block(uint32_t lanes, uint32_t mask) {
    if (lanes == 0) return 0;
    packet_.active = lanes;
    std::fill_n(packet_.mask, raytrace::kPacket, mask);
    return frame_.scene.accel.occluded16(packet_, memory_.counters.trace);
}

// Aims rays from their facets after all, where something stands on the way to the smooth surface;
// these rays.
uint32_t ShadowQueue::lower(uint32_t lanes) {
    uint32_t lowered = 0;
    for (uint32_t left = lanes; left; left &= left - 1) {
        int j = std::countr_zero(left);
        Asked& ray = asked_[j];
        if (is_way_free(frame_.scene.accel, ray.P, ray.error, ray.Ng, ray.up,
                        memory_.counters.trace))
            continue;
        ray.up = vec3(0.0f);
        aim(j);
        lowered |= 1u << j;
    }
    return lowered;
}

void ShadowQueue::flush() {
    if (filled_ == 0) return;
    const uint32_t all = filled_ == raytrace::kPacket ? 0xffffu : (1u << filled_) - 1;
    const bool any = dims_ && straight_;
    const uint32_t mask = any ? raytrace::kMaskAll : raytrace::kMaskOpaque;
    uint32_t blocked = block(all, mask);
    // Whether what is opaque blocks them, only lifted ones need to know at once.
    uint32_t opaque = any ? block(blocked & lifted_, raytrace::kMaskOpaque) : blocked;
    if (uint32_t lowered = lower(lifted_ & ~opaque))
        blocked = (blocked & ~lowered) | block(lowered, mask);
    for (int j = 0; j < filled_; ++j) {
        bool met = blocked >> j & 1;
        const Target& target = asked_[j].target;
        if (dims_ && met == straight_)
            keep(j);
        else if (met)
            for (float* Cl : target.Cl) Cl[target.point] = 0;
    }
    filled_ = 0;
    lifted_ = 0;
    if (rest_->rays.count + raytrace::kPacket > kGridPoints) pass_rest();
}

void ShadowQueue::keep(int lane) {
    raytrace::RayBatch& rest = rest_->rays;
    if (rest_targets_.empty()) {
        rest.reserve(kGridPoints);
        rest_targets_ = memory_.arena.allocate_span<Target>(kGridPoints);
    }
    const Asked& ray = asked_[lane];
    vec3 org(packet_.org_x[lane], packet_.org_y[lane], packet_.org_z[lane]);
    vec3 dir(packet_.dir_x[lane], packet_.dir_y[lane], packet_.dir_z[lane]);
    size_t r = rest.count++;
    set_nested_ray(rest, r, org, dir, packet_.tfar[lane], *ray.hits, ray.hit);
    rest.slot[r] = uint32_t(r);
    rest_targets_[r] = ray.target;
}

void ShadowQueue::pass_rest() {
    raytrace::RayBatch& rest = rest_->rays;
    size_t count = rest.count;
    if (count == 0) return;
    Arena::Mark mark = memory_.arena.mark();
    std::span<vec3> through = memory_.arena.allocate_span<vec3>(count);
    std::fill(through.begin(), through.end(), vec3(1.0f));
    if (straight_)
        transmission_.pass_blocked(rest, tag_, memory_, through);
    else
        transmission_.pass_transparent(rest, tag_, memory_, through.data());
    for (size_t r = 0; r < count; ++r)
        for (size_t k = 0; k < 3; ++k)
            rest_targets_[r].Cl[k][rest_targets_[r].point] *= through[r][int(k)];
    rest.count = 0;
    memory_.arena.release(mark);
}

void ShadowRays::cast(const Grid& grid, const LightPoints& at, const SentLight& light) {
    ShadowQueue queue(frame_, transmission_, grid.memory, grid.ray);
    queue.cast(grid, at, light);
    queue.finish();
}

}  // namespace kinora
