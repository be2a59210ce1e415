// tests/runtime/queries_test.cpp: messages between shaders, and what attribute, option,
// rendererinfo, rayinfo and shadername say, against what the scene's text says.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "jit/target.h"
#include "scene_text.h"

namespace kinora {
namespace {

vec3 middle(const SceneText& scene) {
    Rendering r(scene.text());
    r.frame(4, 4, 0.5);
    EXPECT_FALSE(r.diagnostics.has_errors()) << r.findings();
    return r.color(1, 1);
}

std::string surface(const std::string& body, const std::string& parameters = "") {
    return "surface s(" + parameters + ") { Oi = 1; Ci = 0; " + body + " }";
}

// ---- lists

TEST(Lists, TakeTheLengthOfTheAnswer) {
    SceneText scene = floor_scene(
        "surface s(float steps[3] = {1, 2, 4}; color pair[2] = {(1, 2, 3), (4, 5, 6)};) {"
        " Oi = 1; float l[], none[]; color c[]; push(none, 4); push(l, 9);"
        " float k = surface(\"steps\", l) + 10 * surface(concat(\"pa\", \"ir\"), c)"
        " + 100 * attribute(\"user:nothing\", none);"
        " Ci = color(k, arraylength(l) + 10 * arraylength(c) + 100 * arraylength(none),"
        " l[2] + comp(c[1], 1)); }");
    EXPECT_EQ(middle(scene), vec3(11, 123, 9));
}

// ---- messages

const char* kLamp =
    "light lamp(float steps[3] = {1, 2, 4}; string name = \"lantern\"; color tint = color(1, 2, 3);"
    " matrix m = matrix(1,0,0,0, 0,1,0,0, 0,0,1,0, 5,6,7,1); string __category = \"key,warm\";) {"
    " solar(vector \"world\" (0, 0, -1), 0) Cl = 1; }";

SceneText lit(const std::string& body) {
    SceneText scene = floor_scene(surface("illuminance(P, normalize(N), PI/2) { " + body + " }"));
    scene.rsl_light("lamp", kLamp);
    return scene;
}

TEST(Lightsource, TellsArraysTextsAndMatrices) {
    EXPECT_EQ(middle(lit("float a[3] = {0, 0, 0}; float ok = lightsource(\"steps\", a);"
                         " Ci = ok * color(a[0], a[1], a[2]);")),
              vec3(1, 2, 4));
    EXPECT_EQ(middle(lit("string n = \"\"; float ok = lightsource(\"name\", n);"
                         " if (n == \"lantern\") Ci = ok;")),
              vec3(1));
    EXPECT_EQ(middle(lit("matrix m = 1; float ok = lightsource(\"m\", m);"
                         " Ci = ok * color(comp(m, 3, 0), comp(m, 3, 1), comp(m, 3, 2));")),
              vec3(5, 6, 7));
    EXPECT_EQ(middle(lit("point p = 0; float ok = lightsource(\"tint\", p);"
                         " Ci = ok * color(xcomp(p), ycomp(p), zcomp(p));")),
              vec3(1, 2, 3));
}

TEST(Lightsource, TellsPointsThatAreDefaultsWhereTheLightHasThem) {
    auto asked = [](const std::string& code) {
        SceneText scene =
            floor_scene(surface("illuminance(P, normalize(N), PI/2) { " + code + " }"));
        scene.rsl_light(
            "lamp",
            "light lamp(point at = (1, 2, 3), two[2] = {0, (4, 5, 6)}; vector way = 1;) {"
            " solar(vector \"world\" (0, 0, -1), 0) Cl = 1; }",
            "<translate>10 20 30</translate>");
        return middle(scene);
    };
    auto near = [](const vec3& a, const vec3& b) {
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 1e-4f);
    };
    near(asked("point p = 0; float ok = lightsource(\"at\", p); Ci = ok * "
               "color(transform(\"world\", p));"),
         vec3(11, 22, 27));  // "shader" space of a light looks along z, down
    near(asked("point p[2] = {0, 0}; float ok = lightsource(\"two\", p);"
               " Ci = ok * color(transform(\"world\", p[1]));"),
         vec3(14, 25, 24));
    near(asked("vector v = 0; float ok = lightsource(\"way\", v);"
               " Ci = ok * color(vtransform(\"world\", v));"),
         vec3(1, 1, -1));
}

TEST(Lightsource, LeavesTheVariableWhereNameOrTypeIsAnother) {
    EXPECT_EQ(middle(lit("float x = 7; float a = lightsource(\"tint\", x);"
                         " float y = 8; float b = lightsource(\"none\", y);"
                         " float l[2] = {9, 9}; float c = lightsource(\"steps\", l);"
                         " Ci = color(x + a, y + b, l[0] + c);")),
              vec3(7, 8, 9));
}

TEST(Lightsource, IsReadByPairsOfIlluminanceToo) {
    SceneText scene = floor_scene(surface(
        "color t = 0; string name = \"\"; illuminance(P, normalize(N), PI/2, \"lightcache\","
        " \"refresh\", \"light:tint\", t, \"light:name\", name) if (name == \"lantern\") Ci = t;"));
    scene.rsl_light("lamp", kLamp);
    EXPECT_EQ(middle(scene), vec3(1, 2, 3));
}

TEST(Categories, AreListsAndExpressions) {
    auto lights = [](const char* category) {
        SceneText scene = floor_scene(
            surface(fmt::format("illuminance(\"{}\", P, normalize(N), PI/2) Ci += Cl;", category)));
        int value = 1;
        for (const char* own : {"key, warm", "key ", "fill,warm", ""}) {
            scene.rsl_light(fmt::format("l{}", value),
                            fmt::format("light l(string __category = \"{}\";) {{"
                                        " solar(vector \"world\" (0,0,-1), 0) Cl = {}; }}",
                                        own, value));
            value *= 10;
        }
        return middle(scene).x;
    };
    EXPECT_EQ(lights("key"), 11);
    EXPECT_EQ(lights("-key"), 1100);
    EXPECT_EQ(lights("key,fill"), 111);
    EXPECT_EQ(lights("-key,fill"), 1000);
    EXPECT_EQ(lights("key|fill"), 111);
    EXPECT_EQ(lights("key&warm"), 1);
    EXPECT_EQ(lights("warm&-key"), 100);
    EXPECT_EQ(lights("key&-warm|fill"), 110);
    EXPECT_EQ(lights("-key|warm"), 1101);
    EXPECT_EQ(lights("key & - warm | fill"), 110);
    EXPECT_EQ(lights(""), 1111);
}

TEST(SurfaceMessage, ShowsALightTheParametersOfWhatItLights) {
    const char* lamp =
        "light lamp() { solar(vector \"world\" (0, 0, -1), 0) { color c = 0; string n = \"\";"
        " float bump = 0; float gone = 4; float ok = surface(\"base\", c);"
        " ok += surface(\"label\", n); ok += displacement(\"height\", bump);"
        " ok += surface(\"nothing\", gone);"
        " Cl = n == \"oak\" ? color(comp(c, 1), ok, bump + gone) : color(0); } }";
    SceneText scene = floor_scene(
        "displacement d(float height = 0.25;) { N = normalize(N); }"
        "surface s(color base = color(1, 2, 3); string label = \"\";) {"
        " Oi = 1; illuminance(P, normalize(N), PI/2) Ci = Cl; }",
        "<shader stage=\"DISPLACEMENT\"/><shader stage=\"SURFACE\">"
        "<bind symbol=\"base\"><float3>4 5 6</float3></bind>"
        "<bind symbol=\"label\"><string>oak</string></bind></shader>");
    scene.rsl_light("lamp", lamp);
    EXPECT_EQ(middle(scene), vec3(5, 3, 4.25f));
}

TEST(SurfaceMessage, ShowsALightDefaultsThatAreComputed) {
    SceneText scene = floor_scene(
        "surface s(float angle = degrees(PI / 2); color green = color \"hsv\" (1 / 3.0, 1, 1);"
        " string map = concat(\"oak\", \".tx\");) {"
        " Oi = 1; illuminance(P, normalize(N), PI/2) Ci = Cl; }");
    scene.rsl_light(
        "lamp",
        "light lamp() { solar(vector \"world\" (0, 0, -1), 0) { color c = 0; float a = 0;"
        " string m = \"\"; float ok = surface(\"angle\", a); ok += surface(\"green\", c);"
        " ok += surface(\"map\", m);"
        " Cl = m == \"oak.tx\" ? color(ok, a, 2 * comp(c, 1) + comp(c, 0)) : color(0);"
        " } }");
    vec3 got = middle(scene);
    EXPECT_EQ(got.x, 3);
    EXPECT_NEAR(got.y, 90, 1e-4);
    EXPECT_NEAR(got.z, 2, 1e-5);
}

TEST(SurfaceMessage, ShowsADisplacementTheSurfaceAboveIt) {
    SceneText scene = floor_scene(
        "displacement d(output float got = 0;) { float k = 0; float ok = surface(\"Kd\", k);"
        " got = k + ok; }"
        "surface s(float Kd = 0.5; float list[2] = {1, 2};) { Oi = 1; float g = 0;"
        " float ok = displacement(\"got\", g); Ci = color(g, ok, 0); }",
        "<shader stage=\"DISPLACEMENT\"/><shader stage=\"SURFACE\"/>");
    EXPECT_EQ(middle(scene), vec3(1.5f, 1, 0));
}

TEST(SurfaceMessage, CarriesArraysBetweenLayers) {
    SceneText scene = floor_scene(
        "displacement d(output float got[3] = {0, 0, 0};) { got[1] = 5; got[2] = s > -1 ? 6 : 0; }"
        "surface s() { Oi = 1; float g[3] = {1, 1, 1}; float ok = displacement(\"got\", g);"
        " Ci = ok * color(g[0], g[1], g[2]); }",
        "<shader stage=\"DISPLACEMENT\"/><shader stage=\"SURFACE\"/>");
    EXPECT_EQ(middle(scene), vec3(0, 5, 6));
}

TEST(VolumeMessages, AnswerNoWhereThereIsNoVolume) {
    EXPECT_EQ(middle(floor_scene(surface(
                  "float x = 3; float ok = atmosphere(\"density\", x) + incident(\"density\", x) +"
                  " opposite(\"density\", x); Ci = color(x, ok, 0);"))),
              vec3(3, 0, 0));
}

// ---- questions

TEST(Attribute, TellsTheGeometrysOwn) {
    SceneText scene;
    scene.square("floor", 1.5)
        .look(
            "oak",
            surface("uniform string name = \"\", look = \"\"; uniform float sides = 0, rate = 0;"
                    " attribute(\"identifier:name\", name); attribute(\"identifier:shadinggroup\", "
                    "look);"
                    " float ok = attribute(\"Ri:Sides\", sides) + attribute(\"ShadingRate\", rate);"
                    " float none = 5; ok += attribute(\"no:such\", none);"
                    " if (name == \"plank\" && look == \"oak\") Ci = color(sides, ok, none);"));
    scene.place("floor", "oak", "", "plank");
    EXPECT_EQ(middle(scene), vec3(2, 2, 5));
}

TEST(Attribute, FindsTheUsersOnTheNodeAndAboveIt) {
    SceneText scene;
    scene.square("floor", 1.5)
        .look("oak",
              surface("color tint = 0; string who = \"\"; float k = 0;"
                      " float ok = attribute(\"user:tint\", tint) + attribute(\"user:who\", who) +"
                      " attribute(\"user:k\", k); if (who == \"anna bell\") Ci = tint * k * ok;"));
    scene.nodes +=
        "<node><node><instance_geometry url=\"#floor\"><bind_material><technique_common>"
        "<instance_material symbol=\"skin\" target=\"#oak\"/></technique_common></bind_material>"
        "</instance_geometry><extra><technique profile=\"RSL\"><attribute name=\"user:tint\">1 2 3"
        "</attribute><attribute name=\"user:k\">2</attribute></technique></extra></node>"
        "<extra><technique profile=\"RSL\"><attribute name=\"user:who\">anna bell</attribute>"
        "<attribute name=\"user:k\">9</attribute></technique></extra></node>";
    EXPECT_EQ(middle(scene), vec3(6, 12, 18));
}

TEST(Option, TellsThePictureAndTheTime) {
    EXPECT_EQ(
        middle(floor_scene(surface(
            "uniform float f[3] = {0, 0, 0}, c[2] = {0, 0}, t[2] = {0, 0}; uniform float a = 0;"
            " float ok = option(\"Format\", f) + option(\"Clipping\", c) +"
            " option(\"Ri:Shutter\", t) + option(\"FrameAspectRatio\", a);"
            " if (ok == 4) Ci = color(f[0] + f[1] / 10 + a, c[1], t[0]);"))),
        vec3(5.4f, 100, 0.5f));
}

TEST(Option, LeavesTheVariableWhereTypeOrNameIsAnother) {
    EXPECT_EQ(
        middle(floor_scene(surface(
            "string s = \"x\"; float f[4] = {7, 7, 7, 7}; float g = 3;"
            " float ok = option(\"Format\", s) + option(\"Format\", f) + option(\"what\", g) +"
            " option(\"Format\", g); if (s == \"x\") Ci = color(ok, f[3], g);"))),
        vec3(0, 7, 3));
}

TEST(Rendererinfo, NamesTheRendererAndItsVersion) {
    EXPECT_EQ(middle(floor_scene(surface(
                  "string who = \"\", text = \"\"; float v[4] = {9, 9, 9, 9};"
                  " float ok = rendererinfo(\"renderer\", who) + rendererinfo(\"version\", v) +"
                  " rendererinfo(\"versionstring\", text);"
                  " if (who == \"Kinora\" && text != \"\" && v[0] + v[1] + v[2] > 0 && v[0] < 9)"
                  "   Ci = color(ok, v[3], 1);"))),
              vec3(3, 0, 1));
}

TEST(Rayinfo, TellsTheCamerasRay) {
    EXPECT_EQ(middle(floor_scene(surface(
                  "string kind = \"\"; float d = 9, l = 0; point o = 0; vector w = 0;"
                  " float ok = rayinfo(\"type\", kind) + rayinfo(\"depth\", d) +"
                  " rayinfo(\"length\", l) + rayinfo(\"origin\", o) + rayinfo(\"direction\", w);"
                  " l += length(o + l * w - P);"
                  " if (kind == \"camera\") Ci = color(ok, l, d + raydepth());"))),
              vec3(5, 10, 0));
}

TEST(Shadername, NamesTheOthersOfThePoint) {
    SceneText scene = floor_scene(
        "displacement bumps() { N = N; } surface paint() { Oi = 1; Ci = 0;"
        " if (shadername() == \"paint\") Ci += color(1, 0, 0);"
        " if (shadername(\"displacement\") == \"bumps\") Ci += color(0, 1, 0);"
        " if (shadername(\"atmosphere\") == \"\") Ci += color(0, 0, 1); }",
        "<shader stage=\"DISPLACEMENT\"/><shader stage=\"SURFACE\"/>");
    EXPECT_EQ(middle(scene), vec3(1));
}

// ---- of each point, whichever it is shaded with

// Pictures of many sizes on all targets, whose red is what `want` says of a point.
template <class Want>
void expect_red_everywhere(const SceneText& scene, Want&& want) {
    for (const jit::Target& target : jit::targets()) {
        if (!target.supported()) continue;
        for (int size : {3, 4, 16}) {
            SceneOptions options;
            options.target = &target;
            Rendering r(scene.text(), options);
            r.frame(size, size);
            EXPECT_FALSE(r.diagnostics.has_errors()) << r.findings();
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x)
                    ASSERT_NEAR(r.color(x, y).x, want(r.place(x, y)), 1e-6)
                        << target.name << " " << size << ": " << x << "," << y;
        }
    }
}

