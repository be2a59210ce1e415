// runtime/picture/shading/lighting/lamp_sampler.cpp: samples of lights on geometry.
//
// Numbers come from an Owen-scrambled (0,2)-sequence seeded by the point and the light, so that the
// first 2^k are stratified and nothing depends on threads or tiles. By area they choose a triangle
// and a place on it, by solid angle a direction, whose ray finds the triangle. That of a rectangle
// of few triangles needs no ray.
#include "runtime/picture/shading/lighting/lamp_sampler.h"

#include <algorithm>
#include <bit>

#include "raytrace/hits.h"
#include "raytrace/sampling.h"

namespace kinora {

namespace {

constexpr size_t kRow = kAngleLanes;
constexpr float kAboutHit = 1e-6f;    // of a distance: other lamps as near lie at the same place
constexpr float kAboutPlane = 1e-3f;  // triangles of a rectangle may lie off its plane
constexpr int kMostMet = 16;          // lamps one behind the other along a direction

static_assert(raytrace::kPacket == kRow);

}  // namespace

LampSampler::LampSampler(const AreaLight& light, const LightPoints& at, ThreadMemory& memory)
    : light_(light), at_(at) {
    if (light.by_angle) see(memory.arena);
}

void LampSampler::see(Arena& arena) {
    const size_t rows = (at_.count + kRow - 1) / kRow;
    const bool sphere = light_.shape.kind == LampShape::Kind::Sphere;
    density_ = arena.allocate_span<float>(at_.count);
    by_angle_ = arena.allocate_span<uint16_t>(rows);
    on_way_ = arena.allocate_span<uint16_t>(rows);
    rays_ = arena.allocate_span<Ray>(light_.facets.count > 0 ? 0 : rows * kRow);
    at_rim_ = arena.allocate_span<uint16_t>(sphere ? rows : 0);
    reach_ = arena.allocate_span<vec3>(sphere ? at_.count : 0);
    spheres_ = arena.allocate_span<SphereLanes>(sphere ? rows : 0);
    rectangles_ = arena.allocate_span<RectangleLanes>(sphere ? 0 : rows);
    std::fill(by_angle_.begin(), by_angle_.end(), uint16_t(0));
    std::fill(on_way_.begin(), on_way_.end(), uint16_t(0));
    for (size_t row = 0; row < rows; ++row) sphere ? see_sphere(row) : see_rectangle(row);
}

void LampSampler::see_rectangle(size_t row) {
    const size_t first = row * kRow, count = std::min(kRow, at_.count - first);
    dvec3 points[kRow];
    double density[kRow];
    for (size_t j = 0; j < count; ++j) points[j] = dvec3(triple(at_.accel, first + j));
    see_rectangles(light_.shape, {points, count}, rectangles_[row], density);
    for (size_t j = 0; j < count; ++j) take_density(first + j, density[j]);
}

void LampSampler::see_sphere(size_t row) {
    const size_t first = row * kRow, end = std::min(first + kRow, at_.count);
    for (size_t i = first; i < end; ++i) {
        const SolidAngle seen(light_.shape, dvec3(triple(at_.accel, i)));
        take_density(i, seen.density());
        if (!(seen.density() > 0)) continue;
        seen.put(spheres_[row], i % kRow);
        reach_[i] = vec3(seen.near(), seen.far(), seen.sure());
    }
}

void LampSampler::take_density(size_t point, double density) {
    density_[point] = density > 0 ? float(density) : LightSamples::kByArea;
    by_angle_[point / kRow] |= uint16_t(density > 0) << point % kRow;
}

float LampSampler::density(size_t point) const {
    return density_.empty() ? LightSamples::kByArea : density_[point];
}

void LampSampler::choose(const Grid& lit, SampleNumber sample, LightSamples& samples) {
    lit.note_random();
    const uint32_t number = uint32_t(lit.look->index);  // tells lights on one surface apart
    for (size_t first = 0; first < at_.count; first += kRow) {
        AngleLanes u, v;
        for (size_t j = 0; j < kRow; ++j) {
            const size_t point = point_of(first + j);
            const raytrace::SampleSeries series =
                raytrace::series_of(at_.series[point], raytrace::hash(number, lit.frame.seed));
            const vec2 at(
                raytrace::stratified_sample(series.part * sample.of + sample.number, series.seed));
            u[j] = double(at.x);
            v[j] = double(at.y);
            samples.density[first + j] = density(point);
            samples.share[first + j] = 1;
        }
        choose_by_area(first, u, v, samples);
        if (!rectangles_.empty()) choose_on_rectangle(first, u, v, samples);
        if (!spheres_.empty()) choose_on_sphere(lit, first, u, v, samples);
    }
    if (!rays_.empty()) meet(lit, samples);
    for (size_t row = 0; row < at_rim_.size(); ++row) on_way_[row] |= at_rim_[row];
    samples.find_points(lit.frame.pose.accel);
}

bool LampSampler::go_on(const Grid& lit, LightSamples& samples) {
    if (spheres_.empty() || light_.hides_far) return false;
    std::fill_n(samples.density, padded(at_.count), 0.0f);
    if (!meet(lit, samples)) return false;
    samples.find_points(lit.frame.pose.accel);
    return true;
}

void LampSampler::choose_by_area(size_t first, const AngleLanes& u, const AngleLanes& v,
                                 LightSamples& samples) const {
    const uint32_t by_angle = by_angle_.empty() ? 0 : by_angle_[first / kRow];
    for (size_t j = 0; j < kRow; ++j) {
        const size_t i = first + j;
        LampPlace place{light_.surfaces[0], 0, vec2(0.0f)};
        if (!(by_angle >> j & 1)) place = place_on(light_, vec2(u[j], v[j]));
        samples.instance[i] = place.surface;
        samples.primitive[i] = place.triangle;
        samples.u[i] = place.uv.x;
        samples.v[i] = place.uv.y;
    }
}

void LampSampler::choose_on_rectangle(size_t first, const AngleLanes& u, const AngleLanes& v,
                                      LightSamples& samples) {
    const uint32_t by_angle = by_angle_[first / kRow];
    if (by_angle == 0) return;
    AngleLanes x, y;
    angle_kernels().to_rectangles(rectangles_[first / kRow], u, v, x, y);
    if (!rays_.empty()) on_way_[first / kRow] = uint16_t(by_angle);
    uint32_t triangle[kRow];
    float at_u[kRow], at_v[kRow];
    if (rays_.empty()) angle_kernels().on_facets(light_.facets, x, y, triangle, at_u, at_v);
    for (uint32_t left = by_angle; left; left &= left - 1) {
        const size_t j = size_t(std::countr_zero(left)), i = first + j;
        if (rays_.empty()) {
            samples.primitive[i] = triangle[j];
            samples.u[i] = at_u[j];
            samples.v[i] = at_v[j];
            continue;
        }
        const dvec3 to = light_.shape.corner + x[j] * light_.shape.axis[0] +
                         y[j] * light_.shape.axis[1] - dvec3(triple(at_.accel, i));
        rays_[i] = {vec3(to), 1 - kAboutPlane, 1 + kAboutPlane, -1, kNone, kNone};
    }
}

void LampSampler::choose_on_sphere(const Grid& lit, size_t first, const AngleLanes& u,
                                   const AngleLanes& v, LightSamples& samples) {
    const size_t row = first / kRow;
    const uint32_t by_angle = by_angle_[row];
    on_way_[row] = at_rim_[row] = 0;
    if (by_angle == 0) return;
    AngleLanes direction[3];
    angle_kernels().to_spheres(spheres_[row], u, v, direction);
    for (uint32_t left = by_angle; left; left &= left - 1) {
        const size_t j = size_t(std::countr_zero(left)), i = first + j;
        const auto bit = uint16_t(1u << j);
        if (u[j] < double(reach_[i].z)) {
            const vec3 dir(direction[0][j], direction[1][j], direction[2][j]);
            rays_[i] = {dir, reach_[i].x, reach_[i].y, -1, kNone, kNone};
            on_way_[row] |= bit;
            continue;
        }
        const uint32_t seed = raytrace::hash(std::bit_cast<uint32_t>(float(u[j])),
                                             std::bit_cast<uint32_t>(float(v[j])));
        if (choose_at_rim(lit, i, seed, samples))
            at_rim_[row] |= bit;
        else
            samples.density[i] = 0;
    }
}

bool LampSampler::choose_at_rim(const Grid& lit, size_t i, uint32_t seed, LightSamples& samples) {
    const SphereLanes& row = spheres_[i / kRow];
    SphereLanes same;
    AngleLanes u, v, direction[3];
    for (uint32_t j = 0; j < kRow; ++j) {
        for (int a = 0; a < 3; ++a)
            for (int k = 0; k < 3; ++k) same.axis[a][k][j] = row.axis[a][k][i % kRow];
        same.opening[j] = row.opening[i % kRow];
        const dvec2 at = raytrace::stratified_sample(j, seed);
        u[j] = double(reach_[i].z) + (1 - double(reach_[i].z)) * at.x;
        v[j] = at.y;
    }
    angle_kernels().to_spheres(same, u, v, direction);
    Ray rays[kRow];
    for (size_t j = 0; j < kRow; ++j)
        rays[j] = {vec3(direction[0][j], direction[1][j], direction[2][j]),
                   reach_[i].x,
                   reach_[i].y,
                   -1,
                   kNone,
                   kNone};
    raytrace::HitPacket16 found;
    uint32_t met = find(lit, rays, i, 0, 0xffffu, found);
    const uint32_t count = uint32_t(std::popcount(met));
    if (count == 0) return false;
    for (uint32_t skip = raytrace::hash(seed) % count; skip; --skip) met &= met - 1;
    const size_t j = size_t(std::countr_zero(met));
    rays_[i] = rays[j];
    samples.primitive[i] = found.primitive[j];
    samples.u[i] = found.u[j];
    samples.v[i] = found.v[j];
    samples.share[i] = float(count) / float(kRow);
    return true;
}

// ---- rays ---------------------------------------------------------------------------------------

bool LampSampler::meet(const Grid& lit, LightSamples& samples) {
    bool any = false;
    for (size_t row = 0; row < on_way_.size(); ++row) {
        if (on_way_[row] == 0) continue;
        meet_sixteen(lit, row * kRow, samples);
        any |= on_way_[row] != 0;
    }
    return any;
}

void LampSampler::meet_sixteen(const Grid& lit, size_t first, LightSamples& samples) {
    const uint32_t lanes = on_way_[first / kRow];
    raytrace::HitPacket16 found;
    const uint32_t met =
        find(lit, std::span<Ray, kRow>(&rays_[first], kRow), first, 1, lanes, found);
    for (uint32_t left = lanes; left; left &= left - 1) {
        const size_t j = size_t(std::countr_zero(left)), i = first + j;
        const bool meets = met >> j & 1;
        samples.density[i] = meets ? density_[i] : 0.0f;
        if (!meets) continue;
        samples.primitive[i] = found.primitive[j];
        samples.u[i] = found.u[j];
        samples.v[i] = found.v[j];
    }
    on_way_[first / kRow] = uint16_t(met);
}

void LampSampler::load(Row rays, size_t first, size_t step, uint32_t lanes,
                       raytrace::RayPacket16& packet) const {
    packet.active = lanes;
    packet.passing = true;
    packet.normals = false;
    for (; lanes; lanes &= lanes - 1) {
        const size_t j = size_t(std::countr_zero(lanes)), point = first + j * step;
        const Ray& ray = rays[j];
        packet.org_x[j] = at_.accel[0][point];
        packet.org_y[j] = at_.accel[1][point];
        packet.org_z[j] = at_.accel[2][point];
        packet.dir_x[j] = ray.dir.x, packet.dir_y[j] = ray.dir.y, packet.dir_z[j] = ray.dir.z;
        packet.tnear[j] = ray.near, packet.tfar[j] = ray.far;
        packet.mask[j] = raytrace::kMaskLamp;
        packet.time[j] = 0;
        packet.window[j] = ray.window;
        packet.passed_first[j] = ray.passed_first;
        packet.passed_last[j] = ray.passed_last;
    }
}

uint32_t LampSampler::find(const Grid& lit, std::span<Ray, kAngleLanes> rays, size_t first,
                           size_t step, uint32_t lanes, raytrace::HitPacket16& found) const {
    const raytrace::Accel& accel = lit.frame.pose.accel;
    raytrace::RayPacket16 packet;
    raytrace::HitPacket16 hits;
    uint32_t met = 0;
    for (uint32_t left = lanes, layer = 0; left && layer < kMostMet; ++layer) {
        load(rays, first, step, left, packet);
        left = accel.intersect16(packet, hits, lit.memory.counters.trace);
        for (uint32_t hit = left; hit; hit &= hit - 1) {
            const size_t j = size_t(std::countr_zero(hit));
            const uint32_t body = accel.body(hits.instance[j]);
            Ray& ray = rays[j];
            if (hits.t[j] <= ray.window)
                ray.passed_last = body;
            else
                ray = {ray.dir, hits.t[j] * (1 - kAboutHit),
                       ray.far, hits.t[j] * (1 + kAboutHit),
                       body,    kNone};
            if (hits.instance[j] != light_.surfaces[0]) continue;
            left &= ~(1u << j);
            met |= 1u << j;
            found.primitive[j] = hits.primitive[j];
            found.u[j] = hits.u[j];
            found.v[j] = hits.v[j];
        }
    }
    return met;
}

}  // namespace kinora
