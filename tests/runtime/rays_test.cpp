// tests/runtime/rays_test.cpp: trace, transmission, occlusion and indirectdiffuse against closed
// forms: where a ray goes and what it meets is known from the scene's few planes.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <filesystem>

#include "allocations_of_ours.h"
#include "jit/target.h"
#include "ray_scenes.h"
#include "runtime/scene/images/image_io.h"

namespace kinora {
namespace {

TEST(Occlusion, OfAFloorBesideAWallIsItsFormFactor) {
    SceneText scene = floor_and_wall(floor_code("Ci = occlusion(P, n, 1024);"), kBlack, 0.8);
    Rendering r(scene.text());
    r.frame();
    ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
    double squares = 0;
    for (int x = 0; x < 16; ++x) {
        double want = wall_share(r.place(x, 0).x, 0.8), mean = 0;
        for (int y = 0; y < 16; ++y) {
            EXPECT_NEAR(r.color(x, y).x, want, 0.02) << x << "," << y;
            mean += double(r.color(x, y).x) / 16;
            squares += std::pow(double(r.color(x, y).x) - want, 2);
        }
        EXPECT_NEAR(mean, want, 0.003) << "column " << x;  // more than four deviations
    }
    // Rays drawn alone: sqrt(want (1 - want) / 1024), 0.01 on average.
    EXPECT_LT(std::sqrt(squares / 256), 0.0035);
}

TEST(Occlusion, OfAnOpenFloorIsExactlyNothing) {
    SceneText scene = floor_and_wall(floor_code("Ci = occlusion(P, n, 64);"), kBlack, -0.5);
    Rendering r(scene.text());
    r.frame();
    for (int x = 0; x < 16; ++x) EXPECT_EQ(r.color(x, 3).x, 0.0f) << r.findings();
}

TEST(Occlusion, OptionsNarrowShortenAndWeigh) {
    SceneText scene = floor_and_wall(
        floor_code("float near = occlusion(P, n, 256, \"maxdist\", 0.6);"
                   " float narrow = occlusion(P, n, 256, \"coneangle\", 0.1);"
                   " vector open = 0; float all = occlusion(P, n, 256, \"environmentdir\", open);"
                   " Ci = color(near, narrow, xcomp(vtransform(\"world\", open)));"),
        kBlack, 0.8);
    Rendering r(scene.text());
    r.frame();
    ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
    EXPECT_EQ(r.color(3, 8).x, 0.0f);  // the wall is 1.7 away
    EXPECT_GT(r.color(15, 8).x, 0.1f);
    EXPECT_LT(r.color(15, 8).x, float(wall_share(r.place(15, 8).x, 0.8)) + 0.02f);
    EXPECT_EQ(r.color(3, 8).y, 0.0f);    // straight up is free
    EXPECT_LT(r.color(15, 8).z, -0.1f);  // away from the wall
}

// An image beside the scenes of tests that is red everywhere; removed with the object.
struct RedSky {
    std::string name = "kinora_rays_test_" + std::to_string(getpid()) + ".png";
    std::filesystem::path path = std::filesystem::temp_directory_path() / name;
    RedSky() {
        Image8 image{4, 2, {}};
        for (int k = 0; k < 8; ++k) image.rgba.insert(image.rgba.end(), {255, 0, 0, 255});
        EXPECT_EQ(write_png(path.string(), image, {}), "");
    }
    ~RedSky() { std::filesystem::remove(path); }
};

// What is open shows the map: under a red sky of 1, one minus what is blocked.
TEST(Occlusion, GivesTheLightOfAnEnvironmentMap) {
    RedSky sky;
    SceneText scene = floor_and_wall(
        floor_code("color c = 0; float hidden = occlusion(P, n, 64, \"environmentmap\", \"" +
                   sky.name + "\", \"environmentcolor\", c); Ci = c + color(0, 0, hidden);"),
        kBlack, 0.8);
    Rendering r(scene.text());
    r.frame();
    EXPECT_GT(r.color(14, 8).z, 0.05f) << r.findings();
    for (int x = 0; x < 16; ++x) {
        EXPECT_NEAR(r.color(x, 8).x + r.color(x, 8).z, 1, 1e-5) << r.findings();
        EXPECT_EQ(r.color(x, 8).y, 0.0f);
    }
}

TEST(IndirectDiffuse, TellsWhatTheEnvironmentMapGives) {
    RedSky sky;
    SceneText scene = floor_and_wall(
        floor_code("color c = 0; color all = indirectdiffuse(P, n, 64, \"environmentmap\", \"" +
                   sky.name + "\", \"environmentcolor\", c); Ci = all - c;"),
        "surface lamp() { Oi = 1; Ci = color(1, 2, 4); }", 0.8);
    Rendering r(scene.text());
    r.frame();
    EXPECT_GT(r.color(14, 8).x, 0.05f) << r.findings();
    for (int x = 0; x < 16; ++x)  // the rest is the lamp's
        EXPECT_NEAR(r.color(x, 8).z, 4 * r.color(x, 8).x, 1e-4) << r.findings();
}

// Its map alone is the sky's light; "occlusion" is what the wall hides (a form factor).
TEST(IndirectDiffuse, TakesAMapAloneAndTellsTheOcclusion) {
    RedSky sky;
    SceneText scene = floor_and_wall(
        floor_code("float hidden = 0; color c = indirectdiffuse(P, n, 256, \"occlusion\", hidden);"
                   " Ci = color(comp(indirectdiffuse(\"" +
                   sky.name + "\", n), 0), hidden, xcomp(transform(\"world\", P)));"),
        kBlack, 0.8);
    Rendering r(scene.text());
    r.frame();
    ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
    for (int x = 0; x < 16; ++x) {
        vec3 got = r.color(x, 8);
        EXPECT_NEAR(got.x, 1, 1e-5);
        EXPECT_NEAR(got.y, wall_share(got.z, 0.8), 0.02) << x;
    }
}

// The wall at 1.25, 0.8 high, hides the lower part of a source at 2.25, 2 high: by similar
// triangles 0.8 (2.25 - x) / (1.25 - x) of its height.
TEST(Shadow, SamplesTheQuadrilateralOfItsSource) {
    SceneText scene = floor_and_wall(
        floor_code(
            "point a = point \"world\" (2.25, -1, 0), b = point \"world\" (2.25, 1, 0),"
            " c = point \"world\" (2.25, -1, 2), d = point \"world\" (2.25, 1, 2);"
            " float rows = shadow(\"raytrace\", P, \"source\", a, b, c, d, \"samples\", 64);"
            " float around = shadow(\"none.tex\", P, \"samples\", 64, \"source\", a, b, d, c);"
            " Ci = color(rows, around, xcomp(transform(\"world\", P)));"),
        kBlack, 0.8);
    Rendering r(scene.text());
    r.frame();
    ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
    for (int x = 0; x < 16; ++x) {
        double rows = 0, around = 0, at = 0;
        for (int y = 0; y < 16; ++y) {
            rows += r.color(x, y).x / 16;
            around += r.color(x, y).y / 16;
            at += r.color(x, y).z / 16;
        }
        if (at > 1.2) continue;
        double want = std::min(1.0, 0.4 * (2.25 - at) / (1.25 - at));
        EXPECT_NEAR(rows, want, 0.02) << at;
        EXPECT_NEAR(around, want, 0.02) << at;
    }
}

// What gather hands out of a map is its light by solid angle: of a sky of 1, the irradiance is pi.
TEST(Gather, GoesThroughAnEnvironmentMap) {
    RedSky sky;
    std::string loop =
        " gather(\"environment:" + sky.name +
        "\", P, n, PI/2, 256, \"environment:color\", c, \"environment:solidangle\", angle,"
        " \"environment:direction\", way";
    SceneText scene = floor_and_wall(
        floor_code("color c = 0, even = 0, by_cosine = 0; float angle = 0; vector way = 0;" + loop +
                   ") even += c * angle * (normalize(way) . n) / PI;" + loop +
                   ", \"distribution\", \"cosine\") by_cosine += c * angle * (normalize(way) . n);"
                   " Ci = color(comp(even, 0), comp(by_cosine, 0) / PI, comp(even, 1));"),
        kBlack, 0.8);
    Rendering r(scene.text());
    r.frame(4, 4);
    ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
    EXPECT_NEAR(r.color(2, 2).x, 1, 0.01) << r.findings();
    EXPECT_NEAR(r.color(2, 2).y, 1, 1e-4);
    EXPECT_EQ(r.color(2, 2).z, 0.0f);
}

// A dusk of 0.0003 with a sun of 2 by 2 of 128 by 64 texels, 30 degrees over the floor's horizon.
struct SunSky {
    std::string name = "kinora_rays_test_sun_" + std::to_string(getpid()) + ".png";
    std::filesystem::path path = std::filesystem::temp_directory_path() / name;
    SunSky() {
        Image8 image{128, 64, {}};
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 128; ++x) {
                bool sun = (x == 84 || x == 85) && (y == 31 || y == 32);
                uint8_t c = sun ? 255 : 1;
                image.rgba.insert(image.rgba.end(), {c, c, c, 255});
            }
        EXPECT_EQ(write_png(path.string(), image, {}), "");
    }
    ~SunSky() { std::filesystem::remove(path); }
};

// As many directions by its brightness find the irradiance of a map with less error than even ones
// of the same sharpness; the truth is the mean of a million.
TEST(Gather, FollowsTheBrightnessOfAMap) {
    SunSky sky;
    auto gather = [&](const char* samples, const std::string& more) {
        return " gather(\"environment:" + sky.name + "\", P, n, PI/2, " + samples +
               ", \"environment:color\", c, \"environment:direction\", way" + more + ")";
    };
    SceneText scene = floor_and_wall(
        floor_code("color c = 0; float a = 0, even = 0, bright = 0, truth = 0; vector way = 0;" +
                   gather("64", "") + " even += comp(c, 0) * (normalize(way) . n) * 2 / 64;" +
                   gather("64", ", \"environment:solidangle\", a") +
                   " bright += comp(c, 0) * a * (normalize(way) . n) / PI;" +
                   gather("4096", ", \"distribution\", \"cosine\"") +
                   " truth += comp(c, 0) / 4096; Ci = color(even, bright, truth);"),
        kBlack, 0.8);
    Rendering r(scene.text());
    r.frame();
    ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
    dvec3 sum(0.0), square(0.0);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) sum += dvec3(r.color(x, y)) / 256.0;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            dvec3 off = dvec3(r.color(x, y)) - sum.z;
            square += off * off / 256.0;
        }
    EXPECT_NEAR(sum.y, sum.z, 0.02 * sum.z);
    EXPECT_LT(std::sqrt(square.y), 0.5 * std::sqrt(square.x)) << sum.x << " " << sum.z;
}

