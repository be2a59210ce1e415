// tests/runtime/meshes_test.cpp: meshes that are flat, units and axes inside a
// document, materials that nothing names, morphs and skeletons in unusual places.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "expect_colors.h"
#include "runtime/scene/values.h"
#include "runtime/scene/vertices/deform.h"

namespace kinora {
namespace {

const double kHalf = std::sqrt(0.5);

void expect_near(dvec3 got, dvec3 want) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(got[k], want[k], 1e-6) << "component " << k;
}

std::string show(const std::string& vector) {
    return fmt::format("surface s() {{ Oi = 1; Ci = color(xcomp({0}), ycomp({0}), zcomp({0})); }}",
                       vector);
}
const std::string kWorldN = "ntransform(\"world\", N)";

// Two faces that meet at 45 degrees over x = 0, wider than the picture.
const std::vector<dvec3> kRoof{{-2, -2, 0}, {0, -2, 2}, {0, 2, 2},
                               {-2, 2, 0},  {2, -2, 0}, {2, 2, 0}};
const std::vector<int> kRoofTriangles{0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 2};
dvec3 roof_normal(dvec2 p) {
    return p.x < 0 ? dvec3(-kHalf, 0, kHalf) : dvec3(kHalf, 0, kHalf);
}

SceneText roof(const std::string& code) {
    SceneText scene;
    return scene.mesh("roof", kRoof, kRoofTriangles).look("look", code);
}

TEST(FlatMesh, NIsThatOfEachFace) {
    SceneText scene = roof(show(kWorldN)).place("roof", "look");
    expect_colors(Rendering(scene.text()).frame(), roof_normal);
}

TEST(FlatMesh, NoVertexIsSplitForIt) {
    SceneText scene = roof(show(kWorldN)).place("roof", "look");
    Rendering r(scene.text());
    ASSERT_TRUE(r.scene) << r.findings();
    EXPECT_EQ(r.scene->meshes[0].positions.size(), kRoof.size());
    EXPECT_TRUE(r.scene->meshes[0].normals.empty());
    EXPECT_TRUE(r.scene->meshes[0].groups[0].flat());
}

TEST(FlatMesh, NDoesNotChangeWithinAFace) {
    SceneText scene = roof(show("Du(N) + Dv(N) + vector(0.5, 0.25, 0.125)")).place("roof", "look");
    expect_colors(Rendering(scene.text()).frame(), [](dvec2) { return dvec3(0.5, 0.25, 0.125); });
}

TEST(FlatMesh, MirrorsAndScalesTurnItAsTheFacesTurn) {
    // The roof at a third of its height, as the mirror image of itself, still and instanced.
    const double c = 1 / std::sqrt(10.0);
    for (bool moves : {false, true}) {
        SceneText scene = roof(show(kWorldN));
        scene.place("roof", "look", "<scale sid=\"s\">-1 1 0.333333333333</scale>", "n");
        if (moves) scene.animate("n/s.X", {0, 1}, {-1, -2});
        expect_colors(Rendering(scene.text()).frame(),
                      [&](dvec2 p) { return p.x < 0 ? dvec3(-c, 0, 3 * c) : dvec3(c, 0, 3 * c); });
    }
}

// A <source> of names or numbers.
std::string source(const std::string& id, const std::string& values, size_t count,
                   const std::string& params, const char* array, const char* type) {
    std::string list;
    for (char p : params) list += fmt::format("<param name=\"{}\" type=\"{}\"/>", p, type);
    return fmt::format(
        "<source id=\"{0}\"><{1} id=\"{0}-a\" count=\"{2}\">{3}</{1}><technique_common><accessor "
        "source=\"#{0}-a\" count=\"{4}\" stride=\"{5}\">{6}</accessor></technique_common></source>",
        id, array, count * params.size(), values, count, params.size(), list);
}

std::string morph(const std::string& id, const std::string& base, const std::string& method,
                  const std::string& targets, const std::vector<double>& weights) {
    return fmt::format(
        "<controller id=\"{0}\"><morph source=\"#{1}\" method=\"{2}\">{3}{4}<targets><input "
        "semantic=\"MORPH_TARGET\" source=\"#{0}-t\"/><input semantic=\"MORPH_WEIGHT\" "
        "source=\"#{0}-w\"/></targets></morph></controller>",
        id, base, method, source(id + "-t", targets, weights.size(), "T", "IDREF_array", "IDREF"),
        source(id + "-w", numbers(weights), weights.size(), "W", "float_array", "float"));
}

// Everything on one joint, "bone", bound at the origin.
std::string skin(const std::string& id, const std::string& base, size_t vertices) {
    std::string vcount, v;
    for (size_t i = 0; i < vertices; ++i) vcount += "1 ", v += "0 0 ";
    return fmt::format(
        "<controller id=\"{0}\"><skin source=\"#{1}\"><bind_shape_matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 "
        "0 0 1</bind_shape_matrix>{2}{3}{4}<joints><input semantic=\"JOINT\" source=\"#{0}-j\"/>"
        "<input semantic=\"INV_BIND_MATRIX\" source=\"#{0}-b\"/></joints><vertex_weights "
        "count=\"{5}\"><input semantic=\"JOINT\" source=\"#{0}-j\" offset=\"0\"/><input "
        "semantic=\"WEIGHT\" source=\"#{0}-w\" offset=\"1\"/><vcount>{6}</vcount><v>{7}</v>"
        "</vertex_weights></skin></controller>",
        id, base, source(id + "-j", "bone", 1, "J", "Name_array", "name"),
        fmt::format(
            "<source id=\"{0}-b\"><float_array id=\"{0}-ba\" count=\"16\">1 0 0 0 0 1 0 0 0 "
            "0 1 0 0 0 0 1</float_array><technique_common><accessor source=\"#{0}-ba\" "
            "count=\"1\" stride=\"16\"><param name=\"T\" type=\"float4x4\"/></accessor>"
            "</technique_common></source>",
            id),
        source(id + "-w", "1", 1, "W", "float_array", "float"), vertices, vcount, v);
}

std::string controlled(const std::string& url, const std::string& inside = "") {
    return fmt::format(
        "<node><instance_controller url=\"#{}\">{}<bind_material><technique_common>"
        "<instance_material symbol=\"skin\" target=\"#look\"/></technique_common></bind_material>"
        "</instance_controller></node>",
        url, inside);
}

const std::string kBone =
    "<node id=\"bone\" sid=\"bone\" type=\"JOINT\"><translate>0 0 -1</translate>"
    "<rotate>0 0 1 90</rotate></node>";

TEST(FlatMesh, MorphsAndSkinsLeaveItFlat) {
    // Half way to a roof of no height its sides rise at 1 in 2; the joint then turns it by 90.
    SceneText scene = roof(show(kWorldN));
    std::vector<dvec3> low = kRoof;
    for (dvec3& p : low) p.z = 0;
    scene.mesh("low", low, kRoofTriangles);
    scene.controllers = morph("m", "roof", "NORMALIZED", "low", {0.5}) + skin("s", "m", 6);
    scene.nodes += kBone + controlled("s", "<skeleton>#bone</skeleton>");
    const double c = 1 / std::sqrt(5.0);
    expect_colors(Rendering(scene.text()).frame(),
                  [&](dvec2 p) { return p.y < 0 ? dvec3(0, -c, 2 * c) : dvec3(0, c, 2 * c); });
}

const std::string kBoth = "<shader stage=\"SURFACE\"/><shader stage=\"DISPLACEMENT\"/>";

TEST(FlatMesh, DisplacedAlikeEverywhereItKeepsItsFaces) {
    SceneText scene;
    scene.mesh("roof", kRoof, kRoofTriangles)
        .look("look", show(kWorldN) + "\ndisplacement d() { P += vector \"object\" (0, 0, 0.5); }",
              kBoth)
        .place("roof", "look");
    SceneOptions options;
    options.quality.dice = 1;
    options.width = options.height = 32;
    Rendering r(scene.text(), options);
    ASSERT_TRUE(r.scene) << r.findings();
    EXPECT_GT(r.scene->dice.triangles, 8u);
    expect_colors(r.frame(), roof_normal, 1e-5);
}

TEST(FlatMesh, DisplacedAfterMorphAndSkinItHasTheFacesOfNow) {
    for (bool skinned : {false, true}) {
        SceneText scene;
        scene.mesh("roof", kRoof, kRoofTriangles)
            .look("look",
                  show(kWorldN) + "\ndisplacement d() { P += vector \"object\" (0, 0, 0.5); }",
                  kBoth);
        std::vector<dvec3> low = kRoof;
        for (dvec3& p : low) p.z = 0;
        scene.mesh("low", low, kRoofTriangles);
        scene.controllers = morph("m", "roof", "NORMALIZED", "low", {0.5}) + skin("s", "m", 6);
        if (skinned)
            scene.nodes += kBone + controlled("s", "<skeleton>#bone</skeleton>");
        else
            scene.nodes += controlled("m");
        SceneOptions options;
        options.quality.dice = 1;
        options.width = options.height = 32;
        const double c = 1 / std::sqrt(5.0);
        expect_colors(
            Rendering(scene.text(), options).frame(),
            [&](dvec2 p) {
                double side = (skinned ? p.y : p.x) < 0 ? -c : c;
                return skinned ? dvec3(0, side, 2 * c) : dvec3(side, 0, 2 * c);
            },
            1e-5);
    }
}

// N in a displacement is the face's: both sides rise by 0.1 along their own.
TEST(FlatMesh, DisplacementsMoveAlongTheFacesNormals) {
    SceneText scene;
    scene.mesh("roof", kRoof, kRoofTriangles)
        .look("look",
              "surface s() { Oi = 1; Ci = zcomp(transform(\"world\", P)); }"
              "displacement d() { P += 0.1 * N; }",
              kBoth)
        .place("roof", "look");
    SceneOptions options;
    options.quality.dice = 1;
    options.width = options.height = 32;
    Rendering r(scene.text(), options);
    r.frame();
    for (int x : {2, 13}) {
        double z = 2 - std::abs(r.place(x, 8).x) + 0.1 / kHalf;
        EXPECT_NEAR(r.color(x, 8).x, z, 1e-4) << x << "\n" << r.findings();
    }
}

// What displacement makes of one face is smooth: a wave's slope, not that of its small triangles.
TEST(FlatMesh, DisplacementIsSmoothWithinAFace) {
    SceneText scene;
    scene.mesh("floor", {{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}, {0, 1, 2, 0, 2, 3})
        .look("look",
              show(kWorldN) +
                  "\ndisplacement d() { P += 0.2 * sin(2 * xcomp(transform(\"object\", P))) * N; }",
              kBoth)
        .place("floor", "look");
    SceneOptions options;
    options.quality.dice = 0.5;
    options.width = options.height = 64;
    expect_colors(
        Rendering(scene.text(), options).frame(),
        [](dvec2 p) { return glm::normalize(dvec3(-0.4 * std::cos(2 * p.x), 0, 1)); }, 0.01);
}

TEST(FlatMesh, ATransformationLeavesItFlat) {
    SceneText scene;
    scene.mesh("roof", kRoof, kRoofTriangles)
        .look("look",
              show(kWorldN) +
                  "\ntransformation t() { P = point(xcomp(P), ycomp(P), 0.5 * zcomp(P)); }",
              "<shader stage=\"SURFACE\"/><shader stage=\"TRANSFORMATION\"/>")
        .place("roof", "look");
    const double c = 1 / std::sqrt(5.0);
    expect_colors(
        Rendering(scene.text()).frame(),
        [&](dvec2 p) { return p.x < 0 ? dvec3(-c, 0, 2 * c) : dvec3(c, 0, 2 * c); }, 1e-5);
}

// ---- morphs on morphs and skins

// Where the first vertex stands in the world.
// Brings a pose that has made no frame to the scene's start.
void stand(const Rendering& r) {
    if (!r.pose->first_frame) return;
    evaluate_anew(*r.scene, *r.pose, r.scene->options.start_time);
    pose_joints(*r.scene, *r.pose);
    deform(*r.scene, *r.pose);
}

dvec3 first_vertex(const Rendering& r) {
    EXPECT_TRUE(r.scene) << r.findings();
    if (!r.scene) return dvec3(0.0);
    stand(r);
    return dvec3(r.pose->shapes[0].shown_positions[0]) + r.scene->origin;
}

// One triangle whose first vertex is (1, 0, 0); targets move it along y and z.
SceneText morphed(const std::string& controllers, const std::string& nodes) {
    SceneText scene;
    scene.look("look", show("N"))
        .mesh("base", {{1, 0, 0}, {0, 0.5, 0}, {0, 0, 0}}, {0, 1, 2})
        .mesh("up", {{1, 4, 0}, {0, 0.5, 0}, {0, 0, 0}}, {0, 1, 2})
        .mesh("near", {{1, 0, 2}, {0, 0.5, 0}, {0, 0, 0}}, {0, 1, 2})
        .mesh("by", {{0, 0, 2}, {0, 0, 0}, {0, 0, 0}}, {0, 1, 2});
    scene.controllers = controllers;
    scene.nodes += nodes;
    return scene;
}

TEST(MorphOnMorph, IsAppliedToItsResult) {
    // By hand: inner (1 - 1/4) (1,0,0) + 1/4 (1,4,0) = (1,1,0).
    std::string inner = morph("inner", "base", "NORMALIZED", "up", {0.25});
    auto outer = [&](const std::string& method, const std::string& target, double weight) {
        Rendering r(
            morphed(inner + morph("outer", "inner", method, target, {weight}), controlled("outer"))
                .text());
        r.frame();
        EXPECT_FALSE(r.diagnostics.has_errors()) << r.findings();
        return first_vertex(r);
    };
    expect_near(outer("RELATIVE", "by", 0.5), {1, 1, 1});
    // (1 - 1/2) (1,1,0) + 1/2 (1,0,2).
    expect_near(outer("NORMALIZED", "near", 0.5), {1, 0.5, 1});
    // Over a RELATIVE one: (1,0,0) + 1/2 (0,0,2) = (1,0,1); then 3/4 of it + 1/4 (1,4,0).
    Rendering r(morphed(morph("inner", "base", "RELATIVE", "by", {0.5}) +
                            morph("outer", "inner", "NORMALIZED", "up", {0.25}),
                        controlled("outer"))
                    .text());
    r.frame();
    expect_near(first_vertex(r), {1, 1, 0.75});
}

TEST(MorphOnMorph, BothMove) {
    SceneText scene = morphed(morph("inner", "base", "NORMALIZED", "up", {0}) +
                                  morph("outer", "inner", "NORMALIZED", "near", {0}),
                              controlled("outer"));
    scene.animate("inner-w(0)", {0, 1}, {0, 1}).animate("outer-w(0)", {0, 1}, {0, 0.5});
    Rendering r(scene.text());
    r.frame(0);
    expect_near(first_vertex(r), {1, 0, 0});
    r.frame(1);  // 1/2 (1,4,0) + 1/2 (1,0,2)
    expect_near(first_vertex(r), {1, 2, 1});
}

TEST(MorphOnSkin, TheSkinMovesWhatItMakes) {
    // (1,1,0) turned by 90 degrees about z is (-1,1,0); the joint stands at z = -1.
    Rendering r(morphed(skin("s", "base", 3) + morph("m", "s", "NORMALIZED", "up", {0.25}),
                        kBone + controlled("m", "<skeleton>#bone</skeleton>"))
                    .text());
    r.frame();
    EXPECT_FALSE(r.diagnostics.has_errors()) << r.findings();
    expect_near(first_vertex(r), {-1, 1, -1});
}

// ---- skeletons

TEST(Skeleton, OnlyInLibraryNodesItPosesItsSkinAndShowsNothing) {
    SceneText scene = morphed(skin("s", "base", 3), controlled("s", "<skeleton>#rig</skeleton>"));
    scene.library_nodes =
        "<node id=\"rig\"><translate>0 0 5</translate><instance_geometry url=\"#up\"/>" + kBone +
        "</node>";
    Rendering r(scene.text());
    r.frame();
    EXPECT_EQ(r.count("SKIN_UNPLACED_SKELETON"), 1) << r.findings();
    EXPECT_EQ(r.scene->shapes.size(), 1u);
    expect_near(first_vertex(r), {0, 1, 4});
}

// ---- materials

// A square whose <triangles> has this attribute, with these <instance_material>s.
Rendering bound(const std::string& attribute, const std::string& instance_materials) {
    SceneText scene;
    scene.look("red", "surface s() { Oi = 1; Ci = color(1, 0, 0); }")
        .look("blue", "surface s() { Oi = 1; Ci = color(0, 0, 1); }")
        .square("floor", 1.5);
    std::string& text = scene.geometries;
    text.replace(text.find("material=\"skin\""), 15, attribute);
    scene.nodes += "<node><instance_geometry url=\"#floor\"><bind_material><technique_common>" +
                   instance_materials +
                   "</technique_common></bind_material></instance_geometry></node>";
    return Rendering(scene.text());
}
const std::string kRed = "<instance_material symbol=\"a\" target=\"#red\"/>";
const std::string kBlue = "<instance_material symbol=\"b\" target=\"#blue\"/>";

TEST(Materials, APrimitiveWithoutOneTakesTheOnlyOneBound) {
    Rendering r = bound("", kRed);
    expect_colors(r.frame(), [](dvec2) { return dvec3(1, 0, 0); });
    EXPECT_EQ(r.count("MAT_AMBIGUOUS"), 0);
    Rendering twice = bound("", kRed + "<instance_material symbol=\"c\" target=\"#red\"/>");
    expect_colors(twice.frame(), [](dvec2) { return dvec3(1, 0, 0); });
}

TEST(Materials, OfSeveralNoneIsTakenAndItIsSaid) {
    Rendering r = bound("", kRed + kBlue);
    EXPECT_EQ(r.count("MAT_AMBIGUOUS"), 1) << r.findings();
    EXPECT_EQ(r.scene->surfaces[0].material, kNone);
}

TEST(Materials, ASymbolThatFitsNothingTakesTheOnlyOneWithAWord) {
    Rendering r = bound("material=\"other\"", kRed);
    expect_colors(r.frame(), [](dvec2) { return dvec3(1, 0, 0); });
    EXPECT_EQ(r.count("MAT_ONLY_BOUND"), 1) << r.findings();
}

// ---- indices

// A square with one index list an input, `p` its six corners.
Rendering indexed(const std::string& p, const std::string& code) {
    SceneText scene;
    scene.look("look", code, "<shader stage=\"SURFACE\"/>");
    scene.geometries =
        "<geometry id=\"floor\"><mesh>" +
        source("p", "-2 -2 0 2 -2 0 2 2 0 -2 2 0", 4, "XYZ", "float_array", "float") +
        source("n", "0 0.6 0.8", 1, "XYZ", "float_array", "float") +
        source("t", "0.5 0.25", 1, "ST", "float_array", "float") +
        "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices><triangles "
        "count=\"2\" material=\"skin\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>"
        "<input semantic=\"NORMAL\" source=\"#n\" offset=\"1\"/><input semantic=\"TEXCOORD\" "
        "source=\"#t\" offset=\"2\" set=\"0\"/><p>" +
        p + "</p></triangles></mesh></geometry>";
    scene.place("floor", "look");
    return Rendering(scene.text());
}

TEST(Indices, ABadNormalCostsTheNormalNotTheFace) {
    // The upper left triangle names normals that are not there: its own is +z.
    Rendering r = indexed("0 0 0 1 0 0 2 0 0  0 7 0 2 -1 0 3 7 0", show(kWorldN));
    EXPECT_EQ(r.count("PRIM_INDEX_RANGE"), 1) << r.findings();
    r.frame();
    int covered = 0;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            covered += r.film.at(x, y).w > 0;
            dvec2 p = r.place(x, y);
            if (std::abs(p.x - p.y) < 0.01) continue;
            EXPECT_NEAR(r.color(x, y).y, p.y > p.x ? 0 : 0.6, 1e-6);
            EXPECT_NEAR(r.color(x, y).z, p.y > p.x ? 1 : 0.8, 1e-6);
        }
    EXPECT_EQ(covered, 256);
}

TEST(Indices, BadTextureCoordinatesAreZero) {
    Rendering r = indexed("0 0 1 1 0 1 2 0 1  0 0 0 2 0 0 3 0 0",
                          "surface s() { Oi = 1; Ci = color(s, t, 0); }");
    EXPECT_EQ(r.count("PRIM_INDEX_RANGE"), 1) << r.findings();
    r.frame();
    EXPECT_EQ(r.color(14, 14), vec3(0));
    EXPECT_EQ(r.color(1, 1), vec3(0.5f, 0.25f, 0));
}

// ---- units and axes

dvec3 placed(const Rendering& r, dvec3 p, size_t shape = 0) {
    if (!r.scene || r.scene->shapes.size() <= shape) {
        ADD_FAILURE() << r.findings();
        return dvec3(0.0);
    }
    stand(r);
    return dvec3(r.pose->shapes[shape].world * dvec4(p, 1.0));
}

const std::string kInches =
    "<asset><created>2026-11-21T00:00:00Z</created><modified>2026-11-21T00:00:00Z</modified>"
    "<unit name=\"inch\" meter=\"0.0254\"/></asset>";
const std::string kZUp =
    "<asset><created>2026-11-21T00:00:00Z</created><modified>2026-11-21T00:00:00Z</modified>"
    "<up_axis>Z_UP</up_axis></asset>";

// The document is in metres and Y up.
TEST(NestedAssets, AGeometryHasItsOwnUnit) {
    SceneText scene = roof(show("N")).place("roof", "look", "<translate>0 0 1</translate>");
    size_t at = scene.geometries.find("<mesh>");
    scene.geometries.insert(at, kInches);
    expect_near(placed(Rendering(scene.text()), {100, 0, 0}), {2.54, 0, 1});
}

TEST(NestedAssets, ALibrarysHoldsForEachEntry) {
    SceneText scene = roof(show("N")).place("roof", "look", "<translate>0 0 1</translate>");
    scene.geometries.insert(0, kZUp);  // z is up: (x, y, z) is our (x, z, -y)
    expect_near(placed(Rendering(scene.text()), {1, 2, 3}), {1, 3, -1});
}

TEST(NestedAssets, ANodesMovesItsTransformsToo) {
    SceneText scene = roof(show("N"));
    scene.place("roof", "look", kInches + "<translate>0 0 100</translate>");
    // The mesh is in metres: the node's unit changes it there and back.
    expect_near(placed(Rendering(scene.text()), {1, 0, 0}), {1, 0, 2.54});
}

TEST(NestedAssets, InsideEachOtherTheInnerOneCounts) {
    SceneText scene = roof(show("N"));
    scene.nodes += "<node>" + kZUp + "<translate>0 0 3</translate><node>" + kInches +
                   "<translate>0 0 100</translate><instance_geometry url=\"#roof\"/></node></node>";
    // Three metres up, 100 inches more up; the mesh has y up again.
    expect_near(placed(Rendering(scene.text()), {0, 1, 0}), {0, 3 + 2.54 + 1, 0});
}

TEST(NestedAssets, AnInstancedNodeBringsItsLibrarysAlong) {
    SceneText scene = roof(show("N"));
    scene.library_nodes = kInches +
                          "<node id=\"unit\"><translate>100 0 0</translate><instance_geometry "
                          "url=\"#roof\"/></node>";
    scene.nodes += "<node><translate>0 1 0</translate><instance_node url=\"#unit\"/></node>";
    expect_near(placed(Rendering(scene.text()), {0, 0, 1}), {2.54, 1, 1});
}

TEST(NestedAssets, AnAssetWithoutUnitOrAxisChangesNothing) {
    SceneText scene = roof(show("N")).place("roof", "look");
    scene.geometries.insert(
        scene.geometries.find("<mesh>"),
        "<asset><created>2026-11-21T00:00:00Z</created><modified>2026-11-21T00:00:00Z</modified>"
        "</asset>");
    expect_near(placed(Rendering(scene.text()), {1, 2, 3}), {1, 2, 3});
}

TEST(NestedAssets, ASkinsNumbersAreItsControllers) {
    // The mesh is in inches, the skin and the joint in metres.
    SceneText scene =
        morphed(skin("s", "base", 3), kBone + controlled("s", "<skeleton>#bone</skeleton>"));
    scene.geometries.insert(0, kInches);
    Rendering r(scene.text());
    r.frame();
    expect_near(first_vertex(r), {0, 0.0254, -1});
}

}  // namespace
}  // namespace kinora
