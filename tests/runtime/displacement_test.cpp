// tests/runtime/displacement_test.cpp: vertices that shaders moved, against formulas; cracks;
// limits of memory; transformations.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <map>

#include "allocations_of_ours.h"
#include "displacement_scenes.h"
#include "runtime/base/parallel.h"
#include "runtime/scene/vertices/vertex_work.h"

namespace kinora {
namespace {

// ---- against formulas

TEST(TrueDisplacement, OfAPlaneIsTheFormulaAtEveryVertex) {
    SceneText scene = square_scene(
        "displacement waves(float A = 0.1; float k = 9;) {"
        "  P += A * sin(k * s) * normalize(N); N = calculatenormal(P); }\n");
    Rendering r(scene.text(), dice_of(2));
    r.frame();
    const Mesh& mesh = mesh_of(r);
    ASSERT_GT(mesh.positions.size(), 1000u);
    for (size_t p = 0; p < mesh.positions.size(); ++p) {
        dvec3 x = position(mesh, p);
        EXPECT_NEAR(x.z, 0.1 * std::sin(9 * (x.x + 1) / 2), 1e-6);
    }
    for (size_t n = 0; n < mesh.normals.size(); ++n) {
        dvec3 x = position(mesh, mesh.normal_positions[n]);
        double slope = 0.1 * 9 / 2 * std::cos(9 * (x.x + 1) / 2);
        double length = std::sqrt(1 + slope * slope);
        EXPECT_NEAR(mesh.normals[n].x, -slope / length, 1e-4);
        EXPECT_NEAR(mesh.normals[n].z, 1 / length, 1e-4);
    }
}

TEST(TrueDisplacement, EdgesAreAboutAsLongAsAskedFor) {
    for (double pixels : {1.0, 4.0}) {
        Rendering r(square_scene("displacement d() { P += 0 * s * N; P += 1e-9 * N; }\n").text(),
                    dice_of(pixels));
        ASSERT_TRUE(r.scene) << r.findings();
        const Mesh& mesh = mesh_of(r);
        const std::vector<uint32_t>& t = mesh.groups[0].triangles;
        double sum = 0, most = 0;
        for (size_t k = 0; k < t.size(); ++k) {
            double length =
                32 * glm::length(position(mesh, t[k]) - position(mesh, t[k - k % 3 + (k + 1) % 3]));
            sum += length;
            most = std::max(most, length);
        }
        EXPECT_LE(most, 1.4143 * pixels);
        EXPECT_GT(sum / double(t.size()), 0.6 * pixels);
        EXPECT_EQ(r.scene->dice.triangles, t.size() / 3);
    }
}

TEST(TrueDisplacement, OfAnOctahedronToASphereIsRoundWithRadialNormals) {
    SceneText scene;
    scene.octahedron("ball").look(
        "look", std::string("displacement d() { P = 0.8 * normalize(P); }\n") + kPlain, kDisplaced);
    scene.place("ball", "look");
    Rendering r(scene.text(), dice_of(1));
    r.frame(64, 64);
    const Mesh& mesh = mesh_of(r);
    for (size_t p = 0; p < mesh.positions.size(); ++p)
        EXPECT_NEAR(glm::length(position(mesh, p)), 0.8, 1e-6);
    // N is the mesh's: radial but for the size of its triangles.
    for (size_t n = 0; n < mesh.normals.size(); ++n) {
        dvec3 x = glm::normalize(position(mesh, mesh.normal_positions[n]));
        EXPECT_GT(glm::dot(x, dvec3(mesh.normals[n])), 0.99);
    }
    expect_closed(mesh);
    size_t inside = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            double radius = glm::length(r.place(x, y));
            if (std::abs(radius - 0.8) > 0.05) {
                EXPECT_EQ(r.film.at(x, y).w, radius < 0.8 ? 1.0f : 0.0f);
            }
            inside += radius < 0.75;
        }
    EXPECT_GT(inside, 1500u);
}

TEST(TrueDisplacement, WhatIsNotMovedKeepsItsNormalsAndFacetsDoNotShow) {
    SceneText scene;
    scene.octahedron("ball").look(
        "look",
        std::string("displacement d() { P += 1e-7 * N; N = calculatenormal(P); }\n") + kPlain,
        kDisplaced);
    scene.place("ball", "look");
    Rendering r(scene.text(), dice_of(4));
    ASSERT_TRUE(r.scene) << r.findings();
    const Mesh& mesh = mesh_of(r);
    for (size_t n = 0; n < mesh.normals.size(); ++n)  // linear between (+-1,0,0) ...: P itself
        EXPECT_GT(glm::dot(glm::normalize(position(mesh, mesh.normal_positions[n])),
                           dvec3(mesh.normals[n])),
                  0.99999);
}

// ---- cracks

// A cube as exporters write it: 24 vertices, hard normals, uv seams everywhere.
void add_cube(SceneText& scene, const std::string& id, bool uvs) {
    std::vector<dvec3> positions, normals, st;
    std::vector<int> triangles;
    for (int axis = 0; axis < 3; ++axis)
        for (int side : {-1, 1}) {
            int first = int(positions.size());
            for (int corner = 0; corner < 4; ++corner) {
                double a = corner == 1 || corner == 2 ? 0.5 : -0.5, b = corner >= 2 ? 0.5 : -0.5;
                dvec3 p(0.0), n(0.0);
                p[axis] = 0.5 * side;
                p[(axis + 1) % 3] = side * a;
                p[(axis + 2) % 3] = b;
                n[axis] = side;
                positions.push_back(p);
                normals.push_back(n);
                st.push_back({a + 0.5, b + 0.5, 0});
            }
            for (int k : {0, 1, 2, 0, 2, 3}) triangles.push_back(first + k);
        }
    scene.mesh(id, positions, triangles, normals, uvs ? st : std::vector<dvec3>{});
}

TEST(TrueDisplacement, ACubeWithHardNormalsAndSeamsStaysClosed) {
    for (bool uvs : {true, false}) {
        SceneText scene;
        add_cube(scene, "cube", uvs);
        scene.look(
            "look",
            std::string("displacement d() { P += (0.1 + 0.2 * noise(9 * s, 7 * t)) * N; }\n") +
                kPlain,
            kDisplaced);
        scene.place("cube", "look", "<rotate>1 2 0 40</rotate>");
        Rendering r(scene.text(), dice_of(2));
        ASSERT_TRUE(r.scene) << r.findings();
        const Mesh& mesh = mesh_of(r);
        expect_closed(mesh);
        dvec3 size = mesh.high - mesh.low;  // it did move
        EXPECT_GT(size.x, 1.2);
        EXPECT_GT(size.z, 1.2);
    }
}

TEST(TrueDisplacement, ACubesHardEdgesStayHard) {
    SceneText scene;
    add_cube(scene, "cube", true);
    scene.look("look", std::string("displacement d() { P += 0.25 * N; }\n") + kPlain, kDisplaced);
    scene.place("cube", "look");
    Rendering r(scene.text(), dice_of(8));
    ASSERT_TRUE(r.scene) << r.findings();
    const Mesh& mesh = mesh_of(r);
    // Inside a face nothing bends; at its rim the mean of three normals moves the corner.
    size_t corners = 0;
    for (size_t p = 0; p < mesh.positions.size(); ++p) {
        dvec3 x = glm::abs(position(mesh, p));
        corners += std::abs(x.x - x.y) < 1e-6 && std::abs(x.y - x.z) < 1e-6;
        if (std::abs(x.x - x.y) < 1e-6 && std::abs(x.y - x.z) < 1e-6) {
            EXPECT_NEAR(x.x, 0.5 + 0.25 / 3, 1e-6);
        }
    }
    EXPECT_EQ(corners, 24u);
    double steepest = 0;
    for (size_t n = 0; n < mesh.normals.size(); ++n) {
        dvec3 normal = glm::abs(dvec3(mesh.normals[n]));
        double most = std::max({normal.x, normal.y, normal.z});
        steepest = std::max(steepest, std::acos(std::min(1.0, most)));
        if (std::min({normal.x, normal.y, normal.z}) < 1e-6 && most > 1 - 1e-6) continue;
        dvec3 x = glm::abs(position(mesh, mesh.normal_positions[n]));
        double second = x.x + x.y + x.z - std::max({x.x, x.y, x.z}) - std::min({x.x, x.y, x.z});
        EXPECT_GT(second, 0.24);  // only one row beside the rim
    }
    EXPECT_GT(steepest, 0.1);
}

TEST(TrueDisplacement, BesideAnotherMaterialItLeavesNoCrack) {
    // An octahedron whose lower half wears a look that displaces nothing.
    SceneText scene;
    scene.octahedron("ball").look(
        "look", std::string("displacement d() { P += 0.2 * noise(5 * P) * N; }\n") + kPlain,
        kDisplaced);
    scene.look("still", kPlain);
    scene.place("ball", "look");
    std::string text = scene.text();
    auto replace = [&](const std::string& from, const std::string& to) {
        size_t at = text.find(from);
        ASSERT_NE(at, std::string::npos) << from;
        text.replace(at, from.size(), to);
    };
    replace("count=\"8\">", "count=\"4\">");
    replace("4 3 0 1 3 4 5 3 1 0 3 5 </p></triangles>",
            "</p></triangles><triangles material=\"low\" count=\"4\"><input semantic=\"VERTEX\" "
            "source=\"#ball-v\" offset=\"0\"/><p>4 3 0 1 3 4 5 3 1 0 3 5</p></triangles>");
    replace("<instance_material symbol=\"skin\"",
            "<instance_material symbol=\"low\" target=\"#still\"/><instance_material "
            "symbol=\"skin\"");
    Rendering r(text, dice_of(1));
    ASSERT_TRUE(r.scene) << r.findings();
    const Mesh& mesh = mesh_of(r);
    ASSERT_EQ(mesh.groups.size(), 2u);
    expect_closed(mesh);
    // What is not displaced is split at the seam only.
    EXPECT_LT(mesh.groups[1].triangles.size() * 4, mesh.groups[0].triangles.size());
}

TEST(TrueDisplacement, RaysFindNoHoleInASeam) {
    SceneText scene;
    add_cube(scene, "cube", true);
    scene.look("look",
               std::string("displacement d() { P += 0.3 * noise(9 * s, 7 * t) * N; }\n") + kPlain,
               kDisplaced);
    scene.place("cube", "look", "<rotate>1 1 0 35</rotate>");
    Rendering r(scene.text(), dice_of(3));
    r.settings.integrator.samples_per_pixel = 16;
    r.frame(96, 96);
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 96; ++x)
            if (glm::length(r.place(x, y)) < 0.45) {
                EXPECT_EQ(r.film.at(x, y).w, 1.0f);
            }
}