TEST(SurfaceQuestion, OfALightFindsVertexInputsAtEachPoint) {
    const char* bound =
        "<bind_vertex_input semantic=\"w\" input_semantic=\"TEXCOORD\" input_set=\"0\"/>";
    for (const char* reads : {"", " if (w < -5) Ci = 0;"})
        for (const char* at : {"P", "Q"}) {
            SCOPED_TRACE(fmt::format("{} {}", at, reads));
            SceneText scene;
            scene.square("floor", 1.5)
                .look("look", fmt::format("surface s(varying float w = 0;) {{ Oi = 1; Ci = 0;"
                                          " point Q = P + normalize(N) * (0.1 + 0.001 * t);"
                                          " illuminance({}) {{ Ci += Cl; }} {} }}",
                                          at, reads))
                .place("floor", "look", "", "", bound);
            scene.rsl_light("lamp",
                            "light lamp() { float q = 7; float k = surface(\"w\", q);"
                            " solar(vector \"world\" (0, 0, -1), 0) Cl = color(q, k, 1); }");
            expect_red_everywhere(scene, [](dvec2 p) { return (p.x + 1.5) / 3; });
        }
}

TEST(SurfaceQuestion, OfALightOnGeometryIsAboutTheSurfaceItLights) {
    SceneText scene;
    scene.square("floor", 1.5)
        .look("look",
              "surface s(varying float w = 0; float k = 5;) { Oi = 1; Ci = 0;"
              " illuminance(P) { Ci += Cl; } }")
        .place("floor", "look", "", "",
               "<bind_vertex_input semantic=\"w\" input_semantic=\"TEXCOORD\" input_set=\"0\"/>");
    scene.look(
        "lamp",
        "surface bulb(float k = 3;) { Oi = 1; Ci = 1; }\n"
        "light l() { float q = 7, k = 7; float known = surface(\"w\", q) + surface(\"k\", k);"
        " illuminate(P) Cl = q * known * k / 10; }",
        "<shader stage=\"SURFACE\"/><shader stage=\"LIGHT\"/>");
    scene.square("panel", 0.5).place("panel", "lamp", "<translate>0 0 20</translate>");
    expect_red_everywhere(scene, [](dvec2 p) { return (p.x + 1.5) / 3; });
}

