// tests/collada/everything_test.cpp: what <scene> does not reach is read for its findings, behind
// all that the picture uses.
#include <gtest/gtest.h>

#include "collada/extract/extract.h"
#include "collada/validate/validate.h"
#include "tests/collada/reading.h"
#include "tests/shared.h"

namespace kinora::collada {
namespace {

const ExtractOptions kEverything = [] {
    ExtractOptions options;
    options.everything = true;
    return options;
}();

std::string camera(const std::string& id, const std::string& yfov) {
    return "<camera id=\"" + id + "\"><optics><technique_common><perspective><yfov sid=\"f\">" +
           yfov +
           "</yfov><znear>1</znear><zfar>9</zfar></perspective></technique_common></optics>" +
           "</camera>";
}

std::string channel_of(const std::string& target) {
    return "<animation>" + float_source("in" + target, "0 1", 2, "T") +
           float_source("out" + target, "40 50", 2, "V") + "<sampler id=\"s" + target +
           "\"><input semantic=\"INPUT\" source=\"#in" + target +
           "\"/><input semantic=\"OUTPUT\" source=\"#out" + target +
           "\"/></sampler><channel source=\"#s" + target + "\" target=\"" + target +
           "/f\"/></animation>";
}

TEST(Everything, IsReadBehindWhatThePictureUses) {
    std::string text =
        with_scene("<library_cameras>" + camera("unused", "-3") + camera("spare", "30") +
                       camera("used", "45") + "</library_cameras><library_animations>" +
                       channel_of("spare") + channel_of("used") +
                       "</library_animations><library_nodes><node id=\"aside\">"
                       "<instance_light url=\"#gone\"/></node></library_nodes>",
                   "<node id=\"n\"><instance_camera url=\"#used\"/></node>");
    Reading picture;
    read_text(picture, text);
    ASSERT_TRUE(picture.scene);
    EXPECT_EQ(picture.diag.count(Severity::Warning), 0) << picture.all();
    ASSERT_EQ(picture.scene->cameras.size(), 1u);
    ASSERT_EQ(picture.scene->channels.size(), 1u);

    Diagnostics diag;
    std::optional<Document> document = read_document_text("test.dae", text, diag);
    std::optional<SceneData> all = extract(*document, diag, kEverything);
    ASSERT_TRUE(all);
    Reading heard;
    for (const Finding& f : diag.findings()) heard.diag.add(*f.info, {}, f.message);
    EXPECT_EQ(heard.count("CAM_FOV"), 1u) << heard.all();  // of "unused"
    EXPECT_EQ(heard.count("LINK_UNRESOLVED"), 1u);
    ASSERT_EQ(all->cameras.size(), 3u);
    EXPECT_EQ(all->cameras[0].id, "used");
    EXPECT_EQ(all->roots, picture.scene->roots);
    ASSERT_EQ(all->nodes.size(), 2u);
    EXPECT_EQ(all->nodes[0].id, "n");
    ASSERT_EQ(all->channels.size(), 2u);
    EXPECT_EQ(all->channels[1].ref.owner, 0u);  // the camera that is used
}

TEST(Everything, NeedsNoScene) {
    std::string text =
        "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">"
        "<library_cameras>" +
        camera("c", "190") + "</library_cameras></COLLADA>";
    Reading r;
    r.document = read_document_text("test.dae", text, r.diag);
    std::optional<SceneData> scene = validate(*r.document, r.diag);
    ASSERT_TRUE(scene);
    EXPECT_TRUE(scene->roots.empty());
    EXPECT_EQ(r.count("SCENE_NONE"), 0u);
    EXPECT_EQ(r.count("SCENE_MISSING"), 1u);
    EXPECT_EQ(r.count("CAM_FOV"), 1u) << r.all();
}

// The scenes of others: reading all of a file leaves what its picture uses where it was.
TEST(Everything, LeavesThePictureOfSharedScenesAlone) {
    std::filesystem::path folder = shared_scenes();
    if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no ../shared/scenes";
    int files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.path().extension() != ".dae") continue;
        SCOPED_TRACE(entry.path().string());
        Reading some, all;
        read_file(some, entry.path().string());
        read_file(all, entry.path().string(), kEverything);
        if (!some.scene) continue;
        ++files;
        const SceneData &a = *some.scene, &b = *all.scene;
        EXPECT_EQ(a.roots, b.roots);
        ASSERT_LE(a.nodes.size(), b.nodes.size());
        for (size_t i = 0; i < a.nodes.size(); ++i) {
            EXPECT_EQ(a.nodes[i].where.begin, b.nodes[i].where.begin);
            EXPECT_EQ(a.nodes[i].children, b.nodes[i].children);
            ASSERT_EQ(a.nodes[i].meshes.size(), b.nodes[i].meshes.size());
            for (size_t m = 0; m < a.nodes[i].meshes.size(); ++m) {
                EXPECT_EQ(a.nodes[i].meshes[m].geometry, b.nodes[i].meshes[m].geometry);
                EXPECT_EQ(a.nodes[i].meshes[m].joint_nodes, b.nodes[i].meshes[m].joint_nodes);
            }
        }
        ASSERT_LE(a.geometries.size(), b.geometries.size());
        for (size_t i = 0; i < a.geometries.size(); ++i)
            EXPECT_EQ(a.geometries[i].id, b.geometries[i].id);
        ASSERT_LE(a.materials.size(), b.materials.size());
        for (size_t i = 0; i < a.materials.size(); ++i) {
            EXPECT_EQ(a.materials[i].id, b.materials[i].id);
            EXPECT_EQ(a.materials[i].effect, b.materials[i].effect);
        }
        size_t next = 0;  // the channels of the picture, in their order
        for (const Channel& c : b.channels)
            if (next < a.channels.size() && c.where.begin == a.channels[next].where.begin &&
                c.where.file == a.channels[next].where.file &&
                c.ref.owner == a.channels[next].ref.owner)
                ++next;
        EXPECT_EQ(next, a.channels.size());
    }
    EXPECT_GE(files, 38);
}

}  // namespace
}  // namespace kinora::collada
