// tests/runtime/cameras_test.cpp: which camera a scene is seen by, and those that are added to it.
#include "runtime/scene/build/cameras.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/scene/build/coverage.h"
#include "scene_text.h"

namespace kinora {
namespace {

constexpr const char* kWhite = "surface s() { Oi = 1; Ci = 1; }";

SceneText bare_scene(const char* up = "Y", const std::string& transforms = "") {
    SceneText scene;
    scene.cameras = scene.camera_node = "";
    scene.asset = std::string("<unit name=\"meter\" meter=\"1\"/><up_axis>") + up + "_UP</up_axis>";
    scene.octahedron("ball").look("l", kWhite).place("ball", "l", transforms, "ball-node");
    return scene;
}

SceneOptions with_camera(const std::string& camera) {
    SceneOptions options;
    options.camera = camera;
    return options;
}

bool added(const Rendering& r) {
    return std::ranges::count(r.scene->added, "default camera") == 1;
}

// What is covered, as shares of the picture from -1 to 1; its outermost pixels.
struct Box {
    double left = 1, right = -1, bottom = 1, top = -1, pixel;
    int pixels = 0;

    explicit Box(const raytrace::Film& film) : pixel(2.0 / film.height) {
        for (int y = 0; y < film.height; ++y)
            for (int x = 0; x < film.width; ++x) {
                if (film.at(x, y).w <= 0) continue;
                ++pixels;
                left = std::min(left, 2.0 * x / film.width - 1);
                right = std::max(right, 2.0 * (x + 1) / film.width - 1);
                bottom = std::min(bottom, 1 - 2.0 * (y + 1) / film.height);
                top = std::max(top, 1 - 2.0 * y / film.height);
            }
    }
};

// Fills 85 % of the height or of the width, and keeps to that in the other.
void expect_framed(const Box& box, const std::string& what) {
    double width = box.right - box.left, height = box.top - box.bottom;
    EXPECT_LT(std::max(width, height), 2 * 0.85 + 3 * box.pixel) << what;
    EXPECT_GT(std::max(width, height), 2 * 0.85 - 4 * box.pixel) << what;
    EXPECT_NEAR(box.left + box.right, 0, 0.1) << what;
    EXPECT_NEAR(box.bottom + box.top, 0, 0.1) << what;
}

TEST(Cameras, ViewsLookAlongTheDirectionsOfTheUpAxisFrame) {
    // COLLADA 1.4.1, up_axis: X_UP has right -y, up x, in -z; Y_UP x, y, -z; Z_UP x, z, y.
    struct {
        const char* up;
        dvec3 right, above, back;
    } frames[] = {{"X", {0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
                  {"Y", {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                  {"Z", {1, 0, 0}, {0, 0, 1}, {0, -1, 0}}};
    struct {
        const char* word;
        dvec3 eye;  // right, up, back
        bool parallel;
    } views[] = {{"auto", {1, 0.6, 1}, false}, {"front", {0, 0, 1}, true},
                 {"back", {0, 0, -1}, true},   {"left", {-1, 0, 0}, true},
                 {"right", {1, 0, 0}, true},   {"top", {0, 1, 0}, true},
                 {"iso", {1, 1, 1}, true},     {"", {1, 0.6, 1}, false}};
    for (const auto& f : frames)
        for (const auto& view : views) {
            std::string what = std::string(f.up) + " " + view.word;
            Rendering r(bare_scene(f.up, "<translate>5 6 7</translate><scale>1 2 3</scale>").text(),
                        with_camera(view.word));
            ASSERT_TRUE(r.scene) << r.findings();
            EXPECT_TRUE(added(r));
            r.frame(128, 72);
            const raytrace::Camera& camera = r.pose->view;
            dvec3 back =
                glm::normalize(view.eye.x * f.right + view.eye.y * f.above + view.eye.z * f.back);
            for (int k = 0; k < 3; ++k) EXPECT_NEAR(camera.forward[k], -back[k], 1e-9) << what;
            EXPECT_EQ(camera.orthographic, view.parallel) << what;
            // What is up in the picture: straight from above what is right stays right.
            dvec3 right = std::string(view.word) == "top"
                              ? f.right
                              : glm::normalize(glm::cross(f.above, back));
            for (int k = 0; k < 3; ++k) EXPECT_NEAR(camera.right[k], right[k], 1e-9) << what;
            if (!view.parallel) {
                EXPECT_NEAR(camera.half_height, std::tan(radians(18.5)), 1e-9);
            }
            expect_framed(Box(r.film), what);
        }
}

TEST(Cameras, AutoFramesPicturesOfAnyShape) {
    for (auto [width, height] : {std::pair(160, 90), {90, 160}, {64, 64}, {256, 32}})
        for (const char* scale : {"1 1 1", "100 3 2", "1 50 4", "1e-6 2e-6 1e-6", "1e6 1e6 3e6"}) {
            SceneOptions options = with_camera("auto");
            options.width = width;
            options.height = height;
            SceneText scene = bare_scene();
            scene.nodes.clear();
            scene.cube("box").place("box", "l", std::string("<scale>") + scale + "</scale>");
            Rendering r(scene.text(), options);
            r.frame(width, height);
            Box box(r.film);
            double w = box.right - box.left, h = box.top - box.bottom;
            std::string what = std::to_string(width) + " wide: " + scale;
            double pixel = 2.0 / std::min(width, height);
            EXPECT_NEAR(std::max(w, h), 1.7, 4 * pixel) << what;
        }
}

TEST(Cameras, AnAddedCameraShowsAllInAPictureOfAnotherShape) {
    Rendering r(bare_scene("Y", "<scale>9 1 1</scale>").text());
    Box box(r.frame(40, 80).film);
    EXPECT_GT(box.left, -0.9);
    EXPECT_LT(box.right, 0.9);
    EXPECT_GT(box.pixels, 20);
}

SceneText moving_scene() {
    SceneText scene = bare_scene("Y", "<translate sid=\"t\">0 0 0</translate>");
    return scene.animate("ball-node/t.X", {0, 1}, {0, 20});
}

TEST(Cameras, AutoFramesTheWholeRangePlayedAndStandsStill) {
    SceneOptions options;
    options.end_time = 1;
    Rendering r(moving_scene().text(), options);
    Box all(r.film);
    dvec3 eye;
    for (double time : {0.0, 0.5, 1.0}) {
        Box box(r.frame(160, 90, time).film);
        EXPECT_GT(box.pixels, 0) << time;
        if (time > 0) {
            EXPECT_EQ(glm::length(r.pose->view.eye - eye), 0);
        }
        eye = r.pose->view.eye;
        all.left = std::min(all.left, box.left);
        all.right = std::max(all.right, box.right);
        all.bottom = std::min(all.bottom, box.bottom);
        all.top = std::max(all.top, box.top);
        all.pixel = box.pixel;
    }
    expect_framed(all, "the range");
}

TEST(Cameras, FollowMovesWithTheCentreOnly) {
    SceneOptions options;
    options.end_time = 1;
    options.view.follow = true;
    SceneText scene = moving_scene();
    scene.nodes.replace(scene.nodes.find("<instance_geometry"), 0,
                        "<rotate sid=\"r\">0 0 1 0</rotate>");
    scene.animate("ball-node/r.ANGLE", {0, 1}, {0, 360});
    Rendering r(scene.text(), options);
    ASSERT_TRUE(r.scene) << r.findings();
    dvec3 eye, forward;
    for (double time : {0.0, 0.25, 0.5, 1.0, 2.0}) {
        Box box(r.frame(160, 90, time).film);
        EXPECT_GT(box.top - box.bottom, 1.2) << time << ": near, although the ball goes far";
        if (time == 0) eye = r.pose->view.eye, forward = r.pose->view.forward;
        // The bounds' centre is the ball's: at 20 x in the first second, then at its end.
        dvec3 moved = r.pose->view.eye - eye;
        EXPECT_NEAR(moved.x, 20 * std::min(time, 1.0), 1e-5) << time;
        EXPECT_NEAR(moved.y, 0, 1e-5);
        EXPECT_NEAR(moved.z, 0, 1e-5);
        EXPECT_EQ(glm::length(r.pose->view.forward - forward), 0);
    }
}

TEST(Cameras, ATurntableGoesRoundTheUpAxisAtThePaceAskedFor) {
    for (const char* up : {"Y", "Z"}) {
        SceneOptions options;
        options.view.turn_seconds = 4;
        options.view.turn_start = 10;
        Rendering r(bare_scene(up, "<translate>3 0 1</translate><scale>1 1.5 0.3</scale>").text(),
                    options);
        ASSERT_TRUE(r.scene) << r.findings();
        dvec3 axis = *up == 'Y' ? dvec3(0, 1, 0) : dvec3(0, 0, 1);
        std::vector<dvec3> eyes;
        for (double time : {10.0, 11.0, 12.0, 14.0, 18.0, 9.0}) {
            Box box(r.frame(128, 72, time).film);
            EXPECT_LT(box.top, 0.85 + 2 * box.pixel) << time;
            EXPECT_GT(box.bottom, -0.85 - 2 * box.pixel) << time;
            eyes.push_back(r.pose->view.eye);  // about the ball's centre, which is the scene's
        }
        auto quarter = [&](dvec3 p) { return glm::cross(axis, p) + axis * glm::dot(axis, p); };
        auto same = [](dvec3 a, dvec3 b) { return glm::length(a - b) < 1e-6; };
        EXPECT_TRUE(same(eyes[1], quarter(eyes[0]))) << up;
        EXPECT_TRUE(same(eyes[2], quarter(quarter(eyes[0])))) << up;
        EXPECT_TRUE(same(eyes[3], eyes[0]) && same(eyes[4], eyes[0])) << up;
        EXPECT_TRUE(same(quarter(eyes[5]), eyes[0])) << up;
        EXPECT_EQ(r.scene->description->end_time, 0) << "the range played is the scene's";
    }
}

TEST(Cameras, LookFromAndAtSayWhereItStandsAndWhatItSees) {
    SceneOptions options;
    options.view.from = dvec3(3, 4, 12);
    options.view.at = dvec3(0, 4, 8);
    options.view.yfov = 50;
    Rendering r(bare_scene().text(), options);
    r.frame(32, 18);
    dvec3 eye = r.pose->view.eye + r.scene->origin;
    dvec3 forward = glm::normalize(dvec3(-3, 0, -4));
    for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(eye[k], (*options.view.from)[k], 1e-9);
        EXPECT_NEAR(r.pose->view.forward[k], forward[k], 1e-9);
    }
    EXPECT_NEAR(r.pose->view.half_height, std::tan(radians(25.0)), 1e-9);

    options.view.at.reset();  // the scene's centre
    Rendering centre(bare_scene("Y", "<translate>0 4 8</translate>").text(), options);
    centre.frame(32, 18);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(centre.pose->view.forward[k], forward[k], 1e-6);

    options = {};
    options.view.at = dvec3(2, 0, 0);  // in the middle, and all in the picture
    Rendering at(bare_scene().text(), options);
    Box box(at.frame(128, 72).film);
    dvec3 to = dvec3(2, 0, 0) - at.pose->view.eye - at.scene->origin;
    EXPECT_NEAR(glm::dot(glm::normalize(to), at.pose->view.forward), 1, 1e-9);
    EXPECT_NEAR(std::max({-box.left, box.right, -box.bottom, box.top}), 0.85, 3 * box.pixel);
}

TEST(Cameras, LookAtANodeTurnsAfterItOrGoesNear) {
    SceneText scene = moving_scene();
    scene.place("ball", "l", "<translate>0 0 -500</translate>", "far");
    SceneOptions options;
    options.end_time = 1;
    options.view.from = dvec3(0, 0, 20);
    options.view.at_node = "ball-node";
    Rendering turns(scene.text(), options);
    ASSERT_TRUE(turns.scene) << turns.findings();
    for (double time : {0.0, 0.5, 1.0}) {
        turns.frame(32, 18, time);
        dvec3 forward = glm::normalize(dvec3(20 * time, 0, -20));
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(turns.pose->view.forward[k], forward[k], 1e-5);
        EXPECT_NEAR((turns.pose->view.eye + turns.scene->origin).z, 20, 1e-6);
    }
    options = with_camera("front");
    options.view.at_node = "far";
    Rendering near(scene.text(), options);
    near.frame(64, 36);
    EXPECT_NEAR(near.pose->view.half_height, 1 / 0.85, 1e-6);  // the ball alone
    options.view.at_node = "nowhere";
    Rendering nowhere(scene.text(), options);
    EXPECT_FALSE(nowhere.scene);
    EXPECT_EQ(nowhere.count("NODE_UNKNOWN"), 1);
}

TEST(Cameras, AnotherFieldOfViewKeepsTheCamerasShape) {
    SceneText scene = bare_scene();
    scene.camera_node = R"(<node id="eye-node"><translate>0 0 6</translate>
        <instance_camera url="#eye"/></node>)";
    scene.cameras = R"(<camera id="eye"><optics><technique_common><perspective><xfov>40</xfov>
        <yfov>20</yfov><znear>0.1</znear><zfar>100</zfar></perspective></technique_common></optics>
        </camera>)";
    SceneOptions options;
    options.view.yfov = 30;
    Rendering r(scene.text(), options);
    EXPECT_FALSE(added(r)) << r.findings();
    double aspect = std::tan(radians(20.0)) / std::tan(radians(10.0));
    r.frame(int(std::lround(100 * aspect)), 100);
    EXPECT_NEAR(r.pose->view.half_height, std::tan(radians(15.0)), 1e-2);
    EXPECT_NEAR(r.pose->view.half_width, aspect * std::tan(radians(15.0)), 1e-2);

    options.camera = "front";  // which is parallel without
    Rendering front(scene.text(), options);
    front.frame(160, 90);
    EXPECT_FALSE(front.pose->view.orthographic);
    EXPECT_NEAR(front.pose->view.half_height, std::tan(radians(15.0)), 1e-9);

    options.camera.clear();
    SceneText parallel;
    parallel.square("floor").look("l", kWhite).place("floor", "l");
    Rendering none(parallel.text(), options);
    EXPECT_FALSE(none.scene);
    EXPECT_EQ(none.count("CAMERA_PARALLEL"), 1);
}

// A square of that half size before SceneText's camera, which shows [-1, 1] squared.
SceneText square_of(double size) {
    SceneText scene;
    return scene.square("floor", size).look("l", kWhite).place("floor", "l", "", "floor-node");
}

TEST(Cameras, AFilesCameraGivesWayUnderThreePercent) {
    Rendering seen(square_of(0.2).text());  // 4 %
    EXPECT_FALSE(added(seen)) << seen.findings();
    EXPECT_EQ(seen.count("CAMERA_SEES_LITTLE"), 0);
    Rendering little(square_of(0.15).text());  // 2.25 %
    ASSERT_TRUE(added(little));
    const Finding* finding = little.find("CAMERA_SEES_LITTLE");
    ASSERT_TRUE(finding);
    EXPECT_EQ(finding->severity, Severity::Warning);
    EXPECT_NE(finding->message.find("eye-node"), std::string::npos);
    EXPECT_NE(finding->help.find("--camera 'eye-node'"), std::string::npos) << finding->help;
    EXPECT_GT(little.where(*finding).line, 1);
    EXPECT_GT(Box(little.frame(64, 36).film).pixels, 200);
    for (const char* named : {"eye-node", "eye", "#eye-node", "#"}) {
        Rendering forced(square_of(0.15).text(), with_camera(named));
        EXPECT_FALSE(added(forced)) << named;
        EXPECT_EQ(forced.count("CAMERA_SEES_LITTLE"), 0) << named;
    }
}

TEST(Cameras, OneOfTheTimesOfTheRangeIsEnough) {
    SceneText scene = square_of(0.2);
    scene.nodes.replace(scene.nodes.find("<instance_geometry"), 0,
                        "<translate sid=\"t\">0 0 0</translate>");
    scene.animate("floor-node/t.X", {0, 1}, {-5, 0});
    SceneOptions options;
    options.end_time = 1;
    EXPECT_FALSE(added(Rendering(scene.text(), options)));
    options.end_time = 0.5;
    Rendering early(scene.text(), options);
    EXPECT_TRUE(added(early));
    EXPECT_EQ(early.scene->start.time, 0) << "it stands at its start again";
}

TEST(Cameras, AFilesCameraWithoutAPictureGivesWay) {
    SceneText scene = square_of(1);
    scene.cameras =
        "<camera id=\"eye\"><optics><technique_common><perspective><yfov>180</yfov><znear>1</znear>"
        "<zfar>10</zfar></perspective></technique_common></optics></camera>";
    Rendering r(scene.text());
    EXPECT_TRUE(added(r)) << r.findings();
    EXPECT_EQ(r.count("CAMERA_SEES_LITTLE"), 1);
    EXPECT_FALSE(r.diagnostics.has_errors());
}

TEST(Cameras, AViewsWordComesBeforeAFilesNameWithoutItsSign) {
    SceneText scene = square_of(0.15);
    scene.camera_node.replace(scene.camera_node.find("eye-node"), 8, "front");
    EXPECT_TRUE(added(Rendering(scene.text(), with_camera("front"))));
    EXPECT_FALSE(added(Rendering(scene.text(), with_camera("#front"))));
    Rendering little(scene.text());
    EXPECT_NE(little.find("CAMERA_SEES_LITTLE")->help.find("'#front'"), std::string::npos);
    Rendering unknown(scene.text(), with_camera("#nobody"));
    EXPECT_FALSE(unknown.scene);
    EXPECT_EQ(unknown.count("CAMERA_UNKNOWN"), 1);
}

TEST(Cameras, AutoLooksAgainWhereAllIsSeenEdgeOn) {
    // The plane x = z holds the direction (1, 0.6, 1).
    SceneText scene = bare_scene();
    scene.nodes.clear();
    scene.mesh("sheet", {{-1, -1, -1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, -1}}, {0, 1, 2, 0, 2, 3})
        .place("sheet", "l");
    EXPECT_GT(Box(Rendering(scene.text()).frame(64, 36).film).pixels, 300);
}

TEST(Cameras, AutoShowsALongThinThingFromItsSide) {
    // Along (1, 0.6, 1); from (-1, 0.6, 1) it is a line, which is under 3 %, too.
    SceneText scene = bare_scene();
    scene.nodes.clear();
    scene.cube("box").place("box", "l",
                            "<rotate>0 1 0 45</rotate><rotate>1 0 0 -23</rotate>"
                            "<scale>1 1 200</scale>");
    Box box(Rendering(scene.text()).frame(160, 90).film);
    EXPECT_GT(std::max(box.right - box.left, box.top - box.bottom), 1.5);
}

TEST(Cameras, AutoLeavesStrayVerticesOut) {
    std::vector<dvec3> points;
    std::vector<int> triangles;
    for (int y = 0; y <= 20; ++y)
        for (int x = 0; x <= 20; ++x) points.push_back({x * 0.1, y * 0.1, 0});
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 20; ++x)
            for (int k : {0, 1, 22, 0, 22, 21}) triangles.push_back(21 * y + x + k);
    auto picture = [&](bool used, double far) {
        SceneText scene = bare_scene();
        scene.nodes.clear();
        std::vector<dvec3> all = points;
        all.push_back({far, 0, 0});
        all.push_back({far, 1, 0});
        all.push_back({far, 0, 1});
        std::vector<int> faces = triangles;
        if (used)
            for (int k : {0, 1, 2}) faces.push_back(int(points.size()) + k);
        scene.mesh("grid", all, faces).place("grid", "l");
        return std::make_unique<Rendering>(scene.text());
    };
    auto alone = picture(false, 0), unused = picture(false, 1e9);
    EXPECT_GT(Box(alone->frame(64, 36).film).pixels, 300);
    EXPECT_TRUE(same_bytes(alone->film, unused->frame(64, 36).film)) << "no triangle has them";
    auto stray = picture(true, 1e4);
    EXPECT_GT(Box(stray->frame(64, 36).film).pixels, 300);
    EXPECT_EQ(stray->count("SCENE_STRAY"), 1);
    EXPECT_EQ(alone->count("SCENE_STRAY"), 0);
}

// Two cubes side by side; the second one stands at these heights at 0 .. n seconds and between.
struct Hiding {
    SceneText scene = bare_scene();
    SceneOptions options;

