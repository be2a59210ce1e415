// tests/runtime/ray_budget_test.cpp: how many rays a picture costs: one way of two at deep hits,
// and the limits of loops that shoot or print.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <sstream>

#include "expect_colors.h"
#include "ray_scenes.h"

namespace kinora {
namespace {

// ---- reflection and transparency ----------------------------------------------------------------

std::string common_material(const std::string& id, double reflects, double passes,
                            const std::string& color) {
    return fmt::format(
        "<effect id=\"{}-fx\"><profile_COMMON><technique sid=\"t\"><phong>"
        "<emission><color>{} 1</color></emission><diffuse><color>0.2 0.2 0.2 1</color></diffuse>"
        "<reflective><color>1 0.9 0.8 1</color></reflective><reflectivity><float>{}</float>"
        "</reflectivity><transparent opaque=\"A_ONE\"><color>1 1 1 1</color></transparent>"
        "<transparency><float>{}</float></transparency></phong></technique></profile_COMMON>"
        "</effect>",
        id, color, reflects, 1 - passes);
}

SceneText& add_material(SceneText& scene, const std::string& id, double reflects, double passes,
                        const std::string& color) {
    scene.effects += common_material(id, reflects, passes, color);
    scene.materials +=
        fmt::format("<material id=\"{0}\"><instance_effect url=\"#{0}-fx\"/></material>", id);
    return scene;
}

// A ball of 12 x 24 faces with smooth normals.
void add_ball(SceneText& scene) {
    std::vector<dvec3> points;
    std::vector<int> triangles;
    constexpr int kRings = 12, kSides = 24;
    for (int r = 0; r <= kRings; ++r)
        for (int k = 0; k < kSides; ++k) {
            double theta = kPi * r / kRings, phi = 2 * kPi * k / kSides;
            points.push_back({std::sin(theta) * std::cos(phi), std::cos(theta),
                              std::sin(theta) * std::sin(phi)});
        }
    for (int r = 0; r < kRings; ++r)
        for (int k = 0; k < kSides; ++k) {
            int a = r * kSides + k, b = r * kSides + (k + 1) % kSides;
            for (int corner : {a, b, a + kSides, b, b + kSides, a + kSides})
                triangles.push_back(corner);
        }
    scene.mesh("ball", points, triangles, points);
}

// Four balls that touch, each reflective and transparent, before a wall and over a floor.
SceneText four_balls(double reflects, double passes) {
    SceneText scene;
    add_ball(scene);
    add_material(scene, "glass", reflects, passes, "0.02 0.04 0.06");
    for (dvec3 at : {dvec3(-0.4, -0.4, 0), dvec3(0.4, -0.4, 0.2), dvec3(-0.4, 0.4, 0.4),
                     dvec3(0.4, 0.4, -0.3)})
        scene.place("ball", "glass",
                    fmt::format("<translate>{} {} {}</translate><scale>0.45 0.45 "
                                "0.45</scale>",
                                at.x, at.y, at.z));
    add_material(scene, "wall", 0, 0, "0.5 0.3 0.7");
    scene.square("plane", 3).place("plane", "wall", "<translate>0 0 -2</translate>");
    scene.light("sun", "<directional><color>1 1 1</color></directional>",
                "<rotate>0 1 0 30</rotate><rotate>1 0 0 -40</rotate>");
    return scene;
}

// A picture of so many samples a pixel.
struct Picture {
    Picture(const SceneText& scene, const SceneOptions& options, int size, int samples)
        : r(scene.text(), options) {
        r.settings.integrator.samples_per_pixel = samples;
        r.frame(size, size);
    }
    Rendering r;
    double rays_per_sample() const {
        return double(r.stats.rays) / double(r.film.width * r.film.height) /
               r.settings.integrator.samples_per_pixel;
    }
};

dvec4 mean(const raytrace::Film& film) {
    dvec4 sum(0.0);
    for (int y = 0; y < film.height; ++y)
        for (int x = 0; x < film.width; ++x) sum += dvec4(film.at(x, y));
    return sum / double(film.width * film.height);
}

TEST(OneWay, OfFourGlassBallsTakesAtMostThirtyRaysASample) {
    Picture picture(four_balls(0.5, 0.5), {}, 96, 4);
    EXPECT_FALSE(picture.r.diagnostics.has_errors()) << picture.r.findings();
    EXPECT_LE(picture.rays_per_sample(), 30);
    EXPECT_GT(picture.rays_per_sample(), 2);
}

// Against both ways at all hits.
TEST(OneWay, KeepsTheMeanOfThePicture) {
    SceneText scene = four_balls(0.5, 0.5);
    SceneOptions options;
    options.quality.ray_depth = 5;
    Picture one(scene, options, 48, 64);
    options.quality.split = 64;
    Picture both(scene, options, 48, 4);
    EXPECT_LT(one.rays_per_sample(), both.rays_per_sample());
    for (int k = 0; k < 4; ++k)
        EXPECT_NEAR(mean(one.r.film)[k], mean(both.r.film)[k], 1.0 / 512) << "channel " << k;
}

// A pane before a bright wall, behind a mirror: the pane reflects 0.25 of a lamp of 1 and lets 0.5
// of a wall of 3 pass. Each sample has one of the two, the mean both.
TEST(OneWay, IsChosenByItsShare) {
    SceneText scene = floor_scene(
        "surface floor() { Oi = 1; vector up = vector \"world\" (0, 0, 1);"
        " Ci = trace(P, up, \"weight\", 1, \"opacity\", Oi); }");
    const char* pane =
        "surface pane() { Oi = 0.5; vector down = vector \"world\" (0, 0, -1);"
        " Ci = 0.25 * trace(P, down, \"weight\", 0.25, \"opacity\", Oi); }";
    scene.look("pane", pane).place("floor", "pane", "<translate>0 0 20</translate>");
    scene.look("wall", "surface wall() { Oi = 1; Ci = 3; }");
    scene.place("floor", "wall", "<translate>0 0 30</translate>");
    // What the pane reflects: a floor of 1 between it and the camera.
    scene.look("lamp", "surface lamp() { Oi = 1; Ci = 1; }");
    scene.mesh("lamp-mesh", {{-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}}, {0, 1, 2, 0, 2, 3});
    scene.place("lamp-mesh", "lamp", "<translate>0 0 15</translate>");
    // The lamp would hide the pane from the floor; the floor's rays begin above it.
    std::string text = scene.text();
    text.replace(text.find("trace(P, up,"), 12, "trace(P + 16 * up, up,");
    Rendering once(text);
    once.frame();
    int lamps = 0;
    for (int k = 0; k < 256; ++k) {
        float got = once.color(k % 16, k / 16).x;
        bool lamp = std::abs(got - 0.75f) < 1e-4f, wall = std::abs(got - 2.25f) < 1e-4f;
        EXPECT_TRUE(lamp || wall) << got << once.findings();
        lamps += lamp;
    }
    EXPECT_GT(lamps, 256 / 3 - 35);  // five standard deviations
    EXPECT_LT(lamps, 256 / 3 + 35);
    SceneOptions options;
    options.quality.split = 2;
    Rendering both(text, options);
    expect_colors(both.frame(), [](dvec2) { return dvec3(0.25 + 1.5); });
}

// Two panes before the camera: at the second the sum of both ways is kept, and so is alpha.
TEST(OneWay, KeepsTheMeanOfAlpha) {
    SceneText scene;
    add_material(scene, "pane", 0.4, 0.6, "0.1 0.1 0.1");
    scene.square("square", 1.5);
    for (double z : {0.0, 1.0})
        scene.place("square", "pane", fmt::format("<translate>0 0 {}</translate>", z));
    SceneOptions options;
    options.quality.split = 64;
    dvec4 both = mean(Picture(scene, options, 16, 1).r.film);
    EXPECT_NEAR(both.w, 1 - 0.36, 1e-5);
    dvec4 one = mean(Picture(scene, {}, 16, 256).r.film);
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(one[k], both[k], 1.0 / 512) << k;
}

// A mirror of a mirror that reflects 1/1000 of a lamp of 100.
TEST(OneWay, OfSmallShareEndsAtRandomAndKeepsTheMean) {
    const char* weak =
        "surface weak() { Oi = 1; vector up = vector \"world\" (0, 0, 1);"
        " Ci = 0.001 * trace(P, up, \"weight\", 0.001); }";
    SceneText scene = floor_scene(
        "surface floor() { Oi = 1; Ci = trace(P, vector \"world\" (0, 0, 1), \"weight\", 1); }");
    scene.look("weak", weak).place("floor", "weak", "<translate>0 0 20</translate>");
    scene.look("lamp", "surface lamp() { Oi = 1; Ci = 100; }");
    scene.place("floor", "lamp", "<translate>0 0 30</translate>");
    Picture picture(scene, {}, 32, 256);
    EXPECT_NEAR(mean(picture.r.film).x, 0.1, 0.003) << picture.r.findings();
    // Camera, mirror, and 0.256 of the last.
    EXPECT_NEAR(picture.rays_per_sample(), 2.256, 0.02);
}

TEST(OneWay, IsTheSameOnAnyNumberOfThreads) {
    SceneText scene = four_balls(0.6, 0.7);
    auto picture = [&](int threads) {
        Threads set(threads);
        return std::move(Picture(scene, {}, 130, 2).r.film);
    };
    EXPECT_TRUE(same_bytes(picture(1), picture(3)));
}

// ---- loops that shoot ---------------------------------------------------------------------------

struct Endless {
    const char* name;
    const char* body;
    int rays;  // of a turn
};
const Endless kEndless[] = {
    {"gather", "gather(\"\", P, up, PI / 2, 1000, \"surface:Ci\", c) Ci += c;", 1000},
    {"trace", "Ci += trace(P, up + right * random());", 1},
    {"occlusion", "Ci += occlusion(P, n, 64);", 64},
    {"indirectdiffuse", "Ci += indirectdiffuse(P, n, 64);", 64},
    {"transmission", "Ci += transmission(P, P + 9 * up);", 1},
};

TEST(RayLimit, EndsLoopsThatDoNotEnd) {
    for (const Endless& e : kEndless) {
        SCOPED_TRACE(e.name);
        std::string loop =
            fmt::format("color c = 0; float i = 0; while (i < 1000000) {{ {} i += 1; }}", e.body);
        // What is seen has the same loop.
        SceneText scene = floor_and_wall(floor_code(loop), floor_code(loop), 0.8);
        Rendering r(scene.text());
        r.frame(4, 4);
        EXPECT_FALSE(r.diagnostics.has_errors()) << r.findings();
        EXPECT_EQ(r.count("RAY_LIMIT"), 1) << r.findings();
        EXPECT_EQ(r.count("SHADER_FAULT"), 0) << r.findings();
        EXPECT_GE(r.stats.rays, 16u * 1000u);
        EXPECT_LT(r.stats.rays, 16u * 40000u);
    }
}

// A loop that ends in time is not touched, and its other work is done.
TEST(RayLimit, LeavesLoopsBelowItAlone) {
    const char* body =
        "float i = 0, open = 0; while (i < 900) { open += comp(transmission(P, P + 0.01 * up), 0);"
        " i += 1; } Ci = color(open, i, 0) / 900;";
    Rendering r(floor_and_wall(floor_code(body), kBlack, 0.8).text());
    expect_colors(
        r.frame(), [](dvec2) { return dvec3(1, 1, 0); }, 1e-5);
    EXPECT_EQ(r.count("RAY_LIMIT"), 0) << r.findings();
}

TEST(RayLimit, CanBeRaised) {
    const char* body =
        "float i = 0; color c = 0; while (i < 3000) { c += trace(P, up); i += 1; }"
        " Ci = c + i / 3000;";
    SceneText scene = floor_and_wall(floor_code(body), kBlack, 0.8);
    Rendering stopped(scene.text());
    stopped.frame(4, 4);
    EXPECT_NEAR(stopped.color(1, 1).x, 1001 / 3000.0, 2e-3);
    EXPECT_EQ(stopped.count("RAY_LIMIT"), 1) << stopped.findings();
    EXPECT_NE(stopped.findings().find("16 shading points"), std::string::npos)
        << stopped.findings();
    SceneOptions options;
    options.quality.ray_limit = 3000;
    Rendering whole(scene.text(), options);
    whole.frame(4, 4);
    EXPECT_EQ(whole.color(1, 1).x, 1.0f);
    EXPECT_EQ(whole.count("RAY_LIMIT"), 0) << whole.findings();
}

// One call of many samples is answered whole.
TEST(RayLimit, DoesNotCutACall) {
    Rendering r(floor_and_wall(floor_code("Ci = occlusion(P, n, 4096);"), kBlack, 0.8).text());
    r.frame(4, 4);
    EXPECT_EQ(r.count("RAY_LIMIT"), 0) << r.findings();
    EXPECT_GE(r.stats.rays, 16u * 4096u);
    EXPECT_NEAR(r.color(3, 1).x, wall_share(0.75, 0.8), 0.01);
}

// ---- rays of all depths -------------------------------------------------------------------------

// The inside of a box whose walls send 1 and half of what `light` says that they get: after b
// bounces 1 + 1/2 + ... + 1/2^b is seen.
struct Box {
    // `behind`: samples of a call behind the first bounce, 0 all that are asked for.
    Box(const std::string& light, uint32_t limit, uint32_t bounces, uint32_t behind = 0) {
        SceneText scene;
        add_box(scene,
                "surface box() { Oi = 1; normal n = faceforward(normalize(N), I); Ci = 1 + " +
                    light + "; }");
        SceneOptions options;
        options.quality.ray_limit = limit;
        options.quality.diffuse_depth = bounces;
        options.quality.samples_behind = behind;
        picture.emplace(scene.text(), options);
        picture->frame(64, 64);
    }
    double rays() const { return double(picture->stats.rays) / (64 * 64); }
    double mean_color() const { return mean(picture->film).x; }
    int count(const char* code) const { return picture->count(code); }
    std::optional<Rendering> picture;
};

TEST(RayLimit, IsOfIndirectRaysOfAllDepths) {
    const std::string light = "0.5 * indirectdiffuse(P, n, 16)";
    for (uint32_t limit : {30u, 100u, 1000u}) {
        SCOPED_TRACE(limit);
        Box box(light, limit, 4);
        EXPECT_LE(box.rays(), limit);
        EXPECT_GT(box.rays(), 16);
        // At 30 one path of sixteen is followed behind the first bounce.
        EXPECT_NEAR(box.mean_color(), 1.9375, limit == 30 ? 0.03 : 0.005);
        EXPECT_EQ(box.count("RAY_SAMPLES"), 1) << box.picture->findings();
    }
    // 16 + 256 rays fit: each is sent.
    Box all(light, 1000, 2);
    EXPECT_EQ(all.rays(), 1 + 16 + 256);
    EXPECT_EQ(all.picture->findings(), "");
    EXPECT_NEAR(all.mean_color(), 1.75, 1e-5);
}

// As a public material has it: 256 samples wherever it is seen.
TEST(RayLimit, HoldsForManySamplesAtEachHit) {
    Box box("0.5 * indirectdiffuse(P, n, 256)", 1000, 3);
    EXPECT_LE(box.rays(), 1000);
    EXPECT_NEAR(box.mean_color(), 1.875, 0.005);
}

// A loop over what is gathered divides by the samples that it asked for, or sums solid angles.
TEST(RayLimit, IsOfGatheredRaysOfAllDepths) {
    const std::string gathered =
        "surface box() { Oi = 1; normal n = faceforward(normalize(N), I); color c = 0, sum = 0;"
        " gather(\"illuminance\", P, n, PI / 2, 64, \"distribution\", \"cosine\","
        " \"surface:Ci\", c) sum += c; Ci = 1 + 0.5 * sum / 64; }";
    SceneText scene;
    add_box(scene, gathered);
    SceneOptions options;
    options.quality.ray_depth = 2;
    options.quality.samples_behind = 0;
    Rendering cut(scene.text(), options);
    cut.frame(16, 16);
    EXPECT_LE(double(cut.stats.rays) / 256, 1000);
    EXPECT_NEAR(mean(cut.film).x, 1.75, 1e-5) << cut.findings();
    EXPECT_EQ(cut.count("RAY_SAMPLES"), 1) << cut.findings();
    options.quality.ray_limit = 20000;
    Rendering whole(scene.text(), options);
    whole.frame(16, 16);
    EXPECT_EQ(whole.stats.rays, 256u * (1 + 64 + 64 * 64));
    EXPECT_EQ(whole.findings(), "");
}

// Counts hold where the eye looks; behind the first bounce a path goes on with one ray.
TEST(SamplesBehind, AreOneAPathUnlessMoreAreWanted) {
    Box one("0.5 * indirectdiffuse(P, n, 16)", 1000, 4, 1);
    EXPECT_EQ(one.rays(), 1 + 4 * 16);
    EXPECT_NEAR(one.mean_color(), 1.9375, 1e-5);
    EXPECT_EQ(one.picture->findings(), "");
    Box four("0.5 * indirectdiffuse(P, n, 16)", 1000, 3, 4);
    EXPECT_EQ(four.rays(), 1 + 16 + 16 * 4 + 16 * 4 * 4);
    EXPECT_NEAR(four.mean_color(), 1.875, 1e-5);
    // The largest divisor: 5 of 6 samples would not weigh alike.
    Box divisor("0.5 * indirectdiffuse(P, n, 6)", 1000, 2, 5);
    EXPECT_EQ(divisor.rays(), 1 + 6 + 6 * 3);
}

// A mirror shows what it sees with all samples; a ray of a cone does not.
TEST(SamplesBehind, AreAllOfThemInAMirror) {
    auto rays = [&](const std::string& cone) {
        SceneText scene;
        add_box(scene,
                "surface box() { Oi = 1; normal n = faceforward(normalize(N), I);"
                " float depth = 0; rayinfo(\"depth\", depth); Ci = depth == 0 ? trace(P, n" +
                    cone + ") : color(occlusion(P, n, 8)); }");
        Rendering r(scene.text());
        r.frame(16, 16);
        EXPECT_NEAR(mean(r.film).x, 1, 1e-5) << r.findings();
        return double(r.stats.rays) / 256;
    };
    EXPECT_EQ(rays(""), 1 + 1 + 8);
    EXPECT_EQ(rays(", \"samplecone\", 0.1, \"samples\", 4"), 1 + 4 + 4);
}

// The limit is of each ray of many; the eye's own and a mirror's have none.
TEST(ClampIndirect, DimsWhatRaysOfManyBring) {
    auto expect = [&](const std::string& light, double most, vec3 wanted) {
        SceneText scene;
        add_box(scene,
                "surface box() { Oi = 1; normal n = faceforward(normalize(N), I); float depth = 0;"
                " rayinfo(\"depth\", depth); color c = 0, all = 0; Ci = color(8, 4, 2);"
                " if (depth == 0) {" +
                    light + "} }");
        SceneOptions options;
        options.quality.clamp_indirect = most;
        Rendering r(scene.text(), options);
        r.frame(8, 8);
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(r.color(4, 4)[k], wanted[k], 1e-5) << light << most << r.findings();
    };
    const char* gathered =
        "gather(\"illuminance\", P, n, PI / 2, 4, \"surface:Ci\", c) all += c;"
        " Ci = all / 4;";
    expect("Ci = indirectdiffuse(P, n, 4);", 0, {8, 4, 2});
    expect("Ci = indirectdiffuse(P, n, 4);", 2, {2, 1, 0.5});
    expect(gathered, 2, {2, 1, 0.5});
    expect("Ci = trace(P, n);", 2, {8, 4, 2});
    expect("", 2, {8, 4, 2});
}

// Two calls a hit share what there is, and neither is left out.
TEST(RayLimit, IsSharedByTheCallsOfAPoint) {
    Box box("0.25 * indirectdiffuse(P, n, 16) + 0.25 * indirectdiffuse(P, n, 8)", 1000, 3);
    EXPECT_LE(box.rays(), 1000);
    EXPECT_NEAR(box.mean_color(), 1.875, 0.01);
}

// The points behind one another along a camera ray share what it has.
TEST(RayLimit, IsOfTheCameraRay) {
    const char* pane =
        "surface pane() { float i = 0; Oi = 0.5; Ci = 0; while (i < 400) {"
        " Ci += 0.5 * transmission(P, P + vector \"world\" (0, 0, 0.001)) / 400; i += 1; } }";
    SceneText scene;
    scene.square("square", 1.5).look("pane", pane);
    for (int k = 0; k < 6; ++k)
        scene.place("square", "pane", fmt::format("<translate>0 0 {}</translate>", -k));
    Rendering r(scene.text());
    r.frame(4, 4);
    EXPECT_EQ(r.count("RAY_LIMIT"), 1) << r.findings();
    EXPECT_GT(r.stats.rays, 16u * 1000u);  // one ray a call: it meets nothing
    EXPECT_LT(r.stats.rays, 16u * 1100u);
}

// ---- rays of many points together ---------------------------------------------------------------

// Walls of a box that tell apart which of them a ray meets, around a floor.
SceneText walled_floor(const std::string& body) {
    SceneText scene = floor_scene("surface floor() { Oi = 1; Ci = 0; " + body + " }");
    add_box(scene,
            "surface box() { Oi = 1; point w = transform(\"world\", P); Ci = color(0, 0.5, 0);"
            " if (zcomp(w) > 39.9) Ci = color(1, 1, 1);"
            " if (xcomp(w) > 39.9) Ci = color(0.25, 0, 0); }");
    return scene;
}
constexpr const char* kThreeWays =
    "vector up = vector \"world\" (0, 0, 1); vector right = vector \"world\" (1, 0, 0.01);"
    " vector left = vector \"world\" (-1, 0, 0.01); ";

// While rays are only noted, nothing is seen: a shader that then goes another way is answered
// for the way it goes in truth.
TEST(FullPackets, CallsMayDependOnWhatEarlierOnesSaw) {
    SceneText scene = walled_floor(std::string(kThreeWays) +
                                   "color c = trace(P, up); vector d = left;"
                                   " if (comp(c, 0) > 0.5) d = right; Ci = trace(P, d);");
    Rendering r(scene.text());
    expect_colors(r.frame(), [](dvec2) { return dvec3(0.25, 0, 0); });
    EXPECT_EQ(r.findings(), "");
}

// The same call in turns of a loop whose number of turns depends on what was seen.
TEST(FullPackets, LoopsThatEndByWhatTheySeeRunAsOften) {
    SceneText scene = walled_floor(std::string(kThreeWays) +
                                   "float n = 0; color c = color(0, 1, 0);"
                                   " while (n < 5 && comp(c, 1) > 0) {"
                                   " if (n > 2) c = trace(P, right); else c = trace(P, left);"
                                   " n += 1; Ci += color(0, 0, 0.125); }");
    Rendering r(scene.text());
    expect_colors(r.frame(), [](dvec2) { return dvec3(0, 0, 0.5); });
}

// Noting rays spends nothing: a ray a point is traced, however the points are grouped.
TEST(FullPackets, EachRayIsTracedOnce) {
    auto rays = [](const std::string& body) {
        Rendering r(walled_floor(kThreeWays + body).text());
        r.frame(16, 16);
        return r.stats.rays;
    };
    uint64_t none = rays("Ci = 1;"), one = rays("Ci = trace(P, up);");
    EXPECT_EQ(one, 2 * none);
    EXPECT_EQ(rays("Ci = trace(P, up) + trace(P, left);"), 3 * none);
}

// What a shader says while its rays are noted is said once.
TEST(FullPackets, PrintsOnce) {
    auto said = [](const std::string& call) {
        SceneText scene = walled_floor(kThreeWays + ("Ci = " + call) + "; printf(\"seen\\n\");");
        testing::internal::CaptureStdout();
        Rendering r(scene.text());
        r.frame(4, 4);
        return testing::internal::GetCapturedStdout();
    };
    std::string once = said("color(1, 1, 1)");
    EXPECT_EQ(std::count(once.begin(), once.end(), '\n'), 16);
    EXPECT_EQ(said("trace(P, up)"), once);
}

// A pane that is nowhere near the rays to the light costs none.
TEST(ShadowRays, ThatMeetNothingAreTracedOnce) {
    auto rays = [](bool pane) {
        SceneText scene = floor_scene("surface s() { Oi = 1; Ci = diffuse(normalize(N)); }");
        scene.rsl_light("lamp", "light lamp() { illuminate(point \"world\" (0, 0, 5)) Cl = 1; }");
        scene.look("aside",
                   std::string("surface pane() { Ci = 0; Oi = ") + (pane ? "0.5" : "1") + "; }");
        scene.place("floor", "aside", "<translate>500 0 0</translate>");
        Rendering r(scene.text());
        r.frame(4, 4);
        EXPECT_GT(r.color(1, 1).x, 0.1f) << r.findings();
        return r.stats.rays;
    };
    EXPECT_EQ(rays(true), rays(false));
}

TEST(RayLimit, HoldsForLightShaders) {
    SceneText scene = floor_scene("surface s() { Oi = 1; Ci = diffuse(normalize(N)); }");
    scene.rsl_light("lamp",
                    "light lamp() { illuminate(point \"world\" (0, 0, 5)) { float i = 0; Cl = 0;"
                    " while (i < 1000000) { Cl += transmission(Ps, Ps - L) / 1000; i += 1; } } }");
    Rendering r(scene.text());
    r.frame(4, 4);
    EXPECT_EQ(r.count("RAY_LIMIT"), 1) << r.findings();
    EXPECT_LT(r.stats.rays, 16u * 1100u);
}

TEST(RayLimit, IsTheSameOnAnyNumberOfThreads) {
    const char* body =
        "color c = 0; float i = 0; while (i < 1000000) {"
        " gather(\"\", P, up, PI / 2, 16, \"surface:Ci\", c) Ci += c / 1000; i += 1; }";
    SceneText scene =
        floor_and_wall(floor_code(body), floor_code("Ci = occlusion(P, n, 64);"), 0.8);
    auto picture = [&](int threads) {
        Threads set(threads);
        Rendering r(scene.text());
        r.frame(68, 5);
        return std::move(r.film);
    };
    EXPECT_TRUE(same_bytes(picture(1), picture(2)));
}

// ---- printf -------------------------------------------------------------------------------------

std::string printed_by(const SceneText& scene, int size, int threads, int findings) {
    Threads set(threads);
    Rendering r(scene.text());
    testing::internal::CaptureStdout();
    r.frame(size, size);
    std::string text = testing::internal::GetCapturedStdout();
    EXPECT_EQ(r.count("PRINT_LIMIT"), findings) << r.findings();
    return text;
}

// The first lines of the picture, whoever rendered them.
TEST(PrintLimit, ShowsTheFirstLinesOfThePicture) {
    SceneText scene = floor_scene(
        "surface p() { Oi = 1; Ci = 1; point Q = transform(\"world\", P);"
        " printf(\"%f %f\\n\", xcomp(Q), ycomp(Q)); }");
    std::string one = printed_by(scene, 160, 1, 1);
    EXPECT_EQ(std::count(one.begin(), one.end(), '\n'), 10000);
    EXPECT_EQ(one, printed_by(scene, 160, 3, 1));
    std::istringstream lines(one);
    double x = 0, y = 0;
    for (int k = 0; k < 10000; ++k) {
        ASSERT_TRUE(lines >> x >> y);
        ASSERT_NEAR(x, -1 + (k % 160 + 0.5) / 80, 1e-4);
        ASSERT_NEAR(y, 1 - (k / 160 + 0.5) / 80, 1e-4);
    }
    printed_by(scene, 100, 1, 0);  // 10000 lines
}

TEST(PrintLimit, CountsBytesToo) {
    std::string word(500, 'x');
    SceneText scene =
        floor_scene("surface p() { Oi = 1; Ci = 1; printf(\"" + word + "\\n\", xcomp(P)); }");
    std::string text = printed_by(scene, 90, 2, 1);
    EXPECT_LE(text.size(), 1u << 20);
    EXPECT_GT(text.size(), (1u << 20) - 1000u);
}

// A shader has its own lines, a loop at frame rate and a displacement too.
TEST(PrintLimit, IsOfEachShaderAtEachRate) {
    SceneText scene = floor_scene("surface p() { Oi = 1; Ci = 1; printf(\"a\\n\", s); }");
    scene.look("other", "surface q() { Oi = 1; Ci = 1; printf(\"b\\n\", s); }");
    scene.place("floor", "other", "<translate>2.2 0 1</translate>");
    std::string text = printed_by(scene, 180, 2, 1);
    EXPECT_EQ(std::count(text.begin(), text.end(), 'a'), 10000);
    EXPECT_GT(std::count(text.begin(), text.end(), 'b'), 3000);

    // One shader on two materials has its lines once.
    SceneText twice = floor_scene("surface p() { Oi = 1; Ci = 1; printf(\"a\\n\", s); }");
    twice.look("other", "surface p() { Oi = 1; Ci = 1; printf(\"a\\n\", s); }");
    twice.place("floor", "other", "<translate>1 0 1</translate>");
    text = printed_by(twice, 180, 2, 1);
    EXPECT_EQ(std::count(text.begin(), text.end(), 'a'), 10000);

    SceneText frame = floor_scene(
        "surface p(float n = 20000;) { uniform float i; Oi = 1; Ci = 1;"
        " for (i = 0; i < n; i += 1) printf(\"u\\n\", i); }");
    text = printed_by(frame, 4, 1, 1);
    EXPECT_EQ(std::count(text.begin(), text.end(), 'u'), 10000);

    SceneText moved = floor_scene(
        "displacement d() { float i = 0; while (i < 30000) { printf(\"d\\n\", i + s); i += 1; } }\n"
        "surface p() { Oi = 1; Ci = 1; }",
        "<shader stage=\"DISPLACEMENT\"/><shader stage=\"SURFACE\"/>");
    Threads set(1);
    testing::internal::CaptureStdout();
    Rendering r(moved.text());
    r.frame(4, 4);
    text = testing::internal::GetCapturedStdout();
    EXPECT_LE(std::count(text.begin(), text.end(), 'd'), 2 * 10000);
    EXPECT_GE(std::count(text.begin(), text.end(), 'd'), 10000);
}

}  // namespace
}  // namespace kinora
