// tests/runtime/scene/ri/motion_test.cpp: motion blocks at the shutter's opening, levels of
// detail, and what this version says that it leaves out.
#include "rib_scene.h"

namespace kinora::ri {
namespace {

const std::string kOneSphere = "Sphere 1 -1 1 360 ";

dvec3 placed(const std::string& shutter, const std::string& motion) {
    RibWorlds r(shutter + " WorldBegin " + motion + " " + kOneSphere + "WorldEnd");
    EXPECT_EQ(r.findings(), "") << motion;
    return r.primitive().place({1, 0, 0});
}

const std::string kMove = "MotionBegin [0 1] Translate 0 0 0 Translate 4 0 0 MotionEnd ";

TEST(RiMotion, StandsAsAtTheOpeningOfTheShutter) {
    expect_near(placed("", kMove), {1, 0, 0});
    expect_near(placed("Shutter 1 1", kMove), {5, 0, 0});
    expect_near(placed("Shutter .25 .25", kMove), {2, 0, 0});
    expect_near(placed("Shutter -3 -3", kMove), {1, 0, 0});
    expect_near(placed("Shutter 9 9", kMove), {5, 0, 0});
}

TEST(RiMotion, MixesTheTwoTimesAround) {
    const std::string three =
        "MotionBegin [0 1 3] Translate 0 0 0 Translate 4 0 0 Translate 4 8 0 MotionEnd";
    expect_near(placed("Shutter 1 1", three), {5, 0, 0});
    expect_near(placed("Shutter 2.5 2.5", three), {5, 6, 0});
    // Rotations by their angle: half of 90 degrees.
    expect_near(
        placed("Shutter .5 .5", "MotionBegin [0 1] Rotate 0 0 0 1 Rotate 90 0 0 1 MotionEnd"),
        {0.70710678, 0.70710678, 0});
    expect_near(placed("Shutter .5 .5",
                       "MotionBegin [0 1] ConcatTransform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1] "
                       "ConcatTransform [3 0 0 0 0 1 0 0 0 0 1 0 2 0 0 1] MotionEnd"),
                {3, 0, 0});
}

TEST(RiMotion, OfColoursAndShapes) {
    RibWorlds r(
        "Shutter .5 .5 WorldBegin MotionBegin [0 1] Color 1 0 0 Color 0 1 0 MotionEnd MotionBegin "
        "[0 "
        "1] Polygon \"P\" [0 0 0 1 0 0 0 1 0] Polygon \"P\" [0 0 0 1 0 0 0 3 0] MotionEnd "
        "MotionBegin [0 1] "
        "Sphere 1 -1 1 360 Sphere 3 -3 3 360 MotionEnd WorldEnd");
    ASSERT_EQ(r.primitives().size(), 2u) << r.findings();
    EXPECT_EQ(color_of(r.world(), r.primitive(0)), dvec3(.5, .5, 0));
    ASSERT_EQ(r.primitive(0).mesh->positions.size(), 3u);
    double high[2] = {};
    for (size_t i = 0; i < 2; ++i)
        for (const dvec3& p : r.primitive(i).mesh->positions)
            high[i] = std::max(high[i], i ? p.z : p.y);
    EXPECT_NEAR(high[0], 2, 1e-6);
    EXPECT_NEAR(high[1], 2, 1e-6);
}

TEST(RiMotion, OfTheCamera) {
    RibWorlds r(
        "Shutter 1 1 MotionBegin [0 1] Translate 0 0 1 Translate 0 0 5 MotionEnd WorldBegin " +
        kOneSphere + "WorldEnd");
    expect_near(r.primitive().place({}), {0, 0, 5});
}

TEST(RiMotion, OfUnequalLengthIsReported) {
    RibWorlds r("WorldBegin MotionBegin [0 1] Translate 1 0 0 MotionEnd MotionBegin [] MotionEnd " +
                kOneSphere + "WorldEnd");
    EXPECT_EQ(r.count("RI_MOTION"), 1) << r.findings();
    expect_near(r.primitive().place({}), {1, 0, 0});
}

TEST(RiMotion, WithinObjects) {
    RibWorlds r("Shutter 1 1 WorldBegin ObjectBegin 1 " + kMove + " " + kOneSphere +
                "ObjectEnd ObjectInstance 1 WorldEnd");
    expect_near(r.primitive().place({}), {4, 0, 0});
}

TEST(RiMotion, BlurIsSaidToBeLeftOut) {
    RibWorlds r("Shutter 0 1 WorldBegin " + kMove + kMove + kOneSphere + "WorldEnd");
    EXPECT_EQ(r.count("RI_NOT_DONE"), 1) << r.findings();
}

// A box of 1 by 1 units is 50 by 50 pixels.
const std::string kBox = "Format 100 100 1 WorldBegin Detail [0 1 0 1 3 3] ";

size_t drawn_by_ranges(const std::string& ranges, const std::string& before = "") {
    RibWorlds r(before + kBox + ranges + kOneSphere + "WorldEnd");
    EXPECT_EQ(r.findings(), "");
    return r.primitives().size();
}

TEST(RiDetail, RangesAreInPixelsOfTheBox) {
    EXPECT_EQ(drawn_by_ranges("DetailRange 0 0 2400 2400 "), 0u);
    EXPECT_EQ(drawn_by_ranges("DetailRange 2400 2400 2600 2600 "), 1u);
    EXPECT_EQ(drawn_by_ranges("DetailRange [2600 2600 1e38 1e38] "), 0u);
    EXPECT_EQ(drawn_by_ranges("DetailRange 0 0 2400 2400 ", "RelativeDetail .5 "), 1u);
    EXPECT_EQ(drawn_by_ranges("DetailRange 0 0 1e38 1e38 "), 1u);
}

TEST(RiDetail, OneOfNeighboursIsDrawn) {
    RibWorlds r(kBox + "AttributeBegin DetailRange 0 0 2000 3000 " + kOneSphere +
                "AttributeEnd AttributeBegin "
                "DetailRange 2000 3000 1e38 1e38 " +
                kOneSphere + "AttributeEnd " + kOneSphere + "WorldEnd");
    EXPECT_EQ(r.primitives().size(), 2u);
}

TEST(RiDetail, InPerspectiveByDistance) {
    // At z = 10 and 90 degrees: 5 pixels a unit.
    const std::string far =
        "Format 100 100 1 Projection \"perspective\" WorldBegin Translate 0 0 10 Detail [0 1 0 1 0 "
        "0] ";
    EXPECT_EQ(
        RibWorlds(far + "DetailRange 24 24 26 26 " + kOneSphere + "WorldEnd").primitives().size(),
        1u);
    EXPECT_EQ(
        RibWorlds(far + "DetailRange 26 26 99 99 " + kOneSphere + "WorldEnd").primitives().size(),
        0u);
}

TEST(RiNotDone, EachIsSaidOnce) {
    for (const char* request :
         {"Curves \"linear\" [2] \"nonperiodic\" \"P\" [0 0 0 1 1 1] \"constantwidth\" [.1]",
          "Points \"P\" [0 0 0]", "Blobby 1 [1001 0] [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1] [\"\"]",
          "Geometry \"bunny\"", "SolidBegin \"union\" SolidEnd", "Perspective 40"}) {
        RibWorlds r(std::string("WorldBegin ") + request + " " + request + " " + kOneSphere +
                    "WorldEnd");
        EXPECT_EQ(r.count("RI_NOT_DONE"), 1) << request << r.findings();
        EXPECT_EQ(r.worlds.size(), 1u);
        EXPECT_EQ(r.primitives().size(), 1u) << request;
    }
    const std::string option = "DepthOfField 2.8 .05 3 ";
    EXPECT_EQ(RibWorlds(option + option + "WorldBegin WorldEnd").count("RI_NOT_DONE"), 1);
    EXPECT_EQ(RibWorlds("DepthOfField WorldBegin WorldEnd").findings(), "");
}

}  // namespace
}  // namespace kinora::ri
