// tests/runtime/scene/gltf/import_gltf_picture_test.cpp: glTF's materials, textures and lights as
// pixels, against formulas of the specification in double.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/runtime/scene/gltf/gltf_text.h"

namespace kinora {
namespace {

using nlohmann::json;

// A square of 2 x 2 that fills the picture, seen along -z, in one material.
GltfText wall(json material, double turned = 0) {
    GltfText g;
    int m = g.material(std::move(material));
    json node = {{"mesh", g.square(m)}};
    if (turned != 0) node["rotation"] = {0, std::sin(turned / 2), 0, std::cos(turned / 2)};
    g.node(node);
    return g;
}

GltfText& lit(GltfText& g, json light, json node = json::object()) {
    g.json["extensionsUsed"].push_back("KHR_lights_punctual");
    auto& lights = g.json["extensions"]["KHR_lights_punctual"]["lights"];
    lights.push_back(std::move(light));
    node["extensions"]["KHR_lights_punctual"]["light"] = lights.size() - 1;
    g.node(node);
    return g;
}

json unlit(json base) {
    return {{"pbrMetallicRoughness", base},
            {"extensions", {{"KHR_materials_unlit", json::object()}}}};
}

vec3 middle(const GltfText& g) {
    auto r = rendering_of(g);
    r->scene->watch_dark = false;  // some lights are meant to reach nothing
    r->frame();
    EXPECT_EQ(r->findings(), "");
    return r->color(8, 8);
}

void expect_near(vec3 a, dvec3 b, double relative) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], relative * std::max(b[k], 1e-3)) << k;
}

// glTF 2.0, appendix B.3, written anew: one light of irradiance E (perpendicular), angles to the
// normal in the plane of incidence.
dvec3 brdf_radiance(dvec3 base, double metal, double rough, double light_angle, double view_angle,
                    double E, double ior = 1.5) {
    double a = rough * rough, pi = M_PI;
    dvec3 n(0, 0, 1), l(std::sin(light_angle), 0, std::cos(light_angle)),
        v(std::sin(view_angle), 0, std::cos(view_angle)), h = glm::normalize(l + v);
    auto dot = [](dvec3 x, dvec3 y) { return x.x * y.x + x.y * y.y + x.z * y.z; };
    double nl = dot(n, l), nv = dot(n, v), nh = dot(n, h), vh = dot(v, h);
    double d = a * a / (pi * std::pow(nh * nh * (a * a - 1) + 1, 2));
    auto g1 = [&](double x) { return 2 * x / (x + std::sqrt(a * a + (1 - a * a) * x * x)); };
    // height-correlated Smith: 1 / (1 + L(l) + L(v)), L = (1 / g1 - 1)
    double g = 1 / (1 + (1 / g1(nl) - 1) + (1 / g1(nv) - 1));
    double f0 = std::pow((ior - 1) / (ior + 1), 2);
    dvec3 result;
    for (int k = 0; k < 3; ++k) {
        double F0 = f0 + (base[k] - f0) * metal;
        double F = F0 + (1 - F0) * std::pow(1 - vh, 5);
        double diffuse = (1 - F) * base[k] * (1 - metal) / pi;
        result[k] = (diffuse + F * d * g / (4 * nl * nv)) * nl * E;
    }
    return result;
}

TEST(GltfMaterial, UnlitIsItsColour) {
    expect_near(middle(wall(unlit({{"baseColorFactor", {0.25, 0.5, 0.75, 1}}}))),
                dvec3(0.25, 0.5, 0.75), 1e-6);
}

TEST(GltfMaterial, AWhiteWallUnderOneLuxIsOneOverPi) {
    GltfText g = wall({{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 1}}},
                       {"extensions", {{"KHR_materials_ior", {{"ior", 1.0}}}}}});
    lit(g, {{"type", "directional"}});
    // With an ior of 1 nothing is reflected but at grazing angles.
    expect_near(middle(g), dvec3(1 / M_PI), 1e-5);
}

