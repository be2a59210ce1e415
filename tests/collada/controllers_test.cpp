// tests/collada/controllers_test.cpp: skins, morphs and the joints they find.
#include <gtest/gtest.h>

#include "tests/collada/reading.h"

namespace kinora::collada {
namespace {

TEST(Skin, ReadsMatricesJointsAndInfluences) {
    Reading r;
    read_file(r, test_file("skinned.dae"));
    ASSERT_TRUE(r.scene && r.scene->skins.size() == 1) << r.all();
    const Skin& skin = r.scene->skins[0];
    EXPECT_EQ(skin.bind_shape_matrix[3], dvec4(5, 6, 7, 1));
    EXPECT_EQ(skin.joints, (std::vector<std::string>{"Upper Arm", "hand"}));  // joined again
    EXPECT_EQ(r.count("SKIN_JOINT_NAMES"), 1u);
    EXPECT_EQ(skin.inverse_bind[0][3], dvec4(1, 2, 3, 1));
    EXPECT_EQ(skin.inverse_bind[1], dmat4(1.0));
    EXPECT_EQ(skin.offsets, (std::vector<uint32_t>{0, 1, 3, 4}));
    EXPECT_EQ(skin.influence_joints, (std::vector<int32_t>{0, 0, 1, -1}));
    EXPECT_EQ(skin.influence_weights, (std::vector<float>{1, 0.25f, 0.75f, 1}));
    const MeshInstance& mesh = r.node("body").meshes.at(0);
    EXPECT_EQ(mesh.skin, 0u);
    EXPECT_EQ(mesh.morph, 0u);
    ASSERT_EQ(mesh.joint_nodes.size(), 2u);
    EXPECT_EQ(r.scene->nodes[mesh.joint_nodes[0]].id, "arm");
    EXPECT_EQ(r.scene->nodes[mesh.joint_nodes[1]].id, "hand-id");
}

TEST(Morph, LeavesOutMissingTargetsAndKeepsWeightsAligned) {
    Reading r;
    read_file(r, test_file("skinned.dae"));
    ASSERT_TRUE(r.scene && r.scene->morphs.size() == 1);
    const Morph& morph = r.scene->morphs[0];
    EXPECT_EQ(morph.method, MorphMethod::Relative);
    ASSERT_EQ(morph.targets.size(), 1u);
    EXPECT_EQ(r.scene->geometries[morph.targets[0]].id, "big");
    EXPECT_EQ(morph.weights, (std::vector<double>{0.25}));
    EXPECT_EQ(r.count("MORPH_TARGET_MISSING"), 1u);
}

// By hand: a metre is 100 units of the base, whose y axis is the target's z.
TEST(Morph, TargetsHaveTheUnitAndTheAxesOfTheirBase) {
    auto geometry = [](const std::string& id, const std::string& asset, const char* numbers) {
        return "<geometry id=\"" + id + "\">" + asset + "<mesh>" +
               float_source(id + "-p", numbers, 3, "XYZ") +
               float_source(id + "-n", "0 0 1", 3, "XYZ") + "<vertices id=\"" + id +
               "-v\"><input semantic=\"POSITION\" source=\"#" + id +
               "-p\"/></vertices><triangles count=\"1\"><input semantic=\"VERTEX\" source=\"#" +
               id + "-v\" offset=\"0\"/><input semantic=\"NORMAL\" source=\"#" + id +
               "-n\" offset=\"1\"/><p>0 0 1 0 2 0</p></triangles></mesh></geometry>";
    };
    std::string own =
        "<asset><created/><modified/><unit meter=\"1\"/><up_axis>Z_UP</up_axis></asset>";
    std::string text = with_scene(
        "<asset><unit meter=\"0.01\"/><up_axis>Y_UP</up_axis></asset><library_geometries>" +
            geometry("g", "", "0 0 0 1 0 0 0 1 0") + geometry("t", own, "0 0 0 1 0 0 0 0.25 2") +
            geometry("u", "", "0 0 0 2 0 0 0 2 0") +
            "</library_geometries><library_controllers><controller id=\"c\"><morph source=\"#g\">"
            "<source id=\"ct\"><IDREF_array id=\"cta\" count=\"3\">t u t</IDREF_array>"
            "<technique_common><accessor source=\"#cta\" count=\"3\"><param type=\"IDREF\"/>"
            "</accessor></technique_common></source>" +
            float_source("cw", "0 0 0", 1, "W") +
            "<targets><input semantic=\"MORPH_TARGET\" source=\"#ct\"/><input "
            "semantic=\"MORPH_WEIGHT\" source=\"#cw\"/></targets></morph></controller>"
            "</library_controllers>",
        "<node id=\"n\"><instance_controller url=\"#c\"/></node>");
    Reading r;
    read_text(r, text);
    ASSERT_TRUE(r.scene && r.scene->morphs.size() == 1) << r.all();
    const std::vector<uint32_t>& targets = r.scene->morphs[0].targets;
    ASSERT_EQ(targets.size(), 3u) << r.all();
    EXPECT_EQ(targets[0], targets[2]);  // one copy
    const Geometry& converted = r.scene->geometries[targets[0]];
    EXPECT_EQ(converted.positions, (std::vector<dvec3>{{0, 0, 0}, {100, 0, 0}, {0, 200, -25}}));
    EXPECT_EQ(converted.sources.at(0).values, (std::vector<float>{0, 1, 0}));
    EXPECT_EQ(r.scene->geometries[targets[1]].positions[1], dvec3(2, 0, 0));  // as it is
}

TEST(Morph, OfAnotherMorphChangesItsResultAndOneOfItselfIsLeftOut) {
    std::string mesh =
        "<library_geometries><geometry id=\"g\"><mesh>" +
        float_source("pos", "0 0 0 1 0 0 0 1 0", 3, "XYZ") +
        "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#pos\"/></vertices>"
        "<triangles count=\"1\"><input semantic=\"VERTEX\" source=\"#v\" "
        "offset=\"0\"/><p>0 1 2</p></triangles></mesh></geometry>"
        "</library_geometries>";
    auto morph = [](const std::string& id, const std::string& source) {
        std::string t = id + "-t", w = id + "-w";
        return "<controller id=\"" + id + "\"><morph source=\"#" + source + "\"><source id=\"" + t +
               "\"><IDREF_array id=\"" + t +
               "-a\" count=\"1\">g</IDREF_array><technique_common>"
               "<accessor source=\"#" +
               t +
               "-a\" count=\"1\"><param type=\"IDREF\"/></accessor>"
               "</technique_common></source>" +
               float_source(w, "0.5", 1, "W") +
               "<targets><input semantic=\"MORPH_TARGET\" source=\"#" + t +
               "\"/><input "
               "semantic=\"MORPH_WEIGHT\" source=\"#" +
               w + "\"/></targets></morph></controller>";
    };
    auto shown = [&](Reading& r, const std::string& base) {
        read_text(r, with_scene(mesh + "<library_controllers>" + morph("outer", base) +
                                    morph("inner", "g") + "</library_controllers>",
                                "<node id=\"n\"><instance_controller url=\"#outer\"/></node>"));
        return r.scene ? r.node("n").meshes.size() : 0;
    };
    Reading of_morph, of_itself;
    ASSERT_EQ(shown(of_morph, "inner"), 1u) << of_morph.all();
    const Morph& outer = of_morph.scene->morphs.at(of_morph.node("n").meshes[0].morph);
    EXPECT_EQ(outer.id, "outer");
    EXPECT_EQ(of_morph.scene->morphs.at(outer.base).id, "inner");
    EXPECT_EQ(of_morph.count("MORPH_SOURCE"), 0u) << of_morph.all();
    Reading chain;  // of 40: too long a one is told once and shows what it is written on
    std::string controllers = morph("c0", "g");
    for (int k = 1; k < 40; ++k)
        controllers += morph("c" + std::to_string(k), "c" + std::to_string(k - 1));
    read_text(chain,
              with_scene(mesh + "<library_controllers>" + controllers + "</library_controllers>",
                         "<node id=\"n\"><instance_controller url=\"#c39\"/></node>"));
    EXPECT_EQ(chain.count("MORPH_DEPTH"), 1u) << chain.all();
    EXPECT_EQ(shown(of_itself, "outer"), 0u);
}

std::string skin_document(const std::string& joints, const std::string& array,
                          const std::string& weights, const std::string& nodes,
                          const std::string& skeleton) {
    return with_scene(
        "<library_geometries><geometry id=\"g\"><mesh>" +
            float_source("pos", "0 0 0 1 0 0 0 1 0", 3, "XYZ") +
            "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#pos\"/></vertices>"
            "<triangles count=\"1\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>"
            "<p>0 1 2</p></triangles></mesh></geometry></library_geometries>"
            "<library_controllers><controller id=\"c\"><skin source=\"#g\"><source id=\"j\"><" +
            array + " id=\"ja\" count=\"2\">" + joints + "</" + array +
            "><technique_common><accessor source=\"#ja\" "
            "count=\"2\"/></technique_common></source>" +
            float_source("w", "1 0.5 2", 3, "W") +
            "<joints><input semantic=\"JOINT\" source=\"#j\"/></joints><vertex_weights count=\"3\">"
            "<input semantic=\"JOINT\" source=\"#j\" offset=\"0\"/><input semantic=\"WEIGHT\" "
            "source=\"#w\" offset=\"1\"/>" +
            weights + "</vertex_weights></skin></controller></library_controllers>",
        nodes + "<node id=\"body\"><instance_controller url=\"#c\">" + skeleton +
            "</instance_controller></node>");
}

const std::string kWeights = "<vcount>1 1 1</vcount><v>0 0 1 0 0 0</v>";

TEST(Skin, JointsFallBackToIdNameAndTheWholeScene) {
    struct {
        std::string joints, array, nodes, skeleton, finding;
    } cases[] = {
        {"a b", "Name_array", "<node sid=\"a\" id=\"x\"><node sid=\"b\" id=\"y\"/></node>",
         "<skeleton>#x</skeleton>", ""},
        {"x y", "Name_array", "<node id=\"x\"><node id=\"y\"/></node>", "<skeleton>#x</skeleton>",
         "SKIN_JOINT_FALLBACK"},
        {"a b", "Name_array", "<node name=\"a\" id=\"x\"><node name=\"b\" id=\"y\"/></node>",
         "<skeleton>#x</skeleton>", "SKIN_JOINT_FALLBACK"},
        {"x y", "IDREF_array", "<node id=\"x\"><node id=\"y\"/></node>", "<skeleton>#x</skeleton>",
         ""},
        {"a b", "Name_array", "<node sid=\"a\" id=\"x\"/><node sid=\"b\" id=\"y\"/>",
         "<skeleton>#x</skeleton>", "SKIN_OUTSIDE_SKELETON"},
        {"a b", "Name_array", "<node sid=\"a\" id=\"x\"/><node sid=\"b\" id=\"y\"/>", "",
         "SKIN_NO_SKELETON"},
        {"a b", "Name_array", "<node sid=\"a\" id=\"x\"/><node sid=\"b\" id=\"y\"/>",
         "<skeleton>#x</skeleton><skeleton>#y</skeleton>", ""},
    };
    for (const auto& c : cases) {
        Reading r;
        read_text(r, skin_document(c.joints, c.array, kWeights, c.nodes, c.skeleton));
        ASSERT_TRUE(r.scene) << r.all();
        const MeshInstance& mesh = r.node("body").meshes.at(0);
        ASSERT_EQ(mesh.joint_nodes.size(), 2u);
        EXPECT_EQ(r.scene->nodes.at(mesh.joint_nodes[0]).id, "x");
        EXPECT_EQ(r.scene->nodes.at(mesh.joint_nodes[1]).id, "y");
        if (c.finding.empty()) {
            EXPECT_EQ(r.count("SKIN_JOINT_FALLBACK") + r.count("SKIN_OUTSIDE_SKELETON"), 0u)
                << r.all();
        } else {
            EXPECT_EQ(r.count(c.finding), 1u) << r.all();
        }
    }
}

TEST(Skin, BadInfluencesAreLeftOut) {
    Reading r;
    read_text(r, skin_document("a b", "Name_array", "<vcount>2 1 0</vcount><v>7 0 0 0 0 9</v>",
                               "<node sid=\"a\" id=\"x\"/>", ""));
    ASSERT_TRUE(r.scene && r.scene->skins.size() == 1) << r.all();
    const Skin& skin = r.scene->skins[0];
    EXPECT_EQ(skin.offsets, (std::vector<uint32_t>{0, 1, 1, 1}));
    EXPECT_EQ(r.count("SKIN_INDEX"), 1u);
    EXPECT_EQ(r.count("SKIN_ZERO_INFLUENCE"), 1u);
    EXPECT_EQ(r.count("SKIN_IBM_COUNT"), 1u);
    EXPECT_EQ(r.count("SKIN_JOINT_UNRESOLVED"), 1u);
    EXPECT_EQ(r.node("body").meshes.at(0).joint_nodes.at(1), kNone);
}

TEST(Skin, WeightSumsAreReportedWithTheWorst) {
    Reading r;
    read_text(r, skin_document("a b", "Name_array", "<vcount>1 1 1</vcount><v>0 0 0 1 0 2</v>",
                               "<node sid=\"a\"/><node sid=\"b\"/>", ""));
    ASSERT_EQ(r.count("SKIN_WEIGHT_SUM"), 1u);
    for (const Finding& f : r.diag.findings())
        if (f.info->code == std::string_view("SKIN_WEIGHT_SUM")) {
            EXPECT_EQ(f.message, "the weights of 2 vertices do not sum to 1 (worst: 2)");
        }
}

TEST(Skin, ShortDataIsNoCrash) {
    for (const char* weights : {"", "<vcount>9 9 9</vcount><v>0 0</v>", "<vcount>1</vcount>",
                                "<vcount>-5 1 1 1 1</vcount><v>0</v>"}) {
        Reading r;
        read_text(r, skin_document("a b", "Name_array", weights, "<node sid=\"a\"/>", ""));
        ASSERT_TRUE(r.scene);
        EXPECT_EQ(r.node("body").meshes.size(), 1u);
    }
}

}  // namespace
}  // namespace kinora::collada
