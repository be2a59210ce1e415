// tests/raytrace/kept_trees_test.cpp: trees that later accels take, and when they do not.
#include "raytrace/kept_trees.h"

#include <gtest/gtest.h>

#include <vector>

#include "raytrace/accel.h"
#include "tests/raytrace/meshes.h"

namespace kinora::raytrace::test {
namespace {

// An accel of a film's next picture: the mesh is made anew, and stands elsewhere.
struct Picture {
    TestMesh mesh;
    std::vector<Geometry> rows;
    Accel accel;

    Picture(std::shared_ptr<KeptTrees> kept, double radius, double x)
        : mesh(sphere(radius, dvec3(0.0))),
          rows{mesh.geometry(7, GeometryKind::Instanced)},
          accel({.kept = std::move(kept)}) {
        rows[0].shape = 0;
        rows[0].accel_from_local[3] = dvec4(x, 0, 0, 1);
        accel.update(rows);
    }
    int kept() const { return accel.last_update().kept; }
    int built() const { return accel.last_update().rebuilds; }
};

TEST(KeptTrees, EqualMeshesTakeThem) {
    auto kept = std::make_shared<KeptTrees>();
    const Picture first(kept, 1, 0), second(kept, 1, 5);
    EXPECT_EQ(first.kept(), 0);
    EXPECT_EQ(first.built(), 1);
    EXPECT_EQ(second.kept(), 1);
    EXPECT_EQ(second.built(), 0);
    const Picture alone(nullptr, 1, 5);
    RandomRays random(3);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        vec3 org, dir;
        random.next(8, dvec3(5, 0, 0), org, dir);
        const OneHit a = shoot(second.accel, org, dir), b = shoot(alone.accel, org, dir);
        ASSERT_EQ(a.hit, b.hit);
        hits += a.hit;
        if (!a.hit) continue;
        EXPECT_EQ(a.primitive, b.primitive);
        EXPECT_EQ(a.t, b.t);
    }
    EXPECT_GT(hits, 100);
}

TEST(KeptTrees, OutliveThePictureThatBuiltThem) {
    auto kept = std::make_shared<KeptTrees>();
    { const Picture first(kept, 1, 0); }
    const Picture second(kept, 1, 0);
    EXPECT_EQ(second.kept(), 1);
    EXPECT_TRUE(shoot(second.accel, vec3(0, 0, 5), vec3(0, 0, -1)).hit);
}

TEST(KeptTrees, OtherMeshesHaveTheirOwn) {
    auto kept = std::make_shared<KeptTrees>();
    const Picture first(kept, 1, 0), larger(kept, 1.0000001, 0);
    EXPECT_EQ(larger.kept(), 0);
    EXPECT_EQ(larger.built(), 1);
}

TEST(KeptTrees, WhatTwoPicturesDoNotUseIsFreed) {
    auto kept = std::make_shared<KeptTrees>();
    const Picture first(kept, 1, 0);
    const Picture a(kept, 2, 0);
    EXPECT_EQ(Picture(kept, 1, 0).kept(), 1);  // one picture in between
    const Picture b(kept, 3, 0), c(kept, 3, 0);
    EXPECT_EQ(c.kept(), 1);
    EXPECT_EQ(Picture(kept, 1, 0).kept(), 0);
}

}  // namespace
}  // namespace kinora::raytrace::test