struct Case {
    double metal, rough, light_angle, view_angle;
};

TEST(GltfMaterial, ReflectsAsTheSpecificationsFormula) {
    for (Case c : {Case{0, 1, 0, 0}, Case{0, 0.5, 0.4, 0}, Case{1, 0.5, 0.4, 0},
                   Case{1, 0.25, 0.3, 0.2}, Case{0.3, 0.7, 0.9, 0.5}, Case{1, 1, 1.2, 0}}) {
        // The wall turned about y by -view: the eye on +z then sees it from `view` towards +x.
        GltfText g = wall({{"doubleSided", true},
                           {"pbrMetallicRoughness",
                            {{"baseColorFactor", {0.9, 0.6, 0.2, 1}},
                             {"metallicFactor", c.metal},
                             {"roughnessFactor", c.rough}}}},
                          -c.view_angle);
        // Light comes along a node's -z: turned so that it comes from that angle to the normal.
        double light = c.light_angle - c.view_angle;
        lit(g, {{"type", "directional"}, {"intensity", 2.5}},
            {{"rotation", {0, std::sin(light / 2), 0, std::cos(light / 2)}}});
        expect_near(
            middle(g),
            brdf_radiance({0.9, 0.6, 0.2}, c.metal, c.rough, c.light_angle, c.view_angle, 2.5),
            2e-3);
    }
}

// KHR_materials_pbrSpecularGlossiness: F0 is the specular color, the base is the diffuse one times
// 1 - max(specular), and alpha is (1 - glossiness)^2. Light and eye are on the normal, where
// D = 1 / (pi alpha^2), and G is 1.
dvec3 specular_radiance(dvec3 diffuse, dvec3 specular, double glossiness, double E) {
    double alpha = (1 - glossiness) * (1 - glossiness), most = 0;
    for (int k = 0; k < 3; ++k) most = std::max(most, specular[k]);
    dvec3 result;
    for (int k = 0; k < 3; ++k) {
        double body = (1 - specular[k]) * diffuse[k] * (1 - most) / M_PI;
        result[k] = E * (body + specular[k] / (4 * M_PI * alpha * alpha));
    }
    return result;
}

GltfText glossy_wall(json extension) {
    GltfText g = wall({{"extensions", {{"KHR_materials_pbrSpecularGlossiness", extension}}}});
    g.json["extensionsUsed"] = {"KHR_materials_pbrSpecularGlossiness"};
    lit(g, {{"type", "directional"}, {"intensity", 2}});
    return g;
}

TEST(GltfMaterial, SpecularGlossinessReflectsByItsFactors) {
    expect_near(middle(glossy_wall({{"diffuseFactor", {0.1, 0.8, 0.2, 1}},
                                    {"specularFactor", {0.04, 0.04, 0.04}},
                                    {"glossinessFactor", 0.3}})),
                specular_radiance({0.1, 0.8, 0.2}, {0.04, 0.04, 0.04}, 0.3, 2), 2e-3);
    expect_near(middle(glossy_wall({{"diffuseFactor", {0.5, 0.5, 0.5, 1}},
                                    {"specularFactor", {0.6, 0.3, 0.1}},
                                    {"glossinessFactor", 0.2}})),
                specular_radiance({0.5, 0.5, 0.5}, {0.6, 0.3, 0.1}, 0.2, 2), 2e-3);
}

TEST(GltfMaterial, SpecularGlossinessMultipliesItsTextures) {
    GltfText g;
    // Display values of specular color; glossiness in alpha is none.
    int map = g.texture(1, 1, {128, 255, 0, 102}, json::object());
    int base = g.texture(1, 1, {255, 128, 255, 255}, json::object());
    int m = g.material({{"extensions",
                         {{"KHR_materials_pbrSpecularGlossiness",
                           {{"diffuseTexture", {{"index", base}}},
                            {"specularFactor", {0.5, 0.25, 1}},
                            {"glossinessFactor", 0.5},
                            {"specularGlossinessTexture", {{"index", map}}}}}}}});
    g.node({{"mesh", g.square(m)}});
    lit(g, {{"type", "directional"}, {"intensity", 2}});
    double half = std::pow((128 / 255.0 + 0.055) / 1.055, 2.4);  // IEC 61966-2-1
    expect_near(middle(g), specular_radiance({1, half, 1}, {0.5 * half, 0.25, 0}, 0.5 * 0.4, 2),
                2e-3);
}