TEST(Rayinfo, LabelsAreThoseOfEachPointsRay) {
    const char* rays[] = {
        "Ci = trace(P, up, \"label\", side);",
        "color c = 0; gather(\"illuminance\", P, up, 0, 1, \"surface:Ci\", c, \"label\", side) { }"
        " Ci = c;"};
    for (const char* ray : rays) {
        SceneText scene = floor_scene(
            surface(std::string("vector up = vector \"world\" (0, 0, 1); string side = \"right\";"
                                " if (s < 0.4) side = \"left\"; ") +
                    ray));
        scene.square("roof", 5).look(
            "roof-look", surface("string l = \"\"; float k = rayinfo(\"label\", l);"
                                 " if (l == \"left\") Ci = 1; if (l == \"right\") Ci = 2;"));
        scene.place("roof", "roof-look", "<translate>0 0 20</translate>");
        expect_red_everywhere(scene, [](dvec2 p) { return (p.x + 1.5) / 3 < 0.4 ? 1 : 2; });
    }
}

// ---- facts

TEST(Attribute, SidesAreOneWhereTheMeshSaysSo) {
    std::string code = surface(
        "float n = 7, b = 7; attribute(\"Sides\", n);"
        " attribute(\"cull:backfacing\", b); Ci = color(n, b, 0);");
    SceneText scene = floor_scene(code);
    EXPECT_EQ(middle(scene), vec3(2, 0, 0));
    std::string end = "</mesh></geometry>";
    scene.geometries.replace(scene.geometries.find(end), end.size(),
                             "</mesh><extra><technique profile=\"MAYA\"><double_sided>0"
                             "</double_sided></technique></extra></geometry>");
    EXPECT_EQ(middle(scene), vec3(1, 1, 0));
}

