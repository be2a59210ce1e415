// tests/runtime/import_test.cpp: materials and parameters of a document on their way to shaders.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "runtime/scene/shaders/shader_instance.h"
#include "scene_text.h"

namespace kinora {
namespace {

const char* kShow = "surface show(float a = 0.125; color c = 0;) { Oi = 1; Ci = a + c; }";
const char* kBindA =
    "<shader stage=\"SURFACE\"><bind symbol=\"a\"><param ref=\"amount\"/></bind></shader>";
const char* kAmount = "<newparam sid=\"amount\"><float>0.25</float></newparam>";

// Two squares side by side in the materials "left" and "right" of the effect.
SceneText pair_scene(const std::string& left_set, const std::string& right_set) {
    SceneText scene;
    scene.look("x", kShow, kBindA, kAmount).square("half", 0.5);
    scene.materials = fmt::format(
        "<material id=\"left\"><instance_effect url=\"#x-fx\">{}</instance_effect></material>"
        "<material id=\"right\"><instance_effect url=\"#x-fx\">{}</instance_effect></material>",
        left_set, right_set);
    scene.place("half", "left", "<translate>-0.5 0 0</translate>")
        .place("half", "right", "<translate>0.5 0 0</translate>");
    return scene;
}
std::string setparam(double value) {
    return fmt::format("<setparam ref=\"amount\"><float>{}</float></setparam>", value);
}
float left(const Rendering& r) {
    return r.color(4, 8).x;
}
float right(const Rendering& r) {
    return r.color(11, 8).x;
}

TEST(Parameters, TheShadersDefaultHoldsWhereNothingIsBound) {
    SceneText scene;
    scene.square("s").look("l", kShow).place("s", "l");
    EXPECT_EQ(Rendering(scene.text()).frame().color(8, 8).x, 0.125f);
}

TEST(Parameters, ANewparamOverridesTheShaderAndASetparamTheNewparam) {
    Rendering r(pair_scene("", setparam(0.75)).text());
    r.frame();
    EXPECT_EQ(left(r), 0.25f) << r.findings();
    EXPECT_EQ(right(r), 0.75f);
}

TEST(Parameters, LiteralsOfEveryTypeReachTheShader) {
    SceneText scene;
    scene.square("s")
        .look("l",
              "surface s(float f = 0; color c = 0; string n = \"\"; vector v = 0;) {"
              " Oi = 1; Ci = color(f, comp(c, 1), n == \"yes\" ? 1 : 0) + 0 * xcomp(v); }",
              "<shader stage=\"SURFACE\"><bind symbol=\"f\"><float>0.5</float></bind>"
              "<bind symbol=\"c\"><color>0.1 0.2 0.3</color></bind>"
              "<bind symbol=\"n\"><string>yes</string></bind></shader>")
        .place("s", "l");
    Rendering r(scene.text());
    vec3 c = r.frame().color(8, 8);
    EXPECT_EQ(c, vec3(0.5f, 0.2f, 1.0f)) << r.findings();
}

TEST(Parameters, AnEffectChannelReachesOnlyMaterialsThatDoNotOverrideIt) {
    SceneText scene = pair_scene("", setparam(0.75));
    scene.animate("x-fx/amount", {0, 1}, {0, 1});
    Rendering r(scene.text());
    r.frame(0.5);
    EXPECT_FLOAT_EQ(left(r), 0.5f) << r.findings();
    EXPECT_EQ(right(r), 0.75f);
}

TEST(Parameters, AMaterialChannelReachesThatMaterialOnlyAlsoWithoutASetparam) {
    SceneText scene = pair_scene("", "");
    scene.animate("right/amount", {0, 1}, {0, 1});
    Rendering r(scene.text());
    r.frame(0.5);
    EXPECT_EQ(left(r), 0.25f) << r.findings();
    EXPECT_FLOAT_EQ(right(r), 0.5f);
    r.frame(0.25);
    EXPECT_FLOAT_EQ(right(r), 0.25f);
}

TEST(Parameters, ABindOfAnInstanceTakesTheTargetsValueAnimatedOrNot) {
    SceneText scene;
    scene.look("x", kShow, kBindA, kAmount).square("half", 0.5);
    scene.nodes += "<node id=\"probe\"><translate sid=\"t\">0 0.5 0</translate></node>";
    scene.place("half", "x", "<translate>-0.5 0 0</translate>")
        .place("half", "x", "<translate>0.5 0 0</translate>", "",
               "<bind semantic=\"a\" target=\"probe/t.Y\"/>");
    Rendering still(scene.text());
    still.frame();
    EXPECT_EQ(left(still), 0.25f) << still.findings();
    EXPECT_EQ(right(still), 0.5f);
    scene.animate("probe/t.Y", {0, 1}, {0, 1});
    Rendering r(scene.text());
    r.frame(0.75);
    EXPECT_EQ(left(r), 0.25f) << r.findings();
    EXPECT_FLOAT_EQ(right(r), 0.75f);
}

TEST(Parameters, PointsAreGivenInShaderSpaceAndVectorsTurnWithIt) {
    SceneText scene;
    scene.square("s")
        .look("l",
              "surface s(point p = 0; vector v = 0;) { Oi = 1;"
              " point w = transform(\"world\", p); vector d = vtransform(\"world\", v);"
              " Ci = color(xcomp(w) + xcomp(d), ycomp(w) + ycomp(d), zcomp(w) + zcomp(d)); }",
              "<shader stage=\"SURFACE\"><bind symbol=\"p\"><point>1 2 3</point></bind>"
              "<bind symbol=\"v\"><vector>10 20 30</vector></bind></shader>")
        .place("s", "l", "<translate>0 0 0.5</translate><rotate>0 0 1 90</rotate>");
    Rendering r(scene.text());
    vec3 c = r.frame().color(8, 8);
    // Turned by 90 degrees about z: (1,2,3) -> (-2,1,3) + translation; (10,20,30) -> (-20,10,30).
    EXPECT_NEAR(c.x, -22, 1e-5) << r.findings();
    EXPECT_NEAR(c.y, 11, 1e-5);
    EXPECT_NEAR(c.z, 33.5, 1e-5);
}

TEST(Parameters, AnUnknownBindSaysWhereAndWhatWasMeant) {
    SceneText scene;
    scene.square("s")
        .look("l", "surface s(float diffuse_gain = 0.5;) { Oi = 1; Ci = diffuse_gain; }",
              "<shader stage=\"SURFACE\">\n  <bind symbol=\"difuse_gain\"><float>1</float></bind>"
              "\n</shader>")
        .place("s", "l");
    Rendering r(scene.text());
    ASSERT_EQ(r.count("RSL_BIND_UNKNOWN"), 1) << r.findings();
    const Finding& finding = *r.find("RSL_BIND_UNKNOWN");
    EXPECT_NE(finding.help.find("'diffuse_gain'"), std::string::npos) << finding.help;
    LineColumn at = r.where(finding);
    std::string_view line = r.diagnostics.files.line_text(finding.where.file, at.line);
    EXPECT_NE(line.find("<bind symbol=\"difuse_gain\""), std::string_view::npos) << line;
    EXPECT_GT(at.column, 1);
    EXPECT_EQ(r.frame().color(8, 8).x, 0.5f);
}

TEST(Parameters, ABindOfTheWrongTypeIsAFindingAndTheDefaultHolds) {
    SceneText scene;
    scene.square("s")
        .look("l", kShow,
              "<shader stage=\"SURFACE\"><bind symbol=\"a\"><string>much</string></bind></shader>")
        .place("s", "l");
    Rendering r(scene.text());
    EXPECT_EQ(r.count("RSL_BIND_TYPE"), 1) << r.findings();
    EXPECT_EQ(r.frame().color(8, 8).x, 0.125f);
}

TEST(Parameters, AStringThatNamesAnImageBecomesItsFile) {
    SceneText scene;
    scene.images = "<image id=\"wood-image\"><init_from>textures/wood.png</init_from></image>";
    scene.square("s")
        .look(
            "l",
            "surface s(string map = \"\";) { Oi = 1; Ci = 0; if (s > 0.99) printf(\"%s\\n\", map); "
            "}",
            "<shader stage=\"SURFACE\"><bind symbol=\"map\"><string>wood-image</string></bind>"
            "</shader>")
        .place("s", "l");
    Rendering r(scene.text());
    ASSERT_TRUE(r.scene) << r.findings();
    const ShaderInstance& look = *r.scene->shader_instances[0];
    ASSERT_EQ(look.layers[0].params.size(), 1u);
    const std::string& name = look.layers[0].params[0].strings[0];
    EXPECT_NE(name.find("textures/wood.png"), std::string::npos) << name;
}

// ---- shaders that are not there

TEST(Shaders, AnErrorInsideCdataHasTheDocumentsLineAndColumn) {
    SceneText scene;
    scene.square("s")
        .look("l", "surface s()\n{\n    Oi = 1;\n    Ci = wibble(3);\n}")
        .place("s", "l");
    std::string text = scene.text();
    Rendering r(text);
    ASSERT_TRUE(r.diagnostics.has_errors());
    size_t place = text.find("wibble");
    int line = 1 + int(std::count(text.begin(), text.begin() + long(place), '\n'));
    int column = int(place - text.rfind('\n', place));
    bool found = false;
    for (const Finding& finding : r.diagnostics.findings())
        if (finding.severity == Severity::Error) {
            LineColumn at = r.where(finding);
            EXPECT_EQ(at.line, line) << r.findings();
            EXPECT_EQ(at.column, column) << r.findings();
            found = true;
        }
    EXPECT_TRUE(found);
    // The scene is still shown, in the default material.
    EXPECT_GT(r.frame().film.at(8, 8).w, 0.99f);
}

TEST(Shaders, EscapedCodeKeepsItsPlacesToo) {
    SceneText scene;
    scene.square("s").place("s", "l");
    scene.effects =
        "<effect id=\"l-fx\"><profile_RSL><technique sid=\"t\"><code>surface s() {\n"
        "if (1 &lt; 2 &amp;&amp; 3 &gt; 2) Ci = wibble(3); }</code><pass><shader "
        "stage=\"SURFACE\"/></pass></technique></profile_RSL></effect>";
    scene.materials = "<material id=\"l\"><instance_effect url=\"#l-fx\"/></material>";
    Rendering r(scene.text());
    std::string text = scene.text();
    size_t place = text.find("wibble");
    bool found = false;
    for (const Finding& finding : r.diagnostics.findings())
        found |= finding.severity == Severity::Error && finding.where.begin == place;
    EXPECT_TRUE(found) << r.findings();
}

TEST(Shaders, StagesThatHaveNoSenseOnASurfaceSaySo) {
    SceneText scene;
    scene.square("s")
        .look("l", "surface s() { Oi = 1; Ci = 1; } imager grey() { Ci *= 0.5; }",
              "<shader stage=\"SURFACE\"/><shader stage=\"IMAGER\"/>")
        .place("s", "l");
    Rendering r(scene.text());
    ASSERT_EQ(r.count("RSL_STAGE_PLACE"), 1) << r.findings();
    EXPECT_NE(r.find("RSL_STAGE_PLACE")->message.find("IMAGER"), std::string::npos);
    EXPECT_GT(r.where(*r.find("RSL_STAGE_PLACE")).line, 1);
    EXPECT_EQ(r.frame().color(8, 8).x, 1.0f);
}

TEST(Shaders, ANameWithoutShaderAndSeveralWithoutANameAreErrors) {
    const char* two = "surface a() { Ci = 1; Oi = 1; } surface b() { Ci = 0.5; Oi = 1; }";
    SceneText scene;
    scene.square("s")
        .look("l", two, "<shader stage=\"SURFACE\"><name>c</name></shader>")
        .place("s", "l");
    Rendering missing(scene.text());
    EXPECT_EQ(missing.count("RSL_SHADER_MISSING"), 1) << missing.findings();
    scene = SceneText();
    scene.square("s").look("l", two).place("s", "l");
    Rendering ambiguous(scene.text());
    EXPECT_EQ(ambiguous.count("RSL_SHADER_AMBIGUOUS"), 1) << ambiguous.findings();
    scene = SceneText();
    scene.square("s")
        .look("l", two, "<shader stage=\"SURFACE\"><name>b</name></shader>")
        .place("s", "l");
    EXPECT_EQ(Rendering(scene.text()).frame().color(8, 8).x, 0.5f);
}

TEST(Shaders, SurfacesOfOnePassAreLayers) {
    SceneText scene;
    scene.square("s")
        .look("l",
              "surface under() { Oi = 1; Ci = color(0, 1, 0); }"
              "surface over() { Oi = 0.25; Ci = color(0.25, 0, 0); }",
              "<shader stage=\"SURFACE\"><name>under</name></shader>"
              "<shader stage=\"SURFACE\"><name>over</name></shader>")
        .place("s", "l");
    Rendering r(scene.text());
    vec3 c = r.frame().color(8, 8);
    EXPECT_FLOAT_EQ(c.x, 0.25f) << r.findings();
    EXPECT_FLOAT_EQ(c.y, 0.75f);
    EXPECT_FLOAT_EQ(r.film.at(8, 8).w, 1.0f);
}

TEST(Materials, AMeshWithoutAMaterialWearsTheDefaultAndSaysSo) {
    SceneText scene;
    scene.square("s").place("s", "");
    scene.light("sky", "<ambient><color>1 1 1</color></ambient>")
        .light("dark", "<directional><color>0 0 0</color></directional>");
    Rendering r(scene.text());
    r.frame();
    EXPECT_EQ(r.count("MAT_NO_BIND") + r.count("MATERIAL_UNBOUND"), 1) << r.findings();
    EXPECT_NEAR(r.color(8, 8).x, 0.8, 1e-6);
}

TEST(Materials, ASymbolThatNothingBindsWearsTheDefaultAndSaysSo) {
    SceneText scene;
    scene.square("s").look("l", kShow).look("m", kShow).place("s", "l");
    std::string text = scene.text();
    // One of two: it is not known which is meant (of one it is: meshes_test.cpp).
    text.replace(text.find("<instance_material symbol=\"skin\""), 32,
                 "<instance_material symbol=\"hat\" target=\"#m\"/>"
                 "<instance_material symbol=\"coat\"");
    Rendering r(text);
    EXPECT_EQ(r.count("MAT_UNBOUND_SYMBOL") + r.count("MATERIAL_UNBOUND"), 1) << r.findings();
    EXPECT_GT(r.frame().film.at(8, 8).w, 0.99f);
}

TEST(Scenes, ATransformOfAMovingNodeMovesWhatHangsThere) {
    SceneText scene;
    scene.square("s", 0.25).look("l", "surface s() { Oi = 1; Ci = 1; }");
    scene.place("s", "l", "<translate sid=\"t\">0 0 0</translate>", "mover")
        .animate("mover/t.X", {0, 1}, {-0.5, 0.5});
    Rendering r(scene.text());
    for (double time : {0.0, 1.0, 0.5}) {
        r.frame(time);
        double centre = time - 0.5;
        for (int x = 0; x < 16; ++x) {
            bool covered = std::abs(r.place(x, 8).x - centre) < 0.25;
            EXPECT_EQ(r.film.at(x, 8).w, covered ? 1.0f : 0.0f) << time << " " << x;
        }
    }
}

TEST(Scenes, AFileThatIsNotThereOrNotXmlIsAnError) {
    auto missing = Rendering::of_file("/nowhere/at_all.dae");
    EXPECT_FALSE(missing->scene);
    EXPECT_TRUE(missing->diagnostics.has_errors());
    Rendering broken("<COLLADA><asset></COLLADA>");
    EXPECT_FALSE(broken.scene);
    EXPECT_TRUE(broken.diagnostics.has_errors());
}

}  // namespace
}  // namespace kinora
