// tests/runtime/scene/ri/orientation_test.cpp: normals, mirrors and sides (RIB.md, section 6).
#include "rib_scene.h"

namespace kinora::ri {
namespace {

class RiOrientation : public testing::Test {
  protected:
    RiOrientation() { folder_.file("show_n.sl", kShowN); }

    std::string world(const std::string& inside, const std::string& before = "") const {
        return kSmall + folder_.search() + before + "WorldBegin Surface \"show_n\" " + inside +
               " WorldEnd";
    }
    // The normal in camera space of what the picture's pixel at (8, 7), its middle, shows.
    dvec3 normal(const std::string& inside, const std::string& before = "") const {
        RibPicture r(world(inside, before));
        EXPECT_TRUE(r.covers(8, 7)) << inside << r.findings();
        return 2.0 * dvec3(vec3(r.at(8, 7))) - 1.0;
    }
    bool covers(const std::string& inside, const std::string& before = "") const {
        return RibPicture(world(inside, before)).covers(8, 7);
    }

    RibFolder folder_;
};

// Outwards; at (8, 7) x = y = 1/16 of the radius.
const std::string kFarBall = "Translate 0 0 5 Sphere 1 -1 1 360";
const dvec3 kToEye(1 / 16., 1 / 16., -0.996086);
const dvec3 kFromEye(-1 / 16., -1 / 16., 0.996086);
// Clockwise as the eye sees it (x right, y up), so outside is towards the eye.
const std::string kClockwise = "Polygon \"P\" [-.5 -.5 5 -.5 .5 5 .5 .5 5 .5 -.5 5]";
const std::string kCounter = "Polygon \"P\" [-.5 -.5 5 .5 -.5 5 .5 .5 5 -.5 .5 5]";
const dvec3 kFlat(0, 0, -1), kFlatAway(0, 0, 1);
// dP/du = x, dP/dv = y: the normal is +z, away from the eye.
const std::string kPatch = "Patch \"bilinear\" \"P\" [-.5 -.5 5 .5 -.5 5 -.5 .5 5 .5 .5 5]";

TEST_F(RiOrientation, SpheresPointOutwards) {
    expect_near(normal(kFarBall), kToEye, .01);
}

TEST_F(RiOrientation, PolygonsAreClockwiseFromOutside) {
    expect_near(normal(kClockwise), kFlat);
    expect_near(normal(kCounter), kFlatAway);
}

TEST_F(RiOrientation, PatchesHaveTheProductOfTheirDerivatives) {
    expect_near(normal(kPatch), kFlatAway);
    expect_near(normal("Translate 0 0 5 Disk 0 1 360"), kFlatAway);
    expect_near(normal("Translate 0 0 5 Disk 0 1 -360"), kFlat);
}

// A mirror changes the handedness and the orientation.
TEST_F(RiOrientation, MirrorsTurnNothingInsideOut) {
    for (const char* mirror : {"Scale -1 1 1 ", "Scale 1 -1 1 ", "Scale -1 -1 1 "}) {
        expect_near(normal(mirror + kFarBall), kToEye, .01);
        // Polygons are clockwise from outside in the space where they are given.
        expect_near(normal(mirror + kClockwise), kFlat);
        expect_near(normal(mirror + kPatch), kFlatAway);
    }
    expect_near(normal("Scale 1 1 -1 Translate 0 0 -10 " + kFarBall), kToEye, .01);
    // z turned round: what points to +z in the object points to the eye.
    expect_near(normal("Scale 1 1 -1 Translate 0 0 -10 " + kPatch), kFlat);
    expect_near(normal("Scale 1 1 -1 Translate 0 0 -10 " + kClockwise), kFlatAway);
}

TEST_F(RiOrientation, MirrorsBeforeTheWorldTurnNothingInsideOut) {
    expect_near(normal(kFarBall, "Scale -1 1 1 "), kToEye, .01);
    expect_near(normal(kClockwise, "Scale -1 1 1 "), kFlat);
    expect_near(normal(kPatch, "Scale 1 -1 1 "), kFlatAway);
    expect_near(normal("Scale 1 -1 1 " + kFarBall, "Scale -1 1 1 "), kToEye, .01);
}

TEST_F(RiOrientation, OutsideInsideAndReverse) {
    for (const std::string mirror : {"", "Scale -1 1 1 "}) {
        expect_near(normal(mirror + "Orientation \"outside\" " + kFarBall), kToEye, .01);
        expect_near(normal(mirror + "Orientation \"inside\" " + kFarBall), kFromEye, .01);
        expect_near(normal(mirror + "ReverseOrientation " + kFarBall), kFromEye, .01);
        expect_near(normal(mirror + "ReverseOrientation ReverseOrientation " + kFarBall), kToEye,
                    .01);
        expect_near(normal(mirror + "Orientation \"inside\" ReverseOrientation " + kFarBall),
                    kToEye, .01);
        expect_near(normal(mirror + "Orientation \"inside\" " + kClockwise), kFlatAway);
        expect_near(normal(mirror + "Orientation \"inside\" " + kPatch), kFlat);
    }
}

TEST_F(RiOrientation, HandsAreAbsolute) {
    expect_near(normal("Orientation \"lh\" " + kFarBall), kToEye, .01);
    expect_near(normal("Orientation \"rh\" " + kFarBall), kFromEye, .01);
    expect_near(normal("Scale -1 1 1 Orientation \"lh\" " + kFarBall), kFromEye, .01);
    expect_near(normal("Scale -1 1 1 Orientation \"rh\" " + kFarBall), kToEye, .01);
    // A mirror after it changes both.
    expect_near(normal("Orientation \"rh\" Scale -1 1 1 " + kFarBall), kFromEye, .01);
    expect_near(normal("Orientation \"rh\" " + kFarBall, "Scale -1 1 1 "), kToEye, .01);
}

TEST_F(RiOrientation, AttributeBlocksRestoreIt) {
    expect_near(normal("AttributeBegin Orientation \"inside\" AttributeEnd " + kFarBall), kToEye,
                .01);
    expect_near(normal("TransformBegin Orientation \"inside\" TransformEnd " + kFarBall), kFromEye,
                .01);
}

TEST_F(RiOrientation, AngleSignsTurnQuadricsInsideOut) {
    expect_near(normal("Translate 0 0 5 Sphere 1 -1 1 -360"), kFromEye, .01);
    // At (8, 7) x = 1/16 of the cylinder's radius 1, axis y.
    expect_near(normal("Translate 0 0 5 Rotate 90 1 0 0 Cylinder 1 -1 1 360"),
                {1 / 16., 0, -0.998045}, .01);
    expect_near(normal("Translate 0 0 5 Rotate 90 1 0 0 Cylinder 1 -1 1 -360"),
                {-1 / 16., 0, 0.998045}, .01);
    // zmin above zmax turns dP/dv round.
    expect_near(normal("Translate 0 0 5 Rotate 90 1 0 0 Cylinder 1 1 -1 360"),
                {-1 / 16., 0, 0.998045}, .01);
}

TEST_F(RiOrientation, NormalsOfVariablesAreTakenAsTheyAre) {
    const std::string n = " \"N\" [.6 0 -.8 .6 0 -.8 .6 0 -.8 .6 0 -.8]";
    expect_near(normal(kClockwise + n), {.6, 0, -.8});
    expect_near(normal(kPatch + n), {.6, 0, -.8});
    expect_near(normal("Scale -1 1 1 " + kClockwise + n), {-.6, 0, -.8});
}

TEST_F(RiOrientation, OneSideHidesWhatPointsAway) {
    EXPECT_TRUE(covers("Sides 2 " + kPatch));
    EXPECT_FALSE(covers("Sides 1 " + kPatch));
    EXPECT_TRUE(covers("Sides 1 " + kClockwise));
    EXPECT_FALSE(covers("Sides 1 " + kCounter));
    EXPECT_TRUE(covers("Sides 1 ReverseOrientation " + kPatch));
    EXPECT_FALSE(covers("Sides 1 ReverseOrientation " + kClockwise));
    for (const char* mirror : {"Scale -1 1 1 ", "Scale 1 -1 1 "}) {
        EXPECT_TRUE(covers("Sides 1 " + (mirror + kClockwise))) << mirror;
        EXPECT_FALSE(covers("Sides 1 " + (mirror + kPatch))) << mirror;
        EXPECT_TRUE(covers("Sides 1 " + kClockwise, mirror)) << mirror;
        EXPECT_FALSE(covers("Sides 1 " + kPatch, mirror)) << mirror;
    }
    EXPECT_TRUE(covers("Sides 1 " + kFarBall));
}

// The near half is hidden, the far one, at z = 5 + 0.996, is seen from within.
TEST_F(RiOrientation, OneSideOfASphereInsideOutShowsItsFarHalf) {
    folder_.file("show_p.sl", kShowP);
    for (const char* sides : {"Sides 1 ", "Sides 2 "}) {
        RibPicture r(kSmall + folder_.search() +
                     "WorldBegin Surface \"show_p\" \"space\" \"camera\" " + sides +
                     "ReverseOrientation " + kFarBall + " WorldEnd");
        const double half = std::string_view(sides) == "Sides 1 " ? 0.996086 : -0.996086;
        EXPECT_NEAR(r.at(8, 7).z, 0.5 + 0.5 * (5 + half), .01) << sides << r.findings();
    }
}

TEST_F(RiOrientation, SidesAreOneOrTwo) {
    RibWorlds r("Sides 3 WorldBegin WorldEnd");
    EXPECT_EQ(r.count("RI_RANGE"), 1) << r.findings();
}

}  // namespace
}  // namespace kinora::ri