TEST(Occlusion, CountsTransparentSurfacesByTheirOpacity) {
    auto share = [](const char* wall) {
        SceneText scene = floor_and_wall(floor_code("Ci = occlusion(P, n, 64);"), wall, 0.8);
        Rendering r(scene.text());
        r.frame();
        return r.color(14, 8).x;
    };
    float full = share(kBlack);
    EXPECT_NEAR(share("surface g() { Oi = 0.25; Ci = 0; }"), 0.25f * full, 1e-6f);
    EXPECT_NEAR(share("surface g() { Oi = 0.25 + 0 * s; Ci = 0; }"), 0.25f * full, 1e-6f);
}

TEST(IndirectDiffuse, InAWhiteFurnaceIsOne) {
    SceneText scene;
    scene.square("floor", 1.5)
        .look("floor-look", floor_code("Ci = indirectdiffuse(P, n, 32);"))
        .place("floor", "floor-look");
    add_box(scene, "surface white() { Oi = 1; Ci = 1; }");
    Rendering r(scene.text());
    r.frame();
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) ASSERT_EQ(r.color(x, y), vec3(1.0f)) << r.findings();
}

TEST(IndirectDiffuse, IsTheColorTimesTheFormFactor) {
    SceneText scene = floor_and_wall(floor_code("Ci = indirectdiffuse(P, n, 1024);"),
                                     "surface lamp() { Oi = 1; Ci = color(1, 2, 4); }", 0.8);
    Rendering r(scene.text());
    r.frame();
    for (int x = 0; x < 16; ++x) {
        vec3 mean(0.0f);
        for (int y = 0; y < 16; ++y) mean += r.color(x, y) / 16.0f;
        double want = wall_share(r.place(x, 0).x, 0.8);
        EXPECT_NEAR(mean.x, want, 0.003) << x;
        EXPECT_FLOAT_EQ(mean.z, 4 * mean.x);
    }
}

