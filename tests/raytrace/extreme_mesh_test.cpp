// tests/raytrace/extreme_mesh_test.cpp: meshes no modeller would make
// (docs/numerics.md#geometry).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "raytrace/accel.h"
#include "tests/raytrace/meshes.h"

namespace kinora::raytrace::test {
namespace {

constexpr GeometryKind kKinds[] = {GeometryKind::Static, GeometryKind::Deforming,
                                   GeometryKind::Instanced};

int count_hits(const Accel& accel, int rays = 500) {
    RandomRays random(23);
    int hits = 0;
    for (int i = 0; i < rays; ++i) {
        vec3 org, dir;
        random.next(4, dvec3(0.0), org, dir);
        hits += shoot(accel, org, dir).hit;
    }
    return hits;
}

bool has_issue(const AccelUpdate& update, GeometryIssue issue, uint32_t geometry) {
    return std::any_of(
        update.issues.begin(), update.issues.end(),
        [&](const AccelUpdate::Issue& i) { return i.issue == issue && i.geometry == geometry; });
}

TEST(ExtremeMesh, TrianglesWithoutAreaAreNeverHitAndHarmNothing) {
    TestMesh ball = sphere(1, {0, 0, 0});
    TestMesh flat = ball;
    for (uint32_t i = 0; i < 200; ++i) {
        uint32_t a = i * 2, b = i * 2 + 1;
        for (uint32_t k : {a, a, b, a, a, a}) flat.triangles.push_back(k);
    }
    flat.positions.push_back({0, 0, 3, 0});
    flat.positions.push_back({0, 1, 3, 0});
    flat.positions.push_back({0, 2, 3, 0});
    const uint32_t n = uint32_t(flat.positions.size());
    for (uint32_t k : {n - 3, n - 2, n - 1}) flat.triangles.push_back(k);  // collinear
    for (GeometryKind kind : kKinds) {
        Accel plain, odd;
        std::vector<Geometry> a{ball.geometry(1, kind)}, b{flat.geometry(1, kind)};
        plain.update(a);
        odd.update(b);
        EXPECT_EQ(count_hits(plain), count_hits(odd));
        OneHit hit = shoot(odd, {0, 0.5f, 5}, {0, 0, -1});
        EXPECT_LT(hit.primitive, ball.triangles.size() / 3);
    }
}

TEST(ExtremeMesh, ABadVertexTakesOnlyItsOwnTrianglesAway) {
    TestMesh ball = sphere(1, {0, 0, 0});
    for (float x : {kNaN, kInf, 1e19f}) {
        for (GeometryKind kind : kKinds) {
            TestMesh bad = ball;
            bad.positions[200].y = x;
            Accel accel;
            std::vector<Geometry> rows{bad.geometry(8, kind)};
            const AccelUpdate& update = accel.update(rows);
            EXPECT_TRUE(has_issue(update, GeometryIssue::BadVertices, 8)) << x;
            EXPECT_EQ(update.issues.at(0).count, 6u);
            EXPECT_TRUE(shoot(accel, {0.1f, 0.1f, 5}, {0, 0, -1}).hit);
            EXPECT_GT(count_hits(accel), 0);
        }
    }
}

TEST(ExtremeMesh, AVertexThatTurnsBadAndHealsInRefitsComesBack) {
    TestMesh ball = sphere(1, {0, 0, 0});
    std::vector<Geometry> rows{ball.geometry(8, GeometryKind::Deforming)};
    Accel accel({.background = false});
    accel.update(rows);
    const int before = count_hits(accel);
    const vec4 good = ball.positions[200];
    for (float x : {kNaN, kInf, 1e19f}) {
        ball.positions[200].x = x;
        ++rows[0].positions_version;
        EXPECT_TRUE(has_issue(accel.update(rows), GeometryIssue::BadVertices, 8));
        EXPECT_GT(count_hits(accel), before / 2);
        ball.positions[200] = good;
        ++rows[0].positions_version;
        EXPECT_TRUE(accel.update(rows).issues.empty());
        EXPECT_EQ(count_hits(accel), before);
    }
}

// By the same rays, a tree that was refitted finds what a fresh one does.
TEST(ExtremeMesh, AMeshThatCollapsesOrExplodesComesBack) {
    TestMesh ball = sphere(1, {0, 0, 0});
    const std::vector<vec4> good = ball.positions;
    std::vector<Geometry> rows{ball.geometry(8, GeometryKind::Deforming)};
    Accel accel({.background = false});
    accel.update(rows);
    const int before = count_hits(accel);
    for (float scale : {0.0f, 1e-30f, 1e-3f, 1e6f, 1e17f}) {
        for (size_t i = 0; i < good.size(); ++i)  // every third vertex alone: triangles are torn
            for (int k = 0; k < 3; ++k)
                ball.positions[i][k] = good[i][k] * (scale < 1 || i % 3 == 0 ? scale : 1);
        ++rows[0].positions_version;
        EXPECT_TRUE(accel.update(rows).issues.empty()) << scale;
        Accel fresh({.background = false});
        std::vector<Geometry> fresh_rows{ball.geometry(8, GeometryKind::Static)};
        fresh.update(fresh_rows);
        EXPECT_NEAR(count_hits(accel), count_hits(fresh), 2) << scale;  // rays at edges
        ball.positions = good;
        ++rows[0].positions_version;
        accel.update(rows);
        EXPECT_EQ(count_hits(accel), before) << scale;
    }
}

TEST(ExtremeMesh, NeedlesBuildRefitAndTraceWithoutAbort) {
    for (double thin : {1e-7, 1e-20, 0.0}) {
        for (uint32_t seed = 0; seed < 10; ++seed) {
            TestMesh m = soup(300, 1, 1, seed);
            for (size_t i = 0; i < m.positions.size(); i += 3)
                m.positions[i + 2] = m.positions[i] + float(thin) * m.positions[i + 2];
            std::vector<Geometry> rows;
            for (uint32_t k = 0; k < 3; ++k) rows.push_back(m.geometry(k, kKinds[k]));
            Accel accel;
            accel.update(rows);
            count_hits(accel, 50);
            for (size_t i = 0; i < m.positions.size(); ++i) m.positions[i].x *= 1e-10f;
            for (Geometry& row : rows) ++row.positions_version;
            accel.update(rows);
            count_hits(accel, 50);
        }
    }
}

TEST(ExtremeMesh, AnIndexOutOfRangeLeavesTheRowOutAndIsReported) {
    TestMesh ball = sphere(1, {0, 0, 0}), other = sphere(0.5, {0, 0, 0});
    ball.triangles[7] = uint32_t(ball.positions.size());
    ball.triangles[9] = ~0u;
    for (GeometryKind kind : kKinds) {
        Accel accel;
        std::vector<Geometry> rows{ball.geometry(1, kind), other.geometry(2, kind)};
        const AccelUpdate& update = accel.update(rows);
        ASSERT_TRUE(has_issue(update, GeometryIssue::IndexOutOfRange, 1));
        EXPECT_EQ(update.issues[0].count, 2u);
        EXPECT_EQ(shoot(accel, {0, 0.1f, 5}, {0, 0, -1}).geometry, 2u);
    }
}

TEST(ExtremeMesh, ASingularMatrixLeavesTheInstanceOutUntilItIsSound) {
    TestMesh ball = sphere(1, {0, 0, 0});
    std::vector<Geometry> rows{ball.geometry(5, GeometryKind::Instanced)};
    rows[0].accel_from_local[1] = dvec4(0.0);
    Accel accel;
    EXPECT_TRUE(has_issue(accel.update(rows), GeometryIssue::SingularMatrix, 5));
    EXPECT_FALSE(shoot(accel, {0, 0, 5}, {0, 0, -1}).hit);
    rows[0].accel_from_local = dmat4(1.0);
    EXPECT_TRUE(accel.update(rows).issues.empty());
    EXPECT_TRUE(shoot(accel, {0, 0, 5}, {0, 0, -1}).hit);
    rows[0].accel_from_local[3].x = double(kNaN);
    EXPECT_TRUE(has_issue(accel.update(rows), GeometryIssue::SingularMatrix, 5));
    EXPECT_FALSE(shoot(accel, {0, 0, 5}, {0, 0, -1}).hit);
}

TEST(ExtremeMesh, ExtremeScaleInOneAxisGivesUnitNormalsOrLeavesTheRowOut) {
    TestMesh ball = sphere(1, {0, 0, 0});
    for (double scale : {1e-20, 1e-9, 1e-5, 1e5, 1e9, 1e20}) {
        std::vector<Geometry> rows{ball.geometry(5, GeometryKind::Instanced)};
        rows[0].accel_from_local[2] *= scale;
        Accel accel;
        const bool left_out = has_issue(accel.update(rows), GeometryIssue::SingularMatrix, 5);
        EXPECT_EQ(left_out, scale > 1e10 || scale < 1e-10);
        OneHit hit = scale < 1 ? shoot(accel, {0.1f, 0.1f, 5}, {0, 0, -1})
                               : shoot(accel, {5, 0.1f, 0}, {-1, 0, 0});
        ASSERT_EQ(hit.hit, !left_out) << scale;
        if (left_out) continue;
        SurfacePoint s = accel.surface_point(hit.instance, hit.primitive, hit.u, hit.v);
        EXPECT_NEAR(std::sqrt(s.Ng.x * s.Ng.x + s.Ng.y * s.Ng.y + s.Ng.z * s.Ng.z), 1, 1e-5);
    }
}

TEST(ExtremeMesh, RaysFromAfarAtSmallInstancesDoNotAbort) {
    TestMesh ball = sphere(1, {0, 0, 0});
    for (double scale : {1e-9, 1e-4, 1.0, 1e4, 1e9}) {
        std::vector<Geometry> rows{ball.geometry(5, GeometryKind::Instanced)};
        for (int c = 0; c < 3; ++c) rows[0].accel_from_local[c] *= scale;
        Accel accel;
        EXPECT_TRUE(accel.update(rows).issues.empty());
        for (float far = 1e-20f; far < 1e19f; far *= 10)
            for (float speed : {1e-18f, 1.0f, 1e18f}) {
                shoot(accel, {0, 0, far}, {0, 0, -speed});
                shoot(accel, {far, far, far}, {-speed, -speed, -speed});
            }
        EXPECT_TRUE(shoot(accel, {0, 0, float(5 * scale)}, {0, 0, -1}).hit);
    }
}

// ---- sizes at which the products of three lengths are no floats

// A mesh as one row, its size shared between its vertices and its matrix.
struct SizedRow {
    TestMesh mesh = sphere(1, {0, 0, 0}, 256, 128);  // small triangles
    std::vector<Geometry> rows;
    SizedRow(GeometryKind kind, float of_vertices, float of_matrix = 1) {
        for (vec4& p : mesh.positions) p *= of_vertices;
        rows = {mesh.geometry(5, kind)};
        for (int c = 0; c < 3; ++c) rows[0].accel_from_local[c] *= double(of_matrix);
    }
    Accel traced() const {
        Accel accel({.background = false});
        EXPECT_TRUE(accel.update(rows).issues.empty());
        return accel;
    }
};

// Sizes are powers of two, so that nothing rounds and hits are the same bits.
void expect_hits_of_size_one(const Accel& accel, const Accel& home, float size) {
    RandomRays random(7);
    for (int i = 0; i < 300; ++i) {
        vec3 org, dir;
        random.next(4, dvec3(0.0), org, dir);
        const OneHit a = shoot(home, org, dir), b = shoot(accel, org * size, dir);
        ASSERT_EQ(a.hit, b.hit) << size;
        if (!a.hit) continue;
        EXPECT_EQ(a.primitive, b.primitive);
        EXPECT_EQ(a.u, b.u);
        EXPECT_EQ(a.t * size, b.t);
        const SurfacePoint p = home.surface_point(0, a.primitive, a.u, a.v),
                           q = accel.surface_point(0, b.primitive, b.u, b.v);
        EXPECT_EQ(p.p * size, q.p);
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(p.Ng[k], q.Ng[k], 1e-6);
        // A ray to a point is as long as the way, and ends before the ball or behind its skin.
        const vec3 way = 1.5f * b.t * dir;
        EXPECT_TRUE(shoot(accel, org * size, way, 0, 1).hit);
        EXPECT_FALSE(shoot(accel, org * size, 0.6f * way, 0, 1).hit);
    }
}

TEST(ExtremeMesh, SizesOfAnyPowerAreTracedAsSizeOne) {
    for (GeometryKind kind : kKinds) {
        SizedRow one(kind, 1);
        const Accel home = one.traced();
        for (float size : {0x1p-50f, 0x1p-40f, 0x1p-30f, 0x1p-10f, 0x1p20f, 0x1p40f, 0x1p50f}) {
            SizedRow row(kind, size);
            expect_hits_of_size_one(row.traced(), home, size);
        }
    }
}

TEST(ExtremeMesh, SizesAreSharedByVerticesAndMatrixAsOneLikes) {
    SizedRow one(GeometryKind::Instanced, 1);
    const Accel home = one.traced();
    for (int size = -40; size <= 40; size += 8)
        for (int of_vertices = -48; of_vertices <= 48; of_vertices += 6) {
            const float whole = std::ldexp(1.0f, size), part = std::ldexp(1.0f, of_vertices);
            SizedRow row(GeometryKind::Instanced, part, whole / part);
            SCOPED_TRACE(testing::Message() << "size 2^" << size << ", vertices 2^" << of_vertices);
            expect_hits_of_size_one(row.traced(), home, whole);
        }
}

// A refit, a rebuild at once and one in the background have the scale of the first build.
TEST(ExtremeMesh, SmallMeshesThatMoveStayTraced) {
    constexpr float kSize = 0x1p-45f;
    for (bool background : {false, true}) {
        SizedRow row(GeometryKind::Deforming, kSize);
        Accel accel({.background = background});
        accel.update(row.rows);
        for (float stretch : {1.1f, 2.0f, 5.0f}) {
            for (vec4& p : row.mesh.positions) p.z *= stretch;
            for (int again = 0; again < 3; ++again) {
                ++row.rows[0].positions_version;
                accel.update(row.rows);
                accel.wait_for_background();
            }
            EXPECT_TRUE(shoot(accel, {0.1f * kSize, 0, 50 * kSize}, {0, 0, -1}).hit) << stretch;
        }
    }
}

// Of a part far off from the rest only that part is large.
TEST(ExtremeMesh, OneVertexFarOffDoesNotMakeTheRestVanish) {
    for (GeometryKind kind : {GeometryKind::Static, GeometryKind::Instanced}) {
        TestMesh ball = sphere(1, {0, 0, 0});
        ball.positions.push_back({1e15f, 0, 0, 0});
        const uint32_t last = uint32_t(ball.positions.size() - 1);
        for (uint32_t k : {0u, 1u, last}) ball.triangles.push_back(k);
        std::vector<Geometry> rows{ball.geometry(5, kind)};
        Accel accel;
        accel.update(rows);
        EXPECT_LT(shoot(accel, {0.1f, 0.1f, -5}, {0, 0, 1}).primitive,
                  ball.triangles.size() / 3 - 1);
    }
}

// What is hidden by a scale of nearly 0 when rays are first traced is seen once it has grown.
TEST(ExtremeMesh, WhatBeginsAlmostAsAPointIsSeenWhenItHasGrown) {
    for (GeometryKind kind : {GeometryKind::Deforming, GeometryKind::Instanced})
        for (double small : {1e-30, 1e-12, 1e-6, 1e-4}) {
            SizedRow row(kind, 1);
            const std::vector<vec4> grown = row.mesh.positions;
            Geometry& geometry = row.rows[0];
            if (kind == GeometryKind::Instanced)
                for (int c = 0; c < 3; ++c) geometry.accel_from_local[c] *= small;
            else
                for (vec4& p : row.mesh.positions) p *= float(small);
            Accel accel({.background = false});
            accel.update(row.rows);
            row.mesh.positions = grown;
            geometry.accel_from_local = dmat4(1.0);
            geometry.positions_version += kind == GeometryKind::Deforming;
            EXPECT_TRUE(accel.update(row.rows).issues.empty()) << small;
            EXPECT_TRUE(shoot(accel, {0.1f, 0.1f, 5}, {0, 0, -1}).hit) << small;
        }
}

}  // namespace
}  // namespace kinora::raytrace::test
