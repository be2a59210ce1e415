// tests/runtime/ri/display_files_test.cpp: which files displays become.
#include "runtime/ri/display_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace kinora::ri {
namespace {

namespace fs = std::filesystem;

TEST(PictureFile, HasAKnownSuffix) {
    EXPECT_EQ(picture_file("a.tif"), "a.png");
    EXPECT_EQ(picture_file("x/a.TIFF"), "x/a.png");
    EXPECT_EQ(picture_file("a.png"), "a.png");
    EXPECT_EQ(picture_file("a.exr"), "a.exr");
    EXPECT_EQ(picture_file("a"), "a.png");
    EXPECT_EQ(picture_file("frame.0001"), "frame.0001.png");
    EXPECT_EQ(picture_file("scene.rib"), "scene.rib.png");
}

class Displays : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = testing::TempDir() + "/displays/";
        fs::remove_all(folder_);
        film_.width = film_.height = 1;
        film_.rgba = {vec4(1, 0, 0, 1)};
        diagnostics_.judge(Judgement::Rendering);
    }
    void write(std::initializer_list<FileDisplay> displays) {
        FilePicture picture;
        picture.displays = displays;
        files_.write(picture, film_);
    }
    FileDisplay display(const std::string& name, const std::string& mode) const {
        FileDisplay made;
        made.name = folder_ + name;
        made.mode = mode;
        return made;
    }
    bool is_there(const std::string& name) const { return fs::exists(folder_ + name); }
    long count(std::string_view code) const {
        return std::ranges::count_if(diagnostics_.findings(),
                                     [&](const Finding& f) { return f.info->code == code; });
    }

    std::string folder_;
    raytrace::Film film_;
    Diagnostics diagnostics_;
    DisplayFiles files_{diagnostics_};
};

TEST_F(Displays, OfColorsAreWritten) {
    write({display("a.png", "rgb"), display("b.tif", "rgba"), display("c.exr", "rgba")});
    EXPECT_TRUE(is_there("a.png") && is_there("b.png") && is_there("c.exr"));
    write({display("d.tif", "rgba")});
    EXPECT_TRUE(is_there("d.png"));
    EXPECT_EQ(count("RI_DISPLAY"), 1);
    EXPECT_EQ(diagnostics_.findings().size(), 1u);
}

TEST_F(Displays, OfOtherThingsAreNotAndSayItOnce) {
    write({display("a.png", "z"), display("b.png", "rgbaz")});
    write({display("a.png", "z")});
    EXPECT_FALSE(is_there("a.png"));
    EXPECT_TRUE(is_there("b.png"));
    EXPECT_EQ(count("RI_NOT_DONE"), 2);
}

TEST_F(Displays, ThatCannotBeWrittenAreErrors) {
    fs::create_directories(folder_ + "a.png");
    write({display("a.png", "rgb")});
    EXPECT_EQ(count("RI_NOT_WRITTEN"), 1);
}

}  // namespace
}  // namespace kinora::ri
