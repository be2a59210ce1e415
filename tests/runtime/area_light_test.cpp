// tests/runtime/area_light_test.cpp: lights on geometry against closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "expect_colors.h"
#include "jit/target.h"
#include "scene_text.h"

namespace kinora {
namespace {

// The standard point light's falloff, and a Lambertian emitter of the same.
const char* kPoint =
    "light area(float intensity = 1; color lightcolor = 1;) {"
    "  illuminate (P, N, PI/2) { Cl = intensity * lightcolor / (L . L); } }";
const char* kLambert =
    "light area(float intensity = 1; color lightcolor = 1;) {"
    "  illuminate (P, N, PI/2) {"
    "    Cl = intensity * lightcolor * (normalize(L) . normalize(N)) / (L . L); } }";
const char* kDown = "<rotate>1 0 0 180</rotate>";  // the square looks along -z

std::string emitter_passes(const std::string& binds = "") {
    return "<shader stage=\"LIGHT\">" + binds + "</shader>";
}
std::string samples(int n) {
    return rsl_extra(fmt::format("<samples>{}</samples>", n));
}

// The lamp stands above the eye (at z = 10), so that it hides nothing.
SceneText& lamp(SceneText& scene, const std::string& code, double half, double height, int n,
                const std::string& binds = "", const std::string& transforms = "") {
    return scene.square("lamp", half)
        .look("lamp-look", code, emitter_passes(binds), "", samples(n))
        .place("lamp", "lamp-look",
               fmt::format("<translate>0 0 {}</translate>{}{}", height, transforms, kDown));
}

// Form factor of a rectangle [0,x] x [0,y] at distance 1, parallel to a differential element under
// its corner (Howell, A catalog of radiation configuration factors, B-4).
double corner_factor(double x, double y) {
    double a = std::sqrt(1 + x * x), b = std::sqrt(1 + y * y);
    return (x / a * std::atan(y / a) + y / b * std::atan(x / b)) / (2 * kPi);
}
double rectangle_factor(dvec2 p, double half, double height) {
    auto signed_corner = [&](double x, double y) {
        return std::copysign(1.0, x * y) *
               corner_factor(std::abs(x) / height, std::abs(y) / height);
    };
    double x0 = -half - p.x, x1 = half - p.x, y0 = -half - p.y, y1 = half - p.y;
    return signed_corner(x1, y1) - signed_corner(x0, y1) - signed_corner(x1, y0) +
           signed_corner(x0, y0);
}

// Its "shader" space is the geometry's, without the mirror of lights on nodes.
TEST(AreaLight, HasTheSpaceOfItsGeometry) {
    SceneText scene =
        floor_scene("surface s() { Oi = 1; Ci = 0; illuminance(P, N, PI/2) Ci += Cl; }");
    lamp(scene,
         "light area() { illuminate(P, N, PI/2) { point p = transform(\"shader\", Ps);"
         "  Cl = color(xcomp(p), ycomp(p), zcomp(p)); } }",
         0.1, 11, 4);
    Rendering r(scene.text());
    // kDown turns it about x: y and z of the geometry go against the world's.
    expect_colors(
        r.frame(), [](dvec2 p) { return dvec3(p.x, -p.y, 11); }, 1e-4);
}

TEST(AreaLight, ARectanglesIrradianceIsItsFormFactor) {
    SceneText scene = floor_scene(kMatte);
    lamp(scene, kLambert, 3, 11, 1024, "<bind symbol=\"intensity\"><float>50</float></bind>");
    Rendering r(scene.text());
    EXPECT_EQ(r.findings(), "");
    r.frame();
    for (int y : {0, 6, 15})
        for (int x : {0, 8, 13}) {
            // The mean over the area of cos cos' / d^2 is pi F / A.
            double want = 50 * kPi * rectangle_factor(r.place(x, y), 3, 11) / 36;
            EXPECT_NEAR(r.color(x, y).x, want, 2e-3 * want) << x << "," << y;
        }
}

TEST(AreaLight, ASmallOneIsThePointLightWithItsShader) {
    SceneText scene = floor_scene(kMatte);
    lamp(scene, kPoint, 1e-4, 11, 4,
         "<bind symbol=\"intensity\"><float>200</float></bind>"
         "<bind symbol=\"lightcolor\"><color>1 0.5 0.25</color></bind>");
    Rendering r(scene.text());
    r.frame();
    for (int y : {0, 6, 15}) {
        dvec2 p = r.place(3, y);
        double d2 = p.x * p.x + p.y * p.y + 121, want = 200 * 11 / (d2 * std::sqrt(d2));
        EXPECT_NEAR(r.color(3, y).x, want, 2e-4 * want);
        EXPECT_NEAR(r.color(3, y).z, 0.25 * want, 2e-4 * want);
    }
}

// Mean of an emitter's answers over a sphere, integrated in double precision.
TEST(AreaLight, ASpheresIrradianceIsTheMeanOverItsLitSide) {
    const int rings = 24, sectors = 48;
    const double radius = 2, height = 13;
    std::vector<dvec3> positions, normals;
    std::vector<int> triangles;
    for (int i = 0; i <= rings; ++i)
        for (int j = 0; j < sectors; ++j) {
            double theta = kPi * i / rings, phi = 2 * kPi * j / sectors;
            dvec3 n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                    std::cos(theta));
            normals.push_back(n);
            positions.push_back(radius * n);
        }
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < sectors; ++j) {
            int a = i * sectors + j, b = i * sectors + (j + 1) % sectors;
            int c = a + sectors, d = b + sectors;
            if (i > 0) triangles.insert(triangles.end(), {a, c, b});
            if (i + 1 < rings) triangles.insert(triangles.end(), {b, c, d});
        }
    SceneText scene = floor_scene(kMatte);
    scene.mesh("ball", positions, triangles, normals)
        .look("ball-look", kLambert,
              emitter_passes("<bind symbol=\"intensity\"><float>600</float></bind>"), "",
              samples(2048))
        .place("ball", "ball-look", fmt::format("<translate>0 0 {}</translate>", height));
    Rendering r(scene.text());
    r.frame();
    for (int x : {1, 8, 15}) {
        dvec2 p = r.place(x, 5);
        double sum = 0;
        const int n = 600;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                double z = -1 + (i + 0.5) * 2 / n, phi = (j + 0.5) * 2 * kPi / n;
                double s = std::sqrt(1 - z * z);
                dvec3 normal(s * std::cos(phi), s * std::sin(phi), z);
                dvec3 to = dvec3(p.x, p.y, 0) - (radius * normal + dvec3(0, 0, height));
                double d = glm::length(to);
                sum += std::max(0.0, glm::dot(to, normal) / d) * std::max(0.0, -to.z / d) / (d * d);
            }
        double want = 600 * sum / (double(n) * n);
        EXPECT_NEAR(r.color(x, 5).x, want, 6e-3 * want) << x;
    }
}

