// tests/runtime/scene/ri/lights_test.cpp: which lights a primitive sees, from where, and with
// which shadows.
#include "rib_scene.h"

namespace kinora::ri {
namespace {

// Half of the picture each, at z = 3, facing the eye.
const std::string kLeft = "Polygon \"P\" [-1 -1 3 -1 1 3 0 1 3 0 -1 3] ";
const std::string kRight = "Polygon \"P\" [0 -1 3 0 1 3 1 1 3 1 -1 3] ";
// Along z, so that what faces the eye has all of it.
const std::string kSun = "LightSource \"distantlight\" ";

RibPicture lit(const std::string& inside, const std::string& before = "") {
    return RibPicture(kSmall + before + "WorldBegin Surface \"matte\" " + inside + "WorldEnd");
}

void expect_halves(const RibPicture& r, double left, double right) {
    r.expect(2, 8, dvec3(left));
    r.expect(13, 8, dvec3(right));
}

TEST(RiLights, ShineOnWhatComesAfterThem) {
    expect_halves(lit(kLeft + kSun + "1 \"intensity\" .5 " + kRight), 0, .5);
    expect_halves(
        lit(kSun + "1 \"intensity\" .5 " + kSun + "2 \"intensity\" .25 " + kLeft + kRight), .75,
        .75);
}

TEST(RiLights, AreSwitchedByTheirHandles) {
    for (const char* handle : {"1", "\"sun\"", "[7]"}) {
        const std::string h = handle;
        RibPicture r = lit(kSun + h + " " + kLeft + "Illuminate " + h + " 0 " + kRight);
        expect_halves(r, 1, 0);
        EXPECT_EQ(r.findings(), "") << handle;
        expect_halves(
            lit(kSun + h + " Illuminate " + h + " 0 " + kLeft + "Illuminate " + h + " 1 " + kRight),
            0, 1);
    }
    expect_halves(lit(kSun + "1 \"intensity\" .5 " + kSun + "\"b\" \"intensity\" .25 " + kLeft +
                      "Illuminate 1 0 " + kRight),
                  .75, .25);
}

TEST(RiLights, TwiceOnIsOnce) {
    expect_halves(lit(kSun + "1 Illuminate 1 1 Illuminate 1 1 " + kLeft + kRight), 1, 1);
}

TEST(RiLights, UnknownHandlesAreReported) {
    RibPicture r = lit(kSun + "1 Illuminate 2 0 Illuminate \"x\" 1 " + kLeft + kRight);
    EXPECT_EQ(r.count("RIB_HANDLE"), 2) << r.findings();
    expect_halves(r, 1, 1);
}

TEST(RiLights, ListsAreThoseOfTheirBlock) {
    expect_halves(lit("AttributeBegin " + kSun + "1 " + kLeft + "AttributeEnd " + kRight), 1, 0);
    expect_halves(
        lit("AttributeBegin " + kSun + "1 AttributeEnd " + kLeft + "Illuminate 1 1 " + kRight), 0,
        1);
    expect_halves(lit(kSun + "1 AttributeBegin Illuminate 1 0 " + kLeft + "AttributeEnd " + kRight),
                  0, 1);
    expect_halves(lit("TransformBegin " + kSun + "1 TransformEnd " + kLeft + kRight), 1, 1);
}

// The direction (0, 0, 1) turned by 60 degrees about x has a cosine of 0.5.
TEST(RiLights, StandWhereTheTransformationIs) {
    expect_halves(
        lit("TransformBegin Rotate 60 1 0 0 " + kSun + "1 TransformEnd " + kLeft + kRight), .5, .5);
    expect_halves(lit("TransformBegin Rotate 60 1 0 0 " + kSun +
                      "1 \"to\" [0 1.7320508 1] TransformEnd " + kLeft + kRight),
                  1, 1);
    // From (0.28125, 0.28125, 2) straight at a pixel's middle at z = 3.
    RibPicture point =
        lit("TransformBegin Translate .1875 .1875 2 LightSource \"pointlight\" 1 \"intensity\" .5 "
            "TransformEnd " +
            kRight);
    point.expect(9, 6, dvec3(.5));
}

TEST(RiLights, BeforeTheWorldStandInCameraSpace) {
    expect_halves(lit("Identity Translate 0 0 -1 " + kLeft + kRight,
                      kSun + "1 Rotate 0 1 0 0 Translate 0 0 1 "),
                  1, 1);
    RibPicture r = lit("Rotate -60 1 0 0 " + kLeft + kRight,
                       "Projection \"orthographic\" " + kSun + "1 Rotate 60 1 0 0 ");
    expect_halves(r, 1, 1);
    RibPicture within = lit(kSun + "1 Rotate -60 1 0 0 " + kLeft + kRight, "Rotate 60 1 0 0 ");
    expect_halves(within, .5, .5);
}

TEST(RiLights, BeforeTheWorldAreOnInEachWorld) {
    RibWorlds r(kSun + "1 WorldBegin " + kLeft + "WorldEnd WorldBegin Illuminate 1 0 " + kLeft +
                "WorldEnd WorldBegin " + kLeft + kSun + "2 " + kRight + "WorldEnd");
    ASSERT_EQ(r.worlds.size(), 3u);
    EXPECT_EQ(r.world(0).lights.size(), 1u);
    EXPECT_FALSE(r.primitive(0, 0).lights);  // all
    EXPECT_TRUE(r.world(1).lights.empty());
    ASSERT_EQ(r.world(2).lights.size(), 2u);
    EXPECT_EQ(r.primitive(0, 2).lights, std::vector<uint32_t>{0});
    EXPECT_FALSE(r.primitive(1, 2).lights);
}

TEST(RiLights, AmbientOnesReachEverySide) {
    expect_halves(lit("LightSource \"ambientlight\" 1 \"intensity\" .25 \"lightcolor\" [1 1 1] " +
                      kLeft + "ReverseOrientation " + kRight),
                  .25, .25);
}

TEST(RiLights, UnknownShadersAreLeftOut) {
    RibPicture r = lit(kSun + "1 LightSource \"nowhere_at_all\" 2 Illuminate 2 0 Illuminate 2 1 " +
                       kLeft + kRight);
    EXPECT_EQ(r.count("RI_SHADER_UNKNOWN"), 1) << r.findings();
    expect_halves(r, 1, 1);
}

// Light along (1, 0, 1): what stands at x in [-0.5, 0], z = 2 has its shadow at [0.5, 1], z = 3.
const std::string kSlanted = "LightSource \"distantlight\" 1 \"to\" [1 0 1] ";
const std::string kBlocker = "Polygon \"P\" [-.5 -1 2 -.5 1 2 0 1 2 0 -1 2] ";
const double kSlant = 0.70710678;

TEST(RiLights, CastNoShadowsByThemselves) {
    RibPicture r = lit(kSlanted + kLeft + kRight + kBlocker);
    r.expect(13, 8, dvec3(kSlant));
    r.expect(1, 8, dvec3(kSlant));
}

TEST(RiLights, CastShadowsWhereTheAttributeIsOn) {
    const std::string on = "Attribute \"light\" \"string shadows\" \"on\" ";
    RibPicture r = lit(on + kSlanted + kLeft + kRight + kBlocker);
    r.expect(13, 8, dvec3(0));
    r.expect(1, 8, dvec3(kSlant));
    r.expect(9, 8, dvec3(kSlant));
    RibPicture undeclared =
        lit("Attribute \"light\" \"shadows\" \"on\" " + kSlanted + kLeft + kRight + kBlocker);
    undeclared.expect(13, 8, dvec3(0));
    RibPicture off = lit(on + "Attribute \"light\" \"string shadows\" \"off\" " + kSlanted + kLeft +
                         kRight + kBlocker);
    off.expect(13, 8, dvec3(kSlant));
    RibPicture later = lit(kSlanted + on + kLeft + kRight + kBlocker);
    later.expect(13, 8, dvec3(kSlant));
    RibPicture block =
        lit("AttributeBegin " + on + "AttributeEnd " + kSlanted + kLeft + kRight + kBlocker);
    block.expect(13, 8, dvec3(kSlant));
}

TEST(RiLights, CastShadowsWhereTheKnobGivesThemToAll) {
    SceneRequest request = RibPicture::request_of("x.rib");
    request.quality.shadows = ShadowMode::All;
    OpenScene scene(request);
    raytrace::Film film;
    ASSERT_EQ(scene.open(kSmall + "WorldBegin Surface \"matte\" " + kSlanted + kLeft + kRight +
                         kBlocker + "WorldEnd"),
              SceneError::None);
    ASSERT_TRUE(scene.render(0, film));
    EXPECT_NEAR(film.at(13, 8).x, 0, 1e-6);
    EXPECT_NEAR(film.at(1, 8).x, kSlant, 1e-5);
}

// A surface that is bound meanwhile does not end it.
TEST(RiLights, AreaLightsEndWithTheirBlock) {
    RibFolder folder;
    folder.file(
        "glow.sl",
        "light glow(float intensity = 1;) { illuminate(P, N, PI / 2) { Cl = intensity; } }");
    RibWorlds r(folder.search() +
                "WorldBegin AttributeBegin Attribute \"light\" \"integer nsamples\" 9 "
                "AreaLightSource \"glow\" 1 \"intensity\" 2 Surface \"constant\" Sphere 1 -1 1 360 "
                "AttributeEnd "
                "Sphere 1 -1 1 360 WorldEnd");
    ASSERT_EQ(r.primitives().size(), 2u) << r.findings();
    ASSERT_EQ(r.primitive(0).material->lights.size(), 1u);
    EXPECT_EQ(r.primitive(0).material->light_samples, 9u);
    EXPECT_EQ(r.primitive(0).material->surfaces[0].shader->name, "constant");
    EXPECT_TRUE(r.primitive(1).material->lights.empty());
    EXPECT_EQ(r.findings(), "");
}

// A light that shines from a square at z = 0 towards what stands at z = 3, and a block for it.
class RiAreaLights : public testing::Test {
  protected:
    RiAreaLights() {
        folder_
            .file("beam.sl",
                  "light beam(float intensity = 1;)"
                  "{ illuminate(P, N, PI / 2) { Cl = intensity; } }")
            .file("sum.sl",
                  "surface sum() { color c = 0; Oi = 1;"
                  " illuminance(P, vector \"camera\" (0, 0, -1), PI / 2) c += Cl; Ci = c; }");
    }
    // Behind the eye, facing along z.
    static std::string lamp(const std::string& inside = "") {
        return "AttributeBegin AreaLightSource \"beam\" \"lamp\" \"intensity\" .5 " + inside +
               "Polygon \"P\" [-.1 -.1 -1 .1 -.1 -1 .1 .1 -1 -.1 .1 -1] AttributeEnd ";
    }
    RibPicture lit(const std::string& inside) const {
        return RibPicture(kSmall + folder_.search() + "WorldBegin Surface \"sum\" " + inside +
                          "WorldEnd");
    }
    RibFolder folder_;
};

TEST_F(RiAreaLights, EndWithTheirBlockUnlessTheyAreSwitchedOn) {
    expect_halves(lit(lamp() + kLeft + kRight), 0, 0);
    expect_halves(lit(lamp() + kLeft + "Illuminate \"lamp\" 1 " + kRight), 0, .5);
    expect_halves(
        lit(lamp() + "Illuminate \"lamp\" 1 " + kLeft + "Illuminate \"lamp\" 0 " + kRight), .5, 0);
    expect_halves(lit(lamp(kLeft) + kRight), .5, 0);
}

TEST_F(RiAreaLights, OfOneHandleGoTogether) {
    const std::string two =
        lamp("Polygon \"P\" [.3 -.1 -1 .5 -.1 -1 .5 .1 -1 .3 .1 -1] ") + "Illuminate \"lamp\" 1 ";
    expect_halves(lit(two + kLeft + "Illuminate \"lamp\" 0 " + kRight), 1, 0);
}

TEST_F(RiAreaLights, AndOthersAreInOneList) {
    RibPicture r = lit(lamp() + kSun + "1 \"intensity\" .25 " + kLeft +
                       "Illuminate 1 0 Illuminate \"lamp\" 1 " + kRight);
    expect_halves(r, .25, .5);
}

}  // namespace
}  // namespace kinora::ri
