// tests/runtime/redice_test.cpp: displaced meshes that are too coarse for a view, and scenes built
// again for it, in the background too. The oracle measures all triangles as a picture shows them.
#include "runtime/picture/frame/redice.h"
#include "runtime/scene/build/build_scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <thread>

#include "displacement_scenes.h"
#include "runtime/base/parallel.h"
#include "runtime/scene/vertices/dice_error.h"

namespace kinora {
namespace {

constexpr int kSize = 96;
constexpr double kFov = 60;          // degrees
constexpr double kDive = 20.5 / 64;  // seconds: between the 64 times that loading looks at
constexpr double kBefore = 0.314, kAfter = 0.327;
constexpr const char* kBumps = "displacement d() { P += 0.05 * noise(6 * P) * N; }\n";
constexpr const char* kStill = "displacement d() { P += 1e-7 * N; }\n";

// The camera looks down, 6 above, and comes to 0.5 for a moment that loading does not see.
SceneText diving(SceneText scene) {
    scene.cameras = fmt::format(
        "<camera id=\"eye\"><optics><technique_common><perspective><xfov>{}</xfov>"
        "<aspect_ratio>1</aspect_ratio><znear>0.01</znear><zfar>100</zfar></perspective>"
        "</technique_common></optics></camera>",
        kFov);
    scene.camera_node =
        "<node id=\"eye-node\"><translate sid=\"move\">0.3 0.2 6</translate>"
        "<rotate sid=\"turn\">0 1 0 0</rotate><instance_camera url=\"#eye\"/></node>";
    return scene.animate("eye-node/move.Z", {0, kBefore, kDive, kAfter, 1}, {6, 6, 0.5, 6, 6});
}
SceneText floor(const char* code = kBumps) {
    SceneText scene;
    scene.square("floor", 2).look("look", std::string(code) + kPlain, kDisplaced);
    return diving(scene.place("floor", "look", "", "floor-node"));
}

SceneOptions options_of(double dice = 2) {
    SceneOptions options = dice_of(dice, kSize);
    options.start_time = 0;
    options.end_time = 1;
    options.background_rebuilds = false;
    options.camera = "#";  // the file's, although loading sees little of a strip by it
    return options;
}

// A scene, and what builds it again.
struct Pair {
    Diagnostics diagnostics;
    std::unique_ptr<Scene> scene;
    std::unique_ptr<Pose> pose;  // of the scene
    std::unique_ptr<Redicer> redicer;
    FrameSettings settings;