TEST(AreaLight, ShinesWhereItsNormalsLook) {
    SceneText scene = floor_scene(kMatte);
    lamp(scene, kPoint, 1, 11, 16, "", "<rotate>1 0 0 180</rotate>");
    Rendering r(scene.text());
    EXPECT_EQ(r.frame().color(8, 8), vec3(0));
}

TEST(AreaLight, ABlockerOfHalfTheLampMakesHalfShadow) {
    SceneText scene = floor_scene(kMatte);
    lamp(scene, kLambert, 2, 12, 256);
    scene.square("flag", 1).look("black", "surface b() { Oi = 1; Ci = 0; }");
    // At half the height a half plane x < 0 hides the half x < 0 of the lamp from the origin.
    scene.place("flag", "black", "<translate>-3 0 11.999</translate><scale>3 6 1</scale>");
    Rendering half(scene.text());
    half.frame();
    SceneText open = floor_scene(kMatte);
    lamp(open, kLambert, 2, 12, 256);
    Rendering all(open.text());
    all.frame();
    for (int y : {3, 8, 12}) EXPECT_NEAR(half.color(8, y).x / all.color(8, y).x, 0.5, 0.02) << y;
}

TEST(AreaLight, ItsOwnSurfaceDoesNotShadowIt) {
    // Scales and places at which a fixed offset would fail.
    for (double scale : {1e-4, 1.0, 1e5}) {
        SceneText scene = floor_scene(kMatte);
        lamp(scene, kLambert, 2, 12, 64, "<bind symbol=\"intensity\"><float>100</float></bind>");
        scene.nodes = fmt::format("<node><scale>{0} {0} {0}</scale>{1}</node>", scale, scene.nodes);
        scene.cameras = fmt::format(
            "<camera id=\"eye\"><optics><technique_common><orthographic><xmag>{0}</xmag>"
            "<ymag>{0}</ymag></orthographic></technique_common></optics></camera>",
            scale);
        scene.camera_node =
            fmt::format("<node><translate>0 0 {}</translate><instance_camera url=\"#eye\"/></node>",
                        10 * scale);
        Rendering r(scene.text());
        r.frame();
        double want = 100 * kPi * rectangle_factor(r.place(8, 8), 2, 12) / 16 / (scale * scale);
        EXPECT_NEAR(r.color(8, 8).x / want, 1, 0.01) << scale;
    }
}

