// tests/runtime/smooth_shadow_test.cpp: rays to lights leave from the smooth surface that the
// normals of a coarse mesh describe. The truth is the round body itself: alone it is lit wherever
// its normal faces the light.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "scene_text.h"

namespace kinora {
namespace {

// Red: whether the light arrives. Green: cosine between normal and light. Blue: between the facet,
// on the normal's side, and light.
const char* kProbe =
    "float cosine(normal n; vector l;) { return normalize(n) . normalize(l); }\n"
    "surface probe() { Oi = 1; Ci = 0; illuminance(P, N, PI) {"
    " float side = Ng . N < 0 ? -1 : 1; float lit = SHADOW;"
    " Ci = color(lit, cosine(N, L), side * cosine(Ng, L)); } }";

struct Way {
    const char* name;
    const char* shadow;  // 1 lit
    bool automatic;
};
const Way kWays[] = {
    {"the light's own", "comp(Cl, 0) > 0 ? 1 : 0", true},
    {"shadow", "1 - float shadow(\"raytrace\", P)", false},
    {"transmission", "comp(transmission(P, P + 30 * normalize(L)), 0)", false},
    {"transmission to P", "comp(transmission(P + 30 * normalize(L), P), 0)", false},
    {"visibility", "visibility(P, P + 30 * normalize(L))", false},
};

std::string probe(const Way& way) {
    std::string code = kProbe;
    return code.replace(code.find("SHADOW"), 6, way.shadow);
}

// About the y axis, between y = -1.5 and 1.5; `inwards`: seen from within.
SceneText& cylinder(SceneText& scene, const std::string& id, int sides, double radius,
                    bool smooth = true, double turn = 0, bool inwards = false, double from = 0,
                    double to = 2 * kPi) {
    std::vector<dvec3> positions, normals;
    std::vector<int> triangles;
    double sign = inwards ? -1 : 1;
    for (int k = 0; k < sides; ++k) {
        double step = (to - from) / sides, a = from + turn + k * step, b = a + step;
        int first = int(positions.size());
        for (double angle : {a, b})
            for (double y : {-1.5, 1.5}) {
                double towards = smooth ? angle : (a + b) / 2;
                positions.push_back({radius * std::cos(angle), y, radius * std::sin(angle)});
                normals.push_back({sign * std::cos(towards), 0, sign * std::sin(towards)});
            }
        for (int corner : {0, 1, 2, 2, 1, 3}) triangles.push_back(first + corner);
    }
    return scene.mesh(id, positions, triangles, normals);
}

// Latitudes and longitudes; the normals are exact.
SceneText& sphere(SceneText& scene, const std::string& id, int rings, int sides, double radius) {
    std::vector<dvec3> positions, normals;
    std::vector<int> triangles;
    for (int r = 0; r <= rings; ++r)
        for (int k = 0; k < sides; ++k) {
            double theta = kPi * r / rings, phi = 2 * kPi * (k + 0.3) / sides;
            dvec3 n(std::sin(theta) * std::cos(phi), std::cos(theta),
                    std::sin(theta) * std::sin(phi));
            normals.push_back(n);
            positions.push_back(radius * n);
        }
    for (int r = 0; r < rings; ++r)
        for (int k = 0; k < sides; ++k) {
            int a = r * sides + k, b = r * sides + (k + 1) % sides;
            for (int corner : {a, b, a + sides, b, b + sides, a + sides})
                triangles.push_back(corner);
        }
    return scene.mesh(id, positions, triangles, normals);
}

// A distant light from there; its node looks along -z.
SceneText& sun(SceneText& scene, double degrees_from_camera, double height = 0) {
    return scene.light("sun", "<directional><color>1 1 1</color></directional>",
                       fmt::format("<rotate>0 1 0 {}</rotate><rotate>1 0 0 {}</rotate>",
                                   degrees_from_camera, -height));
}

SceneOptions options_of(const Way& way) {
    SceneOptions options;
    if (!way.automatic) options.quality.shadows = ShadowMode::Explicit;
    return options;
}

struct Count {
    int lit = 0, shaded = 0;
    int wrong = 0;   // shaded where the round body is lit
    int mended = 0;  // lit although the facet looks away
};
Count count(const Rendering& r, float least = 2e-3f) {
    Count c;
    for (int y = 0; y < r.film.height; ++y)
        for (int x = 0; x < r.film.width; ++x) {
            if (r.film.at(x, y).w == 0) continue;
            vec3 at = r.color(x, y);
            (at.x > 0.5f ? c.lit : c.shaded) += 1;
            c.wrong += at.y > least && at.x < 0.5f;
            c.mended += at.x > 0.5f && at.z < -1e-3f && at.y > least;
        }
    return c;
}

void expect_smooth(const SceneText& scene, const Way& way, float least = 2e-3f) {
    Rendering r(scene.text(), options_of(way));
    r.frame(96, 96);
    ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
    Count c = count(r, least);
    EXPECT_EQ(c.wrong, 0);
    EXPECT_GT(c.mended, 50);
    EXPECT_GT(c.lit, 500);
    EXPECT_GT(c.shaded, 300);
}

TEST(SmoothShadow, OfACylinderOfTwelveSidesIsThatOfARoundOne) {
    for (const Way& way : kWays)
        for (double angle : {50.0, 77.0, 85.0, 114.0}) {
            SCOPED_TRACE(fmt::format("{} {}", way.name, angle));
            SceneText scene;
            cylinder(scene, "body", 12, 0.8).look("probe", probe(way)).place("body", "probe");
            expect_smooth(sun(scene, angle), way);
        }
}

TEST(SmoothShadow, OfACoarseSphereIsThatOfARoundOne) {
    for (const Way& way : kWays)
        for (double height : {0.0, 35.0}) {
            SCOPED_TRACE(fmt::format("{} {}", way.name, height));
            SceneText scene;
            sphere(scene, "body", 7, 10, 0.9).look("probe", probe(way)).place("body", "probe");
            expect_smooth(sun(scene, 80, height), way);
        }
}

TEST(SmoothShadow, IsThatOfAPointLightToo) {
    SceneText scene;
    cylinder(scene, "body", 12, 0.8).look("probe", probe(kWays[0])).place("body", "probe");
    scene.light("lamp", "<point><color>1 1 1</color></point>", "<translate>3 0 -0.26</translate>");
    expect_smooth(scene, kWays[0]);
}

// Its shader runs at points of the lamp; the ray it sends to the lit point is that of the surface.
TEST(SmoothShadow, IsThatOfALightOnGeometryThatCastsItsOwnRays) {
    for (const char* ray :
         {"transmission(P, Ps)", "transmission(Ps, P)", "color(visibility(P, Ps))",
          "color(1 - float shadow(\"raytrace\", Ps))"}) {
        SCOPED_TRACE(ray);
        SceneText scene;
        cylinder(scene, "body", 12, 0.8).look("probe", probe(kWays[0])).place("body", "probe");
        scene.square("lamp", 1e-3)
            .look("lamp-look", fmt::format("light own() {{ illuminate(P) {{ Cl = {}; }} }}", ray),
                  "<shader stage=\"LIGHT\"/>", "", rsl_extra("<samples>2</samples>"))
            .place("lamp", "lamp-look", "<translate>3 0 -0.26</translate>");
        expect_smooth(scene, kWays[0]);
    }
}

// Placed by a matrix, mirrored, flattened, repeated, moving, displaced, with all normals inside
// out.
TEST(SmoothShadow, HoldsHoweverTheMeshIsPlaced) {
    struct Case {
        const char* name;
        std::function<void(SceneText&, const std::string& look)> place;
        float least;
    };
    auto add = [](SceneText& scene) -> SceneText& { return cylinder(scene, "body", 12, 0.8); };
    const Case kCases[] = {
        {"mirrored",
         [&](SceneText& s, auto& look) { add(s).place("body", look, "<scale>-1 1 1</scale>"); },
         2e-3f},
        {"flattened",
         [&](SceneText& s, auto& look) {
             add(s).place("body", look, "<rotate>0 1 0 3</rotate><scale>1 1 0.6</scale>");
         },
         0.02f},
        {"repeated and mirrored",
         [&](SceneText& s, auto& look) {
             add(s).place("body", look, "<scale>-1 1 1</scale>", "one");
             s.place("body", look, "<translate>0 0 -40</translate>");
         },
         2e-3f},
        {"repeated and flattened",
         [&](SceneText& s, auto& look) {
             add(s).place("body", look, "<scale>1 1 0.6</scale>", "one");
             s.place("body", look, "<translate>0 0 -40</translate>");
         },
         0.02f},
        {"moving",
         [&](SceneText& s, auto& look) {
             add(s).place("body", look, "<translate sid=\"t\">0 0 0</translate>", "mover");
             s.animate("mover/t.X", {0, 1}, {0, 0.2});
         },
         2e-3f},
        {"inside out",
         [&](SceneText& s, auto& look) {
             cylinder(s, "body", 12, 0.8, true, 0, true).place("body", look);
         },
         2e-3f},
    };
    for (const Case& c : kCases) {
        SCOPED_TRACE(c.name);
        SceneText scene;
        scene.look("probe", probe(kWays[0]));
        c.place(scene, "probe");
        sun(scene, 85);
        Rendering r(scene.text());
        r.frame(96, 96, 0.5);
        ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
        bool inside_out = std::string_view(c.name) == "inside out";
        int wrong = 0, mended = 0;
        for (int y = 0; y < 96; ++y)
            for (int x = 0; x < 96; ++x) {
                if (r.film.at(x, y).w == 0) continue;
                vec3 at = r.color(x, y) * (inside_out ? vec3(1, -1, -1) : vec3(1));
                wrong += at.y > c.least && at.x < 0.5f;
                mended += at.x > 0.5f && at.z < -1e-3f && at.y > c.least;
            }
        EXPECT_EQ(wrong, 0);
        EXPECT_GT(mended, 30);
    }
}

// A morph whose weight moves, so the mesh deforms: from a thin cylinder to the one looked at.
TEST(SmoothShadow, HoldsForMeshesThatDeform) {
    SceneText scene;
    scene.look("probe", probe(kWays[0]));
    cylinder(scene, "thin", 12, 0.3);
    cylinder(scene, "thick", 12, 0.9);
    scene.controllers =
        R"(<controller id="morph"><morph source="#thin" method="NORMALIZED">
        <source id="mt"><IDREF_array id="mt-a" count="1">thick</IDREF_array><technique_common>
        <accessor source="#mt-a" count="1"><param type="IDREF"/></accessor></technique_common>
        </source><source id="mw"><float_array id="mw-a" count="1">0</float_array><technique_common>
        <accessor source="#mw-a" count="1"><param type="float"/></accessor></technique_common>
        </source><targets><input semantic="MORPH_TARGET" source="#mt"/>
        <input semantic="MORPH_WEIGHT" source="#mw"/></targets></morph></controller>)";
    scene.nodes += R"(<node><instance_controller url="#morph"><bind_material><technique_common>
        <instance_material symbol="skin" target="#probe"/></technique_common></bind_material>
        </instance_controller></node>)";
    scene.animate("mw(0)", {0, 1}, {0, 1});
    sun(scene, 85);
    Rendering r(scene.text());
    r.frame(96, 96, 0.75);
    ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
    ASSERT_EQ(r.scene->shapes[0].kind, raytrace::GeometryKind::Deforming);
    Count c = count(r);
    EXPECT_EQ(c.wrong, 0);
    EXPECT_GT(c.mended, 30);
    EXPECT_GT(c.shaded, 300);
}

