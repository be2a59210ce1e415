// tests/runtime/aovs_test.cpp: built-in AOVs of materials of any kind, against places worked out
// by hand.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "jit/target.h"
#include "runtime/kinora/aov_texts.h"
#include "runtime/scene/aovs/cryptomatte.h"
#include "tests/runtime/scene_text.h"

namespace kinora {
namespace {

// A square of the left half of the picture, its right edge at x = 0, 2 nearer than z = 0, turned
// about y by 60 degrees so that its far edge is at x = -1. A fixed material and no light.
constexpr const char* kTurned =
    "<translate>-0.5 0 2</translate><rotate>0 1 0 60</rotate><scale>2 2 2</scale>";
SceneText fixed_scene() {
    SceneText scene;
    scene.effects += R"(<effect id="f-fx"><profile_COMMON><technique sid="t"><lambert>
        <diffuse><color>1 0 0 1</color></diffuse></lambert></technique></profile_COMMON></effect>)";
    scene.materials += R"(<material id="f"><instance_effect url="#f-fx"/></material>)";
    return scene.square("s", 0.5).place("s", "f", kTurned, "turned");
}

std::unique_ptr<Rendering> taken(const SceneText& scene, std::vector<std::string> aovs,
                                 int samples = 1) {
    SceneOptions options;
    options.aovs = std::move(aovs);
    auto r = std::make_unique<Rendering>(scene.text(), options);
    r->settings.integrator.samples_per_pixel = samples;
    r->frame();
    return r;
}

double number(const Rendering& r, const std::string& name, int x, int y) {
    auto found = std::ranges::find(r.film.aovs, name, &raytrace::AovPlane::name);
    EXPECT_NE(found, r.film.aovs.end()) << name;
    return found == r.film.aovs.end() ? 0 : double(found->values[size_t(y) * 16 + size_t(x)]);
}

TEST(Aovs, AreThereWithoutALineOfRsl) {
    const auto taken_frame =
        taken(fixed_scene(), {"P", "N", "Ng", "uv", "st", "dPdu", "Z", "depth"});
    const Rendering& r = *taken_frame;
    EXPECT_EQ(r.findings(), "");
    const double c = std::cos(radians(60.0)), s = std::sin(radians(60.0));
    for (int y : {1, 8, 14})
        for (int x : {1, 4, 7}) {
            const dvec2 place = r.place(x, y);
            // The square's own coordinates; z of the world is 2 - s * across.
            const double across = (place.x + 0.5) / c, up = place.y;
            const double distance = 10 - (2 - s * across);
            const std::pair<const char*, double> want[] = {{"P.X", place.x},
                                                           {"P.Y", place.y},
                                                           {"P.Z", distance},
                                                           {"Z", distance},
                                                           {"depth", distance},
                                                           {"N.X", s},
                                                           {"N.Y", 0},
                                                           {"N.Z", -c},
                                                           {"Ng.X", s},
                                                           {"Ng.Y", 0},
                                                           {"Ng.Z", -c},
                                                           {"st.s", across / 2 + 0.5},
                                                           {"st.t", 0.5 + up / 2},
                                                           {"dPdu.Y", 0}};
            for (const auto& [name, value] : want)
                EXPECT_NEAR(number(r, name, x, y), value, 2e-5) << name << " at " << x << ' ' << y;
            EXPECT_NEAR(number(r, "dPdu.X", x, y) * s, number(r, "dPdu.Z", x, y) * c, 1e-5);
        }
    for (const raytrace::AovPlane& plane : r.film.aovs) {
        const bool far = plane.name == "Z" || plane.name == "depth";
        EXPECT_EQ(plane.values[8 * 16 + 12], far ? raytrace::kNoDepth : 0) << plane.name;
    }
}

TEST(Aovs, OfIdsTellNodesMaterialsAndBothApart) {
    SceneText scene = fixed_scene();
    scene.look("g", "surface g() { Ci = 1; }")
        .place("s", "g", "<translate>0.5 0.5 0</translate>", "above")
        .place("s", "f", "<translate>0.5 -0.5 0</translate>", "below");
    const auto taken_frame = taken(scene, {"id", "object_id", "material_id"}, 16);
    const Rendering& r = *taken_frame;
    struct Place {
        int x, y;
        const char *object, *material;
    };
    const Place places[] = {{4, 8, "turned", "f"}, {12, 4, "above", "g"}, {12, 12, "below", "f"}};
    const auto texts = aov_texts(*r.scene);
    auto named = [&](const std::string& layer, const Place& place, const std::string& name) {
        const double id = number(r, layer, place.x, place.y);
        auto text = std::ranges::find(texts, "kinora/" + layer,
                                      &std::pair<std::string, std::string>::first);
        ASSERT_NE(text, texts.end());
        EXPECT_NE(text->second.find(fmt::format("\"{}\":\"{}\"", id, name)), std::string::npos)
            << layer << ' ' << id << ' ' << text->second;
    };
    for (const Place& place : places) {
        named("object_id", place, place.object);
        named("material_id", place, place.material);
        named("id", place, fmt::format("{} {}", place.object, place.material));
    }
    // No pixel has a number that is no surface's, at edges either.
    for (const raytrace::AovPlane& plane : r.film.aovs)
        for (float value : plane.values) EXPECT_EQ(value, std::round(value)) << plane.name;
}

// The left edge of the sheet runs through the middle of the pixels of column 3.
TEST(Aovs, OfHalfCoveredPixelsAreOfOneSample) {
    SceneText scene;
    scene.square("s", 1)
        .look("l", "surface l() { Ci = 1; }")
        .place("s", "l", "<translate>0.4375 0 3</translate>");
    const auto taken_frame = taken(scene, {"Z", "object_id", "P:filter", "N:average"}, 64);
    const Rendering& r = *taken_frame;
    size_t near = 0;
    for (int y = 0; y < 16; ++y) {
        EXPECT_NEAR(r.film.at(3, y).w, 0.5, 0.05);
        const double z = number(r, "Z", 3, y);
        EXPECT_TRUE(std::abs(z - 7) < 1e-5 || z == double(raytrace::kNoDepth)) << z;
        EXPECT_EQ(number(r, "object_id", 3, y) > 0, std::abs(z - 7) < 1e-5);
        near += std::abs(z - 7) < 1e-5;
        EXPECT_NEAR(number(r, "P.Z", 3, y), 7 * double(r.film.at(3, y).w), 1e-4);
        EXPECT_NEAR(number(r, "N.Z", 3, y), -1, 1e-5);
    }
    EXPECT_GT(near, 0u);
    EXPECT_LT(near, 16u);
}

TEST(Aovs, OfShadersGoBeforeThoseOfTheirName) {
    SceneText scene;
    scene.square("s", 1)
        .look("l", "surface l(output varying float depth = 0;) { depth = 3; Ci = 1; }")
        .place("s", "l");
    const auto taken_frame = taken(scene, {"depth"});
    const Rendering& r = *taken_frame;
    EXPECT_EQ(r.count("AOV_OF_SHADER"), 1) << r.findings();
    EXPECT_NEAR(number(r, "depth", 8, 8), 3, 1e-6);
}

TEST(Aovs, OfAllAreTheRowsAndTheOutputsOfShaders) {
    SceneText scene;
    scene.square("s", 1)
        .look("l", "surface l(output varying color glow[2] = {1, 2};) { Ci = 1; }")
        .place("s", "l");
    const auto taken_frame = taken(scene, {"all"});
    const Rendering& r = *taken_frame;
    EXPECT_EQ(r.findings(), "");
    size_t channels = 6;
    for (const AovRow& row : aov_rows()) channels += channel_names(row).size();
    EXPECT_EQ(r.film.aovs.size(), channels);
    EXPECT_NEAR(number(r, "glow.1.G", 8, 8), 2, 1e-6);
    EXPECT_EQ(number(r, "samples", 8, 8), 1);
}

TEST(Aovs, OfUnknownFiltersAndTwiceTheSameNameAreFindings) {
    const auto taken_frame = taken(fixed_scene(), {"Z:mode", "P:min", "P", "nosuch:max"});
    const Rendering& r = *taken_frame;
    EXPECT_EQ(r.count("AOV_FILTER_UNKNOWN"), 1) << r.findings();
    EXPECT_EQ(r.count("AOV_REPEATED"), 1) << r.findings();
    EXPECT_EQ(r.count("AOV_UNKNOWN"), 1) << r.findings();
    EXPECT_EQ(r.film.aovs.size(), 3u);
}

void expect_color(const Rendering& r, const std::string& layer, int x, int y, vec3 want) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(number(r, fmt::format("{}.{}", layer, "RGB"[c]), x, y), double(want[c]), 1e-6)
            << layer << '.' << "RGB"[c];
}

