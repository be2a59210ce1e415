// tests/runtime/frame_test.cpp: the frame loop: what it allocates, and that a picture depends on
// the time alone.
#include <gtest/gtest.h>

#include <cstring>

#include "allocations_of_ours.h"
#include "jit/target.h"
#include "runtime/base/parallel.h"
#include "scene_text.h"
#include "tests/folders.h"

namespace kinora {
namespace {

// Skinned strip, rigidly moving ball, transparent pane, lit floor; shadows, noise, mirrors.
SceneText moving_scene() {
    SceneText scene;
    scene
        .look("marble",
              "surface marble() { Oi = 1; normal Nf = faceforward(normalize(N), I);"
              " Ci = (0.2 + noise(5 * transform(\"shader\", P))) * diffuse(Nf); }")
        .look("plain",
              "surface plain() { Oi = 1; normal Nf = faceforward(normalize(N), I);"
              " Ci = diffuse(Nf) + 0.2 * trace(P, reflect(normalize(I), Nf)); }")
        .look("glass", "surface glass() { Oi = 0.3 + 0.2 * noise(4 * P); Ci = Oi * Cs; }")
        .square("floor", 1.5)
        .octahedron("ball")
        .place("floor", "plain", "<translate>0 0 -0.5</translate>")
        .place("floor", "glass",
               "<translate>0.3 0.2 1.5</translate><rotate>1 1 0 50</rotate><scale>.3 .3 .3</scale>")
        .place("ball", "plain",
               "<translate sid=\"t\">0 0 0.4</translate><rotate>1 2 3 40</rotate>"
               "<scale>0.3 0.3 0.3</scale>",
               "ball-node")
        .bending_strip("strip", "marble", 40)
        .animate("ball-node/t.X", {0, 1}, {-0.7, 0.7})
        .light("bulb", "<point><color>1 1 1</color></point>", "<translate>1 1 3</translate>")
        .light("sun", "<directional><color>.5 .4 .3</color></directional>",
               "<rotate>1 1 0 -30</rotate>");
    return scene;
}

std::string walker() {
    return project_folder() + "/assets/scenes/walker.dae";
}

// A rebuild makes new structures; a frame that refits makes none.
SceneOptions refit_only() {
    SceneOptions options;
    options.quality.refit_limit = options.low_limit = 1e9f;
    return options;
}

void expect_no_allocation(Rendering& r) {
    ASSERT_TRUE(r.scene) << r.findings();
    // Buffers grow to the largest frame: the frames are met once, then played again.
    for (int frame = 0; frame < 9; ++frame) r.frame(64, 36, frame / 24.0);
    watch_allocations();
    for (int frame = 0; frame < 9; ++frame)
        render_frame(*r.scene, *r.pose, frame / 24.0, r.settings, r.film, r.stats, r.diagnostics);
    size_t count = allocations_of_ours();
    EXPECT_EQ(count, 0u) << "the first at " << first_allocation_of_ours() << r.findings();
    EXPECT_GT(r.stats.shading_points, 100u);
}

TEST(Frame, NoAllocationOfOursAfterTheFirstFrames) {
    Threads one(1);
    Rendering r(moving_scene().text(), refit_only());
    expect_no_allocation(r);
}

TEST(Frame, NoAllocationOfOursAfterTheFirstFramesOnTwoThreads) {
    Threads two(2);
    Rendering r(moving_scene().text(), refit_only());
    // Which thread meets its largest tile when is a matter of luck; a while of it settles that.
    for (int frame = 0; frame < 40; ++frame) r.frame(64, 36, frame % 10 / 24.0);
    expect_no_allocation(r);
}

TEST(Frame, NoAllocationOfOursInTheWalker) {
    Threads one(1);
    expect_no_allocation(*Rendering::of_file(walker(), refit_only()));
}

TEST(Frame, PicturesMoveAtAll) {
    Rendering r(moving_scene().text());
    EXPECT_FALSE(r.diagnostics.has_errors()) << r.findings();
    r.frame(64, 36, 0);
    raytrace::Film first = r.film;
    r.frame(64, 36, 1);
    EXPECT_GT(different_pixels(first, r.film, 0.01f), 200u);
    EXPECT_GT(r.stats.refits + r.stats.rebuilds, 0);
}

TEST(Frame, RefittedFramesEqualRebuiltFrames) {
    SceneOptions rebuild;
    rebuild.quality.always_rebuild = true;
    Rendering refitted(moving_scene().text()), rebuilt(moving_scene().text(), rebuild);
    int refits = 0;
    for (int i = 0; i <= 6; ++i) {
        refitted.frame(64, 36, i / 6.0);
        rebuilt.frame(64, 36, i / 6.0);
        EXPECT_LE(difference(refitted.film, rebuilt.film), 1e-4f) << "frame " << i;
        refits += refitted.stats.refits;
    }
    EXPECT_GE(refits, 3);
}

// The tree may be another one after a rebuild. A ray exactly on the edge of two triangles may then
// meet the other of them: that pixel differs by rounding (docs/rays.md#order-of-frames).
void expect_any_order(const SceneOptions& options, size_t pixels_on_edges) {
    const double times[] = {0, 0.2, 0.4, 0.6, 0.8, 1.0};
    Rendering forward(moving_scene().text(), options);
    std::vector<raytrace::Film> films;
    for (double time : times) films.push_back(forward.frame(48, 27, time).film);
    for (int i : {5, 0, 3, 3, 1, 4, 2}) {
        forward.frame(48, 27, times[i]);
        EXPECT_LE(different_pixels(forward.film, films[size_t(i)], 0), pixels_on_edges) << i;
        EXPECT_LE(difference(forward.film, films[size_t(i)]), 1e-6f) << i;
    }
    Rendering fresh(moving_scene().text(), options);
    fresh.frame(48, 27, times[4]);
    EXPECT_LE(different_pixels(fresh.film, films[4], 0), pixels_on_edges);
    EXPECT_LE(difference(fresh.film, films[4]), 1e-6f);
}

TEST(Frame, AnyOrderOfFramesGivesTheSamePictures) {
    expect_any_order(refit_only(), 0);
    expect_any_order({}, 1);
}

TEST(Frame, ThreadsDoNotShowInThePicture) {
    raytrace::Film films[2];
    for (int n = 1; n <= 2; ++n) {
        Threads threads(n);
        Rendering r(moving_scene().text());
        r.settings.integrator.samples_per_pixel = 3;
        r.settings.integrator.tile = 8;
        r.frame(64, 36, 0.1);
        films[n - 1] = r.frame(64, 36, 0.7).film;
    }
    EXPECT_TRUE(same_bytes(films[0], films[1])) << difference(films[0], films[1]);
}

TEST(Frame, TargetsDoNotShowInThePictureInPreciseMath) {
    std::vector<raytrace::Film> films;
    for (const jit::Target& target : jit::targets()) {
        if (!target.supported()) continue;
        SceneOptions options;
        options.target = &target;
        Rendering r(moving_scene().text(), options);
        films.push_back(r.frame(64, 36, 0.6).film);
        EXPECT_TRUE(same_bytes(films.front(), films.back()))
            << target.name << ": " << difference(films.front(), films.back());
    }
    EXPECT_GE(films.size(), 2u);
}

TEST(Frame, CountsRaysAndPoints) {
    SceneText scene;
    scene.square("floor", 1.5)
        .look("look", "surface s() { Oi = 1; Ci = diffuse(N); }")
        .place("floor", "look")
        .light("sun", "<directional><color>1 1 1</color></directional>");
    Rendering r(scene.text());
    r.frame(24, 12);  // the window is fitted inside: the picture shows 4 x 2, the floor covers 18
                      // columns of 24
    EXPECT_EQ(r.stats.shading_points, 216u);
    EXPECT_EQ(r.stats.rays, 288u + 216u);
}

// 200 000 triangles may be baked: 10 times 20 000 are, 11 times are not.
TEST(Frame, ARepeatedMeshIsInstancedWhereAllOfItWouldBeMuch) {
    for (int times : {10, 11}) {
        std::vector<dvec3> positions;
        std::vector<int> triangles;
        for (int y = 0; y <= 100; ++y)
            for (int x = 0; x <= 100; ++x) positions.push_back({0.01 * x, 0.01 * y, 0});
        for (int y = 0; y < 100; ++y)
            for (int x = 0; x < 100; ++x)
                for (int k : {0, 1, 102, 0, 102, 101}) triangles.push_back(101 * y + x + k);
        SceneText scene;
        scene.mesh("grid", positions, triangles).look("l", "surface s() { Ci = 1; Oi = 1; }");
        for (int i = 0; i < times; ++i)
            scene.place("grid", "l", "<translate>0 0 " + std::to_string(-i) + "</translate>");
        Rendering r(scene.text());
        ASSERT_TRUE(r.scene) << r.findings();
        auto wanted =
            times == 10 ? raytrace::GeometryKind::Static : raytrace::GeometryKind::Instanced;
        for (const Shape& shape : r.scene->shapes) EXPECT_EQ(shape.kind, wanted) << times;
    }
}

TEST(Frame, ACameraWithoutAPictureIsAnError) {
    SceneText scene;
    scene.square("floor").look("l", "surface s() { Ci = 1; }").place("floor", "l");
    scene.cameras =
        "<camera id=\"eye\"><optics><technique_common><perspective><yfov>180</yfov><znear>1</znear>"
        "<zfar>10</zfar></perspective></technique_common></optics></camera>";
    SceneOptions options;
    options.camera = "eye-node";  // unnamed it would give way
    Rendering r(scene.text(), options);
    ASSERT_TRUE(r.scene);
    EXPECT_FALSE(render_frame(*r.scene, *r.pose, 0, r.settings, r.film, r.stats, r.diagnostics));
    ASSERT_EQ(r.count("CAMERA_OPTICS"), 1) << r.findings();
    EXPECT_GT(r.where(*r.find("CAMERA_OPTICS")).line, 1);
}

// Pictures too large for memory are made a band at a time: imager, outputs and all.
TEST(Frame, BandsAreTheRowsOfTheWholePicture) {
    SceneText scene = moving_scene();
    scene.scene_effect("grain", "imager g() { Ci += 0.1 * random() + 0.1 * noise(P / 7); }",
                       "<shader stage=\"IMAGER\"/>");
    for (int samples : {1, 4}) {
        Rendering whole(scene.text());
        whole.settings.integrator.samples_per_pixel = samples;
        whole.frame(70, 150, 0.5);
        Rendering banded(scene.text());
        banded.settings.integrator.samples_per_pixel = samples;
        banded.settings.band_rows = 64;
        std::vector<vec4> rows;
        size_t most = 0;
        banded.settings.on_band = [&](const raytrace::Film& band) {
            EXPECT_EQ(band.top, int(rows.size() / 70));
            most = std::max(most, band.rgba.size());
            rows.insert(rows.end(), band.rgba.begin(), band.rgba.end());
            return true;
        };
        banded.frame(70, 150, 0.5);
        ASSERT_EQ(rows.size(), whole.film.rgba.size());
        EXPECT_EQ(std::memcmp(rows.data(), whole.film.rgba.data(), rows.size() * sizeof(vec4)), 0);
        EXPECT_EQ(most, 70u * 64);
        EXPECT_EQ(banded.stats.rays, whole.stats.rays);
        EXPECT_EQ(banded.findings(), whole.findings());
        // And a whole picture again with the same film.
        banded.settings.band_rows = 0;
        banded.frame(70, 150, 0.5);
        EXPECT_TRUE(same_bytes(banded.film, whole.film));
    }
}

}  // namespace
}  // namespace kinora
