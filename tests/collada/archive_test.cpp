// tests/collada/archive_test.cpp: .zae and .kmz: what is shown, what is refused.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zip.h>

#include <cstring>
#include <fstream>

#include "collada/document/open_scene.h"
#include "collada/extract/extract.h"
#include "reading.h"

namespace kinora::collada {
namespace {

namespace fs = std::filesystem;

const std::string kDae = with_scene("", "<node id=\"n\"/>");

// Writes a zip by libzip, which takes any name.
class ZipFile {
  public:
    explicit ZipFile(const std::string& name)
        : path(testing::TempDir() + "kinora_" + std::to_string(getpid()) + "_" + name) {
        zip_ = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
    }
    ~ZipFile() { fs::remove(path); }
    zip_uint64_t add(const std::string& name, const std::string& text) {
        char* copy = static_cast<char*>(std::malloc(text.size() + 1));
        std::memcpy(copy, text.data(), text.size());
        zip_source_t* source = zip_source_buffer(zip_, copy, text.size(), 1);
        zip_int64_t index = zip_file_add(zip_, name.c_str(), source, ZIP_FL_ENC_UTF_8);
        EXPECT_GE(index, 0) << zip_strerror(zip_);
        return zip_uint64_t(index);
    }
    zip_t* zip() { return zip_; }
    const std::string& close() {
        EXPECT_EQ(zip_close(zip_), 0);
        return path;
    }
    const std::string path;

