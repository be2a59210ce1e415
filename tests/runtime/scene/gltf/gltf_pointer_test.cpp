// tests/runtime/scene/gltf/gltf_pointer_test.cpp: values of a glTF file that channels drive by JSON
// pointers (KHR_animation_pointer), read and written.
#include <gtest/gtest.h>

#include <cmath>

#include "runtime/scene/curves/channels.h"
#include "runtime/scene/gltf/document/glb.h"
#include "runtime/scene/gltf/export/export.h"
#include "tests/runtime/scene/gltf/gltf_text.h"

namespace kinora {
namespace {

using nlohmann::json;

// A channel of the first animation, of numbers of an accessor type.
void drive(GltfText& g, const json& pointer, const std::vector<float>& times,
           const std::vector<float>& values, const char* type = "SCALAR",
           const char* interpolation = "LINEAR") {
    json& animation = g.json["animations"][0];
    animation["samplers"].push_back({{"input", g.floats(times, "SCALAR")},
                                     {"output", g.floats(values, type)},
                                     {"interpolation", interpolation}});
    animation["channels"].push_back(
        {{"sampler", animation["samplers"].size() - 1},
         {"target",
          {{"path", "pointer"},
           {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}}}});
    g.json["extensionsUsed"] = {"KHR_animation_pointer"};
}

// A square with a material, a spot light.
GltfText lit_square(const json& material) {
    GltfText g;
    g.node({{"mesh", g.square(g.material(material))}});
    g.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"intensity", 5}, {"spot", {{"outerConeAngle", 0.5}}}}};
    g.node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    return g;
}

// A slot's numbers as the scene's animation moves them.
std::vector<double> numbers_at(const SceneDescription& scene, ValueSlot slot, double time) {
    ValuesAtTime values(scene);
    values.evaluate(channels_of(scene, scene.animation, std::span(&slot, 1)), time);
    auto first = values.values().begin() + slot.offset;
    return {first, first + slot.count};
}

std::vector<double> param_at(const SceneDescription& scene, const ShaderUse& use, const char* name,
                             double time) {
    const ParamSource* p = use.find(name);
    return p ? numbers_at(scene, p->value, time) : std::vector<double>();
}

std::vector<double> surface_at(const SceneDescription& scene, const char* name, double time) {
    return param_at(scene, scene.materials[0].surfaces.back(), name, time);
}

void expect_near(const std::vector<double>& numbers, const std::vector<double>& wanted,
                 double error = 1e-6) {
    ASSERT_EQ(numbers.size(), wanted.size());
    for (size_t k = 0; k < wanted.size(); ++k) EXPECT_NEAR(numbers[k], wanted[k], error) << k;
}

TEST(GltfPointer, FactorsOfMaterialsFollow) {
    GltfText g = lit_square({{"alphaMode", "MASK"}});
    drive(g, "/materials/0/pbrMetallicRoughness/baseColorFactor", {0, 2}, {1, 0, 0, 1, 0, 1, 0, .5},
          "VEC4");
    drive(g, "/materials/0/pbrMetallicRoughness/roughnessFactor", {1, 2}, {1, 0.25}, "SCALAR",
          "STEP");
    drive(g, "/materials/0/alphaCutoff", {0, 1}, {0.25, 0.75});
    drive(g, "/materials/0/extensions/KHR_materials_specular/specularColorFactor", {0, 1},
          {0, 0, 0, 1, 0.5, 0}, "VEC3");
    auto d = described(g.glb());
    ASSERT_TRUE(d->scene);
    EXPECT_EQ(d->findings(), "");
    expect_near(surface_at(*d->scene, "base_color", 0.5), {0.75, 0.25, 0});
    expect_near(surface_at(*d->scene, "base_alpha", 1), {0.75});
    expect_near(surface_at(*d->scene, "roughness", 1.9), {1});
    expect_near(surface_at(*d->scene, "roughness", 2), {0.25});
    expect_near(surface_at(*d->scene, "mirrors", 0), {1});
    expect_near(surface_at(*d->scene, "alpha_cutoff", 0.5), {0.5});
    expect_near(surface_at(*d->scene, "specular_color", 0.5), {0.5, 0.25, 0});
    EXPECT_EQ(d->scene->clips.size(), 1u);
}

