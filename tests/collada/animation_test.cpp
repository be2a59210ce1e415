// tests/collada/animation_test.cpp: targets, samplers and clips.
#include <gtest/gtest.h>

#include "tests/collada/reading.h"

namespace kinora::collada {
namespace {

// One animation per target, each with `stride` values at times 0 and 1.
std::string channel_library(const std::vector<std::pair<std::string, int>>& targets) {
    std::string out = "<library_animations>";
    int n = 0;
    for (const auto& [target, stride] : targets) {
        std::string id = "s" + std::to_string(n++), values;
        for (int i = 0; i < 2 * stride; ++i) values += std::to_string(i) + " ";
        out += "<animation id=\"a" + id + "\">" + float_source(id + "i", "0 1", 2, "T") +
               float_source(id + "o", values, 2,
                            std::string("ABCDEFGHIJKLMNOP").substr(0, size_t(stride))) +
               "<sampler id=\"" + id + "\"><input semantic=\"INPUT\" source=\"#" + id +
               "i\"/><input semantic=\"OUTPUT\" source=\"#" + id +
               "o\"/></sampler>\n<channel source=\"#" + id + "\" target=\"" + target +
               "\"/></animation>";
    }
    return out + "</library_animations>";
}

const char* const kNodes =
    "<node id=\"n\"><translate sid=\"t\">1 2 3</translate><rotate sid=\"r\">0 0 1 30</rotate>"
    "<matrix sid=\"m\">1 2 3 4 5 6 7 8 9 10 11 12 0 0 0 1</matrix>"
    "<skew sid=\"k\">20 1 0 0 0 1 0</skew><scale sid=\"a.b\">1 1 1</scale>"
    "<node id=\"child\"><translate sid=\"deep\">0 0 0</translate></node>"
    "<instance_light url=\"#l\"/><instance_camera url=\"#c\"/></node>";
const char* const kLibraries =
    "<library_lights><light id=\"l\"><technique_common><point><color sid=\"col\">1 1 1</color>"
    "<constant_attenuation>1</constant_attenuation></point></technique_common></light>"
    "<light id=\"unused\"><technique_common><point><color sid=\"col\">1 1 1</color></point>"
    "</technique_common></light></library_lights>"
    "<library_cameras><camera id=\"c\"><optics><technique_common><perspective>"
    "<yfov sid=\"fov\">40</yfov></perspective></technique_common></optics></camera>"
    "</library_cameras>";

// A morph of id "x" with two weights in the source "w", and a node that shows it.
std::string morph_library() {
    std::string out;
    for (const char* id : {"g0", "g1", "g2"}) {
        std::string p = std::string(id) + "-p", v = std::string(id) + "-v";
        out += std::string("<geometry id=\"") + id + "\"><mesh>" +
               float_source(p, "0 0 0 1 0 0 0 1 0", 3, "XYZ") + "<vertices id=\"" + v +
               "\"><input semantic=\"POSITION\" source=\"#" + p +
               "\"/></vertices><triangles count=\"1\"><input semantic=\"VERTEX\" source=\"#" + v +
               "\" offset=\"0\"/><p>0 1 2</p></triangles></mesh></geometry>";
    }
    return "<library_geometries>" + out +
           "</library_geometries><library_controllers><controller id=\"x\"><morph source=\"#g0\">"
           "<source id=\"names\"><IDREF_array id=\"names-a\" count=\"2\">g1 g2</IDREF_array>"
           "<technique_common><accessor source=\"#names-a\" count=\"2\"><param name=\"T\" "
           "type=\"IDREF\"/></accessor></technique_common></source>" +
           float_source("w", "0 0", 2, "W") +
           "<targets><input semantic=\"MORPH_TARGET\" source=\"#names\"/><input "
           "semantic=\"MORPH_WEIGHT\" source=\"#w\"/></targets></morph></controller>"
           "</library_controllers>";
}
const char* const kMorphNode = "<node id=\"y\"><instance_controller url=\"#x\"/></node>";

TEST(Targets, NamePartsOfValues) {
    struct {
        std::string target;
        int stride;
        Owner kind;
        uint32_t slot, first, count;
        bool whole;
    } cases[] = {
        {"n/t", 3, Owner::Transform, 0, 0, 3, false},
        {"n/t.Y", 1, Owner::Transform, 0, 1, 1, false},
        {"n/t(2)", 1, Owner::Transform, 0, 2, 1, false},
        {"n/r.ANGLE", 1, Owner::Transform, 1, 3, 1, false},
        {"n/r", 4, Owner::Transform, 1, 0, 4, false},
        {"n/r", 1, Owner::Transform, 1, 3, 1, false},  // exporters forget .ANGLE
        {"n/r(3)", 1, Owner::Transform, 1, 3, 1, false},
        {"n/m", 16, Owner::Transform, 2, 0, 16, true},
        {"n/m(3)(0)", 1, Owner::Transform, 2, 12, 1, false},  // column 3, row 0: moves x
        {"n/m(3)", 1, Owner::Transform, 2, 12, 1, false},     // the file's fourth number
        {"n/k.ANGLE", 1, Owner::Transform, 3, 0, 1, false},
        {"n/a.b", 3, Owner::Transform, 4, 0, 3, false},
        {"n/a.b.Z", 1, Owner::Transform, 4, 2, 1, false},
        {"n/deep.X", 1, Owner::Transform, 0, 0, 1, false},
        {"child/deep", 3, Owner::Transform, 0, 0, 3, false},
        {"l/col", 3, Owner::Light, 0, 0, 3, false},
        {"l/col", 4, Owner::Light, 0, 0, 3, false},
        {"l/col.G", 1, Owner::Light, 0, 1, 1, false},
        {"l/constant_attenuation", 1, Owner::Light, 1, 0, 1, false},
        {"c/fov", 1, Owner::Camera, 1, 0, 1, false},
        {"c/yfov", 1, Owner::Camera, 1, 0, 1, false},
        {"c/optics/technique_common/perspective/fov", 1, Owner::Camera, 1, 0, 1, false},
        {"l/technique_common/point/col.G", 1, Owner::Light, 0, 1, 1, false},
        {"x/w(1)", 1, Owner::MorphWeight, 0, 1, 1, false},
        {"x/morph/w(1)", 1, Owner::MorphWeight, 0, 1, 1, false},
        {"w(1)", 1, Owner::MorphWeight, 0, 1, 1, false},
    };
    for (const auto& c : cases) {
        Reading r;
        read_text(r,
                  with_scene(kLibraries + morph_library() + channel_library({{c.target, c.stride}}),
                             std::string(kNodes) + kMorphNode));
        ASSERT_TRUE(r.scene && r.scene->channels.size() == 1) << c.target << r.all();
        const Channel& channel = r.scene->channels[0];
        EXPECT_EQ(channel.ref.kind, c.kind) << c.target;
        EXPECT_EQ(channel.ref.slot, c.slot) << c.target;
        EXPECT_EQ(channel.ref.first, c.first) << c.target;
        EXPECT_EQ(channel.ref.count, c.count) << c.target;
        EXPECT_EQ(channel.ref.whole_matrix, c.whole) << c.target;
        EXPECT_EQ(r.scene->samplers[channel.sampler].stride, c.count) << c.target;
    }
}

TEST(Targets, ThatNameNothingAreReportedAtTheTarget) {
    struct {
        std::string target, code;
        int stride;
    } cases[] = {{"n/zzz", "ANIM_TARGET_UNRESOLVED", 1}, {"zzz/t", "ANIM_TARGET_UNRESOLVED", 1},
                 {"n/t.Q", "ANIM_TARGET_MEMBER", 1},     {"n/t.W", "ANIM_TARGET_MEMBER", 1},
                 {"n/t(3)", "ANIM_TARGET_MEMBER", 1},    {"n/m(4)(0)", "ANIM_TARGET_MEMBER", 1},
                 {"n/m(x)", "ANIM_TARGET_MEMBER", 1},    {"n/t", "ANIM_STRIDE", 2},
                 {"", "ANIM_TARGET_UNRESOLVED", 1},      {"n", "ANIM_TARGET_UNSUPPORTED", 1}};
    for (const auto& c : cases) {
        Reading r;
        read_text(r, with_scene(kLibraries + channel_library({{c.target, c.stride}}), kNodes));
        ASSERT_TRUE(r.scene);
        EXPECT_TRUE(r.scene->channels.empty()) << c.target;
        EXPECT_EQ(r.count(c.code), 1u) << c.target << r.all();
        EXPECT_EQ(r.pointed(c.code), c.target);
    }
    Reading quiet;  // what the scene does not reach is left out without a word
    read_text(quiet, with_scene(kLibraries + channel_library({{"unused/col", 3}}), kNodes));
    EXPECT_TRUE(quiet.scene->channels.empty());
    EXPECT_EQ(quiet.all().find("[ANIM_"), std::string::npos) << quiet.all();
}

TEST(Sampler, WholeMatricesAreTurnedToColumns) {
    Reading r;
    read_text(r, with_scene(kLibraries + channel_library({{"n/m", 16}}), kNodes));
    const Sampler& s = r.scene->samplers.at(0);
    EXPECT_EQ(s.values[1], 4);   // row 1, column 0
    EXPECT_EQ(s.values[12], 3);  // row 0, column 3
    EXPECT_EQ(s.values[16 + 12], 19);
    EXPECT_EQ(r.node("n").transforms[2].slot.values[12], 4);
}

TEST(Sampler, KeysAreSortedAndBadOnesDropped) {
    Reading r;
    read_file(r, test_file("skinned.dae"));
    ASSERT_TRUE(r.scene);
    ASSERT_EQ(r.scene->channels.size(), 3u) << r.all();
    const Sampler& s = r.scene->samplers.at(r.scene->channels[0].sampler);
    EXPECT_EQ(s.times, (std::vector<double>{0, 1, 2}));
    EXPECT_EQ(s.values, (std::vector<double>{0, 10, 20}));
    // The BEZIER key has no tangents.
    EXPECT_EQ(s.interpolation,
              (std::vector<Interpolation>{Interpolation::Linear, Interpolation::Linear,
                                          Interpolation::Step}));
    EXPECT_EQ(r.count("ANIM_TIME_ORDER"), 1u);
    EXPECT_EQ(r.count("ANIM_TANGENT_MISSING"), 1u);
    EXPECT_EQ(r.scene->channels[1].ref.kind, Owner::MorphWeight);
    EXPECT_EQ(r.scene->channels[1].ref.first, 0u);  // weight 1 became 0: target 0 was left out
    EXPECT_EQ(r.scene->channels[2].ref.first, 13u);
    EXPECT_EQ(r.scene->channels[0].sampler, r.scene->channels[2].sampler);
}

std::string sampler_document(const std::string& times, int keys, const std::string& values,
                             const std::string& names, const std::string& tangents,
                             const std::string& params) {
    int count = keys;
    std::string t = params.empty() ? ""
                                   : float_source("in", tangents, count, params) +
                                         float_source("out", tangents, count, params);
    return with_scene("<library_animations><animation>" + float_source("i", times, count, "T") +
                          float_source("o", values, count, "X") +
                          "<source id=\"n\"><Name_array id=\"na\" count=\"2\">" + names +
                          "</Name_array></source>" + t +
                          "<sampler id=\"s\" pre_behavior=\"CYCLE\" post_behavior=\"OSCILLATE\">"
                          "<input semantic=\"INPUT\" source=\"#i\"/><input semantic=\"OUTPUT\" "
                          "source=\"#o\"/><input semantic=\"INTERPOLATION\" source=\"#n\"/>" +
                          (params.empty() ? ""
                                          : "<input semantic=\"IN_TANGENT\" source=\"#in\"/><input "
                                            "semantic=\"OUT_TANGENT\" source=\"#out\"/>") +
                          "</sampler><channel source=\"#s\" target=\"n/t.X\"/></animation>"
                          "</library_animations>",
                      "<node id=\"n\"><translate sid=\"t\">0 0 0</translate></node>");
}

TEST(Sampler, TangentsHaveOneOrTwoDimensions) {
    Reading one;
    read_text(one, sampler_document("0 1", 2, "5 6", "BEZIER BEZIER", "1 2", "X"));
    ASSERT_EQ(one.scene->samplers.size(), 1u) << one.all();
    EXPECT_EQ(one.scene->samplers[0].tangent_dims, 1);
    EXPECT_EQ(one.scene->samplers[0].pre, Behavior::Cycle);
    EXPECT_EQ(one.scene->samplers[0].post, Behavior::Oscillate);
    Reading two;
    read_text(two, sampler_document("0 1", 2, "5 6", "HERMITE BEZIER", "1 2 3 4", "XY"));
    EXPECT_EQ(two.scene->samplers.at(0).tangent_dims, 2);
    EXPECT_EQ(two.scene->samplers[0].out_tangents, (std::vector<double>{1, 2, 3, 4}));
    EXPECT_EQ(two.scene->samplers[0].interpolation[0], Interpolation::Hermite);
    Reading three;
    read_text(three, sampler_document("0 1", 2, "5 6", "BEZIER LINEAR", "1 2 3 4 5 6", "XYZ"));
    EXPECT_EQ(three.count("ANIM_TANGENT_DIM"), 2u);
    EXPECT_EQ(three.scene->samplers.at(0).interpolation[0], Interpolation::Linear);
}

TEST(Sampler, OddInputIsRepairedOrLeftOut) {
    Reading nan;
    read_text(nan, sampler_document("0 1", 2, "5 NaN", "LINEAR STEP", "", ""));
    EXPECT_EQ(nan.scene->samplers.at(0).times.size(), 1u);
    EXPECT_EQ(nan.count("ANIM_KEY_NAN"), 1u);
    Reading none;
    read_text(none, sampler_document("NaN INF", 2, "5 6", "LINEAR STEP", "", ""));
    EXPECT_TRUE(none.scene->channels.empty());
    EXPECT_EQ(none.count("ANIM_EMPTY"), 1u);
    Reading word;
    read_text(word, sampler_document("0 1", 2, "5 6", "SMOOTH", "", ""));
    EXPECT_EQ(word.count("ANIM_INTERP_UNKNOWN"), 1u);
    EXPECT_EQ(word.count("ANIM_COUNT"), 1u);
}

TEST(Clips, NameRangesAndTheirChannels) {
    std::string library = channel_library({{"n/t.X", 1}, {"n/t.X", 1}, {"n/t.Y", 1}});
    library +=
        "<library_animation_clips><animation_clip id=\"walk\" start=\"2\" end=\"1\">"
        "<instance_animation url=\"#as0\"/></animation_clip><animation_clip id=\"run\">"
        "<instance_animation url=\"#as1\"/></animation_clip></library_animation_clips>";
    Reading r;
    read_text(r, with_scene(kLibraries + library, kNodes));
    ASSERT_EQ(r.scene->clips.size(), 2u) << r.all();
    EXPECT_EQ(r.scene->clips[0].start, 1);
    EXPECT_EQ(r.scene->clips[0].end, 2);
    EXPECT_EQ(r.count("ANIM_CLIP_RANGE"), 1u);
    EXPECT_EQ(r.scene->clips[0].channels, (std::vector<uint32_t>{0}));
    EXPECT_EQ(r.scene->clips[1].end, 1);  // its last key
    EXPECT_TRUE(r.scene->channels[0].in_clip && r.scene->channels[1].in_clip);
    EXPECT_FALSE(r.scene->channels[2].in_clip);
    EXPECT_EQ(r.count("ANIM_DUPLICATE_TARGET"), 0u);
    Reading twice;
    read_text(twice, with_scene(kLibraries + channel_library({{"n/t.X", 1}, {"n/t", 3}}), kNodes));
    EXPECT_EQ(twice.count("ANIM_DUPLICATE_TARGET"), 1u);
}

}  // namespace
}  // namespace kinora::collada
