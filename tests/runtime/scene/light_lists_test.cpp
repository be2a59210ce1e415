// tests/runtime/scene/light_lists_test.cpp: meshes that say which lights shine on them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "runtime/scene/dae/export.h"
#include "tests/runtime/scene_text.h"

namespace kinora {
namespace {

std::string lights_extra(const std::string& urls) {
    std::string list;
    for (size_t at = 0; at < urls.size();) {
        size_t end = std::min(urls.find(' ', at), urls.size());
        list += "<instance_light url=\"" + urls.substr(at, end - at) + "\"/>";
        at = end + 1;
    }
    return rsl_extra("<lights>" + list + "</lights>");
}

// Two halves of the picture under a light of 1 and one of 1/2. `left` and `right` stand in the
// instances of the meshes.
SceneText two_lights(const std::string& left, const std::string& right,
                     const std::string& node = "") {
    const char* kSum =
        "surface sum() { color c = 0; Oi = 1; illuminance(P, N, PI / 2) c += Cl; Ci = c; }";
    auto beam = [](double strength) {
        return fmt::format("light beam() {{ solar(vector (0, 0, 1), 0) Cl = {}; }}", strength);
    };
    SceneText scene;
    scene.square("half", 0.5).look("sum", kSum);
    scene.rsl_light("one", beam(1)).rsl_light("two", beam(0.5));
    auto place = [&](double x, const std::string& extra) {
        scene.nodes += fmt::format(
            "<node><translate>{} 0 0</translate><instance_geometry url=\"#half\"><bind_material>"
            "<technique_common><instance_material symbol=\"skin\" "
            "target=\"#sum\"/></technique_common>"
            "</bind_material>{}</instance_geometry>{}</node>",
            x, extra, node);
    };
    place(-0.5, left);
    place(0.5, right);
    return scene;
}

void expect_sides(const Rendering& r, float left, float right) {
    EXPECT_NEAR(r.color(4, 8).x, left, 1e-6) << r.findings();
    EXPECT_NEAR(r.color(11, 8).x, right, 1e-6) << r.findings();
}

TEST(LightLists, SayWhichLightsShineOnAMesh) {
    auto sides = [](const std::string& left, const std::string& right, float a, float b) {
        Rendering r(two_lights(left, right).text());
        expect_sides(r.frame(), a, b);
        EXPECT_EQ(r.findings(), "");
    };
    sides("", "", 1.5f, 1.5f);
    sides(lights_extra("#one"), lights_extra("#two"), 1, 0.5f);
    sides(lights_extra("#two #one"), lights_extra("#two #two"), 1.5f, 0.5f);
    sides(lights_extra(""), "", 0, 1.5f);
}

TEST(LightLists, OfANodeAreForMeshesWithoutOne) {
    Rendering r(two_lights("", lights_extra("#one"), lights_extra("#two")).text());
    expect_sides(r.frame(), 0.5f, 1);
}

TEST(LightLists, UnknownLightsAreFindings) {
    Rendering r(two_lights(lights_extra("#one #none"), lights_extra("#half")).text());
    EXPECT_EQ(r.count("LINK_UNRESOLVED"), 1) << r.findings();
    EXPECT_EQ(r.count("LINK_WRONG_TYPE"), 1) << r.findings();
    expect_sides(r.frame(), 1, 0);
}

TEST(LightLists, AreWrittenAgain) {
    const std::string text = two_lights(lights_extra("#one"), lights_extra("")).text();
    Diagnostics diagnostics;
    std::optional<SceneDescription> read = import_scene({"x.dae", text}, {}, diagnostics);
    ASSERT_TRUE(read);
    ColladaExport written = export_collada(*read, "y.dae", diagnostics);
    Rendering again(written.text);
    expect_sides(again.frame(), 1, 0);
}

}  // namespace
}  // namespace kinora
