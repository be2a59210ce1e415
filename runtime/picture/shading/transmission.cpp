// runtime/picture/shading/transmission.cpp: rays through transparent surfaces, and shadow rays.
#include "runtime/picture/shading/transmission.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numeric>
#include <utility>

#include "raytrace/hits.h"
#include "raytrace/sampling.h"
#include "runtime/base/stage_clock.h"
#include "runtime/picture/columns/kernels.h"
#include "runtime/picture/lights/kernels.h"

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
    for (size_t r = 0; r < rays.count; ++r) through[rays.slot[r]] = vec3(1.0f);
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

void Transmission::pass_blocked(raytrace::RayBatch& rays, const RayTag& tag, ThreadMemory& memory,
                                std::span<vec3> through) {
    uint32_t all[kGridPoints];
    std::iota(all, all + rays.count, 0u);
    pass_blocked(rays, {all, rays.count}, tag, memory, through);
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
                         ThreadMemory& memory, const RayTag& from)
    : frame_(frame),
      transmission_(transmission),
      memory_(memory),
      tag_(sent_tag(from, row_of(RayKind::Lamp), 0)),
      dims_(frame.any_transparent),
      straight_(frame.shaders.volumes.empty()),
      mask_(dims_ && straight_ ? raytrace::kMaskAll : raytrace::kMaskOpaque),
      accel_from_camera_(glm::transpose(frame.camera_from_accel)),
      smooth_(frame.shapes, frame.pose),
      rest_(memory) {
    rest_->rays.count = 0;
}

void ShadowQueue::cast(const Grid& grid, const LightPoints& at, const SentLight& light) {
    StageScope stage(Stage::Shadows);
    const bool of_surface = grid.look->kind == ShaderInstanceKind::Surface;
    if (hits_ != &grid.hits || of_surface_ != of_surface) flush_all();
    hits_ = &grid.hits;
    of_surface_ = of_surface;
    std::span<const uint32_t> points(chosen_, choose(at, light));
    while (!points.empty()) {
        const size_t n = std::min(points.size(), size_t(raytrace::kPacket - fresh_.count));
        take(grid, at, light, points.first(n));
        points = points.subspan(n);
        if (fresh_.count == raytrace::kPacket) flush();
    }
}

// The points that the light reaches at all.
size_t ShadowQueue::choose(const LightPoints& at, const SentLight& light) {
    const float* const Cl[3] = {light.Cl[0], light.Cl[1], light.Cl[2]};
    return light_kernels().choose(Cl, light.lit, at.count, chosen_);
}

namespace {

// Rows of columns to lanes from `first` on.
void pick(std::span<const raytrace::KeptColumn> columns, std::span<const uint32_t> points,
          size_t first) {
    if (points.size() == raytrace::kPacket)
        return raytrace::point_kernels().pick(points.data(), columns.data(), columns.size());
    for (const raytrace::KeptColumn& column : columns) {
        const auto* from = static_cast<const uint32_t*>(column.from);
        auto* to = static_cast<uint32_t*>(column.to) + first;
        for (size_t j = 0; j < points.size(); ++j)
            std::memcpy(to + j, from + points[j], sizeof(*to));
    }
}

}  // namespace

