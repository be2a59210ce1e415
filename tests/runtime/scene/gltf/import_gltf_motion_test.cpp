// tests/runtime/scene/gltf/import_gltf_motion_test.cpp: glTF's animations, skins and morphs against
// formulas of the specification in double.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <glm/matrix.hpp>

#include "runtime/scene/description/play_range.h"
#include "runtime/scene/transforms.h"
#include "runtime/scene/vertices/deform.h"
#include "tests/runtime/scene/gltf/gltf_text.h"

namespace kinora {
namespace {

using nlohmann::json;
using Four = std::array<double, 4>;  // x y z w

std::vector<double> values_at(const SceneDescription& scene, double time) {
    std::vector<double> values = scene.values;
    std::vector<uint64_t> changed(anim::changed_words(scene.nodes.size() + scene.morphs.size() + 1),
                                  0);
    anim::evaluate(scene.animation, time, values, changed);
    return values;
}

// What one channel of a node's property gives at a time.
std::vector<double> animated(const char* path, const char* interpolation,
                             const std::vector<float>& times, const std::vector<float>& keys,
                             double time) {
    GltfText g;
    int n = g.node({{"name", "n"}});
    g.json["animations"].push_back({{"name", "move"}});
    g.animate(0, n, path, interpolation, times, keys);
    auto d = described(g.glb());
    EXPECT_EQ(d->findings(), "");
    if (!d->scene) return {};
    const Transform& t = d->scene->nodes[size_t(n)].transforms.at(0);
    std::vector<double> values = values_at(*d->scene, time);
    size_t count = std::string_view(path) == "rotation" ? 4 : 3;
    return {values.begin() + t.value, values.begin() + ptrdiff_t(t.value + count)};
}

TEST(GltfAnimation, StepHoldsAndLinearMixesWithinTheKeysAndTheEndsHold) {
    std::vector<float> times = {1, 2, 4}, keys = {0, 0, 0, 4, 0, 0, 8, 2, 0};
    auto at = [&](const char* interpolation, double time) {
        return animated("translation", interpolation, times, keys, time);
    };
    EXPECT_EQ(at("STEP", 1.99), (std::vector<double>{0, 0, 0}));
    EXPECT_EQ(at("STEP", 2), (std::vector<double>{4, 0, 0}));
    EXPECT_EQ(at("LINEAR", 3), (std::vector<double>{6, 1, 0}));
    EXPECT_EQ(at("LINEAR", 0), (std::vector<double>{0, 0, 0}));
    EXPECT_EQ(at("LINEAR", 9), (std::vector<double>{8, 2, 0}));
}

// glTF 2.0, appendix C.5, term by term.
double cubic(double v0, double out0, double in1, double v1, double duration, double s) {
    double s2 = s * s, s3 = s2 * s;
    return (2 * s3 - 3 * s2 + 1) * v0 + duration * (s3 - 2 * s2 + s) * out0 +
           (-2 * s3 + 3 * s2) * v1 + duration * (s3 - s2) * in1;
}

TEST(GltfAnimation, CubicsplineIsTheSpecificationsPolynomial) {
    std::vector<float> times = {0.5f, 2.0f, 2.5f};
    std::vector<float> keys;  // in, value, out of each key
    for (int k = 0; k < 3; ++k)
        for (int part = 0; part < 3; ++part)
            for (int c = 0; c < 3; ++c)
                keys.push_back(float(std::sin(1.7 * k + 2.3 * part + 0.9 * c)));
    for (double time : {0.5, 0.75, 1.9, 2.0, 2.2, 2.49}) {
        std::vector<double> got = animated("scale", "CUBICSPLINE", times, keys, time);
        size_t k = time < 2 ? 0 : 1;
        double duration = double(times[k + 1]) - double(times[k]);
        double s = (time - double(times[k])) / duration;
        for (size_t c = 0; c < 3; ++c) {
            auto part = [&](size_t key, size_t p) { return double(keys[key * 9 + p * 3 + c]); };
            double expected =
                cubic(part(k, 1), part(k, 2), part(k + 1, 0), part(k + 1, 1), duration, s);
            EXPECT_NEAR(got[c], expected, 1e-12) << time;
        }
    }
}

// Slerp written through the exponential: q0 (q0^-1 q1)^s by its angle and axis.
Four slerp(Four a, Four b, double s) {
    double dot = 0;
    for (int k = 0; k < 4; ++k) dot += a[size_t(k)] * b[size_t(k)];
    if (dot < 0) {
        dot = -dot;
        for (double& v : b) v = -v;
    }
    // In the plane of a and b: a is 1, what of b is square to it is i.
    Four side;
    double length = 0;
    for (size_t k = 0; k < 4; ++k) side[k] = b[k] - dot * a[k], length += side[k] * side[k];
    length = std::sqrt(length);
    std::complex<double> turn = std::pow(std::complex<double>(dot, length), s);
    Four q;
    for (size_t k = 0; k < 4; ++k)
        q[k] = turn.real() * a[k] + (length > 0 ? turn.imag() * side[k] / length : 0);
    return q;
}

Four turned(double angle, double x, double y, double z) {
    double l = std::sqrt(x * x + y * y + z * z), s = std::sin(angle / 2) / l;
    return {x * s, y * s, z * s, std::cos(angle / 2)};
}

void append(std::vector<float>& keys, const Four& q) {
    for (double v : q) keys.push_back(float(v));
}

TEST(GltfAnimation, LinearRotationsSlerpTheShorterWay) {
    Four a = turned(0.4, 1, 2, 3), b = turned(2.9, -1, 0.5, 2), minus_b = b;
    for (double& v : minus_b) v = -v;
    for (const Four& to : {b, minus_b}) {
        std::vector<float> keys;
        append(keys, a);
        append(keys, to);
        for (double s : {0.0, 0.1, 0.5, 0.83, 1.0}) {
            auto got = animated("rotation", "LINEAR", {0, 2}, keys, 2 * s);
            Four expected = slerp(a, to, s);
            double dot = 0;
            for (size_t k = 0; k < 4; ++k) dot += got[k] * expected[k];
            EXPECT_NEAR(std::abs(dot), 1, 1e-12) << s;
            EXPECT_NEAR(got[0] * got[0] + got[1] * got[1] + got[2] * got[2] + got[3] * got[3], 1,
                        1e-14);
        }
    }
}

TEST(GltfAnimation, CubicRotationsAreNormalised) {
    Four a = turned(0.4, 1, 2, 3), b = turned(1.2, -1, 0.5, 2);
    Four in = {0.3, -0.2, 0.1, 0.4}, out = {-0.5, 0.1, 0.6, 0.2};
    std::vector<float> keys;
    for (const Four& q : {in, a, out, in, b, out}) append(keys, q);
    for (double s : {0.0, 0.25, 0.6, 1.0}) {
        auto got = animated("rotation", "CUBICSPLINE", {0, 4}, keys, 4 * s);
        Four expected;
        double square = 0;
        for (size_t k = 0; k < 4; ++k) {
            expected[k] = cubic(double(float(a[k])), double(float(out[k])), double(float(in[k])),
                                double(float(b[k])), 4, s);
            square += expected[k] * expected[k];
        }
        for (size_t k = 0; k < 4; ++k)
            EXPECT_NEAR(got[k], expected[k] / std::sqrt(square), 1e-12) << s;
    }
}

TEST(GltfAnimation, EachIsAClipAndAllPlayAtOnceUnlessTheyMeet) {
    GltfText g;
    int a = g.node({{"name", "a"}}), b = g.node({{"name", "b"}});
    for (const char* name : {"walk", "wave", "run"})
        g.json["animations"].push_back({{"name", name}});
    g.animate(0, a, "translation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 0});
    g.animate(1, b, "translation", "LINEAR", {0.5, 3}, {0, 0, 0, 0, 5, 0});
    g.animate(2, a, "translation", "LINEAR", {0, 2}, {0, 0, 0, 0, 0, 7});
    auto d = described(g.glb());
    ASSERT_TRUE(d->scene) << d->findings();
    EXPECT_EQ(d->count("GLTF_ANIMATIONS_MEET"), 1);
    SceneDescription& scene = *d->scene;
    PlayRange range = play_range(scene);
    EXPECT_EQ(range.start, 0);
    EXPECT_EQ(range.end, 3);
    ASSERT_EQ(scene.clips.size(), 3u);
    uint32_t of_a = scene.nodes[size_t(a)].transforms[0].value;
    uint32_t of_b = scene.nodes[size_t(b)].transforms[0].value;
    EXPECT_EQ(values_at(scene, 3)[of_a], 1);
    EXPECT_EQ(values_at(scene, 3)[of_b + 1], 5);
    play_clip(scene, *find_clip(scene, "run"));
    EXPECT_EQ(play_range(scene).end, 2);
    EXPECT_EQ(values_at(scene, 2)[of_a], 0);
    EXPECT_EQ(values_at(scene, 2)[of_a + 2], 7);
    EXPECT_EQ(values_at(scene, 2)[of_b + 1], 0);
    EXPECT_TRUE(scene.animated[of_a]);
    EXPECT_FALSE(scene.animated[of_b]);
}

// ---- skins and morphs: deformed vertices of a built scene

// World positions of the first shape's vertices at a time.
std::vector<dvec3> posed(Rendering& r, double time) {
    r.frame(time);
    if (!r.scene || r.scene->shapes.empty()) return {};
    std::vector<dvec3> positions;
    for (const vec4& p : r.pose->shapes[0].shown_positions)
        positions.push_back(dvec3(p) + r.scene->origin);
    return positions;
}

void expect_positions(const std::vector<dvec3>& got, const std::vector<dvec3>& expected) {
    ASSERT_EQ(got.size(), expected.size());
    for (size_t i = 0; i < got.size(); ++i)
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(got[i][k], expected[i][k], 2e-6) << i << " " << k;
}

// A triangle held by two joints, the second below the first and turning about z.
struct Skinned {
    GltfText g;
    std::vector<dvec3> rest = {{0, 0, 0}, {0.5, 0, 0}, {0.5, 0.5, 0}};
    int upper, mesh_node;

    explicit Skinned(bool inverse_bind = true) {
        int m =
            g.mesh({{"POSITION", g.floats({0, 0, 0, 0.5, 0, 0, 0.5, 0.5, 0}, "VEC3")},
                    {"JOINTS_0", bytes({0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0})},
                    {"WEIGHTS_0", g.floats({1, 0, 0, 0, 0.25, 0.75, 0, 0, 1, 0, 0, 0}, "VEC4")}});
        mesh_node = g.node({{"mesh", m}, {"skin", 0}, {"translation", {100, 0, 0}}});
        int lower = g.node({{"name", "lower"}, {"translation", {-0.25, 0, 0}}});
        g.json["nodes"].push_back({{"name", "upper"}, {"translation", {0.5, 0, 0}}});
        upper = int(g.json["nodes"].size()) - 1;
        g.json["nodes"][size_t(lower)]["children"] = {upper};
        g.json["skins"] = {{{"joints", {lower, upper}}}};
        // Bind pose: joints at 0 and 0.5.
        if (inverse_bind)
            g.json["skins"][0]["inverseBindMatrices"] =
                g.floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,    0, 0, 1,
                          1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -0.5, 0, 0, 1},
                         "MAT4");
        g.json["animations"].push_back(json::object());
        float h = float(std::sqrt(0.5));
        g.animate(0, upper, "rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 0, h, h});
    }
    int bytes(std::vector<uint8_t> joints) {
        return g.accessor(g.view(joints.data(), joints.size()), 5121, joints.size() / 4, "VEC4");
    }
};

TEST(GltfSkin, VerticesFollowTheirJointsAndNotTheirNode) {
    Skinned s;
    auto r = rendering_of(s.g);
    for (double time : {0.0, 0.5, 1.0}) {
        double angle = time * M_PI / 2;
        auto lower = [](dvec3 p) { return p + dvec3(-0.25, 0, 0); };
        auto upper = [&](dvec3 p) {
            dvec3 q = p - dvec3(0.5, 0, 0);
            return dvec3(std::cos(angle) * q.x - std::sin(angle) * q.y + 0.25,
                         std::sin(angle) * q.x + std::cos(angle) * q.y, q.z);
        };
        expect_positions(posed(*r, time),
                         {lower(s.rest[0]), 0.25 * lower(s.rest[1]) + 0.75 * upper(s.rest[1]),
                          upper(s.rest[2])});
    }
}

TEST(GltfSkin, WithoutInverseBindMatricesTheyAreTheIdentity) {
    Skinned s(false);
    auto r = rendering_of(s.g);
    auto lower = [](dvec3 p) { return p + dvec3(-0.25, 0, 0); };
    auto upper = [](dvec3 p) { return p + dvec3(0.25, 0, 0); };
    expect_positions(
        posed(*r, 0),
        {lower(s.rest[0]), 0.25 * lower(s.rest[1]) + 0.75 * upper(s.rest[1]), upper(s.rest[2])});
}

TEST(GltfSkin, ASecondSetOfJointsCounts) {
    Skinned s;
    auto& attributes = s.g.json["meshes"][0]["primitives"][0]["attributes"];
    // The first vertex: 0.5 lower in the first set, 0.5 upper in the second.
    attributes["WEIGHTS_0"] = s.g.floats({0.5, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    attributes["JOINTS_1"] = s.bytes({0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    attributes["WEIGHTS_1"] = s.g.floats({0, 0, 0.5, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
    auto r = rendering_of(s.g);
    EXPECT_NEAR(posed(*r, 1)[0].x, 0.5 * -0.25 + 0.5 * 0.25, 2e-6);
    EXPECT_NEAR(posed(*r, 1)[0].y, 0.5 * -0.5, 2e-6);
}

TEST(GltfMorph, TargetsAddByWeightsOfTheMeshTheNodeAndChannels) {
    GltfText g;
    int m = g.mesh({{"POSITION", g.floats({0, 0, 0, 0.5, 0, 0, 0, 0.5, 0}, "VEC3")}});
    g.json["meshes"][size_t(m)]["primitives"][0]["targets"] = {
        {{"POSITION", g.floats({0, 0, 1, 0, 0, 0, 0, 0, 0}, "VEC3")}},
        {{"POSITION", g.floats({0, 0, 0, 0, 0.25, 0, 0, 0, 0}, "VEC3")}}};
    g.json["meshes"][size_t(m)]["weights"] = {0.5, 0.0};
    int n = g.node({{"mesh", m}, {"translation", {0.125, 0, 0}}});
    auto positions = [](double w0, double w1) {
        return std::vector<dvec3>{{0.125, 0, w0}, {0.625, 0.25 * w1, 0}, {0.125, 0.5, 0}};
    };
    expect_positions(posed(*rendering_of(g), 0), positions(0.5, 0));
    g.json["nodes"][size_t(n)]["weights"] = {0.25, 1.0};
    expect_positions(posed(*rendering_of(g), 0), positions(0.25, 1));
    g.json["animations"].push_back(json::object());
    g.animate(0, n, "weights", "LINEAR", {0, 2}, {0, 1, 1, -1});
    auto r = rendering_of(g);
    expect_positions(posed(*r, 1), positions(0.5, 0));
    expect_positions(posed(*r, 2), positions(1, -1));
}

// What a frame is does not depend on the one before it.
TEST(GltfMorph, AFrameAloneIsTheFrameInASequence) {
    Skinned s;
    SceneOptions options;
    options.background_rebuilds = false;  // as kinora-render has it
    auto sequence = rendering_of(s.g, options), alone = rendering_of(s.g, options);
    for (double time : {0.0, 0.25, 0.75}) sequence->frame(time);
    alone->frame(0.75);
    EXPECT_TRUE(same_bytes(sequence->film, alone->film)) << difference(sequence->film, alone->film);
}

}  // namespace
}  // namespace kinora