// t is in seconds; tangents are, too (glTF 2.0, appendix C.5).
TEST(GltfPointer, CubicsAreCubics) {
    GltfText g = lit_square(json::object());
    drive(g, "/materials/0/pbrMetallicRoughness/metallicFactor", {0, 2}, {0, 0, 0.5, 0, 1, 0},
          "SCALAR", "CUBICSPLINE");
    auto d = described(g.glb());
    ASSERT_TRUE(d->scene);
    for (double t : {0.0, 0.5, 1.0, 1.5, 2.0}) {
        double s = t / 2, h10 = s * s * s - 2 * s * s + s, h01 = 3 * s * s - 2 * s * s * s;
        expect_near(surface_at(*d->scene, "metallic", t), {2 * 0.5 * h10 + h01});
    }
}

TEST(GltfPointer, ValuesThatAreOneNumberHereFollowTogether) {
    GltfText g = lit_square({{"emissiveFactor", {1, 0.5, 0}}});
    drive(g, "/materials/0/emissiveFactor", {0, 1}, {0, 0, 0, 1, 0.5, 0}, "VEC3");
    drive(g, "/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength", {0, 1},
          {1, 3});
    drive(g, "/materials/0/extensions/KHR_materials_ior/ior", {0, 1}, {1, 2});
    auto d = described(g.glb());
    ASSERT_TRUE(d->scene);
    EXPECT_EQ(d->findings(), "");
    expect_near(surface_at(*d->scene, "emissive", 0.5), {0.5 * 2, 0.25 * 2, 0}, 1e-3);
    expect_near(surface_at(*d->scene, "emissive", 1), {3, 1.5, 0});
    expect_near(surface_at(*d->scene, "dielectric_F0", 0.5), {0.04}, 1e-5);
    expect_near(surface_at(*d->scene, "dielectric_F0", 1), {1 / 9.0});
}

TEST(GltfPointer, TexturesSlideAndTurn) {
    GltfText g;
    int t = g.texture(1, 1, {255, 255, 255, 255}, json::object());
    json info = {{"index", t}, {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0}}}}}}};
    g.node(
        {{"mesh", g.square(g.material({{"pbrMetallicRoughness", {{"baseColorTexture", info}}}}))}});
    const std::string own =
        "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/";
    drive(g, own + "offset", {0, 1}, {0.5, 0, 0.5, 1}, "VEC2");
    drive(g, own + "rotation", {0, 1}, {0, float(kPi / 2)});
    auto d = described(g.glb());
    ASSERT_TRUE(d->scene);
    // uv' = offset + R (u, v), R = (c s; -s c); s = u, t = 1 - v.
    double c = std::cos(kPi / 4);
    expect_near(surface_at(*d->scene, "base_color_ss", 0.5), {c}, 1e-3);
    expect_near(surface_at(*d->scene, "base_color_st", 0.5), {-c}, 1e-3);
    expect_near(surface_at(*d->scene, "base_color_so", 0.5), {0.5 + c}, 1e-3);
    expect_near(surface_at(*d->scene, "base_color_to", 0.5), {1 - 0.5 - c}, 1e-3);
}

TEST(GltfPointer, LightsCamerasAndNodesFollow) {
    GltfText g = lit_square(json::object());
    const std::string light = "/extensions/KHR_lights_punctual/lights/0/";
    drive(g, light + "intensity", {0, 1}, {0, 8});
    drive(g, light + "color", {0, 1}, {1, 1, 1, 1, 0, 0}, "VEC3");
    drive(g, light + "spot/outerConeAngle", {0, 1}, {0.5, 1});
    drive(g, "/cameras/0/orthographic/xmag", {0, 1}, {1, 3});
    drive(g, "/nodes/1/translation", {0, 1}, {0, 0, 0, 2, 0, 0}, "VEC3");
    auto d = described(g.glb());
    ASSERT_TRUE(d->scene);
    EXPECT_EQ(d->findings(), "");
    const ShaderUse& spot = d->scene->lights[0].shader;
    expect_near(param_at(*d->scene, spot, "intensity", 0.25), {2});
    expect_near(param_at(*d->scene, spot, "lightcolor", 0.5), {1, 0.5, 0.5});
    expect_near(param_at(*d->scene, spot, "outer_angle", 0.5), {0.75});
    expect_near(numbers_at(*d->scene, d->scene->cameras[0].x, 0.5), {2});
    ASSERT_EQ(d->scene->nodes[1].transforms.size(), 1u);
    expect_near(numbers_at(*d->scene, {d->scene->nodes[1].transforms[0].value, 3}, 0.5), {1, 0, 0});
}

json rsl_material() {
    json layer = {{"code",
                   "surface s(float k = 1; color c = 1; float a[5] = {0,0,0,0,0};) {"
                   " Ci = k * c * a[4]; Oi = 1; }"},
                  {"params", {{"k", 1}, {"c", {1, 1, 1}}, {"a", {0, 0, 0, 0, 1}}}}};
    return {{"extras", {{"kinora_rsl", {{"surface", layer}}}}}};
}

