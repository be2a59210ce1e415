// tests/runtime/picture/shading/dome_test.cpp: what lies around a scene: its light against closed
// forms and quadrature, and the rays that leave the scene.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "runtime/scene/description/shader_library.h"
#include "tests/runtime/expect_colors.h"
#include "tests/runtime/picture/shading/sun_map.h"

namespace kinora {
namespace {

const char* const kColor = "<color>1 1 1</color>";

SceneText& around(SceneText& scene, const std::string& inside) {
    scene.scene_extra += rsl_extra("<environment>" + inside + "</environment>");
    return scene;
}
SceneText& around(SceneText& scene, const SunMap& map, const std::string& more = "") {
    scene.images += fmt::format("<image id=\"sky\"><init_from>{}</init_from></image>", map.name);
    return around(scene, "<instance_image url=\"#sky\"/>" + more);
}

SceneOptions with_samples(int samples) {
    SceneOptions options;
    options.quality.light_samples = uint32_t(samples);
    return options;
}

struct Mean {
    double mean = 0, variance = 0, alpha = 0;  // of red over the pixels
};
Mean mean_of(Rendering& r, int side, int spp) {
    EXPECT_EQ(r.findings(), "");
    r.settings.integrator.samples_per_pixel = spp;
    r.frame(side, side);
    Mean of;
    double squares = 0;
    const double share = 1.0 / (side * side);
    for (int k = 0; k < side * side; ++k) {
        const vec4 c = r.film.at(k % side, k / side);
        of.mean += share * double(c.x), of.alpha += share * double(c.w);
        squares += share * double(c.x) * double(c.x);
    }
    of.variance = squares - of.mean * of.mean;
    return of;
}

// ---- light --------------------------------------------------------------------------------------

// Lambert as a specular lobe: chosen by cosine, or by the lights, and then traced. `LIT`: whether
// directlighting() is called.
const char* const kLobe = R"(
class lobe(uniform float samples = 4; uniform float mis = 1;) {
    normal Nn = 0;
    vector Tn = 0, Bn = 0;
    public void begin() {
        Nn = normalize(faceforward(N, I));
        Tn = normalize(abs(Nn[0]) < 0.9 ? Nn ^ vector(1, 0, 0) : Nn ^ vector(0, 1, 0));
        Bn = Nn ^ Tn;
    }
    public void evaluateSamples(string what; output __radiancesample s[]) {
        uniform float i;
        for (i = 0; i < arraylength(s); i += 1) {
            float c = max(0, Nn . s[i]->direction) / PI;
            s[i]->setMaterialResponse(what == "diffuse" ? 0 : c, c);
        }
    }
    public void generateSamples(string what; output __radiancesample s[]) {
        uniform float i, start = arraylength(s), end = start + samples;
        if (what != "diffuse") {
            resize(s, end);
            for (i = start; i < end; i += 1) {
                float x = random(), a = 2 * PI * random(), z = sqrt(1 - x);
                vector D = sqrt(x) * (cos(a) * Tn + sin(a) * Bn) + z * Nn;
                s[i]->setMaterialSample(z / PI, z / PI, D, 1e30);
            }
        }
    }
    public void lighting(output color Ci, Oi) {
        color shine = 0;
#ifdef LIT
        directlighting(this, getlights(), "mis", mis, "specularresult", shine);
#endif
        Ci = shine + indirectspecular(this);
    }
})";
std::string lobe(bool lit) {
    return lit ? std::string("#define LIT 1\n") + kLobe : kLobe;
}
std::string mis(int value) {
    return fmt::format(
        "<shader stage=\"SURFACE\"><bind symbol=\"mis\"><float>{}</float></bind>"
        "</shader>",
        value);
}

TEST(Dome, AWhiteSkyGivesWhiteSurfacesOne) {
    for (const std::string& code : {std::string(kMatte), lobe(true)}) {
        SceneText scene = floor_scene(code);
        Rendering r(around(scene, kColor).text());
        const Mean of = mean_of(r, 16, 16);
        EXPECT_NEAR(of.mean, 1, 1e-3) << code;
        EXPECT_EQ(of.alpha, 1);
    }
}

struct DomeMap : testing::TestWithParam<double> {
    SunMap map{GetParam(), GetParam() < 100 ? 8 : 2, 40};
};
INSTANTIATE_TEST_SUITE_P(Peaks, DomeMap, testing::Values(40.0, 800.0, 3700.0));

// The middle of the map lies along +x, its left a quarter further along -z (docs/lights.md).
TEST_P(DomeMap, HasTheSameMeanForAnyNumberOfSamples) {
    const double truth = map.irradiance({-1, 0, 0});
    for (int samples : {1, 16, 256}) {
        SceneText scene = floor_scene(kMatte);
        Rendering r(around(scene, map).text(), with_samples(samples));
        EXPECT_NEAR(mean_of(r, 16, std::max(1, 512 / samples)).mean / truth, 1, 0.005) << samples;
    }
}

// Evenly over the sphere, of the same map.
const char* const kEven = R"(
class even(uniform string map = ""; uniform float samples = 16;) {
    vector in_map(vector D) {
        vector d = vtransform("shader", D);
        return vector(-d[0], d[1], d[2]);
    }
    public void generateSamples(string what; output __radiancesample s[]) {
        uniform float i;
        resize(s, samples);
        for (i = 0; i < samples; i += 1) {
            float z = 1 - 2 * random(), a = 2 * PI * random(), r = sqrt(max(0, 1 - z * z));
            vector D = vector(r * cos(a), r * sin(a), z);
            s[i]->setLightSample(maplight(map, in_map(D)), 1 / (4 * PI), D, 1e30);
        }
    }
    public void evaluateSamples(string what; output __radiancesample s[]) {
        uniform float i;
        for (i = 0; i < arraylength(s); i += 1)
            s[i]->setLightSample(maplight(map, in_map(s[i]->direction)), 1 / (4 * PI));
    }
})";

