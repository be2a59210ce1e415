// tests/runtime/displacement_frame_test.cpp: displacement over the frames of a scene: what runs
// once and what at each frame, after the skin, in which space; what surfaces see.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <map>

#include "allocations_of_ours.h"
#include "displacement_scenes.h"
#include "jit/target.h"
#include "runtime/base/parallel.h"
#include "runtime/scene/vertices/vertex_work.h"

namespace kinora {
namespace {

// ---- when it runs

struct Decision {
    const char* name;
    std::string code;
    bool moving_node;
    bool each_frame;
};

TEST(TrueDisplacement, RunsOnceUnlessItReadsWhatChanges) {
    const Decision rows[] = {
        {"plain", "displacement d() { P += 0.1 * sin(9 * s) * N; }\n", false, false},
        {"plain on a moving node", "displacement d() { P += 0.1 * noise(P) * N; }\n", true, false},
        {"time", "displacement d() { P += 0.1 * sin(9 * s + time) * N; }\n", false, true},
        {"I", "displacement d() { P += 0.01 * length(I) * N; }\n", false, true},
        {"E", "displacement d() { P += 0.01 * zcomp(E) * N; }\n", false, true},
        {"du", "displacement d() { P += 0.01 * du * N; }\n", false, true},
        {"area", "displacement d() { P += 0.01 * area(P) * N; }\n", false, true},
        {"NDC", "displacement d() { P += 0.01 * zcomp(transform(\"NDC\", P)) * N; }\n", false,
         true},
        {"camera space", "displacement d() { P += 0.01 * zcomp(transform(\"camera\", P)) * N; }\n",
         false, true},
        {"depth", "displacement d() { P += 0.01 * depth(P) * N; }\n", false, true},
        {"world space, still",
         "displacement d() { P += 0.1 * noise(transform(\"world\", P)) * N; }\n", false, false},
        {"world space, moving",
         "displacement d() { P += 0.1 * noise(transform(\"world\", P)) * N; }\n", true, true},
        {"object space", "displacement d() { P += 0.1 * noise(transform(\"object\", P)) * N; }\n",
         true, false},
        {"frame number",
         "displacement d() { float f = 0; option(\"Frame\", f); P += 0.01 * f * N; }\n", false,
         true},
        {"I without effect", "displacement d() { vector V = I; P += 0.1 * N; }\n", true, false},
    };
    for (const Decision& row : rows) {
        SCOPED_TRACE(row.name);
        SceneText scene =
            square_scene(row.code, kDisplaced, "<translate sid=\"move\">0 0 0</translate>");
        if (row.moving_node) scene.animate("floor-node/move.X", {0, 1}, {0, 0.1});
        Rendering r(scene.text(), dice_of(8));
        ASSERT_TRUE(r.scene) << r.findings();
        const Shape& shape = r.scene->shapes[0];
        EXPECT_EQ(shape.vertex_work != nullptr, row.each_frame);
        auto still =
            row.moving_node ? raytrace::GeometryKind::Instanced : raytrace::GeometryKind::Static;
        EXPECT_EQ(shape.kind, row.each_frame ? raytrace::GeometryKind::Deforming : still);
        EXPECT_GT(mesh_of(r).positions.size(), 50u);
        r.frame(0.5);
    }
}

// Light loops, light functions and questions of every kind: vertices have no grid to answer from.
TEST(TrueDisplacement, MeetsNoLightsAndAnswersQuestions) {
    const std::string asks =
        "float x = 0; surface(\"a\", x); displacement(\"b\", x); atmosphere(\"c\", x);"
        " incident(\"d\", x); opposite(\"e\", x); rayinfo(\"depth\", x); attribute(\"f\", x);"
        " float f = 0, t[2] = {0, 0}; option(\"Frame\", f); option(\"Shutter\", t);";
    const std::string moves = " P += vector(0, 0, 0.25 + x + 1e-20 * (f + t[1]));";
    const std::string lights =
        " color c = ambient() + diffuse(N) + specular(N, -I, 0.1); illuminance(P) c += 1;"
        " illuminance(P + N, N, PI / 2) { lightsource(\"g\", x); c += 1; }"
        " P += vector(comp(c, 0), 0, 0);";
    for (const char* kind : {"displacement", "transformation"}) {
        SCOPED_TRACE(kind);
        bool displaces = std::string(kind) == "displacement";
        SceneText scene =
            square_scene(kind + (" d() { " + asks + moves) + (displaces ? lights : "") + " }\n",
                         displaces ? kDisplaced : kTransformed);
        Rendering r(scene.text(), dice_of(8));
        ASSERT_TRUE(r.scene) << r.findings();
        r.frame(0.5);
        for (dvec3 p : world_positions(r)) {
            EXPECT_NEAR(p.z, 0.25, 1e-6);
            EXPECT_LE(std::fabs(p.x), 1 + 1e-6);
        }
        EXPECT_EQ(r.count("RSL_NO_LIGHTS"), displaces ? 5 : 0) << r.findings();
    }
}

TEST(TrueDisplacement, AnimatedParametersRunItAtEachFrame) {
    SceneText scene;
    scene.square("floor").look(
        "look", std::string("displacement d(float h = 0;) { P += h * N; }\n") + kPlain,
        "<shader stage=\"DISPLACEMENT\"><bind symbol=\"h\"><param ref=\"h\"/></bind></shader>"
        "<shader stage=\"SURFACE\"/>",
        "<newparam sid=\"h\"><float>0.25</float></newparam>");
    scene.place("floor", "look").animate("look-fx/h", {0, 1}, {0, 1});
    Rendering r(scene.text(), dice_of(8));
    ASSERT_TRUE(r.scene) << r.findings();
    ASSERT_TRUE(r.scene->shapes[0].vertex_work);
    for (double time : {0.75, 0.0, 0.5}) {
        r.frame(time);
        for (dvec3 p : world_positions(r)) EXPECT_NEAR(p.z, time, 1e-6);
    }
}

TEST(TrueDisplacement, ThatOnlyBendsNStaysAKernelOfTheSurface) {
    SceneText scene = square_scene(
        "displacement bumps() { point Q = P; P += 0.1 * sin(9 * s) * N; N = calculatenormal(P);"
        " P = Q; }\n");
    Rendering r(scene.text(), dice_of(2));
    ASSERT_TRUE(r.scene) << r.findings();
    EXPECT_EQ(mesh_of(r).positions.size(), 4u);
    EXPECT_EQ(r.scene->shader_instances[0]->done_layers, 0u);
    EXPECT_EQ(r.scene->dice.triangles, 0u);
}

TEST(TrueDisplacement, IsLeftOutByTheBumpKnob) {
    SceneOptions options = dice_of(2);
    options.quality.displacement = DisplacementMode::Bump;
    Rendering r(square_scene("displacement d() { P += 0.5 * N; }\n").text(), options);
    r.frame();
    EXPECT_EQ(mesh_of(r).positions.size(), 4u);
    for (dvec3 p : world_positions(r)) EXPECT_EQ(p.z, 0.0);
}

// ---- in space, in time

TEST(TrueDisplacement, IsInObjectSpaceWhereverTheNodeStands) {
    SceneText scene =
        square_scene("displacement d() { P += vector(0, 0, 0.1 * xcomp(P)); }\n", kDisplaced,
                     "<translate>0.25 0 0</translate><rotate>0 0 1 90</rotate>"
                     "<scale>0.5 0.5 2</scale>");
    Rendering r(scene.text(), dice_of(4));
    ASSERT_TRUE(r.scene) << r.findings();
    for (dvec3 p : world_positions(r))  // object x = 2 world y; z is doubled
        EXPECT_NEAR(p.z, 2 * 0.1 * 2 * p.y, 1e-6);
}

TEST(TrueDisplacement, ATimesVerticesDependOnThatTimeAlone) {
    SceneText scene = square_scene(
        "displacement d() { P += 0.2 * sin(9 * s + 3 * time) * N; N = calculatenormal(P); }\n");
    scene.light("sun", "<directional><color>1 1 1</color></directional>",
                "<rotate>0 1 0 40</rotate>");
    SceneOptions options = dice_of(2);
    options.background_rebuilds = false;
    Rendering r(scene.text(), options);
    r.frame(32, 32, 0.0);
    r.frame(32, 32, 0.4);
    EXPECT_EQ(r.stats.refits, 1);
    options.quality.always_rebuild = true;
    Rendering fresh(scene.text(), options);
    fresh.frame(32, 32, 0.4);
    EXPECT_EQ(fresh.stats.refits, 0);
    EXPECT_TRUE(same_bytes(r.film, fresh.film));
    for (dvec3 p : world_positions(r))
        EXPECT_NEAR(p.z, 0.2 * std::sin(9 * (p.x + 1) / 2 + 1.2), 1e-6);
}

TEST(TrueDisplacement, GivesTheSameBytesOnAnyThreadsAndTargets) {
    std::string text =
        square_scene(
            "displacement d() { P += 0.2 * noise(9 * P + time) * N + 0.01 * random() * N;"
            " N = calculatenormal(P); }\n")
            .text();
    std::vector<vec4> first, first_normals;
    for (const jit::Target& target : jit::targets())
        for (int threads : {1, 2}) {
            if (!target.supported()) continue;
            SCOPED_TRACE(fmt::format("{} {}", target.name, threads));
            Threads scope(threads);
            SceneOptions options = dice_of(1);
            options.target = &target;
            Rendering r(text, options);
            r.frame(0.25);
            const ShapePose& shape = r.pose->shapes[0];
            if (first.empty()) {
                first = shape.positions;
                first_normals = shape.normals;
                continue;
            }
            ASSERT_EQ(shape.positions.size(), first.size());
            EXPECT_EQ(std::memcmp(shape.positions.data(), first.data(), first.size() * 16), 0);
            EXPECT_EQ(
                std::memcmp(shape.normals.data(), first_normals.data(), first_normals.size() * 16),
                0);
        }
    EXPECT_GT(first.size(), 1000u);
}

TEST(TrueDisplacement, ComesAfterTheSkin) {
    SceneText plain, displaced;
    plain.look("skin", kPlain).bending_strip("strip", "skin", 8);
    displaced.look(
        "skin",
        std::string("displacement d() { P += 0.25 * vector \"world\" (0, 0, s); }\n") + kPlain,
        kDisplaced);
    displaced.bending_strip("strip", "skin", 8);
    Rendering a(plain.text()), b(displaced.text(), dice_of(2));
    a.frame(1.0);
    b.frame(1.0);
    std::vector<dvec3> bent = world_positions(a), moved = world_positions(b);
    ASSERT_GT(moved.size(), 4 * bent.size());
    // The file's vertices come first; their s is 0 and 1 in turn.
    for (size_t p = 0; p < bent.size(); ++p)
        EXPECT_LT(glm::length(moved[p] - bent[p] - dvec3(0, 0, p % 2 ? 0.25 : 0)), 1e-5);
    // Those between are skinned by weights between: in the plane they stay near the bent strip.
    double off = 0;
    for (const dvec3& p : moved) {
        double nearest = 1e9;
        for (const dvec3& q : bent) nearest = std::min(nearest, glm::length(dvec2(p) - dvec2(q)));
        off = std::max(off, nearest);
    }
    EXPECT_LT(off, 0.36);
    b.frame(0.0);
    EXPECT_EQ(b.stats.rebuilds + b.stats.refits, 1);
}

TEST(TrueDisplacement, AllocatesNothingAfterTheFirstFrames) {
    Threads one(1);
    SceneText scene = square_scene(
        "displacement d() { P += 0.1 * noise(9 * P + time) * N; N = calculatenormal(P); }\n");
    scene.look("skin", std::string("displacement d() { P += 0.1 * noise(9 * P) * N; }\n") + kPlain,
               kDisplaced);
    scene.bending_strip("strip", "skin", 8);
    SceneOptions options = dice_of(4);
    options.quality.refit_limit = options.low_limit = 1e9f;
    Rendering r(scene.text(), options);
    for (int frame = 0; frame < 6; ++frame) r.frame(32, 32, frame / 24.0);
    watch_allocations();
    for (int frame = 0; frame < 6; ++frame)
        render_frame(*r.scene, *r.pose, frame / 24.0, r.settings, r.film, r.stats, r.diagnostics);
    size_t count = allocations_of_ours();
    EXPECT_EQ(count, 0u) << "the first at " << first_allocation_of_ours() << r.findings();
}

// ---- what surfaces see

TEST(TrueDisplacement, SurfacesSeeTheMovedPointAndTheShadersN) {
    SceneText scene;
    scene.square("floor").look(
        "look",
        "displacement d() { P += 0.25 * s * N; N = calculatenormal(P); }\n"
        "surface show() { Oi = 1; normal n = ntransform(\"world\", normalize(N));"
        " Ci = color(zcomp(transform(\"world\", P)), xcomp(n), zcomp(n)); }",
        kDisplaced);
    scene.place("floor", "look");
    Rendering r(scene.text(), dice_of(2));
    r.frame();
    double slope = 0.125, length = std::sqrt(1 + slope * slope);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            double s = (r.place(x, y).x + 1) / 2;
            EXPECT_NEAR(r.color(x, y).x, 0.25 * s, 1e-5);
            EXPECT_NEAR(r.color(x, y).y, -slope / length, 1e-4);
            EXPECT_NEAR(r.color(x, y).z, 1 / length, 1e-4);
        }
}

// The camera stands at z = 10 and looks along -z; the sheet's z at x is 1 - x tan 30.
TEST(TrueDisplacement, TellsCameraSpaceFromItsOwn) {
    struct Row {
        const char* given;
        dvec3 (*want)(dvec3 p);
    };
    const Row rows[] = {
        {"transform(\"camera\", P)", [](dvec3 p) { return dvec3(p.x, p.y, 10 - p.z); }},
        {"transform(\"camera\", \"world\", point(0, 0, 0))", [](dvec3) { return dvec3(0, 0, 10); }},
        {"transform(\"world\", point \"camera\" (1, 2, 3))", [](dvec3) { return dvec3(1, 2, 7); }},
        {"vtransform(\"world\", \"camera\", vector(0, 1, 1))",
         [](dvec3) { return dvec3(0, 1, -1); }},
        {"transform(concat(\"cam\", \"era\"), P)",
         [](dvec3 p) { return dvec3(p.x, p.y, 10 - p.z); }},
        {"point(depth(P), 0, 0)", [](dvec3 p) { return dvec3((9.9 - p.z) / 99.9, 0, 0); }},
    };
    for (const Row& row : rows) {
        SCOPED_TRACE(row.given);
        SceneText scene;
        scene.square("floor").look(
            "look",
            fmt::format("displacement d(output varying color q = 0;) {{ point c = {};"
                        " q = color(xcomp(c), ycomp(c), zcomp(c)); P += 1e-9 * N; }}\n"
                        "surface show() {{ Oi = 1; displacement(\"q\", Ci); }}",
                        row.given),
            kDisplaced);
        scene.place("floor", "look",
                    "<translate>0 0 1</translate><rotate>0 1 0 30</rotate><scale>2 2 2</scale>");
        Rendering r(scene.text(), dice_of(4));
        r.frame();
        ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
        for (int y = 0; y < 16; y += 5)
            for (int x = 0; x < 16; x += 5) {
                dvec2 at = r.place(x, y);
                dvec3 want = row.want({at.x, at.y, 1 - at.x * std::tan(kPi / 6)});
                for (int k = 0; k < 3; ++k) EXPECT_NEAR(r.color(x, y)[k], want[k], 2e-5) << k;
            }
    }
}

TEST(Transformation, MovesInCameraSpace) {
    SceneText scene;
    scene.square("floor").look(
        "look",
        "transformation d() { point c = transform(\"camera\", P); c += vector(0, 0, -0.5);"
        " P = transform(\"camera\", \"current\", c); }\n"
        "surface show() { Oi = 1; Ci = zcomp(transform(\"world\", P)); }",
        kTransformed);
    scene.place("floor", "look",
                "<translate>0 0 1</translate><rotate>0 1 0 30</rotate><scale>2 2 2</scale>");
    Rendering r(scene.text(), dice_of(4));
    r.frame();
    for (int x = 0; x < 16; x += 5)
        EXPECT_NEAR(r.color(x, 8).x, 1.5 - r.place(x, 8).x * std::tan(kPi / 6), 2e-5)
            << r.findings();
}

TEST(TrueDisplacement, LeavesItsParametersToDisplacementOfTheSurface) {
    SceneText scene;
    scene.square("floor").look(
        "look",
        "displacement d(float k = 0.5; output varying float h = 0; output varying color c = 0;) {"
        " h = s * t; c = color(s, 0, t); P += 1e-3 * h * N; }\n"
        "surface show() { float h = -1, k = -1; color c = 0; Oi = 1;"
        " float a = displacement(\"h\", h), b = displacement(\"k\", k), d = displacement(\"c\", c);"
        " Ci = color(h, k, a + b + d) + 10 * c; }",
        kDisplaced);
    scene.place("floor", "look");
    Rendering r(scene.text(), dice_of(1, 256));
    r.frame();
    EXPECT_EQ(r.scene->shader_instances[0]->done_layers, 1u);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            dvec2 p = r.place(x, y);
            double s = (p.x + 1) / 2, t = (p.y + 1) / 2;
            EXPECT_NEAR(r.color(x, y).x, s * t + 10 * s, 1e-4);
            EXPECT_NEAR(r.color(x, y).y, 0.5, 1e-6);
            EXPECT_NEAR(r.color(x, y).z, 3 + 10 * t, 1e-4);
        }
}

