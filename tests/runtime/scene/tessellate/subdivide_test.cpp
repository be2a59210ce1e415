// tests/runtime/scene/tessellate/subdivide_test.cpp: Catmull-Clark against masks and B-splines.
#include "runtime/scene/tessellate/subdivide.h"

#include <random>

#include "tests/runtime/scene/tessellate/surfaces.h"

namespace kinora {
namespace {

SubdivisionSurface cube() {
    SubdivisionSurface s;
    for (int k = 0; k < 8; ++k)
        s.points.push_back({k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1});
    s.face_sizes.assign(6, 4);
    // Counter-clockwise from outside.
    s.indices = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
    return s;
}

// n x n points, u fastest, of heights that are no polynomial's.
SubdivisionSurface field(uint32_t n, double height) {
    SubdivisionSurface s;
    for (uint32_t k = 0; k < n * n; ++k)
        s.points.push_back({k % n, k / n, height * std::sin(2.0 * k + 0.3 * k * k)});
    for (uint32_t j = 0; j + 1 < n; ++j)
        for (uint32_t i = 0; i + 1 < n; ++i) {
            s.face_sizes.push_back(4);
            for (uint32_t k : {0u, 1u, n + 1, n}) s.indices.push_back(j * n + i + k);
        }
    return s;
}

// The same field, as bicubic B-splines: patch (i, j) is face (i + 1, j + 1).
CurvedSurface splines(const SubdivisionSurface& field, uint32_t n) {
    CurvedSurface s;
    s.kind = CurvedKind::Bicubic;
    s.u = s.v = cubic(n, kBspline, 1);
    for (dvec3 p : field.points) s.points.push_back(dvec4(p, 1));
    return s;
}

TessellationLimits within(double pixels) {
    TessellationLimits limits;
    limits.error = pixels;
    return limits;
}

long euler(const Tessellation& t) {
    EdgeCount edges = count_edges(t);
    return long(t.positions.size()) - long(edges.rim + edges.inner + edges.more) +
           long(triangle_count(t));
}

TEST(Subdivide, ACubesCornersEndHalfWay) {
    // (9 P + 4 sum of neighbours + sum of those across) / 24 = (9 + 4 - 1) / 24.
    for (double pixels : {1.0, 400.0}) {
        Tessellation t = subdivide(cube(), seen(1, pixels));
        expect_sound(t);
        int found = 0;
        for (size_t k = 0; k < t.group.triangles.size(); ++k) {
            dvec3 p = t.positions[t.group.triangles[k]];
            if (glm::length(glm::abs(p) - dvec3(0.5)) > 1e-12) continue;
            ++found;
            EXPECT_NEAR(glm::dot(normal_at(t, k), p) / std::sqrt(0.75), 1, 1e-6);
        }
        EXPECT_GE(found, 8);
        if (pixels == 1.0) {
            EXPECT_EQ(t.positions.size(), 8u);
        }
        EXPECT_EQ(euler(t), 2);
        EXPECT_EQ(count_edges(t).rim + count_edges(t).alike, 0u);
        EXPECT_GT(least_agreement(t), 0.5);
    }
}

TEST(Subdivide, ReversedTurnsFacesAndNormals) {
    SubdivisionSurface s = cube();
    s.reversed = true;
    Tessellation t = subdivide(s, seen(1, 100));
    EXPECT_GT(least_agreement(t), 0.8);
    for (size_t k = 0; k < t.group.triangles.size(); k += 3)
        EXPECT_LT(glm::dot(normal_at(t, k), triangle(t, k)[0]), 0);
}

TEST(Subdivide, RegularFacesAreBicubicSplines) {
    const uint32_t n = 7;
    SubdivisionSurface s = field(n, 1);
    SurfaceVariable height{"height", VariableRate::Vertex, 1, {}};
    for (dvec3 p : s.points) height.values.push_back(float(p.z));
    SurfaceVariable face{"face", VariableRate::Uniform, 1, {}};
    for (uint32_t k = 0; k < s.face_sizes.size(); ++k) face.values.push_back(float(k));
    s.variables = {height, face};
    CurvedSurface spline = splines(s, n);
    Tessellation t = subdivide(s, seen(4, 300));
    expect_sound(t);
    ASSERT_GT(triangle_count(t), 500u);
    const VertexAttribute &uv = *attribute(t, kSurfaceParameters), &f = *attribute(t, "face"),
                          &h = *attribute(t, "height");
    for (size_t k = 0; k < t.group.triangles.size(); ++k) {
        uint32_t number = uint32_t(f.values[f.corners[k]]), i = number % (n - 1),
                 j = number / (n - 1);
        double u = (i - 1 + uv.values[2 * uv.corners[k]]) / (n - 3);
        double v = (j - 1 + uv.values[2 * uv.corners[k] + 1]) / (n - 3);
        SurfacePoint at = evaluate(spline, u, v);
        dvec3 p = t.positions[t.group.triangles[k]];
        ASSERT_NEAR(glm::length(p - at.p), 0, 1e-12);
        ASSERT_NEAR(glm::dot(normal_at(t, k), at.normal), 1, 1e-6);
        ASSERT_NEAR(h.values[h.corners[k]], p.z, 1e-6);
    }
}

TEST(Subdivide, TheErrorIsThatOfPixels) {
    const uint32_t n = 6;
    SubdivisionSurface s = field(n, 1);
    CurvedSurface spline = splines(s, n);
    size_t before = 0;
    for (double pixels : {10.0, 100.0, 1000.0}) {
        PictureScale scale = seen(3, pixels);
        Tessellation t = subdivide(s, scale);
        EXPECT_LE(t.error, 0.25);
        EXPECT_GE(triangle_count(t), before);
        before = triangle_count(t);
        const VertexAttribute& uv = *attribute(t, kSurfaceParameters);
        for (size_t k = 0; k < t.group.triangles.size(); k += 3) {
            auto [a, b, c] = triangle(t, k);
            // The face is found by the middle: patches are as wide as units there.
            dvec2 m(0.0);
            for (size_t i = 0; i < 3; ++i)
                m += dvec2(uv.values[2 * uv.corners[k + i]], uv.values[2 * uv.corners[k + i] + 1]) /
                     3.0;
            dvec3 middle = (a + b + c) / 3.0;
            dvec2 cell = glm::floor(dvec2(middle)) - 1.0 + m;
            dvec3 p = evaluate(spline, cell.x / (n - 3), cell.y / (n - 3)).p;
            ASSERT_LT(glm::length(p - middle) * scale.pixels, 0.5) << pixels;
        }
    }
}

TEST(Subdivide, BoundaryFacesAreThereOnlyWhereAskedFor) {
    SubdivisionSurface s = field(5, 0);
    EXPECT_NEAR(area(subdivide(s, seen(4, 100))), 4, 1e-12);
    s.draw_boundary = true;
    Tessellation t = subdivide(s, seen(4, 100));
    EXPECT_NEAR(area(t), 16, 1e-12);
    EXPECT_EQ(euler(t), 1);
    s.sharp_corners = false;
    Tessellation round = subdivide(s, seen(4, 1000));
    EXPECT_LT(area(round), 16 - 0.1);
    for (dvec3 p : round.positions) EXPECT_GT(glm::length(p), 0.1);
}

TEST(Subdivide, BoundariesAreCubicSplinesOfTheirPoints) {
    SubdivisionSurface s = field(6, 1);
    s.draw_boundary = true;
    Tessellation t = subdivide(s, seen(4, 300));
    expect_sound(t);
    // Between points 2 and 3 of the first row.
    int found = 0;
    for (dvec3 p : t.positions) {
        if (p.y > 1e-9 || p.x < 2 - 1e-9 || p.x > 3 + 1e-9) continue;
        ++found;
        double x = p.x - 2, r = 1 - x;
        double w[4] = {r * r * r / 6, (3 * x * x * x - 6 * x * x + 4) / 6,
                       (3 * r * r * r - 6 * r * r + 4) / 6, x * x * x / 6};
        double z = 0;
        for (int k = 0; k < 4; ++k) z += w[k] * s.points[size_t(k + 1)].z;
        EXPECT_NEAR(p.z, z, 1e-12);
    }
    EXPECT_GT(found, 4);
}

TEST(Subdivide, NormalsAreThoseOfFineTrianglesOnBoundariesToo) {
    SubdivisionSurface s = field(5, 0.4);
    s.draw_boundary = true;
    Tessellation t = subdivide(s, seen(4, 2000), within(0.05));
    EXPECT_GT(least_agreement(t), 0.995);
    // A fan of five, at a corner that turns inwards: three quads of a ring left out of four.
    SubdivisionSurface l = field(3, 0);
    l.face_sizes.pop_back();
    l.indices.resize(12);
    for (dvec3& p : l.points) p.z = 0.2 * p.x * p.x + 0.1 * p.x * p.y;
    l.draw_boundary = true;
    Tessellation bent = subdivide(l, seen(2, 2000), within(0.05));
    EXPECT_GT(least_agreement(bent), 0.99);
}

TEST(Subdivide, OtherFacesBecomeQuads) {
    // A prism on a pentagon.
    SubdivisionSurface s;
    for (int k = 0; k < 10; ++k) {
        double a = 2 * kPi * (k % 5) / 5;
        s.points.push_back({std::cos(a), std::sin(a), k < 5 ? -1 : 1});
    }
    s.face_sizes = {5, 5, 4, 4, 4, 4, 4};
    s.indices = {4, 3, 2, 1, 0, 5, 6, 7, 8, 9};
    for (uint32_t k = 0; k < 5; ++k)
        for (uint32_t p : {k, (k + 1) % 5, (k + 1) % 5 + 5, k + 5}) s.indices.push_back(p);
    SurfaceVariable corner{"corner", VariableRate::FaceVarying, 1, {}};
    for (size_t k = 0; k < s.indices.size(); ++k) corner.values.push_back(float(k));
    SurfaceVariable few = corner;
    few.name = "few";
    few.values.pop_back();
    s.variables = {corner, few};
    Tessellation t = subdivide(s, seen(1, 1));
    expect_sound(t);
    EXPECT_EQ(attribute(t, "few"), nullptr);
    EXPECT_EQ(triangle_count(t), 2 * (10 + 4 * 5u));
    EXPECT_EQ(euler(t), 2);
    t = subdivide(s, seen(1, 500));
    EXPECT_EQ(euler(t), 2);
    EXPECT_GT(least_agreement(t), 0.9);
    const VertexAttribute &uv = *attribute(t, kSurfaceParameters), &c = *attribute(t, "corner");
    std::vector<bool> seen_value(s.indices.size(), false);
    for (size_t k = 0; k < t.group.triangles.size(); ++k) {
        const float *at = &uv.values[2 * uv.corners[k]], value = c.values[c.corners[k]];
        EXPECT_TRUE(at[0] >= 0 && at[0] <= 1 && at[1] >= 0 && at[1] <= 1);
        if (at[0] == 0 && at[1] == 0) seen_value[size_t(value)] = true;
    }
    for (size_t k = 0; k < 10; ++k) EXPECT_TRUE(seen_value[k]) << k;
    for (size_t k = 10; k < 30; k += 4) EXPECT_TRUE(seen_value[k]) << k;
}

TEST(Subdivide, NonsenseIsLeftOut) {
    SubdivisionSurface s = cube();
    s.face_sizes.insert(s.face_sizes.end(), {4, 2, 0, 3, 7});
    s.indices.insert(s.indices.end(), {0, 1, 0, 1, 5, 6, 1, 2, 99, 1});
    Tessellation t = subdivide(s, seen(1, 50));
    expect_sound(t);
    EXPECT_EQ(euler(t), 2);
    EXPECT_EQ(triangle_count(subdivide(SubdivisionSurface(), seen(1, 50))), 0u);
}

TEST(Subdivide, RandomMeshesEndSoonAndSound) {
    TessellationLimits limits;
    limits.triangles = 20000;
    for (unsigned seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> uniform(-1, 1);
        SubdivisionSurface s;
        uint32_t points = 4 + uint32_t(random() % 12);
        for (uint32_t k = 0; k < points; ++k)
            s.points.push_back({uniform(random), uniform(random), uniform(random)});
        if (seed % 7 == 0) s.points[1].y = std::nan("");
        if (seed % 11 == 0) s.points[0].x = 1e300;
        for (uint32_t f = 0; f < 20; ++f) {
            s.face_sizes.push_back(uint32_t(random() % 6));
            for (uint32_t k = 0; k < s.face_sizes.back(); ++k)
                s.indices.push_back(uint32_t(random() % (points + (seed % 5 == 0))));
        }
        if (seed % 3 == 0) s.indices.pop_back();
        s.draw_boundary = seed % 2;
        s.variables.push_back({"st", VariableRate(random() % 5), 2, std::vector<float>(80, 1.f)});
        s.variables.push_back({"N", VariableRate(random() % 5), 3, std::vector<float>(90, 0.f)});
        Tessellation t = subdivide(s, seen(1, 3000), limits);
        ASSERT_NO_FATAL_FAILURE(expect_sound(t));
        ASSERT_LE(triangle_count(t), limits.triangles);
    }
}

TEST(Subdivide, AFaceOfManyCornersCostsInProportion) {
    SubdivisionSurface s;
    const uint32_t n = 100000;
    for (uint32_t k = 0; k < n; ++k) {
        s.points.push_back({std::cos(2 * kPi * k / n), std::sin(2 * kPi * k / n), 0});
        s.indices.push_back(k);
    }
    s.face_sizes = {n};
    s.draw_boundary = true;
    s.variables.push_back({"st", VariableRate::Varying, 2, std::vector<float>(2 * n, 1.f)});
    Tessellation t = subdivide(s, seen(1, 1));
    EXPECT_EQ(triangle_count(t), 2 * n);
    EXPECT_NEAR(area(t), kPi, 1e-3);
}

}  // namespace
}  // namespace kinora
