// tests/runtime/picture/light/extremes_test.cpp: lamps at the limits of numbers: what they send is
// what the limit says, or nothing, and never a NaN.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/runtime/picture/light/closed_forms.h"
#include "tests/runtime/picture/light/lamp_classes.h"

namespace kinora {
namespace {

// The floor under a lamp of a class or on geometry.
SceneText under_class(const LampClass& lamp, const std::string& binds, double height = kLampHeight,
                      const char* floor = kMatte) {
    SceneText scene = floor_scene(floor);
    scene.rsl_light("lamp", lamp.code, fmt::format("<translate>0 0 {}</translate>", height), binds);
    return scene;
}
SceneText under_mesh(const LampMesh& mesh, double radiance, const std::string& transforms) {
    SceneText scene = floor_scene(kMatte);
    look_from_below(scene, 0.9 * kLampHeight);
    scene.look("lamp-look", geometry_lamp(mesh.area, radiance), "<shader stage=\"LIGHT\"/>");
    scene.mesh("lamp", mesh.positions, mesh.triangles, mesh.normals);
    return scene.place("lamp", "lamp-look", transforms);
}

// The scene's light alone. Findings may tell of it, errors not.
template <class F>
void expect_light(const SceneText& scene, const std::string& name, F&& is_right) {
    SceneOptions options;
    options.lights = LightSet::Scene;
    Rendering r(scene.text(), options);
    r.frame(16, 16);
    EXPECT_FALSE(r.diagnostics.has_errors()) << name << r.findings();
    EXPECT_EQ(r.stats.non_finite, 0u) << name;
    for (int k = 0; k < 256; ++k) {
        const double c = double(r.color(k % 16, k / 16).x);
        EXPECT_TRUE(is_right(c, r.place(k % 16, k / 16))) << name << ": " << c << " at " << k;
        if (testing::Test::HasFailure()) return;
    }
}
bool is_dark(double c, dvec2) {
    return c == 0;
}
bool is_finite(double c, dvec2) {
    return std::isfinite(c) && c >= 0;
}

TEST(LightExtremes, LampsWithoutAreaAreDark) {
    const char* const kNoSize[] = {"wide", "radius", "radius"};
    for (size_t k = 0; k < std::size(kLampClasses); ++k)
        expect_light(under_class(kLampClasses[k], bound_number(kNoSize[k], 0)),
                     kLampClasses[k].name, is_dark);
    LampMesh line = rectangle_mesh();
    for (dvec3& corner : line.positions) corner.y = 0;
    expect_light(under_mesh(line, 1, "<translate>0 0 2</translate>"), "line", is_dark);
    LampMesh spot = rectangle_mesh();
    for (dvec3& corner : spot.positions) corner = dvec3(0.0);
    expect_light(under_mesh(spot, 1, "<translate>0 0 2</translate>"), "spot", is_dark);
    expect_light(
        under_mesh(rectangle_mesh(), 1, "<translate>0 0 2</translate><scale>0 0 0</scale>"),
        "scaled to 0", is_dark);
}

TEST(LightExtremes, RadianceOf0Or1e30IsThatManyTimesOne) {
    const dvec2 corner(kLampWide / 2, kLampTall / 2);
    for (double radiance : {0.0, 1e30}) {
        auto is_right = [&](double c, dvec2 p) {
            const double want = radiance * rectangle_share(p, -corner, corner, kLampHeight);
            return std::abs(c - want) <= 0.1 * want;
        };
        const std::string binds =
            fmt::format("<bind symbol=\"radiance\"><color>{0} {0} {0}</color></bind>", radiance);
        expect_light(under_class(kLampClasses[0], binds), "class", is_right);
        expect_light(under_mesh(rectangle_mesh(), radiance, "<translate>0 0 2</translate>"),
                     "geometry", is_right);
    }
}

// The floor cuts the lamp, and some of its points are the lamp's own.
TEST(LightExtremes, PointsOnALampAreFinite) {
    for (const LampClass& lamp : kLampClasses)
        expect_light(under_class(lamp, "", 0), lamp.name, is_finite);
    for (const char* transforms : {"", "<rotate>1 0 0 90</rotate>"}) {
        expect_light(under_mesh(rectangle_mesh(), 1, transforms), "rectangle", is_finite);
        expect_light(under_mesh(disc_mesh(), 1, transforms), "disc", is_finite);
        expect_light(under_mesh(sphere_mesh(8, 16), 1, transforms), "sphere", is_finite);
    }
}

// The lamp is also asked what it sends from above, as a material does that chose the direction.
const char* const kWeighed =
    "surface weighed() { Oi = 1; Ci = diffuse(normalize(N));"
    " illuminance(P, \"recordset\", samplinglights(vector \"world\" (0, 0, 1), 1, 2)) Ci += Cl; }";

// As pdf, radiance, direction and distance of a sample of any of the two methods. A pdf means
// something between 0 and infinity.
TEST(LightExtremes, SamplesThatMeanNothingAreDark) {
    const struct {
        const char* radiance;
        const char* pdf;
        const char* direction;
        const char* distance;
    } rows[] = {
        {"1", "0", "up", "2"},           {"1", "-1", "up", "2"},
        {"1", "1 / zero", "up", "2"},    {"1", "zero / zero", "up", "2"},
        {"1 / zero", "1", "up", "2"},    {"zero / zero", "1", "up", "2"},
        {"1", "1", "vector 0", "2"},     {"1", "1", "up / zero", "2"},
        {"1", "1", "up", "zero / zero"}, {"1", "1", "up", "0"},
        {"1", "1", "up", "-1"},
    };
    for (const auto& row : rows) {
        const std::string code = fmt::format(R"(
class odd(float zero = 0;) {{
    vector up = vector "world" (0, 0, 1);
    public void generateSamples(string what; output __radiancesample s[]) {{
        resize(s, 4);
        uniform float i;
        for (i = 0; i < 4; i += 1) s[i]->setLightSample(color ({0}), {1}, {2}, {3});
    }}
    public void evaluateSamples(string what; output __radiancesample s[]) {{
        uniform float i;
        for (i = 0; i < arraylength(s); i += 1) {{
            s[i]->setLightSample(color ({0}), {1});
            s[i]->distance = {3};
        }}
    }}
}})",
                                             row.radiance, row.pdf, row.direction, row.distance);
        expect_light(
            under_class({"odd", code.c_str()}, ""),
            std::string(row.radiance) + ", " + row.pdf + ", " + row.direction + ", " + row.distance,
            is_dark);
    }
}

// Point lights far up, each a hundred-thousandth of the light of all.
TEST(LightExtremes, AHundredThousandLightsEnd) {
    constexpr int kLights = 100000;
    SceneText scene = floor_scene(kMatte);
    scene.look("lamp-look",
               fmt::format("light lamp() {{ solar(vector \"world\" (0, 0, -1), 0) Cl = {}; }}",
                           1.0 / kLights),
               "<shader stage=\"LIGHT\"/>");
    scene.lights =
        "<light id=\"lamp\"><technique_common><point><color>1 1 1</color></point>"
        "</technique_common><extra><technique profile=\"RSL\"><instance_effect "
        "url=\"#lamp-look-fx\"/></technique></extra></light>";
    for (int k = 0; k < kLights; ++k) scene.nodes += "<node><instance_light url=\"#lamp\"/></node>";
    Rendering r(scene.text());
    r.frame(2, 2);
    EXPECT_FALSE(r.diagnostics.has_errors()) << r.findings();
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(r.color(k % 2, k / 2).x, 1, 0.01) << r.findings();
}

}  // namespace
}  // namespace kinora
