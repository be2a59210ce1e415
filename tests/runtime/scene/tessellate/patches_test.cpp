// tests/runtime/scene/tessellate/patches_test.cpp: meshes of patches against polynomials.
#include <random>

#include "tests/runtime/scene/tessellate/surfaces.h"

namespace kinora {
namespace {

std::vector<dvec4> random_points(size_t count, int seed) {
    std::mt19937 random{unsigned(seed)};
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<dvec4> points;
    for (size_t k = 0; k < count; ++k)
        points.push_back({uniform(random), uniform(random), uniform(random), 1});
    return points;
}

CurvedSurface mesh(PatchDirection u, PatchDirection v, int seed) {
    CurvedSurface s;
    s.kind = CurvedKind::Bicubic;
    s.u = u;
    s.v = v;
    s.points = random_points(size_t(u.points) * v.points, seed);
    return s;
}

// Rows of different heights over a grid: a mesh without folds.
CurvedSurface heights(PatchDirection u, PatchDirection v, double height) {
    CurvedSurface s = mesh(u, v, 5);
    for (size_t k = 0; k < s.points.size(); ++k)
        s.points[k] = {double(k % u.points), double(k / u.points), height * s.points[k].z, 1};
    return s;
}

dvec4 casteljau(std::vector<dvec4> p, double t) {
    for (size_t n = p.size(); n > 1; --n)
        for (size_t k = 0; k + 1 < n; ++k) p[k] = (1 - t) * p[k] + t * p[k + 1];
    return p[0];
}

void expect_near(dvec3 a, dvec3 b, double within) {
    EXPECT_NEAR(a.x, b.x, within);
    EXPECT_NEAR(a.y, b.y, within);
    EXPECT_NEAR(a.z, b.z, within);
}

// A cubic through weights written by hand.
using Blend = std::array<double, 4> (*)(double);
std::array<double, 4> bspline(double t) {
    double s = 1 - t;
    return {s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (3 * s * s * s - 6 * s * s + 4) / 6,
            t * t * t / 6};
}
std::array<double, 4> catmull(double t) {
    // A Hermite curve whose tangents are half the neighbours' difference.
    double a = (1 + 2 * t) * (1 - t) * (1 - t), b = t * t * (3 - 2 * t);
    double c = t * (1 - t) * (1 - t), d = t * t * (t - 1);
    return {-c / 2, a - d / 2, b + c / 2, d / 2};
}
std::array<double, 4> hermite(double t) {
    return {(1 + 2 * t) * (1 - t) * (1 - t), t * (1 - t) * (1 - t), t * t * (3 - 2 * t),
            t * t * (t - 1)};
}
std::array<double, 4> power(double t) {
    return {t * t * t, t * t, t, 1};
}

dvec3 blended(const CurvedSurface& s, Blend f, Blend g, double u, double v) {
    auto patch = [](const PatchDirection& d, double at) {
        double n = d.periodic ? d.points / d.step : (d.points - 4) / d.step + 1;
        double k = std::min(std::floor(at * n), n - 1);
        return std::pair(uint32_t(k), at * n - k);
    };
    auto [i, a] = patch(s.u, u);
    auto [j, b] = patch(s.v, v);
    dvec3 sum(0.0);
    for (uint32_t r = 0; r < 4; ++r)
        for (uint32_t c = 0; c < 4; ++c) {
            size_t row = (j * s.v.step + r) % s.v.points, column = (i * s.u.step + c) % s.u.points;
            sum += g(b)[r] * f(a)[c] * dvec3(s.points[row * s.u.points + column]);
        }
    return sum;
}

TEST(Patches, BezierIsDeCasteljau) {
    CurvedSurface s = mesh(cubic(4, kBezier, 3), cubic(4, kBezier, 3), 1);
    for (double u : {0.0, 0.2, 0.71, 1.0})
        for (double v : {0.0, 0.33, 0.9, 1.0}) {
            std::vector<dvec4> column;
            for (int r = 0; r < 4; ++r)
                column.push_back(
                    casteljau({s.points.begin() + 4 * r, s.points.begin() + 4 * r + 4}, u));
            expect_near(evaluate(s, u, v).p, dvec3(casteljau(column, v)), 1e-14);
        }
}

TEST(Patches, EachBasisIsItsPolynomialsOverTheWholeMesh) {
    struct Case {
        BasisRows rows;
        uint32_t step;
        Blend blend;
    };
    for (const Case& c : {Case{kBspline, 1, bspline}, Case{kCatmullRom, 1, catmull},
                          Case{kHermite, 2, hermite}, Case{kPower, 4, power}}) {
        CurvedSurface s = mesh(cubic(8, c.rows, c.step), cubic(4 + 2 * c.step, c.rows, c.step), 2);
        for (int i = 0; i <= 10; ++i)
            for (int j = 0; j <= 7; ++j) {
                double u = i / 10.0, v = j / 7.0;
                expect_near(evaluate(s, u, v).p, blended(s, c.blend, c.blend, u, v), 1e-13);
            }
    }
}

TEST(Patches, PeriodicMeshesClose) {
    CurvedSurface s = mesh(cubic(6, kBspline, 1, true), cubic(6, kCatmullRom, 1, true), 3);
    for (int i = 0; i <= 12; ++i)
        for (int j = 0; j <= 12; ++j)
            expect_near(evaluate(s, i / 12.0, j / 12.0).p,
                        blended(s, bspline, catmull, i / 12.0, j / 12.0), 1e-13);
    expect_near(evaluate(s, 0, 0.3).p, evaluate(s, 1, 0.3).p, 1e-14);
    Tessellation t = tessellate(s, seen(1, 200));
    expect_sound(t);
    EdgeCount edges = count_edges(t);
    EXPECT_EQ(edges.rim, 0u);
    EXPECT_EQ(edges.more, 0u);
    EXPECT_EQ(long(t.positions.size()) - long(edges.inner) + long(triangle_count(t)), 0);
}

TEST(Patches, DerivativesAreCentralDifferences) {
    const double h = 1e-5;
    for (bool rational : {false, true}) {
        CurvedSurface s = mesh(cubic(7, kBezier, 3), cubic(6, kBspline, 1), 4);
        s.rational = rational;
        for (size_t k = 0; k < s.points.size(); ++k) s.points[k].w = 1 + 0.5 * std::sin(double(k));
        for (double u : {0.1, 0.3, 0.77})
            for (double v : {0.1, 0.45, 0.9}) {
                SurfacePoint at = evaluate(s, u, v);
                dvec3 du = (evaluate(s, u + h, v).p - evaluate(s, u - h, v).p) / (2 * h);
                dvec3 dv = (evaluate(s, u, v + h).p - evaluate(s, u, v - h).p) / (2 * h);
                expect_near(at.du, du, 1e-6);
                expect_near(at.dv, dv, 1e-6);
                expect_near(at.normal, glm::normalize(glm::cross(du, dv)), 1e-6);
            }
    }
}

TEST(Patches, RationalPatchesAreDividedAfterTheyAreBlended) {
    CurvedSurface s = mesh(cubic(4, kBezier, 3), cubic(4, kBezier, 3), 6);
    s.rational = true;
    for (size_t k = 0; k < 16; ++k) s.points[k].w = 1 + double(k % 3);
    std::vector<dvec4> column;
    for (int r = 0; r < 4; ++r)
        column.push_back(casteljau({s.points.begin() + 4 * r, s.points.begin() + 4 * r + 4}, 0.4));
    dvec4 p = casteljau(column, 0.7);
    expect_near(evaluate(s, 0.4, 0.7).p, dvec3(p) / p.w, 1e-14);
}

TEST(Patches, BilinearMeshesPassThroughTheirPoints) {
    CurvedSurface s;
    s.kind = CurvedKind::Bilinear;
    s.u.points = 3;
    s.v.points = 4;
    s.points = random_points(12, 7);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j)
            expect_near(evaluate(s, i / 2.0, j / 3.0).p, dvec3(s.points[size_t(j * 3 + i)]), 1e-14);
    s.u.periodic = true;
    expect_near(evaluate(s, 1, 0).p, dvec3(s.points[0]), 1e-14);
}

TEST(Patches, NeighboursShareTheirEdges) {
    for (const CurvedSurface& s : {heights(cubic(13, kBezier, 3), cubic(10, kBezier, 3), 3),
                                   heights(cubic(9, kBspline, 1), cubic(8, kCatmullRom, 1), 2)}) {
        Tessellation t = tessellate(s, seen(6, 600));
        expect_sound(t);
        EdgeCount edges = count_edges(t);
        EXPECT_EQ(edges.more, 0u);
        EXPECT_EQ(edges.alike, 0u);
        EXPECT_EQ(
            long(t.positions.size()) - long(edges.inner + edges.rim) + long(triangle_count(t)), 1);
        EXPECT_LE(t.error, 0.26);
    }
}

TEST(Patches, SmoothMeshesShareNormalsAndCreasesDoNot) {
    Tessellation smooth =
        tessellate(heights(cubic(9, kBspline, 1), cubic(9, kBspline, 1), 2), seen(6, 300));
    EXPECT_EQ(attribute(smooth, "NORMAL")->values.size(), 3 * smooth.positions.size());
    CurvedSurface roof;
    roof.kind = CurvedKind::Bilinear;
    roof.u.points = 3;
    roof.v.points = 2;
    roof.points = {{0, 0, 0, 1}, {1, 0, 1, 1}, {2, 0, 0, 1},
                   {0, 1, 0, 1}, {1, 1, 1, 1}, {2, 1, 0, 1}};
    Tessellation t = tessellate(roof, seen(2, 100));
    EXPECT_EQ(t.positions.size(), 6u);
    EXPECT_EQ(attribute(t, "NORMAL")->values.size(), 3 * 8u);
    EXPECT_EQ(attribute(t, kSurfaceParameters)->values.size(), 2 * 6u);
}

TEST(Patches, CollapsedEdgesArePointsWithNormals) {
    CurvedSurface s = heights(cubic(4, kBezier, 3), cubic(4, kBezier, 3), 0.5);
    for (int k = 0; k < 4; ++k) s.points[size_t(k)] = {1.5, -1, 0.2, 1};
    Tessellation t = tessellate(s, seen(3, 300));
    expect_sound(t);
    EXPECT_EQ(count_edges(t).more, 0u);
    EXPECT_GT(least_agreement(t), 0.9);
    dvec3 at = evaluate(s, 0.5, 0).normal, near = evaluate(s, 0.5, 1e-6).normal;
    expect_near(at, near, 1e-5);
}

TEST(Patches, VariablesFollowTheirRates) {
    CurvedSurface s = heights(cubic(7, kBezier, 3), cubic(4, kBezier, 3), 1);
    auto add = [&](const char* name, VariableRate rate, size_t count) {
        SurfaceVariable v{name, rate, 1, {}};
        for (size_t k = 0; k < count; ++k) v.values.push_back(float(k));
        s.variables.push_back(v);
    };
    add("one", VariableRate::Constant, 1);
    add("patch", VariableRate::Uniform, 2);
    add("corner", VariableRate::Varying, 6);
    add("point", VariableRate::Vertex, 28);
    add("few", VariableRate::Vertex, 27);
    Tessellation t = tessellate(s, seen(4, 300));
    expect_sound(t);
    EXPECT_EQ(attribute(t, "few"), nullptr);
    EXPECT_EQ(attribute(t, "one")->values.size(), 1u);
    EXPECT_EQ(attribute(t, "patch")->values.size(), 2u);
    auto value = [&](const char* name, size_t corner) {
        const VertexAttribute& a = *attribute(t, name);
        return double(a.values[a.corners[corner]]);
    };
    CurvedSurface index = s;  // the same blend, of the points' numbers
    for (size_t k = 0; k < 28; ++k) index.points[k] = {double(k), 0, 0, 1};
    const VertexAttribute& uv = *attribute(t, kSurfaceParameters);
    for (size_t k = 0; k < t.group.triangles.size(); ++k) {
        double u = uv.values[2 * uv.corners[k]], v = uv.values[2 * uv.corners[k] + 1];
        double middle = uv.values[2 * uv.corners[k - k % 3]] +
                        uv.values[2 * uv.corners[k - k % 3 + 1]] +
                        uv.values[2 * uv.corners[k - k % 3 + 2]];
        EXPECT_EQ(value("patch", k), middle / 3 > 0.5 ? 1 : 0);
        EXPECT_NEAR(value("corner", k), 2 * u + 3 * v, 1e-5);
        EXPECT_NEAR(value("point", k), evaluate(index, u, v).p.x, 1e-4);
    }
}

TEST(Patches, TextureCoordinatesAndNormalsCanBeGiven) {
    CurvedSurface s = heights(cubic(4, kBezier, 3), cubic(4, kBezier, 3), 1);
    s.variables.push_back({"s", VariableRate::Varying, 1, {5, 6, 5, 6}});
    s.variables.push_back({"N", VariableRate::Varying, 3, {0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2}});
    s.reversed = true;
    Tessellation t = tessellate(s, seen(4, 100));
    const VertexAttribute &st = *attribute(t, "TEXCOORD"), &uv = *attribute(t, kSurfaceParameters);
    for (size_t k = 0; k < t.group.triangles.size(); ++k) {
        EXPECT_EQ(normal_at(t, k), dvec3(0, 0, 1));
        EXPECT_NEAR(st.values[2 * st.corners[k]], 5 + uv.values[2 * uv.corners[k]], 1e-5);
        EXPECT_NEAR(st.values[2 * st.corners[k] + 1], uv.values[2 * uv.corners[k] + 1], 1e-6);
    }
    EXPECT_EQ(attribute(t, "s"), nullptr);
    EXPECT_EQ(attribute(t, "N"), nullptr);
}

}  // namespace
}  // namespace kinora
