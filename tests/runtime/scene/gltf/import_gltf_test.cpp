// tests/runtime/scene/gltf/import_gltf_test.cpp: glTF's structure: accessors, primitives, nodes,
// cameras.
#include <gtest/gtest.h>

#include <cstring>

#include "runtime/scene/transforms.h"
#include "tests/runtime/scene/gltf/gltf_text.h"

namespace kinora {
namespace {

using nlohmann::json;

const MeshDefinition& mesh(const GltfDescription& d, size_t index = 0) {
    return d.scene->meshes.at(index);
}
const PrimitiveGroup& group(const GltfDescription& d, size_t index = 0) {
    return mesh(d).groups.at(index);
}
const VertexAttribute* attribute(const PrimitiveGroup& group, std::string_view semantic) {
    for (const VertexAttribute& a : group.attributes)
        if (a.semantic == semantic) return &a;
    return nullptr;
}

const std::vector<float> kFour = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

GltfText with_mesh(const std::function<int(GltfText&)>& make) {
    GltfText g;
    int m = make(g);
    g.node({{"mesh", m}, {"name", "thing"}});
    return g;
}

TEST(Gltf, GlbAndGltfWithADataUriAreTheSame) {
    GltfText g = with_mesh([](GltfText& s) { return s.square(); });
    auto binary = described(g.glb()), text = described(g.gltf(), ".gltf");
    ASSERT_TRUE(binary->scene) << binary->findings();
    ASSERT_TRUE(text->scene) << text->findings();
    EXPECT_EQ(mesh(*binary).positions, mesh(*text).positions);
    EXPECT_EQ(group(*binary).triangles, group(*text).triangles);
    EXPECT_EQ(binary->findings() + text->findings(), "");
}

TEST(Gltf, IndicesOfEveryWidthAndNoneGiveTheSameTriangles) {
    std::vector<uint32_t> expected = {0, 1, 2, 0, 2, 3};
    auto triangles = [&](int type, auto values) {
        GltfText g = with_mesh([&](GltfText& s) {
            int v = s.view(values.data(), values.size() * sizeof values[0]);
            return s.mesh({{"POSITION", s.floats(kFour, "VEC3")}},
                          s.accessor(v, type, values.size(), "SCALAR"));
        });
        auto d = described(g.glb());
        return group(*d).triangles;
    };
    EXPECT_EQ(triangles(5121, std::vector<uint8_t>{0, 1, 2, 0, 2, 3}), expected);
    EXPECT_EQ(triangles(5123, std::vector<uint16_t>{0, 1, 2, 0, 2, 3}), expected);
    EXPECT_EQ(triangles(5125, std::vector<uint32_t>{0, 1, 2, 0, 2, 3}), expected);
    GltfText none = with_mesh([](GltfText& s) {
        return s.mesh({{"POSITION", s.floats({0, 0, 0, 1, 0, 0, 1, 1, 0}, "VEC3")}});
    });
    EXPECT_EQ(group(*described(none.glb())).triangles, (std::vector<uint32_t>{0, 1, 2}));
}

// glTF 2.0, 3.7.2.1: strip triangle i = {i, i + (1 + i % 2), i + (2 - i % 2)}, fan {i + 1, i + 2,
// 0}.
TEST(Gltf, StripsAndFansBecomeTriangles) {
    auto triangles = [&](int mode) {
        GltfText g = with_mesh([&](GltfText& s) {
            return s.mesh(
                {{"POSITION", s.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}, "VEC3")}}, -1,
                -1, mode);
        });
        return group(*described(g.glb())).triangles;
    };
    EXPECT_EQ(triangles(5), (std::vector<uint32_t>{0, 1, 2, 1, 3, 2, 2, 3, 4}));
    EXPECT_EQ(triangles(6), (std::vector<uint32_t>{1, 2, 0, 2, 3, 0, 3, 4, 0}));
}