    explicit Hiding(const std::vector<double>& heights) {
        scene.nodes.clear();
        scene.cube("box").place("box", "l", "", "stays");
        scene.place("box", "l", "<translate sid=\"t\">3 0 0</translate>", "goes");
        std::vector<double> times;
        for (size_t k = 0; k < heights.size(); ++k) times.push_back(double(k));
        if (heights.size() > 1) scene.animate("goes/t.Y", times, heights);
        options.end_time = times.back();
    }
};

TEST(Cameras, AutoStaysWithWhatIsThereAtTheStart) {
    for (double far : {30.0, -1000.0, 1e5, -1e9}) {
        Hiding hiding({0, 0, far, far});
        Rendering r(hiding.scene.text(), hiding.options);
        ASSERT_TRUE(r.scene) << r.findings();
        // Both are in the picture at the start, and the one that stays is no speck at any time.
        Box start(r.frame(64, 36, 0).film);
        EXPECT_GT(start.right - start.left, 0.8) << far;
        EXPECT_LT(std::max(start.right, start.top), 1 - start.pixel) << far;
        EXPECT_GT(std::min(start.left, start.bottom), start.pixel - 1) << far;
        EXPECT_GT(Box(r.frame(64, 36, 3).film).pixels, 64 * 36 * 3 / 100) << far;
        ASSERT_EQ(r.count("SCENE_FAR_PART"), 1) << r.findings();
        const Finding& finding = *r.find("SCENE_FAR_PART");
        EXPECT_EQ(finding.severity, Severity::Warning);
        EXPECT_NE(finding.message.find("'goes'"), std::string::npos) << finding.message;
        EXPECT_NE(finding.help.find("--hide 'goes'"), std::string::npos) << finding.help;
    }
}

TEST(Cameras, AutoShowsWhatStaysWhereTheOtherIsFarAwayAtTheStart) {
    for (double far : {-1000.0, 1e5, -1e9}) {
        Hiding hiding({far, far, 0, 0, 0, 0});
        Rendering r(hiding.scene.text(), hiding.options);
        for (double time : {0.0, 5.0}) {
            Box box(r.frame(64, 36, time).film);
            EXPECT_GT(box.pixels, 64 * 36 * 3 / 100) << far << " " << time;
            EXPECT_LT(std::max(box.right, box.top), 1 - box.pixel) << far << " " << time;
        }
        EXPECT_EQ(r.count("SCENE_FAR_PART"), 1) << r.findings();
    }
}

TEST(Cameras, AutoFramesAllWhereThatShowsSomething) {
    Hiding hiding({0, 0, 8, 8});
    Rendering r(hiding.scene.text(), hiding.options);
    EXPECT_GT(Box(r.frame(64, 36, 3).film).top, 0.5);
    EXPECT_EQ(r.count("SCENE_FAR_PART") + r.count("SCENE_SPECKS"), 0) << r.findings();
}

TEST(Cameras, AutoShowsHalfOfWhatCannotBeSeenTogether) {
    SceneText scene = bare_scene();
    scene.nodes.clear();
    scene.cube("box").place("box", "l", "", "near");
    scene.place("box", "l", "<translate>0 1e6 0</translate>", "far");
    Rendering r(scene.text());
    EXPECT_GT(Box(r.frame(64, 36).film).pixels, 64 * 36 * 3 / 100) << r.findings();
    EXPECT_EQ(r.count("SCENE_FAR_PART"), 1) << r.findings();
    // Small things all over the picture are no reason to leave half of them out.
    SceneText many = bare_scene();
    many.nodes.clear();
    many.cube("box");
    for (int k = 0; k < 100; ++k)
        many.place("box", "l",
                   "<translate>" + std::to_string(130 * (k % 10)) + " " +
                       std::to_string(130 * (k / 10)) + " 0</translate><scale>3 3 3</scale>",
                   "n" + std::to_string(k));
    Rendering all(many.text());
    EXPECT_EQ(all.count("SCENE_FAR_PART") + all.count("SCENE_SPECKS"), 0) << all.findings();
}

TEST(Cameras, AnEmptyPictureOverTheWholeRangeNamesTheFarThing) {
    SceneOptions options;
    options.end_time = 1;
    SceneText scene = bare_scene("Y", "<translate sid=\"t\">0 0 0</translate>");
    scene.animate("ball-node/t.X", {0, 1}, {0, 1e4});
    Rendering r(scene.text(), options);
    ASSERT_EQ(r.count("SCENE_SPECKS"), 1) << r.findings();
    const Finding& finding = *r.find("SCENE_SPECKS");
    EXPECT_NE(finding.message.find("'ball-node'"), std::string::npos) << finding.message;
    EXPECT_NE(finding.message.find("1e+04"), std::string::npos) << finding.message;
    for (const char* camera : {"front", "iso"}) {  // asked for by name
        options.camera = camera;
        Rendering named(scene.text(), options);
        EXPECT_EQ(named.count("SCENE_SPECKS"), 0) << camera;
    }
}

TEST(Cameras, ASceneWithNothingToDrawIsAnError) {
    SceneText none, no_triangle, flat, zero;
    no_triangle.square("s").look("l", kWhite);
    flat.mesh("s", {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {0, 1, 2}).look("l", kWhite).place("s", "l");
    zero.square("s").look("l", kWhite).place("s", "l", "<scale>1 0 1</scale>");
    for (const SceneText& scene : {none, no_triangle, flat, zero})
        for (const char* camera : {"", "auto", "eye-node"}) {
            Rendering r(scene.text(), with_camera(camera));
            EXPECT_FALSE(r.scene);
            ASSERT_EQ(r.count("SCENE_EMPTY"), 1) << r.findings();
            EXPECT_EQ(r.find("SCENE_EMPTY")->severity, Severity::Error);
        }
}

}  // namespace
}  // namespace kinora