// Two wide planes: the upper one, which the camera sees, shows what it sees below it; the lower one
// glows by 1 and adds what it sees of the upper. Every second bounce so adds 1.
TEST(IndirectDiffuse, BouncesAsOftenAsTheSceneAllows) {
    for (int bounces : {0, 1, 2, 3, 4, 5}) {
        SceneText scene;
        scene.square("plane", 5000)
            .look("upper", floor_code("Ci = indirectdiffuse(P, -n, 4);"))
            .look("lower", "surface s() { Oi = 1; Ci = 1 + indirectdiffuse(P, normalize(N), 4); }")
            .place("plane", "upper")
            .place("plane", "lower", "<translate>0 0 -1</translate>");
        SceneOptions options;
        options.quality.diffuse_depth = bounces;
        Rendering r(scene.text(), options);
        r.frame(4, 4);
        EXPECT_FALSE(r.diagnostics.has_errors()) << r.findings();
        for (int k = 0; k < 4; ++k)
            EXPECT_NEAR(r.color(k, k).x, (bounces + 1) / 2, 1e-3) << bounces;
    }
}

TEST(Trace, SeesThroughWhatIsNotOpaque) {
    SceneText scene =
        floor_and_wall(floor_code("float d = trace(P, right + up); Ci = trace(P, right + up);"
                                  " if (s < 0.5) Ci = d;"),
                       "surface pane() { Oi = 0.5; Ci = color(0.25, 0, 0.125); }", 30);
    add_box(scene, "surface white() { Oi = 1; Ci = 1; }", 60);
    Rendering r(scene.text());
    r.frame();
    ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
    EXPECT_EQ(r.color(12, 8), vec3(0.75f, 0.5f, 0.625f));
    EXPECT_NEAR(r.color(2, 8).x, (1.25 - r.place(2, 8).x) * std::sqrt(2.0), 1e-5);
}

