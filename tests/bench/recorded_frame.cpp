// tests/bench/recorded_frame.cpp: records a frame's rays and launches, and plays them back.
#include "tests/bench/recorded_frame.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "runtime/base/math.h"
#include "runtime/base/stage_clock.h"

namespace kinora {

using raytrace::kPacket;
using raytrace::RayPacket16;

// ---- rays ---------------------------------------------------------------------------------------

namespace {

RecordedRay ray_at(const RayPacket16& p, int i) {
    return {{p.org_x[i], p.org_y[i], p.org_z[i]},
            {p.dir_x[i], p.dir_y[i], p.dir_z[i]},
            p.tnear[i],
            p.tfar[i],
            p.passing ? p.window[i] : 0,
            p.mask[i],
            p.passing ? p.passed_first[i] : 0,
            p.passing ? p.passed_last[i] : 0};
}

void set_ray_at(const RecordedRay& ray, int i, RayPacket16& p) {
    p.org_x[i] = ray.org[0], p.org_y[i] = ray.org[1], p.org_z[i] = ray.org[2];
    p.dir_x[i] = ray.dir[0], p.dir_y[i] = ray.dir[1], p.dir_z[i] = ray.dir[2];
    p.tnear[i] = ray.tnear, p.tfar[i] = ray.tfar, p.time[i] = 0;
    p.mask[i] = ray.mask;
    p.window[i] = ray.window;
    p.passed_first[i] = ray.passed_first, p.passed_last[i] = ray.passed_last;
}

// Bits of up to three small numbers in turns.
uint64_t interleave(const uint32_t v[3], int count) {
    uint64_t key = 0;
    for (int bit = 9; bit >= 0; --bit)
        for (int k = 0; k < count; ++k) key = key << 1 | (v[k] >> bit & 1);
    return key;
}

}  // namespace

void RecordedRays::closest(const RayPacket16& packet) {
    add(packet, packet.coherent ? RayUse::Camera : RayUse::Nested);
}

void RecordedRays::any(const RayPacket16& packet) {
    add(packet, RayUse::Shadow);
}

void RecordedRays::add(const RayPacket16& packet, RayUse use) {
    packets_.push_back({packet.active & 0xffffu, use, packet.passing});
    for (uint32_t left = packet.active & 0xffffu; left; left &= left - 1)
        rays_.push_back(ray_at(packet, std::countr_zero(left)));
}

std::vector<RayPacket16> RecordedRays::as_sent(RayUse use) const {
    std::vector<RayPacket16> result;
    const RecordedRay* next = rays_.data();
    for (const Packet& from : packets_) {
        const RecordedRay* ray = next;
        next += std::popcount(from.active);
        if (from.use != use || from.active == 0) continue;
        RayPacket16& p = result.emplace_back();
        for (int i = 0; i < kPacket; ++i) set_ray_at(*ray, i, p);  // lanes out of use: any rays
        p.active = from.active;
        p.passing = from.passing;
        p.coherent = use == RayUse::Camera;
        for (uint32_t left = from.active; left; left &= left - 1)
            set_ray_at(*ray++, std::countr_zero(left), p);
    }
    return result;
}

std::vector<RayPacket16> RecordedRays::sorted(RayUse use) const {
    std::vector<std::pair<RecordedRay, uint64_t>> rays[2];  // not passing, passing
    const RecordedRay* next = rays_.data();
    vec3 low(std::numeric_limits<float>::infinity()), high(-low);
    for (const Packet& from : packets_)
        for (int i = std::popcount(from.active); i > 0; --i, ++next) {
            if (from.use != use) continue;
            rays[from.passing].push_back({*next, 0});
            for (int c = 0; c < 3; ++c) {
                low[c] = std::min(low[c], next->org[c]);
                high[c] = std::max(high[c], next->org[c]);
            }
        }
    std::vector<RayPacket16> result;
    for (bool passing : {false, true}) {
        for (auto& [ray, key] : rays[passing]) {
            uint32_t cell[3], way[2];
            float sum = std::abs(ray.dir[0]) + std::abs(ray.dir[1]) + std::abs(ray.dir[2]);
            for (int c = 0; c < 3; ++c) {
                const float side = high[c] - low[c];
                cell[c] = side > 0 ? uint32_t(31.99f * (ray.org[c] - low[c]) / side) : 0;
            }
            float x = ray.dir[0] / sum, y = ray.dir[1] / sum;
            if (ray.dir[2] < 0) {
                const float folded = (1 - std::abs(y)) * std::copysign(1.0f, x);
                y = (1 - std::abs(x)) * std::copysign(1.0f, y);
                x = folded;
            }
            way[0] = uint32_t(1023 * std::clamp(0.5f * x + 0.5f, 0.0f, 1.0f));
            way[1] = uint32_t(1023 * std::clamp(0.5f * y + 0.5f, 0.0f, 1.0f));
            key = interleave(cell, 3) << 20 | interleave(way, 2);
        }
        std::stable_sort(rays[passing].begin(), rays[passing].end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
        for (size_t first = 0; first < rays[passing].size(); first += kPacket) {
            RayPacket16& p = result.emplace_back();
            const size_t n = std::min<size_t>(kPacket, rays[passing].size() - first);
            for (size_t i = 0; i < kPacket; ++i)
                set_ray_at(rays[passing][first + std::min(i, n - 1)].first, int(i), p);
            p.active = n == kPacket ? 0xffffu : (1u << n) - 1;
            p.passing = passing;
            p.coherent = use == RayUse::Camera;
        }
    }
    return result;
}

// ---- kernels ------------------------------------------------------------------------------------

namespace {

constexpr size_t kMostSlots = 32;

struct Log {
    const jit::KernelCall& call;
    std::vector<std::vector<float>> results;
    size_t next;
};

template <size_t slot>
void keep(const jit::ServiceCall& asked) {
    Log& log = *static_cast<Log*>(asked.grid);
    jit::ServiceCall real = asked;
    real.grid = log.call.host;
    log.call.services[slot](real);
    const size_t floats = log.call.kernel.services[slot].results.size() * jit::kMaxLanes;
    log.results.emplace_back(asked.results, asked.results + floats);
}
void answer(const jit::ServiceCall& asked) {
    Log& log = *static_cast<Log*>(asked.grid);
    const std::vector<float>& kept = log.results[log.next++];
    std::copy(kept.begin(), kept.end(), asked.results);
}
template <size_t... slots>
constexpr std::array<jit::ServiceFn, kMostSlots> keepers(std::index_sequence<slots...>) {
    return {keep<slots>...};
}

}  // namespace

void ReplayedKernels::run(const jit::KernelCall& call) {
    const std::vector<jit::ServiceInfo>& services = call.kernel.services;
    const bool records = std::any_of(services.begin(), services.end(), [](const auto& s) {
        return s.name == "lights" || s.name == "gather";  // whose memory is let go again
    });
    if (services.size() > kMostSlots || records) {
        ++left_out;
        call.run();
        return;
    }
    Log log{call, {}, 0};
    std::array<jit::ServiceFn, kMostSlots> functions =
        keepers(std::make_index_sequence<kMostSlots>{});
    jit::KernelCall own = call;
    own.services = {functions.data(), services.size()};
    own.host = &log;
    own.run();
    functions.fill(answer);
    uint64_t least = ~uint64_t{0};
    for (int run = 0; run < runs_; ++run) {
        log.next = 0;
        const jit::CheckedCall checked(own);
        const uint64_t begin = cpu_ticks();
        checked.run();
        least = std::min(least, cpu_ticks() - begin);
    }
    ticks += least;
    points += call.count;
    ++launches;
}

}  // namespace kinora
