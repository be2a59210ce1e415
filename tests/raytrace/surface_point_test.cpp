// tests/raytrace/surface_point_test.cpp: hit points, their error bounds, and rays that leave them
// without meeting the surface again (docs/numerics.md#where-rays-leave).
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "raytrace/accel.h"
#include "raytrace/brute_force.h"
#include "raytrace/points/points.h"
#include "tests/raytrace/meshes.h"

namespace kinora::raytrace::test {
namespace {

double dot(dvec3 a, dvec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

struct Leaving {
    int hits = 0, outward_again = 0, inward_missed = 0;
};

// Shoots at a convex body, then from each hit outward (must meet nothing) and inward (must meet
// the far side).
Leaving leave(const Accel& accel, double radius, dvec3 center, int count) {
    RandomRays random(41);
    Leaving result;
    for (int i = 0; i < count; ++i) {
        vec3 org, dir;
        random.next(2 * radius, center, org, dir);
        OneHit hit = shoot(accel, org, dir);
        if (!hit.hit) continue;
        SurfacePoint s = accel.surface_point(hit.instance, hit.primitive, hit.u, hit.v);
        dvec3 w = random.direction();
        if (dot(w, dvec3(s.Ng)) < 0) w = -w;
        if (dot(w, dvec3(s.Ng)) < 0.01) continue;  // neither out nor in
        ++result.hits;
        vec3 out(w), in(-w);
        result.outward_again += shoot(accel, offset_ray_origin(s.p, s.p_error, s.Ng, out), out).hit;
        result.inward_missed += !shoot(accel, offset_ray_origin(s.p, s.p_error, s.Ng, in), in).hit;
    }
    return result;
}

struct Case {
    double radius, distance;
};
constexpr Case kCases[] = {{1, 0}, {1, 100}, {1, 1e4}, {1e-6, 0}, {1e6, 0}};

TEST(SurfacePoint, RaysThatLeaveASphereNeverMeetItAgain) {
    for (Case c : kCases) {
        dvec3 center(c.distance);
        TestMesh ball = sphere(c.radius, center);
        for (bool robust : {true, false}) {
            Accel accel({.robust = robust});
            Geometry row = ball.geometry(1);
            accel.update(std::span(&row, 1));
            Leaving l = leave(accel, c.radius, center, 20000);
            EXPECT_GT(l.hits, 9000) << c.radius << " at " << c.distance;
            EXPECT_EQ(l.outward_again, 0) << c.radius << " at " << c.distance;
            // Far rays may slip between triangles where traversal is not watertight.
            EXPECT_LE(l.inward_missed, robust ? 0 : 20) << c.radius << " at " << c.distance;
        }
    }
}

// Coordinates of exactly 0 have no rounding error, so nothing to be offset by.
TEST(SurfacePoint, RaysThatLeaveAPlaneThroughTheOriginNeverMeetItAgain) {
    TestMesh plane;
    plane.positions = {vec4(-2, -2, 0, 0), vec4(2, -2, 0, 0), vec4(0, 3, 0, 0)};
    plane.triangles = {0, 1, 2};
    for (GeometryKind kind : {GeometryKind::Static, GeometryKind::Instanced})
        for (int axis = 0; axis < 3; ++axis) {
            Geometry row = plane.geometry(1, kind);
            for (vec4& p : plane.positions) p = vec4(p.z, p.x, p.y, 0);  // turn to the next axis
            Accel accel;
            accel.update(std::span(&row, 1));
            Leaving l = leave(accel, 1, dvec3(0.0), 3000);
            EXPECT_GT(l.hits, 500);
            EXPECT_EQ(l.outward_again, 0);
            EXPECT_EQ(l.inward_missed, l.hits);  // behind it there is nothing either
        }
}

dmat4 turned(double angle, double scale, dvec3 to) {
    const double c = std::cos(angle), s = std::sin(angle);
    dmat4 x(dvec4(1, 0, 0, 0), dvec4(0, c, s, 0), dvec4(0, -s, c, 0), dvec4(0, 0, 0, 1));
    dmat4 z(dvec4(c, s, 0, 0), dvec4(-s, c, 0, 0), dvec4(0, 0, 1, 0), dvec4(0, 0, 0, 1));
    dmat4 m = z * x;
    for (int k = 0; k < 3; ++k) m[k] *= scale;
    m[3] = dvec4(to, 1);
    return m;
}

TEST(SurfacePoint, RaysThatLeaveAnInstanceNeverMeetItAgain) {
    for (Case c : kCases) {
        for (double local : {1.0, 1e-3, 50.0}) {
            TestMesh ball = sphere(local, dvec3(0.3 * local));
            dvec3 center(c.distance);
            Geometry row = ball.geometry(1, GeometryKind::Instanced);
            row.accel_from_local = turned(0.9, c.radius / local, center);
            dvec3 middle(row.accel_from_local * dvec4(dvec3(0.3 * local), 1));
            Accel accel;
            accel.update(std::span(&row, 1));
            Leaving l = leave(accel, c.radius, middle, 5000);
            EXPECT_GT(l.hits, 2000) << c.radius << " at " << c.distance;
            EXPECT_EQ(l.outward_again, 0) << c.radius << " at " << c.distance << " of " << local;
            EXPECT_EQ(l.inward_missed, 0) << c.radius << " at " << c.distance << " of " << local;
        }
    }
}

TEST(SurfacePoint, TheExactPointLiesWithinTheErrorBound) {
    TestMesh m = soup(200, 30, 3, 5);
    std::vector<Geometry> rows{m.geometry(0), m.geometry(1, GeometryKind::Instanced)};
    rows[1].accel_from_local = turned(1.1, 0.7, {100, -40, 3});
    Accel accel;
    accel.update(rows);
    RandomRays random(9);
    std::uniform_real_distribution<float> uniform(0, 1);
    for (int i = 0; i < 5000; ++i) {
        const uint32_t row = uint32_t(i) % 2, triangle = random.random() % 200u;
        float u = uniform(random.random), v = uniform(random.random);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        SurfacePoint s = accel.surface_point(row, triangle, u, v);
        const double b[3] = {1 - double(u) - double(v), double(u), double(v)};
        dvec4 exact(0.0, 0.0, 0.0, 1.0);
        for (int k = 0; k < 3; ++k)
            for (int c = 0; c < 3; ++c)
                exact[c] += b[k] * double(m.positions[3 * triangle + uint32_t(k)][c]);
        if (row == 1) exact = rows[1].accel_from_local * exact;
        for (int c = 0; c < 3; ++c) {
            EXPECT_LE(std::abs(double(s.p[c]) - exact[c]), double(s.p_error[c]));
            EXPECT_LT(s.p_error[c], 1e-3f);  // a bound that says nothing would pass as well
        }
    }
}

TEST(SurfacePoint, NormalsOfTinyAndHugeTrianglesHaveLengthOne) {
    for (float size : {1e-30f, 1e-12f, 1.0f, 1e12f, 1e18f}) {
        TestMesh m;
        m.positions = {vec4(0), vec4(size, 0, 0, 0), vec4(0, size, 0, 0)};
        m.triangles = {0, 1, 2, 0, 0, 1};
        Geometry row = m.geometry(1);
        Accel accel;
        accel.update(std::span(&row, 1));
        SurfacePoint s = accel.surface_point(0, 0, 0.2f, 0.2f);
        EXPECT_FLOAT_EQ(s.Ng.z, 1) << size;
        EXPECT_EQ(accel.surface_point(0, 1, 0.2f, 0.2f).Ng, vec3(0.0f));
    }
}

TEST(SurfacePoint, ManyAtOnceEqualOneAtATime) {
    TestMesh m = soup(50, 3, 1, 2);
    std::vector<Geometry> rows{m.geometry(0), m.geometry(1, GeometryKind::Instanced),
                               m.geometry(2, GeometryKind::Deforming)};
    rows[1].accel_from_local = turned(0.4, 2, {1, 2, 3});
    rows[2].mirrored = true;
    Accel accel;
    accel.update(rows);
    constexpr size_t n = 77;
    std::vector<uint32_t> instance(n), primitive(n);
    std::vector<float> u(n), v(n), out(9 * n);
    for (size_t i = 0; i < n; ++i) {
        instance[i] = uint32_t(i * 7 % 3), primitive[i] = uint32_t(i * 13 % 50);
        u[i] = float(i % 10) / 20, v[i] = float(i % 7) / 20;
    }
    float* o = out.data();
    accel.surface_points(n, instance.data(), primitive.data(), u.data(), v.data(),
                         {{o, o + n, o + 2 * n},
                          {o + 3 * n, o + 4 * n, o + 5 * n},
                          {o + 6 * n, o + 7 * n, o + 8 * n}});
    for (size_t i = 0; i < n; ++i) {
        SurfacePoint s = accel.surface_point(instance[i], primitive[i], u[i], v[i]);
        for (size_t c = 0; c < 3; ++c) {
            EXPECT_EQ(s.p[int(c)], out[c * n + i]);
            EXPECT_EQ(s.p_error[int(c)], out[(3 + c) * n + i]);
            EXPECT_EQ(s.Ng[int(c)], out[(6 + c) * n + i]);
        }
    }
}

// The kernels' origins are those of offset_ray_origin(), bit for bit, also with parts of +-0.
TEST(SurfacePoint, SixteenRaysLeaveAsEachAlone) {
    RandomRays random(43);
    auto any = [&] { return vec3(random.direction()); };
    auto is_same = [](float a, float b) { return std::memcmp(&a, &b, 4) == 0; };
    for (int round = 0; round < 200; ++round) {
        LeavingRays from{};
        for (size_t i = 0; i < kPoints; ++i) {
            const vec3 rows[] = {any(),        glm::abs(any()) * 1e-6f, any(),
                                 3.0f * any(), 0.01f * any(),           any()};
            for (int c = 0; c < 3; ++c) {
                from.P[c][i] = i == 3 ? 0 : rows[0][c];
                from.error[c][i] = i == 4 ? 0 : rows[1][c];
                from.Ng[c][i] = i == 5 ? 0 : i == 6 ? float(c == 1) : rows[2][c];
                from.way[c][i] = rows[3][c];
                from.up[c][i] = i % 2 ? rows[4][c] : 0;
                from.short_of[c][i] = i % 3 ? rows[5][c] : -0.0f;
            }
            from.endless[i] = i % 4 == 0;
        }
        for (size_t k = 0; k < usable_point_kernels().count; ++k) {
            float org[3][kPoints], dir[3][kPoints], tfar[kPoints];
            float* const to_org[] = {org[0], org[1], org[2]};
            float* const to_dir[] = {dir[0], dir[1], dir[2]};
            usable_point_kernels().kernels[k]->leave(from, to_org, to_dir, tfar);
            for (size_t i = 0; i < kPoints; ++i) {
                auto at = [&](const float(&rows)[3][kPoints]) {
                    return vec3(rows[0][i], rows[1][i], rows[2][i]);
                };
                const vec3 P = at(from.P), way = at(from.way), up = at(from.up);
                const vec3 n = at(from.Ng) == vec3(0) ? glm::normalize(way) : at(from.Ng);
                const vec3 begin = i % 2 ? offset_ray_origin(P + up, at(from.error), n, up)
                                         : offset_ray_origin(P, at(from.error), n, way);
                const vec3 along = i % 4 == 0 ? way : P + way - begin + at(from.short_of);
                for (int c = 0; c < 3; ++c) {
                    EXPECT_TRUE(is_same(org[c][i], begin[c])) << i;
                    EXPECT_TRUE(is_same(dir[c][i], along[c])) << i;
                }
                EXPECT_EQ(std::isinf(tfar[i]), i % 4 == 0);
            }
        }
    }
}

}  // namespace
}  // namespace kinora::raytrace::test
