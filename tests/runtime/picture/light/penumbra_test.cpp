// tests/runtime/picture/light/penumbra_test.cpp: the edge of a shade before lamps of some width:
// sample methods are as good as lamps on geometry, whose samples the renderer chooses.
#include <gtest/gtest.h>

#include "tests/runtime/picture/light/closed_forms.h"
#include "tests/runtime/picture/light/lamp_classes.h"

namespace kinora {
namespace {

constexpr int kOfPoint = 256;

// The shade's edge goes through the axis at half the height, turned by 30 degrees from the lamp's
// sides: it hides what lies left of the edge, which of the lamp's plane is right(at) < -right(p).
constexpr double kTurn = 30;
dvec2 turned(dvec2 p) {
    const double c = std::cos(kTurn * kPi / 180), s = std::sin(kTurn * kPi / 180);
    return {c * p.x + s * p.y, c * p.y - s * p.x};
}

// The lamp's polygon, without what is hidden (I. Sutherland and G. Hodgman 1974).
double rectangle_seen(dvec2 p) {
    const std::vector<dvec3> whole = rectangle_mesh().positions;
    auto right = [&](dvec3 at) { return turned(dvec2(at)).x + turned(p).x; };
    std::vector<dvec3> seen;
    for (size_t k = 0; k < whole.size(); ++k) {
        const dvec3 a = whole[k], b = whole[(k + 1) % whole.size()];
        if (right(a) > 0) seen.push_back(a);
        if ((right(a) > 0) != (right(b) > 0))
            seen.push_back(a + (b - a) * (right(a) / (right(a) - right(b))));
    }
    return polygon_share(dvec3(p, -kLampHeight), seen);
}

// Over strips along the edge, whose light is found by midpoints.
double disc_seen(dvec2 place) {
    constexpr int kSteps = 128;
    const dvec2 p = turned(place);
    const double left = std::clamp(-p.x, -kDiscRadius, kDiscRadius);
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double x = left + (kDiscRadius - left) * (i + 0.5) / kSteps;
        const double half = std::sqrt(kDiscRadius * kDiscRadius - x * x);
        for (int j = 0; j < kSteps; ++j) {
            const double y = half * (2 * (j + 0.5) / kSteps - 1), dx = x - p.x, dy = y - p.y;
            const double far2 = dx * dx + dy * dy + kLampHeight * kLampHeight;
            sum += 2 * half * (kDiscRadius - left) * kLampHeight * kLampHeight / (far2 * far2);
        }
    }
    return sum / (kPi * kSteps * kSteps);
}

// Over its cone, evenly.
double sphere_seen(dvec2 p) {
    constexpr int kSteps = 128;
    const dvec3 way(-p.x, -p.y, kLampHeight), W = glm::normalize(way);
    const dvec3 T = glm::normalize(glm::cross(W, dvec3(0, 1, 0))), B = glm::cross(W, T);
    const double sine2 = kSphereRadius * kSphereRadius / glm::dot(way, way);
    const double opening = 1 - std::sqrt(1 - sine2);
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const double c = 1 - opening * (i + 0.5) / kSteps, s = std::sqrt(1 - c * c);
            const double a = 2 * kPi * (j + 0.5) / kSteps;
            const dvec3 D = c * W + s * (std::cos(a) * T + std::sin(a) * B);
            if (turned(p + dvec2(D) / D.z * (kLampHeight / 2)).x > 0) sum += D.z;
        }
    return sum * 2 * opening / (kSteps * kSteps);
}

struct Shape {
    const char* name;
    const char* code;
    LampMesh mesh;
    double (*seen)(dvec2);
};

SceneText shaded_floor() {
    SceneText scene = floor_scene(kMatte);
    scene.square("shade", 5).look("dark", "surface dark() { Ci = 0; Oi = 1; }");
    scene.place("shade", "dark",
                fmt::format("<rotate>0 0 1 {}</rotate><translate>-5 0 {}</translate>", kTurn,
                            kLampHeight / 2));
    look_from_below(scene, 0.5);
    return scene;
}

// Over the whole lamp's light at the middle, of all pixels and some seeds.
double error_of(const SceneText& scene, const Shape& shape, const std::vector<double>& want) {
    constexpr int kSeeds = 4;
    SceneOptions options;
    options.quality.light_samples = kOfPoint;
    Rendering r(scene.text(), options);
    double squares = 0;
    for (int seed = 0; seed < kSeeds; ++seed) {
        r.settings.integrator.seed = uint32_t(seed);
        r.frame(16, 16);
        for (int k = 0; k < 256; ++k)
            squares += std::pow(double(r.color(k % 16, k / 16).x) - want[size_t(k)], 2);
    }
    EXPECT_EQ(r.findings(), "") << shape.name;
    return std::sqrt(squares / (256 * kSeeds)) / (2 * shape.seen({0, 0}));
}

TEST(LampPenumbra, OfSampleMethodsIsAsGoodAsOfGeometry) {
    const Shape shapes[] = {{"rectangle", kRectangleClass, rectangle_mesh(), rectangle_seen},
                            {"disc", kDiscClass, disc_mesh(), disc_seen},
                            {"sphere", kSphereClass, sphere_mesh(64, 128), sphere_seen}};
    for (const Shape& shape : shapes) {
        std::vector<double> want;
        for (int k = 0; k < 256; ++k)
            want.push_back(shape.seen({-1 + (k % 16 + 0.5) / 8, 1 - (k / 16 + 0.5) / 8}));
        SceneText by_class = shaded_floor(), by_mesh = shaded_floor();
        by_class.rsl_light("lamp", shape.code,
                           fmt::format("<translate>0 0 {}</translate>", kLampHeight),
                           bound_number("samples", kOfPoint));
        add_lamp(by_mesh, shape.mesh);
        const double own = error_of(by_class, shape, want), others = error_of(by_mesh, shape, want);
        RecordProperty(shape.name, fmt::format("{:.5f} {:.5f}", own, others));
        EXPECT_LE(own, 1.3 * others) << shape.name;
        EXPECT_LE(own, 0.02) << shape.name;
    }
}

}  // namespace
}  // namespace kinora
