// tests/runtime/player/co_shaders_test.cpp: shaders with co-shaders, edited while they are shown.
#include <cmath>

#include "runtime/player/scene_maker.h"
#include "tests/runtime/player/played.h"

namespace kinora {
namespace {

constexpr const char* kSquare = R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><created>2026-01-01T00:00:00Z</created><modified>2026-01-01T00:00:00Z</modified></asset>
<library_cameras><camera id="c"><optics><technique_common><orthographic><xmag>1</xmag><ymag>1</ymag>
<znear>0.1</znear><zfar>100</zfar></orthographic></technique_common></optics></camera></library_cameras>
<library_effects>%EFFECTS%</library_effects>
<library_materials><material id="m"><instance_effect url="#fx"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="12">-1 -1 0 1 -1 0 1 1 0 -1 1 0</float_array><technique_common>
<accessor source="#pa" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<source id="u"><float_array id="ua" count="8">0 0 1 0 1 1 0 1</float_array><technique_common>
<accessor source="#ua" count="4" stride="2"><param name="S" type="float"/><param name="T" type="float"/></accessor>
</technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles material="skin" count="2"><input semantic="VERTEX" source="#v" offset="0"/>
<input semantic="TEXCOORD" source="#u" offset="0" set="0"/><p>0 1 2 0 2 3</p></triangles></mesh></geometry>
</library_geometries>
<library_visual_scenes><visual_scene id="scene">
<node id="eye"><translate>0 0 10</translate><instance_camera url="#c"/></node>
<node id="n"><instance_geometry url="#g"><bind_material><technique_common>
<instance_material symbol="skin" target="#m"/></technique_common></bind_material></instance_geometry></node>
%EXTRA%</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>
)";
const std::string kSurface =
    "class layered(shader base = null; shader coat = null;) {\n"
    "    public void surface(output color Ci, Oi) {\n"
    "        color c = 0;\n        base->tint(c);\n        coat->tint(c);\n"
    "        Ci = c;\n        Oi = 1;\n    }\n}\n";
const std::string kCoShaders =
    "class clay(float gain = 0.75;) { public void tint(output color c) {\n"
    "    c = gain * color(s, t, 0.25);\n} }\n"
    "class wash() { public void tint(output color c) { c = mix(c, color(0, 0, 1), 0.25); } }\n";
constexpr const char* kPass =
    "<shader stage=\"SURFACE\"><name>layered</name>"
    "<bind symbol=\"base\"><string>clay</string></bind>"
    "<bind symbol=\"coat\"><string>wash</string></bind></shader>";
constexpr const char* kCoPass =
    "<shader stage=\"COSHADER\" handle=\"clay\"><name>clay</name></shader>"
    "<shader stage=\"COSHADER\" handle=\"wash\"><name>wash</name></shader>";

std::string effect_of(const std::string& id, const std::string& code, const std::string& pass) {
    return "<effect id=\"" + id + "\"><profile_RSL><technique sid=\"t\"><code><![CDATA[" + code +
           "]]></code><pass>" + pass + "</pass></technique></profile_RSL></effect>";
}

std::string with(std::string text, const std::string& from, const std::string& to) {
    size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

std::string square_of(const std::string& effects, const std::string& extra = "") {
    return with(with(kSquare, "%EFFECTS%", effects), "%EXTRA%", extra);
}

std::vector<uint8_t> shown(Player& player) {
    EXPECT_TRUE(player.wait_idle(kLong));
    return player.picture()->rgba;
}

std::vector<uint8_t> shown_of(const std::string& document) {
    std::string file = testing::TempDir() + "kinora_play_co_shaders_expected.dae";
    write(file, document);
    Played played(small_request(file));
    return shown(played.player);
}

// The co-shaders' text is the effect's own: it is edited with the surface's.
TEST(CoShaderEdits, OfACoShaderSwapTheKernelThatCallsIt) {
    auto document = [](const std::string& co_shaders) {
        return square_of(effect_of("fx", kSurface + co_shaders, std::string(kPass) + kCoPass));
    };
    std::string file = testing::TempDir() + "kinora_play_co_shaders.dae";
    write(file, document(kCoShaders));
    Played played(small_request(file));
    Player& player = played.player;
    std::vector<uint8_t> before = shown(player);
    EXPECT_EQ(played.script("select_material m; edit; find \"gain * color\"; type \"0.5 * \""), "");
    std::vector<uint8_t> edited = shown(player);
    EXPECT_EQ(player.shader().shown, player.shader().version);
    EXPECT_NE(edited, before);
    EXPECT_EQ(player.made().scenes, 1u);  // a kernel in a scene that stands
    EXPECT_EQ(player.made().kernels, 1u);
    EXPECT_EQ(edited, shown_of(document(with(kCoShaders, "gain * color", "0.5 * gain * color"))));

    // An error in a co-shader leaves the last good one, and has its place.
    EXPECT_EQ(played.script("type \"x(\""), "");
    EXPECT_EQ(shown(player), edited);
    EXPECT_FALSE(player.shader().findings.empty());
    EXPECT_EQ(played.script("undo"), "");  // both typed words were one change
    EXPECT_EQ(shown(player), before);
    EXPECT_TRUE(player.shader().findings.empty());

    EXPECT_EQ(played.script("find \"gain * color\"; type \"0.5 * \"; wait refined; save"), "");
    EXPECT_EQ(text_of(file), document(with(kCoShaders, "gain * color", "0.5 * gain * color")));
}

// A method that a co-shader no longer has: the call does nothing, and the picture says so.
TEST(CoShaderEdits, AMethodThatIsRenamedIsNoLongerCalled) {
    std::string code = kSurface + kCoShaders;
    auto document = [](const std::string& text) {
        return square_of(effect_of("fx", text, std::string(kPass) + kCoPass));
    };
    std::string file = testing::TempDir() + "kinora_play_co_shaders_renamed.dae";
    write(file, document(code));
    Played played(small_request(file));
    std::string renamed = with(code, "wash() { public void tint", "wash() { public void shade");
    EXPECT_EQ(played.script("select_material m; edit"), "");
    ASSERT_TRUE(played.player.run("set_text", {renamed}).done);
    EXPECT_EQ(shown(played.player), shown_of(document(renamed)));
    EXPECT_NE(shown(played.player), shown_of(document(code)));
}

// The surface's text is edited where its co-shaders stand in a library of the scene.
TEST(CoShaderEdits, OfTheSurfaceKeepTheLibrarysCoShaders) {
    auto document = [](const std::string& surface) {
        return square_of(effect_of("fx", surface, kPass) + effect_of("lib", kCoShaders, kCoPass),
                         "<extra><technique profile=\"RSL\"><instance_effect "
                         "url=\"#lib\"/></technique></extra>");
    };
    std::string file = testing::TempDir() + "kinora_play_co_shaders_library.dae";
    write(file, document(kSurface));
    Played played(small_request(file));
    std::vector<uint8_t> before = shown(played.player);
    EXPECT_EQ(played.script("select_material m; edit"), "");
    ASSERT_TRUE(played.player.run("find", {"= c;"}).done);
    ASSERT_TRUE(played.player.run("type", {"= 0.5 * c; //"}).done);
    std::vector<uint8_t> edited = shown(played.player);
    EXPECT_NE(edited, before);
    EXPECT_EQ(edited, shown_of(document(with(kSurface, "Ci = c;", "Ci = 0.5 * c;"))));
}

// A class that displaces: its picture shows how high the square lies, in units of the scene.
constexpr const char* kLifts =
    "class lift(float amount = 0.5;) {\n"
    "    public void displacement(output point P; output normal N) {\n"
    "        P += amount * normalize(N);\n        N = calculatenormal(P);\n    }\n}\n"
    "class height() { public void surface(output color Ci, Oi) {\n"
    "    extern point P;\n    Ci = zcomp(transform(\"world\", P));\n    Oi = 1;\n} }\n";
constexpr const char* kLiftPass =
    "<shader stage=\"DISPLACEMENT\"><name>lift</name></shader>"
    "<shader stage=\"SURFACE\"><name>height</name></shader>";

int middle(Player& player) {
    const std::vector<uint8_t> rgba = shown(player);
    return rgba.empty() ? -1 : rgba[4 * (64 * 18 + 32)];
}

// As sRGB has it, IEC 61966-2-1.
int byte_of(double linear) {
    return int(std::lround(255 * (1.055 * std::pow(linear, 1 / 2.4) - 0.055)));
}

TEST(ClassEdits, OfADisplacementMoveTheMesh) {
    auto document = [](const std::string& code) {
        return square_of(effect_of("fx", code, kLiftPass));
    };
    std::string file = testing::TempDir() + "kinora_play_lift.dae";
    write(file, document(kLifts));
    Played played(small_request(file));
    Player& player = played.player;
    EXPECT_EQ(middle(player), byte_of(0.5));
    EXPECT_EQ(played.script("select_material m:displacement; edit; find \"amount * n\"; "
                            "type \"0.5 * \""),
              "");
    EXPECT_EQ(middle(player), byte_of(0.25));
    EXPECT_EQ(player.shader().shown, player.shader().version);
    EXPECT_EQ(shown(player), shown_of(document(with(kLifts, "amount * n", "0.5 * amount * n"))));
    EXPECT_EQ(played.script("param amount 1.5"), "");
    EXPECT_EQ(middle(player), byte_of(0.75));

    // An error leaves the mesh where the last good text has it.
    EXPECT_EQ(played.script("type \"x(\""), "");
    EXPECT_EQ(middle(player), byte_of(0.75));
    EXPECT_FALSE(player.shader().findings.empty());
    EXPECT_EQ(played.script("undo; undo; undo"), "");
    EXPECT_EQ(middle(player), byte_of(0.5));

    // The surface beside it is edited in the same text.
    EXPECT_EQ(played.script("select_material m; edit; find \"zcomp\"; type \"0.5 * \"; "
                            "wait refined; save"),
              "");
    EXPECT_EQ(middle(player), byte_of(0.25));
    EXPECT_EQ(text_of(file), document(with(kLifts, "zcomp", "0.5 * zcomp")));
}

}  // namespace
}  // namespace kinora