// Vertices of a thin body are moved out to the round one, with its normals.
TEST(SmoothShadow, HoldsForDisplacedMeshes) {
    SceneText scene;
    scene.look("probe",
               "displacement out() { point Q = transform(\"object\", P);"
               " vector r = normalize(vector (xcomp(Q), 0, zcomp(Q)));"
               " P = transform(\"object\", \"current\", point (0.8 * xcomp(r), ycomp(Q), 0.8 * "
               "zcomp(r))); N = ntransform(\"object\", \"current\", normal r); }\n" +
                   probe(kWays[0]),
               "<shader stage=\"DISPLACEMENT\"/><shader stage=\"SURFACE\"/>");
    cylinder(scene, "body", 12, 0.6).place("body", "probe");
    sun(scene, 80);
    SceneOptions options;
    options.quality.dice = 16;
    options.width = options.height = 96;
    Rendering r(scene.text(), options);
    r.frame(96, 96);
    ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
    Count c = count(r);
    EXPECT_EQ(c.wrong, 0);
    EXPECT_GT(c.mended, 20);
    EXPECT_GT(c.shaded, 300);
}

// A shell around the upper half, closer to the round body than the smooth surface is to the facets:
// no light gets in between.
TEST(SmoothShadow, LetsNoLightThroughWhatStandsOnTheSurface) {
    for (const Way& way : kWays) {
        SCOPED_TRACE(way.name);
        SceneText scene;
        cylinder(scene, "body", 12, 0.8).look("probe", probe(way)).place("body", "probe");
        // The camera sees through its faces, lights do not.
        scene.look(
            "shell-look",
            "surface shell() { Oi = raydepth() == 0 && isshadowray() == 0 ? 0 : 1; Ci = 0; }");
        cylinder(scene, "shell", 90, 0.81);
        scene.place("shell", "shell-look", "<translate>0 1.5 0</translate>");
        sun(scene, 85);
        Rendering r(scene.text(), options_of(way));
        r.frame(96, 96);
        ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
        int above = 0, lit_above = 0, wrong_below = 0;
        for (int y = 0; y < 96; ++y)
            for (int x = 0; x < 96; ++x) {
                if (r.film.at(x, y).w == 0) continue;
                vec3 at = r.color(x, y);
                bool upper = y < 47;  // rows go down
                above += upper;
                lit_above += upper && at.x > 0.02f && at.y > 2e-3f;
                wrong_below += y > 50 && at.y > 2e-3f && at.x < 0.5f;
            }
        EXPECT_GT(above, 2000);
        EXPECT_EQ(lit_above, 0);
        EXPECT_EQ(wrong_below, 0);
    }
}

