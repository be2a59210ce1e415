// tests/runtime/scene/ri/unseen_test.cpp: mattes, clipping planes, and what some rays do not meet.
#include "rib_scene.h"

namespace kinora::ri {
namespace {

// The left half of the picture, the upper half, and all of it.
const std::string kLeftHalf = "Polygon \"P\" [-1 -1 0 -1 1 0 0 1 0 0 -1 0] ";
const std::string kUpperHalf = "Polygon \"P\" [-1 0 0 -1 1 0 1 1 0 1 0 0] ";
const std::string kWall = "Polygon \"P\" [-1 -1 0 -1 1 0 1 1 0 1 -1 0] ";

RibPicture seen_in(const std::string& inside, const std::string& before = "") {
    return RibPicture(kSmall + before + "WorldBegin Surface \"constant\" " + inside + "WorldEnd");
}

std::string at_depth(const std::string& z, const std::string& what) {
    return "AttributeBegin Translate 0 0 " + z + " " + what + "AttributeEnd ";
}

TEST(RiMatte, HidesWhatIsBehindAndIsAHole) {
    const std::string held =
        at_depth("3", "Color 1 .5 0 " + kLeftHalf) + at_depth("2", "Matte 1 " + kUpperHalf);
    RibPicture before = seen_in(held + at_depth("1", "Color 0 0 1 " + kLeftHalf));
    EXPECT_EQ(before.at(2, 2), vec4(0, 0, 1, 1));
    RibPicture r = seen_in(held);
    EXPECT_EQ(r.at(2, 2), vec4(0));
    EXPECT_EQ(r.at(2, 13), vec4(1, .5f, 0, 1));
    EXPECT_EQ(r.at(13, 2), vec4(0));
    EXPECT_EQ(r.findings(), "");
}

// 3/4 of what is behind is seen, and covers so much.
TEST(RiMatte, HidesByItsOpacity) {
    RibPicture r = seen_in(at_depth("3", "Color 1 1 1 " + kLeftHalf) +
                           at_depth("2", "Matte 1 Opacity .25 .25 .25 " + kWall));
    EXPECT_EQ(r.at(2, 8), vec4(.75f));
    EXPECT_EQ(r.at(13, 8), vec4(0));
}

TEST(RiMatte, ShowsTheBackground) {
    SceneRequest request = RibPicture::request_of("x.rib");
    request.background = vec3(0, .5f, 0);
    OpenScene scene(request);
    raytrace::Film film;
    ASSERT_EQ(scene.open(kSmall + "WorldBegin Surface \"constant\" " +
                         at_depth("2", "Matte 1 Opacity .5 .5 .5 " + kLeftHalf) +
                         at_depth("3", "Color 1 0 0 " + kLeftHalf) + "WorldEnd"),
              SceneError::None);
    ASSERT_TRUE(scene.render(0, film));
    EXPECT_EQ(film.at(2, 8), vec4(.5f, .25f, 0, 1));
    EXPECT_EQ(film.at(13, 8), vec4(0, .5f, 0, 1));
}

TEST(RiClippingPlane, CutsOffTheSideOfItsNormal) {
    const std::string both =
        at_depth("2", "Color 1 0 0 " + kLeftHalf) + at_depth("3", "Color 0 1 0 " + kWall);
    RibPicture near = seen_in(both, "ClippingPlane 0 0 2.5 0 0 -1 ");
    EXPECT_EQ(near.at(2, 8), vec4(0, 1, 0, 1)) << near.findings();
    RibPicture far = seen_in(both, "ClippingPlane 0 0 2.5 0 0 1 ");
    EXPECT_EQ(far.at(2, 8), vec4(1, 0, 0, 1));
    EXPECT_FALSE(far.covers(13, 8));
    RibPicture slab = seen_in(both, "ClippingPlane 0 0 2.5 0 0 1 ClippingPlane 0 0 2.5 0 0 -1 ");
    EXPECT_EQ(slab.covered(), 0);
}

// Along rays: its normal is across them.
TEST(RiClippingPlane, StandsWhereTheTransformationPutsIt) {
    RibPicture r =
        seen_in(at_depth("3", kWall),
                "TransformBegin Translate .5 0 0 Scale -2 1 1 ClippingPlane 0 0 0 -1 0 0 "
                "TransformEnd ");
    for (int x = 0; x < 16; ++x) EXPECT_EQ(r.covers(x, 8), x < 12) << x;
}

// The plane through the points at 45 degrees: each ray is cut elsewhere.
TEST(RiClippingPlane, CutsEachRayWhereItPasses) {
    const std::string camera = "Projection \"perspective\" \"fov\" 90 ";
    RibPicture r = seen_in(at_depth("4", "Scale 4 4 1 " + kWall),
                           camera + "ClippingPlane 0 0 4 .70710678 0 .70710678 ");
    for (int x = 0; x < 16; ++x) EXPECT_EQ(r.covers(x, 8), x < 8) << x;
}

TEST(RiClippingPlane, MustHaveANormal) {
    EXPECT_EQ(RibWorlds("ClippingPlane 0 0 1 0 0 0 WorldBegin WorldEnd").count("RI_RANGE"), 1);
    std::string many;
    for (int i = 0; i < 17; ++i) many += "ClippingPlane 0 0 1 0 0 1 ";
    EXPECT_EQ(RibWorlds(many + "WorldBegin WorldEnd").count("RI_RANGE"), 1);
}

// A sun behind the eye, and something before the left half of a white wall.
std::string shadowed_wall(const std::string& attributes) {
    return "Attribute \"light\" \"string shadows\" \"on\" LightSource \"distantlight\" 1 "
           "Surface \"matte\" " +
           at_depth("3", kWall) + at_depth("2", "Color 1 0 0 " + attributes + kLeftHalf);
}

void expect_left_half(const RibPicture& r, dvec3 color) {
    r.expect(2, 8, color);
    r.expect(13, 8, dvec3(1));
}

TEST(RiVisibility, OfTheCameraLeavesShadows) {
    expect_left_half(seen_in(shadowed_wall("")), {1, 0, 0});
    expect_left_half(seen_in(shadowed_wall("Attribute \"visibility\" \"int camera\" [0] ")),
                     dvec3(0));
    expect_left_half(seen_in(shadowed_wall("Attribute \"render\" \"visibility\" [4] ")), dvec3(0));
    RibPicture cut = seen_in(shadowed_wall(""), "ClippingPlane 0 0 2.5 0 0 -1 ");
    expect_left_half(cut, dvec3(0));  // planes cut what the camera sees alone
}

TEST(RiVisibility, OfShadowsLetsLightThrough) {
    const std::string hidden = "Attribute \"visibility\" \"int camera\" [0] ";
    for (const char* words : {"Attribute \"visibility\" \"int transmission\" [0] ",
                              "Attribute \"visibility\" \"string transmission\" \"transparent\" ",
                              "Attribute \"render\" \"string casts_shadows\" \"none\" "})
        expect_left_half(seen_in(shadowed_wall(hidden + words)), dvec3(1));
    for (const char* words : {"Attribute \"visibility\" \"string transmission\" \"opaque\" ",
                              "Attribute \"render\" \"string casts_shadows\" \"Os\" "})
        expect_left_half(seen_in(shadowed_wall(hidden + words)), dvec3(0));
}

// A mirror that shows what is behind the eye.
TEST(RiVisibility, OfReflectionsIsTheirOwn) {
    RibFolder folder;
    folder.file("mirror.sl", "surface mirror() { Oi = 1; Ci = trace(P, vector(0, 0, -1)); }");
    auto seen = [&](const std::string& attributes) {
        return seen_in("AttributeBegin Surface \"mirror\" " + at_depth("3", kWall) +
                           "AttributeEnd " +
                           at_depth("-1", "Color 0 1 0 " + attributes + kLeftHalf),
                       folder.search());
    };
    seen("").expect(2, 8, {0, 1, 0});
    for (const char* name : {"specular", "trace"})
        seen("Attribute \"visibility\" \"int " + std::string(name) + "\" [0] ")
            .expect(2, 8, dvec3(0));
    seen("Attribute \"visibility\" \"int diffuse\" [0] ").expect(2, 8, {0, 1, 0});
    seen("Attribute \"render\" \"visibility\" [5] ").expect(2, 8, dvec3(0));
}

TEST(RiVisibility, OfNothingIsNoMesh) {
    EXPECT_TRUE(RibWorlds("WorldBegin Attribute \"render\" \"visibility\" [0] Sphere 1 -1 1 360 "
                          "WorldEnd")
                    .primitives()
                    .empty());
}

}  // namespace
}  // namespace kinora::ri
