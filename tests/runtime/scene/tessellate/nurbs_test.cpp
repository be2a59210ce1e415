// tests/runtime/scene/tessellate/nurbs_test.cpp: NURBS against Cox and de Boor, circles, trims.
#include <random>

#include "tests/runtime/scene/tessellate/surfaces.h"

namespace kinora {
namespace {

// B-spline i of an order, by the recursion itself.
long double cox_de_boor(const std::vector<double>& knots, size_t i, uint32_t order, double x) {
    if (order == 1) return knots[i] <= x && x < knots[i + 1];
    auto part = [&](double over, double under, size_t k) {
        return under > 0 ? over / under * cox_de_boor(knots, k, order - 1, x) : 0;
    };
    return part(x - knots[i], knots[i + order - 1] - knots[i], i) +
           part(knots[i + order] - x, knots[i + order] - knots[i + 1], i + 1);
}

CurvedSurface random_nurbs(PatchDirection u, PatchDirection v, int seed, bool rational) {
    CurvedSurface s;
    s.kind = CurvedKind::Nurbs;
    s.u = u;
    s.v = v;
    s.rational = rational;
    std::mt19937 random{unsigned(seed)};
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (uint32_t k = 0; k < u.points * v.points; ++k) {
        double w = rational ? 1.5 + uniform(random) : 1;
        s.points.push_back(w * dvec4(uniform(random), uniform(random), uniform(random), 1));
    }
    return s;
}

dvec3 by_recursion(const CurvedSurface& s, double u, double v) {
    dvec4 sum(0.0);
    for (uint32_t j = 0; j < s.v.points; ++j)
        for (uint32_t i = 0; i < s.u.points; ++i)
            sum += double(cox_de_boor(s.u.knots, i, s.u.order, u) *
                          cox_de_boor(s.v.knots, j, s.v.order, v)) *
                   s.points[j * s.u.points + i];
    return s.rational ? dvec3(sum) / sum.w : dvec3(sum);
}

CurvedSurface plane() {
    CurvedSurface s;
    s.kind = CurvedKind::Nurbs;
    s.u = s.v = line_spline();
    s.points = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}, {1, 1, 0, 1}};
    return s;
}

TrimLoop circle(dvec2 centre, double radius, int n = 400) {
    TrimLoop loop;
    for (int k = 0; k < n; ++k) {
        double a = 2 * kPi * (k + 0.3) / n;
        loop.push_back(centre + radius * dvec2(std::cos(a), std::sin(a)));
    }
    return loop;
}

TrimLoop square(double low, double high) {
    return {{low, low}, {high, low}, {high, high}, {low, high}};
}

TEST(Nurbs, PlacesAreThoseOfTheRecursion) {
    const PatchDirection directions[] = {
        spline(2, {0, 0, 1, 2.5, 2.5, 4}, 0, 2.5),
        spline(3, {0, 0, 0, 1, 1, 2, 2, 2}, 0, 2),
        spline(4, {-3, -2, -1, 0, 1, 2, 3, 4, 5}, 0, 2),
        spline(4, {0, 0, 0, 0, .2, .2, .7, 1, 1, 1, 1}, 0.1, 0.9),
        spline(6, {0, 0, 1, 1, 2, 3, 4, 4, 5, 6, 7, 8, 9}, 3, 4),
    };
    int seed = 0;
    for (const PatchDirection& u : directions)
        for (const PatchDirection& v : directions) {
            CurvedSurface s = random_nurbs(u, v, seed, seed % 2);
            ++seed;
            for (int i = 0; i < 9; ++i)
                for (int j = 0; j < 9; ++j) {
                    double a = u.low + (u.high - u.low) * i / 9;
                    double b = v.low + (v.high - v.low) * j / 9;
                    dvec3 p = evaluate(s, a, b).p, q = by_recursion(s, a, b);
                    EXPECT_NEAR(glm::length(p - q), 0, 1e-12) << i << " " << j;
                }
        }
}

TEST(Nurbs, DerivativesAreCentralDifferences) {
    const double h = 1e-5;
    CurvedSurface s = random_nurbs(spline(4, {0, 0, 0, 0, 1, 2, 3, 3, 3, 3}, 0, 3),
                                   spline(3, {0, 0, 0, 2, 5, 5, 5}, 0, 5), 9, true);
    for (double u : {0.2, 0.7, 1.5, 2.6})
        for (double v : {0.5, 1.7, 3.3, 4.8}) {
            SurfacePoint at = evaluate(s, u, v);
            dvec3 du = (evaluate(s, u + h, v).p - evaluate(s, u - h, v).p) / (2 * h);
            dvec3 dv = (evaluate(s, u, v + h).p - evaluate(s, u, v - h).p) / (2 * h);
            EXPECT_NEAR(glm::length(at.du - du), 0, 1e-7 * (1 + glm::length(du)));
            EXPECT_NEAR(glm::length(at.dv - dv), 0, 1e-7 * (1 + glm::length(dv)));
        }
}