// ---- memory

TEST(TrueDisplacement, CoarserThanAskedForWhereTheLimitBindsAndSaysSo) {
    SceneOptions options = dice_of(0.5, 256);
    options.dice_limit = 2000;
    Rendering r(square_scene("displacement d() { P += 0.1 * N; }\n").text(), options);
    ASSERT_TRUE(r.scene) << r.findings();
    EXPECT_EQ(r.count("DICE_LIMIT"), 1) << r.findings();
    EXPECT_LE(r.scene->dice.triangles, 2000u);
    EXPECT_GT(r.scene->dice.triangles, 400u);
    EXPECT_GT(r.scene->dice.pixels, 0.5);
}

TEST(TrueDisplacement, RepeatedMeshesAreDicedOnce) {
    SceneText scene = square_scene("displacement d() { P += 0.1 * sin(9 * s) * N; }\n");
    scene.place("floor", "look", "<translate>0 0 -1</translate>");
    Rendering r(scene.text(), dice_of(4));
    ASSERT_TRUE(r.scene) << r.findings();
    ASSERT_EQ(r.scene->shapes.size(), 2u);
    EXPECT_EQ(r.scene->shapes[0].mesh, r.scene->shapes[1].mesh);
    r.frame();
}

TEST(TrueDisplacement, ToNowhereLeavesVerticesAndIsReported) {
    Rendering r(square_scene("displacement d() { P += log(s - 2) * N * 1e38 * 1e38; }\n").text(),
                dice_of(8));
    r.frame();
    EXPECT_EQ(r.count("VERTEX_NON_FINITE"), 1) << r.findings();
    for (dvec3 p : world_positions(r)) EXPECT_EQ(p.z, 0.0);
}

