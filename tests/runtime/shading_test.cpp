// tests/runtime/shading_test.cpp: what shaders see of a scene: spaces, texture coordinates,
// derivatives, bent normals, varying inputs, printf.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "expect_colors.h"

namespace kinora {
namespace {

// A surface whose colour is three numbers.
std::string show(const std::string& expression, const std::string& params = "",
                 const std::string& before = "") {
    return fmt::format("surface s({}) {{ Oi = 1; {} Ci = color({}); }}", params, before,
                       expression);
}
std::string components(const std::string& expression) {
    return fmt::format("xcomp({0}), ycomp({0}), zcomp({0})", expression);
}

// ---- spaces

TEST(Spaces, PIsInCameraSpaceWithZIntoThePicture) {
    SceneText scene = floor_scene(show(components("P")));
    expect_colors(Rendering(scene.text()).frame(), [](dvec2 p) { return dvec3(p.x, p.y, 10); });
}

TEST(Spaces, WorldIsTheFilesOwn) {
    SceneText scene = floor_scene(show(components("transform(\"world\", P)")));
    expect_colors(Rendering(scene.text()).frame(), [](dvec2 p) { return dvec3(p.x, p.y, 0); });
}

TEST(Spaces, NormalsAndVectorsGoAlong) {
    SceneText scene = floor_scene(show(components("ntransform(\"world\", N)")));
    expect_colors(Rendering(scene.text()).frame(), [](dvec2) { return dvec3(0, 0, 1); });
    scene = floor_scene(show(components("vtransform(\"world\", I)")));
    expect_colors(
        Rendering(scene.text()).frame(), [](dvec2) { return dvec3(0, 0, -10); }, 1e-4);
}

TEST(Spaces, RasterIsPixelsAndNdcIsTheUnitSquare) {
    SceneText scene = floor_scene(show(components("transform(\"raster\", P)")));
    Rendering r(scene.text());
    r.frame();
    EXPECT_NEAR(r.color(3, 5).x, 3.5, 1e-4) << r.findings();
    EXPECT_NEAR(r.color(3, 5).y, 5.5, 1e-4);
    scene = floor_scene(show(components("transform(\"NDC\", P)")));
    Rendering ndc(scene.text());
    ndc.frame();
    EXPECT_NEAR(ndc.color(3, 5).x, 3.5 / 16, 1e-5) << ndc.findings();
    EXPECT_NEAR(ndc.color(3, 5).y, 5.5 / 16, 1e-5);
}

TEST(Spaces, ObjectIsTheInstancesOwnAlsoUnderInstanceNode) {
    SceneText scene;
    scene.square("tile", 0.25).look("look", show(components("transform(\"object\", P)")));
    scene.library_nodes =
        "<node id=\"unit\"><translate>0 0.5 0</translate><instance_geometry url=\"#tile\">"
        "<bind_material><technique_common><instance_material symbol=\"skin\" target=\"#look\"/>"
        "</technique_common></bind_material></instance_geometry></node>";
    scene.nodes +=
        "<node><translate>-0.5 0 0</translate><instance_node url=\"#unit\"/></node>"
        "<node><translate>0.5 -0.25 0</translate><scale>1 2 1</scale>"
        "<instance_node url=\"#unit\"/></node>";
    Rendering r(scene.text());
    r.frame();
    int covered = 0;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            if (r.film.at(x, y).w == 0) continue;
            ++covered;
            dvec2 p = r.place(x, y);
            dvec2 want =
                p.x < 0 ? dvec2(p.x + 0.5, p.y - 0.5) : dvec2(p.x - 0.5, (p.y + 0.25) / 2 - 0.5);
            EXPECT_NEAR(r.color(x, y).x, want.x, 2e-6) << r.findings();
            EXPECT_NEAR(r.color(x, y).y, want.y, 2e-6);
        }
    EXPECT_EQ(covered, 16 + 4 * 6);  // the second reaches from y = 0.25 over the picture's top
}

TEST(Spaces, EveryNodeIdNamesASpace) {
    SceneText scene = floor_scene(show(components("transform(\"probe\", P)")));
    scene.nodes +=
        "<node id=\"probe\"><translate>1 2 3</translate><rotate>0 0 1 90</rotate></node>";
    expect_colors(Rendering(scene.text()).frame(), [](dvec2 p) {
        return dvec3(p.y - 2, -(p.x - 1), -3);  // turned back by 90 degrees
    });
}

TEST(Spaces, AnUnknownNameIsAWarningAndMeansShader) {
    for (const char* name : {"\"nowhere\"", "(s > -9 ? \"nowhere\" : \"world\")"}) {
        SceneText scene;
        scene.square("floor", 3)
            .look("floor-look", show(components(fmt::format("transform({}, P)", name))))
            .place("floor", "floor-look", "<translate>0.25 0.5 0</translate>");
        Rendering r(scene.text());
        expect_colors(r.frame(), [](dvec2 p) { return dvec3(p.x - 0.25, p.y - 0.5, 0); });
        bool constant = name[0] == '"';  // another is known at run time alone
        EXPECT_EQ(r.findings().find("RSL_SPACE_UNKNOWN") != std::string::npos, constant);
    }
}

// ---- parameters of the surface

TEST(SurfaceParameters, TextureCoordinatesAreSAndT) {
    SceneText scene = floor_scene(show("s, t, u - s"));
    expect_colors(Rendering(scene.text()).frame(),
                  [](dvec2 p) { return dvec3((p.x + 1.5) / 3, (p.y + 1.5) / 3, 0); });
}

TEST(SurfaceParameters, WithoutThemTheyAreBarycentrics) {
    SceneText scene;
    scene.mesh("triangle", {{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}}, {0, 1, 2})
        .look("look", show("u, v, s"))
        .place("triangle", "look");
    expect_covered_colors(Rendering(scene.text()).frame(), [](dvec2 p) {
        return dvec3((p.x + 1) / 2, (p.y + 1) / 2, (p.x + 1) / 2);
    });
}

TEST(SurfaceParameters, DerivativesOfSAndTAreThoseOfTheMap) {
    SceneText scene = floor_scene(show("Du(s), Dv(s), Dv(t)"));
    expect_colors(Rendering(scene.text()).frame(), [](dvec2) { return dvec3(1, 0, 1); });
}

TEST(SurfaceParameters, TheDerivativeOfPIsTheEdgePerU) {
    SceneText scene = floor_scene(show(components("vtransform(\"world\", Du(P))")));
    expect_colors(
        Rendering(scene.text()).frame(), [](dvec2) { return dvec3(3, 0, 0); }, 1e-5);
    scene = floor_scene(show(components("vtransform(\"world\", dPdv)")));
    expect_colors(
        Rendering(scene.text()).frame(), [](dvec2) { return dvec3(0, 3, 0); }, 1e-5);
}

TEST(SurfaceParameters, DerivativesFollowTheChainRule) {
    SceneText scene = floor_scene(show("Du(sin(4*s*t)), Dv(sin(4*s*t)), Du(xcomp(P)*s)"));
    expect_colors(
        Rendering(scene.text()).frame(),
        [](dvec2 p) {
            double s = (p.x + 1.5) / 3, t = (p.y + 1.5) / 3, c = std::cos(4 * s * t);
            return dvec3(4 * t * c, 4 * s * c, 3 * s + p.x);
        },
        2e-5);
}

TEST(SurfaceParameters, WithoutDerivativesTheyAreZero) {
    SceneText scene = floor_scene(show("Du(s), 1 + Dv(t), 0.5 + area(P)"));
    SceneOptions options;
    options.quality.derivatives = false;
    expect_colors(Rendering(scene.text(), options).frame(), [](dvec2) { return dvec3(0, 1, 0.5); });
}

TEST(SurfaceParameters, TheFootprintIsOnePixel) {
    // 16 pixels show 2 of the 3 units that u runs over.
    SceneText scene = floor_scene(show("du, dv, sqrt(area(P))"));
    expect_colors(
        Rendering(scene.text()).frame(),
        [](dvec2) { return dvec3(2.0 / 16 / 3, 2.0 / 16 / 3, 2.0 / 16); }, 1e-5);
}

TEST(SurfaceParameters, AParameterCalledPrefIsTheRestPosition) {
    SceneText scene;
    scene.square("floor", 0.5)
        .look("look", show(components("transform(\"object\", Pref)"), "varying point Pref = 0"))
        .place("floor", "look", "<translate>0.25 0 0</translate><rotate>0 0 1 90</rotate>");
    Rendering r(scene.text());
    r.frame();
    expect_covered_colors(r, [](dvec2 p) { return dvec3(p.y, -(p.x - 0.25), 0); });
}

// As all points, it is in "current" space: where nothing moves the mesh, it is P.
TEST(SurfaceParameters, TheRestPositionIsInCurrentSpace) {
    SceneText scene;
    scene.square("floor", 0.5)
        .look("look", show(components("Pref - P"), "varying point Pref = 0"))
        .place("floor", "look", "<translate>0.25 0 0</translate><scale>2 3 1</scale>");
    Rendering r(scene.text());
    r.frame();
    expect_covered_colors(r, [](dvec2) { return dvec3(0); });
}

TEST(SurfaceParameters, VertexInputsReachVaryingParameters) {
    SceneText scene;
    scene.square("floor", 1.5)
        .look("look", show("a, b, 0", "varying float a = 7; varying float b = 7"))
        .place("floor", "look", "", "",
               "<bind_vertex_input semantic=\"b\" input_semantic=\"TEXCOORD\" input_set=\"0\"/>");
    expect_colors(Rendering(scene.text()).frame(),
                  [](dvec2 p) { return dvec3(7, (p.x + 1.5) / 3, 0); });
}

// What readprimvar() finds: inputs by their semantics and by what binds them, the rest position in
// "current" space, and nothing else.
TEST(SurfaceParameters, AreNotNeededToReadVertexInputs) {
    for (const char* name :
         {"\"dirt\"", "what", "concat(\"di\", \"rt\")", "format(\"%srt\", two)"}) {
        SceneText scene;
        scene.square("floor", 1.5)
            .look("look",
                  fmt::format("surface s(string what = \"dirt\"; string two = \"di\";) {{"
                              " float d = 7, none = 3; point rest = 0; vector n = 0;"
                              " float k = readprimvar({}, d) + 2 * readprimvar(\"clean\", none)"
                              " + 4 * readprimvar(\"Pref\", rest) + 8 * readprimvar(\"b\", none);"
                              " Oi = 1; Ci = color(d + Du(d), k + distance(rest, P), none); }}",
                              name))
            .place(
                "floor", "look", "<translate>0.25 0 0</translate>", "",
                "<bind_vertex_input semantic=\"b\" input_semantic=\"TEXCOORD\" input_set=\"0\"/>");
        std::string text = scene.text(), uv = "source=\"#floor-t\" offset=\"0\" set=\"0\"/>";
        size_t at = text.find(uv);
        ASSERT_NE(at, text.npos);
        text.insert(at + uv.size(), "<input semantic=\"dirt\" source=\"#floor-t\" offset=\"0\"/>");
        Rendering r(text);
        EXPECT_FALSE(r.diagnostics.has_errors()) << r.findings();
        expect_colors(r.frame(), [](dvec2 p) {
            double s = (p.x - 0.25 + 1.5) / 3;
            return dvec3(s + 1, 1 + 4 + 8, s);
        });
    }
}

// ---- displacement as bent normals

SceneOptions bump_only() {
    SceneOptions options;
    options.quality.displacement = DisplacementMode::Bump;
    return options;
}

TEST(Displacement, BendsNormalsAsTheMovedSurfaceWouldHaveThem) {
    SceneText scene = floor_scene(
        "displacement waves(float A = 0.1; float k = 9;) {"
        "  P += A * sin(k * s) * normalize(N); N = calculatenormal(P); }\n" +
            show(components("ntransform(\"world\", normalize(N))")),
        "<shader stage=\"DISPLACEMENT\"/><shader stage=\"SURFACE\"/>");
    expect_colors(
        Rendering(scene.text(), bump_only()).frame(),
        [](dvec2 p) {
            double slope = 0.1 * 9 / 3 * std::cos(9 * (p.x + 1.5) / 3);  // dh/dx
            double length = std::sqrt(1 + slope * slope);
            return dvec3(-slope / length, 0, 1 / length);
        },
        5e-6);
}

// Heights are in the object's space, as true displacement has them.
TEST(Displacement, HeightsScaleWithTheirNode) {
    const std::pair<dvec3, const char*> kCases[] = {
        {{2, 2, 2}, "N = calculatenormal(P);"},
        {{1, 1, 3}, "N = calculatenormal(P);"},
        {{0.5, 2, 1}, "N = calculatenormal(P);"},
        {{1, 1, 3}, ""},  // N of what has moved
    };
    for (const auto& [scale, bend] : kCases) {
        SceneText scene;
        scene.square("floor", 2)
            .look("look",
                  "displacement waves(float A = 0.1; float k = 9;) {"
                  "  P += A * sin(k * xcomp(transform(\"shader\", P))) * normalize(N);" +
                      std::string(bend) + "}\n" +
                      show(components("ntransform(\"world\", normalize(N))")),
                  "<shader stage=\"DISPLACEMENT\"/><shader stage=\"SURFACE\"/>")
            .place("floor", "look",
                   fmt::format("<scale>{} {} {}</scale>", scale.x, scale.y, scale.z));
        expect_colors(
            Rendering(scene.text(), bump_only()).frame(),
            [scale = scale](dvec2 p) {
                double slope = 0.1 * 9 * std::cos(9 * p.x / scale.x) * scale.z / scale.x;
                double length = std::sqrt(1 + slope * slope);
                return dvec3(-slope / length, 0, 1 / length);
            },
            1e-5);
    }
}

TEST(Displacement, LayersApplyBottomFirst) {
    SceneText scene = floor_scene(
        "displacement a() { N = vector \"world\" (0, 0, 1); }\n"
        "displacement b() { N += 2 * vector \"world\" (1, 0, 0); }\n" +
            show(components("ntransform(\"world\", N)")),
        "<shader stage=\"DISPLACEMENT\"><name>a</name></shader>"
        "<shader stage=\"DISPLACEMENT\"><name>b</name></shader>"
        "<shader stage=\"SURFACE\"/>");
    expect_colors(Rendering(scene.text(), bump_only()).frame(),
                  [](dvec2) { return dvec3(2, 0, 1); });
}

TEST(Displacement, LeavesTheSurfaceWhereItIs) {
    SceneText scene =
        floor_scene("displacement up() { P += 0.5 * normalize(N); N = calculatenormal(P); }\n" +
                        show(components("transform(\"world\", P)")),
                    "<shader stage=\"DISPLACEMENT\"/><shader stage=\"SURFACE\"/>");
    Rendering r(scene.text(), bump_only());
    r.frame();
    EXPECT_EQ(r.film.at(8, 8).w, 1.0f);
}

// ---- grids

TEST(Grids, TilesAndChunksDoNotShowInThePicture) {
    SceneText scene;
    scene.octahedron("ball").look(
        "look",
        "surface s() { Oi = 1; float k; color c = 0;"
        "  for (k = 0; k < 3 + 4 * noise(3 * P); k += 1) c += noise(k * P) * random();"
        "  Ci = c * diffuse(normalize(N)) + 0.1 * Du(P) . N; }");
    scene.place("ball", "look", "<scale>0.9 0.9 0.9</scale><rotate>1 1 0 20</rotate>")
        .light("bulb", "<point><color>1 1 1</color></point>", "<translate>2 2 3</translate>");
    Rendering r(scene.text());
    ASSERT_TRUE(r.scene) << r.findings();
    EXPECT_FALSE(r.diagnostics.has_errors()) << r.findings();
    r.frame(33, 21);
    raytrace::Film whole = r.film;
    for (int tile : {4, 16, 28}) {
        r.settings.integrator.tile = tile;
        r.settings.integrator.chunk_rays = size_t(tile * tile);
        r.frame(33, 21);
        EXPECT_TRUE(same_bytes(whole, r.film)) << tile << ": " << difference(whole, r.film);
    }
}

// One pixel at a time is a grid of one point at a time.
TEST(Grids, AWholeGridEqualsItsPointsOneByOne) {
    SceneText scene = floor_scene(
        "surface s() { Oi = 1; float k = 0; while (k < 10 * s) { k += 0.7; if (k > 3 * t) break; }"
        " Ci = color(k, mod(k, 0.4), noise(7 * P)); }");
    Rendering r(scene.text());
    r.frame(12, 12);
    raytrace::Film whole = r.film;
    r.settings.integrator.tile = 4;
    r.settings.integrator.chunk_rays = 16;
    Rendering one(scene.text());
    for (int size : {4, 8}) {
        r.frame(size, size);
        one.settings.integrator.tile = 4;
        one.settings.integrator.chunk_rays = 1;
        one.frame(size, size);
        EXPECT_TRUE(same_bytes(one.film, r.film)) << size;
    }
}

// ---- printf

TEST(Printf, ComesInPictureOrderWhateverTheThreadsAndTiles) {
    SceneText scene = floor_scene(
        "surface s() { Oi = 1; Ci = 0; point R = transform(\"raster\", P);"
        " printf(\"%d %d\\n\", ycomp(R), xcomp(R)); }");
    Threads two(2);
    Rendering r(scene.text());
    ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
    r.settings.integrator.tile = 4;
    testing::internal::CaptureStdout();
    r.frame();
    std::istringstream printed(testing::internal::GetCapturedStdout());
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            int got_y = -1, got_x = -1;
            ASSERT_TRUE(printed >> got_y >> got_x);
            ASSERT_EQ(got_y, y);
            ASSERT_EQ(got_x, x);
        }
    std::string rest;
    EXPECT_FALSE(printed >> rest) << rest;
}

TEST(Printf, WritesEveryTypeOfValue) {
    SceneText scene = floor_scene(
        "surface s(float a = 1.5; string name = \"oak\") { Oi = 1; Ci = 0;"
        " if (s > 0) printf(\"%f|%c|%s|%d|%%|%p\\n\", a, color(1,2,3), name, 3.9,"
        "   point \"current\" (4,5,6)); }");
    Rendering r(scene.text());
    testing::internal::CaptureStdout();
    r.frame(1, 1);
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "1.5|1 2 3|oak|3|%|4 5 6\n") << r.findings();
}

}  // namespace
}  // namespace kinora