TEST(Trace, MissesBeyondMaxdistAndInANarrowConeSeesTheSame) {
    SceneText scene = floor_and_wall(
        floor_code("color far = trace(P, right + up, \"maxdist\", 0.1);"
                   " float d = trace(P, right + up, \"maxdist\", 0.1);"
                   " color cone = trace(P, right + up, \"samples\", 16, \"samplecone\", 0.01);"
                   " Ci = color(comp(far, 0), comp(cone, 1), d > 1e29 ? 1 : 0);"),
        "surface lamp() { Oi = 1; Ci = 1; }", 30);
    Rendering r(scene.text());
    r.frame();
    EXPECT_EQ(r.color(8, 8), vec3(0, 1, 1)) << r.findings();
}

TEST(Trace, HangsNoMoreRaysBehindEachOtherThanAllowed) {
    // Two mirrors that add 1 each: the depth shows in the sum.
    const char* mirror =
        "surface m() { Oi = 1; Ci = 1 + trace(P, reflect(normalize(I), normalize(N))); }";
    for (int depth : {1, 4, 16}) {
        SceneText scene;
        scene.square("a", 1.5).look("m", mirror).place("a", "m");
        // The camera's side has its back culled, so that the picture sees past it.
        scene.mesh("b", {{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}}, {0, 2, 1, 0, 3, 2});
        scene.place("b", "m", "<translate>0 0 11</translate>");
        SceneOptions options;
        options.quality.ray_depth = depth;
        Rendering r(scene.text(), options);
        r.frame(4, 4);
        EXPECT_EQ(r.color(1, 1).x, 1.0f + float(depth)) << r.findings();
    }
}

