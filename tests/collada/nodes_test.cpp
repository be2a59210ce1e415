// tests/collada/nodes_test.cpp: the node tree, instances, cycles, limits and other documents.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/collada/reading.h"
#include "tests/folders.h"

namespace kinora::collada {
namespace {

TEST(Nodes, KeepTransformsInOrderAsTheyAreWritten) {
    Reading r;
    read_text(r, with_scene("",
                            "<node id=\"n\" sid=\"s\" name=\"N\" type=\"JOINT\"><lookat>1 2 3 4 5 "
                            "6 0 1 0</lookat><rotate sid=\"r\">0 1 0 720</rotate><skew>1 1 0 0 0 1 "
                            "0</skew><scale>1 2 3</scale></node>"));
    const Node& n = r.node("n");
    ASSERT_EQ(n.transforms.size(), 4u) << r.all();
    EXPECT_TRUE(n.joint);
    EXPECT_EQ(n.transforms[0].kind, TransformKind::Lookat);
    EXPECT_EQ(n.transforms[0].slot.values[5], 6);
    EXPECT_EQ(n.transforms[1].slot.values[3], 720);
    EXPECT_EQ(n.transforms[1].slot.sid, "r");
    EXPECT_EQ(n.transforms[2].slot.count, 7);
    EXPECT_EQ(n.transforms[3].kind, TransformKind::Scale);
}

TEST(Nodes, BadTransformsAreTheIdentity) {
    Reading r;
    read_text(r, with_scene("",
                            "<node id=\"n\"><rotate>0 0 0 90</rotate><matrix>1 2 3</matrix>"
                            "<lookat>0 0 0 0 0 0 0 1 0</lookat><translate>NaN 0 0</translate>"
                            "<matrix>1 0 0 4 0 1 0 5 0 0 1 6 1 1 1 2</matrix></node>"));
    const Node& n = r.node("n");
    ASSERT_EQ(n.transforms.size(), 5u);
    EXPECT_EQ(n.transforms[0].slot.values[2], 1);
    EXPECT_EQ(n.transforms[0].slot.values[3], 0);
    EXPECT_EQ(n.transforms[1].slot.values[0], 1);
    EXPECT_EQ(n.transforms[3].slot.values[0], 0);
    EXPECT_EQ(n.transforms[4].slot.values[12], 4);
    EXPECT_EQ(n.transforms[4].slot.values[15], 1);
    EXPECT_EQ(r.count("NODE_VALUE"), 3u);
    EXPECT_EQ(r.count("NODE_MATRIX_ROW"), 1u);
}

// Its place and view are known; runtime/base picks the axis that is not (transforms_test.cpp).
TEST(Nodes, ALookatWithUpAlongItsViewKeepsItsPlaceAndView) {
    Reading r;
    read_text(r, with_scene("",
                            "<node id=\"n\"><lookat>1 2 7 1 2 3 0 0 1</lookat>"
                            "<lookat>4 5 6 4 5 6 0 1 0</lookat></node>"));
    const Node& n = r.node("n");
    ASSERT_EQ(n.transforms.size(), 2u);
    const double view[] = {1, 2, 7, 1, 2, 3, 0, 0, 1}, place[] = {4, 5, 6, 4, 5, 6, 0, 1, 0};
    for (int i = 0; i < 9; ++i) {
        EXPECT_EQ(n.transforms[0].slot.values[i], view[i]) << i;
        EXPECT_EQ(n.transforms[1].slot.values[i], place[i]) << i;
    }
    EXPECT_EQ(r.count("NODE_VALUE"), 2u);
}

TEST(Nodes, CyclesAreRefusedByName) {
    Reading r;
    read_file(r, test_file("common.dae"));
    ASSERT_TRUE(r.scene);
    ASSERT_EQ(r.count("LINK_CYCLE"), 1u) << r.all();
    for (const Finding& f : r.diag.findings())
        if (f.info->code == std::string_view("LINK_CYCLE")) {
            EXPECT_EQ(f.message, "a cycle: 'loop' -> 'loop2' -> 'loop'");
        }
    EXPECT_EQ(r.node("n1").instances.size(), 1u);
    EXPECT_EQ(r.node("loop").instances.size() + r.node("loop2").instances.size(), 1u);
    Reading self;
    read_text(self,
              with_scene("", "<node id=\"n\"><node><instance_node url=\"#n\"/></node></node>"));
    EXPECT_EQ(self.count("LINK_CYCLE"), 1u);
}

TEST(Nodes, UnrollingIsBounded) {
    std::string library = "<library_nodes><node id=\"n0\"/>";
    for (int i = 1; i <= 40; ++i) {  // 2^40 nodes if unrolled
        std::string below = "<instance_node url=\"#n" + std::to_string(i - 1) + "\"/>";
        library += "<node id=\"n" + std::to_string(i) + "\">" + below + below + "</node>";
    }
    Reading r;
    read_text(r, with_scene(library + "</library_nodes>",
                            "<node id=\"top\"><instance_node url=\"#n40\"/></node>"));
    ASSERT_TRUE(r.scene);
    EXPECT_EQ(r.count("LINK_TOO_MANY"), 1u);
    std::string chain = "<library_nodes>";
    for (int i = 0; i < 50000; ++i)
        chain += "<node id=\"c" + std::to_string(i) + "\"><instance_node url=\"#c" +
                 std::to_string(i + 1) + "\"/></node>";
    Reading deep;  // no recursion over instances
    read_text(deep, with_scene(chain + "<node id=\"c50000\"/></library_nodes>",
                               "<node><instance_node url=\"#c0\"/></node>"));
    EXPECT_EQ(deep.scene->nodes.size(), 50002u);
}

TEST(Links, AreReportedAtTheirPlace) {
    Reading r;
    read_text(r,
              with_scene("<library_lights><light id=\"l\"><technique_common><point/>"
                         "</technique_common></light></library_lights>",
                         "\n<node><instance_light url=\"#zzz\"/>\n<instance_camera url=\"#l\"/>\n"
                         "<instance_light url=\"l\"/>\n<instance_light/></node>"));
    ASSERT_TRUE(r.scene);
    EXPECT_EQ(r.pointed("LINK_UNRESOLVED"), "#zzz");
    EXPECT_EQ(r.pointed("LINK_WRONG_TYPE"), "#l");
    EXPECT_EQ(r.pointed("LINK_NO_HASH"), "l");
    EXPECT_GE(r.count("SCHEMA_MISSING_ATTRIBUTE"), 1u);
    EXPECT_EQ(r.scene->nodes.at(0).lights.size(), 1u);
}

TEST(Links, LeadToOtherDocumentsInsideTheFolder) {
    std::string folder = testing::TempDir() + "kinora_collada_links/";
    std::filesystem::create_directories(folder + "in");
    std::ofstream(folder + "in/part two.dae")
        << "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">"
           "<asset><unit meter=\"0.01\"/><up_axis>Z_UP</up_axis></asset><library_nodes><node "
           "id=\"a\"><instance_node url=\"../main.dae#back\"/><instance_light url=\"#l\"/></node>"
           "</library_nodes><library_lights><light id=\"l\"><technique_common><point/>"
           "</technique_common></light></library_lights></COLLADA>";
    std::string main =
        with_scene("<library_nodes><node id=\"back\"/></library_nodes>",
                   "<node id=\"n\"><instance_node url=\"in/part%20two.dae#a\"/><instance_node "
                   "url=\"in/part%20two.dae#a\"/><instance_node url=\"gone.dae#a\"/><instance_node "
                   "url=\"/etc/hostname#a\"/></node>");
    std::ofstream(folder + "main.dae") << main;
    Reading r;
    read_file(r, folder + "main.dae");
    ASSERT_TRUE(r.scene) << r.all();
    EXPECT_EQ(r.scene->documents.size(), 2u);
    ASSERT_EQ(r.node("n").instances.size(), 2u);
    const NodeInstance& instance = r.node("n").instances[0];
    EXPECT_EQ(r.scene->nodes[instance.node].document, 1u);
    ASSERT_NE(instance.conversion, kNone);
    // Z up to Y up, centimetres to metres: their (0, 0, 100) is our (0, 1, 0).
    dvec4 p = r.scene->conversions[instance.conversion] * dvec4(0, 0, 100, 1);
    EXPECT_NEAR(p.y, 1, 1e-12);
    EXPECT_NEAR(p.x * p.x + p.z * p.z, 0, 1e-12);
    EXPECT_EQ(r.scene->nodes[r.node("a").instances[0].node].id, "back");
    EXPECT_EQ(r.pointed("LINK_EXTERNAL_MISSING"), "gone.dae#a");
    EXPECT_EQ(r.pointed("LINK_OUTSIDE"), "/etc/hostname#a");
}

TEST(Scene, FallsBackToTheFirstVisualScene) {
    Reading r;
    read_text(r,
              "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
              "version=\"1.4.1\"><library_visual_scenes><visual_scene id=\"first\"><node/>"
              "</visual_scene></library_visual_scenes></COLLADA>");
    ASSERT_TRUE(r.scene);
    EXPECT_EQ(r.scene->scene_id, "first");
    EXPECT_EQ(r.count("SCENE_MISSING"), 1u);
    Reading elsewhere;
    read_text(elsewhere,
              "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
              "version=\"1.4.1\"><library_visual_scenes><visual_scene id=\"first\"><node/>"
              "</visual_scene></library_visual_scenes><scene><instance_visual_scene "
              "url=\"#other\"/></scene></COLLADA>");
    ASSERT_TRUE(elsewhere.scene);
    EXPECT_EQ(elsewhere.scene->scene_id, "first");
    EXPECT_EQ(elsewhere.count("SCENE_MISSING"), 0u);
    EXPECT_EQ(elsewhere.count("LINK_UNRESOLVED"), 1u) << elsewhere.all();
    Reading none;
    read_text(none, "<COLLADA version=\"1.4.1\"/>");
    EXPECT_FALSE(none.scene);
    EXPECT_EQ(none.count("SCENE_NONE"), 1u);
}

TEST(Asset, ReadsUnitsAxesAndRanges) {
    Reading r;
    read_file(r, test_file("skinned.dae"));
    EXPECT_EQ(r.scene->asset.meter, 0.01);
    EXPECT_EQ(r.scene->asset.up_axis, UpAxis::Z);
    Reading odd;
    read_text(odd, with_scene("<asset><unit meter=\"1\" name=\"centimeter\"/><up_axis>W</up_axis>"
                              "</asset>",
                              "<extra><technique profile=\"MAYA\"><start_time>0.5</start_time>"
                              "<end_time>2</end_time></technique></extra><extra><technique "
                              "profile=\"MAX3D\"><frame_rate>30</frame_rate></technique></extra>"));
    EXPECT_EQ(odd.count("UNIT_CONFLICT"), 1u);
    EXPECT_EQ(odd.pointed("UPAXIS_VALUE"), "W");
    EXPECT_EQ(odd.scene->start_time, 0.5);
    EXPECT_EQ(odd.scene->end_time, 2.0);
    EXPECT_EQ(odd.scene->frame_rate, 30.0);
}

TEST(Asset, AnAxisInOtherLettersIsUnderstood) {
    struct Row {
        const char* written;
        UpAxis axis;
    };
    const Row rows[] = {{"z_up", UpAxis::Z}, {"Z_Up", UpAxis::Z}, {"Z-UP", UpAxis::Z},
                        {"zUp", UpAxis::Z},  {"Z", UpAxis::Z},    {" x_up ", UpAxis::X},
                        {"y", UpAxis::Y},    {"Y_up", UpAxis::Y}};
    for (const Row& row : rows) {
        Reading r;
        read_text(r,
                  with_scene(std::string("<asset><up_axis>") + row.written + "</up_axis></asset>",
                             "<node id=\"n\"/>"));
        EXPECT_EQ(r.scene->asset.up_axis, row.axis) << row.written;
        EXPECT_EQ(r.count("UPAXIS_SPELLING"), 1u) << row.written;
        EXPECT_EQ(r.count("UPAXIS_VALUE"), 0u) << row.written;
    }
    for (const char* unknown : {"UP_Y", "W", "", "ZZ_UP", "Z_UPS", "-Z2"}) {
        Reading r;
        read_text(r, with_scene(std::string("<asset><up_axis>") + unknown + "</up_axis></asset>",
                                "<node id=\"n\"/>"));
        EXPECT_EQ(r.scene->asset.up_axis, UpAxis::Y) << unknown;
        EXPECT_EQ(r.count("UPAXIS_VALUE"), 1u) << unknown;
        EXPECT_EQ(r.count("UPAXIS_SPELLING"), 0u) << unknown;
    }
}

TEST(Asset, AUnitWithADecimalCommaIsUnderstood) {
    Reading r;
    read_text(r, with_scene("<asset><unit meter=\"0,010000\" name=\"centimeter\"/></asset>",
                            "<node id=\"n\"/>"));
    EXPECT_EQ(r.scene->asset.meter, 0.01);
    EXPECT_EQ(r.pointed("SRC_COMMA_DECIMAL"), "0,010000");
    EXPECT_EQ(r.count("UNIT_RANGE") + r.count("UNIT_CONFLICT"), 0u);
}

std::string hidden_by(const std::string& flag) {
    return "<extra><technique profile=\"FCOLLADA\">" + flag + "</technique></extra>";
}

TEST(Nodes, AnExtraHidesThemUnlessAChannelNamesItOrNothingWouldBeLeft) {
    const std::string kShape = "<instance_geometry url=\"#g\"/>";
    auto document = [&](const std::string& nodes) {
        return with_scene("<library_animations><animation>" + float_source("t", "0 1", 2, "T") +
                              float_source("v", "0 1", 2, "V") +
                              "<sampler id=\"s\"><input semantic=\"INPUT\" source=\"#t\"/><input "
                              "semantic=\"OUTPUT\" source=\"#v\"/></sampler><channel source=\"#s\" "
                              "target=\"blinks/visibility\"/></animation></library_animations>"
                              "<library_geometries>" +
                              triangle_geometry("g", {"m"}) + "</library_geometries>",
                          nodes);
    };
    Reading r;
    read_text(
        r,
        document("<node id=\"box\">" + kShape + hidden_by("<visibility>0</visibility>") +
                 "</node><node id=\"zero\">" + kShape +
                 hidden_by("<visibility>\n0.000</visibility>") + "</node><node id=\"seen\">" +
                 kShape + hidden_by("<visibility>1</visibility>") + "</node><node id=\"blinks\">" +
                 kShape + hidden_by("<visibility sid=\"visibility\">0</visibility>") + "</node>"));
    ASSERT_TRUE(r.scene) << r.all();
    EXPECT_TRUE(r.node("box").hidden);
    EXPECT_TRUE(r.node("zero").hidden);
    EXPECT_FALSE(r.node("seen").hidden);
    EXPECT_FALSE(r.node("blinks").hidden);
    EXPECT_EQ(r.count("NODE_HIDDEN"), 2u) << r.all();
    Reading all;
    read_text(all, document("<node id=\"box\">" + hidden_by("<visibility>0</visibility>") +
                            "<node id=\"inner\">" + kShape + "</node></node><node id=\"empty\"/>"));
    EXPECT_FALSE(all.node("box").hidden);
    EXPECT_EQ(all.count("NODE_HIDDEN"), 0u);
}

// Blender's decomposed transforms: what the picture needs is location * rotation * scale, and what
// channels name moves along.
TEST(Nodes, BlendersOrderOfTransformsIsMended) {
    const std::string rules = test_data_folder() + "/rules/";
    Reading r;
    read_file(r, rules + "NODE_ORDER.dae");
    ASSERT_TRUE(r.scene);
    const Node& node = r.node("ball");
    ASSERT_EQ(node.transforms.size(), 5u);
    const char* const order[] = {"location", "rotationZ", "rotationY", "rotationX", "scale"};
    for (size_t i = 0; i < 5; ++i) EXPECT_EQ(node.transforms[i].slot.sid, order[i]);
    EXPECT_EQ(node.transforms[0].kind, TransformKind::Translate);
    EXPECT_EQ(node.transforms[0].slot.values[2], 3);
    ASSERT_EQ(r.scene->channels.size(), 1u);
    EXPECT_EQ(r.scene->channels[0].ref.slot, 0u);
    EXPECT_EQ(r.scene->channels[0].ref.first, 2u);
    EXPECT_EQ(r.count("NODE_ORDER"), 1u);
    Reading other;
    read_file(other, rules + "NODE_ORDER.ok.maker.dae");
    EXPECT_EQ(other.node("ball").transforms[0].kind, TransformKind::Scale);
}

// xs:boolean has two words for each.
TEST(Nodes, AnEvaluateSceneThatIsSwitchedOffSetsNoCamera) {
    for (std::string enable : {"0", "false", " 0 ", "1", "true"}) {
        bool on = enable == "1" || enable == "true";
        Reading r;
        read_text(r, with_scene("<library_cameras><camera id=\"c\"><optics><technique_common>"
                                "<perspective><yfov>30</yfov><znear>1</znear><zfar>9</zfar>"
                                "</perspective></technique_common></optics></camera>"
                                "</library_cameras>",
                                "<node id=\"a\"/><node id=\"b\"><instance_camera url=\"#c\"/>"
                                "</node><evaluate_scene enable=\"" +
                                    enable + "\"><render camera_node=\"#b\"/></evaluate_scene>"));
        ASSERT_TRUE(r.scene);
        EXPECT_EQ(r.scene->camera_node != kNone, on) << enable;
    }
}

}  // namespace
}  // namespace kinora::collada