// No lamp shines; the sheets are a mirror, a glowing plastic and a fixed material.
TEST(Aovs, OfAlbedoAndEmissionAreOfTheShaderInOtherLight) {
    SceneText scene = fixed_scene();
    scene
        .look("mirror",
              "surface m() { Ci = trace(P, vector \"camera\" (0, 0, -1)) + (1 - occlusion(P, N, "
              "4)) * color(.1, .2, .3); }")
        .look("plastic",
              "surface p() { normal Nf = faceforward(normalize(N), I); printf(\"once\\n\");"
              " Ci = color(.5, .25, .125) * (ambient() + diffuse(Nf)) +"
              "      specular(Nf, -normalize(I), .1) + color(0, .5, 2); }")
        .place("s", "mirror", "<translate>0.5 0.5 0</translate>")
        .place("s", "plastic", "<translate>0.5 -0.5 0</translate><rotate>0 1 0 150</rotate>")
        .light("everywhere", "<ambient><color>1 1 1</color></ambient>");
    const auto taken_frame = taken(scene, {"albedo", "emission"});
    const Rendering& r = *taken_frame;
    expect_color(r, "emission", 12, 12, {0, .5, 2});
    expect_color(r, "albedo", 12, 12, {.5, .25, .125});
    expect_color(r, "emission", 12, 4, {.1, .2, .3});
    expect_color(r, "albedo", 12, 4, {0, 0, 0});
    expect_color(r, "albedo", 4, 8, {1, 0, 0});
    expect_color(r, "emission", 4, 8, {0, 0, 0});
    expect_color(r, "albedo", 12, 0, {0, 0, 0});
    EXPECT_GT(r.film.at(12, 12).x, 0.4f);  // the ambient light is of the picture alone
}