// As a light of a file: the map's middle lies where the light looks, here along +z.
TEST_P(DomeMap, HasLittleNoiseAndMayBePlacedByHand) {
    const double truth = map.irradiance({0, 0, 1});
    auto of = [&](const std::string& code) {
        SceneText scene = floor_scene(kMatte);
        scene.rsl_light("sky", code, "<rotate>0 1 0 180</rotate>",
                        fmt::format("<bind symbol=\"map\"><string>{}</string></bind>", map.name));
        Rendering r(scene.text());
        return mean_of(r, 64, 1);
    };
    const Mean even = of(kEven), ours = of(std::string(library_shader_text("envlight")));
    EXPECT_NEAR(ours.mean / truth, 1, 0.02);
    EXPECT_LT(ours.variance, 0.06 * truth * truth);
    EXPECT_LT(ours.variance, 0.06 * even.variance);
}

TEST(Dome, TurnsAboutTheUpAxis) {
    const SunMap map(800, 2, 40);
    for (int degrees : {90, 180, -60}) {
        const double turn = -degrees * kPi / 180;
        // The floor's normal in the world as the map was before, then in the map.
        const dvec3 n(std::sin(turn), 0, std::cos(turn)), in_map(-n.z, n.y, n.x);
        SceneText scene = floor_scene(kMatte);
        around(scene, map,
               fmt::format("<rotation>{}</rotation><brightness>2</brightness>", degrees));
        Rendering r(scene.text(), with_samples(64));
        EXPECT_NEAR(mean_of(r, 16, 16).mean / (2 * map.irradiance(in_map)), 1, 0.005) << degrees;
    }
}

TEST(Dome, UpIsThatOfTheFile) {
    SunMap map(40, 8, 40);
    for (int y = 0; y < kMapHeight; ++y)
        for (int x = 0; x < kMapWidth; ++x) map.at(x, y) = y < kMapHeight / 2 ? 1 : 0;
    map.write();
    const struct {
        const char* axis;
        double want;
    } rows[] = {{"Z_UP", 1}, {"Y_UP", 0.5}, {"X_UP", 0.5}};
    for (const auto& row : rows) {
        SceneText scene = floor_scene(kMatte);
        scene.asset = fmt::format("<up_axis>{}</up_axis>", row.axis);
        Rendering r(around(scene, map).text(), with_samples(64));
        EXPECT_NEAR(mean_of(r, 16, 16).mean, row.want, 0.01) << row.axis;
    }
}

TEST(Dome, AllLightMayComeFromOneTexel) {
    SunMap map(40, 8, 40);
    std::fill(map.texels.begin(), map.texels.end(), 0.0);
    map.at(200, 50) = 1000;
    map.write();
    const double truth = map.irradiance({-1, 0, 0});
    ASSERT_GT(truth, 0);
    SceneText scene = floor_scene(kMatte);
    Rendering r(around(scene, map).text());
    const Mean of = mean_of(r, 16, 16);
    EXPECT_NEAR(of.mean / truth, 1, 0.005);
    EXPECT_LT(of.variance, 1e-4 * truth * truth);
}

TEST(Dome, BlackGivesNoLightAndNoFault) {
    SceneText scene = floor_scene(kMatte);
    Rendering r(around(scene, "<color>0 0 0</color>").text());
    EXPECT_EQ(mean_of(r, 16, 1).mean, 0);
    SunMap map(40, 8, 40);
    std::fill(map.texels.begin(), map.texels.end(), 0.0);
    map.write();
    SceneText other = floor_scene(kMatte);
    Rendering s(around(other, map).text());
    EXPECT_EQ(mean_of(s, 16, 1).mean, 0);
}

