// tests/collada/deviations_test.cpp: each of the 25 things that real exporters do loads, is told by
// its code, and becomes the scene that was meant (docs/format.md#what-exporters-get-wrong; files by
// deviations/make.py).
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "collada/validate/validate.h"
#include "reading.h"
#include "tests/folders.h"

namespace kinora::collada {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(test_data_folder()) / "deviations";

struct Deviation {
    const char* file;
    std::vector<const char*> at_load;  // findings that every program gives
    std::vector<const char*> by_lint;  // and those the validator adds
    std::function<void(const Reading&)> check;
};

const MeshInstance& mesh(const Reading& r, const char* node = "n") {
    static const MeshInstance kNone_;
    const Node& n = r.node(node);
    EXPECT_FALSE(n.meshes.empty()) << node;
    return n.meshes.empty() ? kNone_ : n.meshes[0];
}

// Both joints lead to nodes, the second to the one that turns.
void joints_are_found(const Reading& r) {
    const MeshInstance& m = mesh(r);
    ASSERT_EQ(m.joint_nodes.size(), 2u);
    for (uint32_t joint : m.joint_nodes) ASSERT_NE(joint, kNone);
    EXPECT_FALSE(r.scene->nodes[m.joint_nodes[1]].transforms.empty());
    EXPECT_NE(m.joint_nodes[0], m.joint_nodes[1]);
}

size_t triangles(const Reading& r) {
    size_t n = 0;
    for (const PrimitiveGroup& group : r.scene->geometries.at(0).groups)
        n += group.indices[0].size() / 3;
    return n;
}

const CommonShading& common(const Reading& r) {
    return *r.scene->effects.at(0).common;
}

const std::vector<Deviation> kDeviations = {
    {"01_no_skeleton", {"SKIN_NO_SKELETON"}, {}, joints_are_found},
    {"02_joints_by_name", {"SKIN_JOINT_FALLBACK"}, {}, joints_are_found},
    {"03_spaces_in_joint_names",
     {"SKIN_JOINT_NAMES"},
     {},
     [](const Reading& r) {
         joints_are_found(r);
         EXPECT_EQ(r.scene->skins.at(0).joints,
                   (std::vector<std::string>{"upper arm", "lower arm"}));
     }},
    {"04_several_skeletons",
     {"SKIN_OUTSIDE_SKELETON"},
     {},
     [](const Reading& r) {
         joints_are_found(r);
         EXPECT_EQ(mesh(r).skeleton_roots.size(), 2u);
     }},
    {"05_curves",
     {},
     {"PORT_BEZIER"},
     [](const Reading& r) {
         const Sampler& s = r.scene->samplers.at(0);
         EXPECT_EQ(s.interpolation, (std::vector{Interpolation::Bezier, Interpolation::Hermite,
                                                 Interpolation::Step}));
         EXPECT_EQ(s.tangent_dims, 2);
     }},
    {"06_tangent_dimensions",
     {"ANIM_TANGENT_MISSING"},
     {},
     [](const Reading& r) {
         ASSERT_EQ(r.scene->samplers.size(), 2u);
         EXPECT_EQ(r.scene->samplers[0].tangent_dims, 1);
         EXPECT_EQ(r.scene->samplers[0].out_tangents, (std::vector<double>{20, 20}));
     }},
    {"07_single_axes",
     {},
     {"PORT_AXIS_CHANNEL"},
     [](const Reading& r) {
         ASSERT_EQ(r.scene->channels.size(), 4u);
         const uint32_t first[] = {0, 1, 3, 3 * 4 + 2};  // a matrix by columns
         for (size_t c = 0; c < 4; ++c) {
             EXPECT_EQ(r.scene->channels[c].ref.first, first[c]) << r.scene->channels[c].target;
             EXPECT_EQ(r.scene->channels[c].ref.count, 1u);
         }
     }},
    {"08_full_turns",
     {},
     {"PORT_ROTATION"},
     [](const Reading& r) {
         EXPECT_EQ(r.scene->samplers.at(0).values, (std::vector<double>{0, 720}));
         EXPECT_EQ(r.node("n").transforms.at(0).kind, TransformKind::Rotate);
     }},
    {"09_pivots",
     {},
     {"PORT_STACK"},
     [](const Reading& r) {
         EXPECT_EQ(r.node("n").transforms.size(), 8u);
         EXPECT_EQ(r.scene->channels.at(0).ref.slot, 3u);
     }},
    {"10_clips",
     {"ANIM_CLIP_RANGE"},
     {"PORT_CLIPS"},
     [](const Reading& r) {
         ASSERT_EQ(r.scene->clips.size(), 1u);
         EXPECT_EQ(r.scene->clips[0].start, 0.5);
         EXPECT_EQ(r.scene->clips[0].end, 1.0);
         ASSERT_EQ(r.scene->channels.size(), 2u);
         EXPECT_TRUE(r.scene->channels[0].in_clip);
         EXPECT_FALSE(r.scene->channels[1].in_clip);
     }},
    {"11_up_axis",
     {},
     {"UPAXIS_MISSING"},
     [](const Reading& r) { EXPECT_EQ(r.scene->asset.up_axis, UpAxis::Y); }},
    {"12_units",
     {"UNIT_CONFLICT"},
     {},
     [](const Reading& r) { EXPECT_EQ(r.scene->asset.meter, 1.0); }},
    {"13_transparency",
     {"FX_TRANSPARENT_ALL"},
     {},
     [](const Reading& r) {
         EXPECT_TRUE(r.scene->materials.at(0).invisible);
         EXPECT_EQ(common(r).opaque, Opaque::RgbZero);
     }},
    {"14_direct_image",
     {"TEX_DIRECT_IMAGE", "TEX_NO_TEXCOORD"},
     {},
     [](const Reading& r) {
         ASSERT_EQ(r.scene->images.size(), 1u);
         EXPECT_TRUE(fs::exists(r.scene->images[0].path));
         EXPECT_EQ(common(r)[CommonSlot::Diffuse].source, SlotSource::Texture);
     }},
    {"15_no_vertex_input",
     {"TEX_NO_BVI", "TEX_SET_MISSING"},
     {},
     [](const Reading& r) {
         const auto& inputs = mesh(r).materials.at(0).vertex_inputs;
         ASSERT_EQ(inputs.size(), 1u);
         EXPECT_EQ(inputs[0].input_set, 7u);  // the number in its name
     }},
    {"16_materials",
     {"MAT_ONLY_BOUND", "MAT_NO_BIND"},
     {},
     [](const Reading& r) {
         const auto& materials = mesh(r).materials;  // the only one, under the mesh's own symbol
         ASSERT_EQ(materials.size(), 2u);
         EXPECT_EQ(materials[1].material, materials[0].material);
         EXPECT_EQ(materials[1].symbol, r.scene->geometries[mesh(r).geometry].groups[0].material);
         EXPECT_TRUE(mesh(r, "n2").materials.empty());
     }},
    {"17_image_paths",
     {"FILE_FALLBACK", "FILE_MISSING", "FILE_ABSOLUTE", "FILE_BACKSLASH", "FILE_HOST"},
     {},
     [](const Reading& r) {
         ASSERT_EQ(r.scene->images.size(), 7u);
         for (size_t i = 0; i < 6; ++i)
             EXPECT_TRUE(r.scene->images[i].path.ends_with("map.png")) << r.scene->images[i].uri;
         EXPECT_EQ(r.scene->images[6].path, "");
     }},
    {"18_empty_primitives",
     {"PRIM_EMPTY", "PRIM_STRIP_SHORT"},
     {},
     [](const Reading& r) {
         EXPECT_EQ(triangles(r), 17u);
     }},  // the house's 16 and one of <polylist>
    {"19_concave",
     {},
     {"PORT_HOLES", "PORT_STRIPS"},
     [](const Reading& r) {
         EXPECT_EQ(triangles(r), 3u + 8u + 2u);  // n + 2 holes - 2 for a loop of n corners in all
         // A concave corner at (0, 0) cuts a quarter of the square, the hole takes 0.24.
         const Geometry& g = r.scene->geometries.at(0);
         double area = 0;
         for (size_t t = 0; t < g.groups.at(0).indices[0].size(); t += 3) {
             dvec3 p[3];
             for (size_t k = 0; k < 3; ++k) p[k] = g.positions[g.groups[0].indices[0][t + k]];
             area += 0.5 * ((p[1].x - p[0].x) * (p[2].y - p[0].y) -
                            (p[2].x - p[0].x) * (p[1].y - p[0].y));
         }
         EXPECT_NEAR(area, 3 + 3 - 0.24, 1e-9);
     }},
    {"20_shared_offsets",
     {},
     {"PORT_VERTEX_INPUT"},
     [](const Reading& r) {
         const PrimitiveGroup& group = r.scene->geometries.at(0).groups.at(0);
         std::string semantics;
         for (const VertexInput& input : group.inputs) semantics += input.semantic + " ";
         for (const char* wanted : {"NORMAL", "COLOR", "TEXCOORD"})
             EXPECT_NE(semantics.find(wanted), std::string::npos) << semantics;
     }},
    {"21_order",
     {"SCHEMA_EMPTY_LIBRARY", "SCHEMA_ORDER", "SCHEMA_UNKNOWN_ATTRIBUTE"},
     {},
     [](const Reading& r) { EXPECT_EQ(r.scene->cameras.size(), 1u); }},
    {"22_ids",
     {"ID_DUPLICATE"},
     {"ID_BAD_CHAR"},
     [](const Reading& r) {
         EXPECT_EQ(mesh(r).materials.at(0).material, 0u);
         EXPECT_EQ(r.scene->cameras.size(), 1u);
     }},
    {"23_number_forms",
     {"SRC_COMMA_DECIMAL", "SRC_NAN_INF", "SRC_COUNT", "PRIM_INDEX_NEGATIVE"},
     {},
     [](const Reading& r) {
         EXPECT_EQ(r.scene->geometries.at(0).positions.at(0), dvec3(-0.6, -0.5, 0.3));
         EXPECT_EQ(triangles(r), 16u);
     }},
    {"24_cameras",
     {"CAM_FOV"},
     {"PORT_CAMERA"},
     [](const Reading& r) {
         ASSERT_EQ(r.scene->cameras.size(), 5u);
         EXPECT_TRUE(r.scene->cameras[0][CameraSlot::Xfov].present());
         EXPECT_FALSE(r.scene->cameras[0][CameraSlot::Yfov].present());
         EXPECT_TRUE(r.scene->cameras[3].orthographic);
     }},
    {"25_extras",
     {},
     {"PORT_EXTRA"},
     [](const Reading& r) {
         EXPECT_FALSE(common(r).double_sided);
         EXPECT_EQ(common(r)[CommonSlot::Bump].source, SlotSource::Texture);
         EXPECT_EQ(common(r).bump_amount, 0.5);
         const TextureSampler& s =
             r.scene->effects[0].samplers.at(common(r)[CommonSlot::Diffuse].sampler);
         EXPECT_EQ(s.wrap_s, Wrap::Clamp);
         EXPECT_EQ(s.repeat, vec2(2, 3));
     }},
};

class Deviations : public testing::TestWithParam<Deviation> {};

TEST_P(Deviations, LoadAndSayWhatWasAssumed) {
    const Deviation& row = GetParam();
    Reading r;
    read_file(r, (kFolder / (std::string(row.file) + ".dae")).string());
    ASSERT_TRUE(r.scene) << r.all();
    for (const char* code : row.at_load) EXPECT_GE(r.count(code), 1u) << code << "\n" << r.all();
    ASSERT_EQ(r.scene->roots.empty(), false);
    row.check(r);
    Reading v;
    v.document = read_document((kFolder / (std::string(row.file) + ".dae")).string(), v.diag);
    validate(*v.document, v.diag);
    for (const char* code : row.by_lint) EXPECT_GE(v.count(code), 1u) << code << "\n" << v.all();
}

INSTANTIATE_TEST_SUITE_P(All, Deviations, testing::ValuesIn(kDeviations),
                         [](const auto& test) { return "Nr" + std::string(test.param.file); });

TEST(DeviationFiles, AreTwentyFive) {
    EXPECT_EQ(kDeviations.size(), 25u);
    size_t files = 0;
    for (const auto& entry : fs::directory_iterator(kFolder))
        files += entry.path().extension() == ".dae";
    EXPECT_EQ(files, 25u);
}

}  // namespace
}  // namespace kinora::collada
