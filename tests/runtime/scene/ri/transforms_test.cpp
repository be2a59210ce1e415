// tests/runtime/scene/ri/transforms_test.cpp: where requests of transformation put points, by
// row vectors: v M, and each request before those that were there.
#include <cmath>

#include "rib_scene.h"
#include "runtime/scene/ri/bytestream/read_stream.h"
#include "runtime/scene/ri/calls/context.h"
#include "runtime/scene/ri/state/interpreter.h"

namespace kinora::ri {
namespace {

dvec3 placed(const std::string& requests, dvec3 p, const std::string& before = "") {
    RibWorlds r(before + "WorldBegin " + requests + " Sphere 1 -1 1 360 WorldEnd");
    EXPECT_EQ(r.findings(), "");
    return r.primitive().place(p);
}

TEST(RiTransforms, TranslateScaleAndTheirOrder) {
    expect_near(placed("Translate 1 2 3", {1, 1, 1}), {2, 3, 4});
    expect_near(placed("Scale 2 3 4", {1, 1, 1}), {2, 3, 4});
    expect_near(placed("Translate 1 0 0 Scale 2 2 2", {1, 0, 0}), {3, 0, 0});
    expect_near(placed("Scale 2 2 2 Translate 1 0 0", {1, 0, 0}), {4, 0, 0});
}

// [x y] [c s; -s c]: x turns to y, y to z, z to x.
TEST(RiTransforms, RotateTurnsEachAxisToTheNext) {
    expect_near(placed("Rotate 90 0 0 1", {1, 0, 0}), {0, 1, 0});
    expect_near(placed("Rotate 90 1 0 0", {0, 1, 0}), {0, 0, 1});
    expect_near(placed("Rotate 90 0 1 0", {0, 0, 1}), {1, 0, 0});
    const double c = std::cos(radians(30)), s = std::sin(radians(30));
    expect_near(placed("Rotate 30 0 0 5", {1, 2, 3}), {c - 2 * s, s + 2 * c, 3});
    expect_near(placed("Rotate -90 0 0 1", {1, 0, 0}), {0, -1, 0});
    expect_near(placed("Rotate 120 1 1 1", {1, 0, 0}), {0, 1, 0});
}

// (0,1,0) turns by 45 degrees to (1,0,0): y moves along x as far as it is high.
TEST(RiTransforms, SkewMovesAlongTheSecondAxis) {
    expect_near(placed("Skew 45 0 1 0 1 0 0", {0, 1, 0}), {1, 1, 0});
    expect_near(placed("Skew 45 0 1 0 1 0 0", {3, 0, 0}), {3, 0, 0});
    expect_near(placed("Skew 45 0 1 0 1 0 0", {0, 0, 2}), {0, 0, 2});
    expect_near(placed("Skew 30 0 2 0 0 0 3", {1, 1, 0}), {1, 1, std::tan(radians(30))});
    expect_near(placed("Skew [45 0 1 0 1 0 0]", {0, 2, 0}), {2, 2, 0});
}

TEST(RiTransforms, MatricesAreRowsWithTheTranslationLast) {
    const char* matrix = "[0 1 0 0  -1 0 0 0  0 0 1 0  5 6 7 1]";
    expect_near(placed(std::string("ConcatTransform ") + matrix, {1, 0, 0}), {5, 7, 7});
    expect_near(placed(std::string("ConcatTransform ") + matrix, {0, 1, 0}), {4, 6, 7});
    expect_near(placed(std::string("Translate 1 0 0 ConcatTransform ") + matrix, {1, 0, 0}),
                {6, 7, 7});
    expect_near(placed(std::string("Translate 1 0 0 Transform ") + matrix, {1, 0, 0}), {5, 7, 7});
}

// World-to-camera stays.
TEST(RiTransforms, IdentityAndTransformSetObjectToWorld) {
    expect_near(placed("Translate 1 2 3 Identity", {1, 1, 1}, "Translate 0 0 5 "), {1, 1, 6});
    expect_near(placed("Scale 9 9 9 Transform [1 0 0 0 0 1 0 0 0 0 1 0 2 0 0 1]", {0, 0, 0},
                       "Rotate 90 0 0 1 Translate 0 0 5 "),
                {0, 2, 5});
}

TEST(RiTransforms, CoordSysTransformGoesToANamedSystem) {
    expect_near(placed("AttributeBegin Translate 1 2 3 Scale 2 2 2 CoordinateSystem \"there\" "
                       "AttributeEnd Rotate 77 1 2 3 CoordSysTransform \"there\"",
                       {1, 0, 0}, "Translate 0 0 5 "),
                {3, 2, 8});
    expect_near(placed("Translate 4 4 4 CoordSysTransform \"camera\"", {1, 2, 3}, "Scale 2 2 2 "),
                {1, 2, 3});
    expect_near(placed("Translate 4 4 4 CoordSysTransform \"world\"", {1, 2, 3}, "Scale 2 2 2 "),
                {2, 4, 6});
    RibWorlds unknown(
        "WorldBegin Translate 1 0 0 CoordSysTransform \"nowhere\" Sphere 1 -1 1 360 WorldEnd");
    EXPECT_EQ(unknown.count("RI_SPACE"), 1);
    expect_near(unknown.primitive().place({}), {1, 0, 0});
}

TEST(RiTransforms, ScopedCoordinateSystemsEndWithTheirBlock) {
    RibWorlds r(
        "WorldBegin AttributeBegin Translate 1 0 0 ScopedCoordinateSystem \"a\" Identity "
        "CoordSysTransform \"a\" Sphere 1 -1 1 360 AttributeEnd CoordSysTransform \"a\" "
        "Sphere 1 -1 1 360 WorldEnd");
    EXPECT_EQ(r.count("RI_SPACE"), 1) << r.findings();
    expect_near(r.primitive(0).place({}), {1, 0, 0});
    expect_near(r.primitive(1).place({}), {0, 0, 0});
}

TEST(RiTransforms, PerspectiveIsSaidToBeLeftOut) {
    RibWorlds r("WorldBegin Perspective 40 Perspective 50 Sphere 1 -1 1 360 WorldEnd");
    EXPECT_EQ(r.count("RI_NOT_DONE"), 1) << r.findings();
}

// RiTransformPoints, of an interpreter whose world is open.
class RiTransformPointsTest : public testing::Test {
  protected:
    // Reads the text, and transforms at its end.
    dvec3 transformed(const std::string& text, const char* from, const char* to, dvec3 p) {
        Diagnostics diagnostics;
        InterpreterHost host;
        host.take_world = [](SceneDescription&&) {};
        auto sink = std::make_unique<Interpreter>("x.rib", ImportOptions{}, WorldChoice{}, host,
                                                  diagnostics);
        Interpreter& interpreter = *sink;
        Context context(std::move(sink), diagnostics);
        Context* before = Context::current();
        Context::make_current(&context);
        BytestreamReader(context).read("x.rib", text);
        float numbers[3] = {float(p.x), float(p.y), float(p.z)};
        known_ = interpreter.transform_points(from, to, numbers);
        Context::make_current(before);
        return {numbers[0], numbers[1], numbers[2]};
    }
    bool known_ = false;
};

TEST_F(RiTransformPointsTest, BetweenObjectWorldAndCamera) {
    const std::string text =
        "Translate 0 0 5 WorldBegin Translate 1 0 0 Scale 2 2 2 "
        "CoordinateSystem \"mine\" Identity Translate 0 3 0";
    expect_near(transformed(text, "object", "world", {1, 1, 1}), {1, 4, 1});
    expect_near(transformed(text, "object", "camera", {1, 1, 1}), {1, 4, 6});
    expect_near(transformed(text, "mine", "world", {1, 1, 1}), {3, 2, 2});
    expect_near(transformed(text, "world", "mine", {3, 2, 2}), {1, 1, 1});
    transformed(text, "mine", "nowhere", {});
    EXPECT_FALSE(known_);
}

// 100 pixels for 2 units at z = 1.
TEST_F(RiTransformPointsTest, ToTheScreenAndItsPixels) {
    const std::string flat = "Format 100 100 1 WorldBegin";
    expect_near(transformed(flat, "camera", "screen", {.5, .25, 3}), {.5, .25, 3});
    dvec3 raster = transformed(flat, "camera", "raster", {.5, .5, 3});
    EXPECT_NEAR(raster.x, 75, 1e-3);
    EXPECT_NEAR(raster.y, 25, 1e-3);
    dvec3 ndc = transformed(flat, "camera", "NDC", {.5, .5, 3});
    EXPECT_NEAR(ndc.x, .75, 1e-5);
    EXPECT_NEAR(ndc.y, .25, 1e-5);
    dvec3 cropped = transformed("Format 100 100 1 CropWindow .5 1 0 .5 WorldBegin", "camera",
                                "raster", {.5, .5, 3});
    EXPECT_NEAR(cropped.x, 75, 1e-3);
    EXPECT_NEAR(cropped.y, 25, 1e-3);
    // In perspective: x / (z tan(45 deg)).
    dvec3 far = transformed("Format 100 100 1 Projection \"perspective\" WorldBegin", "camera",
                            "raster", {2, 2, 4});
    EXPECT_NEAR(far.x, 75, 1e-3);
    EXPECT_NEAR(far.y, 25, 1e-3);
    expect_near(transformed("Format 100 100 1 Projection \"perspective\" WorldBegin", "raster",
                            "camera", {75, 25, 4}),
                {2, 2, 4});
    // tan(30 deg) = 0.5773503; the transformation at Projection comes first.
    dvec3 screen = transformed("Translate 0 0 1 Projection \"perspective\" \"fov\" 60 WorldBegin",
                               "camera", "screen", {1, 2, 3});
    EXPECT_NEAR(screen.x, 0.4330127, 1e-5);
    EXPECT_NEAR(screen.y, 0.8660254, 1e-5);
}

}  // namespace
}  // namespace kinora::ri
