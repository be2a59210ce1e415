// tests/runtime/player/closer_test.cpp: displaced meshes are diced again while the camera comes
// closer, between pictures that are not refined. The oracle is the refined picture of the same
// view.
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "../displacement_scenes.h"
#include "played.h"
#include "runtime/base/stats.h"
#include "runtime/player/scene_maker.h"

namespace kinora {
namespace {

constexpr const char* kHills =
    "displacement hills() { P += 0.3 * noise(5 * P) * N; N = calculatenormal(P); }\n"
    "surface slopes() { normal n = normalize(N); Oi = 1; Ci = color(n) * 0.5 + 0.5; }\n";

// A floor that the camera looks down at from 30 above it, and where wanted one below it.
std::string floor_file(bool two = false) {
    SceneText scene;
    scene.cameras =
        "<camera "
        "id=\"eye\"><optics><technique_common><perspective><xfov>50</xfov><znear>0.01</znear>"
        "<zfar>100</zfar></perspective></technique_common></optics></camera>";
    scene.camera_node =
        "<node id=\"eye-node\"><translate>0.3 0.2 30</translate><instance_camera "
        "url=\"#eye\"/></node>";
    scene.square("floor", 2).look("look", kHills, kDisplaced).place("floor", "look");
    if (two) scene.place("floor", "look", "<translate>0 0 -1</translate>", "low");
    const std::string file =
        std::filesystem::temp_directory_path() / ("closer_" + std::to_string(getpid()) + ".dae");
    write(file, scene.text());
    return file;
}

double apart(const raytrace::Film& a, const raytrace::Film& b) {
    EXPECT_EQ(a.rgba.size(), b.rgba.size());
    double sum = 0;
    for (size_t k = 0; k < std::min(a.rgba.size(), b.rgba.size()); ++k)
        for (int c = 0; c < 3; ++c) sum += std::abs(double(a.rgba[k][c]) - b.rgba[k][c]);
    return sum / (3 * double(a.rgba.size()));
}

TEST(Closer, MeshesAreDicedAgainWhileTheCameraMoves) {
    const std::string file = floor_file(), near = "dolly 40";
    // The first of four samples is the one of one sample.
    Played exact(small_request(file)), rough(small_request(file, 4)),
        moving(small_request(file, 4), {true, false, nullptr});
    std::filesystem::remove(file);
    EXPECT_EQ(exact.script(near + "; wait refined"), "");
    ASSERT_TRUE(exact.player.picture());
    const raytrace::Film& fine = exact.player.picture()->film;

    // Without a clock nothing is diced for pictures that are not refined.
    EXPECT_EQ(rough.script("refine; " + near), "");
    ASSERT_TRUE(rough.player.wait_picture(kLong));
    const double coarse = apart(rough.player.picture()->film, fine);
    EXPECT_GT(coarse, 1e-3);

    Player& player = moving.player;
    ASSERT_TRUE(player.wait_picture(kLong));  // the camera is that of a picture
    EXPECT_EQ(moving.script("adapt; filter; refine; " + near), "");
    // A hundredth of a pixel there and back, until the pictures are those of finer meshes.
    double best = coarse;
    const Stopwatch watch;
    for (int k = 0; watch.ms() < 1000 * kLong && best > coarse / 4; ++k) {
        EXPECT_EQ(moving.script(k % 2 ? "orbit -0.001 0" : "orbit 0.001 0"), "");
        ASSERT_TRUE(player.wait_picture(kLong));
        best = std::min(best, apart(player.picture()->film, fine));
    }
    EXPECT_LE(best, coarse / 4) << coarse;
    EXPECT_FALSE(player.picture()->refined);
}

// Scenes in the order in which they are made, until the maker has no more to do.
std::vector<std::unique_ptr<MadeScene>> all_made(News& news, SceneMaker& maker) {
    std::vector<std::unique_ptr<MadeScene>> all;
    EXPECT_TRUE(news.await([&] {
        while (auto made = maker.take()) all.push_back(std::move(made));
        return maker.idle();
    }));
    return all;
}

// The oracle is the scene that nobody hurries.
TEST(Coarse, ASceneIsSeenBeforeItIsDicedWhole) {
    const std::string file = floor_file(true);
    News news;
    SceneMaker hurried(news.bell(), true, false), slow(news.bell(), false, false);
    const auto open = [&](SceneMaker& maker) {
        SceneRequest request = small_request(file);
        request.look_from = dvec3(0.3, 0.2, 3);
        request.look_at = "0.3,0.2,0";
        maker.open(request, {}, true);
        return all_made(news, maker);
    };
    auto whole = open(slow), parts = open(hurried);
    ASSERT_EQ(whole.size(), 1u);
    const DiceStats& asked = whole[0]->shown->scene->dice;
    EXPECT_EQ(asked.pixels, 1);
    // The first may have been replaced before this thread looked.
    ASSERT_TRUE(parts.size() == 1 || parts.size() == 2);
    EXPECT_TRUE(parts[0]->replaces_camera);
    if (parts.size() == 2) {
        EXPECT_LT(parts[0]->shown->scene->dice.triangles * 4, asked.triangles);
        EXPECT_FALSE(parts[1]->replaces_camera);
    }
    EXPECT_EQ(parts.back()->shown->scene->dice.triangles, asked.triangles);
    EXPECT_EQ(parts.back()->shown->scene->dice.pixels, asked.pixels);
    EXPECT_EQ(hurried.counts().scenes, 2u);

    // An edit need not wait for the finer scene, and comes to be diced as finely.
    SceneEdits edits;
    edits.hidden = {"low"};
    hurried.open(small_request(file), {}, true);
    hurried.edit(edits);
    parts = all_made(news, hurried);
    ASSERT_FALSE(parts.empty());
    EXPECT_EQ(parts.back()->edits, edits);
    EXPECT_EQ(parts.back()->shown->scene->dice.pixels, asked.pixels);
    std::filesystem::remove(file);
}

// Nor does another file that cannot be opened; the edits are kept.
TEST(Coarse, AFailedOpeningLeavesTheFinerSceneItsEdits) {
    const std::string file = floor_file(true);
    SceneEdits edits;
    edits.hidden = {"low"};
    News news;
    SceneMaker maker(news.bell(), true, false);
    maker.open(small_request(file), edits, true);
    ASSERT_TRUE(news.await([&] { return maker.counts().scenes > 0; }));
    maker.open(small_request(file + ".missing"), {}, true);
    auto made = all_made(news, maker);
    std::filesystem::remove(file);
    std::erase_if(made, [](const auto& one) { return !one->shown; });
    ASSERT_FALSE(made.empty());
    EXPECT_EQ(made.back()->edits, edits);
    EXPECT_EQ(made.back()->shown->scene->dice.pixels, 1);
}

// A text that cannot be compiled is told, and the scene becomes finer without it.
TEST(Coarse, ABrokenTextDoesNotKeepASceneCoarse) {
    const std::string file = floor_file();
    News news;
    SceneMaker maker(news.bell(), true, false);
    maker.open(small_request(file), {}, true);
    ASSERT_TRUE(news.await([&] { return maker.counts().scenes > 0; }));
    SceneEdits edits;
    edits.texts = {{"look", file, "surface slopes( {", 1}};
    maker.edit(edits);
    auto made = all_made(news, maker);
    std::filesystem::remove(file);
    const auto broken = std::ranges::find_if(made, [](const auto& one) { return !one->shown; });
    ASSERT_NE(broken, made.end());
    EXPECT_FALSE((*broken)->findings.empty());
    EXPECT_EQ((*broken)->error, SceneError::Shader);
    std::erase_if(made, [](const auto& one) { return !one->shown; });
    ASSERT_FALSE(made.empty());
    EXPECT_EQ(made.back()->edits, SceneEdits{});
    EXPECT_EQ(made.back()->shown->scene->dice.pixels, 1);
}

}  // namespace
}  // namespace kinora
