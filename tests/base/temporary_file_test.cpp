// tests/base/temporary_file_test.cpp: a file that has its final name is whole, and nothing is left
// of one that has not.
#include "runtime/base/files/temporary_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace kinora {
namespace {

namespace fs = std::filesystem;

class TemporaryFiles : public testing::Test {
  protected:
    TemporaryFiles()
        : folder_(fs::path(testing::TempDir()) / ("kinora_temporary_" + std::to_string(getpid()))) {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    ~TemporaryFiles() override { fs::remove_all(folder_); }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    std::string text_of(const std::string& name) const {
        std::ifstream in(path(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    std::set<std::string> names() const {
        std::set<std::string> all;
        for (const auto& entry : fs::directory_iterator(folder_))
            all.insert(entry.path().filename().string());
        return all;
    }
    void put(const std::string& name, std::chrono::minutes age) const {
        std::ofstream(path(name)) << "x";
        fs::last_write_time(path(name), fs::file_time_type::clock::now() - age);
    }

    fs::path folder_;
};

TEST_F(TemporaryFiles, HaveNamesThatNoOtherProcessTakes) {
    utsname system{};
    ASSERT_EQ(uname(&system), 0);
    std::string boot;
    std::ifstream("/proc/sys/kernel/random/boot_id") >> boot;
    std::set<std::string> seen;
    for (int i = 0; i < 1000; ++i) seen.insert(temporary_name(path("f.0001.exr")));
    EXPECT_EQ(seen.size(), 1000u);
    const std::string name = fs::path(*seen.begin()).filename();
    EXPECT_TRUE(is_temporary_name(name)) << name;
    EXPECT_TRUE(name.starts_with(".f.0001.exr.kinora.")) << name;
    EXPECT_NE(name.find("." + boot.substr(0, 8) + "." + std::to_string(getpid()) + "."), name.npos)
        << name;
    std::string host = system.nodename;
    host.resize(std::min<size_t>(host.size(), 24));
    for (char& c : host)
        if (!std::isalnum(uint8_t(c))) c = '-';
    EXPECT_NE(name.find(".kinora." + host + "."), name.npos) << name;
}

TEST_F(TemporaryFiles, HaveNamesThatAFileSystemTakes) {
    for (size_t length : {1, 100, 180, 255}) {
        TemporaryFile file;
        EXPECT_EQ(file.open(path(std::string(length, 'n'))), 0) << length;
        EXPECT_EQ(file.commit(), 0) << length;
    }
    std::string wide;
    for (int i = 0; i < 85; ++i) wide += "\xe2\x82\xac";  // 255 bytes
    for (int cut = 0; cut < 3; ++cut) {
        const std::string name =
            fs::path(temporary_name(std::string(size_t(cut), 'a') + wide)).filename();
        EXPECT_LE(name.size(), 255u);
        const size_t mark = name.find(".kinora.");
        EXPECT_EQ((mark - 1 - size_t(cut)) % 3, 0u) << name;  // whole characters
    }
}

TEST_F(TemporaryFiles, BecomeWholeOrNothing) {
    std::ofstream(path("a")) << "old";
    {
        TemporaryFile file;
        ASSERT_EQ(file.open(path("a")), 0);
        std::fputs("half", file.stream());
        EXPECT_EQ(names().size(), 2u);
        EXPECT_EQ(text_of("a"), "old");
    }
    EXPECT_EQ(names(), std::set<std::string>{"a"});
    EXPECT_EQ(write_whole_file(path("a"), std::string("new\0", 4)), 0);
    EXPECT_EQ(text_of("a"), std::string("new\0", 4));
    EXPECT_EQ(write_whole_file(path("none/a"), "x"), ENOENT);
    fs::create_directory(path("taken"));
    EXPECT_EQ(write_whole_file(path("taken"), "x"), EISDIR);
    EXPECT_EQ(names(), (std::set<std::string>{"a", "taken"}));
}

TEST_F(TemporaryFiles, SayWhatTheSystemSaysOfAFailedWrite) {
    rlimit saved{};
    getrlimit(RLIMIT_FSIZE, &saved);
    auto handler = std::signal(SIGXFSZ, SIG_IGN);
    for (rlim_t size : {0, 10, 100000}) {
        rlimit limit{size, saved.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
        EXPECT_EQ(write_whole_file(path("a"), std::string(size + 1, 'x')), EFBIG) << size;
    }
    setrlimit(RLIMIT_FSIZE, &saved);
    std::signal(SIGXFSZ, handler);
    EXPECT_TRUE(names().empty());
}

TEST_F(TemporaryFiles, AreRemovedByAgeAlone) {
    const auto mine = [&](const char* name) {
        return fs::path(temporary_name(path(name))).filename().string();
    };
    const std::string old = mine("a.png"),
                      other = ".b.exr.kinora.far-away.0a1b2c3d.1.0123456789abcdef.tmp";
    const std::string young = mine("c.png");
    put(old, std::chrono::hours(25));
    put(other, std::chrono::hours(24 * 400));
    put(young, std::chrono::hours(23));
    const std::set<std::string> foreign = {".a.png.999999999.tmp",
                                           "a.png.kinora.host.0a1b2c3d.1.0123456789abcdef.tmp",
                                           ".a.png.kinora.host.0a1b2c3d.1.0123456789abcdef",
                                           ".a.png.kinora.host.0a1b2c3d.1x.0123456789abcdef.tmp",
                                           ".a.png.kinora.host.0a1b2c3d..0123456789abcdef.tmp",
                                           ".a.png.kinora.host.0a1b2c3d.1.0123456789abcde.tmp",
                                           ".a.png.kinora.host.0a1b2c3g.1.0123456789abcdef.tmp",
                                           ".a.png.konira.host.0a1b2c3d.1.0123456789abcdef.tmp",
                                           ".kinora",
                                           ".tmp",
                                           "a.png"};
    for (const std::string& name : foreign) put(name, std::chrono::hours(1000));
    remove_old_temporaries(path("f.####.png"));
    std::set<std::string> kept = foreign;
    kept.insert(young);
    EXPECT_EQ(names(), kept);
    remove_old_temporaries(path("no such folder/f.png"));
}

TEST_F(TemporaryFiles, OpenOnesAreUnlinkedAtOnce) {
    TemporaryFile a, b;
    ASSERT_EQ(a.open(path("a")), 0);
    ASSERT_EQ(b.open(path("b")), 0);
    ASSERT_EQ(b.commit(), 0);
    ASSERT_EQ(names().size(), 2u);
    unlink_temporaries();
    EXPECT_EQ(names(), std::set<std::string>{"b"});
    EXPECT_EQ(a.commit(), ENOENT);
    // More than are kept in mind.
    std::vector<std::unique_ptr<TemporaryFile>> many;
    for (int i = 0; i < 40; ++i) {
        many.push_back(std::make_unique<TemporaryFile>());
        ASSERT_EQ(many.back()->open(path("m")), 0);
    }
    many.clear();
    EXPECT_EQ(names(), std::set<std::string>{"b"});
}

TEST_F(TemporaryFiles, AReplacedFileKeepsItsPermissionsAndItsLinks) {
    std::ofstream(path("a")) << "old";
    ASSERT_EQ(chmod(path("a").c_str(), 0640), 0);
    fs::create_symlink("a", path("link"));
    EXPECT_EQ(replace_file(path("link"), "new"), 0);
    EXPECT_TRUE(fs::is_symlink(path("link")));
    EXPECT_EQ(text_of("a"), "new");
    struct stat status {};
    ASSERT_EQ(stat(path("a").c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 07777, 0640u);
    EXPECT_EQ(replace_file(path("none"), "x"), ENOENT);
    EXPECT_EQ(names(), (std::set<std::string>{"a", "link"}));
}

TEST_F(TemporaryFiles, AFolderIsMadeWithThoseAboveIt) {
    EXPECT_EQ(make_folder_of(path("a/b/c.png")), 0);
    EXPECT_TRUE(fs::is_directory(path("a/b")));
    EXPECT_EQ(make_folder_of("c.png"), 0);
    std::ofstream(path("plain")) << "x";
    EXPECT_EQ(make_folder_of(path("plain/c.png")), ENOTDIR);
}

}  // namespace
}  // namespace kinora