TEST(Gltf, PointsAndLinesAreReadNotShadedAndToldOf) {
    for (int mode : {0, 1, 2, 3}) {
        GltfText g = with_mesh([&](GltfText& s) {
            return s.mesh({{"POSITION", s.floats(kFour, "VEC3")}}, -1, -1, mode);
        });
        auto d = described(g.glb());
        EXPECT_EQ(d->count("GLTF_NOT_SHADED"), 1) << mode;
        EXPECT_TRUE(mesh(*d).groups.empty());
    }
}

TEST(Gltf, InterleavedVerticesAreReadByTheirStride) {
    GltfText g = with_mesh([](GltfText& s) {
        std::vector<float> rows;
        for (int i = 0; i < 3; ++i)
            rows.insert(rows.end(), {float(i), float(i * i), 0, /*normal*/ 0, 0, 1});
        int v = s.view(rows.data(), rows.size() * 4, 24);
        return s.mesh({{"POSITION", s.accessor(v, 5126, 3, "VEC3")},
                       {"NORMAL", s.accessor(v, 5126, 3, "VEC3", 12)}});
    });
    auto d = described(g.glb());
    EXPECT_EQ(mesh(*d).positions[2], dvec3(2, 4, 0));
    EXPECT_EQ(attribute(group(*d), "NORMAL")->values,
              (std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}));
}

// glTF 2.0, 3.11: f = c / 127, floored at -1; c / 255; c / 32767; c / 65535.
TEST(Gltf, NormalizedIntegersAreFractions) {
    GltfText g = with_mesh([](GltfText& s) {
        std::vector<int8_t> p = {0, 0, 0, 0, 127, 0, 0, 0, -128, 127, 0, 0};
        std::vector<uint16_t> uv = {0, 65535, 32768, 0, 0, 0};
        std::vector<uint8_t> color = {255, 51, 0, 255, 0, 0, 0, 0, 0, 0, 0, 128};
        return s.mesh(
            {{"POSITION", s.accessor(s.view(p.data(), 12, 4), 5120, 3, "VEC3", 0, true)},
             {"TEXCOORD_0", s.accessor(s.view(uv.data(), 12, 4), 5123, 3, "VEC2", 0, true)},
             {"COLOR_0", s.accessor(s.view(color.data(), 12, 4), 5121, 3, "VEC4", 0, true)}});
    });
    auto d = described(g.glb());
    ASSERT_TRUE(d->scene) << d->findings();
    EXPECT_EQ(mesh(*d).positions[1], dvec3(1, 0, 0));
    EXPECT_EQ(mesh(*d).positions[2], dvec3(-1, 1, 0));
    const VertexAttribute* st = attribute(group(*d), "TEXCOORD");
    EXPECT_EQ(st->values[1], 0.0f);  // v = 1 is t = 0
    EXPECT_FLOAT_EQ(st->values[2], 32768.0f / 65535);
    const VertexAttribute* color = attribute(group(*d), "COLOR");
    EXPECT_EQ(color->stride, 4u);
    EXPECT_FLOAT_EQ(color->values[1], 0.2f);
    EXPECT_FLOAT_EQ(attribute(group(*d), "vertex_alpha")->values[2], 128.0f / 255);
}

TEST(Gltf, IntegersOfQuantizedMeshesAreWholeNumbers) {
    GltfText g = with_mesh([](GltfText& s) {
        std::vector<int16_t> p = {0, 0, 0, 0, 300, 0, 0, 0, -7, 20000, 0, 0};
        return s.mesh({{"POSITION", s.accessor(s.view(p.data(), 24, 8), 5122, 3, "VEC3")}});
    });
    g.json["extensionsUsed"] = g.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    auto d = described(g.glb());
    ASSERT_TRUE(d->scene) << d->findings();
    EXPECT_EQ(mesh(*d).positions[2], dvec3(-7, 20000, 0));
}