// A surface of area 1 that sends c / d^2 has the radiance pi c from before.
TEST(AreaLight, IsSeenAsItShinesOrByItsSurface) {
    SceneText scene;
    scene.square("lamp", 0.5)
        .look("plain", kPoint,
              emitter_passes("<bind symbol=\"lightcolor\"><color>1 0.5 0.25</color></bind>"))
        .look("dressed", std::string(kPoint) + "surface glow() { Oi = 1; Ci = color(0, 2, 0); }",
              emitter_passes() + "<shader stage=\"SURFACE\"/>")
        .place("lamp", "plain", "<translate>-0.5 0 0</translate>")
        .place("lamp", "dressed", "<translate>0.5 0 0</translate>");
    Rendering r(scene.text());
    r.frame();
    EXPECT_EQ(r.findings(), "");
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(r.color(4, 8)[k], kPi / (1 << k), 1e-4);
    EXPECT_EQ(r.color(12, 8), vec3(0, 2, 0));
}

TEST(AreaLight, DoesNotLightItself) {
    SceneText scene;
    scene.square("lamp", 1.5)
        .look("l", std::string(kPoint) + kMatte, emitter_passes() + "<shader stage=\"SURFACE\"/>")
        .place("lamp", "l");
    Rendering r(scene.text());
    r.frame();
    for (const vec4& pixel : r.film.rgba) EXPECT_EQ(vec3(pixel), vec3(0));
}

TEST(AreaLight, SamplesKnowTheirPlaceOnTheMesh) {
    // Light through a slide: red grows with s over the lamp; its mean is a half.
    SceneText scene = floor_scene(kMatte);
    lamp(scene,
         "light slide() { illuminate (P, N, PI/2) { Cl = 100 * color(s, t * t, 1) / (L . L); } }",
         1e-4, 11, 1024);
    Rendering r(scene.text());
    r.frame();
    vec3 c = r.color(8, 8);
    EXPECT_NEAR(c.x / c.z, 0.5, 1e-3);
    EXPECT_NEAR(c.y / c.z, 1.0 / 3, 2e-3);
}

TEST(AreaLight, FollowsItsNode) {
    SceneText scene = floor_scene(kMatte);
    scene.square("lamp", 1e-4)
        .look("lamp-look", kPoint, emitter_passes(), "", samples(1))
        .place("lamp", "lamp-look", fmt::format("<translate sid=\"t\">0 0 11</translate>{}", kDown),
               "mover")
        .animate("mover/t.X", {0, 1}, {0, 4});
    Rendering r(scene.text());
    for (double time : {0.0, 0.5, 1.0}) {
        r.frame(time);
        dvec2 p = r.place(2, 9);
        double x = p.x - 4 * time, d2 = x * x + p.y * p.y + 121;
        EXPECT_NEAR(r.color(2, 9).x, 11 / (d2 * std::sqrt(d2)), 1e-6) << time;
    }
}

TEST(AreaLight, FollowsItsMeshAsItDeforms) {
    // A strip bends by 80 degrees; what shines from it lights the wall the more on that side.
    SceneText scene;
    scene.look("lamp", std::string(kPoint), emitter_passes(), "", samples(256));
    scene.bending_strip("strip", "lamp", 16);
    scene.square("wall", 3)
        .look("matte", kMatte)
        .place("wall", "matte", "<translate>0 0 5</translate><rotate>0 1 0 180</rotate>");
    scene.camera_node =
        "<node><translate>0 0 -10</translate><rotate>0 1 0 180</rotate>"
        "<instance_camera url=\"#eye\"/></node>";
    scene.cameras.replace(scene.cameras.find("<xmag>1</xmag><ymag>1"),
                          std::string("<xmag>1</xmag><ymag>1").size(), "<xmag>3</xmag><ymag>3");
    Rendering r(scene.text());
    r.frame(0);
    float straight = r.color(0, 8).x - r.color(15, 8).x;
    r.frame(1);
    float bent = r.color(0, 8).x - r.color(15, 8).x;
    EXPECT_LT(std::abs(straight), 1e-3);
    EXPECT_GT(std::abs(bent), 2e-3);
}