TEST(GltfMaterial, BrokenSpecularGlossinessIsAsIfItsPartWereNotThere) {
    for (json broken : {json(7), json{{"diffuseFactor", "red"}}, json{{"diffuseTexture", 3}},
                        json{{"diffuseTexture", {{"index", 4294967295u}}}},
                        json{{"specularFactor", {nullptr, 1}}}}) {
        auto d = described(glossy_wall(broken).glb());
        ASSERT_TRUE(d->scene) << broken;
        EXPECT_EQ(d->scene->materials.size(), 1u);
    }
}

TEST(GltfMaterial, EmissionIsInCandelaPerSquareMetreWithItsStrength) {
    GltfText g =
        wall({{"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1}}}},
              {"emissiveFactor", {0.5, 0.25, 1}},
              {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}}}}});
    lit(g, {{"type", "directional"}, {"intensity", 0}});
    expect_near(middle(g), dvec3(2, 1, 4), 1e-5);
}

TEST(GltfMaterial, AlphaModesHideAllCutOrBlend) {
    auto alpha = [](const char* mode, double value, double cutoff) {
        json m = unlit({{"baseColorFactor", {1, 1, 1, value}}});
        m["alphaMode"] = mode;
        m["alphaCutoff"] = cutoff;
        auto r = rendering_of(wall(m));
        r->frame();
        return r->film.at(8, 8).w;
    };
    EXPECT_EQ(alpha("OPAQUE", 0.25, 0.5), 1);
    EXPECT_EQ(alpha("MASK", 0.25, 0.5), 0);
    EXPECT_EQ(alpha("MASK", 0.25, 0.25), 1);
    EXPECT_FLOAT_EQ(alpha("BLEND", 0.25, 0.5), 0.25f);
}

TEST(GltfMaterial, SingleSidedOnesAreNotSeenFromBehind) {
    for (bool both : {false, true}) {
        json m = unlit({{"baseColorFactor", {1, 1, 1, 1}}});
        m["doubleSided"] = both;
        auto r = rendering_of(wall(m, M_PI));
        r->frame();
        EXPECT_EQ(r->film.at(8, 8).w, both ? 1 : 0);
    }
}

TEST(GltfMaterial, VertexColoursMultiply) {
    GltfText g;
    int m = g.material(unlit({{"baseColorFactor", {0.5, 1, 1, 1}}}));
    std::vector<float> colors;
    for (int i = 0; i < 3; ++i) colors.insert(colors.end(), {0.5f, 0.25f, 1.0f, 0.5f});
    g.json["materials"][size_t(m)]["alphaMode"] = "BLEND";
    g.node({{"mesh", g.mesh({{"POSITION", g.floats({-3, -3, 0, 3, -3, 0, 0, 3, 0}, "VEC3")},
                             {"COLOR_0", g.floats(colors, "VEC4")}},
                            -1, m)}});
    auto r = rendering_of(g);
    r->frame();
    EXPECT_FLOAT_EQ(r->film.at(8, 8).w, 0.5f) << r->findings();
    expect_near(r->color(8, 8), dvec3(0.125, 0.125, 0.5), 1e-6);
}

// ---- textures: four texels, red green / blue white from the top

const std::vector<uint8_t> kTexels = {255, 0, 0,   255, 0,   255, 0,   255,
                                      0,   0, 255, 255, 255, 255, 255, 255};
const json kNearest = {{"magFilter", 9728}, {"wrapS", 33071}, {"wrapT", 33071}};