TEST(TrueDisplacement, KeepsStOfMeshesWithoutTextureCoordinates) {
    SceneText plain, displaced;
    std::string show = "surface show() { Oi = 1; Ci = color(s, t, u); }\n";
    plain.octahedron("ball").look("look", show).place("ball", "look");
    displaced.octahedron("ball")
        .look("look", "displacement d() { P += 1e-6 * N; }\n" + show, kDisplaced)
        .place("ball", "look");
    Rendering a(plain.text()), b(displaced.text(), dice_of(4));
    a.frame();
    b.frame();
    EXPECT_GT(mesh_of(b).positions.size(), 100u);
    EXPECT_LT(difference(a.film, b.film), 1e-4);
}

TEST(TrueDisplacement, LeavesTextsMatricesAndArraysToTheSurfaceAsBumpDoes) {
    const char* displacement =
        "displacement d(output varying matrix m = 1; output varying string side = \"none\";"
        " output varying float ar[2] = {0.1, 0.2}; output varying color cs[2] = {0, 0};"
        " output varying string words[2] = {\"a\", \"b\"}) {"
        " m = matrix(.01, .02, .03, .04, .05, .06, .07, .08, .09, .10, .11, .12, .13, .14, .15, "
        ".16);"
        " side = \"right\"; if (s < 0.5) side = \"left\"; ar[0] = s; ar[1] = t;"
        " cs[1] = color(t, 0.75, s); words[1] = \"set\"; P += 1e-4 * N; }\n";
    struct Row {
        const char* body;
        dvec3 (*want)(double s, double t);
    };
    const Row rows[] = {
        {"matrix q = 0; float k = displacement(\"m\", q);"
         " Ci = color(comp(q, 0, 1), comp(q, 2, 1), k * comp(q, 3, 3));",
         [](double, double) { return dvec3(0.02, 0.10, 0.16); }},
        {"string q = \"?\"; float k = displacement(\"side\", q); if (q == \"left\") Ci = color(1, "
         "0, k);"
         " if (q == \"right\") Ci = color(0, 1, k);",
         [](double s, double) { return s < 0.5 ? dvec3(1, 0, 1) : dvec3(0, 1, 1); }},
        {"float q[2] = {7, 7}; float k = displacement(\"ar\", q); Ci = color(q[0], q[1], k);",
         [](double s, double t) { return dvec3(s, t, 1); }},
        {"color q[2] = {7, 7}; float k = displacement(\"cs\", q); Ci = q[1] + k * q[0];",
         [](double s, double t) { return dvec3(t, 0.75, s); }},
        {"string q[2] = {\"\", \"\"}; float k = displacement(\"words\", q);"
         " if (q[0] == \"a\" && q[1] == \"set\") Ci = k;",
         [](double, double) { return dvec3(1); }},
    };
    for (const Row& row : rows)
        for (DisplacementMode mode : {DisplacementMode::True, DisplacementMode::Bump}) {
            SCOPED_TRACE(fmt::format("{} {}", row.body, int(mode)));
            SceneText scene;
            scene.square("floor").look(
                "look",
                displacement + fmt::format("surface show() {{ Oi = 1; Ci = 0; {} }}", row.body),
                kDisplaced);
            scene.place("floor", "look");
            SceneOptions options = dice_of(2, 64);
            options.quality.displacement = mode;
            Rendering r(scene.text(), options);
            r.frame();
            ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
            EXPECT_EQ(r.scene->shader_instances[0]->done_layers,
                      mode == DisplacementMode::True ? 1u : 0u);
            for (int y = 0; y < 16; ++y)
                for (int x = 0; x < 16; ++x) {
                    dvec2 p = r.place(x, y);
                    dvec3 want = row.want((p.x + 1) / 2, (p.y + 1) / 2);
                    for (int k = 0; k < 3; ++k)
                        ASSERT_NEAR(r.color(x, y)[k], want[k], 1e-4) << x << "," << y << "," << k;
                }
        }
}