TEST(AreaLight, SampleCountsComeFromTheMaterialOrTheOption) {
    SceneText scene = floor_scene(kMatte);
    lamp(scene, kLambert, 2, 12, 7);
    Rendering file(scene.text());
    uint64_t points = 16 * 16;
    file.frame();
    SceneOptions options;
    options.quality.light_samples = 3;
    Rendering option(scene.text(), options);
    option.frame();
    EXPECT_NEAR(double(file.stats.rays - points) / double(option.stats.rays - points), 7.0 / 3,
                1e-9);
    SceneText bad = floor_scene(kMatte);
    bad.square("lamp", 1)
        .look("l", kPoint, emitter_passes(), "", rsl_extra("<samples>many</samples>"))
        .place("lamp", "l", "<translate>0 0 12</translate>");
    EXPECT_EQ(Rendering(bad.text()).count("LIGHT_SAMPLES"), 1);
}

TEST(AreaLight, GivesTheSameBytesForAnyThreadsAndTargets) {
    SceneText scene = floor_scene(kMatte);
    lamp(scene, kLambert, 2, 12, 8, "<bind symbol=\"intensity\"><float>100</float></bind>");
    scene.octahedron("ball").place("ball", "floor-look", "<scale>0.5 0.5 0.5</scale>");
    std::string text = scene.text();
    Rendering first(text);
    first.settings.integrator.samples_per_pixel = 3;
    first.frame(40, 33);
    for (int threads : {1, 3}) {
        Threads scope(threads);
        Rendering again(text);
        again.settings.integrator.samples_per_pixel = 3;
        EXPECT_TRUE(same_bytes(first.film, again.frame(40, 33).film)) << threads << " threads";
    }
    for (const jit::Target& target : jit::targets()) {
        if (!target.supported()) continue;
        SceneOptions options;
        options.target = &target;
        Rendering again(text, options);
        again.settings.integrator.samples_per_pixel = 3;
        EXPECT_TRUE(same_bytes(first.film, again.frame(40, 33).film)) << target.name;
    }
}

// ---- a sun with a disc --------------------------------------------------------------------------

// A floor lit from straight above, half of the sky behind a sheet whose edge runs over x = 0.
constexpr double kSheet = 11;  // above the eye, so that it hides nothing
SceneText half_sky(const std::string& sun) {
    SceneText scene =
        floor_scene("surface s() { Oi = 1; Ci = 0; illuminance(P, normalize(N), PI/2) Ci += Cl; }");
    scene
        .mesh(
            "sheet",
            {{-1000, -1000, kSheet}, {0, -1000, kSheet}, {0, 1000, kSheet}, {-1000, 1000, kSheet}},
            {0, 1, 2, 0, 2, 3})
        .place("sheet", "floor-look")
        .rsl_light("sun", sun);
    return scene;
}
Rendering sunlit(const std::string& sun, uint32_t samples) {
    SceneOptions options;
    options.quality.light_samples = samples;
    return Rendering(half_sky(sun).text(), options);
}

// Of a disc of that half-angle, uniform in solid angle, the share that a point at x sees: the part
// of each ring about the zenith beyond the edge, which stands at atan(-x / height).
double seen_share(double x, double half_angle) {
    constexpr int kRings = 4000;
    double seen = 0, all = 0;
    for (int k = 0; k < kRings; ++k) {
        const double theta = (k + 0.5) / kRings * half_angle;
        const double edge = std::clamp(-x / kSheet / std::tan(theta), -1.0, 1.0);
        seen += std::sin(theta) * std::acos(edge) / kPi;
        all += std::sin(theta);
    }
    return seen / all;
}

TEST(Solar, AnAngleGivesShadowsAPenumbraOfItsWidth) {
    const double half_angle = 0.05, reach = kSheet * std::tan(half_angle);  // 0.55 of [-1, 1]
    Rendering r = sunlit("light s() { solar(vector \"world\" (0, 0, -1), 0.05) Cl = 1; }", 1024);
    EXPECT_EQ(r.findings(), "");
    r.frame(32, 32);
    int partly = 0;
    for (int x = 0; x < 32; ++x) {
        const double at = r.place(x, 16).x, share = double(r.color(x, 16).x);
        EXPECT_NEAR(share, seen_share(at, half_angle), 0.01) << at;
        if (at < -reach) {
            EXPECT_EQ(share, 0) << at;
        }
        if (at > reach) {
            EXPECT_NEAR(share, 1, 1e-4) << at;
        }
        partly += share > 0 && share < 0.9999;
    }
    EXPECT_GE(partly, 16);  // of 17.6 pixels
    EXPECT_LE(partly, 18);
}