TEST(Nurbs, ARationalQuadraticIsACircle) {
    CurvedSurface s = between_circles(2, 0, 2, 1);
    for (int k = 0; k <= 1000; ++k) {
        dvec3 p = evaluate(s, k / 1000.0, 0.5).p;
        EXPECT_NEAR(std::hypot(p.x, p.y), 2, 1e-12);
    }
    Tessellation t = tessellate(s, seen(2, 400));
    expect_sound(t);
    for (dvec3 p : t.positions) EXPECT_NEAR(std::hypot(p.x, p.y), 2, 1e-12);
    EdgeCount edges = count_edges(t);  // a tube: it closes
    EXPECT_EQ(long(t.positions.size()) - long(edges.rim + edges.inner) + long(triangle_count(t)),
              0);
    EXPECT_EQ(edges.more, 0u);
}

TEST(Nurbs, ATipHasTheLimitNormal) {
    CurvedSurface s = between_circles(1, 0, 0, 1);
    const double r = std::sqrt(0.5);
    for (double u : {0.1, 0.3, 0.6}) {
        dvec3 n = evaluate(s, u, 1).normal, below = evaluate(s, u, 0.5).normal;
        EXPECT_NEAR(n.z, r, 1e-6);
        EXPECT_NEAR(glm::dot(n, below), 1, 1e-6);
    }
    Tessellation t = tessellate(s, seen(1, 300));
    expect_sound(t);
    EXPECT_EQ(count_edges(t).rim + count_edges(t).more, count_edges(t).rim);
    EXPECT_GT(least_agreement(t), 0.9);
}

TEST(Nurbs, ParametersKeepTheirRange) {
    CurvedSurface s = random_nurbs(spline(3, {0, 0, 0, 1, 2, 3, 3, 3}, 0.5, 2.5),
                                   spline(2, {5, 5, 9, 9}, 5, 9), 3, false);
    Tessellation t = tessellate(s, seen(1, 200));
    const VertexAttribute &uv = *attribute(t, kSurfaceParameters), &st = *attribute(t, "TEXCOORD");
    for (size_t k = 0; k < uv.corners.size(); ++k) {
        const float* p = &uv.values[2 * uv.corners[k]];
        const float* q = &st.values[2 * st.corners[k]];
        EXPECT_NEAR(q[0], (p[0] - 0.5) / 2, 1e-6);
        EXPECT_NEAR(q[1], (p[1] - 5) / 4, 1e-6);
        EXPECT_NEAR(glm::length(evaluate(s, p[0], p[1]).p - t.positions[t.group.triangles[k]]), 0,
                    1e-5);
    }
}

TEST(Nurbs, VaryingValuesAreCountedByKnotIntervals) {
    // 1 + nu - uorder = 3 intervals, of which the middle one is empty.
    CurvedSurface s =
        random_nurbs(spline(3, {0, 0, 0, 1, 1, 2, 2, 2}, 0, 2), line_spline(), 4, false);
    s.variables.push_back({"a", VariableRate::Varying, 1, {0, 1, 2, 3, 0, 1, 2, 3}});
    s.variables.push_back({"b", VariableRate::Uniform, 1, {7, 8, 9}});
    Tessellation t = tessellate(s, seen(1, 300));
    const VertexAttribute &uv = *attribute(t, kSurfaceParameters), &a = *attribute(t, "a"),
                          &b = *attribute(t, "b");
    for (size_t k = 0; k < a.corners.size(); ++k) {
        double u = uv.values[2 * uv.corners[k]], value = a.values[a.corners[k]];
        double patch = b.values[b.corners[k]];
        EXPECT_TRUE(patch == 7 || patch == 9);
        EXPECT_NEAR(value, patch == 7 ? u : u + 1, 1e-5);
    }
}

TEST(Nurbs, AnOrderAboveTheCountIsLowered) {
    CurvedSurface s = random_nurbs(line_spline(), line_spline(), 5, false);
    s.u.order = 4;
    s.u.knots = {0, 0, 0, 1, 1, 1};
    CurvedSurface plain = s;
    plain.u = line_spline();
    EXPECT_NEAR(glm::length(evaluate(s, 0.3, 0.4).p - evaluate(plain, 0.3, 0.4).p), 0, 1e-15);
}

