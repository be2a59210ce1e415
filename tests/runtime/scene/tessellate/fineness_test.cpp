// tests/runtime/scene/tessellate/fineness_test.cpp: outlines in pixels, and what they cost.
#include <set>

#include "tests/runtime/scene/tessellate/surfaces.h"

namespace kinora {
namespace {

// How far, in pixels, triangles seen along z lie inside a circle's outline: by directions.
double inside_outline(const Tessellation& t, double radius, double pixels_a_unit) {
    constexpr int kDirections = 113;
    double most = 0;
    for (int k = 0; k < kDirections; ++k) {
        double a = 2 * kPi * k / kDirections, reach = 0;
        dvec2 d(std::cos(a), std::sin(a));
        for (size_t c = 0; c < t.group.triangles.size(); ++c) {
            dvec3 p = t.positions[t.group.triangles[c]];
            dvec3 q = t.positions[t.group.triangles[c - c % 3 + (c + 1) % 3]];
            // Where the edge crosses the direction.
            double s0 = d.x * p.y - d.y * p.x, s1 = d.x * q.y - d.y * q.x;
            if ((s0 > 0) == (s1 > 0)) continue;
            double f = s0 / (s0 - s1);
            dvec3 m = (1 - f) * p + f * q;
            reach = std::max(reach, d.x * m.x + d.y * m.y);
        }
        most = std::max(most, (radius - reach) * pixels_a_unit);
    }
    return most;
}

TEST(Fineness, OutlinesAreWithinHalfAPixel) {
    CurvedSurface lying = quadric(CurvedKind::Torus, {2, 1, 0, 360, 360});
    const std::pair<CurvedSurface, double> cases[] = {
        {quadric(CurvedKind::Sphere, {3, -3, 3, 360}), 3},
        {lying, 3},
        {between_circles(3, 0, 3, 1), 3},
        {quadric(CurvedKind::Disk, {0, 3, 360}), 3}};
    for (double pixels : {4.0, 20.0, 100.0, 640.0, 2000.0})
        for (const auto& [surface, radius] : cases) {
            PictureScale scale = seen(3, pixels);
            Tessellation t = tessellate(surface, scale);
            EXPECT_LT(inside_outline(t, radius, scale.pixels), 0.5) << pixels;
            EXPECT_LE(t.error, 0.2501) << pixels;
        }
}

TEST(Fineness, PerspectiveMeasuresAtTheSurface) {
    CurvedSurface s = quadric(CurvedKind::Sphere, {1, -1, 1, 360});
    PictureScale scale;
    scale.pixels = 500;
    double before = 1e9;
    for (double distance : {1.5, 4.0, 20.0, 100.0, 2000.0}) {
        scale.to_camera[3] = {0, 0, distance, 1};
        Tessellation t = tessellate(s, scale);
        double pixels = scale.pixels / std::sqrt(distance * distance - 1);
        EXPECT_LT(inside_outline(t, 1, pixels), 0.5) << distance;
        EXPECT_LT(triangle_count(t), before);
        before = double(triangle_count(t));
    }
}

TEST(Fineness, CountsFallWithSizeAndTinyBodiesStayBodies) {
    CurvedSurface s = quadric(CurvedKind::Sphere, {1, -1, 1, 360});
    size_t before = ~size_t(0);
    for (double pixels : {3000.0, 300.0, 30.0, 3.0, 0.3}) {
        Tessellation t = tessellate(s, seen(1, pixels));
        EXPECT_LT(triangle_count(t), before);
        before = triangle_count(t) + 1;
    }
    EXPECT_GE(before, 8u);
    EXPECT_LE(before, 40u);
}

TEST(Fineness, FlatSurfacesAreFewTriangles) {
    CurvedSurface s;
    s.kind = CurvedKind::Bilinear;
    s.u.points = s.v.points = 2;
    s.points = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}, {1, 1, 0, 1}};
    EXPECT_EQ(triangle_count(tessellate(s, seen(1, 5000))), 2u);
}

