// tests/collada/limits_test.cpp: whatever a file asks for, reading it takes at most 20 times its
// bytes and 64 MB, and ends.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "collada/extract/extract.h"
#include "collada/validate/validate.h"
#include "tests/collada/reading.h"

namespace kinora::collada {
namespace {

std::string number(size_t i) {
    return std::to_string(i);
}

template <class Piece>
std::string repeat(size_t count, Piece piece) {
    std::string text;
    for (size_t i = 0; i < count; ++i) text += piece(i);
    return text;
}

std::string words(size_t count, const char* word) {
    return repeat(count, [&](size_t) { return word; });
}

std::string library(const std::string& name, const std::string& items) {
    return "<library_" + name + ">" + items + "</library_" + name + ">";
}

std::string list_source(const std::string& id, const std::string& kind, size_t count,
                        const char* word) {
    return "<source id=\"" + id + "\"><" + kind + " id=\"" + id + "-a\" count=\"" + number(count) +
           "\">" + words(count, word) + "</" + kind + "><technique_common><accessor source=\"#" +
           id + "-a\" count=\"" + number(count) +
           "\"><param name=\"N\" type=\"float\"/></accessor>"
           "</technique_common></source>";
}

std::string mesh_of(size_t i, const std::string& source, const std::string& primitives = {}) {
    return "<geometry id=\"g" + number(i) + "\"><mesh><vertices id=\"v" + number(i) +
           "\"><input semantic=\"POSITION\" source=\"#" + source + "\"/></vertices>" + primitives +
           "</mesh></geometry>";
}

std::string skin_of(size_t i, const std::string& geometry) {
    return "<controller id=\"c" + number(i) + "\"><skin source=\"#" + geometry +
           "\"><joints><input semantic=\"JOINT\" source=\"#names\"/><input "
           "semantic=\"INV_BIND_MATRIX\" source=\"#matrices\"/></joints><vertex_weights "
           "count=\"1\">"
           "<input semantic=\"JOINT\" source=\"#names\" offset=\"0\"/><input semantic=\"WEIGHT\" "
           "source=\"#weights\" offset=\"1\"/><vcount>1</vcount><v>0 0</v></vertex_weights></skin>"
           "</controller>";
}

std::string xyz_source(size_t positions) {
    return float_source("pos", words(positions, "0 0 0 "), int(positions), "XYZ");
}

struct Hostile {
    const char* name;
    std::string (*text)();
};

const Hostile kHostile[] = {
    {"EmptyElements", [] { return with_scene(words(1'000'000, "<a/>"), ""); }},
    {"EmptyNodes", [] { return with_scene("", words(500'000, "<node/>")); }},
    {"Ids",
     [] {
         return with_scene(
             repeat(300'000, [](size_t i) { return "<a id=\"" + number(i) + "\"/>"; }), "");
     }},
    {"OneIdOften", [] { return with_scene(words(300'000, "<a id=\"b\"/>"), ""); }},
    {"AttributesOfOneElement",
     [] {
         return with_scene(
             "<a " + repeat(400'000, [](size_t i) { return "b" + number(i) + "=\"\" "; }) + "/>",
             "");
     }},
    {"DistinctAttributes",
     [] {
         return with_scene(repeat(300'000, [](size_t i) { return "<a b" + number(i) + "=\"\"/>"; }),
                           "");
     }},
    {"Entities", [] { return with_scene("<extra>" + words(1'000'000, "&lt;") + "</extra>", ""); }},
    {"TrianglesAlone",
     [] {
         return with_mesh("0 0 0 1 0 0 0 1 0", 3,
                          "<polygons count=\"300000\"><input semantic=\"VERTEX\" source=\"#v\" "
                          "offset=\"0\"/>" +
                              words(300'000, "<p>0 1 2</p>") + "</polygons>");
     }},
    {"NumbersThatAreNone",
     [] {
         return with_mesh("0 0 0 1 0 0 0 1 0", 3,
                          "<polygons count=\"300000\"><input semantic=\"VERTEX\" source=\"#v\" "
                          "offset=\"0\"/>" +
                              words(300'000, "<p>x</p>") + "</polygons>");
     }},
    {"Zeros", [] { return with_mesh(words(1'000'000, "0 0 0 "), 1'000'000, ""); }},
    {"OneSourceForManyMeshes",
     [] {
         return with_scene(
             library("geometries", "<geometry id=\"first\"><mesh>" + xyz_source(100'000) +
                                       "</mesh></geometry>" +
                                       repeat(10'000, [](size_t i) { return mesh_of(i, "pos"); })),
             repeat(10'000, [](size_t i) {
                 return "<node><instance_geometry url=\"#g" + number(i) + "\"/></node>";
             }));
     }},
    {"OneMeshForManySkins",
     [] {
         return with_scene(
             library("geometries", "<geometry id=\"big\"><mesh>" + xyz_source(100'000) +
                                       "<vertices id=\"v\"><input semantic=\"POSITION\" "
                                       "source=\"#pos\"/></vertices></mesh></geometry>") +
                 library("controllers",
                         "<controller id=\"x\"><skin source=\"#big\">" +
                             list_source("names", "Name_array", 20'000, "a ") +
                             list_source("weights", "float_array", 20'000, "1 ") +
                             list_source("matrices", "float_array", 20'000, "1 ") +
                             "</skin></controller>" +
                             repeat(5'000, [](size_t i) { return skin_of(i, "big"); })),
             repeat(5'000, [](size_t i) {
                 return "<node><instance_controller url=\"#c" + number(i) + "\"/></node>";
             }));
     }},
    {"JointsOfManyInstances",
     [] {
         return with_scene(
             library("geometries", "<geometry id=\"big\"><mesh>" + xyz_source(3) +
                                       "<vertices id=\"v\"><input semantic=\"POSITION\" "
                                       "source=\"#pos\"/></vertices></mesh></geometry>") +
                 library("controllers", "<controller id=\"x\"><skin source=\"#big\">" +
                                            list_source("names", "Name_array", 100'000, "a ") +
                                            list_source("weights", "float_array", 1, "1 ") +
                                            list_source("matrices", "float_array", 16, "1 ") +
                                            "</skin></controller>" + skin_of(0, "big")),
             "<node sid=\"a\"/>" +
                 words(20'000, "<node><instance_controller url=\"#c0\"/></node>"));
     }},
    {"SkeletonsOfAChain",
     [] {
         return with_scene(
             library("nodes", repeat(20'000,
                                     [](size_t i) {
                                         return "<node id=\"n" + number(i) + "\" sid=\"s" +
                                                number(i) + "\"><instance_node url=\"#n" +
                                                number(i + 1) + "\"/></node>";
                                     })) +
                 library("geometries", "<geometry id=\"big\"><mesh>" + xyz_source(3) +
                                           "<vertices id=\"v\"><input semantic=\"POSITION\" "
                                           "source=\"#pos\"/></vertices></mesh></geometry>") +
                 library("controllers", "<controller id=\"x\"><skin source=\"#big\">" +
                                            list_source("names", "Name_array", 1, "a ") +
                                            list_source("weights", "float_array", 1, "1 ") +
                                            list_source("matrices", "float_array", 16, "1 ") +
                                            "</skin></controller>" + skin_of(0, "big")),
             repeat(20'000, [](size_t i) {
                 return "<node><instance_controller url=\"#c0\"><skeleton>#n" + number(i) +
                        "</skeleton></instance_controller></node>";
             }));
     }},
    {"BareCameras",
     [] {
         return with_scene(library("cameras", words(100'000, "<camera><optics/></camera>")), "");
     }},
    {"BareEffects", [] { return with_scene(library("effects", words(200'000, "<effect/>")), ""); }},
    {"BareMaterials",
     [] { return with_scene(library("materials", words(200'000, "<material/>")), ""); }},
    {"BareLights",
     [] {
         return with_scene(
             library("lights", words(60'000,
                                     "<light><technique_common><point/></technique_common>"
                                     "</light>")),
             "");
     }},
    {"ClipsOfManyChannels",
     [] {
         return with_scene(
             library("animations",
                     "<animation id=\"all\">" + float_source("in", "0 1", 2, "T") +
                         float_source("out", "0 1", 2, "X") +
                         "<sampler id=\"s\"><input semantic=\"INPUT\" source=\"#in\"/>"
                         "<input semantic=\"OUTPUT\" source=\"#out\"/></sampler>" +
                         words(40'000, "<channel source=\"#s\" target=\"n/t.X\"/>") +
                         "</animation>") +
                 library("animation_clips",
                         "<animation_clip>" + words(40'000, "<instance_animation url=\"#all\"/>") +
                             "</animation_clip>"),
             "<node id=\"n\"><translate sid=\"t\">0 0 0</translate></node>");
     }},
    {"LadderOfNodes",
     [] {
         return with_scene(library("nodes", repeat(5'000,
                                                   [](size_t i) {
                                                       std::string below =
                                                           "<instance_node url=\"#n" +
                                                           number(i + 1) + "\"/>";
                                                       return "<node id=\"n" + number(i) + "\">" +
                                                              words(10, below.c_str()) + "</node>";
                                                   })),
                           "<node><instance_node url=\"#n0\"/></node>");
     }},
    {"HugeCounts",
     [] {
         return with_mesh(
             "0 0 0 1 0 0 0 1 0", 3,
             "<triangles count=\"4000000000\"><input semantic=\"VERTEX\" source=\"#v\" "
             "offset=\"0\"/><p>0 1 2</p></triangles><polylist "
             "count=\"18446744073709551615\"><input "
             "semantic=\"VERTEX\" source=\"#v\" offset=\"65535\"/><vcount>2147483647</vcount><p>0 "
             "1 "
             "2</p></polylist><triangles count=\"1\"><input semantic=\"VERTEX\" source=\"#v\" "
             "offset=\"4294967295\"/><p>0 1 2</p></triangles>",
             "<source id=\"huge\"><float_array id=\"huge-a\" count=\"9999999999\">1 2 "
             "3</float_array><technique_common><accessor source=\"#huge-a\" "
             "count=\"9223372036854775807\" stride=\"4611686018427387904\"><param name=\"X\" "
             "type=\"float\"/></accessor></technique_common></source><source id=\"wide\">"
             "<float_array id=\"wide-a\" count=\"3\">1 2 "
             "3</float_array><technique_common><accessor "
             "source=\"#wide-a\" count=\"1000000\" stride=\"2000000000\"/></technique_common>"
             "</source>");
     }},
    {"DeepElements", [] { return with_scene(words(500'000, "<extra>"), ""); }},
};

// The most memory of a child process that does `work`, in bytes.
template <class Work>
uint64_t peak_of(Work work, bool& ended_well) {
    pid_t child = fork();
    if (child == 0) {
        work();
        _exit(0);
    }
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    ended_well = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    return uint64_t(usage.ru_maxrss) * 1024;
}

#if defined(KINORA_SANITIZED)
constexpr bool kMeasured = false;  // its shadow memory counts
#else
constexpr bool kMeasured = true;
#endif

class Limits : public testing::TestWithParam<Hostile> {};

TEST_P(Limits, MemoryIsBoundedByTheFile) {
    const std::string text = GetParam().text();
    bool ended_well = false;
    uint64_t idle = peak_of([] {}, ended_well);
    uint64_t peak = peak_of(
        [&] {
            Diagnostics diag;
            std::optional<Document> document = read_document_text("hostile.dae", text, diag);
            if (document) validate(*document, diag);
        },
        ended_well);
    EXPECT_TRUE(ended_well);
    uint64_t used = peak > idle ? peak - idle : 0;
    RecordProperty("times", std::to_string(double(used) / double(text.size())));
    if (kMeasured) {
        EXPECT_LE(used, 20 * text.size() + (64 << 20)) << "of " << text.size() << " bytes";
    }
}

INSTANTIATE_TEST_SUITE_P(Hostile, Limits, testing::ValuesIn(kHostile),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(LimitFindings, NameWhatWasTooMuch) {
    auto text_of = [](std::string_view name) {
        for (const Hostile& h : kHostile)
            if (name == h.name) return h.text();
        return std::string();
    };
    for (const char* name : {"OneSourceForManyMeshes", "OneMeshForManySkins", "SkeletonsOfAChain",
                             "ClipsOfManyChannels", "LadderOfNodes"}) {
        Reading r;
        read_text(r, text_of(name));
        EXPECT_EQ(r.count("LINK_TOO_MANY"), 1u) << name;
        EXPECT_TRUE(r.scene);
    }
    for (const char* name : {"EmptyElements", "AttributesOfOneElement"}) {
        Reading r;
        read_text(r, text_of(name));
        EXPECT_EQ(r.count("XML_LIMIT"), 1u) << name;
    }
    Reading deep;
    read_text(deep, text_of("DeepElements"));
    EXPECT_EQ(deep.count("XML_DEPTH"), 1u);
}

// Found by fuzzing: the way to what a SIDREF names leads through the SIDREF.
TEST(LimitFindings, SidrefsThatLeadToThemselvesEnd) {
    Diagnostics diag;
    auto document = read_document_text(
        "loop.dae",
        "<COLLADA xmlns=\"http://www.collada.org/2008/03/COLLADASchema\" version=\"1.5.0\">"
        "<library_articulated_systems><articulated_system id=\"a\"><SIDREF>a/b</SIDREF>"
        "</articulated_system></library_articulated_systems>"
        "<scene><instance_kinematics_scene><bind_joint_axis target=\"n/t\"><axis>"
        "<SIDREF>a/x</SIDREF></axis></bind_joint_axis></instance_kinematics_scene></scene>"
        "</COLLADA>",
        diag);
    ASSERT_TRUE(document);
    validate(*document, diag);
    auto named = [](const Finding& f) { return f.message.find("'a/x'") != f.message.npos; };
    EXPECT_TRUE(std::ranges::any_of(diag.findings(), named));
}

TEST(LimitFindings, AreCutAtFiftyThousandWithAWordOfIt) {
    Reading r;
    r.diag.judge(Judgement::Rendering);  // errors have some room more
    read_text(r, with_scene("", words(60'000, "<node><instance_light url=\"#gone\"/></node>\n")));
    EXPECT_EQ(r.diag.findings().size(), 50'001u);
    EXPECT_EQ(r.count("FINDINGS_CUT"), 1u);
}

// References across files: read once per real file, only from what is reached, and not too many.
TEST(LimitFindings, DocumentsAreReadOnceAndNotTooMany) {
    namespace fs = std::filesystem;
    const std::string folder = testing::TempDir() + "kinora_collada_limits/";
    fs::remove_all(folder);
    fs::create_directories(folder + "in");
    auto part = [](const std::string& color) {
        return "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">"
               "<asset><up_axis>Y_UP</up_axis></asset><library_lights><light id=\"l\">"
               "<technique_common><ambient><color>" +
               color +
               "</color></ambient></technique_common></light></library_lights><library_nodes>"
               "<node id=\"n\"><instance_light url=\"#l\"/></node></library_nodes></COLLADA>";
    };
    for (int i = 0; i < 40; ++i)
        std::ofstream(folder + "p" + std::to_string(i) + ".dae")
            << part(std::to_string(i) + " 0 0");
    fs::create_symlink(folder + "p0.dae", folder + "in/link.dae");
    std::string nodes;
    for (const char* file : {"p0.dae", "./p0.dae", "in/../p0.dae", "in/link.dae", "%70%30.dae",
                             "p1.dae", "missing.dae"})
        nodes += "<node><instance_node url=\"" + std::string(file) + "#n\"/></node>";
    const std::string unreached =
        "<library_nodes><node id=\"aside\"><instance_node "
        "url=\"p2.dae#n\"/></node></library_nodes>";
    std::ofstream(folder + "main.dae") << with_scene(unreached, nodes);
    Reading r;
    read_file(r, folder + "main.dae");
    ASSERT_TRUE(r.scene) << r.all();
    EXPECT_EQ(r.scene->documents.size(), 3u);  // main, p0, p1
    EXPECT_EQ(r.pointed("LINK_EXTERNAL_MISSING"), "missing.dae#n");
    ASSERT_EQ(r.scene->lights.size(), 2u);  // each document's own #l
    EXPECT_NE(r.scene->lights[0][LightSlot::Color].values[0],
              r.scene->lights[1][LightSlot::Color].values[0]);

    std::string many;
    for (int i = 0; i < 40; ++i)
        many += "<node><instance_node url=\"p" + std::to_string(i) + ".dae#n\"/></node>";
    std::ofstream(folder + "many.dae") << with_scene("", many);
    Reading few;
    ExtractOptions options;
    EXPECT_EQ(options.max_documents, 256u);
    options.max_documents = 10;
    read_file(few, folder + "many.dae", options);
    ASSERT_TRUE(few.scene);
    EXPECT_EQ(few.scene->documents.size(), 10u);
    EXPECT_EQ(few.count("LINK_TOO_MANY"), 31u);
    EXPECT_EQ(few.scene->lights.size(), 9u);  // the rest renders
}

}  // namespace
}  // namespace kinora::collada
