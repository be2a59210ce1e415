// tests/base/content_hash_test.cpp: what stands for bytes, files and builds.
#include "runtime/base/files/content_hash.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>

#include "runtime/base/files/build_id.h"

namespace kinora {
namespace {

namespace fs = std::filesystem;

std::string digits_of(std::string_view bytes, size_t piece) {
    ContentHash hash;
    for (; !bytes.empty(); bytes.remove_prefix(std::min(piece, bytes.size())))
        hash.add(bytes.data(), std::min(piece, bytes.size()));
    return hash.digits();
}

// XXH3's own test vector for no input is 2d06800538d394c2.
TEST(ContentHash, IsXxh3) {
    EXPECT_EQ(ContentHash().digits(), "2d06800538d394c2");
}

TEST(ContentHash, DoesNotDependOnThePieces) {
    std::string bytes;
    for (int i = 0; i < 5000; ++i) bytes += char(i * i % 251);
    for (size_t piece : {1, 7, 64, 1000, 5000})
        EXPECT_EQ(digits_of(bytes, piece), digits_of(bytes, 4999)) << piece;
    EXPECT_NE(digits_of(bytes + "x", 64), digits_of(bytes, 64));
}

TEST(ContentHash, TellsTextsFromOneText) {
    ContentHash two, one;
    two.add_text("ab"), two.add_text("c");
    one.add_text("a"), one.add_text("bc");
    EXPECT_NE(two.value(), one.value());
}

TEST(FileHashes, AreOfContentWhateverTheName) {
    const fs::path folder =
        fs::path(testing::TempDir()) / ("kinora_hash_" + std::to_string(getpid()));
    fs::create_directories(folder);
    const auto write = [&](const char* name, const std::string& text) {
        std::ofstream(folder / name, std::ios::binary) << text;
    };
    write("a", "one"), write("b", "one"), write("c", "two");
    fs::create_hard_link(folder / "a", folder / "d");
    FileHashes files;
    const auto of = [&](const char* name) { return files.of((folder / name).string()); };
    ASSERT_TRUE(of("a"));
    EXPECT_EQ(of("a"), of("b"));
    EXPECT_EQ(of("a"), of("d"));
    EXPECT_NE(of("a"), of("c"));
    EXPECT_FALSE(of("none"));
    EXPECT_FALSE(of("."));
    fs::remove_all(folder);
}

TEST(BuildId, IsThatOfTheProgramsFile) {
    const std::string id = build_id();
    EXPECT_EQ(id.find_first_not_of("0123456789abcdef"), id.npos) << id;
    const std::string command = "readelf -n /proc/" + std::to_string(getpid()) + "/exe 2>/dev/null";
    std::unique_ptr<std::FILE, decltype(&pclose)> pipe(popen(command.c_str(), "r"), &pclose);
    std::string notes(1 << 16, '\0');
    notes.resize(std::fread(notes.data(), 1, notes.size(), pipe.get()));
    if (notes.find("Build ID: ") == notes.npos) GTEST_SKIP() << "no readelf, or no build id";
    EXPECT_NE(notes.find("Build ID: " + id + "\n"), notes.npos) << id << notes;
}

}  // namespace
}  // namespace kinora