GltfText textured(json info, const json& sampler = kNearest, int width = 2,
                  const std::vector<uint8_t>& texels = kTexels) {
    GltfText g;
    int t = g.texture(width, int(texels.size()) / 4 / width, texels, sampler);
    info["index"] = t;
    int m = g.material(unlit({{"baseColorTexture", info}}));
    g.node({{"mesh", g.square(m)}});
    return g;
}

std::string quarters(const GltfText& g) {
    auto r = rendering_of(g);
    r->frame();
    EXPECT_EQ(r->findings(), "");
    std::string text;
    for (int y : {4, 12})
        for (int x : {4, 12}) {
            vec3 c = r->color(x, y);
            text += c == vec3(1, 0, 0)   ? 'r'
                    : c == vec3(0, 1, 0) ? 'g'
                    : c == vec3(0, 0, 1) ? 'b'
                    : c == vec3(1)       ? 'w'
                                         : '?';
        }
    return text;
}

TEST(GltfTexture, TheFirstTexelIsTheUpperLeft) {
    EXPECT_EQ(quarters(textured(json::object())), "rgbw");
}

TEST(GltfTexture, ADataUriIsAsGoodAsABufferView) {
    GltfText g = textured(json::object());
    GltfFileOnDisk file(g.gltf(), ".gltf");
    auto r = Rendering::of_file(file.path());
    r->frame();
    EXPECT_EQ(r->color(4, 4), vec3(1, 0, 0)) << r->findings();
}

// KHR_texture_transform: uv' = offset + R(rotation) scale uv.
TEST(GltfTexture, TransformsMoveTurnAndScaleTheCoordinates) {
    auto with = [](json transform, const json& sampler) {
        GltfText g = textured({{"extensions", {{"KHR_texture_transform", transform}}}}, sampler);
        g.json["extensionsUsed"] = {"KHR_texture_transform"};
        return quarters(g);
    };
    json repeat = {{"magFilter", 9728}};
    EXPECT_EQ(with({{"offset", {0.5, 0}}}, repeat), "grwb");
    EXPECT_EQ(with({{"offset", {0, 0.5}}}, repeat), "bwrg");
    EXPECT_EQ(with({{"scale", {0.5, 0.5}}}, repeat), "rrrr");
    // u' = cos u + sin v, v' = -sin u + cos v: at 90 degrees (u, v) looks up (v, -u).
    EXPECT_EQ(with({{"rotation", M_PI / 2}}, repeat), "brwg");
    EXPECT_EQ(with({{"rotation", M_PI / 2}, {"offset", {0, 1}}}, kNearest), "brwg");
    // The extension's example: "only the lower left quadrant of the source image".
    EXPECT_EQ(with({{"rotation", M_PI / 2}, {"offset", {0, 1}}, {"scale", {0.5, 0.5}}}, kNearest),
              "bbbb");
}

TEST(GltfTexture, TheSetOfTheTextureInfoIsLookedUp) {
    GltfText g = textured({{"texCoord", 1}});
    // Set 1 is set 0 turned around.
    auto& attributes = g.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["TEXCOORD_1"] = g.floats({1, 0, 0, 0, 0, 1, 1, 1}, "VEC2");
    EXPECT_EQ(quarters(g), "wbgr");
}

TEST(GltfTexture, WrapModesRepeatMirrorAndClamp) {
    auto with = [](int wrap) {
        return quarters(
            textured({{"extensions", {{"KHR_texture_transform", {{"offset", {1, 0}}}}}}},
                     {{"magFilter", 9728}, {"wrapS", wrap}, {"wrapT", 33071}}));
    };
    EXPECT_EQ(with(10497), "rgbw");
    EXPECT_EQ(with(33648), "grwb");
    EXPECT_EQ(with(33071), "ggww");
}

