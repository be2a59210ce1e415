// runtime/picture/shading/lighting/lamp_rays.cpp: rays to lights, made and sent in full batches.
#include "runtime/picture/shading/lighting/lamp_rays.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <glm/matrix.hpp>
#include <numeric>

#include "raytrace/hits.h"
#include "runtime/base/stage_clock.h"
#include "runtime/picture/columns/kernels.h"
#include "runtime/picture/lights/kernels.h"

namespace kinora {

namespace {

using Rows = float[3][raytrace::kPacket];

vec3 in_lane(const Rows& rows, size_t lane) {
    return {rows[0][lane], rows[1][lane], rows[2][lane]};
}

void set_lane(Rows& rows, size_t lane, vec3 value) {
    for (int k = 0; k < 3; ++k) rows[k][lane] = value[k];
}

// How far a light's sample stands off the surface that shines, where the ray to it ends.
vec3 before_sample(const raytrace::HitBatch& samples, size_t i, vec3 P, vec3 to_light) {
    vec3 end = triple(samples.P, i);
    vec3 error = vec3(end_error(P, end)) + triple(samples.P_error, i);
    return raytrace::offset_ray_origin(end, error, triple(samples.Ng, i), -to_light) - end;
}

}  // namespace

LampRays::LampRays(const ShadingFrame& frame, RayQueue& queue, ThreadMemory& memory,
                   const RayTag& from)
    : frame_(frame),
      queue_(queue),
      memory_(memory),
      tag_(sent_tag(from, row_of(RayKind::Lamp), 0)),
      accel_from_camera_(glm::transpose(frame.camera_from_accel)),
      smooth_(frame.shapes, frame.pose),
      batch_(memory) {
    batch_->rays.count = 0;
}

void LampRays::cast(const Grid& grid, const LightPoints& at, const SentLight& light) {
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

void LampRays::finish() {
    StageScope stage(Stage::Shadows);
    flush_all();
    send();
    targets_ = {};
}

// ---- points to rays -----------------------------------------------------------------------------

// The points that the light reaches at all.
size_t LampRays::choose(const LightPoints& at, const SentLight& light) {
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

void LampRays::take(const Grid& grid, const LightPoints& at, const SentLight& light,
                    std::span<const uint32_t> points) {
    static_assert(raytrace::kPacket == kColumnPoints);
    raytrace::LeavingRays& rays = fresh_.rays;
    const size_t first = size_t(fresh_.count);
    alignas(64) Rows L, N;
    if (points.size() < raytrace::kPacket) {  // lanes that are not picked
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
    turn_in(L, N, points.size());
    const uint32_t* const hits = &grid.points[at.first];
    for (size_t j = 0; j < points.size(); ++j) {
        rays.endless[first + j] = light.solar;
        fresh_.hit[first + j] = hits[points[j]];
        fresh_.target[first + j] = {{light.Cl[0], light.Cl[1], light.Cl[2]}, points[j]};
    }
    if (light.samples && !light.solar) aim_before(*light.samples, points, first);
    fresh_.count += int(points.size());
}

// The next rays of fresh_ get their ways and normals, which are in the lanes of L and N, turned to
// accel space. They leave the surface itself and end where the light is.
void LampRays::turn_in(const Rows& L, const Rows& N, size_t count) {
    raytrace::LeavingRays& rays = fresh_.rays;
    const float* M = &accel_from_camera_[0][0];
    auto turn = [&](const Rows& from, Rows& to) {
        float* const rows[3] = {to[0], to[1], to[2]};
        column_kernels().turn(M, {{from[0], from[1], from[2]}}, rows);
    };
    if (count == raytrace::kPacket) {
        std::memset(rays.up, 0, sizeof rays.up);
        std::memset(rays.short_of, 0, sizeof rays.short_of);
        turn(L, rays.way);
        return turn(N, fresh_.N);
    }
    alignas(64) Rows way, normal;
    turn(L, way);
    turn(N, normal);
    const int first = fresh_.count, end = first + int(count);
    for (size_t k = 0; k < 3; ++k) {
        std::fill(rays.up[k] + first, rays.up[k] + end, 0.0f);
        std::fill(rays.short_of[k] + first, rays.short_of[k] + end, 0.0f);
        std::copy(way[k] + first, way[k] + end, rays.way[k] + first);
        std::copy(normal[k] + first, normal[k] + end, fresh_.N[k] + first);
    }
}

// Rays to samples of a light on geometry end before its surface.
void LampRays::aim_before(const LightSamples& samples, std::span<const uint32_t> points,
                          size_t first) {
    raytrace::LeavingRays& rays = fresh_.rays;
    for (size_t j = 0; j < points.size(); ++j) {
        const size_t lane = first + j;
        set_lane(
            rays.short_of, lane,
            before_sample(samples.hits, points[j], in_lane(rays.P, lane), in_lane(rays.way, lane)));
    }
}

// ---- where they leave ---------------------------------------------------------------------------

// The rays of fresh_ that leave the facets of a surface.
uint32_t LampRays::on_facets() const {
    if (!of_surface_) return 0;
    const auto& Ng = fresh_.rays.Ng;
    uint32_t is_set[raytrace::kPacket], lanes = 0;
    for (int j = 0; j < raytrace::kPacket; ++j)
        is_set[j] = uint32_t((Ng[0][j] != 0) | (Ng[1][j] != 0) | (Ng[2][j] != 0));
    for (int j = 0; j < raytrace::kPacket; ++j) lanes |= is_set[j] << j;
    return lanes & fresh_.lanes();
}

// Finds `up` of the rays of fresh_ that have a bit; the bits of those where it is not 0.
uint32_t LampRays::lift(uint32_t lanes) {
    if (lanes == 0) return 0;
    const float* const N[3] = {fresh_.N[0], fresh_.N[1], fresh_.N[2]};
    lanes &= ~raytrace::point_kernels().sees_light(fresh_.rays, N, fresh_.normals, kSeesLight);
    uint32_t lifted = 0;
    for (; lanes; lanes &= lanes - 1) {
        const uint32_t i = uint32_t(std::countr_zero(lanes));
        const vec3 up = smooth_.way_from(*hits_, fresh_.hit[i], in_lane(fresh_.rays.way, i));
        set_lane(fresh_.rays.up, i, up);
        lifted |= uint32_t(up != vec3(0.0f)) << i;
    }
    return lifted;
}

namespace {

template <class Packet>
void move(const Packet& from, int lane, Packet& to) {
    const int j = to.count++;
    auto copy = [&](const Rows& a, Rows& b) { set_lane(b, size_t(j), in_lane(a, size_t(lane))); };
    copy(from.rays.P, to.rays.P), copy(from.rays.error, to.rays.error);
    copy(from.rays.Ng, to.rays.Ng), copy(from.rays.way, to.rays.way);
    copy(from.rays.up, to.rays.up), copy(from.rays.short_of, to.rays.short_of);
    to.rays.endless[j] = from.rays.endless[lane];
    to.hit[j] = from.hit[lane];
    to.target[j] = from.target[lane];
}

}  // namespace

// Rays that leave a smooth surface wait for others: whether the way there is free is found for
// sixteen at once.
void LampRays::flush() {
    if (fresh_.count == 0) return;
    const uint32_t lifted = lift(on_facets());
    aim(fresh_);
    add(fresh_, fresh_.lanes() & ~lifted);
    for (uint32_t left = lifted; left; left &= left - 1) {
        move(fresh_, std::countr_zero(left), lifted_);
        if (lifted_.count == raytrace::kPacket) flush_lifted();
    }
    fresh_.count = 0;
}

void LampRays::flush_lifted() {
    if (lifted_.count == 0) return;
    Packet up;  // from P to the smooth surface
    up.count = lifted_.count;
    up.rays.endless[0] = 0;
    std::memcpy(up.rays.P, lifted_.rays.P, sizeof(Rows));
    std::memcpy(up.rays.error, lifted_.rays.error, sizeof(Rows));
    std::memcpy(up.rays.Ng, lifted_.rays.Ng, sizeof(Rows));
    std::memcpy(up.rays.way, lifted_.rays.up, sizeof(Rows));
    // Which changes nothing when added.
    for (float(&row)[raytrace::kPacket] : up.rays.short_of)
        std::fill_n(row, raytrace::kPacket, -0.0f);
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
    aim(lifted_);
    add(lifted_, lifted_.lanes() & ~lowered);
    for (uint32_t left = lowered; left; left &= left - 1) {
        move(lifted_, std::countr_zero(left), lowered_);
        if (lowered_.count == raytrace::kPacket) flush_lowered();
    }
    lifted_.count = 0;
}

// Where something stands on the way to the smooth surface, rays leave their facets after all. Those
// that something opaque would block from there are dark as they are.
void LampRays::flush_lowered() {
    if (lowered_.count == 0) return;
    aim(lowered_);
    const uint32_t dark = block(lowered_.lanes(), raytrace::kMaskOpaque);
    for (uint32_t left = dark; left; left &= left - 1) {
        const Target& target = lowered_.target[std::countr_zero(left)];
        for (float* Cl : target.Cl) Cl[target.point] = 0;
    }
    std::memset(lowered_.rays.up, 0, sizeof lowered_.rays.up);
    aim(lowered_);
    add(lowered_, lowered_.lanes() & ~dark);
    lowered_.count = 0;
}

void LampRays::flush_all() {
    flush();
    flush_lifted();
    flush_lowered();
}

// The packet's rays go into packet_. Lanes behind the last become copies of the first.
void LampRays::aim(Packet& packet) {
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

// The lanes of packet_ that something of the mask blocks.
uint32_t LampRays::block(uint32_t lanes, uint32_t mask) {
    if (lanes == 0) return 0;
    packet_.active = lanes;
    std::fill_n(packet_.mask, raytrace::kPacket, mask & row_of(RayKind::Lamp).sees);
    return frame_.pose.accel.occluded16(packet_, memory_.counters.trace);
}

// ---- through the queue --------------------------------------------------------------------------

// Adds lanes of packet_, which are those of the packet, to the batch.
void LampRays::add(const Packet& packet, uint32_t lanes) {
    if (lanes == 0) return;
    raytrace::RayBatch& rays = batch_->rays;
    if (targets_.empty()) {
        rays.reserve(kGridPoints);
        targets_ = memory_.arena.allocate_span<Target>(kGridPoints);
    }
    const size_t first = rays.count;
    const raytrace::KeptColumn columns[] = {
        {packet_.org_x, rays.org[0]}, {packet_.org_y, rays.org[1]}, {packet_.org_z, rays.org[2]},
        {packet_.dir_x, rays.dir[0]}, {packet_.dir_y, rays.dir[1]}, {packet_.dir_z, rays.dir[2]},
        {packet_.tfar, rays.tfar}};
    raytrace::point_kernels().keep(lanes, columns, std::size(columns), 0, first);
    uint32_t hit[raytrace::kPacket];
    for (; lanes; lanes &= lanes - 1) {
        const int lane = std::countr_zero(lanes);
        hit[rays.count - first] = packet.hit[lane];
        targets_[rays.count++] = packet.target[lane];
    }
    const size_t count = rays.count - first;
    std::fill_n(rays.tnear + first, count, 0.0f);
    std::iota(rays.slot + first, rays.slot + rays.count, uint32_t(first));
    inherit(rays, first, *hits_, {hit, count});
    set_kind(rays, first, RayKind::Lamp);
    if (rays.count + raytrace::kPacket > kGridPoints) send();
}

// What passes of each ray, to its colour. What is blocked is dark even where the light is infinite.
void LampRays::send() {
    raytrace::RayBatch& rays = batch_->rays;
    if (rays.count == 0) return;
    Arena::Mark mark = memory_.arena.mark();
    std::span<SeenByRay> seen = memory_.arena.allocate_span<SeenByRay>(rays.count);
    queue_.pass(rays, tag_, memory_, false, seen);
    for (size_t r = 0; r < seen.size(); ++r) {
        const vec3 open = seen[r].open;
        if (open == vec3(1.0f)) continue;
        const Target& target = targets_[r];
        for (int k = 0; k < 3; ++k) {
            float& Cl = target.Cl[k][target.point];
            Cl = open[k] == 0 ? 0 : Cl * open[k];
        }
    }
    rays.count = 0;
    memory_.arena.release(mark);
}

void LampRaysAtOnce::cast(const Grid& grid, const LightPoints& at, const SentLight& light) {
    LampRays rays(frame_, queue_, grid.memory, grid.ray);
    rays.cast(grid, at, light);
    rays.finish();
}

}  // namespace kinora