void ShadowQueue::take(const Grid& grid, const LightPoints& at, const SentLight& light,
                       std::span<const uint32_t> points) {
    static_assert(raytrace::kPacket == kColumnPoints);
    raytrace::LeavingRays& rays = fresh_.rays;
    const size_t first = size_t(fresh_.count), end = first + points.size();
    const bool whole = points.size() == raytrace::kPacket;
    alignas(64) float L[3][raytrace::kPacket], N[3][raytrace::kPacket];
    if (!whole) {  // lanes that are not picked
        std::memset(L, 0, sizeof L);
        std::memset(N, 0, sizeof N);
    }
    raytrace::KeptColumn columns[16];
    for (size_t k = 0; k < 3; ++k) {
        columns[k] = {at.accel[k], rays.P[k]};
        columns[3 + k] = {at.error[k], rays.error[k]};
        columns[6 + k] = {at.Ng[k], rays.Ng[k]};
        columns[9 + k] = {light.L[k], L[k]};
        columns[12 + k] = {at.N[k], N[k]};
    }
    columns[15] = {at.normals && of_surface_ ? at.normals : static_cast<const void*>(at.zeros),
                   fresh_.normals};
    pick(columns, points, first);
    const float* M = &accel_from_camera_[0][0];
    if (whole) {
        std::memset(rays.up, 0, sizeof rays.up);
        std::memset(rays.short_of, 0, sizeof rays.short_of);
        float* const way[3] = {rays.way[0], rays.way[1], rays.way[2]};
        float* const normal[3] = {fresh_.N[0], fresh_.N[1], fresh_.N[2]};
        column_kernels().turn(M, {{L[0], L[1], L[2]}}, way);
        column_kernels().turn(M, {{N[0], N[1], N[2]}}, normal);
    } else {
        float* const of_L[3] = {L[0], L[1], L[2]};
        float* const of_N[3] = {N[0], N[1], N[2]};
        column_kernels().turn(M, {{L[0], L[1], L[2]}}, of_L);
        column_kernels().turn(M, {{N[0], N[1], N[2]}}, of_N);
        for (size_t k = 0; k < 3; ++k) {
            std::fill(rays.up[k] + first, rays.up[k] + end, 0.0f);
            std::fill(rays.short_of[k] + first, rays.short_of[k] + end, 0.0f);
            std::copy(L[k] + first, L[k] + end, rays.way[k] + first);
            std::copy(N[k] + first, N[k] + end, fresh_.N[k] + first);
        }
    }
    Target target{{light.Cl[0], light.Cl[1], light.Cl[2]}, 0};
    const uint32_t endless = light.solar;
    const uint32_t* const hits = &grid.points[at.first];
    for (size_t j = 0; j < points.size(); ++j) {
        const size_t lane = first + j;
        rays.endless[lane] = endless;
        fresh_.hit[lane] = hits[points[j]];
        target.point = points[j];
        fresh_.target[lane] = target;
        if (!light.samples || light.solar) continue;
        const vec3 off = before_sample(light.samples->hits, points[j],
                                       {rays.P[0][lane], rays.P[1][lane], rays.P[2][lane]},
                                       {rays.way[0][lane], rays.way[1][lane], rays.way[2][lane]});
        for (int k = 0; k < 3; ++k) rays.short_of[k][lane] = off[k];
    }
    fresh_.count = int(end);
}

void ShadowQueue::finish() {
    StageScope stage(Stage::Shadows);
    flush_all();
    pass_rest();
    rest_targets_ = {};
}

// Lanes behind the last become copies of the first.
void ShadowQueue::aim(Packet& packet) {
    raytrace::LeavingRays& r = packet.rays;
    for (int j = packet.count; j < raytrace::kPacket; ++j) {
        for (auto* rows : {&r.P, &r.error, &r.Ng, &r.way, &r.up, &r.short_of})
            for (float(&row)[raytrace::kPacket] : *rows) row[j] = row[0];
        r.endless[j] = r.endless[0];
    }
    float* const org[3] = {packet_.org_x, packet_.org_y, packet_.org_z};
    float* const dir[3] = {packet_.dir_x, packet_.dir_y, packet_.dir_z};
    raytrace::point_kernels().leave(r, org, dir, packet_.tfar);
}

// The lanes that something of the mask blocks.
uint32_t ShadowQueue::block(uint32_t lanes, uint32_t mask) {
    if (lanes == 0) return 0;
    packet_.active = lanes;
    std::fill_n(packet_.mask, raytrace::kPacket, mask & row_of(RayKind::Lamp).sees);
    return frame_.pose.accel.occluded16(packet_, memory_.counters.trace);
}

void ShadowQueue::move(const Packet& from, int lane, Packet& to) {
    const int j = to.count++;
    auto copy = [&](const auto& a, auto& b) {
        for (int c = 0; c < 3; ++c) b[c][j] = a[c][lane];
    };
    copy(from.rays.P, to.rays.P), copy(from.rays.error, to.rays.error);
    copy(from.rays.Ng, to.rays.Ng), copy(from.rays.way, to.rays.way);
    copy(from.rays.up, to.rays.up), copy(from.rays.short_of, to.rays.short_of);
    to.rays.endless[j] = from.rays.endless[lane];
    to.hit[j] = from.hit[lane];
    to.target[j] = from.target[lane];
}

// What becomes of rays that are in packet_.
void ShadowQueue::settle(const Packet& packet, uint32_t lanes, uint32_t blocked) {
    if (!dims_) lanes &= blocked;
    for (; lanes; lanes &= lanes - 1) {
        const int j = std::countr_zero(lanes);
        const bool met = blocked >> j & 1;
        const Target& target = packet.target[j];
        if (dims_ && met == straight_)
            keep(packet, j);
        else if (met)
            for (float* Cl : target.Cl) Cl[target.point] = 0;
    }
    if (rest_->rays.count + raytrace::kPacket > kGridPoints) pass_rest();
}

// Finds `up` of the rays of fresh_ that have a bit; the bits of those where it is not 0.
uint32_t ShadowQueue::lift(uint32_t lanes) {
    const float* const N[3] = {fresh_.N[0], fresh_.N[1], fresh_.N[2]};
    lanes &= ~raytrace::point_kernels().sees_light(fresh_.rays, N, fresh_.normals, kSeesLight);
    uint32_t lifted = 0;
    for (; lanes; lanes &= lanes - 1) {
        const int i = std::countr_zero(lanes);
        const auto& way = fresh_.rays.way;
        const vec3 up = smooth_.way_from(*hits_, fresh_.hit[i], {way[0][i], way[1][i], way[2][i]});
        for (int c = 0; c < 3; ++c) fresh_.rays.up[c][i] = up[c];
        lifted |= uint32_t(up != vec3(0.0f)) << i;
    }
    return lifted;
}

