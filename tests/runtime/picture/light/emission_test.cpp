// tests/runtime/picture/light/emission_test.cpp: fixed-function materials that emit, as lights of
// scenes with indirect light: against closed forms, and against rays that happen to meet them.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "runtime/scene/images/image_io.h"
#include "tests/runtime/picture/light/closed_forms.h"
#include "tests/runtime/picture/light/lamp_classes.h"

namespace kinora {
namespace {

const char* const kGrey =
    "surface grey() { Oi = 1; Ci = 0.5 * diffuse(normalize(faceforward(N, I))); }";

// A material whose emission is that color or texture, and nothing else.
void add_emitter(SceneText& scene, const std::string& id, const std::string& slot,
                 const std::string& newparams = "") {
    scene.effects += fmt::format(
        "<effect id=\"{0}-fx\"><profile_COMMON>{2}<technique sid=\"t\"><lambert>"
        "<emission>{1}</emission><diffuse><color>0 0 0 1</color></diffuse></lambert>"
        "</technique></profile_COMMON></effect>",
        id, slot, newparams);
    scene.materials +=
        fmt::format("<material id=\"{0}\"><instance_effect url=\"#{0}-fx\"/></material>", id);
}

std::string grey_slot(double radiance) {
    return fmt::format("<color>{0} {0} {0} 1</color>", radiance);
}

// A floor within a box of these walls, seen from below the lamp's height.
SceneText room_of(const char* floor, const char* walls, double height = kLampHeight) {
    SceneText scene = floor_scene(floor);
    look_from_below(scene, 0.75 * height);
    scene.cube("box", 5).look("walls", walls).place("box", "walls");
    return scene;
}

void place_mesh(SceneText& scene, const LampMesh& mesh, const std::string& look,
                const std::string& transforms = "<translate>0 0 2</translate>") {
    scene.mesh("lamp", mesh.positions, mesh.triangles, mesh.normals);
    scene.place("lamp", look, transforms);
}

const char* const kBlack = "surface black() { Oi = 1; Ci = 0; }";

SceneOptions with_bounces(uint32_t bounces, uint32_t samples = 0) {
    SceneOptions options;
    options.lights = LightSet::Scene;
    options.indirect = options.quality.diffuse_depth = bounces;
    options.quality.light_samples = samples;
    options.decode_textures = false;  // numbers as the file has them
    return options;
}

struct Moments {
    double mean = 0, variance = 0;
};
Moments moments_of(const SceneText& scene, const SceneOptions& options, int size, int samples) {
    Rendering r(scene.text(), options);
    EXPECT_EQ(r.findings(), "");
    r.settings.integrator.samples_per_pixel = samples;
    r.frame(size, size);
    Moments of;
    for (int k = 0; k < size * size; ++k) {
        const double c = double(r.color(k % size, k / size).x);
        of.mean += c / (size * size);
        of.variance += c * c / (size * size);
    }
    of.variance -= of.mean * of.mean;
    return of;
}

template <class Share>
void expect_floor(const SceneText& scene, const Share& share, double tolerance) {
    Rendering r(scene.text(), with_bounces(1, 256));
    EXPECT_EQ(r.findings(), "");
    sample_middles(r, 4);
    r.frame(16, 16);
    for (int k = 0; k < 256; ++k) {
        const double want = share(r.place(k % 16, k / 16));
        EXPECT_NEAR(double(r.color(k % 16, k / 16).x), want, tolerance * want) << k;
    }
}

double panel_at(dvec2 p) {
    const dvec2 corner(kLampWide / 2, kLampTall / 2);
    return rectangle_share(p, -corner, corner, kLampHeight);
}

TEST(Emission, OfARectangleIsTheClosedForm) {
    SceneText scene = room_of(kMatte, kBlack);
    add_emitter(scene, "glow", grey_slot(1));
    place_mesh(scene, rectangle_mesh(), "glow");
    expect_floor(scene, panel_at, 1e-4);
}

// Six panels beside each other, each brighter than the one before.
SceneText under_panels(double height) {
    SceneText scene = room_of(kMatte, kBlack, height);
    const LampMesh mesh = rectangle_mesh(0.5, 0.2);
    scene.mesh("lamp", mesh.positions, mesh.triangles, mesh.normals);
    for (int k = 0; k < 6; ++k) {
        const std::string id = fmt::format("glow{}", k);
        add_emitter(scene, id, grey_slot(k));
        scene.place("lamp", id,
                    fmt::format("<translate>0 {} {}</translate>", 0.3 * k - 0.9, height));
    }
    return scene;
}
double panels_at(dvec2 p, double height) {
    double sum = 0;
    for (int k = 0; k < 6; ++k) {
        const dvec2 middle(0, 0.3 * k - 0.9), corner(0.25, 0.1);
        sum += k * rectangle_share(p, middle - corner, middle + corner, height);
    }
    return sum;
}

TEST(Emission, OfManySurfacesIsTheirSum) {
    expect_floor(
        under_panels(kLampHeight), [](dvec2 p) { return panels_at(p, kLampHeight); }, 0.01);
}

// Near them, rays find a part of the light that is not left to samples.
TEST(Emission, OfSurfacesNearbyCountsOnceBySamplesAndRays) {
    constexpr double kNear = 0.15;
    Rendering r(under_panels(kNear).text(), with_bounces(1, 16));
    sample_middles(r, 256);
    r.frame(32, 32);
    double got = 0, want = 0;
    for (int k = 0; k < 1024; ++k) {
        got += double(r.color(k % 32, k / 32).x);
        want += panels_at(r.place(k % 32, k / 32), kNear);
    }
    EXPECT_NEAR(got / want, 1, 0.002);
}

// The same scene, lit by samples of the material or by rays that meet a surface of RSL as bright.
TEST(Emission, CountsOnceAndVariesAFifthAsMuch) {
    auto scene_of = [&](bool sampled) {
        SceneText scene = room_of(kMatte, kBlack);
        scene.look("shows", "surface shows() { Oi = 1; Ci = 1; }");
        add_emitter(scene, "glow", grey_slot(1));
        place_mesh(scene, rectangle_mesh(), sampled ? "glow" : "shows");
        return scene;
    };
    const Moments samples = moments_of(scene_of(true), with_bounces(1), 32, 1),
                  rays = moments_of(scene_of(false), with_bounces(1), 32, 1);
    EXPECT_LE(samples.variance, 0.2 * rays.variance);
    EXPECT_NEAR(samples.mean / rays.mean, 1, 4 * std::sqrt(rays.variance / 1024) / rays.mean);
}

// Light of a large lamp goes on between grey walls: three bounces by both ways.
TEST(Emission, CountsOnceBehindBounces) {
    auto mean = [&](bool sampled) {
        SceneText scene = room_of(kGrey, kGrey);
        scene.look("shows", "surface shows() { Oi = 1; Ci = 1; }");
        add_emitter(scene, "glow", grey_slot(1));
        place_mesh(scene, rectangle_mesh(4, 4), sampled ? "glow" : "shows");
        return moments_of(scene, with_bounces(3), 16, 256).mean;
    };
    EXPECT_NEAR(mean(true) / mean(false), 1, 0.005);
}

// Two halves, of which the right one is black.
struct HalfWhite {
    std::string name = "kinora_emission_test_" + std::to_string(getpid()) + ".png";
    std::filesystem::path path = std::filesystem::temp_directory_path() / name;
    HalfWhite() {
        Image8 image{256, 4, {}};
        for (int k = 0; k < 1024; ++k) {
            const uint8_t white = k % 256 < 128 ? 255 : 0;
            image.rgba.insert(image.rgba.end(), {white, white, white, 255});
        }
        EXPECT_EQ(write_png(path.string(), image, {}), "");
    }
    ~HalfWhite() { std::filesystem::remove(path); }
};

TEST(Emission, OfATextureIsThatOfItsTexels) {
    const HalfWhite image;
    SceneText scene = room_of(kMatte, kBlack);
    scene.images = "<image id=\"half\"><init_from>" + image.name + "</init_from></image>";
    add_emitter(scene, "glow", "<texture texture=\"half-sampler\" texcoord=\"UV\"/>",
                "<newparam sid=\"half-surface\"><surface type=\"2D\"><init_from>half</init_from>"
                "</surface></newparam><newparam sid=\"half-sampler\"><sampler2D>"
                "<source>half-surface</source></sampler2D></newparam>");
    scene.square("panel", 0.5)
        .place("panel", "glow", "<translate>0 0 2</translate>", "",
               "<bind_vertex_input semantic=\"UV\" "
               "input_semantic=\"TEXCOORD\" input_set=\"0\"/>");
    auto share = [](dvec2 p) { return rectangle_share(p, {-0.5, -0.5}, {0, 0.5}, kLampHeight); };
    expect_floor(scene, share, 0.02);
}

// Without indirect light a scene has no such lights, and surfaces that surround it are none.
TEST(Emission, IsALightOfScenesWithIndirectLightAlone) {
    SceneText scene = room_of(kMatte, kBlack);
    add_emitter(scene, "glow", grey_slot(1));
    add_emitter(scene, "dark", grey_slot(0));
    place_mesh(scene, rectangle_mesh(), "glow");
    scene.cube("around", 4).place("around", "glow").place("lamp", "dark");
    EXPECT_EQ(Rendering(scene.text(), with_bounces(0)).scene->lights.size(), 0u);
    EXPECT_EQ(Rendering(scene.text(), with_bounces(1)).scene->lights.size(), 2u);
}

// A triangle of glTF in that material; how many lights the scene has beside that of --gi.
size_t lights_of(const std::string& material) {
    const std::filesystem::path path =
        std::filesystem::temp_directory_path() / fmt::format("kinora_emission_{}.gltf", getpid());
    std::ofstream(path) << R"({"asset":{"version":"2.0"},
        "extensionsUsed":["KHR_materials_emissive_strength"],
        "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
        "bufferViews":[{"buffer":0,"byteLength":36}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",
                      "min":[0,0,0],"max":[1,1,0]}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
        "nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0,
        "materials":[{)" << material
                        << "}]}";
    auto r = Rendering::of_file(path.string(), with_bounces(1));
    std::filesystem::remove(path);
    return r->scene ? r->scene->lights.size() - 1 : 99;
}

TEST(Emission, OfGltfMaterialsIsALight) {
    EXPECT_EQ(lights_of(R"("emissiveFactor":[0,0.5,0])"), 1u);
    EXPECT_EQ(lights_of(R"("emissiveFactor":[1,1,1],"extensions":
                           {"KHR_materials_emissive_strength":{"emissiveStrength":9}})"),
              1u);
    EXPECT_EQ(lights_of(R"("emissiveFactor":[0,0,0])"), 0u);
    EXPECT_EQ(lights_of(R"("doubleSided":true)"), 0u);
}

TEST(LightExtremes, EmissionOf0Or1e30OrNoAreaIsThatManyTimesOne) {
    for (double radiance : {0.0, 1e30}) {
        SceneText scene = room_of(kMatte, kBlack);
        add_emitter(scene, "glow", grey_slot(radiance));
        place_mesh(scene, rectangle_mesh(), "glow");
        expect_floor(
            scene, [&](dvec2 p) { return radiance * panel_at(p); }, 1e-4);
    }
    SceneText line = room_of(kMatte, kBlack);
    add_emitter(line, "glow", grey_slot(1));
    place_mesh(line, rectangle_mesh(), "glow", "<translate>0 0 2</translate><scale>1 0 1</scale>");
    Rendering r(line.text(), with_bounces(1));
    r.frame(16, 16);
    EXPECT_EQ(r.stats.non_finite, 0u);
    for (int k = 0; k < 256; ++k) EXPECT_EQ(r.color(k % 16, k / 16), vec3(0.0f));
}

}  // namespace
}  // namespace kinora
