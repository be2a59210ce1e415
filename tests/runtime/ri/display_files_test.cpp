// tests/runtime/ri/display_files_test.cpp: which files displays become.
#include "runtime/ri/display_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace kinora::ri {
namespace {

namespace fs = std::filesystem;

FileDisplay display_of(const std::string& name, const std::string& mode,
                       const std::string& type = "file") {
    FileDisplay made;
    made.name = name;
    made.type = type;
    made.mode = mode;
    return made;
}

FileDisplay with_floats(FileDisplay display) {
    display.quantization = Quantization{.one = 0, .low = 0, .high = 0};
    return display;
}

TEST(DisplayFile, HasAKnownSuffix) {
    auto file = [](const std::string& name) { return file_of(display_of(name, "rgb")); };
    EXPECT_EQ(file("a.tif"), "a.png");
    EXPECT_EQ(file("x/a.TIFF"), "x/a.png");
    EXPECT_EQ(file("a.png"), "a.png");
    EXPECT_EQ(file("a.exr"), "a.exr");
    EXPECT_EQ(file("a"), "a.png");
    EXPECT_EQ(file("frame.0001"), "frame.0001.png");
    EXPECT_EQ(file("scene.rib"), "scene.rib.png");
    EXPECT_EQ(file(""), "ri.png");
}

TEST(DisplayFile, OfFloatsIsExr) {
    EXPECT_EQ(file_of(with_floats(display_of("a.tif", "z"))), "a.exr");
    EXPECT_EQ(file_of(with_floats(display_of("a.png", "rgba"))), "a.exr");
    EXPECT_EQ(file_of(display_of("a.tif", "rgbaz")), "a.exr");
    EXPECT_EQ(file_of(display_of("a.tif", "N", "openexr")), "a.exr");
    FileDisplay deep = display_of("a.tif", "rgb");
    deep.quantization = Quantization{.one = 65535, .low = 0, .high = 65535};
    EXPECT_EQ(file_of(deep), "a.exr");
}

std::vector<std::string> beside(std::vector<FileDisplay> displays) {
    std::vector<std::string> paths;
    for (const DisplayFile& file : displays_beside("out/f.png", displays))
        paths.push_back(file.path);
    return paths;
}
using Paths = std::vector<std::string>;

TEST(DisplaysBeside, AreAllButTheFirstOfColours) {
    EXPECT_EQ(beside({display_of("a.tif", "rgba")}), Paths());
    EXPECT_EQ(beside({display_of("a.tif", "z"), display_of("b.tif", "rgb")}), Paths{"out/a.png"});
    EXPECT_EQ(
        beside({display_of("a.tif", "rgba"), display_of("b.tif", "rgb"), display_of("c.tif", "N")}),
        (Paths{"out/b.png", "out/c.png"}));
}

TEST(DisplaysBeside, LieInItsFolderAlone) {
    EXPECT_EQ(beside({display_of("../../etc/a.tif", "N"), display_of("/b.tif", "s"),
                      display_of("x\\c", "t"), display_of("d/..", "u")}),
              (Paths{"out/a.png", "out/b.png", "out/c.png", "out/ri.png"}));
}

TEST(DisplaysBeside, OfTheSameColoursAreNotWrittenAgain) {
    EXPECT_EQ(beside({display_of("a.tif", "rgba"), display_of("a.tif", "framebuffer"),
                      display_of("a.tif", "rgb", "framebuffer"), display_of("a.tif", "rgb"),
                      display_of("b", "rgba", "framebuffer")}),
              Paths{"out/a.png"});
    EXPECT_EQ(beside({display_of("a.tif", "s"), display_of("a.tif", "s")}), Paths{"out/a.png"});
}

TEST(DisplaysBeside, HaveFilesOfTheirOwn) {
    EXPECT_EQ(beside({display_of("a.tif", "rgba"), display_of("f.tif", "N"),
                      display_of("f.tif", "varying color glow")}),
              (Paths{"out/f.N.png", "out/f.glow.png"}));
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

TEST_F(Displays, OfOtherThingsNeedTheirPlanes) {
    write({display("a.png", "z"), display("b.png", "N")});
    EXPECT_FALSE(is_there("a.exr") || is_there("a.png") || is_there("b.png"));
    film_.add_aov("N.X"), film_.add_aov("N.Y"), film_.add_aov("N.Z"), film_.add_aov("z");
    film_.aovs[0].values[0] = -1, film_.aovs[2].values[0] = .5f;
    FileDisplay N = display("b.tif", "N");
    N.quantization = Quantization{.one = 255, .low = 0, .high = 255, .zero = 128};
    write({with_floats(display("a.tif", "z")), N});
    EXPECT_TRUE(is_there("a.exr"));
    std::optional<Image8> image = read_png(folder_ + "b.png");
    ASSERT_TRUE(image);
    // 128 + 127 v, rounded.
    EXPECT_EQ(image->rgba, (std::vector<uint8_t>{1, 128, 192, 255}));
}

TEST_F(Displays, HaveTheirOwnExposure) {
    film_.rgba = {vec4(.25f, .5f, 0, .5f)};
    FileDisplay bright = display("a.png", "rgb");
    bright.exposure = Exposure{.gain = 2, .gamma = 2};
    FilePicture picture;
    picture.exposure.gain = .5;
    picture.displays = {bright, display("b.png", "a")};
    files_.write(picture, film_);
    // (2 / .5 * 1/4) ^ (1/2) and (2 / .5 * 1/2) ^ (1/2), which is above 1.
    EXPECT_EQ(read_png(folder_ + "a.png")->rgba, (std::vector<uint8_t>{255, 255, 0, 255}));
    EXPECT_EQ(read_png(folder_ + "b.png")->rgba, (std::vector<uint8_t>{128, 128, 128, 255}));
}

TEST_F(Displays, ThatCannotBeWrittenAreErrors) {
    fs::create_directories(folder_ + "a.png");
    write({display("a.png", "rgb")});
    EXPECT_EQ(count("RI_NOT_WRITTEN"), 1);
}

}  // namespace
}  // namespace kinora::ri
