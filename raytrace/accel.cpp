// raytrace/accel.cpp: queries: filters what Embree must not see, and hands on.
#include "raytrace/accel.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cfloat>
#include <cmath>
#include <cstring>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "raytrace/accel_state_p.h"
#include "raytrace/packet_recorder.h"
#include "raytrace/points/points.h"

namespace kinora::raytrace {

namespace {

// Embree squares directions; outside this range of |dir|^2 it loses hits without a word.
constexpr float kSmallestDir2 = 0x1p-40f;
constexpr float kLargestDir2 = 0x1p40f;

struct Lanes {
    uint32_t sound = 0;     // to be traced as they are
    uint32_t rescale = 0;   // to be traced with a direction of length 1
    uint32_t filtered = 0;  // not well-formed
};

// False for NaN and infinities.
bool within(float x, float limit) {
    return std::abs(x) <= limit;
}

// Whether all sixteen rays can go to Embree as they are: nearly always so. A usual |dir|^2 implies
// a finite direction.
bool all_sound(const RayPacket16& rays, float far) {
    return point_kernels().sound({{rays.org_x, rays.org_y, rays.org_z},
                                  {rays.dir_x, rays.dir_y, rays.dir_z},
                                  rays.tnear,
                                  rays.tfar},
                                 far, kSmallestDir2, kLargestDir2);
}

Lanes classify(const RayPacket16& rays, float far) {
    Lanes lanes;
    if (all_sound(rays, far)) {
        lanes.sound = rays.active;
        return lanes;
    }
    for (int i = 0; i < kPacket; ++i) {
        const float x = rays.dir_x[i], y = rays.dir_y[i], z = rays.dir_z[i];
        const float length2 = x * x + y * y + z * z;
        bool finite = within(rays.org_x[i], far) & within(rays.org_y[i], far) &
                      within(rays.org_z[i], far) & within(x, kLargest) & within(y, kLargest) &
                      within(z, kLargest);
        bool ordered = (rays.tnear[i] >= 0) & !std::isnan(rays.tfar[i]);
        bool nonzero = (x != 0) | (y != 0) | (z != 0);
        bool usual = (length2 >= kSmallestDir2) & (length2 <= kLargestDir2);
        bool good = finite & ordered & nonzero;
        bool empty = !(rays.tnear[i] <= rays.tfar[i]) | std::isinf(rays.tnear[i]);
        lanes.filtered |= uint32_t(!good) << i;
        lanes.sound |= uint32_t(good & usual & !empty) << i;
        lanes.rescale |= uint32_t(good & !usual & !empty) << i;
    }
    lanes.filtered &= rays.active;
    lanes.sound &= rays.active;
    lanes.rescale &= rays.active;
    return lanes;
}

// Gives the lanes of `which` directions of length 1, found in double. Returns the old lengths.
void rescale(RayPacket16& rays, uint32_t which, double length[kPacket]) {
    for (int i = 0; i < kPacket; ++i) {
        if (!(which >> i & 1)) continue;
        double x = double(rays.dir_x[i]), y = double(rays.dir_y[i]), z = double(rays.dir_z[i]);
        length[i] = std::sqrt(x * x + y * y + z * z);
        rays.dir_x[i] = float(x / length[i]);
        rays.dir_y[i] = float(y / length[i]);
        rays.dir_z[i] = float(z / length[i]);
        rays.tnear[i] = float(double(rays.tnear[i]) * length[i]);
        rays.tfar[i] = float(double(rays.tfar[i]) * length[i]);
        if (rays.passing) rays.window[i] = float(double(rays.window[i]) * length[i]);
    }
}

std::atomic<PacketRecorder*> g_recorder = nullptr;

}  // namespace

void record_packets(PacketRecorder* recorder) {
    g_recorder = recorder;
}

namespace {

uint32_t closest(const Accel::State& s, const RayPacket16& rays, HitPacket16& hits,
                 TraceCounters& counters) {
    Lanes lanes = classify(rays, s.largest_origin);
    counters.filtered += uint64_t(std::popcount(lanes.filtered));
    bool as_they_are = lanes.sound == rays.active;
    if (as_they_are && s.top) return s.top.intersect16(rays, s.map, s.policy.fixed_winner, hits);
    std::fill_n(hits.geometry, kPacket, kNone);
    if (!s.top || (lanes.sound | lanes.rescale) == 0) return 0;
    RayPacket16 copy = rays;
    copy.active = lanes.sound | lanes.rescale;
    double length[kPacket];
    rescale(copy, lanes.rescale, length);
    uint32_t hit = s.top.intersect16(copy, s.map, s.policy.fixed_winner, hits);
    for (int i = 0; i < kPacket; ++i)
        if (hit & lanes.rescale & (1u << i)) hits.t[i] = float(double(hits.t[i]) / length[i]);
    return hit;
}

uint32_t any(const Accel::State& s, const RayPacket16& rays, TraceCounters& counters) {
    Lanes lanes = classify(rays, s.largest_origin);
    counters.filtered += uint64_t(std::popcount(lanes.filtered));
    if (!s.top) return 0;
    if (lanes.sound == rays.active) return s.top.occluded16(rays);
    if ((lanes.sound | lanes.rescale) == 0) return 0;
    RayPacket16 copy = rays;
    copy.active = lanes.sound | lanes.rescale;
    double length[kPacket];
    rescale(copy, lanes.rescale, length);
    return s.top.occluded16(copy);
}

}  // namespace

uint32_t Accel::intersect16(const RayPacket16& rays, HitPacket16& hits,
                            TraceCounters& counters) const {
    const State& s = *state_;
    if (PacketRecorder* recorder = g_recorder.load(std::memory_order_relaxed)) [[unlikely]]
        recorder->closest(rays);
    ++counters.packets;
    counters.rays += uint64_t(std::popcount(rays.active & 0xffffu));
    if (s.scale == 1) return closest(s, rays, hits, counters);
    const uint32_t hit = closest(s, scaled(rays, s.scale), hits, counters);
    unscale(hits, hit, s.scale);
    return hit;
}

uint32_t Accel::occluded16(const RayPacket16& rays, TraceCounters& counters) const {
    const State& s = *state_;
    if (PacketRecorder* recorder = g_recorder.load(std::memory_order_relaxed)) [[unlikely]]
        recorder->any(rays);
    ++counters.shadow_packets;
    counters.shadow_rays += uint64_t(std::popcount(rays.active & 0xffffu));
    return s.scale == 1 ? any(s, rays, counters) : any(s, scaled(rays, s.scale), counters);
}

uint32_t Accel::body(uint32_t row) const {
    return state_->map.rows[row].body;
}

void Accel::bounds(vec3& low, vec3& high) const {
    state_->top.bounds(low, high);
    for (vec3* corner : {&low, &high}) *corner = *corner / state_->scale;
}

const AccelPolicy& Accel::policy() const {
    return state_->policy;
}

#if defined(__x86_64__)
namespace {
constexpr unsigned kFlushAndDaz = 0x8040;
}
DenormalGuard::DenormalGuard() : saved_(_mm_getcsr()) {
    if ((saved_ & kFlushAndDaz) != kFlushAndDaz) _mm_setcsr(unsigned(saved_) | kFlushAndDaz);
}
DenormalGuard::~DenormalGuard() {
    if ((saved_ & kFlushAndDaz) != kFlushAndDaz) _mm_setcsr(unsigned(saved_));
}
#elif defined(__aarch64__)
namespace {
constexpr uint64_t kFlush = uint64_t(1) << 24;  // FPCR.FZ
uint64_t read_fpcr() {
    uint64_t value;
    __asm__ volatile("mrs %0, fpcr" : "=r"(value));
    return value;
}
void write_fpcr(uint64_t value) {
    __asm__ volatile("msr fpcr, %0" : : "r"(value));
}
}  // namespace
DenormalGuard::DenormalGuard() : saved_(read_fpcr()) {
    write_fpcr(saved_ | kFlush);
}
DenormalGuard::~DenormalGuard() {
    write_fpcr(saved_);
}
#else
DenormalGuard::DenormalGuard() : saved_(0) {}
DenormalGuard::~DenormalGuard() {}
#endif

}  // namespace kinora::raytrace