TEST(Gltf, SparseAccessorsReplaceElementsOfAViewOrOfZeros) {
    for (bool has_view : {true, false}) {
        GltfText g = with_mesh([&](GltfText& s) {
            int base = has_view ? s.view(kFour.data(), 48) : -1;
            int position = s.accessor(base, 5126, 4, "VEC3");
            std::vector<uint16_t> indices = {1, 3};
            std::vector<float> values = {5, 6, 7, 8, 9, 10};
            s.json["accessors"][size_t(position)]["sparse"] = {
                {"count", 2},
                {"indices", {{"bufferView", s.view(indices.data(), 4)}, {"componentType", 5123}}},
                {"values", {{"bufferView", s.view(values.data(), 24)}}}};
            return s.mesh({{"POSITION", position}}, s.shorts({0, 1, 2}));
        });
        auto d = described(g.glb());
        ASSERT_TRUE(d->scene) << d->findings();
        EXPECT_EQ(mesh(*d).positions[1], dvec3(5, 6, 7));
        EXPECT_EQ(mesh(*d).positions[2], has_view ? dvec3(1, 1, 0) : dvec3(0, 0, 0));
        EXPECT_EQ(mesh(*d).positions[3], dvec3(8, 9, 10));
    }
}

TEST(Gltf, MissingNormalsAreFlat) {
    GltfText g = with_mesh([](GltfText& s) {
        return s.mesh({{"POSITION", s.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3")}},
                      s.shorts({0, 1, 2, 0, 2, 3}));
    });
    auto d = described(g.glb());
    EXPECT_FALSE(attribute(group(*d), "NORMAL"));  // N is Ng then (meshes_test.cpp)
}

TEST(Gltf, PrimitivesThatShareTheirVerticesShareThem) {
    GltfText g = with_mesh([](GltfText& s) {
        int position = s.floats(kFour, "VEC3");
        int m = s.mesh({{"POSITION", position}}, s.shorts({0, 1, 2}));
        s.json["meshes"][size_t(m)]["primitives"].push_back(
            {{"attributes", {{"POSITION", position}}}, {"indices", s.shorts({0, 2, 3})}});
        return m;
    });
    auto d = described(g.glb());
    EXPECT_EQ(mesh(*d).positions.size(), 4u);
    EXPECT_EQ(group(*d, 1).triangles, (std::vector<uint32_t>{0, 2, 3}));
}

// The application's own attributes reach shader parameters of their name.
TEST(Gltf, AttributesWithAnUnderscoreAreVertexInputs) {
    GltfText g = with_mesh([](GltfText& s) {
        return s.mesh({{"POSITION", s.floats({0, 0, 0, 1, 0, 0, 1, 1, 0}, "VEC3")},
                       {"_heat", s.floats({1, 2, 3}, "SCALAR")},
                       {"_COLOR_1", s.floats({1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3")}});
    });
    auto d = described(g.glb());
    EXPECT_EQ(attribute(group(*d), "heat")->values, (std::vector<float>{1, 2, 3}));
    EXPECT_EQ(attribute(group(*d), "COLOR")->set, 1u);
}

// ---- nodes

dmat4 local(const GltfDescription& d, std::string_view id) {
    for (const NodeDefinition& node : d.scene->nodes)
        if (node.id == id) return node_matrix(node, d.scene->values);
    ADD_FAILURE() << "no node " << id;
    return dmat4(0.0);
}

TEST(Gltf, AMatrixAndItsTranslationRotationScaleAreOneNode) {
    // A turn of 90 degrees about z after a scale of 2, 3, 4: x -> 2y, y -> -3x.
    GltfText g;
    double half = std::sqrt(0.5);
    g.node({{"name", "trs"},
            {"translation", {5, 6, 7}},
            {"rotation", {0, 0, half, half}},
            {"scale", {2, 3, 4}}});
    g.node({{"name", "matrix"}, {"matrix", {0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 5, 6, 7, 1}}});
    auto d = described(g.glb());
    ASSERT_TRUE(d->scene) << d->findings();
    dmat4 a = local(*d, "trs"), b = local(*d, "matrix");
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) EXPECT_NEAR(a[c][r], b[c][r], 1e-15) << c << r;
    EXPECT_NEAR(a[0][1], 2, 1e-15);
    EXPECT_NEAR(a[1][0], -3, 1e-15);
}

TEST(Gltf, NodesAndMeshesKnowWhereTheyStandInTheFile) {
    GltfText g = with_mesh([](GltfText& s) { return s.square(); });
    g.node({{"name", "more [ { \" than one"}, {"scale", {0, 1, 1}}});
    auto d = described(g.gltf(), ".gltf");
    ASSERT_TRUE(d->scene) << d->findings();
    auto text_at = [&](const Location& where) {
        std::string_view text = d->diagnostics.files.text(where.file);
        return nlohmann::json::parse(text.substr(where.begin, where.end - where.begin));
    };
    ASSERT_EQ(d->scene->nodes.size(), g.json["nodes"].size());
    for (size_t n = 0; n < d->scene->nodes.size(); ++n)
        EXPECT_EQ(text_at(d->scene->nodes[n].where), g.json["nodes"][n]) << n;
    EXPECT_EQ(text_at(d->scene->meshes[0].where), g.json["meshes"][0]);
}

TEST(Gltf, OnlyTheScenesOwnNodesAreShown) {
    GltfText g = with_mesh([](GltfText& s) { return s.square(); });
    g.json["nodes"].push_back({{"mesh", 0}, {"name", "elsewhere"}});
    g.json["scenes"].push_back({{"nodes", {2}}});
    auto d = described(g.glb());
    EXPECT_TRUE(d->scene->nodes[2].meshes.empty());
    g.json["scene"] = 1;
    d = described(g.glb());
    ASSERT_EQ(d->scene->roots.size(), 1u);
    EXPECT_EQ(d->scene->roots[0].node, 2u);
    EXPECT_EQ(d->scene->nodes[2].meshes.size(), 1u);
}

TEST(Gltf, AFileWithoutScenesShowsAllRoots) {
    GltfText g = with_mesh([](GltfText& s) { return s.square(); });
    g.json["nodes"][1]["children"] = {2};
    g.json["nodes"].push_back({{"name", "child"}});
    g.json.erase("scenes");
    g.json.erase("scene");
    auto d = described(g.glb());
    ASSERT_EQ(d->scene->roots.size(), 2u);
    EXPECT_EQ(d->scene->roots[0].node, 0u);
    EXPECT_EQ(d->scene->roots[1].node, 1u);
    EXPECT_EQ(d->count("GLTF_NO_SCENE"), 1);
}

TEST(Gltf, NamesThatStandForSeveralNodesBecomeIdsOfOne) {
    GltfText g;
    g.node({{"name", "twin"}});
    g.node({{"name", "twin"}});
    g.node(json::object());
    auto d = described(g.glb());
    EXPECT_EQ(d->scene->nodes[1].id, "twin");
    EXPECT_EQ(d->scene->nodes[2].id, "twin.2");
    EXPECT_EQ(d->scene->nodes[3].id, "node_3");
}

// ---- cameras

TEST(Gltf, CamerasKeepTheirVerticalFieldOfViewAndMayEndNowhere) {
    GltfText g;
    g.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.2}}}},
        {{"type", "perspective"},
         {"perspective", {{"yfov", 1.0}, {"znear", 0.1}, {"zfar", 50}, {"aspectRatio", 1.5}}}},
        {{"type", "orthographic"},
         {"orthographic", {{"xmag", 2}, {"ymag", 3}, {"znear", 0.5}, {"zfar", 9}}}}};
    auto d = described(g.glb());
    ASSERT_TRUE(d->scene) << d->findings();
    auto value = [&](ValueSlot slot) { return d->scene->values.at(slot.offset); };
    const auto& cameras = d->scene->cameras;
    EXPECT_NEAR(value(cameras[0].y), 0.5 * 180 / M_PI, 1e-12);
    EXPECT_FALSE(cameras[0].zfar.present() || cameras[0].aspect.present() ||
                 cameras[0].x.present());
    EXPECT_EQ(value(cameras[1].aspect), 1.5);
    EXPECT_EQ(value(cameras[1].zfar), 50);
    EXPECT_TRUE(cameras[2].orthographic);
    EXPECT_EQ(value(cameras[2].x), 2);
    EXPECT_EQ(value(cameras[2].y), 3);
}

}  // namespace
}  // namespace kinora