TEST(Dome, AClosedBoxIsDark) {
    SceneText scene = floor_scene(kMatte);
    scene.cube("box", 20).look("wall", kMatte).place("box", "wall");
    Rendering r(around(scene, kColor).text());
    EXPECT_EQ(mean_of(r, 16, 1).mean, 0);
}

TEST(Dome, TexelsThatAreNoNumbersAreToldAndDark) {
    SunMap map(40, 8, 40);
    std::fill(map.texels.begin(), map.texels.end(), 1.0);
    map.at(3, 3) = std::nan("");
    map.at(100, 30) = -5;
    map.write();
    SceneText scene = floor_scene(kMatte);
    Rendering r(around(scene, map).text(), with_samples(64));
    EXPECT_EQ(r.count("ENVIRONMENT_VALUES"), 1) << r.findings();
    r.settings.integrator.samples_per_pixel = 4;
    r.frame();
    for (int k = 0; k < 256; ++k) EXPECT_NEAR(r.color(k % 16, k / 16).x, 1, 0.3);
}

// ---- rays that leave the scene ------------------------------------------------------------------

// A square that covers the middle of the picture.
SceneText small(const std::string& code) {
    SceneText scene;
    scene.square("plate", 0.5).look("plate-look", code).place("plate", "plate-look");
    return scene;
}

TEST(Dome, IsBehindThePictureUnlessHidden) {
    for (bool hidden : {false, true}) {
        SceneText scene = small(kMatte);
        around(scene,
               std::string("<color>0.25 0.5 2</color>") + (hidden ? "<hidden>true</hidden>" : ""));
        Rendering r(scene.text());
        r.settings.integrator.samples_per_pixel = 16;
        r.frame();
        EXPECT_EQ(r.findings(), "");
        EXPECT_EQ(r.film.at(0, 0), hidden ? vec4(0.0f) : vec4(0.25f, 0.5f, 2.0f, 1.0f));
        EXPECT_NEAR(r.color(8, 8).y, 0.5, 0.02);
    }
}

TEST(Dome, IsSeenByMirrorsAlongTheirRays) {
    const SunMap map(40, 8, 40);
    for (const char* hidden : {"", "<hidden>true</hidden>"}) {
        SceneText scene = floor_scene(
            "surface mirror() { Oi = 1; Ci = trace(P, vector \"world\" (0.6, 0, 0.8)); }");
        Rendering r(around(scene, map, hidden).text());
        r.frame();
        // In the map: x is -z of the world, z its x.
        const dvec3 d(-0.8, 0, 0.6);
        const double column = (std::atan2(-d.x, d.z) / (2 * kPi) + 0.5) * kMapWidth - 0.5;
        const double wanted = map.between(column, kMapHeight / 2.0 - 0.5);
        EXPECT_NEAR(r.color(8, 8).x, wanted, 2e-3 * wanted);
        EXPECT_EQ(r.findings(), "");
    }
}

TEST(Dome, RaysThatEndBeforeDoNotSeeIt) {
    SceneText scene = floor_scene(
        "surface s() { normal n = normalize(N); Oi = 1;"
        " Ci = color(comp(trace(P, n, \"maxdist\", 5), 0), trace(P, n) == color(1), 0); }");
    Rendering r(around(scene, kColor).text());
    r.frame();
    EXPECT_EQ(r.color(8, 8), vec3(0, 1, 0)) << r.findings();
}

// Light of a white sky counts once, however a surface asks for it.
TEST(Dome, CountsOnceForEachSurface) {
    const char* const kOnce[] = {
        "diffuse(n)",
        "indirectdiffuse(P, n, 16)",
        "diffuse(n) + indirectdiffuse(P, n, 16)",
        "diffuse(n) + sum",
        "sum",
    };
    for (const char* way : kOnce)
        for (uint32_t bounces : {0u, 2u}) {
            const bool gathers = std::string_view(way).find("sum") != std::string_view::npos;
            SceneText scene = floor_scene(
                fmt::format("surface s() {{ normal n = normalize(N); color c = 0, sum = 0; Oi = 1;"
                            " {} Ci = {}; }}",
                            gathers ? "gather(\"illuminance\", P, n, PI/2, 16, \"surface:Ci\", c,"
                                      " \"distribution\", \"cosine\") sum += c / 16;"
                                    : "",
                            way));
            SceneOptions options;
            options.indirect = bounces;
            if (bounces) options.quality.diffuse_depth = bounces;
            options.quality.light_samples = 16;
            Rendering r(around(scene, kColor).text(), options);
            EXPECT_NEAR(mean_of(r, 16, 4).mean, 1, 5e-3) << way << " " << bounces;
        }
}