// Three rays a hit, sixteen deep, would be 4e7 a pixel.
TEST(Trace, OfSeveralRaysAHitEndsBeforeTheyMultiply) {
    SceneText scene;
    const char* three =
        "surface s() { normal n = normalize(N); vector a = normalize(dPdu), b = normalize(dPdv);"
        " if (n . I > 0) n = -n; Oi = 1;"
        " Ci = 1 + (trace(P, n + a) + trace(P, n - a) + trace(P, n + 0.5 * b)) / 3; }";
    scene.square("floor", 1.5).look("floor-look", three).place("floor", "floor-look");
    add_box(scene, three);
    Rendering r(scene.text());
    r.frame(2, 2);
    EXPECT_LT(r.stats.rays, 4u * 20000u);
    EXPECT_GT(r.stats.rays, 4u * 100u);
    EXPECT_GT(r.color(0, 0).x, 5.0f);  // of at most 17
}

// Eight bounces of 16 rays would be 4e9 a sample. Each gives half of what it sees and 0.5.
TEST(IndirectDiffuse, OfManyBouncesEndsAndKeepsItsMean) {
    SceneText scene;
    const char* half =
        "surface s() { normal n = faceforward(normalize(Ng), I); Oi = 1;"
        " Ci = 0.5 + 0.5 * indirectdiffuse(P, n, 16); }";
    scene.square("floor", 1.5).look("floor-look", half).place("floor", "floor-look");
    add_box(scene, half);
    SceneOptions options;
    options.quality.diffuse_depth = 8;
    options.quality.samples_behind = 0;
    Rendering r(scene.text(), options);
    r.frame(32, 32);
    EXPECT_LT(r.stats.rays, 1024u * 1000u);  // --ray-limit
    EXPECT_GT(r.stats.rays, 1024u * 200u);
    double mean = 0;
    for (int k = 0; k < 1024; ++k) mean += double(r.color(k % 32, k / 32).x) / 1024;
    EXPECT_NEAR(mean, 1 - std::pow(0.5, 9), 0.001) << r.findings();
}

// A pixel of a camera of 40 degrees is 2 tan 20 / 16 high at distance 1. In the mirror and behind
// the pane the wall is 10 + 20 away; du is a share of its 100.
TEST(Rays, SpreadOnWithTheirDistanceInMirrorsAndPanes) {
    const char* bodies[] = {
        "Ci = trace(P, reflect(I, n));",
        "Ci = trace(P, I);",
        "color c = 0; gather(\"\", P, reflect(I, n), 0, 1, \"surface:Ci\", c) { Ci = c; }",
        "Oi = 0; Ci = 0;",
    };
    for (const char* body : bodies) {
        SCOPED_TRACE(body);
        SceneText scene;
        scene.cameras = R"(<camera id="eye"><optics><technique_common><perspective>
            <yfov>40</yfov><aspect_ratio>1</aspect_ratio><znear>0.1</znear><zfar>100</zfar>
            </perspective></technique_common></optics></camera>)";
        scene.square("floor", 5)
            .look("floor-look",
                  fmt::format("surface s() {{ normal n = normalize(N); Oi = 1; {} }}", body));
        scene.place("floor", "floor-look");
        scene.square("wall", 50)
            .look("wall-look", "surface w() { Oi = 1; Ci = color(du, dv, 1); }");
        scene.place("wall", "wall-look", "<translate>0 0 20</translate><rotate>1 0 0 180</rotate>");
        scene.place("wall", "wall-look", "<translate>0 0 -20</translate>");
        Rendering r(scene.text());
        r.frame();
        double want = 30 * 2 * std::tan(kPi / 9) / 16 / 100;
        EXPECT_NEAR(r.color(8, 8).x, want, 3e-3 * want) << r.findings();
        EXPECT_NEAR(r.color(8, 8).y, want, 3e-3 * want);
    }
}