// Hashes that the algorithm's author and others publish.
TEST(Cryptomatte, HashesNamesAsOthersDo) {
    EXPECT_EQ(murmur_hash_3(""), 0u);
    EXPECT_EQ(murmur_hash_3("hello"), 0x248bfa47u);
    EXPECT_EQ(murmur_hash_3("hello, world"), 0x149bbb7fu);
    EXPECT_EQ(murmur_hash_3("The quick brown fox jumps over the lazy dog"), 0x2e4ff723u);
    // Of a thousand names some would be no normal floats.
    size_t turned = 0;
    for (int n = 0; n < 1000; ++n) {
        const std::string name = fmt::format("node/{}", n);
        const float id = crypto_id(name);
        EXPECT_TRUE(std::isnormal(id)) << name;
        turned += std::bit_cast<uint32_t>(id) != murmur_hash_3(name);
    }
    EXPECT_GT(turned, 0u);
    EXPECT_LT(turned, 30u);
}

double coverage(const Rendering& r, const std::string& layer, const std::string& name, int x,
                int y) {
    double sum = 0;
    for (const char* rank : {"00", "01", "02"})
        for (auto [id, part] : {std::pair("R", "G"), {"B", "A"}})
            if (float(number(r, fmt::format("{}{}.{}", layer, rank, id), x, y)) == crypto_id(name))
                sum += number(r, fmt::format("{}{}.{}", layer, rank, part), x, y);
    return sum;
}

// Glass of which half is seen before two sheets; their border halves the pixels of column 8.
TEST(Cryptomatte, CoverageIsThatOfTheSamplesAndAddsUp) {
    SceneText scene;
    scene.square("s", 1)
        .look("red", "surface l() { Ci = 1; }")
        .look("glass", "surface g() { Oi = color(0.25, 0.5, 0.75); Ci = 0; }")
        .place("s", "red", "<translate>-0.9375 0 0</translate>", "left")
        .place("s", "red", "<translate>1.0625 -1 0</translate>", "right")
        .place("s", "glass", "<translate>0 0.5 2</translate>", "front");
    const auto taken_frame = taken(scene, {"crypto_object", "crypto_material", "object_id"}, 64);
    const Rendering& r = *taken_frame;
    EXPECT_EQ(r.findings(), "");
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            double sum = 0, last = 1;
            for (const char* rank : {"00", "01", "02"})
                for (const char* part : {"G", "A"}) {
                    const double one =
                        number(r, fmt::format("crypto_object{}.{}", rank, part), x, y);
                    EXPECT_LE(one, last);
                    sum += last = one;
                }
            EXPECT_NEAR(sum, double(r.film.at(x, y).w), 1e-6) << x << ' ' << y;
            EXPECT_NEAR(coverage(r, "crypto_material", "red", x, y),
                        coverage(r, "crypto_object", "left", x, y) +
                            coverage(r, "crypto_object", "right", x, y),
                        1e-6);
        }
    EXPECT_NEAR(coverage(r, "crypto_object", "front", 3, 2), 0.5, 1e-6);
    EXPECT_NEAR(coverage(r, "crypto_object", "left", 3, 2), 0.5, 1e-6);
    EXPECT_NEAR(coverage(r, "crypto_object", "left", 8, 14), 0.5, 0.03);
    EXPECT_NEAR(coverage(r, "crypto_object", "right", 8, 14), 0.5, 0.03);
    EXPECT_EQ(coverage(r, "crypto_object", "left", 12, 14), 0);
}