TEST(Dome, SpecularLightCountsOnceWhoeverChooses) {
    const SunMap map(40, 8, 40);
    const double truth = map.irradiance({-1, 0, 0});
    for (int strategy : {0, 1, 2}) {
        SceneText scene = floor_scene(lobe(true), mis(strategy));
        Rendering r(around(scene, map).text(), with_samples(16));
        EXPECT_NEAR(mean_of(r, 16, 64).mean / truth, 1, strategy == 2 ? 0.02 : 0.01) << strategy;
    }
    SceneText scene = floor_scene(lobe(false));
    Rendering r(around(scene, map).text());
    EXPECT_NEAR(mean_of(r, 16, 64).mean / truth, 1, 0.02);
}

TEST(Dome, GathersMeetItOnlyWhereTheyTakeAColor) {
    SceneText scene = floor_scene(
        "surface s() { normal n = normalize(N); color c = 0; float far = 0, open = 0; Oi = 1;"
        " gather(\"illuminance\", P, n, 0.1, 1, \"surface:Ci\", c, \"ray:length\", far) ;"
        " else c = color(9);"
        " gather(\"illuminance\", P, n, 0.1, 1, \"ray:length\", far) ; else open = 1;"
        " Ci = color(comp(c, 0), open, 0); }");
    Rendering r(around(scene, "<color>0.5 0 0</color>").text());
    r.frame();
    EXPECT_EQ(r.color(8, 8), vec3(0.5f, 1, 0)) << r.findings();
}

// What generateSamples() says of its directions is what evaluateSamples() says of them.
TEST(SunSky, GivesTheSameLightWhoeverChooses) {
    auto mean = [](int strategy, double sun) {
        SceneText scene = floor_scene(lobe(true), mis(strategy));
        scene.rsl_light("sky", std::string(library_shader_text("sunsky")),
                        "<rotate>1 0 0 90</rotate>",
                        fmt::format("<bind symbol=\"sun\"><float>{}</float></bind>", sun));
        Rendering r(scene.text());
        return mean_of(r, 16, 64).mean;
    };
    const double sky = mean(0, 0), whole = mean(0, 1);
    EXPECT_GT(sky, 0.01);
    EXPECT_GT(whole, 3 * sky);  // the sun of a clear day
    EXPECT_NEAR(mean(1, 0) / sky, 1, 0.01);
    EXPECT_NEAR(mean(2, 0) / sky, 1, 0.01);
    EXPECT_NEAR(mean(1, 1) / whole, 1, 0.01);
}

// ---- files --------------------------------------------------------------------------------------

TEST(Dome, WhatIsWrongIsTold) {
    struct {
        const char* inside;
        const char* code;
        const char* text;
    } rows[] = {
        {"<color>1 1</color>", "RSL_ENVIRONMENT", "<color> is no color of three numbers"},
        {"<color>1 x 1</color>", "RSL_ENVIRONMENT", "<color> is no color of three numbers"},
        {"<color>1 1 1</color><colour/>", "RSL_ENVIRONMENT", "<colour> is not known here"},
        {"<color>1 1 1</color><rotation>x</rotation>", "RSL_ENVIRONMENT", "<rotation> is no num"},
        {"<color>1 1 1</color><brightness>-1</brightness>", "RSL_ENVIRONMENT", "is below 0"},
        {"<color>1 1 1</color><hidden>perhaps</hidden>", "RSL_ENVIRONMENT", "neither true nor"},
        {"<color>1 1 1</color><color>2 2 2</color>", "RSL_ENVIRONMENT", "stands here twice"},
        {"<rotation>5</rotation>", "RSL_ENVIRONMENT", "neither an <instance_image> nor a <color>"},
        {"<instance_image url=\"#none\"/>", "LINK_UNRESOLVED", "none"},
    };
    for (const auto& row : rows) {
        SceneText scene = floor_scene(kMatte);
        Rendering r(around(scene, row.inside).text());
        EXPECT_NE(r.findings().find(row.text), std::string::npos) << row.inside << r.findings();
        EXPECT_GE(r.count(row.code), 1) << row.inside << r.findings();
    }
}

TEST(Dome, AMissingPictureIsAnErrorWithItsPath) {
    SceneText scene = floor_scene(kMatte);
    scene.images = "<image id=\"sky\"><init_from>no/such/sky.hdr</init_from></image>";
    Rendering r(around(scene, "<instance_image url=\"#sky\"/>").text());
    EXPECT_EQ(r.count("ENVIRONMENT_UNREADABLE"), 1);
    EXPECT_NE(r.findings().find("no/such/sky.hdr"), std::string::npos) << r.findings();
    EXPECT_EQ(r.scene, nullptr);
}

}  // namespace
}  // namespace kinora
