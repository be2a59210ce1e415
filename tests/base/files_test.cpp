// tests/base/files_test.cpp: which files may be read, how they are found, and that only regular
// ones are opened.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "runtime/base/allowed_paths.h"
#include "runtime/base/picture_search.h"
#include "runtime/base/regular_file.h"
#include "runtime/base/uri/package_uri.h"

namespace kinora {
namespace {

namespace fs = std::filesystem;

// A folder of its own, which is the current one as long as it lives.
class Files : public testing::Test {
  protected:
    Files() : before_(fs::current_path()) {
        root_ = fs::canonical(testing::TempDir()) / ("kinora_files_" + std::to_string(getpid()));
        fs::remove_all(root_);
        fs::create_directories(root_);
        fs::current_path(root_);
    }
    ~Files() override {
        fs::current_path(before_);
        fs::remove_all(root_);
    }
    void write(const std::string& name, const std::string& text = "x") {
        fs::create_directories(fs::path(root_ / name).parent_path());
        std::ofstream(root_ / name, std::ios::binary) << text;
    }
    std::string absolute(const std::string& name) const { return (root_ / name).string(); }

    fs::path root_, before_;
};

TEST_F(Files, OnlyRegularOnesAreOpened) {
    write("plain", std::string("a\0b", 3));
    fs::create_symlink("plain", "link");
    fs::create_directory("folder");
    ASSERT_EQ(mkfifo("pipe", 0600), 0);
    fs::create_symlink("pipe", "to_pipe");
    uint64_t size = 0;
    EXPECT_TRUE(open_regular_file("plain", size));
    EXPECT_EQ(size, 3u);
    EXPECT_EQ(read_regular_file("link"), std::string("a\0b", 3));
    std::string error;
    EXPECT_FALSE(read_regular_file("plain", 2, &error));
    EXPECT_EQ(error, "it is too large");
    for (const char* name : {"folder", "pipe", "to_pipe", "/dev/zero", "/dev/null", "gone", ""}) {
        error.clear();
        EXPECT_FALSE(open_regular_file(name, &error)) << name;
        EXPECT_NE(error, "") << name;
        EXPECT_FALSE(is_regular_file(name)) << name;
    }
}

TEST_F(Files, DescriptorsAreNotLeaked) {
    ASSERT_EQ(mkfifo("pipe", 0600), 0);
    int before = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    ::close(before);
    for (int i = 0; i < 100; ++i) EXPECT_FALSE(open_regular_file("pipe"));
    int after = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    ::close(after);
    EXPECT_EQ(before, after);
}

TEST_F(Files, TreesHoldNamesAndAnywhereDoesNot) {
    write("scene/own.png");
    write("secret/map.png");
    write("here.png");
    fs::create_symlink(absolute("secret/map.png"), "scene/link.png");
    AllowedPaths trees({"scene/"});
    AllowedPaths anywhere = trees.anywhere();
    EXPECT_EQ(trees.find("own.png").path, "scene/own.png");
    EXPECT_EQ(anywhere.find("own.png").path, "scene/own.png");
    for (const std::string& name :
         {std::string("link.png"), std::string("../secret/map.png"), absolute("secret/map.png")}) {
        EXPECT_TRUE(trees.find(name).outside) << name;
        AllowedPaths::Found found = anywhere.find(name);
        EXPECT_FALSE(found.outside) << name;
        EXPECT_TRUE(is_regular_file(found.path)) << found.path;
    }
    // A relative name is the scene's, wherever one stands.
    EXPECT_EQ(anywhere.find("here.png").path, "scene/here.png");
    trees.add_file("secret/map.png");
    EXPECT_TRUE(trees.contains("scene/link.png"));
    EXPECT_FALSE(trees.contains("secret/other.png"));
    EXPECT_EQ(trees.find("secret/map.png").path, "secret/map.png");
    EXPECT_FALSE(trees.find(std::string("own.png\0", 8)).path == "scene/own.png");
    EXPECT_TRUE(anywhere.find(std::string("a\0b", 3)).outside);
}

TEST_F(Files, ANameLeadsBackToItsFile) {
    write("scene/own.png");
    write("secret/map.png");
    AllowedPaths anywhere = AllowedPaths({"scene/"}).anywhere();
    EXPECT_EQ(anywhere.name_of("scene/own.png"), "scene/own.png");
    EXPECT_EQ(anywhere.name_of("secret/map.png"), absolute("secret/map.png"));
    EXPECT_EQ(anywhere.find(anywhere.name_of("secret/map.png")).path, absolute("secret/map.png"));
    fs::current_path(root_ / "scene");
    AllowedPaths here = AllowedPaths({""}).anywhere();
    EXPECT_EQ(here.name_of("own.png"), "own.png");
    EXPECT_EQ(here.find(here.name_of("../secret/map.png")).path, absolute("secret/map.png"));
}

TEST_F(Files, APictureIsFoundWhereExportersLeaveIt) {
    AllowedPaths anywhere = AllowedPaths({"a/meshes/"}).anywhere();
    write("a/meshes/main.dae");
    struct {
        const char* written;
        const char* lies;
        PictureMatch match;
    } rows[] = {
        {"a/meshes/x.png", "a/meshes/x.png", PictureMatch::Exact},
        {"a/meshes/X.png", "a/meshes/x.PNG", PictureMatch::Case},
        {"a/materials/textures/x.png", "a/materials/textures/x.png", PictureMatch::Exact},
        {"C:/art/x.png", "a/meshes/x.png", PictureMatch::Elsewhere},
        {"C:/art/x.png", "a/meshes/textures/x.png", PictureMatch::Elsewhere},
        {"C:/art/x.png", "a/meshes/images/x.png", PictureMatch::Elsewhere},
        {"C:/art/x.png", "a/textures/X.Png", PictureMatch::Elsewhere},
        {"/art/x.tga", "a/materials/textures/x.jpg", PictureMatch::Elsewhere},
        {"a/meshes/sub/x.png", "a/meshes/sub/x.tif", PictureMatch::Elsewhere},
        {"C:/art/skins/x.png", "a/meshes/skins/x.png", PictureMatch::Elsewhere},
        {"a/hides/x.png", "a/meshes/Hides/x.png", PictureMatch::Elsewhere},
        {"C:/job/art/skins/x.png", "a/meshes/art/skins/x.png", PictureMatch::Elsewhere},
        {"C:/job/art/skins/x.png", "a/Art/Skins/x.png", PictureMatch::Elsewhere},
        {"/../LWO/maps/x.png", "LWO/maps/X.png", PictureMatch::Elsewhere},
        {"C:/1/2/3/4/5/x.png", "a/2/3/4/5/x.png", PictureMatch::Elsewhere},
        {"C:/1/2/3/4/5/x.png", "a/1/2/3/4/5/x.png", PictureMatch::Missing},
        {"a/meshes/Disk 1:Poser:Skins:x.png", "a/meshes/x.png", PictureMatch::Elsewhere},
        {"a/meshes/Disk 1:Poser:Skins:x.png", "a/meshes/skins/x.png", PictureMatch::Elsewhere},
        {"a/meshes/gr\xfcn.png", "a/meshes/gr\xc3\xbcn.png", PictureMatch::Elsewhere},
        {"a/meshes/x.png", "b/x.png", PictureMatch::Missing},
        {"a/meshes/x.png", "a/meshes/textures/x.txt", PictureMatch::Missing},
    };
    for (const auto& row : rows) {
        write(row.lies);
        FoundPicture found = PictureSearch().find(row.written, "a/meshes/", anywhere);
        EXPECT_EQ(found.match, row.match) << row.written << " " << row.lies;
        if (row.match == PictureMatch::Missing)
            EXPECT_EQ(found.path, "");
        else
            EXPECT_EQ(fs::absolute(found.path), fs::absolute(row.lies)) << row.written;
        fs::remove(row.lies);
    }
}

TEST_F(Files, ConfinedPicturesAreFoundInTheTreesOnly) {
    AllowedPaths trees({"a/meshes/"});
    write("a/textures/x.png");
    PictureSearch search;
    EXPECT_EQ(search.find("a/textures/x.png", "a/meshes/", trees).match, PictureMatch::Outside);
    EXPECT_EQ(search.find("a/meshes/x.png", "a/meshes/", trees).match, PictureMatch::Missing);
    write("a/meshes/images/x.png");
    FoundPicture found = PictureSearch().find("a/textures/x.png", "a/meshes/", trees);
    EXPECT_EQ(found.match, PictureMatch::Elsewhere);
    EXPECT_EQ(found.path, "a/meshes/images/x.png");
}

// A variable of the environment, as it was before afterwards.
struct Environment {
    std::string name, before;
    bool was;
    Environment(const char* variable, const std::string& value) : name(variable) {
        const char* old = std::getenv(variable);
        was = old != nullptr;
        before = was ? old : "";
        setenv(variable, value.c_str(), 1);
    }
    ~Environment() {
        if (was)
            setenv(name.c_str(), before.c_str(), 1);
        else
            unsetenv(name.c_str());
    }
};

TEST_F(Files, PackagesAreFoundByTheirVariables) {
    write("ws/src/arm_description/meshes/a.png");
    write("ws/src/repo/hand_description/meshes/b.png");
    write("opt/share/leg_description/c.png");
    write("models/wheel/materials/d.png");
    Environment ros("ROS_PACKAGE_PATH", absolute("none") + "::" + absolute("ws/src") + "/");
    Environment ament("AMENT_PREFIX_PATH", absolute("opt"));
    Environment gazebo("GAZEBO_MODEL_PATH", absolute("models"));
    auto find = [](const char* uri) { return path_of_package_uri(uri, "elsewhere/"); };
    EXPECT_EQ(find("package://arm_description/meshes/a.png"),
              absolute("ws/src/arm_description/meshes/a.png"));
    EXPECT_EQ(find("Package://arm_description//meshes/../meshes/a.png"),
              absolute("ws/src/arm_description/meshes/a.png"));
    EXPECT_EQ(find("package://hand_description/meshes/b.png"),
              absolute("ws/src/repo/hand_description/meshes/b.png"));
    EXPECT_EQ(find("package://leg_description/c.png"), absolute("opt/share/leg_description/c.png"));
    EXPECT_EQ(find("model://wheel/materials/d.png"), absolute("models/wheel/materials/d.png"));
    for (const char* none :
         {"package://wheel/materials/d.png", "package://arm_description/none.png",
          "package://arm_description", "package://arm_description/", "package://", "package:///a",
          "package://../ws/src/arm_description/meshes/a.png", "packages://arm_description/a.png",
          "http://arm_description/meshes/a.png", "meshes/a.png"})
        EXPECT_EQ(find(none), "") << none;
    Environment itself("ROS_PACKAGE_PATH", absolute("ws/src/arm_description"));
    EXPECT_EQ(find("package://arm_description/meshes/a.png"),
              absolute("ws/src/arm_description/meshes/a.png"));
}

TEST_F(Files, PackagesAreFoundAroundTheDocument) {
    for (const char* variable : {"ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "CMAKE_PREFIX_PATH",
                                 "GAZEBO_MODEL_PATH", "GZ_SIM_RESOURCE_PATH"})
        unsetenv(variable);
    write("checkout/package.xml", "<package>\n<name>\n arm_description </name>");
    write("checkout/textures/a.png");
    write("checkout/meshes/visual/arm.dae");
    write("hand_description/textures/b.png");
    write("wheel/model.config", "<model><name>A wheel</name></model>");
    write("wheel/materials/c.png");
    write("tyre/materials/d.png");
    write("copy_description/textures/e.png");
    write("package.xml", "<name>outer</name>");
    write("textures/a.png");
    auto find = [](const char* uri, const char* folder) {
        return path_of_package_uri(uri, folder);
    };
    const char* arm = "checkout/meshes/visual/";
    EXPECT_EQ(find("package://arm_description/textures/a.png", arm),
              absolute("checkout/textures/a.png"));
    EXPECT_EQ(find("package://hand_description/textures/b.png", arm),
              absolute("hand_description/textures/b.png"))
        << "beside the document's own package";
    EXPECT_EQ(find("model://wheel/materials/c.png", "wheel/meshes/"),
              absolute("wheel/materials/c.png"));
    EXPECT_EQ(find("model://tyre/materials/d.png", "wheel/meshes/"),
              absolute("tyre/materials/d.png"));
    EXPECT_EQ(find("package://copy_description/textures/e.png", "copy_description/meshes/"),
              absolute("copy_description/textures/e.png"))
        << "a folder of that name";
    EXPECT_EQ(find("package://outer/textures/a.png", arm), "") << "the nearest package alone";
    EXPECT_EQ(find("package://arm_description/none.png", arm), "");
}

}  // namespace
}  // namespace kinora