// A disc that shrinks to a point is that point; what is one direction costs one ray a point.
TEST(Solar, WithoutAnAngleCastsOneHardShadow) {
    Rendering fixed = sunlit("light s() { solar(vector \"world\" (0, 0, -1), 0) Cl = 1; }", 16);
    Rendering given =
        sunlit("light s(float a = 0;) { solar(vector \"world\" (0, 0, -1), a) Cl = 1; }", 16);
    Rendering small = sunlit("light s() { solar(vector \"world\" (0, 0, -1), 1e-6) Cl = 1; }", 16);
    for (Rendering* r : {&fixed, &given, &small}) r->frame();
    EXPECT_TRUE(same_bytes(fixed.film, given.film));
    EXPECT_LT(difference(fixed.film, small.film), 1e-6f);
    EXPECT_EQ(fixed.stats.rays, given.stats.rays);
    EXPECT_EQ(fixed.color(0, 8).x, 0);
    EXPECT_EQ(fixed.color(15, 8).x, 1);
    const uint64_t shadow_rays = fixed.stats.rays - 16 * 16;
    EXPECT_EQ(small.stats.rays - 16 * 16, 16 * shadow_rays);
}

// A sky of two colors, whose border stands nearly upright: sums over its cone. The block runs for
// each direction, so what it leaves where it sends nothing is dark.
TEST(Solar, ABlockThatReadsLRunsForEachDirection) {
    const std::string sky =
        "light s() { solar(vector \"world\" (.001, 0, -1), 1) {"
        " vector w = vtransform(\"world\", L);"
        " Cl = xcomp(w) > 0 ? color(1, 0, 0) : color(0, 1, 0); if (ycomp(w) > 0) Cl += color(0, 0, "
        "1); } }";
    dvec3 want(0.0);
    constexpr int kRings = 400, kTurns = 800;
    for (int k = 0; k < kRings; ++k)
        for (int t = 0; t < kTurns; ++t) {  // L leads down; the axis is tilted by 0.001
            const double c = std::cos(1.0), z = -(1 - (k + 0.5) / kRings * (1 - c));
            const double out = std::sqrt(1 - z * z), turn = 2 * kPi * (t + 0.5) / kTurns;
            const double x = out * std::cos(turn) - 0.001 * z, y = out * std::sin(turn);
            want += -z / (kRings * kTurns) * dvec3(x > 0, x <= 0, y > 0);
        }
    EXPECT_NEAR(want.x, 0.3853, 1e-3);
    for (uint32_t samples : {4u, 256u}) {
        SceneText scene = floor_scene("surface white() { Oi = 1; Ci = diffuse(normalize(N)); }");
        scene.rsl_light("sky", sky);
        SceneOptions options;
        options.quality.light_samples = samples;
        Rendering r(scene.text(), options);
        r.frame(32, 32);
        EXPECT_EQ(r.findings(), "");
        dvec3 mean(0.0);
        for (int k = 0; k < 1024; ++k) mean += dvec3(r.color(k % 32, k / 32)) / 1024.0;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], want[c], 0.004) << samples << " " << c;
    }
}

// A block that does not read L runs once.
TEST(Solar, ABlockThatDoesNotReadLRunsOnce) {
    auto light_points = [](const std::string& body) {
        Rendering r =
            sunlit("light s() { solar(vector \"world\" (0, 0, -1), 0.05) " + body + " }", 16);
        return r.frame().stats.light_points;
    };
    const uint64_t once = light_points("Cl = 1;");
    EXPECT_EQ(light_points("{ color c = 1; Cl = c; }"), once);
    EXPECT_EQ(light_points("Cl = 1 + max(0, zcomp(L));"), 17 * once);
}

TEST(Solar, SoftShadowsHaveTheSameBytesForAnyThreadsAndTargets) {
    const std::string sun = "light s() { solar(vector \"world\" (0.2, 0, -1), 0.05) Cl = 1; }";
    Rendering first = sunlit(sun, 8);
    first.frame(40, 33);
    for (const jit::Target& target : jit::targets()) {
        if (!target.supported()) continue;
        Threads scope(3);
        SceneOptions options;
        options.quality.light_samples = 8;
        options.target = &target;
        Rendering again(half_sky(sun).text(), options);
        EXPECT_TRUE(same_bytes(first.film, again.frame(40, 33).film)) << target.name;
    }
}

}  // namespace
}  // namespace kinora