TEST(GltfPointer, ParametersInExtrasFollowAndWhatTheyReplaceIsPassedOver) {
    GltfText g = lit_square(rsl_material());
    const std::string own = "/materials/0/extras/kinora_rsl/surface/params/";
    drive(g, own + "k", {0, 1}, {0, 4});
    drive(g, own + "c", {0, 1}, {0, 0, 0, 1, 2, 3}, "VEC3");
    drive(g, own + "a", {0, 1}, {0, 0, 0, 0, 1, 0, 0, 0, 0, 3});
    drive(g, "/materials/0/pbrMetallicRoughness/metallicFactor", {0, 1}, {0, 1});
    auto d = described(g.glb());
    ASSERT_TRUE(d->scene);
    EXPECT_EQ(d->findings(), "");
    expect_near(surface_at(*d->scene, "k", 0.25), {1});
    expect_near(surface_at(*d->scene, "c", 0.5), {0.5, 1, 1.5});
    expect_near(surface_at(*d->scene, "a", 0.5), {0, 0, 0, 0, 2});
    EXPECT_EQ(d->scene->animation.channels.size(), 3u);
}

TEST(GltfPointer, WhatNothingFollowsIsAFindingWithItsName) {
    for (const char* pointer :
         {"/materials/7/alphaCutoff", "/materials/0", "/materials/0/pbrMetallicRoughness", "/",
          "/materials/-1/alphaCutoff", "/nodes/1/extensions/KHR_node_visibility/visible",
          "/nodes/99999999999/translation", "/materials/0/extras/kinora_rsl/surface/params/nothing",
          "/meshes/0/weights", "no pointer", "/materials/0/alphaCutoff/", "/~2"}) {
        GltfText g = lit_square(rsl_material());
        drive(g, pointer, {0, 1}, {0, 1});
        auto d = described(g.glb());
        ASSERT_TRUE(d->scene) << pointer;
        EXPECT_EQ(d->count("GLTF_POINTER"), 1) << pointer << d->findings();
        EXPECT_NE(d->findings().find(pointer), std::string::npos) << d->findings();
        survive(g.glb(), ".glb");
    }
}

TEST(GltfPointer, AChannelWithoutASoundPointerIsAFinding) {
    for (const json& pointer : {json(1), json(), json::object(), json::array(), json("")}) {
        GltfText g = lit_square(json::object());
        drive(g, pointer, {0, 1}, {0, 1});
        auto d = described(g.glb());
        ASSERT_TRUE(d->scene);
        EXPECT_EQ(d->count("GLTF_ANIMATION"), 1) << d->findings();
        survive(g.glb(), ".glb");
    }
    GltfText g = lit_square(json::object());
    drive(g, "/materials/0/alphaCutoff", {0, 1}, {0, 0, 0, 1, 1, 1}, "VEC3");
    drive(g, "/materials/0/emissiveFactor", {0, 1}, {0, 1});
    drive(g, "/cameras/0/orthographic/xmag", {0, 1}, {0, 1}, "SCALAR", "WILD");
    auto d = described(g.glb());
    ASSERT_TRUE(d->scene);
    EXPECT_EQ(d->count("GLTF_ANIMATION"), 3) << d->findings();
    EXPECT_TRUE(d->scene->animation.channels.empty());
}

// tinygltf leaves out channels whose target has no node.
TEST(GltfPointer, ChannelsBehindOneWithoutANodeKeepTheirNumbers) {
    GltfText g = lit_square(json::object());
    drive(g, "/materials/0/alphaCutoff", {0, 1}, {0, 1});
    g.animate(0, 1, "rotation", "WILD", {0, 1}, {0, 0, 0, 1, 0, 0, 0, 1});
    g.json["animations"][0]["channels"].push_back(
        {{"sampler", 1}, {"target", {{"path", "scale"}}}});
    g.animate(0, 1, "weights", "LINEAR", {0, 1}, {0, 1});
    auto d = described(g.glb());
    ASSERT_TRUE(d->scene);
    bool named = false;
    for (const Finding& f : d->diagnostics.findings())
        named |= f.id_path == "/animations/0/channels/3/target";
    EXPECT_TRUE(named) << d->findings();
}

// ---- written

json exported(const SceneDescription& scene) {
    Diagnostics diagnostics;
    return json::parse(split_glb(export_glb(scene, {}, diagnostics)).json);
}