TEST(Rays, AreNotShotForAFrameThatNobodyWaitsFor) {
    SceneText scene = floor_and_wall(floor_code("Ci = occlusion(P, n, 256);"), kBlack, 0.8);
    Rendering r(scene.text());
    std::atomic<int> stop{15};
    r.frame();
    r.settings.stop = &stop;
    EXPECT_FALSE(render_frame(*r.scene, *r.pose, 0, r.settings, r.film, r.stats, r.diagnostics));
    EXPECT_EQ(r.stats.rays, 0u);
    stop = 0;
    r.frame();
    EXPECT_GT(r.stats.rays, 256u * 256u);
}

TEST(Transmission, IsTheProductOfWhatLiesBetween) {
    SceneText scene =
        floor_and_wall(floor_code("point there = P + 4 * right + up; Ci = transmission(P, there);"
                                  " if (s < 0.5) Ci = visibility(P, there);"
                                  " if (s < 0.35) Ci = transmission(P, P + 0.1 * up);"),
                       "surface pane() { Oi = color(0.5, 0.25, 0); Ci = Oi; }", 30);
    scene.look("second-look", "surface pane() { Oi = 0.5 + 0 * s; Ci = Oi; }");
    scene.place("wall", "second-look", "<translate>3 0 0</translate>");
    Rendering r(scene.text());
    r.frame();
    ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
    EXPECT_EQ(r.color(13, 8), vec3(0.25f, 0.375f, 0.5f));
    EXPECT_EQ(r.color(6, 8), vec3(1.0f));
    EXPECT_EQ(r.color(1, 8), vec3(1.0f));
}

TEST(RaytracedMaps, EnvironmentSeesWhatTraceSees) {
    SceneText scene =
        floor_and_wall(floor_code("Ci = environment(\"raytrace\", right + up);"
                                  " if (s < 0.5) Ci = float environment(\"raytrace\", right, "
                                  "\"maxdist\", 0.01);"),
                       "surface lamp() { Oi = 1; Ci = color(0.25, 0.5, 1); }", 30);
    Rendering r(scene.text());
    r.frame();
    ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
    EXPECT_EQ(r.color(12, 8), vec3(0.25f, 0.5f, 1.0f));
    EXPECT_EQ(r.color(2, 8), vec3(0.0f));
}

// A light that asks the map of the scene has the shadows that a light without shadows of its own is
// given.
TEST(RaytracedMaps, ShadowInALightIsThatOfTheRenderer) {
    std::vector<std::unique_ptr<Rendering>> pictures;
    for (const char* own : {"Cl = 1", "Cl = 1 - shadow(\"raytrace\", Ps)"})
        for (const char* where : {"illuminate(point \"shader\" (0, 0, 0))",
                                  "solar(vector \"world\" (0.6, 0, -0.8), 0)"}) {
            SceneText scene =
                floor_and_wall(floor_code("Ci = diffuse(n);"),
                               "surface pane() { Oi = color(1, 0.5, 0); Ci = 0; }", 0.8);
            scene.rsl_light("lamp", std::string("light l() { ") + where + " { " + own + "; } }",
                            "<translate>4 0 2</translate>");
            pictures.push_back(std::make_unique<Rendering>(scene.text()));
            pictures.back()->frame();
            EXPECT_FALSE(pictures.back()->diagnostics.has_errors()) << pictures.back()->findings();
        }
    for (size_t k = 0; k < 2; ++k) {
        EXPECT_LT(difference(pictures[k]->film, pictures[k + 2]->film), 1e-6f) << k;
        EXPECT_GT(pictures[k]->color(15, 8).z, 0.1f);
    }
    EXPECT_EQ(pictures[0]->color(15, 8).x, 0);  // behind the wall, seen from the lamp
}

