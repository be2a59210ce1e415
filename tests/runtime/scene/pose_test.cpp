// tests/runtime/scene/pose_test.cpp: several poses of one scene, one after the other and side by
// side.
#include <gtest/gtest.h>

#include <malloc.h>

#include <thread>

#include "runtime/picture/frame/frame.h"
#include "tests/folders.h"
#include "tests/runtime/scene_text.h"

namespace kinora {
namespace {

std::unique_ptr<Rendering> asset(const char* name) {
    return Rendering::of_file(project_folder() + "/assets/" + name);
}

struct Picture {
    raytrace::Film film;
    FrameStats stats;
    Diagnostics diagnostics;
    bool made = false;
};

void render(const Scene& scene, Pose& pose, const FrameSettings& settings, double time,
            Picture& to) {
    to.made = render_frame(scene, pose, time, settings, to.film, to.stats, to.diagnostics);
}

FrameSettings small() {
    FrameSettings settings;
    settings.width = 64;
    settings.height = 36;
    return settings;
}

class Poses : public testing::TestWithParam<const char*> {};

// Skins, morphs, displacement, nested rays, volumes and lamps: what a frame writes is the pose's.
TEST_P(Poses, OfOneSceneOnTwoThreadsAreThoseOfOneAfterTheOther) {
    const std::unique_ptr<Rendering> r = asset(GetParam());
    ASSERT_TRUE(r->scene) << r->findings();
    const double times[2] = {0.2, 0.7};
    Picture alone[2], together[2];
    for (size_t k = 0; k < 2; ++k) {
        Pose pose(*r->scene);
        render(*r->scene, pose, small(), times[k], alone[k]);
        ASSERT_TRUE(alone[k].made);
    }
    Pose first(*r->scene), second(*r->scene);
    for (int round = 0; round < 3; ++round) {
        std::thread other([&] { render(*r->scene, first, small(), times[0], together[0]); });
        render(*r->scene, second, small(), times[1], together[1]);
        other.join();
        for (size_t k = 0; k < 2; ++k) {
            ASSERT_TRUE(together[k].made);
            EXPECT_EQ(difference(alone[k].film, together[k].film), 0) << "time " << times[k];
        }
    }
}

// The frame before leaves nothing in a pose, nor do frames of other poses.
TEST_P(Poses, StandWhereTheirTimesPutThem) {
    const std::unique_ptr<Rendering> r = asset(GetParam());
    ASSERT_TRUE(r->scene) << r->findings();
    Pose going(*r->scene), other(*r->scene);
    Picture there, back, fresh, elsewhere;
    render(*r->scene, going, small(), 0.2, there);
    render(*r->scene, other, small(), 0.9, elsewhere);
    render(*r->scene, going, small(), 0.7, back);
    render(*r->scene, going, small(), 0.2, back);
    Pose anew(*r->scene);
    render(*r->scene, anew, small(), 0.2, fresh);
    EXPECT_EQ(difference(there.film, back.film), 0);
    EXPECT_EQ(difference(there.film, fresh.film), 0);
}

INSTANTIATE_TEST_SUITE_P(Assets, Poses,
                         testing::Values("scenes/walker.dae", "scenes/tintoy.dae",
                                         "scenes/court.dae", "scenes/layers.dae",
                                         "gltf/bender.glb"),
                         [](const auto& test) {
                             std::string name = test.param;
                             for (char& c : name)
                                 if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                             return name;
                         });

// A floor of many squares, which stands.
SceneText many_squares(int side) {
    SceneText scene;
    scene.look("plain", "surface s() { Ci = 1; Oi = 1; }");
    std::string positions, triangles;
    for (int y = 0; y <= side; ++y)
        for (int x = 0; x <= side; ++x) positions += fmt::format("{} {} 0 ", x, y);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const int a = y * (side + 1) + x, b = a + side + 1;
            triangles += fmt::format("{} {} {} {} {} {} ", a, a + 1, b, a + 1, b + 1, b);
        }
    scene.geometries += fmt::format(
        "<geometry id=\"floor\"><mesh><source id=\"floor-p\"><float_array id=\"floor-a\" "
        "count=\"{}\">{}</float_array><technique_common><accessor source=\"#floor-a\" count=\"{}\" "
        "stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/><param "
        "name=\"Z\" type=\"float\"/></accessor></technique_common></source><vertices "
        "id=\"floor-v\"><input semantic=\"POSITION\" source=\"#floor-p\"/></vertices><triangles "
        "material=\"skin\" count=\"{}\"><input semantic=\"VERTEX\" source=\"#floor-v\" "
        "offset=\"0\"/><p>{}</p></triangles></mesh></geometry>",
        3 * (side + 1) * (side + 1), positions, (side + 1) * (side + 1), 2 * side * side,
        triangles);
    scene.place("floor", "plain");
    return scene;
}

TEST(Pose, OfASceneThatStandsSharesItsTree) {
    const size_t before = mallinfo2().uordblks;
    if (before == 0) GTEST_SKIP() << "the allocator of sanitizers does not count";
    Rendering r(many_squares(500).text());
    ASSERT_TRUE(r.scene) << r.findings();
    Picture one, two;
    Pose first(*r.scene);
    render(*r.scene, first, small(), 0, one);
    const size_t with_one = mallinfo2().uordblks;
    Pose second(*r.scene);
    render(*r.scene, second, small(), 0, two);
    const size_t with_two = mallinfo2().uordblks;
    EXPECT_EQ(difference(one.film, two.film), 0);
    // Some 5 MB of it are the memory of frames, whatever the scene.
    EXPECT_LT(double(with_two - with_one), 0.05 * double(with_one - before))
        << with_one - before << " bytes, the second " << with_two - with_one;
}

}  // namespace
}  // namespace kinora
