// tests/raytrace/camera_test.cpp: COLLADA optics, axes and rays, against hand arithmetic.
#include "raytrace/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

namespace kinora::raytrace {
namespace {

CameraOptics perspective(std::optional<double> x, std::optional<double> y,
                         std::optional<double> aspect = {}) {
    CameraOptics o;
    if (x) o.x = radians(*x);
    if (y) o.y = radians(*y);
    o.aspect = aspect;
    o.znear = 0.1;
    o.zfar = 100;
    return o;
}

Camera make(const CameraOptics& optics, int width, int height, const dmat4& node = dmat4(1.0),
            dvec3 origin = dvec3(0.0)) {
    Camera camera;
    EXPECT_EQ(make_camera(optics, node, width, height, origin, 10, camera), CameraStatus::Ok);
    return camera;
}

TEST(Camera, OneFieldOfViewIsKept) {
    Camera x = make(perspective(90, {}), 200, 100);
    EXPECT_NEAR(x.half_width, 1, 1e-12);
    EXPECT_NEAR(x.half_height, 0.5, 1e-12);
    Camera y = make(perspective({}, 90), 200, 100);
    EXPECT_NEAR(y.half_width, 2, 1e-12);
    EXPECT_NEAR(y.half_height, 1, 1e-12);
}

TEST(Camera, AWindowOfKnownShapeIsFittedInsideThePicture) {
    const double w = 1, h = 0.5;  // xfov 90, aspect 2
    for (CameraOptics optics :
         {perspective(90, {}, 2), perspective(90, 2 * 180 / kPi * std::atan(0.5)),
          perspective({}, 2 * 180 / kPi * std::atan(0.5), 2)}) {
        Camera same = make(optics, 200, 100), square = make(optics, 100, 100),
               wide = make(optics, 400, 100);
        EXPECT_NEAR(same.half_width, w, 1e-12);
        EXPECT_NEAR(same.half_height, h, 1e-12);
        EXPECT_NEAR(square.half_width, w, 1e-12);
        EXPECT_NEAR(square.half_height, 1, 1e-12);
        EXPECT_NEAR(wide.half_width, 2, 1e-12);
        EXPECT_NEAR(wide.half_height, h, 1e-12);
        EXPECT_NEAR(picture_aspect(optics).value(), 2, 1e-12);
    }
    EXPECT_FALSE(picture_aspect(perspective(90, {})));
}

// COLLADA: right-handed, looks along -z, y up. Shading space: z into the picture.
TEST(Camera, LooksAlongMinusZOfItsNodeWithYUp) {
    Camera c = make(perspective(90, {}), 100, 100);
    CameraRay middle = camera_ray(c, 50, 50);
    EXPECT_EQ(middle.dir, vec3(0, 0, -1));
    CameraRay corner = camera_ray(c, 0, 0);  // top left
    const float s = 1 / std::sqrt(3.0f);
    EXPECT_NEAR(corner.dir.x, -s, 1e-6);
    EXPECT_NEAR(corner.dir.y, s, 1e-6);
    EXPECT_NEAR(corner.dir.z, -s, 1e-6);
    dvec4 p = c.camera_from_world * dvec4(2, 3, -7, 1);
    EXPECT_EQ(p, dvec4(2, 3, 7, 1));
}

TEST(Camera, MatricesAreEachOthersInverseAndRigid) {
    dmat4 node(dvec4(0, 3, 0, 0), dvec4(0, 0, 3, 0), dvec4(3, 0, 0, 0), dvec4(5, -6, 7, 1));
    Camera c = make(perspective(40, {}), 64, 48, node);
    dmat4 product = c.camera_from_world * c.world_from_camera;
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 4; ++k) EXPECT_NEAR(product[i][k], i == k, 1e-12);
    EXPECT_NEAR(c.camera_from_world[3][3], 1, 0);
    EXPECT_EQ(c.world_from_camera[3], dvec4(5, -6, 7, 1));
    EXPECT_EQ(c.forward, dvec3(-1, 0, 0));  // -z of the node, without its scale
    EXPECT_EQ(c.up, dvec3(0, 0, 1));
}

TEST(Camera, ScaleShearAndMirrorLeaveTheAxesRightHandedAndUnit) {
    dmat4 node(dvec4(-2, 0, 0, 0), dvec4(0.5, 3, 0.2, 0), dvec4(0, 0, 0.1, 0), dvec4(0, 0, 0, 1));
    Camera c = make(perspective(40, {}), 64, 48, node);
    EXPECT_NEAR(c.forward.z, -1, 1e-12);
    auto dot = [](dvec3 a, dvec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
    EXPECT_NEAR(dot(c.up, c.up), 1, 1e-12);
    EXPECT_NEAR(dot(c.right, c.right), 1, 1e-12);
    EXPECT_NEAR(dot(c.right, c.up), 0, 1e-12);
    EXPECT_NEAR(dot(c.forward, c.up), 0, 1e-12);
    EXPECT_GT(c.right.x, 0);
}

TEST(Camera, FarFromTheOriginRaysStartExactlyWhereTheyDoNear) {
    dmat4 node(1.0);
    const dvec3 origin(1e7, -1e7, 1e7), eye(0.123456789, 2.5, 3.25);
    node[3] = dvec4(origin + eye, 1);
    CameraRay far = camera_ray(make(perspective(40, {}), 64, 48, node, origin), 3.5, 7.5);
    node[3] = dvec4(eye, 1);
    CameraRay near = camera_ray(make(perspective(40, {}), 64, 48, node), 3.5, 7.5);
    EXPECT_EQ(far.dir, near.dir);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(far.org[c], near.org[c], 2e-9 + 1e-7);
}

TEST(Camera, OrthographicRaysAreParallelAndStartOnTheWindow) {
    CameraOptics o;
    o.orthographic = true;
    o.x = 4;
    o.y = 3;
    o.znear = 0.1;
    o.zfar = 10;
    Camera c = make(o, 80, 60);
    CameraRay corner = camera_ray(c, 0, 60), middle = camera_ray(c, 40, 30);
    EXPECT_EQ(corner.dir, middle.dir);
    EXPECT_EQ(corner.org, vec3(-4, -3, 0));
    EXPECT_EQ(middle.org, vec3(0, 0, 0));
    EXPECT_NEAR(corner.dorg_dx.x, 0.1, 1e-6);
    EXPECT_NEAR(corner.dorg_dy.y, -0.1, 1e-6);
    EXPECT_EQ(corner.ddir_dx, vec3(0.0f));
}

TEST(Camera, DifferentialsPredictTheNeighbouringRays) {
    Camera c = make(perspective(70, {}), 640, 480);
    for (double x : {1.5, 320.0, 600.5})
        for (double y : {2.5, 240.0, 470.5}) {
            CameraRay here = camera_ray(c, x, y), right = camera_ray(c, x + 0.5, y),
                      left = camera_ray(c, x - 0.5, y), down = camera_ray(c, x, y + 0.5),
                      up = camera_ray(c, x, y - 0.5);
            for (int k = 0; k < 3; ++k) {
                EXPECT_NEAR(here.ddir_dx[k], right.dir[k] - left.dir[k], 1e-6);
                EXPECT_NEAR(here.ddir_dy[k], down.dir[k] - up.dir[k], 1e-6);
            }
        }
}

TEST(Camera, RasterPositionsAreWhereRaysGo) {
    for (bool orthographic : {false, true})
        for (double mirror : {1.0, -1.0}) {
            CameraOptics optics;
            optics.orthographic = orthographic;
            optics.window = {{-0.7 * mirror, 1.1 * mirror, -0.4, 0.9}};
            dmat4 node = glm::rotate(dmat4(1.0), 0.7, dvec3(1, 2, 3));
            node[3] = dvec4(3, -2, 5, 1);
            Camera camera;
            ASSERT_EQ(make_camera(optics, node, 40, 25, dvec3(1, 1, 1), 10, camera),
                      CameraStatus::ClipRangeRepaired);
            for (const dvec2& at : {dvec2(3.5, 7.25), dvec2(39, 0.5), dvec2(-12, 80)})
                for (double t : {0.5, 30.0}) {
                    const CameraRay ray = camera_ray(camera, at.x, at.y);
                    const auto place = raster_position(camera, dvec3(ray.org) + t * dvec3(ray.dir));
                    ASSERT_TRUE(place);
                    EXPECT_NEAR(place->x, at.x, 1e-3);
                    EXPECT_NEAR(place->y, at.y, 1e-3);
                    EXPECT_FALSE(raster_position(camera, dvec3(ray.org) - t * dvec3(ray.dir)));
                }
        }
}

TEST(Camera, ClipPlanesBoundRaysOnlyWhenAsked) {
    Camera c = make(perspective(90, {}), 100, 100);
    EXPECT_EQ(camera_ray(c, 0, 0).tnear, 0);
    EXPECT_EQ(camera_ray(c, 0, 0).tfar, std::numeric_limits<float>::infinity());
    c.clip = true;
    EXPECT_NEAR(camera_ray(c, 50, 50).tfar, 100, 1e-4);
    EXPECT_NEAR(camera_ray(c, 0, 50).tfar, 100 * std::sqrt(2.0), 1e-4);
    EXPECT_NEAR(camera_ray(c, 0, 50).tnear, 0.1 * std::sqrt(2.0), 1e-6);
}

// docs/numerics.md#cameras.
TEST(Camera, ExtremeOpticsWorkAndImpossibleOnesAreErrors) {
    EXPECT_NEAR(make(perspective(0.001, {}), 10, 10).half_width, radians(0.0005), 1e-12);
    EXPECT_NEAR(make(perspective(179.9, {}), 10, 10).half_width, std::tan(radians(89.95)), 1e-6);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Camera c;
    auto status = [&](const CameraOptics& o, const dmat4& node = dmat4(1.0), int width = 10) {
        c.width = -1;
        CameraStatus s = make_camera(o, node, width, 10, dvec3(0.0), 10, c);
        EXPECT_EQ(is_error(s), c.width == -1);  // untouched on an error
        return s;
    };
    for (double fov : {0.0, 180.0, -10.0, 200.0, nan}) {
        EXPECT_EQ(status(perspective(fov, {})), CameraStatus::FieldOfViewOutOfRange);
        EXPECT_EQ(status(perspective(40, fov)), CameraStatus::FieldOfViewOutOfRange);
    }
    EXPECT_EQ(status(perspective({}, {}, 1)), CameraStatus::FieldOfViewOutOfRange);
    for (double aspect : {0.0, -1.0, nan})
        EXPECT_EQ(status(perspective(40, {}, aspect)), CameraStatus::AspectNotPositive);
    EXPECT_EQ(status(perspective(40, {}, 1e-4)), CameraStatus::Ok);
    EXPECT_EQ(status(perspective(40, {}), dmat4(0.0)), CameraStatus::BadMatrix);
    EXPECT_EQ(status(perspective(40, {}), dmat4(nan)), CameraStatus::BadMatrix);
    EXPECT_EQ(status(perspective(40, {}), dmat4(1.0), 0), CameraStatus::BadPicture);
    CameraOptics ortho;
    ortho.orthographic = true;
    ortho.x = 0;
    EXPECT_EQ(status(ortho), CameraStatus::MagnificationNotPositive);
}

TEST(Camera, ClipRangesWithoutSenseAreRepaired) {
    for (auto [znear, zfar] :
         {std::pair(0.0, 0.0), {1.0, 1.0}, {5.0, 1.0}, {-1.0, 10.0}, {1.0, 0.0}}) {
        CameraOptics o = perspective(40, {});
        o.znear = znear;
        o.zfar = zfar;
        Camera c;
        EXPECT_EQ(make_camera(o, dmat4(1.0), 10, 10, dvec3(0.0), 20, c),
                  CameraStatus::ClipRangeRepaired);
        EXPECT_GT(c.znear, 0);
        EXPECT_GT(c.zfar, c.znear);
        if (znear <= 0) {
            EXPECT_DOUBLE_EQ(c.znear, 20e-6);
        }
    }
}

TEST(Camera, WithoutAZfarSeesTheWholeSceneFromAnywhere) {
    for (double distance : {0.0, 50.0, 4e3, 1e9}) {
        CameraOptics o = perspective(40, {});
        o.zfar = 0;
        dmat4 node(1.0);
        node[3] = dvec4(0, distance, 0, 1);
        Camera c;
        ASSERT_FALSE(is_error(make_camera(o, node, 10, 10, dvec3(0.0), 2, c)));
        EXPECT_EQ(c.znear, 0.1);
        EXPECT_GT(c.zfar, distance + 2);
    }
}

}  // namespace
}  // namespace kinora::raytrace
