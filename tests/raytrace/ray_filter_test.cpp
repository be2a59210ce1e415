// tests/raytrace/ray_filter_test.cpp: rays that would abort Embree are misses
// (docs/numerics.md#rays), and the floating-point mode is given back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cfenv>

#include "raytrace/hits.h"
#include "raytrace/wavefront.h"
#include "tests/raytrace/meshes.h"

namespace kinora::raytrace::test {
namespace {

struct OneSphere : ::testing::Test {
    TestMesh ball = sphere(1, {0, 0, 0});
    Accel accel;
    void SetUp() override {
        Geometry row = ball.geometry(1);
        accel.update(std::span(&row, 1));
    }
};
using RayFilter = OneSphere;

TEST_F(RayFilter, MalformedRaysAreCountedMissesAndSpareTheirNeighbours) {
    struct Bad {
        vec3 org, dir;
        float tnear, tfar;
    };
    const vec3 o{0, 0, 5}, d{0, 0, -1};
    std::vector<Bad> bad;
    for (float x : {kNaN, kInf, -kInf, 1.85e18f, -3e38f}) {
        for (int c = 0; c < 3; ++c) {
            vec3 org = o, dir = d;
            org[c] = x;
            dir[c] = x;
            bad.push_back({org, d, 0, kInf});
            bad.push_back({o, dir, 0, kInf});
        }
    }
    bad.push_back({o, d, -1e-30f, kInf});
    bad.push_back({o, d, -kInf, kInf});
    bad.push_back({o, d, kNaN, kInf});
    bad.push_back({o, d, 0, kNaN});
    bad.push_back({o, {0, 0, 0}, 0, kInf});
    bad.push_back({o, {0, -0.0f, 0}, 0, kInf});
    for (const Bad& b : bad) {
        RayPacket16 packet;
        for (int i = 0; i < kPacket; ++i) set_lane(packet, i, o, d);
        set_lane(packet, 5, b.org, b.dir, b.tnear, b.tfar);
        HitPacket16 hits;
        TraceCounters counters;
        EXPECT_EQ(accel.intersect16(packet, hits, counters), 0xffffu & ~(1u << 5));
        EXPECT_EQ(hits.geometry[5], kNone);
        EXPECT_EQ(accel.occluded16(packet, counters), 0xffffu & ~(1u << 5));
        EXPECT_EQ(counters.filtered, 2u);
    }
}

TEST_F(RayFilter, EmptyIntervalsAreMisses) {
    EXPECT_FALSE(shoot(accel, {0, 0, 5}, {0, 0, -1}, 4.5f, 4.2f).hit);
    EXPECT_FALSE(shoot(accel, {0, 0, 5}, {0, 0, -1}, 0, -1).hit);
    EXPECT_FALSE(shoot(accel, {0, 0, 5}, {0, 0, -1}, 0, -kInf).hit);
    EXPECT_FALSE(shoot(accel, {0, 0, 5}, {0, 0, -1}, kInf, kInf).hit);
}

TEST_F(RayFilter, TnearAndTfarBoundTheHit) {
    EXPECT_NEAR(shoot(accel, {0.1f, 0.1f, 5}, {0, 0, -1}).t, 4.02, 0.03);
    EXPECT_NEAR(shoot(accel, {0.1f, 0.1f, 5}, {0, 0, -1}, 4.5f).t, 5.98, 0.03);
    EXPECT_FALSE(shoot(accel, {0.1f, 0.1f, 5}, {0, 0, -1}, 0, 3.9f).hit);
}

TEST_F(RayFilter, DirectionsOfAnyLengthFindTheSameHit) {
    const OneHit unit = shoot(accel, {0.1f, 0.2f, 5}, {0, 0, -1});
    for (float length : {1e-44f, 1e-38f, 1e-30f, 1e-20f, 1e-8f, 1e8f, 1e18f}) {
        const OneHit hit = shoot(accel, {0.1f, 0.2f, 5}, {0, 0, -length});
        ASSERT_TRUE(hit.hit) << length;
        EXPECT_EQ(hit.primitive, unit.primitive);
        if (length > 1e-38f) {
            EXPECT_NEAR(hit.t * length, unit.t, 1e-5f);
        }
    }
}

TEST_F(RayFilter, AllSixteenLanesMalformedIsAMiss) {
    RayPacket16 packet;
    for (int i = 0; i < kPacket; ++i) set_lane(packet, i, {kNaN, 0, 0}, {0, 0, 1});
    HitPacket16 hits;
    TraceCounters counters;
    EXPECT_EQ(accel.intersect16(packet, hits, counters), 0u);
    EXPECT_EQ(accel.occluded16(packet, counters), 0u);
    EXPECT_EQ(counters.filtered, 32u);
}

TEST_F(RayFilter, InactiveLanesMayHoldAnything) {
    RayPacket16 packet;
    for (int i = 0; i < kPacket; ++i) set_lane(packet, i, {kNaN, 0, 0}, {kInf, 0, 1}, -1, kNaN);
    set_lane(packet, 3, {0, 0, 5}, {0, 0, -1});
    packet.active = 1u << 3;
    HitPacket16 hits;
    TraceCounters counters;
    EXPECT_EQ(accel.intersect16(packet, hits, counters), 1u << 3);
    EXPECT_EQ(counters.filtered, 0u);
    EXPECT_EQ(counters.rays, 1u);
    // Whatever random shaders left there made Embree's shadow rays abort.
    for (int i = 0; i < kPacket; ++i) set_lane(packet, i, {0, 0, 5}, {0, 0, -1});
    set_lane(packet, 2, {kNaN, kNaN, kNaN}, {0, 0, 0}, 0, 1);
    packet.active = 0x7b;
    EXPECT_EQ(accel.occluded16(packet, counters), 0x7bu);
    EXPECT_EQ(accel.intersect16(packet, hits, counters), 0x7bu);
}

TEST(DenormalGuard, FlushesInItsScopeOnly) {
    volatile float tiny = 1e-39f;
    EXPECT_NE(tiny * 1.0f, 0.0f);
    {
        DenormalGuard guard;
        { DenormalGuard inner; }
        EXPECT_EQ(tiny * 1.0f, 0.0f);
    }
    EXPECT_NE(tiny * 1.0f, 0.0f);
}

TEST_F(RayFilter, TracingLeavesDenormalsToTheCaller) {
    shoot(accel, {0, 0, 5}, {0, 0, -1});
    volatile float tiny = 1e-39f;
    EXPECT_NE(tiny * 1.0f, 0.0f);
}

TEST_F(RayFilter, OccludedByOpaqueLooksAtOpaqueGeometryOnly) {
    TestMesh near = sphere(1, {0, 0, 3});
    std::vector<Geometry> rows{ball.geometry(1), near.geometry(2)};
    rows[1].opaque = false;
    accel.update(rows);
    RayBatch rays(20);
    for (size_t k = 0; k < 20; ++k) {
        rays.org[0][k] = k < 10 ? 0.1f : 3.0f;
        rays.org[1][k] = 0.1f;
        rays.org[2][k] = 10;
        rays.dir[0][k] = rays.dir[1][k] = 0;
        rays.dir[2][k] = -1;
        rays.tnear[k] = 0;
        rays.tfar[k] = k % 2 ? 8 : 20;  // 8 ends between the balls
        ++rays.count;
    }
    std::vector<uint8_t> blocked(20);
    TraceCounters counters;
    occluded(accel, rays, kMaskOpaque, blocked.data(), counters);
    for (size_t k = 0; k < 20; ++k) EXPECT_EQ(blocked[k], k < 10 && k % 2 == 0) << k;
}

// RayBatch::sees goes with the ray, also where it is moved within its batch.
TEST_F(RayFilter, RaysMeetNoMoreThanTheySee) {
    TestMesh near = sphere(1, {0, 0, 3});
    std::vector<Geometry> rows{ball.geometry(1), near.geometry(2)};
    rows[1].opaque = false;
    accel.update(rows);
    constexpr uint32_t kSees[] = {kMaskAll, kMaskOpaque, kMaskNotOpaque, 0};
    RayBatch rays(40);
    for (size_t k = 0; k < 40; ++k) {
        set_ray(rays, k, {0.1f, 0.1f, 10}, {0, 0, -1}, 20);
        rays.sees[k] = kSees[k % 4];
        rays.slot[k] = uint32_t(k);
        ++rays.count;
    }
    TraceCounters counters;
    HitStore store;
    std::vector<uint32_t> met(40, 0), want = {2, 1, 2, 0};  // by slot
    auto look = [&] {
        const HitBatch& hits = trace(accel, rays, kMaskAll, 1, store, counters);
        for (size_t h = 0; h < hits.count; ++h) met[rays.slot[hits.ray[h]]] = hits.geometry[h];
    };
    look();
    for (size_t k = 0; k < 40; ++k) EXPECT_EQ(met[k], want[k % 4]) << k;
    std::vector<uint8_t> blocked(40);
    std::vector<uint32_t> odd;
    for (uint32_t k = 1; k < 40; k += 2) odd.push_back(k);
    occluded(accel, rays, odd, kMaskOpaque, blocked.data(), counters);
    for (size_t i = 0; i < odd.size(); ++i) EXPECT_EQ(blocked[i], odd[i] % 4 == 1) << odd[i];
    rays.count = 0;
    for (uint32_t k : odd) move_ray(rays, rays.count++, k);
    std::ranges::fill(met, 0u);
    look();
    for (uint32_t k : odd) EXPECT_EQ(met[k], want[k % 4]) << k;
}

}  // namespace
}  // namespace kinora::raytrace::test