    explicit Pair(const SceneText& text, const SceneOptions& options = options_of()) {
        static int number = 0;
        std::string path = std::filesystem::temp_directory_path() /
                           fmt::format("redice_{}_{}.dae", getpid(), number++);
        std::ofstream(path) << text.text();
        auto description = import_scene(path, {}, diagnostics);
        std::filesystem::remove(path);
        if (!description) return;
        EXPECT_TRUE(may_dice(*description, options));
        redicer = std::make_unique<Redicer>(*description, options);
        scene = build_scene(std::make_shared<SceneDescription>(std::move(*description)), options,
                            diagnostics);
        settings.width = settings.height = kSize;
        if (scene) pose = std::make_unique<Pose>(*scene);
        if (scene) redicer->share(*scene, diagnostics.files);
    }
    double error(const Scene& of, Pose& in, double time) {
        FrameStats stats;
        EXPECT_TRUE(pose_frame(of, in, time, settings, stats, diagnostics));
        return stats.dice_error;
    }
    double error(PosedScene& of, double time) { return error(*of.scene, *of.pose, time); }
    raytrace::Film picture(const Scene& of, Pose& in, double time) {
        raytrace::Film film;
        FrameStats stats;
        EXPECT_TRUE(render_frame(of, in, time, settings, film, stats, diagnostics));
        return film;
    }
    raytrace::Film picture(PosedScene& of, double time) {
        return picture(*of.scene, *of.pose, time);
    }
    size_t count(std::string_view code) const {
        size_t n = 0;
        for (const Finding& finding : diagnostics.findings()) n += finding.info->code == code;
        return n;
    }
};

// The longest edge in pixels of all triangles, of those that lie in the picture: its length over
// its distance from an eye at (0.3, 0.2, z) that looks down.
double longest_seen(const Scene& scene, double z) {
    double tangent = std::tan(kFov / 360 * 3.14159265358979), most = 0;
    dvec3 eye(0.3, 0.2, z);
    for (const Shape& shape : scene.shapes) {
        const Mesh& mesh = scene.meshes[shape.mesh];
        for (const MeshGroup& group : mesh.groups)
            for (size_t k = 0; k < group.triangles.size(); ++k) {
                dvec3 a = position(mesh, group.triangles[k]) - eye;
                dvec3 b = position(mesh, group.triangles[k - k % 3 + (k + 1) % 3]) - eye;
                double nearest = 1e9;
                bool seen = false;
                for (int s = 0; s <= 16; ++s) {
                    dvec3 p = a + s / 16.0 * (b - a);
                    nearest = std::min(nearest, glm::length(p));
                    seen |= std::max(std::abs(p.x), std::abs(p.y)) < -p.z * tangent;
                }
                if (seen) most = std::max(most, glm::length(b - a) / nearest);
            }
    }
    return most * kSize / 2 / tangent;
}

TEST(DiceError, IsTheLongestEdgeOverTheLongestAllowed) {
    Pair r(floor(kStill));
    ASSERT_TRUE(r.scene);
    double allowed = std::sqrt(2.0) * 2;
    for (double time : {0.0, 0.25, 0.317, kDive, 0.325, 1.0}) {
        double error = r.error(*r.scene, *r.pose, time);
        double z = r.pose->view.eye.z + r.scene->origin.z;
        double seen = longest_seen(*r.scene, z) / allowed;
        EXPECT_LT(error, 1.1 * seen) << time;
        EXPECT_GT(error, 0.85 * seen) << time;
    }
    EXPECT_LE(r.error(*r.scene, *r.pose, 0.5), 1.0001);
    EXPECT_GT(r.error(*r.scene, *r.pose, kDive), 3);
}

TEST(DiceError, IsAtMostOneForEveryViewThatWasSampled) {
    for (double dice : {1.0, 3.0, 12.0}) {
        Pair r(floor(), options_of(dice));
        ASSERT_TRUE(r.scene);
        for (int s = 0; s <= 8; ++s) {
            EXPECT_LE(r.error(*r.scene, *r.pose, s / 8.0), 1.0001);
            EXPECT_GT(r.error(*r.scene, *r.pose, s / 8.0), 0.3);
        }
    }
}

TEST(DiceError, IsSmallWhereverTheRangeComesCloserBetweenItsViews) {
    SceneText scene = floor(kStill);
    scene.animations.clear();
    scene.animate("eye-node/move.Z", {0, 0.28, 0.3125, 0.33, 0.8, 0.9, 1}, {6, 6, 0.5, 6, 6, 2, 6});
    Pair r(scene);
    ASSERT_TRUE(r.scene);
    for (int k = 0; k <= 64; ++k) EXPECT_LE(r.error(*r.scene, *r.pose, k / 64.0), 1.2501) << k;
    EXPECT_LE(r.error(*r.scene, *r.pose, 0.3125), 1.0001);
    r.error(*r.scene, *r.pose, 0.3125);
    EXPECT_LE(longest_seen(*r.scene, 0.5), 1.05 * std::sqrt(2.0) * 2);
    // A scene built again is diced for the same views and one more: here for one of those.
    auto again = r.redicer->make({0.5, {}}, r.diagnostics);
    ASSERT_TRUE(again);
    EXPECT_EQ(again.scene->dice.triangles, r.scene->dice.triangles);
}

TEST(DiceError, DoesNotMindWhatTheCameraTurnsAwayFrom) {
    SceneText away = floor();
    away.animate("eye-node/turn.ANGLE", {0, kBefore, kDive, kAfter, 1}, {0, 0, 180, 0, 0});
    Pair r(away), down(floor());
    ASSERT_TRUE(r.scene && down.scene);
    EXPECT_NEAR(r.error(*r.scene, *r.pose, kDive), down.error(*down.scene, *down.pose, kDive) / 4,
                0.4);
}

TEST(DiceError, SeesMeshesThatComeToTheCamera) {
    SceneText scene;
    scene.square("floor", 2).look("look", std::string(kBumps) + kPlain, kDisplaced);
    scene.place("floor", "look", "<translate sid=\"up\">0 0 0</translate>", "floor-node");
    SceneText comes = diving(scene);
    comes.animations.clear();
    comes.animate("floor-node/up.Z", {0, kBefore, kDive, kAfter, 1}, {0, 0, 5.5, 0, 0});
    Pair r(comes);
    ASSERT_TRUE(r.scene);
    EXPECT_EQ(r.scene->shapes[0].kind, raytrace::GeometryKind::Instanced);
    EXPECT_LE(r.error(*r.scene, *r.pose, 0.25), 1.0001);
    EXPECT_GT(r.error(*r.scene, *r.pose, kDive), 3);
}

TEST(DiceError, FollowsSkinsAndMorphs) {
    SceneText strip;
    strip.look("skin", std::string(kBumps) + kPlain, kDisplaced).bending_strip("strip", "skin", 8);
    Pair r(diving(strip));
    ASSERT_TRUE(r.scene);
    ASSERT_EQ(r.scene->watched.size(), 1u);
    EXPECT_TRUE(r.scene->watched[0]->deforms());
    for (int s = 0; s <= 8; ++s) EXPECT_LE(r.error(*r.scene, *r.pose, s / 8.0), 1.0001);
    EXPECT_GT(r.error(*r.scene, *r.pose, kDive), 2);
    auto closer = r.redicer->make({kDive, {}}, r.diagnostics);
    ASSERT_TRUE(closer);
    EXPECT_LE(r.error(closer, kDive), 1.0001);
}

TEST(DiceError, IsNoneWhereNothingIsDiced) {
    SceneText plain;
    plain.square("floor", 2).look("look", kPlain).place("floor", "look");
    Rendering r(diving(plain).text(), options_of());
    r.frame(kDive);
    EXPECT_EQ(r.stats.dice_error, 0);
    EXPECT_TRUE(r.scene->watched.empty());
    EXPECT_FALSE(may_dice(*r.scene->description, options_of()));
}

// By brute force: a fly-by low over a field whose triangles come in no order.
TEST(DiceError, FindsTheNearTrianglesOfAFieldInNoOrder) {
    constexpr int kCells = 40;
    std::vector<dvec3> positions;
    std::vector<int> triangles;
    for (int y = 0; y <= kCells; ++y)
        for (int x = 0; x <= kCells; ++x)
            positions.push_back({x * 4.0 / kCells - 2, y * 4.0 / kCells - 2, 0});
    for (int k = 0; k < kCells * kCells; ++k) {
        int cell = k * 607 % (kCells * kCells), x = cell % kCells, y = cell / kCells;
        int first = y * (kCells + 1) + x;
        for (int corner : {0, 1, kCells + 2, 0, kCells + 2, kCells + 1})
            triangles.push_back(first + corner);
    }
    SceneText scene;
    scene.mesh("field", positions, triangles)
        .look("look", std::string(kStill) + kPlain, kDisplaced)
        .place("field", "look");
    Pair r(diving(scene));
    ASSERT_TRUE(r.scene);
    double error = r.error(*r.scene, *r.pose, kDive);
    double seen = longest_seen(*r.scene, 0.5) / (std::sqrt(2.0) * 2);
    EXPECT_LT(error, 1.1 * seen);
    EXPECT_GT(error, 0.85 * seen);
    EXPECT_GT(error, 2);
}

TEST(Redice, MakesASceneFineEnoughForTheView) {
    Pair r(floor(kStill));
    ASSERT_TRUE(r.scene);
    EXPECT_GT(r.error(*r.scene, *r.pose, kDive), kMostDiceError);
    auto closer = r.redicer->make({kDive, {}}, r.diagnostics);
    ASSERT_TRUE(closer);
    EXPECT_LE(r.error(closer, kDive), 1.0001);
    EXPECT_LE(longest_seen(*closer.scene, 0.5), 1.05 * std::sqrt(2.0) * 2);
    EXPECT_GT(r.error(closer, kDive), 0.5);
    // And as fine as before for all others.
    for (int s = 0; s <= 8; ++s) EXPECT_LE(r.error(closer, s / 8.0), 1.0001);
    EXPECT_EQ(closer.scene->origin, r.scene->origin);
    EXPECT_EQ(closer.scene->textures, r.scene->textures);
    EXPECT_EQ(closer.scene->points, r.scene->points);
}

TEST(Redice, IsForTimesOutsideTheRangeToo) {
    SceneOptions options = options_of();
    options.end_time = 0.2;
    Pair r(floor(), options);
    ASSERT_TRUE(r.scene);
    EXPECT_LE(r.error(*r.scene, *r.pose, 0.2), 1.0001);
    EXPECT_GT(r.error(*r.scene, *r.pose, kDive), 3);
    auto closer = r.redicer->make({kDive, {}}, r.diagnostics);
    ASSERT_TRUE(closer);
    EXPECT_LE(r.error(closer, kDive), 1.0001);
}

TEST(Redice, IsForACameraThatAUserMoves) {
    Pair r(floor());
    ASSERT_TRUE(r.scene);
    r.error(*r.scene, *r.pose, 0);
    raytrace::Camera moved = r.pose->view;
    moved.eye += dvec3(0.8, -0.5, -5.6);
    r.pose->view = moved;
    EXPECT_GT(dice_error(*r.scene->description, *r.scene, *r.pose), 2);
    auto closer = r.redicer->make({0, moved}, r.diagnostics);
    ASSERT_TRUE(closer);
    EXPECT_LE(r.error(closer, 0), 1.0001);
    closer.pose->view = moved;
    EXPECT_LE(dice_error(*closer.scene->description, *closer.scene, *closer.pose), 1.0001);
    EXPECT_GT(dice_error(*closer.scene->description, *closer.scene, *closer.pose), 0.5);
}

TEST(Redice, LetsAFrameGoThatIsTooCoarseAndLeavesTheNextOnesAlone) {
    Pair r(floor()), whole(floor());
    ASSERT_TRUE(r.scene && whole.scene);
    raytrace::Film film;
    FrameStats stats;
    r.settings.most_dice_error = kMostDiceError;
    EXPECT_TRUE(render_frame(*r.scene, *r.pose, 0.25, r.settings, film, stats, r.diagnostics));
    EXPECT_FALSE(stats.too_coarse);
    EXPECT_FALSE(render_frame(*r.scene, *r.pose, kDive, r.settings, film, stats, r.diagnostics));
    EXPECT_TRUE(stats.too_coarse);
    EXPECT_GT(stats.dice_error, kMostDiceError);
    EXPECT_EQ(stats.rays, 0u);
    EXPECT_TRUE(render_frame(*r.scene, *r.pose, 0.375, r.settings, film, stats, r.diagnostics));
    EXPECT_TRUE(same_bytes(film, whole.picture(*whole.scene, *whole.pose, 0.375)));
}

// Deforming and moving shapes too: they are moved by what changed since a frame that was drawn.
TEST(Redice, LeavesMovingShapesWhereTheirTimesPutThem) {
    SceneText scene;
    scene.look("skin", std::string(kBumps) + kPlain, kDisplaced).bending_strip("strip", "skin", 8);
    scene.square("tile", 0.2)
        .look("white", kPlain)
        .place("tile", "white", "<translate sid=\"go\">0 0 0.1</translate>", "tile-node");
    scene.animate("tile-node/go.X", {0, kDive, kDive + 1e-4, 1}, {-1, -1, 0.5, 0.5});
    Pair r(diving(scene)), whole(diving(scene));
    ASSERT_TRUE(r.scene && whole.scene);
    raytrace::Film film;
    FrameStats stats;
    r.settings.most_dice_error = kMostDiceError;
    for (double time : {0.1, kDive, kDive + 1e-3, 0.6, kDive, 0.1}) {
        bool drawn = render_frame(*r.scene, *r.pose, time, r.settings, film, stats, r.diagnostics);
        EXPECT_EQ(drawn, std::abs(time - kDive) > 0.01) << time;
        if (drawn) {
            EXPECT_TRUE(same_bytes(film, whole.picture(*whole.scene, *whole.pose, time))) << time;
        }
    }
}

TEST(Redice, InTheBackgroundGivesTheSameBitsAsHere) {
    for (int threads : {1, 2}) {
        Threads scope(threads);
        Pair r(floor());
        ASSERT_TRUE(r.scene);
        raytrace::Film before = r.picture(*r.scene, *r.pose, 0.5);
        EXPECT_FALSE(r.redicer->running());
        r.redicer->start({kDive, {}});
        EXPECT_TRUE(r.redicer->running());
        int frames = 0;
        while (!r.redicer->ready() || frames < 2) {
            EXPECT_TRUE(same_bytes(before, r.picture(*r.scene, *r.pose, 0.5)));
            ++frames;
        }
        size_t findings = r.diagnostics.findings().size();
        PosedScene taken = r.redicer->take(r.diagnostics);
        ASSERT_TRUE(taken);
        EXPECT_FALSE(r.redicer->running());
        EXPECT_EQ(r.diagnostics.findings().size(), findings);
        auto made = r.redicer->make({kDive, {}}, r.diagnostics);
        ASSERT_TRUE(made);
        raytrace::Film film = r.picture(taken, kDive);
        EXPECT_TRUE(same_bytes(film, r.picture(made, kDive)));
        EXPECT_GT(different_pixels(film, before, 0.01f), 0u);
        EXPECT_TRUE(same_bytes(r.picture(taken, 0.7), r.picture(made, 0.7)));
        EXPECT_EQ(taken.scene->points, r.scene->points);
    }
}

TEST(Redice, IsGivenUpAtOnce) {
    Pair r(floor(), options_of(0.1));  // a million triangles and more
    ASSERT_TRUE(r.scene);
    for (int ms : {0, 1, 20, 100}) {
        r.redicer->start({kDive, {}});
        std::this_thread::sleep_for(std::chrono::milliseconds(ms));
    }
    r.redicer.reset();
    Pair idle(floor());
    EXPECT_FALSE(idle.redicer->take(idle.diagnostics));
    idle.redicer->start({kDive, {}});
    idle.redicer->start({0.3, {}});  // the first is let go
    auto scene = idle.redicer->take(idle.diagnostics);
    ASSERT_TRUE(scene);
    EXPECT_LE(idle.error(scene, 0.3), 1.0001);
    EXPECT_GT(idle.error(scene, kDive), 1.0001);
}

TEST(Redice, KnowsThatALimitOfTrianglesIsNoError) {
    SceneOptions options = options_of(1);
    options.dice_limit = 500;
    Pair r(floor(), options);
    ASSERT_TRUE(r.scene);
    EXPECT_GT(r.scene->dice.pixels, 2);
    EXPECT_EQ(r.count("DICE_LIMIT"), 1u);
    for (int s = 0; s <= 8; ++s) EXPECT_LE(r.error(*r.scene, *r.pose, s / 8.0), 1.0001);
    for (int round = 0; round < 2; ++round) {
        auto closer = r.redicer->make({kDive, {}}, r.diagnostics);
        ASSERT_TRUE(closer);
        EXPECT_LE(r.error(closer, kDive), 1.0001);
        EXPECT_LE(closer.scene->dice.triangles, 500u);
        r.redicer->start({kDive, {}});
        EXPECT_TRUE(r.redicer->take(r.diagnostics));
        EXPECT_EQ(r.count("DICE_LIMIT"), 1u);  // once is enough
    }
}

TEST(Redice, TellsNoFindingOfTheFirstSceneAgain) {
    SceneText scene = floor(
        "displacement d() { color c = ambient(); P += log(s - 2) * N * 1e38 * 1e38 + comp(c, 0); "
        "}\n");
    Pair r(scene);
    ASSERT_TRUE(r.scene);
    auto expect_once = [&] {
        EXPECT_EQ(r.count("RSL_NO_LIGHTS"), 1u);
        for (const Finding& finding : r.diagnostics.findings()) {
            std::string text = format_finding(finding, r.diagnostics.files);
            bool lights = std::string_view(finding.info->code) == "RSL_NO_LIGHTS";
            EXPECT_EQ(text.find("ambient()") != std::string::npos, lights) << text;
        }
    };
    EXPECT_EQ(r.count("VERTEX_NON_FINITE"), 1u);
    expect_once();
    r.redicer->start({kDive, {}});
    EXPECT_TRUE(r.redicer->take(r.diagnostics));
    EXPECT_EQ(r.count("VERTEX_NON_FINITE"), 2u);  // of more vertices
    expect_once();
    EXPECT_TRUE(r.redicer->make({kDive, {}}, r.diagnostics));
    EXPECT_EQ(r.count("VERTEX_NON_FINITE"), 2u);
    expect_once();
}

}  // namespace
}  // namespace kinora
