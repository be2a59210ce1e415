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
    for (size_t r = 0; r < rays.count; ++r) through[r] = vec3(1.0f);
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

void Transmission::pass(raytrace::RayBatch& rays, const RayTag& from, ThreadMemory& memory,
                        std::span<vec3> through) {
    uint8_t blocked[kGridPoints];
    std::fill(through.begin(), through.end(), vec3(1.0f));
    raytrace::occluded(frame_.scene.accel, rays, raytrace::kMaskOpaque, blocked,
                       memory.counters.trace);
    size_t count = rays.count;
    if (frame_.any_transparent) pass_transparent(rays, from, memory, through.data());
    for (size_t r = 0; r < count; ++r)
        if (blocked[r]) through[r] = vec3(0.0f);
}

// ---- opacity of what rays meet ------------------------------------------------------------------

void Transmission::opacity(const raytrace::HitBatch& hits, const RayTag& ray, ThreadMemory& memory,
                           vec3* Oi) {
    const Scene& scene = frame_.scene;
    Arena::Mark mark = memory.arena.mark();
    std::span<uint32_t> points = memory.arena.allocate_span<uint32_t>(hits.count);
    for (size_t l = 0; l < scene.looks.size(); ++l) {
        const ShaderInstance& look = *scene.looks[l];
        size_t count = 0;
        for (uint32_t i = 0; i < hits.count; ++i)
            if (scene.surfaces[hits.instance[i]].look == l) points[count++] = i;
        if (count == 0) continue;
        if (!look.opacity) {
            for (size_t i = 0; i < count; ++i) Oi[points[i]] = vec3(1.0f);
            continue;
        }
        for (size_t at = 0; at < count; at += kGridPoints)
            run_opacity(hits, points.subspan(at, std::min(kGridPoints, count - at)), look, ray,
                        memory, Oi);
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

// Shadow rays by the packet, and the lit points that asked for them.
struct ShadowPacket {
    raytrace::RayPacket16 rays;
    uint32_t points[raytrace::kPacket];
    vec3 up[raytrace::kPacket];
    uint32_t lifted = 0;  // bit j: ray j leaves a smooth surface, not its facet
    int filled = 0;

    void set(int j, uint32_t point, vec3 org, vec3 dir, float tfar) {
        rays.org_x[j] = org.x;
        rays.org_y[j] = org.y;
        rays.org_z[j] = org.z;
        rays.dir_x[j] = dir.x;
        rays.dir_y[j] = dir.y;
        rays.dir_z[j] = dir.z;
        rays.tnear[j] = 0;
        rays.tfar[j] = tfar;
        rays.mask[j] = raytrace::kMaskOpaque;
        rays.time[j] = 0;
        points[j] = point;
    }
    vec3 org(int j) const { return {rays.org_x[j], rays.org_y[j], rays.org_z[j]}; }
    vec3 dir(int j) const { return {rays.dir_x[j], rays.dir_y[j], rays.dir_z[j]}; }
};

// Casts the rays of one light's grid, a packet at a time.
class ShadowCaster {
  public:
    ShadowCaster(const ShadingFrame& frame, const Grid& grid, const LightPoints& at,
                 const SentLight& light, raytrace::RayBatch& rest)
        : frame_(frame),
          grid_(grid),
          at_(at),
          light_(light),
          rest_(rest),
          counters_(grid.memory.counters.trace),
          accel_from_camera_(glm::transpose(frame.camera_from_accel)),
          smooth_(frame.scene) {}

    // All points that the light reaches; blocked ones lose its colour, and what only transparent
    // surfaces may dim is left in `rest`.
    void run() {
        const bool of_surface = grid_.look->kind == ShaderInstanceKind::Surface;
        for (uint32_t i = 0; i < at_.count; ++i) {
            if (light_.lit && jit::bits_of(light_.lit[i]) == 0) continue;
            if (light_.Cl[0][i] == 0 && light_.Cl[1][i] == 0 && light_.Cl[2][i] == 0) continue;
            vec3 up(0.0f);
            if (of_surface && triple(at_.Ng, i) != vec3(0.0f))
                up = smooth_.way_from(grid_.hits, grid_.points[at_.first + i], to_light(i));
            int j = packet_.filled++;
            packet_.up[j] = up;
            packet_.lifted |= uint32_t(up != vec3(0.0f)) << j;
            aim(j, i, up);
            if (packet_.filled == raytrace::kPacket) flush();
        }
        flush();
    }

  private:
    vec3 to_light(uint32_t i) const { return accel_from_camera_ * triple(light_.L, i); }

    // The ray of a point, from `up` above its facet.
    void aim(int j, uint32_t i, vec3 up) {
        vec3 way = to_light(i), P = triple(at_.accel, i), Ng = triple(at_.Ng, i);
        // A point that is on no known surface leaves its error box along the ray itself.
        if (Ng == vec3(0)) Ng = glm::normalize(way);
        vec3 org = up == vec3(0.0f)
                       ? raytrace::offset_ray_origin(P, triple(at_.error, i), Ng, way)
                       : raytrace::offset_ray_origin(P + up, triple(at_.error, i), Ng, up);
        vec3 dir = light_.solar ? way : P + way - org;
        if (light_.samples && !light_.solar) dir += before_sample(light_.samples->hits, i, P, way);
        packet_.set(j, i, org, dir, light_.solar ? std::numeric_limits<float>::infinity() : 1.0f);
    }

    // From the facets after all, where something stands on the way to their smooth surface.
    uint32_t lower(uint32_t unblocked) {
        uint32_t lowered = 0;
        for (uint32_t left = packet_.lifted & unblocked; left; left &= left - 1) {
            int j = std::countr_zero(left);
            uint32_t i = packet_.points[j];
            if (is_way_free(frame_.scene.accel, triple(at_.accel, i), triple(at_.error, i),
                            triple(at_.Ng, i), packet_.up[j], counters_))
                continue;
            aim(j, i, vec3(0.0f));
            lowered |= 1u << j;
        }
        if (lowered == 0) return 0;
        packet_.rays.active = lowered;
        return frame_.scene.accel.occluded16(packet_.rays, counters_);
    }

    void flush() {
        if (packet_.filled == 0) return;
        packet_.rays.active = (1u << packet_.filled) - 1;
        uint32_t blocked = frame_.scene.accel.occluded16(packet_.rays, counters_);
        blocked |= lower(~blocked);
        for (int j = 0; j < packet_.filled; ++j) {
            uint32_t i = packet_.points[j];
            if (blocked >> j & 1) {
                for (size_t k = 0; k < 3; ++k) light_.Cl[k][i] = 0;
            } else if (frame_.any_transparent) {
                set_nested_ray(rest_, rest_.count, packet_.org(j), packet_.dir(j),
                               packet_.rays.tfar[j], grid_.hits, grid_.points[at_.first + i]);
                rest_.slot[rest_.count++] = i;
            }
        }
        packet_.filled = 0;
        packet_.lifted = 0;
    }

    const ShadingFrame& frame_;
    const Grid& grid_;
    const LightPoints& at_;
    const SentLight& light_;
    raytrace::RayBatch& rest_;
    raytrace::TraceCounters& counters_;
    mat3 accel_from_camera_;
    SmoothSurface smooth_;
    ShadowPacket packet_;
};

}  // namespace

void ShadowRays::cast(const Grid& grid, const LightPoints& at, const SentLight& light) const {
    ThreadMemory& memory = grid.memory;
    NestedWavefront nested(memory);
    raytrace::RayBatch& rest = nested->rays;
    if (frame_.any_transparent) rest.reserve(kGridPoints);
    rest.count = 0;
    ShadowCaster(frame_, grid, at, light, rest).run();
    if (rest.count == 0) return;
    std::span<vec3> through = memory.arena.allocate_span<vec3>(rest.count);
    std::span<uint32_t> points = memory.arena.allocate_span<uint32_t>(rest.count);
    size_t count = rest.count;
    for (size_t r = 0; r < count; ++r) {
        points[r] = rest.slot[r];
        rest.slot[r] = uint32_t(r);
    }
    transmission_.pass_transparent(rest, grid.ray, memory, through.data());
    for (size_t r = 0; r < count; ++r)
        for (size_t k = 0; k < 3; ++k) light.Cl[k][points[r]] *= through[r][int(k)];
}

}  // namespace kinora