// A mirror costs its reflected ray, nothing costs the camera's ray alone.
TEST(Aovs, OfCostCountRays) {
    SceneText scene;
    scene.square("s", 0.5)
        .look("mirror", "surface m() { Ci = trace(P, vector \"camera\" (0, 0, -1)); }")
        .look("plain", "surface p() { Ci = 1; }")
        .place("s", "mirror", "<translate>-0.5 0 0</translate>")
        .place("s", "plain", "<translate>0.5 0 0</translate>");
    const auto taken_frame = taken(scene, {"cost"}, 4);
    const Rendering& r = *taken_frame;
    EXPECT_EQ(number(r, "cost", 8, 0), 4);
    EXPECT_EQ(number(r, "cost", 12, 8), 4);
    EXPECT_EQ(number(r, "cost", 4, 8), 8);
}

bool same_planes(const raytrace::Film& a, const raytrace::Film& b) {
    return std::ranges::equal(a.aovs, b.aovs, {}, &raytrace::AovPlane::values,
                              &raytrace::AovPlane::values);
}

TEST(Aovs, OfPicturesInBandsAreThoseOfWholeOnes) {
    SceneOptions options;
    options.aovs = {"all"};
    const std::string text = fixed_scene().text();
    Rendering whole(text, options), in_bands(text, options);
    whole.settings.integrator.samples_per_pixel = 4;
    whole.frame(40, 150);
    std::vector<std::vector<float>> values(whole.film.aovs.size());
    in_bands.settings = whole.settings;
    in_bands.settings.band_rows = in_bands.settings.integrator.tile;
    in_bands.settings.on_band = [&](const raytrace::Film& band) {
        for (size_t p = 0; p < values.size(); ++p)
            values[p].insert(values[p].end(), band.aovs[p].values.begin(),
                             band.aovs[p].values.end());
        return true;
    };
    in_bands.frame(40, 150);
    for (size_t p = 0; p < values.size(); ++p)
        EXPECT_EQ(values[p], whole.film.aovs[p].values) << whole.film.aovs[p].name;
}

TEST(Aovs, ChangeNoPictureAndAreTheSameForAnyThreadsAndTargets) {
    SceneText scene = fixed_scene();
    scene.octahedron("o")
        .look("m", kMatte)
        .place("o", "m", "<scale>.6 .6 .6</scale>")
        .light("sun", kSun);
    const std::string text = scene.text();
    auto render = [&](std::vector<std::string> aovs, const jit::Target* target) {
        SceneOptions options;
        options.aovs = std::move(aovs);
        options.target = target;
        auto r = std::make_unique<Rendering>(text, options);
        r->settings.integrator.samples_per_pixel = 8;
        r->frame(61, 47);
        return r;
    };
    const auto first = render({"all"}, nullptr), without = render({}, nullptr);
    ASSERT_FALSE(first->film.aovs.empty());
    for (size_t i = 0; i < first->film.rgba.size(); ++i)
        ASSERT_EQ(first->film.rgba[i], without->film.rgba[i]) << i;
    for (int threads : {1, 3}) {
        Threads scope(threads);
        EXPECT_TRUE(same_planes(first->film, render({"all"}, nullptr)->film)) << threads;
    }
    for (const jit::Target& target : jit::targets())
        if (target.supported()) {
            EXPECT_TRUE(same_planes(first->film, render({"all"}, &target)->film)) << target.name;
        }
}

}  // namespace
}  // namespace kinora