TEST(TrueDisplacement, OfASkinThatItsJointsMirrorGoesOutwards) {
    SceneText scene;
    scene.look("look", std::string("displacement d() { P += 0.25 * normalize(Ng); }\n") + kPlain,
               kDisplaced);
    scene.bending_strip("strip", "look", 8);
    std::string root = "<translate>0 -1 0</translate>";
    scene.nodes.insert(scene.nodes.find(root) + root.size(), "<scale>-1 1 1</scale>");
    Rendering r(scene.text(), dice_of(8));
    r.frame();
    ASSERT_TRUE(r.pose->shapes[0].mirrored);
    // The strip's normals are +z, whichever way its triangles are wound.
    for (dvec3 p : world_positions(r)) EXPECT_NEAR(p.z, 0.25, 1e-5);
    for (const vec4& n : r.pose->shapes[0].normals) EXPECT_NEAR(n.z, 1, 1e-4);
}

TEST(TrueDisplacement, TellsTheMeshsNameToItsSurface) {
    SceneText scene;
    for (std::string id : {"first", "second"}) {
        scene.square(id, 0.5).look(id + "-look",
                                   "displacement d() { P += 1e-3 * N; }\nsurface show() { string o "
                                   "= \"?\"; Oi = 1; Ci = 0;"
                                   " float k = attribute(\"identifier:object\", o); if (o == \"" +
                                       id + "\") Ci = k; }",
                                   kDisplaced);
        scene.place(
            id, id + "-look",
            id == "first" ? "<translate>-0.5 0 0</translate>" : "<translate>0.5 0 0</translate>");
    }
    Rendering r(scene.text(), dice_of(8));
    r.frame();
    EXPECT_EQ(r.color(4, 8), vec3(1)) << r.findings();
    EXPECT_EQ(r.color(12, 8), vec3(1)) << r.findings();
}

}  // namespace
}  // namespace kinora
