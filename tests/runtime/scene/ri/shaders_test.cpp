// tests/runtime/scene/ri/shaders_test.cpp: what shaders are given, and which one a name means.
#include "rib_scene.h"

namespace kinora::ri {
namespace {

// Clockwise as seen from the eye, from -1 to 1 at z = 3.
const std::string kSquare = "Polygon \"P\" [-1 -1 3 -1 1 3 1 1 3 1 -1 3] ";

class RiShaders : public testing::Test {
  protected:
    RiShaders() {
        folder_.file("show_p.sl", kShowP)
            .file("show_s_t.sl", kShowSt)
            .file("show_u_v.sl", kShowUv)
            .file("given.sl",
                  "surface given(color tint = color(.25, .5, .75); float weight = 1;"
                  " point spot = point \"shader\" (0, 0, 0); float list[2] = {0, 0};"
                  " string word = \"\"; vector way = 0; matrix frame = 1;)"
                  "{ Oi = 1; Ci = tint * weight;"
                  " if (word == \"spot\") { point p = transform(\"camera\", spot);"
                  "   Ci = 0.5 + 0.5 * color(xcomp(p), ycomp(p), zcomp(p)); }"
                  " if (word == \"list\") Ci = color(list[0], list[1], 0);"
                  " if (word == \"way\") { vector w = vtransform(\"camera\", way);"
                  "   Ci = 0.5 + 0.5 * color(xcomp(w), ycomp(w), zcomp(w)); } }")
            .file("plain.sl", "surface plain() { Oi = Os; Ci = Os * Cs; }")
            .file("varying_one.sl",
                  "surface varying_one(varying float heat = 0;) { Oi = 1; Ci = heat; }")
            .file("pull.sl",
                  "displacement pull(float far = 0;) { P += vtransform(\"shader\", \"current\","
                  " vector(far, 0, 0)); }");
    }
    RibPicture picture(const std::string& inside, const std::string& before = "") const {
        return RibPicture(kSmall + folder_.search() + before + "WorldBegin " + inside +
                          " WorldEnd");
    }
    dvec3 shown_at(const std::string& inside, int x = 8, int y = 7,
                   const std::string& before = "") const {
        RibPicture r = picture(inside, before);
        EXPECT_EQ(r.findings(), "") << inside;
        EXPECT_TRUE(r.covers(x, y)) << inside;
        return dvec3(vec3(r.at(x, y)));
    }