// ---- transformations

TEST(Transformation, TwistsAsItsFormulaSays) {
    for (const char* word : {"transformation", "deformation"}) {
        SceneText scene;
        add_cube(scene, "cube", true);
        scene.look("look",
                   std::string(word) +
                       " twist(float k = 1;) { float a = k * ycomp(P) + time;"
                       " P = point(xcomp(P) * cos(a) + zcomp(P) * sin(a), ycomp(P),"
                       "           zcomp(P) * cos(a) - xcomp(P) * sin(a)); }\n" +
                       kPlain,
                   kTransformed);
        scene.place("cube", "look");
        Rendering r(scene.text());
        for (double time : {0.5, 0.0}) {
            r.frame(time);
            const Mesh& mesh = mesh_of(r);
            ASSERT_EQ(mesh.positions.size(), 24u);  // not diced
            std::vector<dvec3> moved = world_positions(r);
            for (size_t p = 0; p < moved.size(); ++p) {
                dvec3 q = position(mesh, p);
                double a = q.y + time;
                dvec3 expected(q.x * std::cos(a) + q.z * std::sin(a), q.y,
                               q.z * std::cos(a) - q.x * std::sin(a));
                EXPECT_LT(glm::length(moved[p] - expected), 1e-6);
            }
        }
    }
}

