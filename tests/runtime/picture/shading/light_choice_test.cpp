// tests/runtime/picture/shading/light_choice_test.cpp: pictures of points that choose a few of many
// lights, against pictures with all of them.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "runtime/kinora/kinora.h"
#include "tests/runtime/scene/gltf/gltf_text.h"

namespace kinora {
namespace {

using Random = std::mt19937;
double uniform(Random& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

// Lamps over the floor that the default camera sees, below the camera.
using Kind = std::function<std::string(Random&)>;
std::string point_of(double strength) {
    return fmt::format(
        "<point><color>{0} {0} {1}</color><constant_attenuation>0</constant_attenuation>"
        "<quadratic_attenuation>1</quadratic_attenuation></point>",
        strength, 0.5 * strength);
}
std::string random_point(Random& random) {
    return point_of(0.02 * std::pow(10.0, uniform(random, -2, 1)));
}
std::string random_spot(Random& random) {
    return fmt::format(
        "<spot><color>0.05 0.05 0.05</color><constant_attenuation>0</constant_attenuation>"
        "<quadratic_attenuation>1</quadratic_attenuation><falloff_angle>{}</falloff_angle>"
        "<falloff_exponent>{}</falloff_exponent></spot>",
        uniform(random, 30, 150), uniform(random, 0, 3));
}
void add_lamps(SceneText& scene, int count, const Kind& kind, uint32_t seed = 1,
               const std::string& extra = "") {
    Random random(seed);
    for (int k = 0; k < count; ++k) {
        const std::string what = kind(random);
        const std::string place = fmt::format(
            "<translate>{} {} {}</translate><rotate>1 0 0 {}</rotate>", uniform(random, -1.5, 1.5),
            uniform(random, -1.5, 1.5), uniform(random, 0.2, 2), uniform(random, -40, 40));
        scene.light(fmt::format("lamp{}", k), what, place, extra);
    }
}

// A floor with a block on it.
SceneText block_scene(const std::string& shader) {
    SceneText scene = floor_scene(shader);
    scene.cube("block", 0.3).place("block", "floor-look", "<translate>0.2 0.1 0.2</translate>");
    return scene;
}

SceneOptions choosing(ChosenLights choice) {
    SceneOptions options;
    options.quality.light_choice = choice;
    options.quality.weak_lights = 0;
    return options;
}

constexpr int kSize = 8;

// Per pixel and component: the mean of what a choice shows more than all lights do, by its error.
void expect_the_same_mean(Rendering& all, Rendering& some) {
    constexpr int kSeeds = 200;
    ASSERT_FALSE(some.diagnostics.has_errors()) << some.findings();
    std::vector<dvec3> sum(kSize * kSize), squares(kSize * kSize);
    double light = 0;
    for (uint32_t seed = 1; seed <= kSeeds; ++seed) {
        all.settings.integrator.seed = some.settings.integrator.seed = seed;
        all.frame(kSize, kSize);
        some.frame(kSize, kSize);
        for (int p = 0; p < kSize * kSize; ++p) {
            const dvec3 more =
                dvec3(some.color(p % kSize, p / kSize)) - dvec3(all.color(p % kSize, p / kSize));
            sum[p] += more;
            squares[p] += more * more;
            light += double(all.color(p % kSize, p / kSize).x);
        }
    }
    const double mean_light = light / (kSeeds * kSize * kSize);
    EXPECT_GT(mean_light, 0.01);
    double noise = 0, worst = 0;
    for (int p = 0; p < kSize * kSize; ++p)
        for (int k = 0; k < 3; ++k) {
            const double mean = sum[p][k] / kSeeds;
            const double error =
                std::sqrt(std::max(squares[p][k] / kSeeds - mean * mean, 0.0) / kSeeds);
            noise += error;
            // Rounding alone, where all that matter are chosen.
            worst = std::max(worst, std::abs(mean) / (error + 1e-6 * mean_light));
        }
    EXPECT_LT(worst, 4);
    EXPECT_GT(noise, 0);  // something was chosen
}

void expect_the_same_mean(const std::string& text, ChosenLights choice) {
    Rendering all(text, choosing(ChosenLights::All)), some(text, choosing(choice));
    expect_the_same_mean(all, some);
}

TEST(LightChoice, HasTheMeanOfAllLights) {
    SceneText scene = block_scene(kMatte);
    add_lamps(scene, 60, random_point);
    expect_the_same_mean(scene.text(), ChosenLights::Four);
    SceneText spots = block_scene(kMatte);
    add_lamps(spots, 60, random_spot);
    expect_the_same_mean(spots.text(), ChosenLights::Two);
}

// Specular light, messages, several groups: some lamps have no shadows.
TEST(LightChoice, HasTheMeanOfAllThatIsReadOfLights) {
    SceneText scene = block_scene(
        "surface s() { normal Nf = faceforward(normalize(N), I); float strength = 0; color c = 0;"
        "  Oi = 1; illuminance(P, Nf, PI / 2) { lightsource(\"quadratic_attenuation\", strength);"
        "    c += strength * Cl * (normalize(L) . Nf); }"
        "  Ci = c + specular(Nf, -normalize(I), 0.1); }");
    add_lamps(scene, 30, random_point);
    SceneText more;
    add_lamps(more, 30, random_point, 2, rsl_extra("<shadows>0</shadows>"));
    auto renamed = [](std::string text) {
        for (size_t at = 0; (at = text.find("lamp", at)) != std::string::npos; at += 8)
            text.insert(at, "more");
        return text;
    };
    scene.lights += renamed(more.lights);
    scene.nodes += renamed(more.nodes);
    expect_the_same_mean(scene.text(), ChosenLights::Four);
}

TEST(LightChoice, HasTheMeanOfAllLightsWithinVolumes) {
    SceneText scene = floor_scene(kMatte);
    scene.scene_effect("fog-fx",
                       "volume fog() { vector way = I / 4; float k; color c = 0; Oi = Oi;"
                       "  for (k = 0; k < 4; k += 1) { point here = P - (k + 0.5) * way;"
                       "    illuminance (here) { c += Cl * 0.02; } }"
                       "  Ci += c; }",
                       "<shader stage=\"VOLUME\"/>");
    add_lamps(scene, 40, random_point);
    expect_the_same_mean(scene.text(), ChosenLights::Four);
}

// Points and spots of glTF, some with a range.
TEST(LightChoice, HasTheMeanOfAllLightsOfGltf) {
    GltfText g;
    g.node(
        {{"mesh", g.square(g.material({{"pbrMetallicRoughness", {{"roughnessFactor", 1}}}}), 2)}});
    g.json["extensionsUsed"] = {"KHR_lights_punctual"};
    auto& lights = g.json["extensions"]["KHR_lights_punctual"]["lights"];
    Random random(3);
    for (int k = 0; k < 40; ++k) {
        nlohmann::json light = {{"type", k % 2 ? "spot" : "point"},
                                {"intensity", std::pow(10.0, uniform(random, 0, 2))}};
        if (k % 2)
            light["spot"] = {{"innerConeAngle", uniform(random, 0, 0.3)},
                             {"outerConeAngle", uniform(random, 0.4, 1.2)}};
        if (k % 3) light["range"] = uniform(random, 1, 3);
        lights.push_back(light);
        g.node({{"translation",
                 {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, 0.3, 1.5)}},
                {"extensions", {{"KHR_lights_punctual", {{"light", k}}}}}});
    }
    const auto path = std::filesystem::temp_directory_path() /
                      fmt::format("kinora_light_choice_{}.gltf", getpid());
    std::ofstream(path) << g.gltf();
    auto all = Rendering::of_file(path, choosing(ChosenLights::All)),
         some = Rendering::of_file(path, choosing(ChosenLights::Four));
    std::filesystem::remove(path);
    expect_the_same_mean(*all, *some);
}

raytrace::Film rib_picture(const std::string& text, ChosenLights choice) {
    SceneRequest request;
    request.scene = "x.rib";
    request.quality = *find_quality(kDefaultQuality);
    request.quality.light_choice = choice;
    request.quality.weak_lights = 0;
    request.lights = LightSet::Scene;
    request.displays = true;
    OpenScene scene(request);
    raytrace::Film film;
    EXPECT_EQ(scene.open(text), SceneError::None);
    EXPECT_TRUE(scene.render(0, film));
    return film;
}

// Whose lamps stand where their parameters say, over the pixels of one picture.
TEST(LightChoice, HasTheMeanOfAllLightsOfRenderMan) {
    std::string text =
        "Format 32 32 1 PixelSamples 4 4 PixelFilter \"box\" 1 1 Display \"x\" \"file\" \"rgba\" "
        "WorldBegin Surface \"matte\" ";
    Random random(4);
    for (int k = 0; k < 40; ++k) {
        const std::string from = fmt::format("{} {} {}", uniform(random, -1, 1),
                                             uniform(random, -1, 1), uniform(random, 1.5, 2.7));
        text += fmt::format("LightSource \"{}\" {} \"intensity\" {} \"from\" [{}] ",
                            k % 2 ? "spotlight" : "pointlight", k + 1,
                            0.02 * std::pow(10.0, uniform(random, -1, 1)), from);
        if (k % 2)
            text += fmt::format("\"to\" [{} {} 3] \"coneangle\" {} \"beamdistribution\" {} ",
                                uniform(random, -1, 1), uniform(random, -1, 1),
                                uniform(random, 0.3, 1.2), uniform(random, 0, 8));
    }
    text += "Polygon \"P\" [-1 -1 3 -1 1 3 1 1 3 1 -1 3] WorldEnd";
    const raytrace::Film all = rib_picture(text, ChosenLights::All),
                         some = rib_picture(text, ChosenLights::Four);
    double sum = 0, squares = 0, light = 0;
    for (size_t p = 0; p < all.rgba.size(); ++p) {
        const double more = double(some.rgba[p].x) - double(all.rgba[p].x);
        sum += more;
        squares += more * more;
        light += double(all.rgba[p].x);
    }
    const double count = double(all.rgba.size()), mean = sum / count;
    EXPECT_GT(light / count, 0.01);
    EXPECT_GT(squares, 0);
    EXPECT_LT(std::abs(mean), 4 * std::sqrt(squares) / count);
}

bool same_as_all(const std::string& text, ChosenLights choice) {
    Rendering all(text, choosing(ChosenLights::All)), some(text, choosing(choice));
    all.frame(kSize, kSize);
    some.frame(kSize, kSize);
    float light = 0;
    for (int p = 0; p < kSize * kSize; ++p) light += all.color(p % kSize, p / kSize).x;
    EXPECT_GT(light, 0) << all.findings();
    return same_bytes(all.film, some.film);
}

TEST(LightChoice, LeavesScenesOfFewLightsAsTheyAre) {
    for (const int lamps : {1, 10, 16}) {
        SceneText scene = block_scene(kMatte);
        add_lamps(scene, lamps, random_point);
        EXPECT_TRUE(same_as_all(scene.text(), ChosenLights::Auto)) << lamps;
    }
    SceneText scene = block_scene(kMatte);
    add_lamps(scene, 17, random_point);
    EXPECT_FALSE(same_as_all(scene.text(), ChosenLights::Auto));
}

// What asks which light it is has all of them.
TEST(LightChoice, IsNotForShadersThatTellLightsApart) {
    SceneText scene = block_scene(
        "surface s() { color c = 0; string name = \"quadratic_attenuation\"; float q = 0; Oi = 1;"
        "  if (s > 2) name = \"intensity\";"
        "  illuminance(P, N, PI / 2) { lightsource(name, q); c += q * Cl; } Ci = c; }");
    add_lamps(scene, 40, random_point);
    EXPECT_TRUE(same_as_all(scene.text(), ChosenLights::Four));
}

// Lights whose shaders the choice does not know shine as before.
TEST(LightChoice, LeavesOtherShadersAsTheyAre) {
    SceneText scene = block_scene(kMatte);
    for (int k = 0; k < 40; ++k)
        scene.rsl_light(fmt::format("l{}", k),
                        "light l() { illuminate(P) { Cl = 0.05 * length(L); } }",
                        fmt::format("<translate>{} 0 1</translate>", 0.05 * k - 1));
    EXPECT_TRUE(same_as_all(scene.text(), ChosenLights::Four));
}

// What cannot be chosen shines beside what is.
TEST(LightChoice, AddsToOtherLights) {
    SceneText scene = block_scene(kMatte);
    add_lamps(scene, 40, random_point);
    scene.light("sun", kSun);
    scene.light("sky", "<ambient><color>0.1 0.1 0.1</color></ambient>");
    expect_the_same_mean(scene.text(), ChosenLights::Four);
}

TEST(LightChoice, OfLampsWithoutStrengthIsBlack) {
    SceneText scene = floor_scene(kMatte);
    add_lamps(scene, 40, [](Random&) { return point_of(0); });
    Rendering r(scene.text());
    r.frame(kSize, kSize);
    EXPECT_EQ(r.color(4, 4), vec3(0.0f)) << r.findings();
}

// Lamps in the floor light the block alone, and that as all of them do; the floor stays a number.
TEST(LightChoice, EndsAtALampsOwnPlace) {
    SceneText scene = block_scene(kMatte);
    Random random(5);
    for (int k = 0; k < 64; ++k)
        scene.light(fmt::format("in{}", k), point_of(0.05),
                    fmt::format("<translate>{} {} 0</translate>", (k % 8 + 0.5) / 4 - 1,
                                (k / 8 + 0.5) / 4 - 1));
    Rendering all(scene.text(), choosing(ChosenLights::All)),
        some(scene.text(), choosing(ChosenLights::Eight));
    all.frame(kSize, kSize);
    some.frame(kSize, kSize);
    for (int p = 0; p < kSize * kSize; ++p)
        if (std::isfinite(all.color(p % kSize, p / kSize).x)) {
            EXPECT_TRUE(std::isfinite(some.color(p % kSize, p / kSize).x)) << p;
        }
}

// Frames of lamps that move choose by where they are then.
TEST(LightChoice, FollowsLampsThatMove) {
    SceneText scene = block_scene(kMatte);
    add_lamps(scene, 40, random_point);
    Rendering moved(scene.text(), choosing(ChosenLights::Eight));
    moved.frame(kSize, kSize, 0);
    const vec3 before = moved.color(4, 4);
    moved.frame(kSize, kSize, 1);
    EXPECT_EQ(moved.color(4, 4), before);  // nothing moves
}

// A hundred thousand lamps: a picture of all would cost a hundred thousand kernels a point.
TEST(LightChoice, TakesAHundredThousandLights) {
    SceneText scene = floor_scene(kMatte);
    scene.light("lamp", point_of(1e-5));
    const std::string node = "<instance_light url=\"#lamp\"/>";
    Random random(9);
    for (int k = 0; k < 100'000; ++k)
        scene.nodes +=
            fmt::format("<node><translate>{} {} {}</translate>{}</node>", uniform(random, -3, 3),
                        uniform(random, -3, 3), uniform(random, 0.5, 2), node);
    Rendering r(scene.text());
    const auto begin = std::chrono::steady_clock::now();
    r.frame(32, 32);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    EXPECT_GT(r.color(16, 16).x, 0.005) << r.findings();
    EXPECT_LT(r.stats.light_points, 32u * 32 * 9);
    EXPECT_LT(seconds.count(), 20);
}

}  // namespace
}  // namespace kinora