  private:
    zip_t* zip_;
};

size_t count(const Diagnostics& diag, std::string_view code) {
    size_t n = 0;
    for (const Finding& f : diag.findings()) n += f.info->code == code;
    return n;
}

std::string messages(const Diagnostics& diag) {
    std::string text;
    for (const Finding& f : diag.findings()) text += format_finding(f, diag.files);
    return text;
}

// The scene of an archive, read; its id is the node's.
std::string first_node(const SceneFile& file, Diagnostics& diag) {
    auto document = read_document(file.document, diag);
    if (!document) return {};
    ExtractOptions options;
    options.folder = file.folder;
    options.scene_id = file.scene_id;
    auto scene = extract(*document, diag, options);
    return scene && !scene->roots.empty() ? scene->nodes[scene->roots[0]].id : "";
}

TEST(Archive, ShowsTheSceneThatItsManifestNames) {
    ZipFile zip("manifest.zae");
    zip.add("a.dae", with_scene("", "<node id=\"wrong\"/>"));
    zip.add("manifest.xml",
            "<?xml version='1.0'?><dae_root xmlns='x'> ./models/the%20scene.dae#vs </dae_root>");
    zip.add("models/the scene.dae", with_scene("", "<node id=\"right\"/>"));
    Diagnostics diag;
    auto file = open_scene(zip.close(), diag);
    ASSERT_TRUE(file) << messages(diag);
    EXPECT_EQ(file->scene_id, "vs");
    EXPECT_EQ(first_node(*file, diag), "right");
    EXPECT_TRUE(diag.findings().empty()) << messages(diag);
}

TEST(Archive, ShowsTheModelThatItsKmlNames) {
    ZipFile zip("model.kmz");
    zip.add("doc.kml",
            "<k:kml xmlns:k='k'><k:Icon><k:href>a.png</k:href></k:Icon><k:Model><k:Link><k:href>"
            "models/b.DAE</k:href></k:Link></k:Model></k:kml>");
    zip.add("models/a.dae", with_scene("", "<node id=\"wrong\"/>"));
    zip.add("models/b.dae", with_scene("", "<node id=\"right\"/>"));
    Diagnostics diag;
    auto file = open_scene(zip.close(), diag);
    ASSERT_TRUE(file) << messages(diag);
    EXPECT_EQ(first_node(*file, diag), "right");
}

TEST(Archive, WithoutAWordShowsItsTopmostDaeAndSaysSo) {
    ZipFile zip("plain.zae");
    zip.add("deep/a.dae", with_scene("", "<node id=\"deep\"/>"));
    zip.add("b.dae", with_scene("", "<node id=\"top\"/>"));
    Diagnostics diag;
    auto file = open_scene(zip.close(), diag);
    ASSERT_TRUE(file);
    EXPECT_EQ(first_node(*file, diag), "top");
    EXPECT_EQ(count(diag, "ARCHIVE_ROOT"), 1u);
    EXPECT_NE(messages(diag).find("plain.zae!b.dae"), std::string::npos) << messages(diag);

    ZipFile gone("gone.zae");
    gone.add("manifest.xml", "<dae_root>nowhere.dae</dae_root>");
    gone.add("b.dae", with_scene("", "<node id=\"top\"/>"));
    Diagnostics second;
    file = open_scene(gone.close(), second);
    ASSERT_TRUE(file);
    EXPECT_NE(messages(second).find("nowhere.dae"), std::string::npos);

    ZipFile none("none.zae");
    none.add("readme.txt", "no scene");
    Diagnostics third;
    EXPECT_FALSE(open_scene(none.close(), third));
    EXPECT_EQ(count(third, "ARCHIVE_NO_SCENE"), 1u);
}

TEST(Archive, LinksAndImagesStayInsideAndFindingsNameTheMember) {
    ZipFile zip("links.zae");
    zip.add("manifest.xml", "<dae_root>models/main.dae</dae_root>");
    zip.add("models/main.dae",
            with_scene("",
                       "<node id=\"n\"><instance_node url=\"../parts/wheel.dae#w\"/>"
                       "<instance_node url=\"../../../../../../../etc/hostname#w\"/>"
                       "<instance_node url=\"#gone\"/></node>"));
    zip.add("parts/wheel.dae",
            "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">"
            "<asset><unit meter=\"0.01\"/></asset><library_nodes><node id=\"w\"/></library_nodes>"
            "</COLLADA>");
    Diagnostics diag;
    auto file = open_scene(zip.close(), diag);
    ASSERT_TRUE(file);
    auto document = read_document(file->document, diag);
    ASSERT_TRUE(document);
    ExtractOptions options;
    options.folder = file->folder;
    auto scene = extract(*document, diag, options);
    ASSERT_TRUE(scene);
    EXPECT_EQ(scene->documents.size(), 2u);
    EXPECT_EQ(count(diag, "LINK_OUTSIDE"), 1u);
    file.reset();  // what is printed later still knows the names
    std::string text = messages(diag);
    EXPECT_NE(text.find("links.zae!models/main.dae:"), std::string::npos) << text;
    EXPECT_EQ(text.find("/kinora-archive-"), std::string::npos) << text;
}

TEST(Archive, ItsFolderIsPrivateAndGoesWithIt) {
    ZipFile zip("folder.zae");
    zip.add("a.dae", kDae);
    zip.add("sub/b.png", "x");
    Diagnostics diag;
    auto file = open_scene(zip.close(), diag);
    ASSERT_TRUE(file);
    std::string folder = file->folder;
    struct stat status {};
    ASSERT_EQ(stat(folder.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0700u);
    EXPECT_TRUE(fs::exists(folder + "/sub/b.png"));
    file.reset();
    EXPECT_FALSE(fs::exists(folder));
}

TEST(Archive, MembersThatWouldLeaveItsFolderAreLeftOut) {
    std::string outside = testing::TempDir() + "kinora_evil_" + std::to_string(getpid());
    std::string up = "../kinora_evil_" + std::to_string(getpid());
    ZipFile zip("evil.zae");
    zip.add("a.dae", kDae);
    const std::string names[] = {up,        "x/../../" + up,       "..\\evil", outside, "\\evil",
                                 "C:/evil", std::string(1100, 'd')};
    for (const std::string& name : names) zip.add(name, "evil");
    zip_uint64_t link = zip.add("sub", "..");
    zip_file_set_external_attributes(zip.zip(), link, 0, ZIP_OPSYS_UNIX,
                                     zip_uint32_t(0120777) << 16);
    zip.add("sub/evil", "through the link");
    Diagnostics diag;
    auto file = open_scene(zip.close(), diag);
    ASSERT_TRUE(file) << messages(diag);
    EXPECT_EQ(count(diag, "ARCHIVE_MEMBER"), 8u) << messages(diag);
    EXPECT_FALSE(fs::exists(outside));
    EXPECT_FALSE(fs::exists(fs::path(file->folder).parent_path() / up.substr(3)));
    size_t files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(file->folder)) {
        EXPECT_FALSE(entry.is_symlink());
        files += entry.is_regular_file();
    }
    EXPECT_EQ(files, 2u);  // a.dae, and sub/evil in a real folder
}

TEST(Archive, TheFirstOfTwoMembersWithOneNameStays) {
    ZipFile zip("twice.zae");
    zip.add("a.dae", with_scene("", "<node id=\"first\"/>"));
    zip.add("./a.dae", with_scene("", "<node id=\"second\"/>"));
    Diagnostics diag;
    auto file = open_scene(zip.close(), diag);
    ASSERT_TRUE(file);
    EXPECT_EQ(first_node(*file, diag), "first");
    EXPECT_EQ(count(diag, "ARCHIVE_MEMBER"), 1u);
}

TEST(Archive, LimitsAreOfWhatIsReallyUnpacked) {
    ZipFile zip("bomb.zae");
    zip.add("a.dae", kDae);
    zip.add("zeros", std::string(8 << 20, '\0'));
    const std::string& path = zip.close();
    auto refused = [&](ArchiveLimits limits) {
        Diagnostics diag;
        bool open = open_scene(path, diag, limits).has_value();
        EXPECT_EQ(open, count(diag, "ARCHIVE_LIMIT") == 0) << messages(diag);
        return !open;
    };
    EXPECT_FALSE(refused({}));
    EXPECT_TRUE(refused({.members = 1}));
    EXPECT_TRUE(refused({.unpacked_bytes = 1 << 20}));
    EXPECT_TRUE(refused({.ratio = 100, .free_bytes = 1 << 20}));
    EXPECT_FALSE(refused({.ratio = 2000, .free_bytes = 1 << 20}));
    // Nothing stays of an archive that was refused half way.
    Diagnostics diag;
    auto archive = unpack_archive(path, {}, diag);
    ASSERT_TRUE(archive);
    EXPECT_EQ(archive->members.size(), 2u);
}

TEST(Archive, EncryptedAndDamagedMembersAreLeftOut) {
    ZipFile zip("secret.zae");
    zip.add("a.dae", kDae);
    zip_uint64_t secret = zip.add("b.dae", kDae);
    if (zip_file_set_encryption(zip.zip(), secret, ZIP_EM_AES_256, "pass") != 0)
        GTEST_SKIP() << "libzip without encryption";
    Diagnostics diag;
    auto file = open_scene(zip.close(), diag);
    ASSERT_TRUE(file);
    EXPECT_NE(messages(diag).find("secret.zae!b.dae"), std::string::npos) << messages(diag);
    EXPECT_FALSE(fs::exists(file->folder + "/b.dae"));
}

TEST(Archive, AnyDamageIsAFindingAndNeverACrash) {
    ZipFile zip("damaged.zae");
    zip.add("manifest.xml", "<dae_root>a.dae</dae_root>");
    zip.add("a.dae", kDae);
    const std::string& path = zip.close();
    std::ifstream in(path, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(in)), {});
    ASSERT_TRUE(is_archive_bytes(bytes));
    EXPECT_TRUE(is_archive(path));
    uint32_t state = 1;
    auto next = [&] { return state = state * 1664525u + 1013904223u, state >> 8; };
    for (int round = 0; round < 300; ++round) {
        std::string broken = bytes;
        if (round % 3 == 0) broken.resize(next() % bytes.size());
        for (int k = 0; k < 3 && !broken.empty(); ++k)
            broken[next() % broken.size()] = char(next());
        Diagnostics diag;
        auto file = open_scene_bytes("broken.zae", broken, diag);
        EXPECT_TRUE(file || diag.has_errors());
        if (file) first_node(*file, diag);
    }
    Diagnostics diag;
    EXPECT_FALSE(open_scene_bytes("cut.zae", bytes.substr(0, 30), diag));
    EXPECT_EQ(count(diag, "ARCHIVE_OPEN"), 1u) << messages(diag);
}

TEST(Archive, APlainFileIsHandedThrough) {
    Diagnostics diag;
    auto file = open_scene("/no/such/file.dae", diag);
    ASSERT_TRUE(file);
    EXPECT_EQ(file->document, "/no/such/file.dae");
    EXPECT_EQ(file->folder, "");
    EXPECT_TRUE(diag.findings().empty());
}

}  // namespace
}  // namespace kinora::collada
