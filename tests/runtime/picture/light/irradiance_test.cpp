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
void expect_shares(const SceneText& scene, const char* name, const Share& share) {
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
    EXPECT_LE(worst, 1e-3) << name;
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

// The rectangle in so many rows of squares, more than are found without rays.
LampMesh grid_mesh(int rows) {
    LampMesh mesh;
    mesh.area = kLampWide * kLampTall;
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < rows; ++j) {
            const int first = int(mesh.positions.size());
            for (const dvec2 at :
                 {dvec2(i, j), dvec2(i, j + 1), dvec2(i + 1, j + 1), dvec2(i + 1, j)})
                mesh.positions.push_back(
                    {kLampWide * (at.x / rows - 0.5), kLampTall * (at.y / rows - 0.5), 0});
            for (int corner : {0, 1, 2, 0, 2, 3}) mesh.triangles.push_back(first + corner);
        }
    return mesh;
}

TEST(LampIrradiance, OfGeometryIsTheClosedForm) {
    expect_shares(floor_under(rectangle_mesh()), "rectangle", rectangle_at);
    expect_shares(floor_under(grid_mesh(5)), "grid", rectangle_at);
    expect_shares(floor_under(disc_mesh()), "disc", disc_at);
}

// What a sphere's facets send to a place of the floor, from their fronts, their backs or both.
Share of_facets(const LampMesh& mesh, bool fronts, bool backs) {
    return [=](dvec2 p) {
        double sum = 0;
        for (size_t t = 0; t < mesh.positions.size(); t += 3) {
            const dvec3 at(p, -kLampHeight);
            const bool is_front = glm::dot(at - mesh.positions[t], mesh.normals[t]) > 0;
            const double share = polygon_share(at, std::span(mesh.positions).subspan(t, 3));
            if (is_front ? fronts : backs) sum += is_front ? share : -share;
        }
        return sum;
    };
}

TEST(LampIrradiance, OfASphereOnGeometryIsTheSumOverItsFacets) {
    const LampMesh mesh = sphere_mesh(24, 48);
    expect_shares(floor_under(mesh), "facets", of_facets(mesh, true, false));
}

// A lamp that shines to both sides, whose front lets the light of its back through.
TEST(LampIrradiance, OfATransparentSphereIsThatOfBothItsSides) {
    const LampMesh mesh = sphere_mesh(24, 48);
    SceneText scene = floor_scene(kMatte);
    look_from_below(scene, 1.5);
    scene.look("lamp-look",
               fmt::format("light lamp() {{ illuminate(P)"
                           " Cl = {} / PI * abs(normalize(L) . normalize(N)) / (L . L); }}"
                           "surface clear() {{ Oi = 0; Ci = 0; }}",
                           mesh.area),
               "<shader stage=\"LIGHT\"><name>lamp</name></shader>"
               "<shader stage=\"SURFACE\"><name>clear</name></shader>");
    scene.mesh("lamp", mesh.positions, mesh.triangles, mesh.normals);
    scene.place("lamp", "lamp-look", fmt::format("<translate>0 0 {}</translate>", kLampHeight));
    expect_shares(scene, "both sides", of_facets(mesh, true, true));
}

// One sample of a lamp that sends the same from all of its points is exact by area alone.
TEST(LampIrradiance, OfAShaderThatIsNoLampOfOneRadianceIsSampledByArea) {
    for (const LampMesh& mesh : {rectangle_mesh(), sphere_mesh(8, 16)}) {
        SceneText scene =
            floor_scene("surface sums() { Oi = 1; Ci = 0; illuminance(P) Ci += Cl; }");
        look_from_below(scene, 1.5);
        scene.look("lamp-look", "light lamp() { illuminate(P) Cl = 1; }",
                   "<shader stage=\"LIGHT\"/>");
        scene.mesh("lamp", mesh.positions, mesh.triangles, mesh.normals);
        scene.place("lamp", "lamp-look", "<translate>0 0 2</translate>");
        SceneOptions options;
        options.quality.light_samples = 1;
        options.quality.shadows = ShadowMode::Off;
        Rendering r(scene.text(), options);
        r.frame(16, 16);
        for (int k = 0; k < 256; ++k) ASSERT_EQ(r.color(k % 16, k / 16).x, 1);
    }
}

// Of a picture of a point below a lamp: of one sample, relative.
double variance_below(SceneText scene) {
    scene.cameras = R"(<camera id="eye"><optics><technique_common><orthographic>
        <xmag>.001</xmag><ymag>.001</ymag><znear>0.1</znear><zfar>100</zfar>
        </orthographic></technique_common></optics></camera>)";
    SceneOptions options;
    options.quality.light_samples = 1;
    Rendering r(scene.text(), options);
    r.frame(64, 64);
    EXPECT_EQ(r.findings(), "");
    double sum = 0, squares = 0;
    constexpr int kPixels = 64 * 64;
    for (int k = 0; k < kPixels; ++k) {
        const double c = double(r.color(k % 64, k / 64).x);
        sum += c / kPixels, squares += c * c / kPixels;
    }
    return squares / (sum * sum) - 1;
}

// By area it would be 4.9, a point seen edge-on being as likely as one that faces the floor.
TEST(LampIrradiance, OneSampleOfASphereByItsConeHardlyVaries) {
    // The cosine is even between sqrt(1 - r^2) and 1: its variance is a twelfth of the square.
    const double least = std::sqrt(1 - kSphereRadius * kSphereRadius), mean = (1 + least) / 2;
    const double expected = (1 - least) * (1 - least) / (12 * mean * mean);
    SceneText of_class = floor_scene(kMatte);
    of_class.rsl_light("lamp", kSphereClass, "<translate>0 0 1</translate>",
                       bound_number("samples", 1));
    const double by_class = variance_below(of_class);
    EXPECT_LE(by_class, 1e-3);
    EXPECT_NEAR(by_class / expected, 1, 0.1);
    SceneText on_geometry = floor_scene(kMatte);
    look_from_below(on_geometry, 0.5);
    add_lamp(on_geometry, sphere_mesh(128, 256), 1, 1);
    const double by_geometry = variance_below(on_geometry);
    EXPECT_LE(by_geometry, 1e-3);
    EXPECT_GE(by_geometry / expected, 0.9);  // and some directions miss the facets
}

}  // namespace
}  // namespace kinora
