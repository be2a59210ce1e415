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

std::string kml_model(const std::string& parts, const std::string& href) {
    return "<Placemark><name>a place</name><Model>" + parts + "<Link><href>" + href +
           "</href></Link></Model></Placemark>";
}

std::string location(const std::string& longitude, const std::string& latitude,
                     const std::string& altitude = "0") {
    return "<Location><longitude>" + longitude + "</longitude><latitude>" + latitude +
           "</latitude><altitude>" + altitude + "</altitude></Location>";
}

// What the models of a .kml become; both documents are there.
std::vector<PlacedModel> placed(const std::string& models, Diagnostics& diag) {
    ZipFile zip("placed.kmz");
    zip.add("doc.kml", "<kml><Folder>" + models + "</Folder></kml>");
    zip.add("a.dae", with_scene("", "<node id=\"a\"/>"));
    zip.add("b.dae", with_scene("", "<node id=\"b\"/>"));
    auto file = open_scene(zip.close(), diag);
    EXPECT_TRUE(file) << messages(diag);
    return file ? file->models : std::vector<PlacedModel>();
}

dvec3 seen(const dmat4& place, dvec3 p) {
    return dvec3(place * dvec4(p, 1));
}

void expect_near(dvec3 a, dvec3 b, double tolerance, const std::string& what) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], tolerance) << what << " " << k;
}

TEST(Kml, OneModelAsItStandsIsPlacedNowhere) {
    Diagnostics diag;
    EXPECT_TRUE(placed(kml_model(location("7", "51", "300"), "a.dae"), diag).empty());
    EXPECT_TRUE(placed(kml_model("<Orientation><heading>0</heading></Orientation><Scale><x>1</x>"
                                 "<y>1</y><z>1</z></Scale>",
                                 "a.dae"),
                       diag)
                    .empty());
    EXPECT_EQ(placed(kml_model("<Scale><x>2</x></Scale>", "a.dae"), diag).size(), 1u);
    EXPECT_TRUE(diag.findings().empty()) << messages(diag);
}

// WGS 84: a = 6378137, f = 1 / 298.257223563, e^2 = f (2 - f). At the equator a degree of longitude
// is a circle of radius a, one of latitude a circle of radius a (1 - e^2).
TEST(Kml, ModelsStandAsFarApartAsOnTheEarth) {
    double f = 1 / 298.257223563, degree = 3.14159265358979 / 180 * 6378137.0;
    double north = degree * (1 - f * (2 - f));
    Diagnostics diag;
    std::string absolute = "<altitudeMode>absolute</altitudeMode>";
    std::vector<PlacedModel> models =
        placed(kml_model(absolute + location("10", "0", "20"), "a.dae") +
                   kml_model(absolute + location("10.001", "0", "50"), "b.dae") +
                   kml_model(absolute + location("10", "0.001", "20"), "a.dae") +
                   kml_model(location("9.999", "0", "700"), "b.dae") + kml_model("", "a.dae"),
               diag);
    ASSERT_EQ(models.size(), 5u) << messages(diag);
    EXPECT_EQ(models[0].name, "a place");
    EXPECT_TRUE(models[0].document.ends_with("/a.dae"));
    EXPECT_TRUE(models[1].document.ends_with("/b.dae"));
    EXPECT_EQ(models[0].place, dmat4(1.0));
    EXPECT_EQ(models[4].place, dmat4(1.0)) << "without a place it stands at the first one's";
    expect_near(seen(models[1].place, dvec3(0)), {0.001 * degree, 0, 30}, 2e-3, "east, up");
    expect_near(seen(models[2].place, dvec3(0)), {0, 0.001 * north, 0}, 2e-3, "north");
    // On the ground (clampToGround) whatever its altitude says; the first one stands at 20.
    expect_near(seen(models[3].place, dvec3(0)), {-0.001 * degree, 0, -20}, 2e-3, "west");
    // The earth's curve: a quarter of the way round up is east.
    models = placed(
        kml_model(location("0", "0"), "a.dae") + kml_model(location("90", "0"), "b.dae"), diag);
    ASSERT_EQ(models.size(), 2u);
    expect_near(seen(models[1].place, dvec3(0)), {6378137.0, 0, -6378137.0}, 1e-3, "quarter");
    expect_near(dvec3(models[1].place[2]), {1, 0, 0}, 1e-12, "up");
    expect_near(dvec3(models[1].place[1]), {0, 1, 0}, 1e-12, "north");
    EXPECT_TRUE(diag.findings().empty()) << messages(diag);
}