TEST(RaytracedMaps, ShadowInIlluminanceAsksTheLightOfThisTurn) {
    SceneText scene = floor_and_wall(
        floor_code("illuminance(P, n, PI/2) Ci += color shadow(\"raytrace\", P);"), kBlack, 0.8);
    scene.rsl_light("lamp", "light l() { illuminate(point \"shader\" (0, 0, 0)) Cl = 1; }",
                    "<translate>4 0 2</translate>");
    scene.rsl_light("sun", "light s() { solar(vector \"world\" (0, 0, -1), 0) Cl = 1; }");
    Rendering r(scene.text());
    r.frame();
    ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
    EXPECT_EQ(r.color(15, 8), vec3(1.0f));  // hidden from the lamp, not from the sun
    EXPECT_EQ(r.color(0, 8), vec3(0.0f));
}

TEST(Transmission, OfAConeOfSamplesIsTheirMean) {
    // The cone's axis grazes the wall's top edge: half the samples are blocked.
    SceneText scene = floor_and_wall(
        floor_code("point top = point \"world\" (1.25, 0, 0.8); vector way = 3 * (top - P);"
                   " Ci = transmission(P, P + way, \"samples\", 256, \"samplecone\", 0.05);"),
        kBlack, 0.8);
    Rendering r(scene.text());
    r.frame();
    EXPECT_NEAR(r.color(8, 7).x, 0.5, 0.02) << r.findings();
}

// ---- all of them

SceneText ray_zoo() {
    SceneText scene = floor_and_wall(
        floor_code(
            "color c = 0; vector way = 0; gather(\"\", P, n, 1, 6, \"surface:Ci\", c,"
            " \"ray:direction\", way) Ci += c * random(); else Ci += 0.1 * abs(xcomp(way));"
            " Ci += occlusion(P, n, 9) + indirectdiffuse(P, n, 7);"
            " Ci += trace(P, right + up, \"samples\", 3, \"samplecone\", 0.5);"
            " Ci *= transmission(P, P + 3 * up + right, \"samples\", 3, \"samplecone\", 0.2);"),
        "surface wall() { Oi = 0.5 + 0.4 * noise(3 * P); Ci = Oi * (0.2 + diffuse(normalize(N)))"
        " + 0.1 * trace(P, normalize(N)); }",
        0.8);
    scene.octahedron("ball").look("mirror",
                                  "surface m() { Oi = 1; normal nn = normalize(N);"
                                  " Ci = 0.1 + 0.5 * trace(P, reflect(normalize(I), nn)); }");
    scene.place("ball", "mirror", "<translate>0 0 0.5</translate><scale>.4 .4 .4</scale>");
    scene.light("bulb", "<point><color>1 1 1</color></point>", "<translate>-2 2 3</translate>");
    return scene;
}

TEST(Rays, GiveTheSameBytesForAnyThreadsTilesAndTargets) {
    raytrace::Film first;
    for (const jit::Target& target : jit::targets()) {
        if (!target.supported()) continue;
        for (int threads : {1, 2}) {
            Threads count(threads);
            SceneOptions options;
            options.target = &target;
            Rendering r(ray_zoo().text(), options);
            ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
            if (threads == 2) {
                r.settings.integrator.tile = 4;
                r.settings.integrator.chunk_rays = 16;
            }
            r.settings.integrator.samples_per_pixel = 2;
            r.frame(33, 21);
            if (first.rgba.empty()) first = r.film;
            EXPECT_TRUE(same_bytes(first, r.film))
                << target.name << " " << threads << ": " << difference(first, r.film);
        }
    }
    float sum = 0;
    for (const vec4& pixel : first.rgba) sum += pixel.x;
    EXPECT_GT(sum, 10);
}

TEST(Rays, AllocateNothingAfterTheFirstFrames) {
    Threads one(1);
    Rendering r(ray_zoo().text());
    for (int k = 0; k < 3; ++k) r.frame(32, 32);
    watch_allocations();
    render_frame(*r.scene, *r.pose, 0, r.settings, r.film, r.stats, r.diagnostics);
    size_t count = allocations_of_ours();
    EXPECT_EQ(count, 0u) << "the first at " << first_allocation_of_ours();
}