TEST(Trims, ASquareWithACircularHoleHasTheRestOfTheArea) {
    CurvedSurface s = plane();
    s.trims = {circle({0.5, 0.5}, 0.3)};
    s.trim_outside = true;
    const double disk = 400 / 2 * std::sin(2 * kPi / 400) * 0.09;
    Tessellation t = tessellate(s, seen(1, 500));
    expect_sound(t);
    EXPECT_NEAR(area(t), 1 - disk, 1e-12);
    EXPECT_GT(least_agreement(t), 0.999);
    s.trim_outside = false;
    EXPECT_NEAR(area(tessellate(s, seen(1, 500))), disk, 1e-12);
    s.trims.insert(s.trims.begin(), square(0, 1));  // along the borders
    EXPECT_NEAR(area(tessellate(s, seen(1, 500))), 1 - disk, 1e-12);
    s.trims[0] = square(-1, 2);
    EXPECT_NEAR(area(tessellate(s, seen(1, 500))), 1 - disk, 1e-12);
}

TEST(Trims, NestedAndCrossingLoopsAreEvenOdd) {
    CurvedSurface s = plane();
    s.trims = {square(0.1, 0.9), square(0.2, 0.8), square(0.3, 0.7)};
    EXPECT_NEAR(area(tessellate(s, {})), 0.64 - 0.36 + 0.16, 1e-12);
    s.trims = {square(0.1, 0.6), square(0.4, 0.9)};
    EXPECT_NEAR(area(tessellate(s, {})), 2 * (0.25 - 0.04), 1e-12);
    s.trims = {{{0.1, 0.1}, {0.9, 0.9}, {0.9, 0.1}, {0.1, 0.9}}};  // crosses itself
    EXPECT_NEAR(area(tessellate(s, {})), 0.32, 1e-12);
    s.trims = {{}, {{0.5, 0.5}}, {{0.1, 0.1}, {0.9, 0.9}}};
    EXPECT_EQ(triangle_count(tessellate(s, {})), 0u);
}

TEST(Trims, ManyCellsAreCutAsOneIs) {
    CurvedSurface s = plane();
    s.u = s.v = spline(2, {0, 0, .125, .25, .375, .5, .625, .75, .875, 1, 1}, 0, 1);
    s.points.clear();
    for (int k = 0; k < 81; ++k) s.points.push_back({k % 9 / 8.0, k / 9 / 8.0, 0, 1});
    const double disk = 400 / 2 * std::sin(2 * kPi / 400);
    s.trims = {square(0, 1), circle({0.5, 0.5}, 0.4), circle({0.5, 0.5}, 0.25),
               square(0.375, 0.625)};
    EXPECT_NEAR(area(tessellate(s, {})), 1 - disk * 0.16 + disk * 0.0625 - 0.0625, 1e-12);
}

TEST(Trims, CurvedSurfacesAreCutWithinThePixelError) {
    CurvedSurface s = between_circles(1, 0, 1, 2);
    s.trims = {circle({0.5, 0.5}, 0.2, 200)};
    Tessellation t = tessellate(s, seen(1, 600));
    expect_sound(t);
    EXPECT_GT(least_agreement(t), 0.95);
    const VertexAttribute& uv = *attribute(t, kSurfaceParameters);
    for (size_t k = 0; k < uv.corners.size(); ++k) {
        dvec2 p(uv.values[2 * uv.corners[k]], uv.values[2 * uv.corners[k] + 1]);
        EXPECT_LE(glm::length(p - dvec2(0.5)), 0.2 + 1e-6);
        EXPECT_LT(glm::length(evaluate(s, p.x, p.y).p - t.positions[t.group.triangles[k]]) * 300,
                  1);
    }
    // Half the circle's tube is there where the loop is half of the parameters.
    s.trims = {{{0, 0}, {0.5, 0}, {0.5, 1}, {0, 1}}};
    EXPECT_NEAR(area(tessellate(s, seen(1, 2000))), 2 * kPi, 0.01);
}

TEST(Trims, HostileLoopsEnd) {
    CurvedSurface s = between_circles(1, 0, 1, 2);
    std::mt19937 random{3};
    std::uniform_real_distribution<double> uniform(-0.5, 1.5);
    TrimLoop loop;
    for (int k = 0; k < 30000; ++k) loop.push_back({uniform(random), uniform(random)});
    loop.push_back({std::nan(""), 0});
    loop.push_back({1e300, -1e300});
    s.trims = {loop};
    TessellationLimits limits;
    limits.triangles = 100000;
    Tessellation t = tessellate(s, seen(1, 300), limits);
    expect_sound(t);
    EXPECT_LE(triangle_count(t), limits.triangles);
}

}  // namespace
}  // namespace kinora
