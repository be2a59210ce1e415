// tests/runtime/picture/frame/motion_test.cpp: the AOV of motion against known moves. The default
// camera of SceneText shows 2 units by 16 pixels.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/runtime/scene_text.h"

namespace kinora {
namespace {

constexpr double kFrame = 1.0 / 24;
constexpr double kPixels = 8;  // of a unit

class MotionPicture {
  public:
    explicit MotionPicture(const SceneText& scene) {
        SceneOptions options;
        options.aovs = {"motion"};
        rendering_ = std::make_unique<Rendering>(scene.text(), options);
    }
    void frame(double time) { rendering_->frame(time); }
    // To the next frame and from the previous one, at a pixel.
    dvec2 next(int x, int y) const { return {value(0, x, y), value(1, x, y)}; }
    dvec2 previous(int x, int y) const { return {value(2, x, y), value(3, x, y)}; }
    const Rendering& picture() const { return *rendering_; }

  private:
    double value(size_t plane, int x, int y) const {
        return double(rendering_->film.aovs.at(plane).values[size_t(y) * 16 + size_t(x)]);
    }
    std::unique_ptr<Rendering> rendering_;
};

void expect_near(dvec2 got, dvec2 want) {
    EXPECT_NEAR(got.x, want.x, 1e-5);
    EXPECT_NEAR(got.y, want.y, 1e-5);
}

dvec2 turned(dvec2 p, double degrees) {
    const double c = std::cos(radians(degrees)), s = std::sin(radians(degrees));
    return {c * p.x - s * p.y, s * p.x + c * p.y};
}

SceneText square_scene(const std::string& transforms, double size = 1) {
    SceneText scene;
    return scene.square("s", size)
        .look("l", "surface l() { Ci = 1; }")
        .place("s", "l", transforms, "n");
}

TEST(Motion, OfAPannedCameraIsTheOppositeOfThePan) {
    SceneText scene = square_scene("<scale>9 9 9</scale>");
    scene.camera_node = R"(<node id="eye-node"><translate sid="t">0 0 10</translate>
        <instance_camera url="#eye"/></node>)";
    scene.animate("eye-node/t.X", {0, 1}, {0, 1}).animate("eye-node/t.Y", {0, 1}, {0, -3});
    MotionPicture motion(scene);
    motion.frame(0.5);
    for (int at : {0, 7, 15}) {
        expect_near(motion.next(at, at), kFrame * kPixels * dvec2(-1, 3));
        expect_near(motion.previous(at, at), kFrame * kPixels * dvec2(-1, 3));
    }
    motion.frame(1);  // the last key
    expect_near(motion.next(4, 4), {0, 0});
    expect_near(motion.previous(4, 4), kFrame * kPixels * dvec2(-1, 3));
}

TEST(Motion, OfATurningNodeIsItsTurn) {
    SceneText scene = square_scene("<rotate sid=\"r\">0 0 1 0</rotate>", 3);
    scene.animate("n/r.ANGLE", {0, 1}, {0, 90});
    MotionPicture motion(scene);
    for (double time : {0.3, 0.7, 0.3}) {
        motion.frame(time);
        for (auto [x, y] : {std::pair(2, 3), {13, 5}, {8, 14}}) {
            const dvec2 p = motion.picture().place(x, y);
            expect_near(motion.next(x, y), kPixels * (turned(p, 90 * kFrame) - p));
            expect_near(motion.previous(x, y), kPixels * (p - turned(p, -90 * kFrame)));
        }
    }
}

// A wall that comes nearer grows by the ratio of its distances.
TEST(Motion, OfAPerspectiveIsOfThePicturesPlaces) {
    SceneText scene = square_scene("<translate sid=\"t\">0 0 0</translate>", 9);
    scene.cameras = R"(<camera id="eye"><optics><technique_common><perspective>
        <xfov>60</xfov><aspect_ratio>1</aspect_ratio><znear>0.1</znear><zfar>100</zfar>
        </perspective></technique_common></optics></camera>)";
    scene.animate("n/t.Z", {0, 1}, {0, 6});
    MotionPicture motion(scene);
    motion.frame(0.5);
    const double now = 7, next = now - 6 * kFrame, before = now + 6 * kFrame;
    for (auto [x, y] : {std::pair(2, 3), {13, 5}}) {
        const dvec2 from_middle(x + 0.5 - 8, 8 - (y + 0.5));
        expect_near(motion.next(x, y), from_middle * (now / next - 1));
        expect_near(motion.previous(x, y), from_middle * (1 - now / before));
    }
}

// Above y = 0.5 the strip follows its upper joint, below -0.5 its lower one, which stands.
TEST(Motion, OfASkinIsThatOfItsJoints) {
    SceneText scene;
    scene.look("l", "surface l() { Ci = 1; }").bending_strip("b", "l", 32);
    MotionPicture motion(scene);
    const double time = 0.05;  // 4 degrees
    motion.frame(time);
    for (int y : {1, 2}) {
        const dvec2 p = motion.picture().place(7, y);
        expect_near(motion.next(7, y), kPixels * (turned(p, 80 * kFrame) - p));
        expect_near(motion.previous(7, y), kPixels * (p - turned(p, -80 * kFrame)));
    }
    expect_near(motion.next(7, 14), {0, 0});
    EXPECT_EQ(motion.next(0, 14), dvec2(0.0));  // beside the strip
}

TEST(Motion, OfAMorphIsThatOfItsTarget) {
    SceneText scene;
    scene.square("s", 2).mesh("moved", {{-1, -2, 0}, {3, -2, 0}, {3, 2, 0}, {-1, 2, 0}},
                              {0, 1, 2, 0, 2, 3});
    scene.controllers += R"(<controller id="m"><morph source="#s" method="NORMALIZED">
        <source id="m-t"><IDREF_array id="m-ta" count="1">moved</IDREF_array><technique_common>
        <accessor source="#m-ta" count="1"><param name="T" type="IDREF"/></accessor></technique_common></source>
        <source id="m-w"><float_array id="m-wa" count="1">0</float_array><technique_common>
        <accessor source="#m-wa" count="1"><param name="W" type="float"/></accessor></technique_common></source>
        <targets><input semantic="MORPH_TARGET" source="#m-t"/><input semantic="MORPH_WEIGHT" source="#m-w"/>
        </targets></morph></controller>)";
    scene.look("l", "surface l() { Ci = 1; }");
    scene.nodes += R"(<node id="n"><instance_controller url="#m"><bind_material><technique_common>
        <instance_material symbol="skin" target="#l"/></technique_common></bind_material>
        </instance_controller></node>)";
    scene.animate("m-w(0)", {0, 1}, {0, 1});
    MotionPicture motion(scene);
    motion.frame(0.25);
    EXPECT_EQ(motion.picture().findings(), "");
    expect_near(motion.next(8, 8), kFrame * kPixels * dvec2(1, 0));
    expect_near(motion.previous(8, 8), kFrame * kPixels * dvec2(1, 0));
}

}  // namespace
}  // namespace kinora