    RibFolder folder_;
};

TEST_F(RiShaders, UndeclaredParametersHaveTheShadersType) {
    expect_near(shown_at("Surface \"given\" \"tint\" [1 .5 .25] \"weight\" .5 " + kSquare),
                {.5, .25, .125});
    expect_near(shown_at("Surface \"given\" \"word\" \"list\" \"list\" [.25 .75] " + kSquare),
                {.25, .75, 0});
}

TEST_F(RiShaders, DeclaredAndInlineParameters) {
    expect_near(shown_at("Surface \"given\" \"uniform color tint\" [1 0 0] \"float weight\" [.5] " +
                         kSquare),
                {.5, 0, 0});
    expect_near(shown_at("Surface \"given\" \"tint\" [0 1 0] \"weight\" [.5] " + kSquare, 8, 7,
                         "Declare \"tint\" \"color\" Declare \"weight\" \"uniform float\" "),
                {0, .5, 0});
}

TEST_F(RiShaders, UnknownParametersAreLeftOut) {
    RibPicture r = picture("Surface \"given\" \"colour\" [1 1 1] \"weight\" 0.5 " + kSquare);
    EXPECT_EQ(r.count("RI_TOKEN_UNKNOWN") + r.count("RIB_TOKEN_UNKNOWN"), 1) << r.findings();
    r.expect(8, 7, {.125, .25, .375});
}

// Points and vectors of a list are in the system at its request.
TEST_F(RiShaders, PointsAreInTheSpaceOfTheirRequest) {
    const std::string spot = "Surface \"given\" \"word\" \"spot\" \"spot\" [1 0 0] ";
    expect_near(shown_at("Translate 0 .5 0 Scale .5 .5 1 " + spot + "Identity " + kSquare),
                shown({.5, .5, 0}));
    expect_near(shown_at("Translate 0 .5 0 " + spot + kSquare, 8, 7, "Rotate 90 0 0 1 "),
                shown({-.5, 1, 0}));
    expect_near(
        shown_at("Translate 0 .5 0 Scale .5 .5 1 Surface \"given\" \"word\" \"way\" \"way\" "
                 "[1 0 0] Identity " +
                 kSquare),
        shown({.5, 0, 0}));
    // The default, of shader space.
    expect_near(
        shown_at("Translate .25 .5 .75 Surface \"given\" \"word\" \"spot\" Identity " + kSquare),
        shown({.25, .5, .75}));
}

TEST_F(RiShaders, PrimitiveVariablesOverrideParameters) {
    expect_near(
        shown_at("Surface \"given\" \"tint\" [1 0 0] Polygon \"P\" [-1 -1 3 -1 1 3 1 1 3 1 -1 "
                 "3] \"uniform color tint\" [0 1 0]"),
        {0, 1, 0});
    expect_near(shown_at("Surface \"given\" \"tint\" [1 0 0] Translate 0 0 3 Sphere 1 -1 1 360 "
                         "\"constant color tint\" [0 1 0]"),
                {0, 1, 0});
    // At (8, 7) x = y = 1/16: a part of 17/32 along x.
    expect_near(
        shown_at("Surface \"varying_one\" Polygon \"P\" [-1 -1 3 -1 1 3 1 1 3 1 -1 3] \"varying "
                 "float heat\" [0 0 1 1]"),
        dvec3(17 / 32.));
}

TEST_F(RiShaders, ShaderSpaceIsThatOfTheRequest) {
    // At (12, 3): (.5625, .5625, 3) in camera space.
    expect_near(shown_at("Surface \"show_p\" " + kSquare, 12, 3), shown({.5625, .5625, 3}));
    expect_near(shown_at("Translate .5 0 0 Surface \"show_p\" Identity " + kSquare, 12, 3),
                shown({.0625, .5625, 3}));
    expect_near(shown_at("Surface \"show_p\" Translate .5 0 1 Scale .5 1 1 " + kSquare, 12, 3),
                shown({.5625, .5625, 4}));
    expect_near(
        shown_at(
            "Translate .5 0 0 Surface \"show_p\" \"space\" \"object\" Translate 0 0 1 " + kSquare,
            12, 3),
        shown({.0625, .5625, 3}));
    expect_near(shown_at("Translate .5 0 0 Surface \"show_p\" \"space\" \"world\" " + kSquare, 12,
                         3, "Translate 0 0 1 "),
                shown({.5625, .5625, 3}));
    expect_near(shown_at("Translate .5 0 0 Surface \"show_p\" \"space\" \"camera\" " + kSquare, 12,
                         3, "Translate 0 0 1 "),
                shown({.5625, .5625, 4}));
    expect_near(
        shown_at("TransformBegin Translate .5 0 0 CoordinateSystem \"mine\" TransformEnd Surface "
                 "\"show_p\" \"space\" \"mine\" " +
                     kSquare,
                 12, 3),
        shown({.0625, .5625, 3}));
}

TEST_F(RiShaders, ShaderSpaceBeforeTheWorldIsTheCamerasThen) {
    expect_near(shown_at("Identity " + kSquare, 12, 3,
                         "Translate .5 0 0 Surface \"show_p\" Identity "
                         "Translate 0 0 1 "),
                shown({.0625, .5625, 4}));
}

// One material's surface may be bound where a primitive stands, and its displacement where another
// stands.
TEST_F(RiShaders, EachShaderOfAPrimitiveHasItsOwnSpace) {
    const std::string thin = "Polygon \"P\" [-.25 -1 3 -.25 1 3 .25 1 3 .25 -1 3] ";
    RibWorlds r(folder_.search() +
                "WorldBegin TransformBegin Translate -.5 0 0 Surface \"show_p\" TransformEnd "
                "TransformBegin Translate .5 0 0 Displacement \"pull\" TransformEnd "
                "TransformBegin Translate -.5 0 0 " +
                thin +
                "TransformEnd "
                "TransformBegin Translate .5 0 0 " +
                thin + "TransformEnd WorldEnd");
    ASSERT_EQ(r.primitives().size(), 2u);
    const MaterialDefinition &left = *r.primitive(0).material, &right = *r.primitive(1).material;
    EXPECT_EQ(left.surfaces[0].space, "");
    EXPECT_NE(left.displacements[0].space, "");
    EXPECT_NE(right.surfaces[0].space, "");
    EXPECT_EQ(right.displacements[0].space, "");
}

TEST_F(RiShaders, NamesMayHavePathsSuffixesAndOtherCase) {
    for (const char* name : {"plain.sl", "plain.slo", "plain.sdl", "plain.slx", "some/where/plain",
                             "C:\\shaders\\plain", "PLAIN", "Plain.slc"}) {
        if (std::string_view(name) == "Plain.slc") continue;
        expect_near(
            shown_at(
                std::string("Color .25 .5 1 Surface \"") +
                (std::string_view(name) == "C:\\shaders\\plain" ? "C:\\\\shaders\\\\plain" : name) +
                "\" " + kSquare),
            {.25, .5, 1});
    }
    folder_.file("deep/other.sl", "surface other() { Oi = 1; Ci = color(0, 0, 1); }");
    expect_near(shown_at("Surface \"deep/other\" " + kSquare), {0, 0, 1});
    expect_near(shown_at("Surface \"" + folder_.path() + "/deep/other\" " + kSquare), {0, 0, 1});
}

TEST_F(RiShaders, SearchPathsAreTriedInTheirOrder) {
    folder_.file("a/which.sl", "surface which() { Oi = 1; Ci = color(1, 0, 0); }")
        .file("b/which.sl", "surface which() { Oi = 1; Ci = color(0, 1, 0); }");
    const std::string f = folder_.path();
    auto at = [&](const std::string& option) {
        RibPicture r(kSmall + option + " WorldBegin Surface \"which\" " + kSquare + "WorldEnd");
        return dvec3(vec3(r.at(8, 7)));
    };
    expect_near(at("Option \"searchpath\" \"shader\" [\"" + f + "/a:" + f + "/b\"]"), {1, 0, 0});
    expect_near(at("Option \"searchpath\" \"string shader\" \"" + f + "/b:" + f + "/a\""),
                {0, 1, 0});
    expect_near(at("Option \"searchpath\" \"shader\" [\"" + f +
                   "/a\"] Option \"searchpath\" \"shader\" "
                   "[\"" +
                   f + "/b:&\"]"),
                {0, 1, 0});
    expect_near(at("Option \"searchpath\" \"shader\" [\"" + f +
                   "/a\"] Option \"searchpath\" \"shader\" "
                   "[\"@:&:" +
                   f + "/b\"]"),
                {1, 0, 0});
}

TEST_F(RiShaders, RelativeSearchPathsBeginAtTheFile) {
    folder_.file("sub/here.sl", "surface here() { Oi = 1; Ci = color(0, 1, 1); }");
    RibPicture r(kSmall +
                     "Option \"searchpath\" \"shader\" [\"sub\"] WorldBegin Surface \"here\" " +
                     kSquare + "WorldEnd",
                 folder_.path() + "/x.rib");
    r.expect(8, 7, {0, 1, 1});
}

// (Ka + Kd (I.N)^2) Cs of the default surface is Cs where it is seen straight on.
TEST_F(RiShaders, UnknownSurfacesAreTheDefaultOne) {
    RibPicture r = picture(
        "Color 1 .5 0 Surface \"nowhere_at_all\" \"Kd\" 1 Surface \"nowhere_at_all\" " + kSquare);
    EXPECT_EQ(r.count("RI_SHADER_UNKNOWN"), 1) << r.findings();
    r.expect(8, 7, {1, .5, 0});
    RibPicture none = picture("Color 1 .5 0 " + kSquare);
    none.expect(8, 7, {1, .5, 0});
    EXPECT_EQ(none.findings(), "");
}

TEST_F(RiShaders, UnknownDisplacementsAndVolumesAreNone) {
    RibPicture r = picture(
        "Surface \"plain\" Displacement \"nowhere\" Atmosphere \"nowhere\" Interior "
        "\"nowhere\" " +
            kSquare,
        "Imager \"nowhere\" ");
    EXPECT_EQ(r.count("RI_SHADER_UNKNOWN"), 4) << r.findings();
    r.expect(8, 7, {1, 1, 1});
}

// The compiler says where the error is, and this what follows from it: each once.
TEST_F(RiShaders, WhatDoesNotCompileIsNotCalledUnknown) {
    folder_.file("broken.sl", "surface broken() { Ci = ; }");
    RibWorlds r(folder_.search() + "WorldBegin Surface \"broken\" Surface \"broken\" " + kSquare +
                "LightSource \"broken\" 1 Shader \"broken\" \"base\" WorldEnd");
    EXPECT_EQ(r.count("RI_SHADER_UNKNOWN"), 0) << r.findings();
    EXPECT_EQ(r.count("RI_SHADER_REFUSED"), 3) << r.findings();
    EXPECT_EQ(r.count("RSL_SYNTAX"), 1) << r.findings();
    EXPECT_NE(r.findings().find("broken.sl' does not compile; the default surface stands for it"),
              std::string::npos)
        << r.findings();
    EXPECT_EQ(r.primitives().size(), 1u);
}

TEST_F(RiShaders, ShadersOfAnotherKindSayWhichTheyAre) {
    RibPicture r = picture("Color 1 .5 0 Surface \"pull\" LightSource \"plain\" 1 " + kSquare);
    EXPECT_EQ(r.count("RI_SHADER_UNKNOWN"), 0) << r.findings();
    EXPECT_EQ(r.count("RI_SHADER_REFUSED"), 2) << r.findings();
    EXPECT_NE(r.findings().find("it is a displacement shader"), std::string::npos) << r.findings();
    r.expect(8, 7, {1, .5, 0});
}

// It is there, and has no light of its own.
TEST_F(RiShaders, NullSurfacesAreBlack) {
    RibPicture r = picture("Surface \"null\" " + kSquare);
    r.expect(8, 7, {0, 0, 0});
    EXPECT_EQ(r.findings(), "");
}

// Of half opacity, over the one behind it: .5 red + .5 green.
TEST_F(RiShaders, ColourAndOpacity) {
    RibPicture r = picture("Surface \"plain\" Color 1 0 0 Opacity .5 .5 .5 " + kSquare +
                           "Translate 0 0 1 Color 0 1 0 Opacity 1 1 1 Scale .5 .5 1 " + kSquare);
    r.expect(8, 7, {.5, .5, 0});
    r.expect(1, 1, {.5, 0, 0});
    EXPECT_NEAR(r.at(1, 1).w, .5, 1e-5);
    EXPECT_NEAR(r.at(8, 7).w, 1, 1e-5);
}

TEST_F(RiShaders, ColoursOfVariables) {
    // A part of 17/32 from the left (red) to the right (green).
    expect_near(
        shown_at("Surface \"plain\" Color 0 0 1 Polygon \"P\" [-1 -1 3 -1 1 3 1 1 3 1 -1 3] "
                 "\"Cs\" [1 0 0 1 0 0 0 1 0 0 1 0]"),
        {15 / 32., 17 / 32., 0});
    expect_near(
        shown_at("Surface \"plain\" Color 0 0 1 Patch \"bilinear\" \"P\" [-1 -1 3 1 -1 3 -1 1 3 1 "
                 "1 3] \"Cs\" [1 0 0 0 1 0 1 0 0 0 1 0]"),
        {15 / 32., 17 / 32., 0});
    RibPicture clear = picture(
        "Surface \"plain\" Polygon \"P\" [-1 -1 3 -1 1 3 1 1 3 1 -1 3] \"Os\" [0 0 0 "
        "0 0 0 1 1 1 1 1 1]");
    EXPECT_NEAR(clear.at(8, 7).w, 17 / 32., 1e-5);
    expect_near(
        shown_at(
            "Surface \"plain\" PointsPolygons [4 4] [0 1 2 3 3 2 4 5] \"P\" [-1 -1 3 -1 1 3 0 1 "
            "3 0 -1 3 1 1 3 1 -1 3] \"uniform color Cs\" [1 0 0 0 0 1]"),
        {0, 0, 1});
}

TEST_F(RiShaders, OfOtherColorSamplesAreMadeRgb) {
    // Two numbers: the first is red, the second half of green and of blue.
    RibWorlds r(
        "ColorSamples [1 0 0 0 .5 .5] [1 0 0 1 0 0] Color [.5 1] WorldBegin Sphere 1 -1 1 360 "
        "WorldEnd");
    EXPECT_EQ(color_of(r.world(), r.primitive()), dvec3(.5, .5, .5));
    RibWorlds one(
        "ColorSamples [.25 .5 1] [1 1 1] WorldBegin Color [1] Sphere 1 -1 1 360 WorldEnd");
    EXPECT_EQ(color_of(one.world(), one.primitive()), dvec3(.25, .5, 1));
}

// x, y of object space.
TEST_F(RiShaders, TextureCoordinatesOfPolygons) {
    const std::string big = "Polygon \"P\" [0 0 3 0 2 3 2 2 3 2 0 3] ";
    // (8, 7) is (1.0625, 1.0625) from the corner at -1, and 17/32 of the way.
    expect_near(shown_at("Surface \"show_s_t\" Translate -1 -1 0 " + big), {1.0625, 1.0625, 0});
    expect_near(
        shown_at("TextureCoordinates 5 5 6 6 7 7 8 8 Surface \"show_s_t\" Translate -1 -1 0 " +
                 big),
        {1.0625, 1.0625, 0});
    expect_near(
        shown_at("Surface \"show_s_t\" Translate -1 -1 0 Polygon \"P\" [0 0 3 0 2 3 2 2 3 2 0 3] "
                 "\"st\" [0 0 0 .5 1 .5 1 0]"),
        {17 / 32., 17 / 64., 0});
    expect_near(
        shown_at("Surface \"show_s_t\" Translate -1 -1 0 Polygon \"P\" [0 0 3 0 2 3 2 2 3 2 0 3] "
                 "\"s\" [0 0 1 1] \"t\" [0 .5 .5 0]"),
        {17 / 32., 17 / 64., 0});
}

TEST_F(RiShaders, TextureCoordinatesOfPatches) {
    const std::string patch = "Patch \"bilinear\" \"P\" [-1 -1 3 1 -1 3 -1 1 3 1 1 3] ";
    const double part = 17 / 32.;
    expect_near(shown_at("Surface \"show_s_t\" " + patch), {part, part, 0});
    expect_near(shown_at("Surface \"show_u_v\" TextureCoordinates 1 0 0 0 1 1 0 1 " + patch),
                {part, part, 0});
    expect_near(shown_at("Surface \"show_s_t\" TextureCoordinates 1 0 0 0 1 .5 0 .5 " + patch),
                {1 - part, part / 2, 0});
    expect_near(shown_at("Surface \"show_s_t\" " + patch + "\"st\" [0 0 .5 0 0 1 .5 1]"),
                {part / 2, part, 0});
    expect_near(shown_at("Surface \"show_s_t\" " + patch + "\"s\" [0 .5 0 .5] \"t\" [1 1 0 0]"),
                {part / 2, 1 - part, 0});
    // One of both alone: the other is the surface's own.
    expect_near(shown_at("Surface \"show_s_t\" " + patch + "\"t\" [1 1 0 0]"), {part, 1 - part, 0});
}

// 4 by 4 bilinear patches: u, v and s, t go over the whole.
TEST_F(RiShaders, ParametersOfMeshesGoOverTheWhole) {
    std::string points;
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 5; ++x) points += fmt::format("{} {} 3 ", x * .5 - 1, y * .5 - 1);
    const std::string mesh =
        "PatchMesh \"bilinear\" 5 \"nonperiodic\" 5 \"nonperiodic\" \"P\" [" + points + "]";
    expect_near(shown_at("Surface \"show_u_v\" " + mesh), {17 / 32., 17 / 32., 0});
    expect_near(shown_at("Surface \"show_s_t\" " + mesh, 2, 2), {5 / 32., 27 / 32., 0});
}

// Half of the way into a fog of distance 1 / ln 2 the surface is half the fog's; nothing else is.
TEST_F(RiShaders, AnAtmosphereLeavesTheBackgroundAsItIs) {
    RibPicture r(kSmall +
                 "WorldBegin Surface \"constant\" Color 1 0 0 Atmosphere \"fog\" \"distance\" "
                 "1.442695 \"background\" [0 0 1] Translate 0 0 1 Disk 0 .5 360 WorldEnd");
    r.expect(8, 8, {0.5, 0, 0.5}, 1e-3);
    r.expect(0, 0, {0, 0, 0});
    EXPECT_FALSE(r.covers(0, 0)) << r.findings();
}

}  // namespace
}  // namespace kinora::ri
