// tests/raytrace/cracks_test.cpp: closed meshes have no cracks, wherever they stand.
#include <gtest/gtest.h>

#include <bit>

#include "tests/fuzz_settings.h"
#include "tests/raytrace/meshes.h"

namespace kinora::raytrace::test {
namespace {

struct Place {
    double radius, distance;
};

// Rays from points near the middle that meet nothing.
uint64_t leaks(const Accel& accel, Place place, uint64_t count) {
    RandomRays random(7);
    uint64_t missed = 0;
    RayPacket16 packet{};
    HitPacket16 hits;
    TraceCounters counters;
    for (uint64_t i = 0; i < count; i += 16) {
        for (int lane = 0; lane < 16; ++lane) {
            dvec3 from = place.radius * 0.3 * random.direction();
            set_lane(packet, lane, vec3(dvec3(place.distance) + from), vec3(random.direction()));
        }
        packet.active = 0xffff;
        missed += 16 - unsigned(std::popcount(accel.intersect16(packet, hits, counters)));
    }
    return missed;
}

// scripts/nightly extremes sets KINORA_RAYS to 10^7.
TEST(Cracks, NoRayLeavesAClosedMesh) {
    const uint64_t count = fuzz_setting("KINORA_RAYS", 200000);
    for (Place place : {Place{1, 0}, {1e-6, 0}, {1e6, 0}, {1, 1e3}, {1, 1e5}}) {
        TestMesh ball = sphere(place.radius, dvec3(place.distance), 61, 37);
        Accel accel({.robust = true});
        Geometry row = ball.geometry(1);
        accel.update(std::span(&row, 1));
        EXPECT_EQ(leaks(accel, place, count), 0u) << place.radius << " at " << place.distance;
    }
}

}  // namespace
}  // namespace kinora::raytrace::test