// Of rays that leave a smooth surface, those that nothing opaque blocks wait for others: whether
// the way there is free is asked for sixteen at once.
void ShadowQueue::flush() {
    if (fresh_.count == 0) return;
    const uint32_t all = fresh_.lanes();
    uint32_t on_facets = 0;
    if (of_surface_) {
        const auto& Ng = fresh_.rays.Ng;
        uint32_t is_set[raytrace::kPacket];
        for (int j = 0; j < raytrace::kPacket; ++j)
            is_set[j] = uint32_t((Ng[0][j] != 0) | (Ng[1][j] != 0) | (Ng[2][j] != 0));
        for (int j = 0; j < raytrace::kPacket; ++j) on_facets |= is_set[j] << j;
        on_facets &= all;
    }
    const uint32_t lifted = on_facets ? lift(on_facets) : 0;
    aim(fresh_);
    const uint32_t blocked = block(all, mask_);
    uint32_t opaque = blocked;
    if (mask_ != raytrace::kMaskOpaque) opaque = block(blocked & lifted, raytrace::kMaskOpaque);
    const uint32_t waiting = lifted & ~opaque;
    settle(fresh_, all & ~waiting, blocked);
    for (uint32_t left = waiting; left; left &= left - 1) {
        const int j = std::countr_zero(left);
        met_ |= (blocked >> j & 1) << lifted_.count;
        move(fresh_, j, lifted_);
        if (lifted_.count == raytrace::kPacket) flush_lifted();
    }
    fresh_.count = 0;
}

// Where something stands on the way to the smooth surface, rays leave their facets after all.
void ShadowQueue::flush_lifted() {
    if (lifted_.count == 0) return;
    Packet up;  // from P to the smooth surface
    up.count = lifted_.count;
    up.rays.endless[0] = 0;
    for (int j = 0; j < lifted_.count; ++j)
        for (int c = 0; c < 3; ++c) {
            up.rays.P[c][j] = lifted_.rays.P[c][j];
            up.rays.error[c][j] = lifted_.rays.error[c][j];
            up.rays.Ng[c][j] = lifted_.rays.Ng[c][j];
            up.rays.way[c][j] = lifted_.rays.up[c][j];
            up.rays.short_of[c][j] = -0.0f;  // which changes nothing when added
        }
    aim(up);
    uint32_t out = 0;  // beyond the error of P
    for (int j = 0; j < up.count; ++j) {
        const auto& w = up.rays.way;
        out |= uint32_t(packet_.dir_x[j] * w[0][j] + packet_.dir_y[j] * w[1][j] +
                            packet_.dir_z[j] * w[2][j] >
                        0)
               << j;
    }
    const uint32_t lowered = block(out, raytrace::kMaskAll);
    const uint32_t met = std::exchange(met_, 0);
    aim(lifted_);
    settle(lifted_, lifted_.lanes() & ~lowered, met);
    for (uint32_t left = lowered; left; left &= left - 1) {
        move(lifted_, std::countr_zero(left), lowered_);
        for (auto& row : lowered_.rays.up) row[lowered_.count - 1] = 0;
        if (lowered_.count == raytrace::kPacket) flush_lowered();
    }
    lifted_.count = 0;
}

void ShadowQueue::flush_lowered() {
    if (lowered_.count == 0) return;
    aim(lowered_);
    settle(lowered_, lowered_.lanes(), block(lowered_.lanes(), mask_));
    lowered_.count = 0;
}

void ShadowQueue::flush_all() {
    flush();
    flush_lifted();
    flush_lowered();
}

void ShadowQueue::keep(const Packet& packet, int lane) {
    raytrace::RayBatch& rest = rest_->rays;
    if (rest_targets_.empty()) {
        rest.reserve(kGridPoints);
        rest_targets_ = memory_.arena.allocate_span<Target>(kGridPoints);
    }
    vec3 org(packet_.org_x[lane], packet_.org_y[lane], packet_.org_z[lane]);
    vec3 dir(packet_.dir_x[lane], packet_.dir_y[lane], packet_.dir_z[lane]);
    size_t r = rest.count++;
    set_nested_ray(rest, r, org, dir, packet_.tfar[lane], *hits_, packet.hit[lane]);
    rest.sees[r] = row_of(RayKind::Lamp).sees;
    rest.slot[r] = uint32_t(r);
    rest_targets_[r] = packet.target[lane];
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
