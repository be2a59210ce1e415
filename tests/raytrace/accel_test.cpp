// tests/raytrace/accel_test.cpp: Embree's answers against brute force, and their way to the caller.
#include "raytrace/accel.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "raytrace/brute_force.h"
#include "tests/raytrace/meshes.h"

namespace kinora::raytrace::test {
namespace {

struct Disagreements {
    int wrong = 0, edges = 0, hits = 0;
};

// A ray that brute force sees pass within `margin` (in barycentrics) of an edge may go either way.
bool near_edge(const ReferenceHit& hit, double margin = 1e-5) {
    return hit.u < margin || hit.v < margin || hit.u + hit.v > 1 - margin;
}

void compare(const OneHit& got, const ReferenceHit& want, vec3 dir, Disagreements& result) {
    if (want.geometry != kNone) ++result.hits;
    if (got.hit != (want.geometry != kNone)) {
        ++(want.geometry != kNone && near_edge(want) ? result.edges : result.wrong);
        return;
    }
    if (!got.hit) return;
    const bool same = got.geometry == want.geometry && got.instance == want.instance &&
                      got.primitive == want.primitive;
    if (!same) {
        ++(near_edge(want) ? result.edges : result.wrong);
        return;
    }
    dvec3 ng(got.Ng), wanted = want.Ng;
    auto unit = [](dvec3 n) { return n / std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z); };
    ng = unit(ng), wanted = unit(wanted);
    const double facing = ng.x * wanted.x + ng.y * wanted.y + ng.z * wanted.z;
    const double grazing = std::abs(wanted.x * dir.x + wanted.y * dir.y + wanted.z * dir.z);
    const double tolerance = 2e-5 / std::max(grazing, 0.01);  // the plane is met obliquely
    if (std::abs(double(got.t) - want.t) > tolerance * want.t || facing < 0.9999) ++result.wrong;
    if (std::abs(double(got.u) - want.u) > 100 * tolerance) ++result.wrong;
    if (std::abs(double(got.v) - want.v) > 100 * tolerance) ++result.wrong;
}

Disagreements shoot_many(const Accel& accel, std::span<const Geometry> rows, int count,
                         uint32_t mask = kMaskAll) {
    RandomRays rays(7);
    Disagreements result;
    for (int i = 0; i < count; ++i) {
        vec3 org, dir;
        rays.next(6, dvec3(0.0), org, dir);
        ReferenceRay ray{dvec3(org), dvec3(dir)};
        ray.mask = mask;
        compare(shoot(accel, org, dir, 0, std::numeric_limits<float>::infinity(), mask),
                brute_force(rows, ray), dir, result);
    }
    return result;
}

dmat4 some_matrix(double scale, bool mirror) {
    const double a = 0.7, c = std::cos(a), s = std::sin(a);
    dmat4 turn(dvec4(c, s, 0, 0), dvec4(-s, c, 0, 0), dvec4(0, 0, 1, 0), dvec4(0.5, -0.3, 0.2, 1));
    dmat4 size(dvec4(scale, 0, 0, 0), dvec4(0, mirror ? -1.3 : 1.3, 0, 0), dvec4(0.2, 0, 0.8, 0),
               dvec4(0, 0, 0, 1));
    return turn * size;
}

struct MixedScene {
    TestMesh a = sphere(1.0, {1.5, 0, 0}), b = soup(300, 2, 0.5, 1), c = tube(24, 20);
    TestMesh d = sphere(0.6, {0, 0, 0}, 16, 8);
    std::vector<Geometry> rows;
    MixedScene() {
        rows = {a.geometry(100), b.geometry(7), c.geometry(31, GeometryKind::Deforming),
                d.geometry(55, GeometryKind::Instanced), d.geometry(56, GeometryKind::Instanced)};
        for (int k = 3; k < 5; ++k) rows[k].shape = 9;
        rows[3].accel_from_local = some_matrix(0.9, false);
        rows[4].accel_from_local = some_matrix(1.4, true);
        rows[4].accel_from_local[3] = dvec4(-2, 1, 0.5, 1);
        rows[1].opaque = rows[4].opaque = false;
    }
};

TEST(Accel, AgreesWithBruteForceOnRandomRays) {
    MixedScene scene;
    for (bool robust : {true, false}) {
        Accel accel({.robust = robust});
        EXPECT_TRUE(accel.update(scene.rows).issues.empty());
        Disagreements d = shoot_many(accel, scene.rows, 4000);
        EXPECT_EQ(d.wrong, 0);
        EXPECT_LE(d.edges, 4);
        EXPECT_GT(d.hits, 1500);
    }
}

TEST(Accel, TakesTheBarycentricsOfThePrimitivesOwnOrder) {
    TestMesh m;
    m.positions = {vec4(0, 0, 0, 0), vec4(1, 0, 0, 0), vec4(0, 1, 0, 0)};
    m.triangles = {0, 1, 2};
    Accel accel;
    std::vector<Geometry> rows{m.geometry(3)};
    accel.update(rows);
    OneHit hit = shoot(accel, {0.25f, 0.5f, 2}, {0, 0, -1});
    ASSERT_TRUE(hit.hit);
    EXPECT_FLOAT_EQ(hit.u, 0.25f);
    EXPECT_FLOAT_EQ(hit.v, 0.5f);
    EXPECT_FLOAT_EQ(hit.t, 2);
    EXPECT_GT(hit.Ng.z, 0);
}

TEST(Accel, RayMasksTellOpaqueFromNotOpaqueGeometry) {
    MixedScene scene;
    Accel accel;
    accel.update(scene.rows);
    for (uint32_t mask : {kMaskOpaque, kMaskNotOpaque}) {
        Disagreements d = shoot_many(accel, scene.rows, 1500, mask);
        EXPECT_EQ(d.wrong, 0);
        EXPECT_GT(d.hits, 200);
    }
}

TEST(Accel, OccludedAgreesWithIntersect) {
    MixedScene scene;
    Accel accel;
    accel.update(scene.rows);
    RandomRays random(11);
    TraceCounters counters;
    for (int n = 0; n < 500; ++n) {
        RayPacket16 packet;
        packet.active = 0xffff & ~(1u << (n % 16));
        for (int i = 0; i < kPacket; ++i) {
            vec3 org, dir;
            random.next(6, dvec3(0.0), org, dir);
            set_lane(packet, i, org, dir, 0, 6, n % 2 ? kMaskAll : kMaskOpaque);
        }
        HitPacket16 hits;
        EXPECT_EQ(accel.intersect16(packet, hits, counters), accel.occluded16(packet, counters));
    }
    EXPECT_EQ(counters.rays, 500u * 15);
    EXPECT_EQ(counters.shadow_rays, 500u * 15);
    EXPECT_EQ(counters.filtered, 0u);
}

TEST(Accel, TheCoherenceHintChangesNoAnswer) {
    MixedScene scene;
    for (bool robust : {true, false}) {
        AccelPolicy policy;
        policy.robust = robust;
        Accel accel(policy);
        accel.update(scene.rows);
        RandomRays rays(11);
        TraceCounters counters;
        int hits = 0;
        for (int i = 0; i < 2000; ++i) {
            RayPacket16 packet{};
            HitPacket16 plain, hinted;
            vec3 org, dir, scattered, way;
            rays.next(6, dvec3(0.0), org, dir);
            for (int lane = 0; lane < kPacket; ++lane) {
                rays.next(6, dvec3(0.0), scattered, way);
                // Neighbours from one eye in even packets, rays from anywhere in odd ones.
                if (i % 2 == 0)
                    set_lane(packet, lane, org, dir + 0.05f * way);
                else
                    set_lane(packet, lane, scattered, way);
            }
            packet.coherent = false;
            const uint32_t met = accel.intersect16(packet, plain, counters);
            packet.coherent = true;
            ASSERT_EQ(accel.intersect16(packet, hinted, counters), met);
            for (int lane = 0; lane < kPacket; ++lane) {
                if (!(met >> lane & 1)) continue;
                ++hits;
                ASSERT_EQ(hinted.geometry[lane], plain.geometry[lane]);
                ASSERT_EQ(hinted.primitive[lane], plain.primitive[lane]);
                ASSERT_EQ(hinted.t[lane], plain.t[lane]);
                ASSERT_EQ(hinted.u[lane], plain.u[lane]);
                ASSERT_EQ(hinted.v[lane], plain.v[lane]);
            }
        }
        EXPECT_GT(hits, 5000);
    }
}

TEST(Accel, AnInstanceEqualsItsBakedMesh) {
    for (bool mirror : {false, true}) {
        TestMesh local = tube(20, 20);
        TestMesh baked = local;
        const dmat4 matrix = some_matrix(1.2, mirror);
        for (vec4& p : baked.positions) p = vec4(vec3(matrix * dvec4(dvec3(vec3(p)), 1.0)), 0.0f);
        std::vector<Geometry> instanced{local.geometry(1, GeometryKind::Instanced)};
        instanced[0].accel_from_local = matrix;
        std::vector<Geometry> direct{baked.geometry(1)};
        direct[0].mirrored = mirror;
        Accel a, b;
        a.update(instanced);
        b.update(direct);
        RandomRays random(5);
        int differ = 0, hits = 0;
        for (int i = 0; i < 3000; ++i) {
            vec3 org, dir;
            random.next(5, dvec3(0.0), org, dir);
            OneHit x = shoot(a, org, dir), y = shoot(b, org, dir);
            if (x.hit != y.hit || (x.hit && x.primitive != y.primitive)) {
                ++differ;  // an edge: rounding differs by the matrix
                continue;
            }
            if (!x.hit) continue;
            ++hits;
            EXPECT_NEAR(x.t, y.t, 1e-4f * y.t);
            EXPECT_GT(x.Ng.x * y.Ng.x + x.Ng.y * y.Ng.y + x.Ng.z * y.Ng.z, 0);
        }
        EXPECT_LE(differ, 6);
        EXPECT_GT(hits, 300);
    }
}

TEST(Accel, BackFacesHideFromCameraRaysOnly) {
    TestMesh ball = sphere(1, {0, 0, 0});
    for (GeometryKind kind :
         {GeometryKind::Static, GeometryKind::Deforming, GeometryKind::Instanced}) {
        for (bool mirrored : {false, true}) {
            std::vector<Geometry> rows{ball.geometry(1, kind)};
            rows[0].hide_backfaces = true;
            rows[0].mirrored = mirrored;
            for (bool fixed_winner : {false, true}) {
                Accel accel({.fixed_winner = fixed_winner});
                accel.update(rows);
                constexpr float inf = std::numeric_limits<float>::infinity();
                vec3 org{0.1f, 0.2f, 5}, dir{0, 0, -1};
                OneHit seen = shoot(accel, org, dir, 0, inf, kMaskAll | kMaskCamera);
                OneHit met = shoot(accel, org, dir);
                ASSERT_TRUE(seen.hit && met.hit);
                EXPECT_LT(met.t, 4.2f);
                if (mirrored)  // outside is inside: the far wall is seen
                    EXPECT_GT(seen.t, 5.5f);
                else
                    EXPECT_LT(seen.t, 4.2f);
            }
        }
    }
}

TEST(Accel, OfCoincidentSurfacesTheLowestRowAndPrimitiveWins) {
    TestMesh ball = sphere(1, {0, 0, 0});
    TestMesh twice = ball;  // each triangle twice within one mesh, too
    twice.triangles.insert(twice.triangles.end(), ball.triangles.begin(), ball.triangles.end());
    std::vector<Geometry> rows{twice.geometry(12, GeometryKind::Deforming), ball.geometry(4),
                               twice.geometry(3), ball.geometry(2, GeometryKind::Deforming)};
    Accel accel;
    accel.update(rows);
    RandomRays random(3);
    int hits = 0;
    for (int i = 0; i < 3000; ++i) {
        vec3 org, dir;
        random.next(4, dvec3(0.0), org, dir);
        OneHit hit = shoot(accel, org, dir);
        if (!hit.hit) continue;
        ++hits;
        EXPECT_EQ(hit.instance, 0u);
        EXPECT_LT(hit.primitive, ball.triangles.size() / 3);
    }
    EXPECT_GT(hits, 1000);
}

TEST(Accel, AnEmptySceneAnswersMiss) {
    Accel accel;
    EXPECT_FALSE(shoot(accel, {0, 0, 0}, {0, 0, 1}).hit);
    accel.update({});
    EXPECT_FALSE(shoot(accel, {0, 0, 0}, {0, 0, 1}).hit);
    Geometry empty;
    accel.update(std::span(&empty, 1));
    EXPECT_FALSE(shoot(accel, {0, 0, 0}, {0, 0, 1}).hit);
}

// docs/numerics.md#rays: measured 0.5 % in robust mode.
TEST(Accel, RaysAtVerticesAndEdgesOfAClosedMeshFindNoHole) {
    TestMesh ball = sphere(1, {0, 0, 0}, 40, 20);
    Accel accel;
    std::vector<Geometry> rows{ball.geometry(1)};
    accel.update(rows);
    RandomRays random(17);
    int misses = 0, rays = 0;
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int i = 0; i < 20000; ++i) {
        const size_t triangle = random.random() % (ball.triangles.size() / 3);
        auto corner = [&](int k) {
            return dvec3(vec3(ball.positions[ball.triangles[3 * triangle + size_t(k)]]));
        };
        const double along = i % 2 ? 0 : uniform(random.random);
        const dvec3 target = corner(0) + along * (corner(1) - corner(0));
        const dvec3 inside = 0.5 * random.point();
        misses += !shoot(accel, vec3(inside), vec3(target - dvec3(vec3(inside)))).hit;
        ++rays;
    }
    EXPECT_LE(misses, rays * 6 / 1000);
}

}  // namespace
}  // namespace kinora::raytrace::test