// KML reference, <Orientation>: clockwise about z (heading), x (tilt) and y (roll); roll first.
TEST(Kml, ModelsAreTurnedAndScaled) {
    auto place_of = [](const std::string& parts) {
        Diagnostics diag;
        std::vector<PlacedModel> models = placed(kml_model(parts, "a.dae"), diag);
        EXPECT_EQ(models.size(), 1u) << messages(diag);
        return models.empty() ? dmat4(1.0) : models[0].place;
    };
    auto turned = [&](const char* heading, const char* tilt, const char* roll, dvec3 p) {
        return seen(place_of(std::string("<Orientation><heading>") + heading + "</heading><tilt>" +
                             tilt + "</tilt><roll>" + roll + "</roll></Orientation>"),
                    p);
    };
    expect_near(turned("90", "0", "0", {0, 1, 0}), {1, 0, 0}, 1e-12, "north becomes east");
    expect_near(turned("0", "90", "0", {0, 0, 1}), {0, 1, 0}, 1e-12, "up becomes north");
    expect_near(turned("0", "0", "90", {1, 0, 0}), {0, 0, 1}, 1e-12, "east becomes up");
    expect_near(turned("90", "90", "0", {0, 0, 1}), {1, 0, 0}, 1e-12, "tilt, then heading");
    expect_near(turned("0", "90", "90", {1, 0, 0}), {0, 1, 0}, 1e-12, "roll, then tilt");
    dmat4 scaled = place_of(
        "<Orientation><heading>90</heading></Orientation><Scale><x>2</x><y>3</y>"
        "<z>0.5</z></Scale>");
    expect_near(seen(scaled, {1, 1, 1}), {3, -2, 0.5}, 1e-12, "scaled along its own axes");
}

TEST(Kml, WhatSaysNothingIsLeftOutWithItsName) {
    Diagnostics diag;
    std::vector<PlacedModel> models =
        placed(kml_model(location("east", "95"), "a.dae") +
                   kml_model("<Scale><x>0</x><y>nan</y><z>4</z></Scale>", "b.dae") +
                   kml_model("", "models/gone.dae") + kml_model("", "picture.png"),
               diag);
    ASSERT_EQ(models.size(), 2u) << messages(diag);
    EXPECT_EQ(seen(models[1].place, {1, 1, 1}), dvec3(1, 1, 4));
    EXPECT_EQ(count(diag, "ARCHIVE_PLACE"), 4u) << messages(diag);
    EXPECT_EQ(count(diag, "ARCHIVE_MODEL"), 1u) << messages(diag);
    EXPECT_NE(messages(diag).find("models/gone.dae"), std::string::npos);
    EXPECT_NE(messages(diag).find("<latitude> is '95'"), std::string::npos) << messages(diag);
}

// Metres with z up are the places of a .kml; the world is the first document's: centimetres, y up.
TEST(Kml, ModelsOfOtherUnitsAndAxesMeetInTheWorldOfTheFirst) {
    auto asset = [](const char* meter, const char* up) {
        return std::string(
                   "<asset><created>2026-01-01T00:00:00Z</created><modified>"
                   "2026-01-01T00:00:00Z</modified><unit meter=\"") +
               meter + "\"/><up_axis>" + up + "</up_axis></asset>";
    };
    ZipFile zip("axes.kmz");
    zip.add("doc.kml", "<kml>" + kml_model(location("10", "0"), "a.dae") +
                           kml_model("<altitudeMode>relativeToGround</altitudeMode>" +
                                         location("10", "0", "7") + "<Scale><z>2</z></Scale>",
                                     "b.dae") +
                           kml_model("<altitudeMode>relativeToGround</altitudeMode>" +
                                         location("10", "0", "9"),
                                     "a.dae") +
                           "</kml>");
    zip.add("a.dae", with_scene(asset("0.01", "Y_UP"), "<node id=\"a\"/>"));
    zip.add("b.dae", with_scene(asset("1", "Z_UP"), "<node id=\"b\"/><node id=\"c\"/>"));
    Diagnostics diag;
    auto file = open_scene(zip.close(), diag);
    ASSERT_TRUE(file) << messages(diag);
    auto document = read_document(file->document, diag);
    ASSERT_TRUE(document);
    ExtractOptions options;
    options.folder = file->folder;
    options.models = file->models;
    for (bool everything : {false, true}) {
        options.everything = everything;
        auto scene = extract(*document, diag, options);
        ASSERT_TRUE(scene) << messages(diag);
        ASSERT_EQ(scene->roots.size(), 3u);
        auto world = [&](size_t root, size_t instance, dvec3 p) {
            const Node& node = scene->nodes[scene->roots[root]];
            const Slot& slot = node.transforms.at(0).slot;
            dmat4 place;
            for (int c = 0; c < 4; ++c)
                for (int r = 0; r < 4; ++r) place[c][r] = slot.values[size_t(c * 4 + r)];
            uint32_t index = node.instances.at(instance).conversion;
            dmat4 change = index == kNone ? dmat4(1.0) : scene->conversions[index];
            return seen(place, dvec3(change * dvec4(p, 1)));
        };
        EXPECT_EQ(scene->nodes[scene->nodes[scene->roots[1]].instances.at(1).node].id, "c");
        EXPECT_EQ(scene->nodes[scene->roots[2]].instances.at(0).node,
                  scene->nodes[scene->roots[0]].instances.at(0).node)
            << "one document, read once";
        expect_near(world(0, 0, {1, 2, 3}), {1, 2, 3}, 1e-9, "the first stands as it is");
        // One metre up and three north in b: twice that height above 7 m; north is -z.
        expect_near(world(1, 0, {0, 3, 1}), {0, 900, -300}, 1e-6, "the second");
        expect_near(world(2, 0, {0, 50, 0}), {0, 950, 0}, 1e-6, "the first document again");
    }
    EXPECT_TRUE(diag.findings().empty()) << messages(diag);
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
