// tests/runtime/gather_test.cpp: gather: which branch a ray takes, where the rays go and what they
// bring.
#include <gtest/gtest.h>

#include <cmath>

#include "ray_scenes.h"

namespace kinora {
namespace {

// Rays from P = (x, y, 0) meet the wall at x = 1.25 below its top, and nothing else.
const char* kMeetsWall =
    "float meets(point from; vector way;) { vector w = vtransform(\"world\", way);"
    " point p = transform(\"world\", from); float along = (1.25 - xcomp(p)) / xcomp(w);"
    " return (xcomp(w) > 0 && along * zcomp(w) < 0.8) ? 1 : 0; }\n";

TEST(Gather, TakesTheBranchThatTheGeometrySays) {
    SceneText scene = floor_and_wall(
        kMeetsWall +
            floor_code("float wrong = 0, rays = 0, hits = 0; vector way = 0; point from = 0;"
                       " gather(\"illuminance\", P, n, PI/2, 64, \"ray:direction\", way,"
                       "        \"ray:origin\", from) {"
                       "   hits += 1; rays += 1; wrong += 1 - meets(from, way);"
                       " } else { rays += 1; wrong += meets(from, way); }"
                       " Ci = color(wrong, rays, hits);"),
        kBlack, 0.8);
    Rendering r(scene.text());
    r.frame();
    ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
    float hits = 0;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            ASSERT_EQ(r.color(x, y).x, 0.0f) << x << "," << y;
            ASSERT_EQ(r.color(x, y).y, 64.0f) << x << "," << y;
            hits += r.color(x, y).z;
        }
    EXPECT_GT(hits, 1000);
}

TEST(Gather, SpreadsItsRaysAsTheDistributionSays) {
    // The mean cosine is 1/2 of uniform directions and 2/3 of those by cosine.
    SceneText scene = floor_and_wall(
        floor_code("float even = 0, by_cosine = 0, cap = 1; vector way = 0;"
                   " gather(\"\", P, n, PI/2, 256, \"ray:direction\", way) {;}"
                   " else even += (normalize(way) . n) / 256;"
                   " gather(\"\", P, n, PI/2, 256, \"ray:direction\", way, \"distribution\","
                   "        \"cosine\") {;} else by_cosine += (normalize(way) . n) / 256;"
                   " gather(\"\", P, n, 0.3, 64, \"ray:direction\", way) {;}"
                   " else cap = min(cap, normalize(way) . n);"
                   " Ci = color(even, by_cosine, cap);"),
        kBlack, -0.5);
    Rendering r(scene.text());
    r.frame(4, 4);
    ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
    for (int k = 0; k < 4; ++k) {
        EXPECT_NEAR(r.color(k, k).x, 0.5, 0.005);
        EXPECT_NEAR(r.color(k, k).y, 2.0 / 3, 0.005);
        EXPECT_GE(r.color(k, k).z, std::cos(0.3) - 1e-6);
        EXPECT_LT(r.color(k, k).z, 0.99);
    }
}

TEST(Gather, GivesWhatTheRayMeets) {
    SceneText scene = floor_and_wall(
        floor_code(
            "float t = 0, mark = 0, shade = 0; color c = 0, o = 0; point at = 0;"
            " normal pn = 0, sn = 0, g = 0; float bad = 0, level = 0;"
            " gather(\"\", P, right + 0.2 * up, 0, 1, \"ray:length\", t, \"surface:Ci\", c,"
            "        \"surface:Oi\", o, \"surface:P\", at, \"surface:mark\", mark,"
            "        \"surface:N\", sn, \"primitive:N\", pn, \"primitive:Ng\", g,"
            "        \"label\", \"probe\") {"
            "   point w = transform(\"world\", at);"
            "   float x = xcomp(transform(\"world\", P));"
            "   bad += abs(xcomp(w) - 1.25) > 1e-5 ? 1 : 0;"
            "   bad += abs(t - (1.25 - x) * sqrt(1.04)) > 1e-5 ? 2 : 0;"
            "   bad += abs(zcomp(w) - 0.2 * (1.25 - x)) > 1e-5 ? 4 : 0;"
            "   bad += distance(ntransform(\"world\", pn), normal (-1, 0, 0)) > 1e-5 ? 8 : 0;"
            "   bad += distance(ntransform(\"world\", sn), normal (0, 1, 0)) > 1e-5 ? 16 : 0;"
            "   bad += abs(abs(xcomp(ntransform(\"world\", g))) - 1) > 1e-5 ? 32 : 0;"
            "   bad += abs(mark - zcomp(w)) > 1e-5 ? 64 : 0;"
            "   Ci = color(comp(c, 1) + bad, comp(o, 2), comp(c, 0)); }"),
        "surface wall(output varying float mark = 0;) { Oi = color(1, 1, 0.5); float d = 0;"
        " string kind = \"\", label = \"\"; rayinfo(\"depth\", d); rayinfo(\"type\", kind);"
        " rayinfo(\"label\", label); mark = zcomp(transform(\"world\", P));"
        " Ci = color(d, 0.125, 0); if (kind != \"specular\" || label != \"probe\") Ci = 7;"
        " N = normal \"world\" (0, 1, 0); }",
        5);
    Rendering r(scene.text());
    r.frame();
    ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
    for (int x = 0; x < 14; ++x) EXPECT_EQ(r.color(x, 8), vec3(0.125f, 0.5f, 1.0f)) << x;
}

TEST(Gather, BreaksAndContinuesPointByPoint) {
    SceneText scene = floor_and_wall(
        floor_code("float n1 = 0, n2 = 0, k = floor(10 * s);"
                   " gather(\"\", P, n, PI/2, 8) {;} else { if (n1 >= k) break; n1 += 1; }"
                   " gather(\"\", P, n, PI/2, 8) {;} else { n2 += 1; if (n2 > k) continue;"
                   "   n2 += 0; }"
                   " Ci = color(n1, n2, min(k, 8));"),
        kBlack, -0.5);
    Rendering r(scene.text());
    r.frame();
    ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
    for (int x = 0; x < 16; ++x) {
        EXPECT_EQ(r.color(x, 5).x, r.color(x, 5).z) << x;
        EXPECT_EQ(r.color(x, 5).y, 8.0f);
    }
}

TEST(Gather, SampleCountsMayDifferFromPointToPoint) {
    SceneText scene = floor_and_wall(
        floor_code("float k = 1 + floor(7 * s), rays = 0;"
                   " gather(\"\", P, n, PI/2, k) {;} else rays += 1; Ci = color(rays, k, 0);"),
        kBlack, -0.5);
    Rendering r(scene.text());
    r.frame();
    for (int x = 0; x < 16; ++x) EXPECT_EQ(r.color(x, 5).x, r.color(x, 5).y) << r.findings();
}

// A sky that lights a point by the directions that are open to it, from a light and in a loop whose
// surface gathers too.
TEST(Gather, InALightCountsWhatIsOpen) {
    SceneText scene =
        floor_and_wall(floor_code("float meets = 0; gather(\"\", P, n, 0.1, 4) meets += 1; else {"
                                  " illuminance(P + 0 * up, n, PI/2) Ci += Cl / 4; } Ci += meets;"),
                       kBlack, 0.8);
    scene.rsl_light("sky",
                    "light sky() { illuminate(Ps + Ns) { float open = 0;"
                    " gather(\"\", Ps, Ns, PI/2, 256, \"distribution\", \"cosine\") {;}"
                    " else open += 1; Cl = open / 256; } }");
    Rendering r(scene.text());
    r.frame();
    ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
    for (int x = 0; x < 14; ++x)
        EXPECT_NEAR(r.color(x, 8).x, 1 - wall_share(r.place(x, 8).x, 0.8), 0.03) << x;
}

TEST(Gather, ASamplePatternShootsNothing) {
    SceneText scene = floor_and_wall(
        floor_code("float a = 0, b = 0; vector way = 0;"
                   " gather(\"samplepattern\", P, right, 0.1, 8, \"ray:direction\", way) a += 1;"
                   " gather(\"samplepattern\", P, right, 0.1, 8) {;} else b += 1;"
                   " Ci = color(a, b, xcomp(vtransform(\"world\", way)) > 0.99 ? 1 : 0);"),
        kBlack, 5);
    Rendering r(scene.text());
    r.frame(4, 4);
    EXPECT_EQ(r.color(1, 1), vec3(8, 8, 1)) << r.findings();
}

TEST(Gather, NestsInItselfAndInLoops) {
    SceneText scene = floor_and_wall(
        floor_code("float sum = 0, i; for (i = 0; i < 3; i += 1) {"
                   "  gather(\"\", P, n, PI/2, 4) {;} else {"
                   "    gather(\"\", P, n, PI/2, 5) {;} else sum += 1; sum += 100; } }"
                   " Ci = sum;"),
        kBlack, -0.5);
    Rendering r(scene.text());
    r.frame(4, 4);
    EXPECT_EQ(r.color(2, 2).x, 3 * 4 * (5 + 100)) << r.findings();
}

TEST(Gather, AWrongResultIsNamed) {
    SceneText scene = floor_and_wall(
        floor_code("float x = 0; gather(\"\", P, n, PI/2, 4, \"ray:flavour\", x) {;}"), kBlack, 1);
    Rendering r(scene.text());
    EXPECT_FALSE(r.diagnostics.has_errors());
    EXPECT_NE(r.findings().find("ray:flavour"), std::string::npos) << r.findings();
}

}  // namespace
}  // namespace kinora
