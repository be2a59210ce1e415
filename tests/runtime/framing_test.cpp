// tests/runtime/framing_test.cpp: framing and coverage against projections and rays, one by one.
#include "runtime/scene/build/framing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "raytrace/accel.h"
#include "runtime/scene/build/coverage.h"
#include "runtime/scene/build/views.h"
#include "runtime/scene/camera.h"
#include "scene_text.h"

namespace kinora {
namespace {

constexpr double kHalfWidth = 0.6, kHalfHeight = 0.3;

// Points in a box of random shape somewhere, and axes of a random view.
struct Cloud {
    std::vector<dvec3> points;
    ViewAxes axes;

    explicit Cloud(uint32_t seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> number(-1, 1);
        auto vector = [&] { return dvec3(number(random), number(random), number(random)); };
        dvec3 size = vector() + 0.01, middle = 20.0 * vector();
        for (int i = 0; i < 40; ++i) points.push_back(middle + size * vector());
        axes = axes_towards(vector(), up_axis_frame(UpAxis::Y));
    }
};

// Bounds of the projections, in half pictures.
struct Seen {
    double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300}, nearest = 1e300;

    void add(dvec3 p, dvec3 eye, const ViewAxes& axes, bool parallel = false) {
        double depth = glm::dot(eye - p, axes.back), by = parallel ? 1 : depth;
        double at[2] = {glm::dot(p - eye, axes.right) / by / kHalfWidth,
                        glm::dot(p - eye, axes.up) / by / kHalfHeight};
        for (int k = 0; k < 2; ++k) {
            low[k] = std::min(low[k], at[k]);
            high[k] = std::max(high[k], at[k]);
        }
        nearest = std::min(nearest, depth);
    }
    // Both ends of a side at the limit: no nearer eye has them inside, wherever else it stands.
    bool tight(int k, double within) const {
        return std::abs(low[k] + kFramedShare) < within &&
               std::abs(high[k] - kFramedShare) < within;
    }
};

TEST(Framing, PutsPointsInsideAndTouchesBothEndsOfOneSide) {
    for (uint32_t seed = 0; seed < 200; ++seed) {
        Cloud cloud(seed);
        Framing framing(cloud.axes, kHalfWidth, kHalfHeight);
        for (dvec3 p : cloud.points) framing.add(p);
        Seen seen;
        for (dvec3 p : cloud.points) seen.add(p, framing.perspective_eye(), cloud.axes);
        EXPECT_GT(seen.nearest, 0) << seed;
        for (int k = 0; k < 2; ++k) {
            EXPECT_GT(seen.low[k], -kFramedShare - 1e-9) << seed;
            EXPECT_LT(seen.high[k], kFramedShare + 1e-9) << seed;
            EXPECT_NEAR(seen.low[k] + seen.high[k], 0, 0.05) << seed << " is in the middle";
        }
        EXPECT_TRUE(seen.tight(0, 1e-9) || seen.tight(1, 1e-9)) << seed;
    }
}

TEST(Framing, OfParallelRaysFillsOneSide) {
    for (uint32_t seed = 0; seed < 50; ++seed) {
        Cloud cloud(seed);
        Framing framing(cloud.axes, kHalfWidth, kHalfHeight);
        for (dvec3 p : cloud.points) framing.add(p);
        Framing::Parallel at = framing.parallel_eye();
        Seen seen;
        for (dvec3 p : cloud.points) seen.add(p, at.eye, cloud.axes, true);
        EXPECT_GT(seen.nearest, 0) << seed;
        for (int k = 0; k < 2; ++k) {
            double fit = kHalfHeight / at.half_height;  // Seen counts in windows of kHalfHeight
            seen.low[k] *= fit;
            seen.high[k] *= fit;
            EXPECT_NEAR(seen.low[k] + seen.high[k], 0, 1e-9) << seed;
            EXPECT_LT(seen.high[k], kFramedShare + 1e-9) << seed;
        }
        EXPECT_TRUE(seen.tight(0, 1e-9) || seen.tight(1, 1e-9)) << seed;
    }
}

TEST(Framing, OfATurntableHoldsAtEveryAngle) {
    for (dvec3 direction : {dvec3(1, 0.6, 1), dvec3(0, 0, 1), dvec3(0, 1, 0), dvec3(1, 1, 1)})
        for (uint32_t seed = 0; seed < 20; ++seed) {
            Cloud cloud(seed);
            ViewAxes frame = up_axis_frame(UpAxis::Y);
            ViewAxes axes = axes_towards(direction, frame);
            Framing framing(axes, kHalfWidth, kHalfHeight);
            framing.turn_about(frame.up);
            for (dvec3 p : cloud.points) framing.add(p - cloud.points[0]);
            Seen seen;
            for (int step = 0; step < 720; ++step) {
                double c = std::cos(step * kPi / 360), s = std::sin(step * kPi / 360);
                for (dvec3 q : cloud.points) {
                    dvec3 p = q - cloud.points[0];
                    seen.add({c * p.x + s * p.z, p.y, c * p.z - s * p.x}, framing.perspective_eye(),
                             axes);
                }
            }
            for (int k = 0; k < 2; ++k) {
                EXPECT_GT(seen.low[k], -kFramedShare - 1e-9) << seed;
                EXPECT_LT(seen.high[k], kFramedShare + 1e-9) << seed;
            }
            EXPECT_TRUE(seen.tight(0, 1e-3) || seen.tight(1, 1e-3)) << seed;
        }
}

TEST(Framing, KeepsItsCentreWhereItIsAskedTo) {
    Cloud cloud(7);
    Framing framing(cloud.axes, kHalfWidth, kHalfHeight);
    framing.keep_centre();
    for (dvec3 p : cloud.points) framing.add(p);
    dvec3 eye = framing.perspective_eye();
    EXPECT_NEAR(glm::length(eye - glm::dot(eye, cloud.axes.back) * cloud.axes.back), 0, 1e-9);
    Seen seen;
    for (dvec3 p : cloud.points) seen.add(p, eye, cloud.axes);
    double most = std::max({-seen.low[0], seen.high[0], -seen.low[1], seen.high[1]});
    EXPECT_NEAR(most, kFramedShare, 1e-9);
}

TEST(Framing, OfOnePointOrALineAlongTheViewStaysBeforeIt) {
    ViewAxes axes = up_axis_frame(UpAxis::Y);
    for (double length : {0.0, 5.0}) {
        Framing framing(axes, kHalfWidth, kHalfHeight);
        for (double z : {0.0, length}) framing.add({1, 2, z});
        EXPECT_GT(framing.perspective_eye().z, length);
        EXPECT_NEAR(framing.perspective_eye().x, 1, 1e-9);
        EXPECT_GT(framing.parallel_eye().half_height, 0);
    }
}

// The ray tracer's answer to the same rays.
double traced_share(const Pose& pose) {
    constexpr int kGrid = 64;
    const raytrace::Camera& camera = pose.view;
    int met = 0;
    raytrace::TraceCounters counters;
    for (int i = 0; i < kGrid * kGrid; ++i) {
        raytrace::CameraRay ray =
            raytrace::camera_ray(camera, (i % kGrid + 0.5) * camera.width / kGrid,
                                 (double(i / kGrid) + 0.5) * camera.height / kGrid);
        raytrace::RayPacket16 rays{};
        rays.org_x[0] = ray.org.x, rays.org_y[0] = ray.org.y, rays.org_z[0] = ray.org.z;
        rays.dir_x[0] = ray.dir.x, rays.dir_y[0] = ray.dir.y, rays.dir_z[0] = ray.dir.z;
        rays.tnear[0] = ray.tnear, rays.tfar[0] = ray.tfar;
        rays.mask[0] = raytrace::kMaskAll | raytrace::kMaskCamera;
        rays.active = 1;
        raytrace::HitPacket16 hits;
        met += int(pose.accel.intersect16(rays, hits, counters) & 1);
    }
    return double(met) / (kGrid * kGrid);
}

TEST(Coverage, IsWhatRaysMeet) {
    SceneText scene;
    scene.look("l", "surface s() { Ci = 1; Oi = 1; }").cube("cube", 0.7).octahedron("ball");
    scene.place("cube", "l", "<translate>0.3 -2 1</translate><rotate>1 2 3 40</rotate>")
        .place("ball", "l", "<translate>-1 0.5 0</translate><scale>0.5 -1 2</scale>");
    const char* ways[] = {"<lookat>0 0 10 0 0 0 0 1 0</lookat>",
                          "<lookat>1 1 2 0 0 0 0 1 0</lookat>",
                          "<lookat>0.3 -2 1 1 5 2 0 1 0</lookat>",    // inside the cube
                          "<lookat>-0.9 0.6 0 5 3 1 0 1 0</lookat>",  // inside the ball
                          "<lookat>0.3 -1.2 1 0 -3 0.2 1 0 0</lookat>"};
    const char* optics[] = {
        "<perspective><yfov>70</yfov><znear>1.5</znear><zfar>9.7</zfar></perspective>",
        "<perspective><xfov>20</xfov><aspect_ratio>2</aspect_ratio><znear>0.01</znear>"
        "<zfar>100</zfar></perspective>",
        "<orthographic><xmag>2.0371</xmag><znear>0.01</znear><zfar>100</zfar></orthographic>"};
    int seen = 0;
    for (const char* way : ways)
        for (const char* optic : optics) {
            scene.cameras = std::string("<camera id=\"eye\"><optics><technique_common>") + optic +
                            "</technique_common></optics></camera>";
            scene.camera_node = std::string("<node id=\"eye-node\">") + way +
                                "<instance_camera url=\"#eye\"/></node>";
            SceneOptions options;
            options.camera = "eye-node";
            Rendering r(scene.text(), options);
            ASSERT_TRUE(r.scene) << r.findings();
            r.frame(96, 64);
            double traced = traced_share(*r.pose);
            // Rays through edges are decided by rounding.
            EXPECT_NEAR(covered_share(*r.scene, *r.pose, r.pose->view), traced, 6 / 4096.0)
                << way << optic;
            seen += traced > 0.01 && traced < 0.99;
        }
    EXPECT_GT(seen, 5);
}

}  // namespace
}  // namespace kinora
