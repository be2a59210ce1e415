// tests/bench/recorded_frame_test.cpp: what frame_floor records is what was traced and launched,
// and its replays are the same rays and the same launches.
#include "tests/bench/recorded_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <set>

#include "tests/raytrace/meshes.h"

namespace kinora::test {
namespace {

using raytrace::HitPacket16;
using raytrace::kPacket;
using raytrace::RayPacket16;

// ---- rays ---------------------------------------------------------------------------------------

// Rays towards -z from a place of x = number / 1000 about `x`: each is known by its origin.
class Packets {
  public:
    RayPacket16 next(uint32_t active, bool coherent = false, float x = 0) {
        RayPacket16 p{};
        for (int i = 0; i < kPacket; ++i) {
            p.org_x[i] = x + float(number_++) / 1000;
            p.org_z[i] = 5;
            p.dir_z[i] = -1;
            p.tfar[i] = 100;
            p.mask[i] = raytrace::kMaskAll;
        }
        p.active = active;
        p.coherent = coherent;
        return p;
    }

  private:
    int number_ = 0;
};

std::multiset<float> rays_of(const std::vector<RayPacket16>& packets) {
    std::multiset<float> found;
    for (const RayPacket16& p : packets)
        for (uint32_t left = p.active; left; left &= left - 1)
            found.insert(p.org_x[std::countr_zero(left)]);
    return found;
}

TEST(RecordedRays, AreReplayedInTheirLanesByUse) {
    Packets packets;
    const RayPacket16 camera = packets.next(0xffff, true), nested = packets.next(0x8001),
                      empty = packets.next(0), shadow = packets.next(0x00f0);
    RecordedRays rays;
    rays.closest(camera);
    rays.closest(nested);
    rays.any(shadow);
    rays.closest(empty);
    const std::pair<RayUse, const RayPacket16*> expected[] = {
        {RayUse::Camera, &camera}, {RayUse::Nested, &nested}, {RayUse::Shadow, &shadow}};
    for (auto [use, from] : expected) {
        const std::vector<RayPacket16> sent = rays.as_sent(use);
        ASSERT_EQ(sent.size(), 1u);
        EXPECT_EQ(sent[0].active, from->active);
        EXPECT_EQ(sent[0].coherent, use == RayUse::Camera);
        for (int i = 0; i < kPacket; ++i)
            if (from->active >> i & 1) {
                EXPECT_EQ(sent[0].org_x[i], from->org_x[i]);
                EXPECT_EQ(sent[0].dir_z[i], -1);
                EXPECT_EQ(sent[0].tfar[i], 100);
                EXPECT_EQ(sent[0].mask[i], raytrace::kMaskAll);
            }
    }
}

TEST(RecordedRays, SortedAreTheSameRaysInFullPacketsOfOnePlace) {
    Packets packets;
    RecordedRays rays;
    std::multiset<float> sent;
    // Places 1000 apart in turns, half of the lanes in use.
    for (int k = 0; k < 8; ++k) {
        const RayPacket16 p = packets.next(0x5555, false, k % 2 ? 1000.0f : 0.0f);
        rays.closest(p);
        for (int i = 0; i < kPacket; i += 2) sent.insert(p.org_x[i]);
    }
    const std::vector<RayPacket16> sorted = rays.sorted(RayUse::Nested);
    EXPECT_EQ(rays_of(sorted), sent);
    EXPECT_EQ(rays_of(rays.as_sent(RayUse::Nested)), sent);
    ASSERT_EQ(sorted.size(), 4u);  // 64 rays
    for (const RayPacket16& p : sorted) {
        EXPECT_EQ(p.active, 0xffffu);
        for (int i = 1; i < kPacket; ++i) EXPECT_EQ(p.org_x[i] > 500, p.org_x[0] > 500);
    }
    EXPECT_TRUE(rays.sorted(RayUse::Camera).empty());
}

TEST(RecordedRays, SortedKeepRaysApartThatGoOnBehindAHit) {
    Packets packets;
    RecordedRays rays;
    RayPacket16 passing = packets.next(0x0007);
    passing.passing = true;
    for (int i = 0; i < kPacket; ++i) {
        passing.window[i] = 0.25f;
        passing.passed_first[i] = 3;
        passing.passed_last[i] = raytrace::kNone;
    }
    rays.closest(passing);
    rays.closest(packets.next(0x001f));
    const std::vector<RayPacket16> sorted = rays.sorted(RayUse::Nested);
    ASSERT_EQ(sorted.size(), 2u);
    EXPECT_FALSE(sorted[0].passing);
    EXPECT_EQ(sorted[0].active, 0x1fu);
    EXPECT_TRUE(sorted[1].passing);
    EXPECT_EQ(sorted[1].active, 0x7u);
    EXPECT_EQ(sorted[1].window[2], 0.25f);
    EXPECT_EQ(sorted[1].passed_first[2], 3u);
    EXPECT_EQ(sorted[1].passed_last[2], raytrace::kNone);
}

// By the Accel itself: what is recorded of it, traced again, meets the same triangles.
TEST(RecordedRays, MeetAgainWhatTheyMet) {
    using Met = std::map<float, std::pair<uint32_t, float>>;  // by origin: triangle and distance
    const raytrace::test::TestMesh ball = raytrace::test::sphere(1, {0, 0, 0});
    raytrace::Accel accel;
    const std::vector<raytrace::Geometry> rows = {ball.geometry(1)};
    accel.update(rows);
    raytrace::TraceCounters counters;
    auto trace = [&](const std::vector<RayPacket16>& all) {
        Met met;
        for (const RayPacket16& p : all) {
            HitPacket16 hits;
            for (uint32_t hit = accel.intersect16(p, hits, counters); hit; hit &= hit - 1) {
                const int i = std::countr_zero(hit);
                met[p.org_x[i]] = {hits.primitive[i], hits.t[i]};
            }
        }
        return met;
    };
    Packets packets;
    std::vector<RayPacket16> all;
    for (uint32_t active : {0xffffu, 0x1234u, 0x8000u, 0xfffeu})
        for (int k = 0; k < 20; ++k) all.push_back(packets.next(active));
    RecordedRays rays;
    raytrace::record_packets(&rays);
    const Met first = trace(all);
    raytrace::record_packets(nullptr);
    trace(all);  // not recorded
    EXPECT_GT(first.size(), 300u);
    EXPECT_EQ(trace(rays.as_sent(RayUse::Nested)), first);
    EXPECT_EQ(trace(rays.sorted(RayUse::Nested)), first);
}

// ---- kernels ------------------------------------------------------------------------------------

// Writes what its one service answers, lane group by lane group.
struct AskingKernel : jit::Kernel {
    explicit AskingKernel(const char* service) {
        outputs.resize(1);
        services.resize(1);
        services[0].name = service;
        services[0].results.resize(1);
    }
    void run(const jit::KernelArgs& args) const override {
        ++runs;
        for (int32_t first = 0; first < args.count; first += jit::kMaxLanes) {
            alignas(64) float asked[jit::kMaxLanes] = {};
            const jit::ServiceCall call{args.grid, asked, args.out[0] + first,
                                        0xffffu,   first, jit::kMaxLanes};
            args.services[0](call);
        }
    }
    mutable int runs = 0;
};

// Never answers the same twice.
void answer_next(const jit::ServiceCall& call) {
    int& next = *static_cast<int*>(call.grid);
    for (int lane = 0; lane < jit::kMaxLanes; ++lane) call.results[lane] = float(next++);
}

struct Launch {
    explicit Launch(const jit::Kernel& k) : kernel(k) {}
    void run(KernelProbe& probe) {
        float* const rows[] = {out.data()};
        const jit::ServiceFn services[] = {answer_next};
        jit::KernelCall call{.kernel = kernel, .count = 40};
        call.out = rows;
        call.row_floats = out.size();
        call.services = services;
        call.host = &next;
        probe.run(call);
    }
    const jit::Kernel& kernel;
    alignas(64) std::array<float, 48> out{};
    int next = 0;
};

TEST(ReplayedKernels, AskServicesOnceAndReplayWhatTheyAnswered) {
    const AskingKernel kernel("texture");
    Launch launch(kernel);
    ReplayedKernels replayed(5);
    launch.run(replayed);
    EXPECT_EQ(kernel.runs, 1 + 5);
    EXPECT_EQ(launch.next, 48);  // three groups of lanes, once
    for (size_t i = 0; i < launch.out.size(); ++i) EXPECT_EQ(launch.out[i], float(i));
    EXPECT_EQ(replayed.launches, 1u);
    EXPECT_EQ(replayed.points, 40u);
    EXPECT_EQ(replayed.left_out, 0u);
    launch.run(replayed);
    EXPECT_EQ(launch.next, 96);
    EXPECT_EQ(launch.out[0], 48);  // of the second launch
    EXPECT_EQ(replayed.points, 80u);
}

TEST(ReplayedKernels, RunOnceWhereServicesHandOutMemory) {
    for (const char* service : {"lights", "gather"}) {
        const AskingKernel kernel(service);
        Launch launch(kernel);
        ReplayedKernels replayed(5);
        launch.run(replayed);
        EXPECT_EQ(kernel.runs, 1);
        EXPECT_EQ(launch.next, 48);
        EXPECT_EQ(replayed.left_out, 1u);
        EXPECT_EQ(replayed.launches, 0u);
        EXPECT_EQ(replayed.ticks, 0u);
    }
}

}  // namespace
}  // namespace kinora::test