std::vector<std::string> pointers_of(const json& gltf) {
    std::vector<std::string> pointers;
    for (const json& animation : gltf.value("animations", json::array()))
        for (const json& channel : animation["channels"])
            if (channel["target"]["path"] == "pointer")
                pointers.push_back(
                    channel["target"]["extensions"]["KHR_animation_pointer"]["pointer"]);
    return pointers;
}

// A file's description, and that of what is written of it.
std::pair<std::unique_ptr<GltfDescription>, std::unique_ptr<GltfDescription>> both(
    const GltfText& g) {
    auto before = described(g.glb());
    Diagnostics diagnostics;
    auto after = described(export_glb(*before->scene, {}, diagnostics));
    for (const Finding& f : diagnostics.findings()) EXPECT_NE(f.info->code, "CONVERT_LOST");
    return {std::move(before), std::move(after)};
}

TEST(GltfPointer, WhatIsWrittenIsWhatWasRead) {
    GltfText g = lit_square({{"alphaMode", "BLEND"}});
    drive(g, "/materials/0/pbrMetallicRoughness/baseColorFactor", {0, 2}, {1, 0, 0, 1, 0, 1, 0, .5},
          "VEC4");
    drive(g, "/materials/0/emissiveFactor", {0, 1}, {0, 0, 0, 1, 0.5, 0}, "VEC3");
    drive(g, "/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength", {0, 1},
          {1, 3});
    drive(g, "/materials/0/extensions/KHR_materials_ior/ior", {0, 1}, {1.2, 2});
    drive(g, "/extensions/KHR_lights_punctual/lights/0/intensity", {0, 1}, {1, 8}, "SCALAR",
          "STEP");
    drive(g, "/cameras/0/orthographic/xmag", {0, 1}, {1, 3});
    auto [before, after] = both(g);
    ASSERT_TRUE(after->scene) << after->findings();
    EXPECT_EQ(after->findings(), "");
    for (double t : {0.0, 0.3, 0.7, 1.0, 1.5, 2.0}) {
        for (const char* name : {"base_color", "base_alpha", "emissive", "dielectric_F0"})
            expect_near(surface_at(*after->scene, name, t), surface_at(*before->scene, name, t),
                        1e-3);
        expect_near(numbers_at(*after->scene, after->scene->cameras[0].x, t),
                    numbers_at(*before->scene, before->scene->cameras[0].x, t));
        const ShaderUse &a = before->scene->lights[0].shader, &b = after->scene->lights[0].shader;
        expect_near(param_at(*after->scene, b, "intensity", t),
                    param_at(*before->scene, a, "intensity", t), 1e-5);
    }
}

TEST(GltfPointer, AValueThatHoldsItsKeyIsWrittenWithoutAChannel) {
    GltfText g = lit_square({{"alphaMode", "MASK"}});
    drive(g, "/materials/0/alphaCutoff", {0, 1}, {0.25, 0.25});
    auto before = described(g.glb());
    json written = exported(*before->scene);
    EXPECT_TRUE(pointers_of(written).empty());
    EXPECT_EQ(written["materials"][0]["alphaCutoff"], 0.25);
}

TEST(GltfPointer, MembersThatComeLaterStandAtRestWithGltfsDefaults) {
    GltfText g = lit_square(json::object());
    drive(g, "/materials/0/emissiveFactor", {0, 1}, {0, 0, 0, 1, 1, 0}, "VEC3");
    auto before = described(g.glb());
    json written = exported(*before->scene);
    EXPECT_EQ(written["materials"][0]["emissiveFactor"], json({0, 0, 0}));
    EXPECT_EQ(pointers_of(written), std::vector<std::string>{"/materials/0/emissiveFactor"});
    EXPECT_EQ(written["extensionsUsed"].count("KHR_animation_pointer"), 0u);
    bool used = false;
    for (const json& name : written["extensionsUsed"]) used |= name == "KHR_animation_pointer";
    EXPECT_TRUE(used);
}

TEST(GltfPointer, EqualMaterialsThatMoveApartAreTwo) {
    GltfText g = lit_square({{"name", "a"}});
    g.node({{"mesh", g.square(g.material({{"name", "a"}}))}});
    g.json["materials"][1]["name"] = "a";
    drive(g, "/materials/1/pbrMetallicRoughness/roughnessFactor", {0, 1}, {1, 0.5});
    auto before = described(g.glb());
    json written = exported(*before->scene);
    EXPECT_EQ(written["materials"].size(), 2u);
    EXPECT_EQ(pointers_of(written),
              std::vector<std::string>{"/materials/1/pbrMetallicRoughness/roughnessFactor"});
}

}  // namespace
}  // namespace kinora
