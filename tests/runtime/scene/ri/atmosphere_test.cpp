// tests/runtime/scene/ri/atmosphere_test.cpp: atmospheres of some primitives and not of others.
#include "rib_scene.h"

namespace kinora::ri {
namespace {

// Halves of the picture at z = 3, in orthographic view.
const std::string kLeftHalf = "Polygon \"P\" [-1 -1 3 -1 .8 3 0 .8 3 0 -1 3] ";
const std::string kRightHalf = "Polygon \"P\" [0 -1 3 0 .8 3 1 .8 3 1 -1 3] ";

class RiAtmosphere : public testing::Test {
  protected:
    RiAtmosphere() {
        folder_
            .file("tinted.sl",
                  "volume tinted(color tint = color(1, 0, 0); float per = 0.1;)"
                  "{ Ci = mix(Ci, tint, per * length(I)); Oi = Oi; }")
            .file("placed.sl",
                  "volume placed() { point p = transform(\"shader\", P);"
                  " Ci = 0.5 + 0.1 * color(xcomp(p), ycomp(p), zcomp(p)); }")
            .file("mirror.sl", "surface mirror() { Oi = 1; Ci = trace(P, vector (0, 0, -1)); }")
            .file("asks.sl",
                  "surface asks() { color c = 0; atmosphere(\"tint\", c); Oi = 1; Ci = c; }");
    }
    RibPicture picture(const std::string& inside) const {
        return RibPicture(kSmall + folder_.search() +
                          "WorldBegin Surface \"constant\" Color 0 0 1 " + inside + " WorldEnd");
    }
    RibFolder folder_;
};

const std::string kRedFog = "Atmosphere \"tinted\" ";
const std::string kGreenFog = "Atmosphere \"tinted\" \"color tint\" [0 1 0] \"float per\" .2 ";

TEST_F(RiAtmosphere, IsAnAttribute) {
    RibPicture r = picture(kRedFog + kLeftHalf + kGreenFog + kRightHalf);
    EXPECT_EQ(r.findings(), "");
    r.expect(2, 8, {.3, 0, .7});
    r.expect(13, 8, {0, .6, .4});
    EXPECT_FALSE(r.covers(2, 0));  // nothing is there that it belongs to
}

TEST_F(RiAtmosphere, OthersAreFreeOfIt) {
    RibPicture r = picture("AttributeBegin " + kRedFog + kLeftHalf + "AttributeEnd " + kRightHalf);
    r.expect(2, 8, {.3, 0, .7});
    r.expect(13, 8, {0, 0, 1});
    RibPicture ended = picture(kRedFog + kLeftHalf + "Atmosphere \"null\" " + kRightHalf);
    ended.expect(2, 8, {.3, 0, .7});
    ended.expect(13, 8, {0, 0, 1});
}

TEST_F(RiAtmosphere, ItsSpaceIsThatOfItsRequest) {
    RibPicture r = picture("TransformBegin Translate 0 0 2 Atmosphere \"placed\" TransformEnd " +
                           kLeftHalf + "Translate 0 0 1 " + kRightHalf);
    EXPECT_NEAR(r.at(2, 8).z, .6, 1e-5);
    EXPECT_NEAR(r.at(13, 8).z, .7, 1e-5);
}

// Rays of reflections run through the exterior, of which there is none.
TEST_F(RiAtmosphere, TakesRaysOfTheEyeAlone) {
    RibPicture r = picture("Surface \"mirror\" " + kLeftHalf + "Surface \"constant\" " + kRedFog +
                           "Polygon \"P\" [-1 -1 -1 -1 1 -1 0 1 -1 0 -1 -1] ");
    r.expect(2, 8, {0, 0, 1});
}

TEST_F(RiAtmosphere, SurfacesCanAskForTheirs) {
    RibPicture r = picture("Surface \"asks\" Atmosphere \"tinted\" \"tint\" [0 .5 0] \"per\" 0 " +
                           kLeftHalf + "Atmosphere \"null\" " + kRightHalf);
    r.expect(2, 8, {0, .5, 0});
    r.expect(13, 8, {0, 0, 0});
}

TEST_F(RiAtmosphere, OneStandsForAllOfItsPrimitives) {
    RibWorlds r(folder_.search() + "WorldBegin " + kRedFog + kLeftHalf + "Color 1 0 0 " +
                kRightHalf + "Translate 1 0 0 " + kLeftHalf + "Atmosphere \"null\" " + kLeftHalf +
                "WorldEnd");
    EXPECT_EQ(r.world().atmospheres.size(), 1u);
    ASSERT_EQ(r.primitives().size(), 2u);  // three of one look have joined
    EXPECT_EQ(r.primitive(0).material->atmosphere, 0u);
    EXPECT_EQ(r.primitive(0).mesh->groups[0].triangles.size(), 18u);
    EXPECT_EQ(r.primitive(1).material->atmosphere, kNone);
    EXPECT_TRUE(r.world().picture.atmosphere.empty());
}

}  // namespace
}  // namespace kinora::ri