TEST(GltfTexture, ColoursAreDecodedFromSrgbAndDataIsNot) {
    std::vector<uint8_t> grey = {128, 128, 128, 255};
    double linear = std::pow((128 / 255.0 + 0.055) / 1.055, 2.4);  // IEC 61966-2-1
    auto r = rendering_of(textured(json::object(), kNearest, 1, grey));
    r->frame();
    EXPECT_NEAR(r->color(8, 8).x, linear, 1e-4);
    // Roughness 128 / 255 in green, metalness 128 / 255 in blue.
    GltfText g;
    int t = g.texture(1, 1, grey, kNearest);
    int m = g.material({{"pbrMetallicRoughness",
                         {{"baseColorFactor", {0.9, 0.6, 0.2, 1}},
                          {"metallicRoughnessTexture", {{"index", t}}}}}});
    g.node({{"mesh", g.square(m)}});
    lit(g, {{"type", "directional"}, {"intensity", 2}});
    expect_near(middle(g), brdf_radiance({0.9, 0.6, 0.2}, 128 / 255.0, 128 / 255.0, 0, 0, 2), 2e-3);
}

// A flat normal map that leans by an angle: light from the eye meets the wall at that angle.
TEST(GltfTexture, NormalMapsLeanTowardsGrowingUAndUpwards) {
    double lean = 0.5;
    auto byte = [](double x) { return uint8_t(std::lround((x * 0.5 + 0.5) * 255)); };
    for (bool upwards : {false, true}) {
        GltfText g;
        uint8_t side = byte(std::sin(lean)), none = byte(0);
        int t = g.texture(1, 1,
                          {upwards ? none : side, upwards ? side : none, byte(std::cos(lean)), 255},
                          kNearest);
        int m = g.material({{"pbrMetallicRoughness", {{"metallicFactor", 0}}},
                            {"extensions", {{"KHR_materials_ior", {{"ior", 1.0}}}}},
                            {"normalTexture", {{"index", t}}}});
        g.node({{"mesh", g.square(m)}});
        // From +x, or from above, at the angle of the lean: full light; without the map, its
        // cosine.
        json turn = upwards ? json{-std::sin(lean / 2), 0, 0, std::cos(lean / 2)}
                            : json{0, std::sin(lean / 2), 0, std::cos(lean / 2)};
        lit(g, {{"type", "directional"}}, {{"rotation", turn}});
        EXPECT_NEAR(middle(g).x, 1 / M_PI, 0.01 / M_PI) << upwards;
    }
}

// The file's tangents count: turned by 90 degrees against the coordinates, what leaned along
// growing u leans up or down; mirrored and turned nodes take them along.
TEST(GltfTexture, TangentsOfTheFileTurnTheNormalMap) {
    double lean = 0.5;
    auto byte = [](double x) { return uint8_t(std::lround((x * 0.5 + 0.5) * 255)); };
    auto brightness = [&](std::vector<float> tangent, json light_turn, json node, bool along_B) {
        GltfText g;
        uint8_t side = byte(std::sin(lean)), none = byte(0);
        int t = g.texture(1, 1,
                          {along_B ? none : side, along_B ? side : none, byte(std::cos(lean)), 255},
                          kNearest);
        int m = g.material({{"pbrMetallicRoughness", {{"metallicFactor", 0}}},
                            {"doubleSided", true},
                            {"extensions", {{"KHR_materials_ior", {{"ior", 1.0}}}}},
                            {"normalTexture", {{"index", t}}}});
        int mesh = g.square(m);
        std::vector<float> all;
        for (int i = 0; i < 4; ++i) all.insert(all.end(), tangent.begin(), tangent.end());
        g.json["meshes"][size_t(mesh)]["primitives"][0]["attributes"]["TANGENT"] =
            g.floats(all, "VEC4");
        node["mesh"] = mesh;
        g.node(node);
        lit(g, {{"type", "directional"}}, {{"rotation", light_turn}});
        return middle(g).x * M_PI;
    };
    float s = float(std::sin(lean / 2)), c = float(std::cos(lean / 2));
    json from_right = {0, s, 0, c}, from_left = {0, -s, 0, c}, from_above = {-s, 0, 0, c},
         from_below = {s, 0, 0, c}, plain = json::object();
    // As the coordinates have it, and turned: +y, -x.
    EXPECT_NEAR(brightness({1, 0, 0, 1}, from_right, plain, false), 1, 0.01);
    EXPECT_NEAR(brightness({0, 1, 0, 1}, from_above, plain, false), 1, 0.01);
    EXPECT_NEAR(brightness({-1, 0, 0, -1}, from_left, plain, false), 1, 0.01);
    // The bitangent is (N x T) w: up for T = +x and w = 1, down for -1.
    EXPECT_NEAR(brightness({1, 0, 0, 1}, from_above, plain, true), 1, 0.01);
    EXPECT_NEAR(brightness({1, 0, 0, -1}, from_below, plain, true), 1, 0.01);
    // The node turns by 90 degrees about z: +x becomes +y. A mirrored node mirrors them.
    float h = float(std::sqrt(0.5));
    EXPECT_NEAR(brightness({1, 0, 0, 1}, from_above, {{"rotation", {0, 0, h, h}}}, false), 1, 0.01);
    EXPECT_NEAR(brightness({1, 0, 0, 1}, from_left, {{"scale", {-1, 1, 1}}}, false), 1, 0.01);
    EXPECT_NEAR(brightness({1, 0, 0, 1}, from_above, {{"scale", {-1, 1, 1}}}, true), 1, 0.01);
}

