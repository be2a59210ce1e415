// tests/runtime/scene/tessellate/quadrics_test.cpp: quadrics against the formulas of RISpec 5.2.
#include "tests/runtime/scene/tessellate/surfaces.h"

namespace kinora {
namespace {

using Real = long double;
struct Place {
    Real x, y, z;
};

constexpr Real kLongPi = 3.14159265358979323846264338327950288L;

Place turned(Real x, Real y, Real z, Real degrees) {
    Real a = degrees * kLongPi / 180;
    return {x * std::cos(a) - y * std::sin(a), x * std::sin(a) + y * std::cos(a), z};
}

Place formula(const CurvedSurface& s, Real u, Real v) {
    const double* n = s.numbers;
    auto latitude = [&](Real z) {
        return z <= -n[0] ? -kLongPi / 2 : z >= n[0] ? kLongPi / 2 : std::asin(z / n[0]);
    };
    switch (s.kind) {
        case CurvedKind::Sphere: {
            Real f = latitude(n[1]) + v * (latitude(n[2]) - latitude(n[1]));
            return turned(n[0] * std::cos(f), 0, n[0] * std::sin(f), u * n[3]);
        }
        case CurvedKind::Cone:
            return turned(n[1] * (1 - v), 0, v * n[0], u * n[2]);
        case CurvedKind::Cylinder:
            return turned(n[0], 0, n[1] + v * (Real(n[2]) - n[1]), u * n[3]);
        case CurvedKind::Hyperboloid:
            return turned((1 - v) * n[0] + v * n[3], (1 - v) * n[1] + v * n[4],
                          (1 - v) * n[2] + v * n[5], u * n[6]);
        case CurvedKind::Paraboloid: {
            Real z = n[1] + v * (Real(n[2]) - n[1]);
            return turned(n[0] * std::sqrt(z / n[2]), 0, z, u * n[3]);
        }
        case CurvedKind::Disk:
            return turned(n[1] * (1 - v), 0, n[0], u * n[2]);
        default: {
            Real f = (n[2] + v * (Real(n[3]) - n[2])) * kLongPi / 180;
            return turned(n[0] + n[1] * std::cos(f), 0, n[1] * std::sin(f), u * n[4]);
        }
    }
}

const std::vector<CurvedSurface>& all() {
    static const std::vector<CurvedSurface> kAll = {
        quadric(CurvedKind::Sphere, {2, -2, 2, 360}),
        quadric(CurvedKind::Sphere, {2, -1, 1.5, 200}),
        quadric(CurvedKind::Sphere, {0.5, -3, 3, -77}),
        quadric(CurvedKind::Cone, {3, 2, 360}),
        quadric(CurvedKind::Cone, {-3, 2, -120}),
        quadric(CurvedKind::Cylinder, {1.5, -1, 4, 360}),
        quadric(CurvedKind::Cylinder, {1.5, 1, -2, 33}),
        quadric(CurvedKind::Hyperboloid, {1, 0, -1, 0.5, 1, 2, 360}),
        quadric(CurvedKind::Hyperboloid, {1, 0, -1, 0.5, 1, 2, -250}),
        quadric(CurvedKind::Paraboloid, {2, 0, 3, 360}),
        quadric(CurvedKind::Paraboloid, {2, 1, 3, 90}),
        quadric(CurvedKind::Disk, {0.7, 2, 360}),
        quadric(CurvedKind::Disk, {0.7, 2, -45}),
        quadric(CurvedKind::Torus, {3, 1, 0, 360, 360}),
        quadric(CurvedKind::Torus, {3, 1, -30, 140, -100}),
    };
    return kAll;
}

TEST(Quadrics, PlacesAreThoseOfTheFormula) {
    for (const CurvedSurface& s : all())
        for (int i = 0; i <= 20; ++i)
            for (int j = 0; j <= 20; ++j) {
                dvec3 p = evaluate(s, i / 20.0, j / 20.0).p;
                Place q = formula(s, i / 20.0L, j / 20.0L);
                EXPECT_NEAR(p.x, double(q.x), 4e-15) << int(s.kind) << " " << i << " " << j;
                EXPECT_NEAR(p.y, double(q.y), 4e-15);
                EXPECT_NEAR(p.z, double(q.z), 4e-15);
            }
}

TEST(Quadrics, DerivativesAreCentralDifferencesOfTheFormula) {
    const Real h = 1e-6L;
    for (const CurvedSurface& s : all())
        for (int i = 1; i < 8; ++i)
            for (int j = 1; j < 8; ++j) {
                Real u = i / 8.0L, v = j / 8.0L;
                SurfacePoint at = evaluate(s, double(u), double(v));
                Place a = formula(s, u - h, v), b = formula(s, u + h, v);
                Place c = formula(s, u, v - h), d = formula(s, u, v + h);
                EXPECT_NEAR(at.du.x, double((b.x - a.x) / (2 * h)), 1e-8);
                EXPECT_NEAR(at.du.y, double((b.y - a.y) / (2 * h)), 1e-8);
                EXPECT_NEAR(at.du.z, double((b.z - a.z) / (2 * h)), 1e-8);
                EXPECT_NEAR(at.dv.x, double((d.x - c.x) / (2 * h)), 1e-8);
                EXPECT_NEAR(at.dv.y, double((d.y - c.y) / (2 * h)), 1e-8);
                EXPECT_NEAR(at.dv.z, double((d.z - c.z) / (2 * h)), 1e-8);
                dvec3 n = glm::normalize(glm::cross(at.du, at.dv));
                EXPECT_NEAR(glm::dot(n, at.normal), 1, 1e-12);
            }
}

TEST(Quadrics, VerticesSolveTheImplicitEquation) {
    auto off = [](const CurvedSurface& s, dvec3 p) {
        const double* n = s.numbers;
        const double r = std::hypot(p.x, p.y);
        switch (s.kind) {
            case CurvedKind::Sphere:
                return glm::length(p) - n[0];
            case CurvedKind::Cone:
                return r - n[1] * (1 - p.z / n[0]);
            case CurvedKind::Cylinder:
                return r - n[0];
            case CurvedKind::Paraboloid:
                return r * r - n[0] * n[0] * p.z / n[2];
            case CurvedKind::Disk:
                return p.z - n[0];
            case CurvedKind::Torus:
                return std::hypot(r - n[0], p.z) - n[1];
            default: {
                double t = (p.z - n[2]) / (n[5] - n[2]);
                return r - std::hypot(n[0] + t * (n[3] - n[0]), n[1] + t * (n[4] - n[1]));
            }
        }
    };
    for (const CurvedSurface& s : all()) {
        Tessellation t = tessellate(s, seen(3, 500));
        ASSERT_GT(triangle_count(t), 4u);
        expect_sound(t);
        for (dvec3 p : t.positions) EXPECT_NEAR(off(s, p), 0, 1e-14) << int(s.kind);
    }
}

TEST(Quadrics, NormalsAgreeWithTheWindingAndTurnWhenReversed) {
    for (CurvedSurface s : all()) {
        Tessellation t = tessellate(s, seen(3, 500));
        EXPECT_GT(least_agreement(t), 0.8) << int(s.kind);
        s.reversed = true;
        Tessellation r = tessellate(s, seen(3, 500));
        EXPECT_GT(least_agreement(r), 0.8) << int(s.kind);
        ASSERT_EQ(r.group.triangles.size(), t.group.triangles.size());
        EXPECT_NEAR(glm::dot(normal_at(t, 0), normal_at(r, 0)), -1, 1e-6);
    }
}

TEST(Quadrics, SidesAreThoseOfTheSweep) {
    auto normal = [](CurvedKind kind, std::vector<double> numbers, double u, double v) {
        return evaluate(quadric(kind, numbers), u, v).normal;
    };
    EXPECT_NEAR(normal(CurvedKind::Sphere, {1, -1, 1, 360}, 0, 0.5).x, 1, 1e-15);
    EXPECT_NEAR(normal(CurvedKind::Sphere, {1, -1, 1, -360}, 0, 0.5).x, -1, 1e-15);
    EXPECT_NEAR(normal(CurvedKind::Disk, {0, 1, 360}, 0.3, 0.5).z, 1, 1e-15);
    EXPECT_NEAR(normal(CurvedKind::Disk, {0, 1, -360}, 0.3, 0.5).z, -1, 1e-15);
    EXPECT_GT(normal(CurvedKind::Torus, {2, 1, 0, 360, 360}, 0, 0).x, 0.99);
    EXPECT_GT(normal(CurvedKind::Cylinder, {1, 0, 1, 360}, 0, 0).x, 0.99);
}

TEST(Quadrics, PolesTipsAndCentresHaveTheLimitNormal) {
    auto at = [](CurvedKind kind, std::vector<double> numbers, double u, double v) {
        return evaluate(quadric(kind, numbers), u, v).normal;
    };
    for (double u : {0.0, 0.25, 0.4, 1.0}) {
        EXPECT_NEAR(at(CurvedKind::Sphere, {2, -2, 2, 360}, u, 1).z, 1, 1e-9);
        EXPECT_NEAR(at(CurvedKind::Sphere, {2, -2, 2, 360}, u, 0).z, -1, 1e-9);
        EXPECT_NEAR(at(CurvedKind::Disk, {1, 2, 360}, u, 1).z, 1, 1e-9);
        EXPECT_NEAR(at(CurvedKind::Paraboloid, {1, 0, 2, 360}, u, 0).z, -1, 1e-9);
        dvec3 n = at(CurvedKind::Cone, {1, 1, 360}, u, 1);
        double a = 2 * kPi * u, r = std::sqrt(0.5);
        EXPECT_NEAR(n.x, r * std::cos(a), 1e-7);
        EXPECT_NEAR(n.y, r * std::sin(a), 1e-7);
        EXPECT_NEAR(n.z, r, 1e-7);
    }
    for (double v : {0.0, 1.0}) {
        SurfacePoint p = evaluate(quadric(CurvedKind::Paraboloid, {1, 0, 2, 360}), 0.3, v);
        EXPECT_TRUE(std::isfinite(glm::length(p.dv)));
    }
}

TEST(Quadrics, SweepsEndExactly) {
    for (double sweep : {90.0, 180.0, 270.0, 360.0}) {
        dvec3 p = evaluate(quadric(CurvedKind::Cylinder, {2, 0, 1, sweep}), 1, 0).p;
        const double cosine[] = {0, -1, 0, 1}, sine[] = {1, 0, -1, 0};
        const size_t k = size_t(sweep / 90) - 1;
        EXPECT_EQ(p, dvec3(2 * cosine[k], 2 * sine[k], 0));
    }
    EXPECT_EQ(evaluate(quadric(CurvedKind::Sphere, {2, -2, 2, 360}), 0.1, 1).p, dvec3(0, 0, 2));
}

TEST(Quadrics, ClosedOnesHaveNoCracks) {
    for (double pixels : {1.0, 30.0, 1000.0}) {
        for (const CurvedSurface& s : {quadric(CurvedKind::Sphere, {2, -2, 2, 360}),
                                       quadric(CurvedKind::Torus, {3, 1, 0, 360, 360})}) {
            Tessellation t = tessellate(s, seen(3, pixels));
            EdgeCount edges = count_edges(t);
            EXPECT_EQ(edges.rim, 0u) << pixels;
            EXPECT_EQ(edges.more, 0u);
            EXPECT_EQ(edges.alike, 0u);
            long euler = long(t.positions.size()) - long(edges.inner) + long(triangle_count(t));
            EXPECT_EQ(euler, s.kind == CurvedKind::Sphere ? 2 : 0);
        }
    }
}

TEST(Quadrics, AreasOfSweepsAreThoseOfGeometry) {
    auto measured = [](CurvedKind kind, std::vector<double> numbers) {
        TessellationLimits limits;
        limits.error = 0.02;
        return area(tessellate(quadric(kind, numbers), seen(2, 1000), limits));
    };
    EXPECT_NEAR(measured(CurvedKind::Sphere, {2, -2, 2, 360}), 16 * kPi, 0.01);
    EXPECT_NEAR(measured(CurvedKind::Sphere, {2, -1, 1.5, 90}), 2 * 2.5 * kPi / 2, 0.01);
    EXPECT_NEAR(measured(CurvedKind::Cylinder, {2, 0, 3, -60}), 2 * kPi / 3 * 3, 0.01);
    EXPECT_NEAR(measured(CurvedKind::Cone, {1, 1, 180}), kPi * std::sqrt(2) / 2, 0.01);
    EXPECT_NEAR(measured(CurvedKind::Disk, {1, 2, 270}), 3 * kPi, 0.01);
    EXPECT_NEAR(measured(CurvedKind::Torus, {3, 1, 0, 360, 360}), 12 * kPi * kPi, 0.05);
    EXPECT_NEAR(measured(CurvedKind::Paraboloid, {1, 0, 1, 360}), kPi / 6 * (std::pow(5, 1.5) - 1),
                0.01);
}

TEST(Quadrics, ParametersAndTextureCoordinatesAreThoseOfTheirPlaces) {
    CurvedSurface s = quadric(CurvedKind::Paraboloid, {2, 0, 3, 200});
    const double corners[8] = {0, 1, 2, 1, 0, 4, 2, 4};
    std::copy(corners, corners + 8, s.corners);
    Tessellation t = tessellate(s, seen(2, 300));
    const VertexAttribute &uv = *attribute(t, kSurfaceParameters), &st = *attribute(t, "TEXCOORD");
    for (size_t k = 0; k < t.group.triangles.size(); ++k) {
        const float* p = &uv.values[2 * uv.corners[k]];
        const float* q = &st.values[2 * st.corners[k]];
        EXPECT_NEAR(glm::length(evaluate(s, p[0], p[1]).p - t.positions[t.group.triangles[k]]), 0,
                    1e-3);
        EXPECT_NEAR(q[0], 2 * p[0], 1e-6);
        EXPECT_NEAR(q[1], 1 + 3 * p[1], 1e-6);
    }
}

TEST(Quadrics, NonsenseGivesNothing) {
    const double nan = std::nan(""), inf = HUGE_VAL;
    for (const auto& [kind, numbers] : std::vector<std::pair<CurvedKind, std::vector<double>>>{
             {CurvedKind::Sphere, {0, -1, 1, 360}},
             {CurvedKind::Sphere, {1, 0.5, 0.5, 360}},
             {CurvedKind::Sphere, {1, -1, 1, 0}},
             {CurvedKind::Sphere, {nan, -1, 1, 360}},
             {CurvedKind::Sphere, {1, -1, 1, inf}},
             {CurvedKind::Cone, {1, 0, 360}},
             {CurvedKind::Cylinder, {0, 0, 1, 360}},
             {CurvedKind::Cylinder, {1, 2, 2, 360}},
             {CurvedKind::Paraboloid, {0, 0, 1, 360}},
             {CurvedKind::Paraboloid, {1, 0, 0, 360}},
             {CurvedKind::Paraboloid, {1, 2, 1, 360}},
             {CurvedKind::Disk, {1, 0, 360}},
             {CurvedKind::Torus, {1, 0, 0, 360, 360}},
             {CurvedKind::Torus, {1, 1, 9, 9, 360}},
             {CurvedKind::Hyperboloid, {1, 1, 1, 1, 1, 1, 360}}}) {
        CurvedSurface s = quadric(kind, numbers);
        EXPECT_EQ(triangle_count(tessellate(s, seen(1, 100))), 0u) << int(kind);
        dvec3 p = evaluate(s, 0.5, 0.5).p;
        EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
    }
}

}  // namespace
}  // namespace kinora
