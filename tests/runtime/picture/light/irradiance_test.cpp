// tests/runtime/picture/light/irradiance_test.cpp: what lamps send to a floor, against closed
// forms.
#include <gtest/gtest.h>

#include <functional>

#include "tests/runtime/picture/light/closed_forms.h"
#include "tests/runtime/picture/light/lamp_classes.h"

namespace kinora {
namespace {

constexpr int kOfPixel = 4, kOfLamp = 1024;  // 4096 together, which share a sequence
using Share = std::function<double(dvec2)>;

double rectangle_at(dvec2 p) {
    const dvec2 corner(kLampWide / 2, kLampTall / 2);
    return rectangle_share(p, -corner, corner, kLampHeight);
}
double disc_at(dvec2 p) {
    return disc_share(p, kDiscRadius, kLampHeight);
}
double sphere_at(dvec2 p) {
    return sphere_share(p, kSphereRadius, kLampHeight);
}

// Relative: each of 256 pixels, and their mean.
void expect_shares(const SceneText& scene, const char* name, const Share& share,
                   double tolerance = 1e-3) {
    SceneOptions options;
    options.quality.light_samples = kOfLamp;
    Rendering r(scene.text(), options);
    sample_middles(r, kOfPixel);
    r.frame(16, 16);
    EXPECT_EQ(r.findings(), "") << name;
    double worst = 0, got = 0, want = 0;
    for (int k = 0; k < 256; ++k) {
        const double is = double(r.color(k % 16, k / 16).x), be = share(r.place(k % 16, k / 16));
        worst = std::max(worst, std::abs(is / be - 1));
        got += is, want += be;
    }
    EXPECT_LE(worst, tolerance) << name;
    EXPECT_NEAR(got / want, 1, 1e-4) << name;
}

TEST(LampIrradiance, OfClassesIsTheClosedForm) {
    const Share shares[] = {rectangle_at, disc_at, sphere_at};
    for (size_t k = 0; k < std::size(kLampClasses); ++k) {
        SceneText scene = floor_scene(kMatte);
        scene.rsl_light("lamp", kLampClasses[k].code,
                        fmt::format("<translate>0 0 {}</translate>", kLampHeight),
                        bound_number("samples", kOfLamp));
        expect_shares(scene, kLampClasses[k].name, shares[k]);
    }
}

SceneText floor_under(const LampMesh& mesh) {
    SceneText scene = floor_scene(kMatte);
    look_from_below(scene, 1.5);
    add_lamp(scene, mesh);
    return scene;
}

TEST(LampIrradiance, OfGeometryIsTheClosedForm) {
    expect_shares(floor_under(rectangle_mesh()), "rectangle", rectangle_at);
    expect_shares(floor_under(disc_mesh()), "disc", disc_at);
}

// Over half of the samples lie on the far side, so a pixel has twice the tolerance.
TEST(LampIrradiance, OfASphereOnGeometryIsTheSumOverItsFacets) {
    const LampMesh mesh = sphere_mesh(24, 48);
    const Share facets = [&](dvec2 p) {
        double sum = 0;
        for (size_t t = 0; t < mesh.positions.size(); t += 3) {
            const dvec3 at(p, -kLampHeight);
            if (glm::dot(at - mesh.positions[t], mesh.normals[t]) > 0)
                sum += polygon_share(at, std::span(mesh.positions).subspan(t, 3));
        }
        return sum;
    };
    expect_shares(floor_under(mesh), "facets", facets, 2e-3);
}

// By area it would be 4.9, a point seen edge-on being as likely as one that faces the floor.
TEST(LampIrradiance, OneSampleOfASphereByItsConeHardlyVaries) {
    SceneText scene = floor_scene(kMatte);
    scene.cameras = R"(<camera id="eye"><optics><technique_common><orthographic>
        <xmag>.001</xmag><ymag>.001</ymag><znear>0.1</znear><zfar>100</zfar>
        </orthographic></technique_common></optics></camera>)";
    scene.rsl_light("lamp", kSphereClass, "<translate>0 0 1</translate>",
                    bound_number("samples", 1));
    Rendering r(scene.text());
    r.frame(64, 64);
    EXPECT_EQ(r.findings(), "");
    double sum = 0, squares = 0;
    constexpr int kPixels = 64 * 64;
    for (int k = 0; k < kPixels; ++k) {
        const double c = double(r.color(k % 64, k / 64).x);
        sum += c / kPixels, squares += c * c / kPixels;
    }
    EXPECT_LE(squares / (sum * sum) - 1, 1e-3);
    // The cosine is even between sqrt(1 - r^2) and 1: its variance is a twelfth of the square.
    const double least = std::sqrt(1 - kSphereRadius * kSphereRadius), mean = (1 + least) / 2;
    const double expected = (1 - least) * (1 - least) / (12 * mean * mean);
    EXPECT_NEAR((squares / (sum * sum) - 1) / expected, 1, 0.1);
}

}  // namespace
}  // namespace kinora