// ---- lights

TEST(GltfLight, PointsFallWithTheSquareOfTheDistanceUpToTheirRange) {
    auto at = [](double distance, double range) {
        GltfText g = wall({{"pbrMetallicRoughness", {{"metallicFactor", 0}}},
                           {"extensions", {{"KHR_materials_ior", {{"ior", 1.0}}}}}});
        json light = {{"type", "point"}, {"intensity", 40}};
        if (range > 0) light["range"] = range;
        lit(g, light, {{"translation", {0.0625, -0.0625, distance}}});  // over pixel 8, 8
        return g;
    };
    auto radiance = [&](double distance, double range) { return middle(at(distance, range)).x; };
    EXPECT_NEAR(radiance(2, 0), 40 / (M_PI * 4), 1e-4);
    EXPECT_NEAR(radiance(4, 0), 40 / (M_PI * 16), 1e-4);
    // KHR_lights_punctual: max(min(1 - (d / range)^4, 1), 0) / d^2
    EXPECT_NEAR(radiance(4, 5), 40 / (M_PI * 16) * (1 - std::pow(0.8, 4)), 1e-4);
    auto beyond = rendering_of(at(4, 3.9));
    EXPECT_EQ(beyond->frame().color(8, 8).x, 0);
    EXPECT_EQ(beyond->count("LIGHTS_DARK"), 1);
}

TEST(GltfLight, SpotsFadeFromTheInnerToTheOuterCone) {
    double inner = 0.1, outer = 0.3, height = 4;
    GltfText g = wall({{"pbrMetallicRoughness", {{"metallicFactor", 0}}},
                       {"extensions", {{"KHR_materials_ior", {{"ior", 1.0}}}}}});
    lit(g,
        {{"type", "spot"},
         {"intensity", 40},
         {"spot", {{"innerConeAngle", inner}, {"outerConeAngle", outer}}}},
        {{"translation", {0, 0, height}}});
    auto r = rendering_of(g);
    r->frame(64, 64);
    for (int x : {32, 40, 48, 56, 63}) {
        dvec2 at = r->place(x, 32);
        dvec3 l(-at.x, -at.y, height);
        double d = std::sqrt(l.x * l.x + l.y * l.y + l.z * l.z), cosine = height / d;
        // KHR_lights_punctual, inner and outer cone angles
        double scale = 1 / std::max(0.001, std::cos(inner) - std::cos(outer));
        double cone = std::clamp((cosine - std::cos(outer)) * scale, 0.0, 1.0);
        EXPECT_NEAR(r->color(x, 32).x, 40 * cone * cone * cosine / (M_PI * d * d), 2e-3) << x;
    }
}