TEST(Fineness, LimitsHoldHoweverCloseTheEyeIs) {
    TessellationLimits limits;
    for (size_t most : {2u, 10u, 100u, 5000u, 100000u}) {
        limits.triangles = most;
        for (double radius : {1.0, 1e3, 1e9}) {
            PictureScale scale;
            scale.pixels = 1e5;
            Tessellation t = tessellate(quadric(CurvedKind::Sphere, {radius, -radius, radius, 360}),
                                        scale, limits);
            EXPECT_LE(triangle_count(t), most);
        }
    }
    CurvedSurface mesh;
    mesh.kind = CurvedKind::Bilinear;
    mesh.u.points = mesh.v.points = 30;
    for (int k = 0; k < 900; ++k) mesh.points.push_back({k % 30, k / 30, std::sin(k), 1});
    for (size_t most : {2u, 10u, 100u, 1000u}) {
        limits.triangles = most;
        EXPECT_LE(triangle_count(tessellate(mesh, seen(20, 500), limits)), most);
    }
}

TEST(Fineness, ASkyAroundTheEyeIsNoExplosion) {
    PictureScale scale;
    scale.pixels = 1000;
    Tessellation t = tessellate(quadric(CurvedKind::Sphere, {1e4, -1e4, 1e4, 360}), scale);
    EXPECT_LT(triangle_count(t), 500000u);
    EXPECT_LE(t.error, 0.26);
}

TEST(Fineness, WithoutAPictureASurfaceIsAsIfAThousandPixelsWide) {
    CurvedSurface s = quadric(CurvedKind::Sphere, {7, -7, 7, 360});
    EXPECT_EQ(triangle_count(tessellate(s, {})), triangle_count(tessellate(s, seen(7, 1000))));
}

// What a steady scale makes is as fine as the picture asks, and the same at places near each other.
TEST(Fineness, SteadyScalesAreFineEnough) {
    const CurvedSurface ball = quadric(CurvedKind::Sphere, {1, -1, 1, 360});
    PictureScale view;
    view.pixels = 500;
    std::set<double> scales;
    for (double z = 4; z < 40; z *= 1.05) {
        view.to_camera[3] = dvec4(0.1 * z, 0, z, 1);
        const auto steady = steady_scale(view, dvec3(0.0), 1);
        ASSERT_TRUE(steady) << z;
        scales.insert(steady->pixels);
        // A unit of the front, as the pinhole has it.
        EXPECT_GE(steady->pixels, view.pixels / (z - 1)) << z;
        EXPECT_LE(steady->pixels, 3.5 * view.pixels / (z - 1)) << z;
        EXPECT_LT(inside_outline(tessellate(ball, *steady), 1, view.pixels / (z - 1)), 0.5) << z;
    }
    EXPECT_LE(scales.size(), 10u);  // 20 fold, by half octaves
    EXPECT_GE(scales.size(), 6u);
}

TEST(Fineness, WhatHasManySizesHasNoSteadyScale) {
    PictureScale view;
    view.pixels = 500;
    EXPECT_FALSE(steady_scale(view, dvec3(0, 0, 2), 1));  // its front is twice as large as its back
    EXPECT_FALSE(steady_scale(view, dvec3(0, 0, -9), 1));  // behind
    EXPECT_FALSE(steady_scale(view, dvec3(50, 0, 9), 1));  // far aside
    view.to_camera[0] = dvec4(2, 0, 0, 0);
    EXPECT_FALSE(steady_scale(view, dvec3(0, 0, 9), 1));  // stretched
    view.orthographic = true, view.to_camera = dmat4(1.0);
    EXPECT_TRUE(steady_scale(view, dvec3(0, 0, 2), 1));
    EXPECT_FALSE(steady_scale(PictureScale{}, dvec3(0, 0, 9), 1));  // no picture
}

}  // namespace
}  // namespace kinora
