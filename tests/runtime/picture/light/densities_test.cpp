// tests/runtime/picture/light/densities_test.cpp: how dense a lamp's samples are, as the renderer
// weighs them: the integral over all directions is their number, and both methods agree.
#include <gtest/gtest.h>

#include "tests/runtime/picture/light/lamp_classes.h"

namespace kinora {
namespace {

constexpr int kOfEach = 64;

// Sums the density at the middles of cells about the lamp, which is in the plane z = 2 or, as a
// sphere, within a cone. The cells fill twice the lamp's width, and none is cut by its edge; so
// many that the angle of a rectangle is within 1e-4.
//   shape 0: a rectangle; 1: a disc; 2: a sphere. The area of a cell by solid angle is its own
// arithmetic: of the plane cosine / distance^2, of the cone even in the cosine.
const char* const kIntegral = R"(
surface integral(uniform float shape = 0, samples = 64, wide = 1, tall = 0.6, radius = 0.5;) {
    uniform float steps = 48, i, j;
    float sum = 0;
    point centre = point "world" (0, 0, 2);
    illuminance(P) { sum += 0 * Cl[0]; }
    for (i = 0; i < steps; i += 1) {
        for (j = 0; j < steps; j += 1) {
            uniform float x = (i + 0.5) / steps, y = (j + 0.5) / steps;
            float angle = 0;
            vector D = 0;
            if (shape == 2) {
                vector W = centre - P;
                float sine2 = radius * radius / (W . W), opening = 1 - sqrt(1 - sine2);
                float c = 1 - 2 * opening * x, s = sqrt(1 - c * c);
                W = normalize(W);
                vector T = normalize(W ^ vector "world" (1, 0, 0)), B = W ^ T;
                D = c * W + s * (cos(2 * PI * y) * T + sin(2 * PI * y) * B);
                angle = 2 * PI * 2 * opening / (steps * steps);
            } else {
                uniform float r = 2 * radius * sqrt(x), a = 2 * PI * y;
                D = (shape == 1 ? point "world" (r * cos(a), r * sin(a), 2)
                                : point "world" ((2 * x - 1) * wide, (2 * y - 1) * tall, 2)) - P;
                float cell = shape == 1 ? 4 * PI * radius * radius : 4 * wide * tall;
                float far2 = D . D, far = sqrt(far2);
                angle = cell / (steps * steps) * (D . vector "world" (0, 0, 1)) / (far * far2);
                D /= far;
            }
            illuminance(P, "recordset", samplinglights(D, 1, 1))
                sum += max(0, lightdensity()) * angle;
        }
    }
    Oi = 1;
    Ci = sum / samples;
})";

// The largest difference of both methods' densities, relative, and the share of directions that
// evaluateSamples() does not know.
const char* const kPair = R"(
surface pair(uniform float samples = 64;) {
    vector ways[64];
    float made[64], n = 0, worst = 0, known = 0;
    uniform float k;
    illuminance(P) {
        ways[n] = normalize(L);
        made[n] = lightdensity();
        n += 1;
    }
    for (k = 0; k < samples; k += 1) {
        illuminance(P, "recordset", samplinglights(ways[k], 1, 1)) {
            if (lightdensity() > 0) {
                worst = max(worst, abs(lightdensity() / made[k] - 1));
                known += 1;
            }
        }
    }
    Oi = 1;
    Ci = color(worst, known / samples, n / samples);
})";

// The lamp above the floor, by its class or on geometry.
SceneText lit_by(size_t shape, bool on_geometry, const char* code, const std::string& binds = "") {
    SceneText scene = floor_scene(code, "<shader stage=\"SURFACE\">" + binds + "</shader>");
    look_from_below(scene, 1.5);
    if (on_geometry)
        add_lamp(scene, shape == 0 ? rectangle_mesh() : disc_mesh());
    else
        scene.rsl_light("lamp", kLampClasses[shape].code,
                        fmt::format("<translate>0 0 {}</translate>", kLampHeight),
                        bound_number("samples", kOfEach));
    return scene;
}

std::unique_ptr<Rendering> pictured(const SceneText& scene, int size) {
    SceneOptions options;
    options.quality.light_samples = kOfEach;
    auto r = std::make_unique<Rendering>(scene.text(), options);
    r->frame(size, size);
    EXPECT_EQ(r->findings(), "");
    return r;
}

struct Lamp {
    size_t shape;
    bool on_geometry;
};
// A sphere on geometry has two samples in a direction, of which the far one is dark.
constexpr Lamp kLamps[] = {{0, false}, {1, false}, {2, false}, {0, true}, {1, true}};

TEST(LampDensities, IntegrateToOne) {
    for (const Lamp& lamp : kLamps) {
        const std::string binds =
            bound_number("shape", double(lamp.shape)) +
            bound_number("radius", lamp.shape == 2 ? kSphereRadius : kDiscRadius);
        auto r = pictured(lit_by(lamp.shape, lamp.on_geometry, kIntegral, binds), 8);
        for (int k = 0; k < 64; ++k)
            EXPECT_NEAR(r->color(k % 8, k / 8).x, 1, 1e-4) << lamp.shape << lamp.on_geometry;
    }
}

TEST(LampDensities, AreTheSameByBothMethods) {
    for (const Lamp& lamp : kLamps) {
        auto r = pictured(lit_by(lamp.shape, lamp.on_geometry, kPair), 16);
        double known = 0;
        for (int k = 0; k < 256; ++k) {
            const vec3 c = r->color(k % 16, k / 16);
            EXPECT_LE(c.x, 1e-4) << lamp.shape << lamp.on_geometry;
            EXPECT_EQ(c.z, 1) << lamp.shape << lamp.on_geometry;
            known += double(c.y) / 256;
        }
        EXPECT_GE(known, 0.999) << lamp.shape << lamp.on_geometry;  // but at the very edge
    }
}

}  // namespace
}  // namespace kinora
