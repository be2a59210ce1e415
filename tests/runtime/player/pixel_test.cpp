// tests/runtime/player/pixel_test.cpp: what a clicked pixel says, against arithmetic by hand and
// the picture.
#include <algorithm>
#include <cmath>
#include <map>

#include "runtime/picture/frame/frame.h"
#include "runtime/player/pixel/pixel_story.h"
#include "tests/runtime/player/played.h"

namespace kinora {
namespace {

const PixelStory* clicked(Played& played, int x, int y) {
    played.script("click " + std::to_string(x) + " " + std::to_string(y));
    return played.player.state().selection.story.get();
}

// A pixel of the wall.
constexpr const char* kWall = "click 3 3; ";

// Played::script parts lines at ';', which shaders are full of.
struct Shaded : Played {
    explicit Shaded(const std::string& shader) : Played("scenes/walker.dae") {
        EXPECT_EQ(script("select_material stone-material; edit"), "");
        CommandResult set = player.run("set_text", {shader});
        EXPECT_TRUE(set.done) << set.message;
        EXPECT_TRUE(player.wait_idle(kLong));
        EXPECT_EQ(script(kWall), "");
        story = player.state().selection.story.get();
    }
    std::string expect(const std::string& words) { return script("expect variable " + words); }
    const PixelStory* story;
};

TEST(Pixel, TellsEveryVariableAfterEveryLine) {
    Shaded shaded(
        "float twice(float x) {\n"
        "    float y = 2 * x;\n"
        "    return y;\n"
        "}\n"
        "surface a(float k = 0.25; string name = \"wall\") {\n"
        "    float a = twice(k);\n"
        "    color c = color(a, 0.5, k);\n"
        "    float sum = 0, i;\n"
        "    for (i = 0; i < 3; i += 1)\n"
        "        sum += i * a;\n"
        "    if (sum > 1) c = c * sum;\n"
        "    setcomp(c, 1, 0.125);\n"
        "    Oi = 1;\n"
        "    Ci = c;\n"
        "}\n");
    ASSERT_TRUE(shaded.story);
    EXPECT_EQ(shaded.expect("k 5 0.25"), "");
    EXPECT_EQ(shaded.expect("name 5 wall"), "");
    EXPECT_EQ(shaded.expect("y 2 0.5"), "");
    EXPECT_EQ(shaded.expect("a 6 0.5"), "");
    EXPECT_EQ(shaded.expect("c 7 0.5 0.5 0.25"), "");
    EXPECT_EQ(shaded.expect("sum 10 1.5"), "");
    EXPECT_EQ(shaded.expect("i 9 3"), "");
    EXPECT_EQ(shaded.expect("c 11 0.75 0.75 0.375"), "");
    EXPECT_EQ(shaded.expect("c 12 0.75 0.125 0.375"), "");
    EXPECT_EQ(shaded.expect("Ci 14 0.75 0.125 0.375"), "");
    EXPECT_NE(shaded.expect("Ci 14 0.75 0.126 0.375"), "");
    EXPECT_NE(shaded.expect("c 13 0.75 0.125 0.375"), "");
    ASSERT_EQ(shaded.story->points.size(), 1u);
    const PointStory& point = shaded.story->points[0];
    EXPECT_EQ(point.agreement, Agreement::Agrees) << point.why;
    EXPECT_EQ(point.Ci, (std::array<float, 3>{0.75f, 0.125f, 0.375f}));
    std::vector<std::vector<int32_t>> turns;
    for (const StoryStep& step : point.steps) {
        if (step.line == 10) turns.push_back(step.turns);
        if (step.line == 2) {
            EXPECT_EQ(step.inside, "function twice");
        }
    }
    EXPECT_EQ(turns, (std::vector<std::vector<int32_t>>{{0}, {1}, {2}}));
    std::map<std::string, bool> varying;
    for (const StoryStep& step : point.steps)
        for (const StoryVariable& v : step.changes) varying[v.name] = v.varying;
    EXPECT_FALSE(varying["k"]);
    EXPECT_FALSE(varying["sum"]);
    EXPECT_TRUE(varying["Ci"]);
}

TEST(Pixel, UnrollsTheLoopOverLights) {
    Shaded shaded(
        "surface a() {\n"
        "    color sum = 0;\n"
        "    vector n = normalize(vector faceforward(N, I));\n"
        "    illuminance(P, n, PI / 2) {\n"
        "        float cosine = normalize(L) . n;\n"
        "        sum += Cl * cosine;\n"
        "    }\n"
        "    Ci = sum; Oi = 1;\n"
        "}\n");
    ASSERT_TRUE(shaded.story);
    const PointStory& point = shaded.story->points.at(0);
    EXPECT_EQ(point.agreement, Agreement::Agrees) << point.why;
    std::map<std::string, std::vector<float>> now;
    std::array<double, 3> sum{};
    int turns = 0;
    for (const StoryStep& step : point.steps) {
        for (const StoryVariable& v : step.changes) now[v.name] = v.values;
        if (step.line == 4) {
            ++turns;
            EXPECT_NE(step.light, "");
            double along = 0, length = 0;
            for (size_t k = 0; k < 3; ++k) {
                along += double(now["L"][k]) * double(now["n"][k]);
                length += double(now["L"][k]) * double(now["L"][k]);
            }
            for (size_t k = 0; k < 3; ++k)
                sum[k] += double(now["Cl"][k]) * along / std::sqrt(length);
        }
        for (size_t k = 0; step.line == 6 && k < 3; ++k)
            EXPECT_NEAR(double(now["sum"][k]), sum[k], 1e-5);
    }
    EXPECT_GE(turns, 1);
    for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(double(point.Ci[k]), sum[k], 1e-5);
}

TEST(Pixel, MarksWhereANaNArises) {
    Shaded shaded(
        "surface a() {\n"
        "    float zero = comp(P, 0) * 0;\n"
        "    float big = 1e30 * 1e30 * (zero + 1);\n"
        "    float bad = 3 * (big - 2 * big);\n"
        "    Ci = bad; Oi = 1;\n"
        "}\n");
    ASSERT_TRUE(shaded.story);
    const PointStory& point = shaded.story->points.at(0);
    EXPECT_EQ(point.nan_line, 4) << to_json(*shaded.story);
    EXPECT_EQ(point.nan_column, 21);
    bool marked = false;
    for (const StoryStep& step : point.steps)
        for (const StoryVariable& v : step.changes) {
            EXPECT_TRUE(!v.nan || step.line >= 4) << v.name;
            marked = marked || v.nan;
        }
    EXPECT_TRUE(marked);
    EXPECT_EQ(point.agreement, Agreement::Agrees) << point.why;
}

TEST(Pixel, WithoutASurfaceNothingIsTold) {
    Played played("scenes/walker.dae");
    EXPECT_NE(played.script("variables /tmp/never.json"), "");
    EXPECT_NE(played.script("expect variable Ci 1 0 0 0"), "");
}

// A frame's measures are of its own size, and may be gone when a pixel is asked about.
TEST(Pixel, LeavesTheMeasuresOfTheFrameBeforeAlone) {
    OpenedScene opened(small_request(scene_path("scenes/tintoy.dae")));
    ASSERT_TRUE(opened.scene);
    const FrameSettings& settings = opened.settings;
    FirstHits first;
    PixelCosts costs;
    FrameSettings measured = settings;
    measured.insight.first = &first;
    measured.insight.costs = &costs;
    raytrace::Film film;
    FrameStats stats;
    ASSERT_TRUE(
        render_frame(*opened.scene, *opened.pose, 0, measured, film, stats, opened.diagnostics));
    const size_t pixels = size_t(settings.width) * size_t(settings.height);
    ASSERT_EQ(first.surface.size(), pixels);
    std::ranges::fill(first.surface, 12345u);
    const std::vector<float> took = costs.ns;
    int seen = 0;
    for (int x = 0; x < settings.width; x += 4)
        seen += !pixel_story(*opened.scene, *opened.pose, 0, settings, opened.diagnostics.files, x,
                             18, 0)
                     .points.empty();
    EXPECT_GE(seen, 5);
    EXPECT_EQ(std::ranges::count(first.surface, 12345u), ptrdiff_t(pixels));
    EXPECT_EQ(costs.ns, took);
}

// The sample's color is the picture's, and the reference comes to the same.
class PixelOf : public testing::TestWithParam<const char*> {};
TEST_P(PixelOf, AgreesWithThePicture) {
    SceneRequest request = small_request(scene_path(GetParam()), 1);
    request.quality.math = jit::math::Tier::Precise;
    Played played(request);
    ASSERT_TRUE(played.player.wait_idle(kLong));
    auto picture = played.player.picture();
    ASSERT_TRUE(picture && picture->refined);
    int points = 0, agreeing = 0;
    for (int y = 2; y < 36; y += 6)
        for (int x = 2; x < 64; x += 6) {
            const PixelStory* story = clicked(played, x, y);
            if (!story) continue;
            vec4 pixel = picture->film.at(x, y);
            for (int k = 0; k < 3; ++k) EXPECT_EQ(story->color[k], pixel[k]) << x << " " << y;
            for (const PointStory& point : story->points) {
                ++points;
                agreeing += point.agreement == Agreement::Agrees;
                EXPECT_TRUE(point.agreement == Agreement::Agrees ||
                            point.agreement == Agreement::Undecided)
                    << x << " " << y << " " << point.shader << ": " << point.why << " "
                    << point.Ci[0] << " " << point.reference_Ci[0];
                EXPECT_FALSE(point.steps.empty());
            }
        }
    std::cout << GetParam() << ": " << agreeing << " of " << points << " points agree\n";
    EXPECT_GE(points, 5);
    EXPECT_GE(agreeing, points * 9 / 10);
}
INSTANTIATE_TEST_SUITE_P(Scenes, PixelOf,
                         testing::Values("scenes/walker.dae", "scenes/tintoy.dae",
                                         "scenes/matte.dae", "scenes/court.dae",
                                         "scenes/attach.dae", "gltf/bender.glb"));

}  // namespace
}  // namespace kinora