// A wall beside the body keeps its shadow to where the round body has it.
TEST(SmoothShadow, OfOtherThingsStaysWhereItIs) {
    SceneText scene;
    cylinder(scene, "body", 12, 0.8).look("probe", probe(kWays[0])).place("body", "probe");
    scene.look("wall-look", "surface wall() { Oi = 1; Ci = 0; }");
    scene.mesh("wall", {{0, 0, -9}, {0, 9, -9}, {0, 9, 9}, {0, 0, 9}}, {0, 1, 2, 0, 2, 3});
    scene.place("wall", "wall-look", "<translate>1.2 0 0</translate>");
    sun(scene, 88);
    Rendering r(scene.text());
    r.frame(96, 96);
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 96; ++x) {
            vec3 at = r.color(x, y);
            if (r.film.at(x, y).w == 0 || at.y < 2e-3f || r.place(x, y).x > 0.85) continue;
            if (y == 47 || y == 48) continue;
            ASSERT_EQ(at.x > 0.5f, y > 48) << x << "," << y;
        }
}

// A trough, seen from above: where its normals face the light, its rim shades it as it shades one
// of flat faces.
TEST(SmoothShadow, OfAHollowSurfaceIsThatOfItsFacets) {
    for (const Way& way : kWays)
        for (double angle : {20.0, 50.0, 75.0}) {
            SCOPED_TRACE(fmt::format("{} {}", way.name, angle));
            auto seen = [&](bool smooth) {
                SceneText scene;
                cylinder(scene, "trough", 16, 0.9, smooth, 0, true, kPi, 2 * kPi);
                scene.look("probe", probe(way)).place("trough", "probe");
                sun(scene, angle);
                Rendering r(scene.text(), options_of(way));
                r.frame(64, 64);
                EXPECT_FALSE(r.diagnostics.has_errors()) << r.findings();
                std::vector<vec3> colors;
                for (int k = 0; k < 64 * 64; ++k) colors.push_back(r.color(k % 64, k / 64));
                return colors;
            };
            std::vector<vec3> smooth = seen(true), flat = seen(false);
            int lit = 0, shaded = 0;
            for (size_t k = 0; k < smooth.size(); ++k) {
                if (smooth[k].y < 1e-3f) continue;
                EXPECT_EQ(smooth[k].x, flat[k].x) << k;
                (smooth[k].x > 0.5f ? lit : shaded) += 1;
            }
            EXPECT_GT(lit, 200);
            EXPECT_GT(shaded, angle > 30 ? 200 : 0);
        }
}

// Faces that are flat start at P: the facets that look away stay shaded, whatever normal they have.
TEST(SmoothShadow, LeavesFlatFacesAsTheyAre) {
    SceneText scene;
    cylinder(scene, "body", 12, 0.8, false).look("probe", probe(kWays[0])).place("body", "probe");
    sun(scene, 85);
    Rendering r(scene.text());
    r.frame(96, 96);
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 96; ++x) {
            if (r.film.at(x, y).w == 0) continue;
            vec3 at = r.color(x, y);
            if (std::abs(at.z) < 1e-3f) continue;
            ASSERT_EQ(at.x > 0.5f, at.z > 0) << x << "," << y;
        }
}

TEST(SmoothShadow, IsTheSameOnAnyNumberOfThreads) {
    SceneText scene;
    sphere(scene, "body", 7, 10, 0.9).look("probe", probe(kWays[1])).place("body", "probe");
    sun(scene, 80, 20);
    auto picture = [&](int threads) {
        Threads set(threads);
        Rendering r(scene.text(), options_of(kWays[1]));
        r.frame(200, 150);
        return std::move(r.film);
    };
    EXPECT_TRUE(same_bytes(picture(1), picture(3)));
}

}  // namespace
}  // namespace kinora
