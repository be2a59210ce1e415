// tests/runtime/player/free_camera_test.cpp: a camera moved by hand, by geometry.
#include "runtime/player/session/free_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace kinora {
namespace {

constexpr dvec3 kUp(0, 1, 0);

FreeCamera from_front() {
    FreeCamera camera;
    camera.distance = 4;
    camera.half_height = 0.5;
    return camera;
}

void expect_near(dvec3 a, dvec3 b, double bound = 1e-12) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], bound) << k;
}

TEST(FreeCamera, OrbitsAboutItsPivot) {
    FreeCamera camera = from_front();
    orbit(camera, kUp, 90, 0);
    expect_near(camera.eye(), {4, 0, 0});
    orbit(camera, kUp, -90, 30);
    expect_near(camera.eye(), {0, 4 * std::sin(radians(30)), 4 * std::cos(radians(30))});
    expect_near(camera.pivot, dvec3(0.0));
}

TEST(FreeCamera, DoesNotPassOverThePole) {
    FreeCamera camera = from_front();
    for (int k = 0; k < 50; ++k) orbit(camera, kUp, 7, 10);
    EXPECT_GT(camera.axes[1].y, 0);
    EXPECT_LT(camera.axes[2].y, 1);
    EXPECT_NEAR(glm::length(camera.axes[0]), 1, 1e-9);
    EXPECT_NEAR(glm::dot(camera.axes[0], camera.axes[1]), 0, 1e-9);
    double high = camera.axes[2].y;
    orbit(camera, kUp, 0, -10);
    EXPECT_LT(camera.axes[2].y, high);  // and comes back from there
}

TEST(FreeCamera, PansByThePicturesHeight) {
    FreeCamera camera = from_front();
    pan(camera, 0, 1);  // the picture is 2 * 0.5 * 4 high at the pivot
    expect_near(camera.pivot, {0, 4, 0});
    pan(camera, 0.5, 0);
    expect_near(camera.pivot, {2, 4, 0});
}

TEST(FreeCamera, DolliesAndFlies) {
    FreeCamera camera = from_front();
    dolly(camera, 2);
    expect_near(camera.eye(), {0, 0, 2});
    fly(camera, {1, 2, 3});
    expect_near(camera.eye(), {1, 2, -1});
}

TEST(FreeCamera, LooksWithoutMoving) {
    FreeCamera camera = from_front();
    look(camera, kUp, 90, 0);  // to the right
    expect_near(camera.eye(), {0, 0, 4});
    expect_near(camera.axes[2], {-1, 0, 0});
}

TEST(FreeCamera, LooksAlongTheAxes) {
    FreeCamera camera = from_front();
    look_along(camera, AxisView::Front, UpAxis::Z);
    expect_near(camera.axes[2], {0, -1, 0});
    expect_near(camera.axes[1], {0, 0, 1});
    look_along(camera, AxisView::Top, UpAxis::Y);
    expect_near(camera.axes[2], {0, 1, 0});
    expect_near(camera.axes[1], {0, 0, -1});
    expect_near(camera.axes[0], {1, 0, 0});
    look_along(camera, AxisView::Right, UpAxis::Y);
    expect_near(camera.axes[2], {1, 0, 0});
    look_along(camera, AxisView::Left, UpAxis::Y);
    expect_near(camera.axes[0], {0, 0, 1});
}

// All corners lie in the picture, and one is near its edge.
TEST(FreeCamera, FramesABox) {
    for (bool parallel : {false, true})
        for (double aspect : {0.5, 1.0, 2.0}) {
            FreeCamera camera = from_front();
            camera.parallel = parallel;
            orbit(camera, kUp, 33, 21);
            dvec3 low(1, 2, 3), high(2, 5, 4);
            frame_box(camera, low, high, aspect);
            double most = 0;
            for (int k = 0; k < 8; ++k) {
                dvec3 p((k & 1 ? low : high).x, (k & 2 ? low : high).y, (k & 4 ? low : high).z);
                dvec3 to = p - camera.eye();
                double depth = parallel ? camera.distance : -glm::dot(to, camera.axes[2]);
                double y = glm::dot(to, camera.axes[1]) / (depth * camera.half_height);
                double x = glm::dot(to, camera.axes[0]) / (depth * camera.half_height * aspect);
                most = std::max({most, std::abs(x), std::abs(y)});
            }
            EXPECT_LT(most, 0.9);
            EXPECT_GT(most, 0.6);
        }
}

TEST(FreeCamera, TakesOverAViewAsItIs) {
    raytrace::Camera view;
    FreeCamera before = from_front();
    orbit(before, kUp, 40, 25);
    ASSERT_EQ(raytrace::make_camera(before.optics(), before.world_from_camera(), 64, 36,
                                    dvec3(7, 8, 9), 10, view),
              raytrace::CameraStatus::ClipRangeRepaired);
    FreeCamera after = free_camera_of(view, dvec3(7, 8, 9), 4);
    expect_near(after.eye(), before.eye(), 1e-9);
    expect_near(after.pivot, before.pivot, 1e-9);
    expect_near(after.axes[1], before.axes[1], 1e-9);
    EXPECT_NEAR(after.half_height, before.half_height, 1e-12);
}

}  // namespace
}  // namespace kinora
