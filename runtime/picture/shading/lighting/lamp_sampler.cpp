// runtime/picture/shading/lighting/lamp_sampler.cpp: samples of lights on geometry.
//
// Numbers come from an Owen-scrambled (0,2)-sequence seeded by the point and the light, so that the
// first 2^k are stratified and nothing depends on threads or tiles. By area they choose a triangle
// and a place on it, by solid angle a direction, whose ray finds the triangle.
#include "runtime/picture/shading/lighting/lamp_sampler.h"

#include <algorithm>
#include <bit>
#include <memory>

#include "raytrace/hits.h"
#include "raytrace/sampling.h"

namespace kinora {

namespace {

constexpr float kAboutHit = 1e-6f;  // of a distance: other lamps as near lie at the same place
constexpr int kMostMet = 16;        // lamps one behind the other along a direction

static_assert(raytrace::kPacket == 16);

}  // namespace

LampSampler::LampSampler(const AreaLight& light, const LightPoints& at, ThreadMemory& memory)
    : light_(light), at_(at) {
    if (!light.by_angle) return;
    Arena& arena = memory.arena;
    const size_t rows = padded(at.count);
    seen_ = arena.allocate_span<SolidAngle>(rows);
    rays_ = arena.allocate_span<Ray>(rows);
    lanes_ = arena.allocate_span<uint16_t>(rows / raytrace::kPacket + 1);
    for (size_t i = 0; i < rows; ++i) {
        const size_t point = std::min(i, at.count - 1);
        std::construct_at(&seen_[i], light.shape, dvec3(triple(at.accel, point)));
    }
}

float LampSampler::density(size_t point) const {
    const double dense = seen_.empty() ? 0.0 : seen_[point].density();
    return dense > 0 ? float(dense) : LightSamples::kByArea;
}

void LampSampler::choose(const Grid& lit, SampleNumber sample, LightSamples& samples) {
    lit.note_random();
    std::fill(lanes_.begin(), lanes_.end(), uint16_t(0));
    const uint32_t number = uint32_t(lit.look->index);  // tells lights on one surface apart
    for (size_t i = 0; i < padded(at_.count); ++i) {
        const size_t point = std::min(i, at_.count - 1);
        const raytrace::SampleSeries series =
            raytrace::series_of(at_.series[point], raytrace::hash(number, lit.frame.seed));
        const vec2 u(
            raytrace::stratified_sample(series.part * sample.of + sample.number, series.seed));
        samples.density[i] = density(point);
        const bool by_area = samples.density[i] == LightSamples::kByArea;
        if (!by_area) aim(i, point, u);
        const LampPlace place = by_area ? place_on(light_, u) : LampPlace{};
        samples.primitive[i] = place.triangle;
        samples.u[i] = place.uv.x;
        samples.v[i] = place.uv.y;
    }
    if (!seen_.empty()) meet(lit, samples);
    samples.find_points(lit.frame.pose.accel);
}

bool LampSampler::go_on(const Grid& lit, LightSamples& samples) {
    if (seen_.empty() || light_.hides_far || light_.shape.kind == LampShape::Kind::Rectangle)
        return false;
    std::fill_n(samples.density, padded(at_.count), 0.0f);
    if (!meet(lit, samples)) return false;
    samples.find_points(lit.frame.pose.accel);
    return true;
}

// ---- rays ---------------------------------------------------------------------------------------

void LampSampler::aim(size_t i, size_t point, vec2 u) {
    const SolidAngle::Way way = seen_[point].sample(double(u.x), double(u.y));
    rays_[i] = {vec3(way.direction), float(way.near), float(way.far), -1, kNone, kNone};
    lanes_[i / raytrace::kPacket] |= uint16_t(1u << i % raytrace::kPacket);
}

bool LampSampler::meet(const Grid& lit, LightSamples& samples) {
    bool any = false;
    for (size_t p = 0; p < lanes_.size(); ++p) {
        if (lanes_[p] == 0) continue;
        meet_sixteen(lit, p * raytrace::kPacket, lanes_[p], samples);
        any |= lanes_[p] != 0;
    }
    return any;
}

void LampSampler::load(size_t first, uint32_t lanes, raytrace::RayPacket16& packet) const {
    packet.active = lanes;
    packet.passing = true;
    packet.normals = false;
    for (; lanes; lanes &= lanes - 1) {
        const size_t j = size_t(std::countr_zero(lanes)), i = first + j;
        const size_t point = std::min(i, at_.count - 1);
        const Ray& ray = rays_[i];
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

// The next triangle of the light on each way; other lamps before it let the ray pass.
void LampSampler::meet_sixteen(const Grid& lit, size_t first, uint32_t lanes,
                               LightSamples& samples) {
    const raytrace::Accel& accel = lit.frame.pose.accel;
    raytrace::RayPacket16 packet;
    raytrace::HitPacket16 hits;
    uint32_t found = 0;
    for (uint32_t left = lanes, layer = 0; left && layer < kMostMet; ++layer) {
        load(first, left, packet);
        left = accel.intersect16(packet, hits, lit.memory.counters.trace);
        for (uint32_t met = left; met; met &= met - 1) {
            const size_t j = size_t(std::countr_zero(met)), i = first + j;
            const uint32_t body = accel.body(hits.instance[j]);
            Ray& ray = rays_[i];
            if (hits.t[j] <= ray.window)
                ray.passed_last = body;
            else
                ray = {ray.dir, hits.t[j] * (1 - kAboutHit),
                       ray.far, hits.t[j] * (1 + kAboutHit),
                       body,    kNone};
            if (hits.instance[j] != light_.surface) continue;
            left &= ~(1u << j);
            found |= 1u << j;
            samples.primitive[i] = hits.primitive[j];
            samples.u[i] = hits.u[j];
            samples.v[i] = hits.v[j];
            samples.density[i] = density(std::min(i, at_.count - 1));
        }
    }
    for (uint32_t missed = lanes & ~found; missed; missed &= missed - 1)
        samples.density[first + size_t(std::countr_zero(missed))] = 0;
    lanes_[first / raytrace::kPacket] = uint16_t(found);
}

}  // namespace kinora
