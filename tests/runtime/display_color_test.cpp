// tests/runtime/display_color_test.cpp: COLLADA's colours are those of a display: what is decoded,
// what is not, and what moves.
#include "runtime/scene/description/display_color.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "expect_colors.h"
#include "runtime/scene/images/texture_pyramid.h"
#include "runtime/scene/shaders/shader_instance.h"
#include "scene_text.h"

namespace kinora {
namespace {

// IEC 61966-2-1: ((x + 0.055) / 1.055) ^ 2.4, by a desk calculator.
constexpr double kEighth = 0.0143498747, kQuarter = 0.0508760882, kHalf = 0.2140411405;

void expect_near(const dvec3& got, const dvec3& want, double tolerance = 1e-9) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(got[k], want[k], tolerance) << k;
}

TEST(DisplayColor, IsDecodedByTheCurveOfSrgb) {
    expect_near(linear_of_display({0.125, 0.25, 0.5}), {kEighth, kQuarter, kHalf});
    expect_near(linear_of_display({0.01, 0.04, 0}), {0.01 / 12.92, 0.04 / 12.92, 0}, 1e-15);
    EXPECT_EQ(linear_of_display(dvec3(1)), dvec3(1));
    EXPECT_EQ(display_of_linear(dvec3(1)), dvec3(1));
}

TEST(DisplayColor, IsWhatATextureOfThatColorHolds) {
    for (int k = 0; k < 256; ++k)
        EXPECT_NEAR(linear_of_display(dvec3(k / 255.0)).x, srgb_table()[size_t(k)], 1e-7) << k;
}

TEST(DisplayColor, AboveOneTwiceTheNumbersAreTwiceTheLight) {
    expect_near(linear_of_display({2, 1, 0.5}), {2, 2 * kHalf, 2 * kQuarter});
    expect_near(linear_of_display({1000, 500, 0}), {1000, 1000 * kHalf, 0}, 1e-6);
    expect_near(linear_of_display({1e300, 0, 0}) / 1e300, {1, 0, 0});
}

TEST(DisplayColor, BelowZeroIsWhatItsMagnitudeTakesAway) {
    expect_near(linear_of_display({-0.5, 0.25, -0.125}), {-kHalf, kQuarter, -kEighth});
    expect_near(linear_of_display({-2, 1, 0}), {-2, 2 * kHalf, 0});
}

TEST(DisplayColor, NumbersThatAreNoneHaveADefinedColor) {
    double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
    expect_near(linear_of_display({nan, 0.5, 2}), linear_of_display({0, 0.5, 2}));
    dvec3 endless = linear_of_display({inf, 1.292, -inf});
    EXPECT_EQ(endless.x, inf);
    EXPECT_NEAR(endless.y, 0.1, 1e-12);
    EXPECT_EQ(endless.z, -inf);
}

TEST(DisplayColor, EncodingIsTheInverse) {
    for (double scale : {1e-6, 0.003, 0.04, 0.3, 1.0, 7.0, 318.3, 1e9})
        for (const dvec3& hue : {dvec3(1, 1, 1), dvec3(1, 0.5, 0.001), dvec3(-1, 0.2, 0)}) {
            dvec3 color = scale * hue;
            expect_near(linear_of_display(display_of_linear(color)) / scale, hue, 1e-12);
            expect_near(display_of_linear(linear_of_display(color)) / scale, hue, 1e-12);
        }
}

// A wall before the camera in a material of profile_COMMON.
SceneText wall(const std::string& shading, const std::string& params = "",
               const std::string& setparams = "", const std::string& inside = "") {
    SceneText scene;
    scene.effects = fmt::format(
        "<effect id=\"fx\"><profile_COMMON>{}<technique sid=\"t\">{}</technique></profile_COMMON>"
        "</effect>",
        params, shading);
    scene.materials = fmt::format(
        "<material id=\"look\"><instance_effect url=\"#fx\">{}</instance_effect></material>",
        setparams);
    return scene.square("wall", 1.5).place("wall", "look", "", "", inside);
}

std::string emission(const std::string& value) {
    return "<constant><emission>" + value + "</emission></constant>";
}

// The numbers that the first material's surface gets for a parameter.
std::vector<double> given(const Rendering& r, std::string_view name) {
    const SceneDescription& description = *r.scene->description;
    for (const ParamSource& p : description.materials.at(0).surfaces.at(0).params)
        if (p.name == name && p.value.present()) {
            auto first = description.values.begin() + p.value.offset;
            return {first, first + p.value.count};
        }
    return {};
}

void expect_given(const Rendering& r, std::string_view name, const std::vector<double>& want) {
    std::vector<double> got = given(r, name);
    ASSERT_EQ(got.size(), want.size()) << name << r.findings();
    for (size_t k = 0; k < want.size(); ++k) EXPECT_NEAR(got[k], want[k], 1e-9) << name;
}

TEST(CommonColors, FiveSlotsAreDecodedAndMeasuresAreNot) {
    Rendering r(
        wall("<phong><emission><color>0.125 0.25 0.5 1</color></emission>"
             "<ambient><color>0.25 0.25 0.5 1</color></ambient>"
             "<diffuse><color>0.5 0.25 0.125 0.5</color></diffuse>"
             "<specular><color>2 1 0.5 1</color></specular>"
             "<shininess><float>5</float></shininess>"
             "<reflective><color>0.5 0.5 0.5 1</color></reflective>"
             "<reflectivity><float>0.25</float></reflectivity>"
             "<transparent opaque=\"RGB_ONE\"><color>0.5 0.25 0.5 0.125</color></transparent>"
             "<transparency><float>0.5</float></transparency></phong>")
            .text());
    ASSERT_TRUE(r.scene) << r.findings();
    expect_given(r, "emission", {kEighth, kQuarter, kHalf});
    expect_given(r, "ambient_color", {kQuarter, kQuarter, kHalf});
    expect_given(r, "diffuse", {kHalf, kQuarter, kEighth});
    expect_given(r, "specular", {2, 2 * kHalf, 2 * kQuarter});
    expect_given(r, "shininess", {5});
    expect_given(r, "reflective", {kHalf, kHalf, kHalf});
    expect_given(r, "reflectivity", {0.25});
    expect_given(r, "transparent", {0.5, 0.25, 0.5});
    expect_given(r, "transparent_alpha", {0.125});
    expect_given(r, "transparency", {0.5});
}

TEST(CommonColors, ParametersAreDecodedWhereASlotOfLightReadsThem) {
    const std::string param = "<newparam sid=\"c\"><float4>0.5 0.5 0.25 0.25</float4></newparam>";
    const std::string shading =
        "<lambert><emission><param ref=\"c\"/></emission><transparent opaque=\"RGB_ONE\">"
        "<param ref=\"c\"/></transparent></lambert>";
    Rendering one(wall(shading, param).text());
    expect_given(one, "emission", {kHalf, kHalf, kQuarter});
    expect_given(one, "transparent", {0.5, 0.5, 0.25});
    Rendering other(
        wall(shading, param, "<setparam ref=\"c\"><float4>0.25 0.125 0.5 1</float4></setparam>")
            .text());
    expect_given(other, "emission", {kQuarter, kEighth, kHalf});
}

TEST(CommonColors, AreSeenAsDecoded) {
    Rendering r(wall(emission("<color>0.5 0.25 2 1</color>")).text());
    expect_colors(r.frame(), [](dvec2) { return dvec3(2 * kQuarter, 2 * kEighth, 2); });
}

TEST(CommonColors, AFloatInASlotIsAGreyOfLight) {
    Rendering r(wall(emission("<float>0.5</float>")).text());
    expect_colors(r.frame(), [](dvec2) { return dvec3(0.5); });
}

TEST(CommonColors, OfLightsAreDecoded) {
    SceneText scene = floor_scene("surface s() { Oi = 1; Ci = diffuse(normalize(N)); }");
    scene.light("sun", "<directional><color>0.5 2 1</color></directional>");
    expect_colors(Rendering(scene.text()).frame(),
                  [](dvec2) { return dvec3(2 * kQuarter, 2, 2 * kHalf); });
}

TEST(MovingColors, AreInterpolatedAsWrittenAndDecodedAfter) {
    SceneText scene = wall(emission("<color>0 0.5 1 1</color>"));
    scene.animate("fx/t/emission.R", {0, 1}, {0, 1});
    Rendering r(scene.text());
    expect_colors(r.frame(0.5), [](dvec2) { return dvec3(kHalf, kHalf, 1); });
    expect_colors(r.frame(0.25), [](dvec2) { return dvec3(kQuarter, kHalf, 1); });
    expect_colors(r.frame(1), [](dvec2) { return dvec3(1, kHalf, 1); });
}

TEST(MovingColors, OneComponentAboveOneScalesAllThree) {
    SceneText scene = wall(emission("<color>0 0.5 1 1</color>"));
    scene.animate("fx/t/emission.R", {0, 1}, {0, 4});
    Rendering r(scene.text());
    expect_colors(r.frame(0.5), [](dvec2) { return dvec3(2, 2 * kQuarter, 2 * kHalf); });
}

TEST(MovingColors, AParameterMovesAColorAndAMeasureAlike) {
    SceneText scene = wall(
        "<lambert><emission><param ref=\"c\"/></emission><transparent opaque=\"RGB_ONE\">"
        "<param ref=\"c\"/></transparent></lambert>",
        "<newparam sid=\"c\"><float4>1 1 1 1</float4></newparam>");
    scene.animate("fx/c(0)", {0, 1}, {0, 1});
    Rendering r(scene.text());
    expect_colors(r.frame(0.5), [](dvec2) { return dvec3(0.5 * kHalf, 1, 1); });
}

TEST(MovingColors, OfLightsAreDecodedAfter) {
    SceneText scene = floor_scene("surface s() { Oi = 1; Ci = diffuse(normalize(N)); }");
    scene.light("sun", "<directional><color sid=\"c\">1 1 1</color></directional>");
    scene.animate("sun/c.G", {0, 1}, {0, 1});
    expect_colors(Rendering(scene.text()).frame(0.25), [](dvec2) { return dvec3(1, kQuarter, 1); });
}

TEST(MovingColors, OnlyWhatMovesIsDecodedInFrames) {
    SceneText scene = wall(
        "<lambert><emission><color>0 0.5 1 1</color></emission><diffuse>"
        "<color>0.5 0.5 0.5 1</color></diffuse></lambert>");
    Rendering still(scene.text());
    EXPECT_TRUE(still.scene->description->moving_colors.empty());
    scene.animate("fx/t/emission.R", {0, 1}, {0, 1});
    Rendering moving(scene.text());
    EXPECT_EQ(moving.scene->description->moving_colors.size(), 1u);
}

// The mesh "wall" with one colour at all vertices.
void add_vertex_colors(SceneText& scene, const std::string& color) {
    std::string all;
    for (int k = 0; k < 4; ++k) all += color + " ";
    std::string source = fmt::format(
        "<source id=\"cs\"><float_array id=\"cs-a\" count=\"12\">{}</float_array><technique_common>"
        "<accessor source=\"#cs-a\" count=\"4\" stride=\"3\"><param name=\"R\" type=\"float\"/>"
        "<param name=\"G\" type=\"float\"/><param name=\"B\" type=\"float\"/></accessor>"
        "</technique_common></source>",
        all);
    scene.geometries.insert(scene.geometries.find("<vertices"), source);
    scene.geometries.insert(scene.geometries.find("<p>"),
                            "<input semantic=\"COLOR\" source=\"#cs\" offset=\"0\"/>");
}

TEST(VertexColors, OfProfileCommonAreDecoded) {
    SceneText scene = wall(emission("<color>1 1 1 1</color>"), "", "",
                           "<bind_vertex_input semantic=\"emission\" input_semantic=\"COLOR\"/>");
    add_vertex_colors(scene, "0.5 0.25 2");
    expect_colors(Rendering(scene.text()).frame(),
                  [](dvec2) { return dvec3(2 * kQuarter, 2 * kEighth, 2); });
}

TEST(VertexColors, WithoutAMaterialAreDecoded) {
    SceneText scene;
    scene.square("wall", 1.5);
    scene.nodes = "<node><instance_geometry url=\"#wall\"/></node>";
    add_vertex_colors(scene, "0.5 0.25 1");
    scene.light("sun", "<directional><color>1 1 1</color></directional>");
    expect_colors(Rendering(scene.text()).frame(),
                  [](dvec2) { return 0.8 * dvec3(kHalf, kQuarter, 1); });
}

TEST(VertexColors, ThatRslReadsAreAsWritten) {
    SceneText scene;
    scene.square("wall", 1.5).look("look", "surface s() { Oi = 1; Ci = Cs; }");
    scene.place("wall", "look");
    add_vertex_colors(scene, "0.5 0.25 2");
    // Another use of the mesh reads them decoded.
    scene.nodes += "<node><translate>0 0 -5</translate><instance_geometry url=\"#wall\"/></node>";
    expect_colors(Rendering(scene.text()).frame(), [](dvec2) { return dvec3(0.5, 0.25, 2); });
}

// --- transparency by default ---------------------------------------------------------------------

std::string see_through(const std::string& opaque, const std::string& color,
                        const std::string& transparency) {
    return fmt::format(
        "<lambert><emission><color>1 1 1 1</color></emission><transparent opaque=\"{}\"><color>{}"
        "</color></transparent><transparency><float>{}</float></transparency></lambert>",
        opaque, color, transparency);
}

double opacity(Rendering& r, double time = 0) {
    return r.frame(time).film.at(8, 8).w;
}

TEST(TransparencyAuto, WhatTheFormulaHidesEverywhereIsOpaque) {
    struct Row {
        const char *opaque, *color, *transparency;
    };
    for (const Row& row :
         {Row{"A_ONE", "1 1 1 1", "0"}, Row{"A_ONE", "1 1 1 0", "1"}, Row{"A_ZERO", "1 1 1 1", "1"},
          Row{"RGB_ZERO", "1 1 1 1", "1"}, Row{"RGB_ONE", "0 0 0 1", "1"},
          Row{"RGB_ONE", "1 1 1 1", "0"}, Row{"RGB_ZERO", "1 1 1 1", "0.9999"}}) {
        Rendering r(wall(see_through(row.opaque, row.color, row.transparency)).text());
        EXPECT_EQ(opacity(r), 1) << row.opaque << " " << row.transparency;
        EXPECT_EQ(r.count("FX_TRANSPARENT_ALL"), 1) << row.opaque << " " << row.transparency;
        EXPECT_TRUE(r.scene->shader_instances[0]->opaque()) << row.opaque;
    }
}

TEST(TransparencyAuto, GlassStaysGlass) {
    Rendering r(wall(see_through("RGB_ZERO", "1 1 1 1", "0.75")).text());
    EXPECT_NEAR(opacity(r), 0.25, 1e-6);
    EXPECT_EQ(r.count("FX_TRANSPARENT_ALL"), 0);
}

TEST(TransparencyAuto, NamesEachMaterial) {
    SceneText scene = wall(see_through("A_ONE", "1 1 1 1", "0"));
    scene.materials += "<material id=\"second\"><instance_effect url=\"#fx\"/></material>";
    scene.place("wall", "second", "<translate>0 0 -1</translate>");
    Rendering r(scene.text());
    EXPECT_EQ(r.count("FX_TRANSPARENT_ALL"), 2);
    EXPECT_NE(r.findings().find("material 'look'"), std::string::npos) << r.findings();
    EXPECT_NE(r.findings().find("material 'second'"), std::string::npos) << r.findings();
}

TEST(TransparencyAuto, WhatMovesIsNeverOverridden) {
    SceneText scene = wall(see_through("A_ONE", "1 1 1 1", "0"));
    scene.animate("fx/t/transparency", {0, 1}, {0, 1});
    Rendering r(scene.text());
    EXPECT_NEAR(opacity(r, 0.5), 0.5, 1e-6);
    EXPECT_EQ(opacity(r, 0), 0);
}

TEST(TransparencyAuto, AnotherMovingParameterIsNoTransparency) {
    SceneText scene = wall(
        "<lambert><emission><param ref=\"glow\"/></emission><transparency><param ref=\"hidden\"/>"
        "</transparency></lambert>",
        "<newparam sid=\"glow\"><float3>1 1 1</float3></newparam>"
        "<newparam sid=\"hidden\"><float>0</float></newparam>");
    scene.animate("fx/glow(0)", {0, 1}, {0, 1});
    Rendering r(scene.text());
    EXPECT_EQ(opacity(r), 1);
}

}  // namespace
}  // namespace kinora
