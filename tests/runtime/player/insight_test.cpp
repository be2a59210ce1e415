// tests/runtime/player/insight_test.cpp: lights one by one, and what each pixel cost.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "runtime/picture/compare/errors.h"
#include "runtime/player/display.h"
#include "runtime/player/thumbnails.h"
#include "tests/runtime/player/played.h"

namespace kinora {
namespace {

std::shared_ptr<const Picture> picture_of(Player& player) {
    EXPECT_TRUE(player.wait_idle(kLong));
    return player.picture();
}

// Light is a sum: where nothing shines by itself, what the lights send alone adds up to the
// picture.
TEST(Lights, AloneAddUpToThePicture) {
    SceneRequest request = small_request(scene_path("scenes/matte.dae"));
    request.quality.weak_lights = 0;  // no light is weak alone
    Played played(request);
    Player& player = played.player;
    const raytrace::Film whole = picture_of(player)->film;
    const std::vector<std::string> lights = player.scene()->lights;
    ASSERT_GE(lights.size(), 2u);
    std::vector<dvec3> sum(whole.rgba.size(), dvec3(0.0));
    for (const std::string& light : lights) {
        ASSERT_TRUE(player.run("light", {light}).done);
        const auto alone = picture_of(player);
        EXPECT_NE(alone->film.rgba, whole.rgba) << light;
        for (size_t k = 0; k < sum.size(); ++k) sum[k] += dvec3(alone->film.rgba[k]);
    }
    size_t lit = 0;
    for (size_t k = 0; k < sum.size(); ++k)
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(sum[k][c], whole.rgba[k][c], 1e-4 * (1 + whole.rgba[k][c])) << k;
            lit += whole.rgba[k][c] > 0.01f;
        }
    EXPECT_GT(lit, 300u);
    EXPECT_EQ(played.script("light all"), "");
    EXPECT_EQ(picture_of(player)->film.rgba, whole.rgba);
    EXPECT_NE(played.script("light moonn"), "");
}

// Each press goes to the next one, and after the last to all.
TEST(Lights, AreGoneThroughByTheKey) {
    Played played("scenes/court.dae");
    const std::vector<std::string> lights = played.player.scene()->lights;
    for (const std::string& light : lights) {
        EXPECT_EQ(played.script("key Shift+L"), "");
        EXPECT_EQ(played.player.state().picture.light, light);
    }
    EXPECT_EQ(played.script("key Shift+L"), "");
    EXPECT_EQ(played.player.state().picture.light, "");
}

// The pixels of row 18 whose material that is. A ray through an edge meets either side: such
// pixels are left out.
std::vector<size_t> row_of(Played& played, const std::string& material) {
    bool worn[64];
    for (int x = 0; x < 64; ++x) {
        EXPECT_EQ(played.script("click " + std::to_string(x) + " 18"), "");
        const PickedPixel& pixel = *played.player.state().selection.pixel;
        worn[x] = pixel.hit && pixel.material == material;
    }
    std::vector<size_t> pixels;
    for (int x = 1; x < 63; ++x)
        if (worn[x - 1] && worn[x] && worn[x + 1]) pixels.push_back(size_t(18 * 64 + x));
    return pixels;
}

double mean_of(const std::vector<float>& numbers, const std::vector<size_t>& pixels) {
    double sum = 0;
    for (size_t k : pixels) sum += double(numbers[k]);
    return sum / double(pixels.size());
}

// A shader that shoots five rays a point, and no light's: nothing else can shoot any there.
TEST(Costs, CountTheRaysAndPointsOfEachPixel) {
    Played played("scenes/matte.dae");
    Player& player = played.player;
    EXPECT_EQ(played.script("select_material bright; edit"), "");
    ASSERT_TRUE(player
                    .run("set_text", {"surface a(float Kd = 1) { color c = 0; float k;"
                                      " for (k = 0; k < 5; k += 1) c += transmission(P, P + N);"
                                      " Ci = c; Oi = 1; }"})
                    .done);
    EXPECT_EQ(played.script("aov rays"), "");
    const auto picture = picture_of(player);
    const std::vector<float> rays = cost_numbers(picture->costs, "rays");
    const std::vector<float> points = cost_numbers(picture->costs, "samples");
    const std::vector<float> lanes = cost_numbers(picture->costs, "lanes");
    ASSERT_EQ(rays.size(), size_t(64 * 36));
    const std::vector<size_t> bright = row_of(played, "bright");
    ASSERT_GT(bright.size(), 4u);
    for (size_t k : bright) EXPECT_FLOAT_EQ(rays[k], 5) << k;
    EXPECT_EQ(played.script("aov surface"), "");
    const auto guide = picture_of(player);
    for (size_t k = 0; k < points.size(); ++k) {
        EXPECT_EQ(points[k], guide->guide.surface[k] == kNone ? 0 : 1) << k;
        EXPECT_LE(lanes[k], 1) << k;
        EXPECT_EQ(lanes[k] > 0, points[k] > 0) << k;
    }
    EXPECT_TRUE(guide->costs.empty());  // nobody asks any more
    EXPECT_EQ(guide->film.rgba, picture->film.rgba);
}

TEST(Costs, AreHighWhereTheShaderIsSlow) {
    Played played("scenes/matte.dae");
    Player& player = played.player;
    const std::vector<size_t> bright = row_of(played, "bright");
    ASSERT_GT(bright.size(), 4u);
    EXPECT_EQ(played.script("select_material bright; aov shading_ns"), "");
    const double before = mean_of(picture_of(player)->costs.ns, bright);
    EXPECT_EQ(played.script("edit"), "");
    ASSERT_TRUE(player
                    .run("set_text", {"surface a(float Kd = 1) { float k, s = 0;"
                                      " for (k = 0; k < 5000; k += 1) s += noise(P * k);"
                                      " Ci = s; Oi = 1; }"})
                    .done);
    const auto slow = picture_of(player);
    EXPECT_GT(mean_of(slow->costs.ns, bright), 5 * before);
    // The hottest is red, where there is nothing the picture is black.
    const std::vector<float>& ns = slow->costs.ns;
    const size_t hottest = size_t(std::ranges::max_element(ns) - ns.begin());
    const uint8_t* hot = &slow->rgba[4 * hottest];
    EXPECT_GT(hot[0], 200);
    EXPECT_LT(hot[2], 60);
    EXPECT_EQ(slow->rgba[0], 0);
}

// The picture is the one of kinora-render --shader.
TEST(Library, AClickBindsWhatItsPictureShows) {
    Played played("scenes/matte.dae");
    Player& player = played.player;
    EXPECT_EQ(played.script("select_material bright; show_library"), "");
    EXPECT_TRUE(player.wait_idle(kLong));
    const auto made = player.thumbnails();
    const std::vector<std::string> ours = shaders_to_choose();
    ASSERT_EQ(made.size(), ours.size());
    std::set<std::vector<uint8_t>> pictures;
    for (size_t k = 0; k < made.size(); ++k) {
        EXPECT_EQ(made[k]->shader, ours[k]);
        pictures.insert(made[k]->rgba);
    }
    EXPECT_GT(pictures.size(), ours.size() / 2);
    SceneRequest request = small_request(scene_path("scenes/matte.dae"));
    request.shaders.emplace_back("bright", "metal");
    Played dressed(request);
    EXPECT_EQ(played.script("bind metal"), "");
    EXPECT_EQ(picture_of(player)->film.rgba, picture_of(dressed.player)->film.rgba);
    EXPECT_EQ(player.shader().material, "bright");
    EXPECT_NE(player.shader().text.find("surface metal"), std::string::npos);
    EXPECT_EQ(played.script("undo"), "");
    EXPECT_NE(picture_of(player)->film.rgba, picture_of(dressed.player)->film.rgba);
    EXPECT_NE(played.script("bind mettal"), "");
    EXPECT_EQ(played.script("show_library"), "");
    EXPECT_TRUE(player.thumbnails().empty());
}

// phase goes from 0 at 0.041667 s to 1 at 2 s, and is kept outside.
TEST(Curves, AreWhatTheKeysSay) {
    Played played("scenes/tintoy.dae");
    const auto scene = played.player.scene();
    const double begin = scene->first / scene->frame_rate, end = scene->last / scene->frame_rate;
    size_t found = 0;
    for (const MaterialInfo& material : scene->materials)
        for (const ShaderParamInfo& param : material.params) {
            EXPECT_EQ(param.curve.size(), param.animated ? kCurvePoints * param.numbers.size() : 0)
                << material.id << " " << param.name;
            if (material.id != "filament-material" || param.name != "phase") continue;
            ++found;
            ASSERT_EQ(param.curve.size(), kCurvePoints);
            for (size_t k = 0; k < kCurvePoints; ++k) {
                const double time = begin + (end - begin) * double(k) / double(kCurvePoints - 1);
                const double share = (time - 0.041667) / (2 - 0.041667);
                EXPECT_NEAR(param.curve[k], std::clamp(share, 0.0, 1.0), 1e-5) << k;
            }
        }
    EXPECT_EQ(found, 1u);
}

// As kinora-render --quality has it: the same picture.
TEST(Quality, IsThatOfTheOption) {
    SceneRequest request = small_request(scene_path("scenes/matte.dae"));
    request.quality = *find_quality("draft");
    Played draft(request);
    request.quality = *find_quality("preview");
    Played preview(request);
    const std::vector<vec4> coarse = picture_of(draft.player)->film.rgba;
    const std::vector<vec4> fine = picture_of(preview.player)->film.rgba;
    ASSERT_NE(coarse, fine);
    EXPECT_EQ(draft.script("orbit 0 0; camera; quality preview"), "");
    EXPECT_EQ(picture_of(draft.player)->film.rgba, fine);
    EXPECT_EQ(draft.player.state().picture.quality, "preview");
    EXPECT_NE(draft.script("quality superb"), "");
}

// As kinora-render --gi has it: the same picture, and the words of a session.
TEST(IndirectLightCommand, IsThatOfTheOption) {
    SceneRequest request = small_request(scene_path("scenes/court.dae"));
    Played without(request);
    request.gi = 2;
    Played with(request);
    EXPECT_EQ(with.player.state().picture.bounces, 2u);
    const std::vector<vec4> plain = picture_of(without.player)->film.rgba;
    const std::vector<vec4> lit = picture_of(with.player)->film.rgba;
    ASSERT_NE(plain, lit);
    EXPECT_EQ(without.script("orbit 0 0; camera; gi"), "");
    EXPECT_EQ(picture_of(without.player)->film.rgba, lit);
    EXPECT_EQ(without.player.state().picture.bounces, 2u);
    EXPECT_EQ(without.script("gi"), "");
    EXPECT_EQ(picture_of(without.player)->film.rgba, plain);
    EXPECT_EQ(without.script("gi 2; orbit 0 0; camera"), "");
    EXPECT_EQ(picture_of(without.player)->film.rgba, lit);
    for (const char* wrong : {"gi -1", "gi 1.5", "gi 65"}) EXPECT_NE(without.script(wrong), "");
}

// Each stop's picture against the best of the same view, as kinora-render's own comparison says.
TEST(Quality, StopsHaveTheirErrors) {
    SceneRequest request = small_request(scene_path("scenes/matte.dae"));
    request.quality = *find_quality("draft");
    Played played(request);
    Player& player = played.player;
    EXPECT_EQ(played.script("show_quality; quality quick"), "");
    std::map<std::string, raytrace::Film> films;
    films["quick"] = picture_of(player)->film;
    EXPECT_FALSE(player.state().picture.refine);
    for (const char* name : {"draft", "preview"}) {
        ASSERT_TRUE(player.run("quality", {name}).done);
        films[name] = picture_of(player)->film;
        EXPECT_TRUE(player.state().picture.refine);
    }
    const std::vector<TradeStop> stops = player.state().picture.stops;
    ASSERT_EQ(stops.size(), 3u);
    auto view = [](const raytrace::Film& film) {
        return PictureView{film.width, film.height, film.rgba};
    };
    for (size_t k = 0; k < 2; ++k) {
        EXPECT_EQ(stops[k].against, "preview");
        EXPECT_GT(stops[k].ms, 0);
        const auto errors = picture_errors(view(films[stops[k].name]), view(films["preview"]));
        EXPECT_NEAR(stops[k].rmse, errors.rmse, 1e-12) << stops[k].name;
        EXPECT_NEAR(stops[k].flip, errors.flip, 1e-12) << stops[k].name;
        EXPECT_GT(stops[k].flip, 0) << stops[k].name;
    }
    EXPECT_EQ(stops[2].name, "preview");
    EXPECT_EQ(stops[2].against, "");
    EXPECT_EQ(played.script("orbit 3 0"), "");  // another view: nothing of the one before is told
    picture_of(player);
    ASSERT_EQ(player.state().picture.stops.size(), 1u);
    EXPECT_EQ(player.state().picture.stops[0].name, "preview");
    EXPECT_EQ(played.script("show_quality"), "");
    picture_of(player);
    EXPECT_TRUE(player.state().picture.stops.empty());
}

// What the colors of numbers stand for, and the number under a pointer.
TEST(Numbers, AreThoseOfThePlane) {
    Played played("scenes/matte.dae");
    Player& player = played.player;
    EXPECT_FALSE(picture_of(player)->numbers);
    EXPECT_EQ(played.script("aov depth"), "");
    const auto depth = picture_of(player);
    ASSERT_TRUE(depth->numbers);
    float low = INFINITY, high = -INFINITY;
    for (size_t k = 0; k < depth->guide.depth.size(); ++k) {
        const float d = depth->guide.depth[k];
        if (std::isfinite(d)) low = std::min(low, d), high = std::max(high, d);
        const double x = (double(k % 64) + 0.5) / 64, y = (double(k / 64) + 0.5) / 36;
        const std::vector<float> shown = shown_numbers(*depth, "depth", x, y);
        if (depth->guide.surface[k] == kNone)
            EXPECT_TRUE(shown.empty()) << k;
        else
            EXPECT_EQ(shown, std::vector<float>{d}) << k;
    }
    EXPECT_EQ(depth->numbers->low, double(low));
    EXPECT_EQ(depth->numbers->high, double(high));
    EXPECT_FALSE(depth->numbers->in_color);
    EXPECT_EQ(played.script("false_color"), "");
    EXPECT_TRUE(picture_of(player)->numbers->in_color);
    EXPECT_EQ(played.script("aov Ng"), "");
    EXPECT_EQ(shown_numbers(*picture_of(player), "Ng", 0.5, 0.5).size(), 3u);
    EXPECT_EQ(played.script("aov \"\""), "");
    EXPECT_EQ(picture_of(player)->numbers->high, 1);
}

}  // namespace
}  // namespace kinora