TEST(Transformation, RunsOnceWithoutTimeAndTurnsNormalsWithTheFaces) {
    SceneText scene;
    add_cube(scene, "cube", true);
    scene.look(
        "look",
        std::string("transformation turn() { P = point(-ycomp(P), xcomp(P), zcomp(P)); }\n") +
            kPlain,
        kTransformed);
    scene.place("cube", "look");
    Rendering r(scene.text());
    ASSERT_TRUE(r.scene) << r.findings();
    EXPECT_EQ(r.scene->shapes[0].kind, raytrace::GeometryKind::Static);
    EXPECT_EQ(r.count("RSL_STAGE_NOT_RENDERED"), 0);
    const Mesh& mesh = mesh_of(r);
    for (size_t n = 0; n < mesh.normals.size(); ++n) {
        dvec3 p = position(mesh, mesh.normal_positions[n]);
        dvec3 normal(mesh.normals[n]);
        EXPECT_NEAR(glm::length(normal), 1, 1e-6);
        EXPECT_NEAR(glm::dot(normal, p), 0.5, 1e-6);  // still that of its own face
    }
    expect_closed(mesh, 11);
}

TEST(Transformation, ComesBeforeDisplacement) {
    SceneText scene = square_scene(
        "transformation up() { P += vector(0, 0, 0.5); }\n"
        "displacement d() { P += vector(0, 0, zcomp(P)); }\n",
        std::string("<shader stage=\"TRANSFORMATION\"/>") + kDisplaced);
    Rendering r(scene.text(), dice_of(8));
    ASSERT_TRUE(r.scene) << r.findings();
    for (dvec3 p : world_positions(r)) EXPECT_NEAR(p.z, 1.0, 1e-6);
}

}  // namespace
}  // namespace kinora