TEST(GltfLight, BlendersLumensAWattAreTakenBack) {
    GltfText g = wall({{"pbrMetallicRoughness", {{"metallicFactor", 0}}},
                       {"extensions", {{"KHR_materials_ior", {{"ior", 1.0}}}}}});
    g.json["asset"]["generator"] = "Khronos glTF Blender I/O v3.4.50";
    lit(g, {{"type", "directional"}, {"intensity", 683 * 2}});
    auto r = rendering_of(g);
    r->frame();
    EXPECT_NEAR(r->color(8, 8).x, 2 / M_PI + 0.05, 2e-4);  // and its world, by Karis's fit
    EXPECT_EQ(r->count("GLTF_LIGHT_WATTS"), 1);
}

TEST(GltfLight, BlendersGreyWorldLightsWhatItsLampsDoNot) {
    for (const char* generator : {"Khronos glTF Blender I/O v3.4.50", "COLLADA2GLTF"}) {
        bool blender = std::string(generator).starts_with("Khronos");
        GltfText g = wall({{"pbrMetallicRoughness", {{"metallicFactor", 0}}},
                           {"extensions", {{"KHR_materials_ior", {{"ior", 1.0}}}}}});
        g.json["asset"]["generator"] = generator;
        lit(g, {{"type", "directional"}, {"intensity", 1}}, {{"rotation", {0, 1, 0, 0}}});
        auto r = rendering_of(g);
        EXPECT_NEAR(r->frame().color(8, 8).x, blender ? 0.05 : 0, 2e-4) << generator;
        EXPECT_EQ(r->count("LIGHTS_WORLD"), blender) << r->findings();
        EXPECT_EQ(r->count("LIGHTS_DARK"), 1);
    }
}

// ---- RSL

TEST(GltfRsl, CodeInAMaterialsExtrasReplacesItsSurface) {
    GltfText g = wall({{"name", "m"}});
    g.json["materials"][0]["extras"]["kinora_rsl"] = {
        {"surface",
         {{"code",
           "surface show(float a = 0; color c = 0; float k[2] = {0, 0};)\n"
           "{ Oi = 1; Ci = a * c + k[1]; }\n"},
          {"params", {{"a", 0.5}}}}},
        {"params", {{"c", {1, 0.5, 0}}, {"k", {7, 0.25}}}}};
    expect_near(middle(g), dvec3(0.75, 0.5, 0.25), 1e-6);
}

TEST(GltfRsl, ErrorsInCodeHaveTheirPlaceInTheJson) {
    GltfText g = wall({{"name", "m"}});
    g.json["materials"][0]["extras"]["kinora_rsl"] = {
        {"surface", "surface show()\n{ Ci = wrong; }\n"}};
    std::string text = g.gltf();
    auto d = described(text, ".gltf");
    ASSERT_TRUE(d->scene);
    bool found = false;
    for (const Finding& f : d->diagnostics.findings())
        if (f.severity == Severity::Error) {
            EXPECT_EQ(text.substr(f.where.begin, 5), "wrong") << d->findings();
            found = true;
        }
    EXPECT_TRUE(found);
}

TEST(GltfRsl, ParametersThatDoNotFitAreToldOf) {
    GltfText g = wall({{"name", "m"}});
    g.json["materials"][0]["extras"]["kinora_rsl"] = {
        {"surface", {{"library", "plastic"}, {"params", {{"Kd", "no"}, {"Ksx", 1}}}}},
        {"params", {{"nothing", 1}}}};
    auto d = described(g.glb());
    EXPECT_EQ(d->count("RSL_BIND_TYPE"), 1) << d->findings();
    EXPECT_EQ(d->count("RSL_BIND_UNKNOWN"), 2);
    EXPECT_NE(d->findings().find("did you mean 'Ks'?"), std::string::npos);
}

}  // namespace
}  // namespace kinora