// ---- footprints in curved mirrors ---------------------------------------------------------------

constexpr double kBall = 0.8, kSky = 12;  // its radius; the height of what it shows

// A ball of smooth normals below a large sheet that shows the footprints on it, in units.
SceneText mirror_ball(const std::string& turned) {
    SceneText scene;
    constexpr int kRound = 192, kUp = 96;
    std::vector<dvec3> at, normals;
    std::vector<int> triangles;
    for (int j = 0; j <= kUp; ++j)
        for (int i = 0; i <= kRound; ++i) {
            const double up = kPi * j / kUp, turn = 2 * kPi * i / kRound;
            normals.push_back(
                {std::sin(up) * std::cos(turn), std::cos(up), std::sin(up) * std::sin(turn)});
            at.push_back(kBall * normals.back());
        }
    for (int j = 0; j < kUp; ++j)
        for (int i = 0; i < kRound; ++i) {
            const int a = j * (kRound + 1) + i, b = a + kRound + 1;
            for (int k : {a, a + 1, b + 1, a, b + 1, b}) triangles.push_back(k);
        }
    scene
        .look("mirror",
              "surface mirror() { Oi = 1; Ci = trace(P, reflect(normalize(I), normalize(N))); }")
        .look("sky", "surface sky() { Oi = 1; Ci = 2000 * color(du, dv, 0); }")
        .mesh("ball", at, triangles, normals)
        .square("sheet", 1000)
        .place("ball", "mirror", turned, "ball-node")
        .place("sheet", "sky", "<translate>0 0 12</translate><rotate>1 0 0 180</rotate>");
    return scene;
}

// Where the sheet is that a pixel's centre shows.
dvec2 seen_in_ball(dvec2 p) {
    const dvec3 P(p, std::sqrt(kBall * kBall - glm::dot(p, p))), N = P / kBall;
    const dvec3 in(0, 0, -1), R = in - 2 * glm::dot(in, N) * N;
    return dvec2(P) + dvec2(R) * ((kSky - P.z) / R.z);
}

TEST(Footprints, InABallAreThoseOfFiniteDifferences) {
    // Placed once; an instance that moves, in other axes and of another size.
    SceneText moving = mirror_ball(
        "<rotate sid=\"turn\">0 1 0 20</rotate><rotate>1 0 0 70</rotate><scale>2 2 2</scale>"
        "<scale>.5 .5 .5</scale>");
    moving.animate("ball-node/turn.ANGLE", {0, 1}, {20, 60});
    for (const std::string& text : {mirror_ball("").text(), moving.text()}) {
        Rendering r(text);
        r.frame(24, 24);
        ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
        const double pixel = 2.0 / 24, step = 1e-5;
        int compared = 0;
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 24; ++x) {
                const dvec2 p = r.place(x, y);
                if (glm::length(p) > 0.6 * kBall) continue;  // beyond 0.7 it shows the other side
                const dvec2 dx =
                    seen_in_ball(p + dvec2(step, 0)) - seen_in_ball(p - dvec2(step, 0));
                const dvec2 dy =
                    seen_in_ball(p + dvec2(0, step)) - seen_in_ball(p - dvec2(0, step));
                const double scale = pixel / (2 * step);
                const double du = scale * std::max(std::abs(dx.x), std::abs(dy.x));
                const double dv = scale * std::max(std::abs(dx.y), std::abs(dy.y));
                EXPECT_GT(du, 25 * pixel);  // a flat mirror would show a pixel's width
                EXPECT_NEAR(r.color(x, y).x, du, 0.03 * du) << p.x << " " << p.y;
                EXPECT_NEAR(r.color(x, y).y, dv, 0.03 * dv) << p.x << " " << p.y;
                ++compared;
            }
        EXPECT_GT(compared, 80);
    }
}

}  // namespace
}  // namespace kinora