TEST(Attribute, OfTheUserMayBeALongArrayOrAMatrix) {
    SceneText scene;
    scene.square("floor", 1.5)
        .look("oak", surface("float five[5] = {7, 7, 7, 7, 7}; matrix m = 0; float four[4] = {7, 7,"
                             " 7, 7}; float ok = attribute(\"user:five\", five) +"
                             " attribute(\"user:m\", m) + attribute(\"user:five\", four);"
                             " Ci = color(ok, five[0] + 10 * five[4] + 100 * four[3],"
                             " comp(m, 0, 1) + 100 * comp(m, 3, 2));"));
    scene.nodes +=
        "<node><instance_geometry url=\"#floor\"><bind_material><technique_common>"
        "<instance_material symbol=\"skin\" target=\"#oak\"/></technique_common></bind_material>"
        "</instance_geometry><extra><technique profile=\"RSL\"><attribute name=\"user:five\">"
        "1 2 3 4 5</attribute><attribute name=\"user:m\">0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15"
        "</attribute></technique></extra></node>";
    EXPECT_EQ(middle(scene), vec3(3, 451, 1401));
}

TEST(Option, FrameCountsByTheRateThatIsAskedFor) {
    SceneText scene = floor_scene(surface("float f = 7; option(\"Frame\", f); Ci = f;"));
    EXPECT_EQ(middle(scene), vec3(12));
    SceneOptions options;
    options.frame_rate = 30;
    Rendering r(scene.text(), options);
    EXPECT_EQ(r.frame(4, 4, 0.5).color(1, 1), vec3(15));
}

}  // namespace
}  // namespace kinora
