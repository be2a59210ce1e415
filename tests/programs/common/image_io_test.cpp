// tests/programs/common/image_io_test.cpp: pictures come back as they were written, and a name
// stands for a whole file or for none.
#include "runtime/scene/images/image_io.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfInputFile.h>
#include <ImfRgbaFile.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <half.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>

#include "runtime/scene/images/picture_file.h"

namespace kinora {
namespace {

namespace fs = std::filesystem;

class ImageIo : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() /
                  ("kinora_image_io_" + std::to_string(getpid()) + "_" +
                   testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    size_t files() const {
        size_t count = 0;
        for (const auto& entry : fs::recursive_directory_iterator(folder_))
            count += entry.is_regular_file();
        return count;
    }
    fs::path folder_;
};

std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

raytrace::Film ramp(int width, int height) {
    raytrace::Film film(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            film.at(x, y) = vec4(float(x) / float(width), float(y) / float(height), 0.25f, 1.0f);
    return film;
}

TEST_F(ImageIo, PngComesBackAsWritten) {
    Image8 image{7, 5, {}};
    for (int i = 0; i < 7 * 5 * 4; ++i) image.rgba.push_back(uint8_t(i * 37));
    ASSERT_EQ(write_png(path("a.png"), image, {{"key", "value"}}), "");
    auto back = read_png(path("a.png"));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->width, 7);
    EXPECT_EQ(back->height, 5);
    EXPECT_EQ(back->rgba, image.rgba);
    EXPECT_EQ(read_image_text(path("a.png"), "key"), "value");
    EXPECT_FALSE(read_image_text(path("a.png"), "other"));
}

TEST_F(ImageIo, ExrKeepsLinearHalfsAndTexts) {
    raytrace::Film film = ramp(9, 4);
    film.at(0, 0) = vec4(5.5f, -2.0f, 1024.0f, 0.5f);
    ASSERT_EQ(
        write_image(path("a.exr"), film, ColorEncoding::Srgb, {{"kinora/fingerprint", "0123abcd"}}),
        "");
    EXPECT_EQ(read_image_text(path("a.exr"), "kinora/fingerprint"), "0123abcd");
    Imf::RgbaInputFile file(path("a.exr").c_str());
    ASSERT_EQ(file.dataWindow().max.x, 8);
    ASSERT_EQ(file.dataWindow().max.y, 3);
    std::vector<Imf::Rgba> pixels(9 * 4);
    file.setFrameBuffer(pixels.data(), 1, 9);
    file.readPixels(0, 3);
    EXPECT_EQ(float(pixels[0].r), 5.5f);
    EXPECT_EQ(float(pixels[0].g), -2.0f);
    EXPECT_EQ(float(pixels[0].b), 1024.0f);
    EXPECT_EQ(float(pixels[0].a), 0.5f);
    for (size_t i = 1; i < pixels.size(); ++i)
        EXPECT_NEAR(float(pixels[i].r), film.rgba[i].x, 0.5f / 1024) << i;
}

TEST_F(ImageIo, FiniteColoursStayFiniteInAnExr) {
    raytrace::Film film(2, 1);
    film.at(0, 0) = vec4(1e6f, -7e4f, 65503.0f, 1.0f);
    film.at(1, 0) = vec4(std::numeric_limits<float>::infinity(), 0, 0, 1);
    ASSERT_EQ(write_image(path("a.exr"), film, ColorEncoding::Srgb, {}), "");
    Imf::RgbaInputFile file(path("a.exr").c_str());
    std::vector<Imf::Rgba> pixels(2);
    file.setFrameBuffer(pixels.data(), 1, 2);
    file.readPixels(0, 0);
    EXPECT_EQ(float(pixels[0].r), 65504.0f);
    EXPECT_EQ(float(pixels[0].g), -65504.0f);
    EXPECT_EQ(float(pixels[0].b), 65504.0f);  // halfs are 32 apart there
    EXPECT_TRUE(std::isinf(float(pixels[1].r)));
}

TEST_F(ImageIo, AnExrOfFloatsKeepsEveryBit) {
    raytrace::Film film = ramp(9, 4);
    film.at(0, 0) = vec4(1e6f, -1.0f / 3, 1e-30f, 1.0f);
    film.add_aov("dirt");
    film.aovs[0].values.assign(36, 7.0f);
    for (bool planes : {true, false}) {
        if (!planes) film.aovs.clear();
        ASSERT_EQ(write_image(path("a.exr"), film, ColorEncoding::Srgb, {{"k", "v"}}, nullptr,
                              PictureDepth::Float),
                  "");
        EXPECT_EQ(read_image_text(path("a.exr"), "k"), "v");
        Imf::InputFile file(path("a.exr").c_str());
        std::vector<float> green(36);
        Imf::FrameBuffer buffer;
        buffer.insert("G", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(green.data()),
                                      sizeof(float), 9 * sizeof(float)));
        ASSERT_EQ(file.header().channels().findChannel("G")->type, Imf::FLOAT);
        EXPECT_EQ(file.header().channels().findChannel("dirt") != nullptr, planes);
        file.setFrameBuffer(buffer);
        file.readPixels(0, 3);
        for (size_t i = 0; i < 36; ++i) EXPECT_EQ(green[i], film.rgba[i].y) << i;
    }
}

TEST_F(ImageIo, RoundingGivesWhatTheFileHas) {
    raytrace::Film film(2, 1);
    film.at(0, 0) = vec4(1e6f, 1.0f / 3, 0.1f, 1.0f);
    raytrace::Film rounded = film, kept = film;
    round_to_depth(rounded, PictureDepth::Half);
    round_to_depth(kept, PictureDepth::Float);
    EXPECT_EQ(kept.rgba[0], film.rgba[0]);
    EXPECT_EQ(rounded.rgba[0].x, 65504.0f);
    EXPECT_EQ(rounded.rgba[0].y, 1365.0f / 4096);  // the nearest of 11 bits: 1365.33
    EXPECT_EQ(rounded.rgba[0].w, 1.0f);
}

TEST_F(ImageIo, AParameterCalledLikeAChannelDoesNotReplaceIt) {
    raytrace::Film film = ramp(4, 1);
    for (const char* name : {"R", "A", "dirt"}) film.add_aov(name);
    for (raytrace::AovPlane& plane : film.aovs) plane.values.assign(4, 7.0f);
    ASSERT_EQ(write_image(path("a.exr"), film, ColorEncoding::Srgb, {}), "");
    Imf::RgbaInputFile file(path("a.exr").c_str());
    std::vector<Imf::Rgba> pixels(4);
    file.setFrameBuffer(pixels.data(), 1, 4);
    file.readPixels(0, 0);
    for (size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(float(pixels[i].r), film.rgba[i].x);
        EXPECT_EQ(float(pixels[i].a), 1.0f);
    }
    for (const char* name : {"R", "A", "R.V", "A.V", "dirt"})
        EXPECT_TRUE(file.header().channels().findChannel(name)) << name;
    EXPECT_FALSE(file.header().channels().findChannel("dirt.V"));
}

TEST_F(ImageIo, BandsGiveTheBytesOfTheWholePicture) {
    for (bool planes : {false, true})
        for (const char* name : {"a.png", "a.exr"}) {
            raytrace::Film film = ramp(9, 70);
            if (planes) film.add_aov("dirt"), film.add_aov("R"), film.aovs[1].in_file = false;
            for (raytrace::AovPlane& plane : film.aovs)
                for (size_t i = 0; i < plane.values.size(); ++i) plane.values[i] = float(i);
            const ImageTexts texts{{"kinora/fingerprint", "0123"}};
            ASSERT_EQ(write_image(path(name), film, ColorEncoding::Srgb, texts), "");
            const std::string whole = bytes_of(path(name));
            fs::remove(path(name));
            PictureFile file;
            for (int top = 0; top < film.height; top += 32) {
                raytrace::Film band;
                for (const raytrace::AovPlane& plane : film.aovs) {
                    band.add_aov(plane.name);
                    band.aovs.back().in_file = plane.in_file;
                }
                band.hold_band(film.width, top, std::min(32, film.height - top));
                const size_t first = size_t(top) * size_t(film.width);
                std::copy_n(film.rgba.begin() + ptrdiff_t(first), band.rgba.size(),
                            band.rgba.begin());
                for (size_t k = 0; k < band.aovs.size(); ++k)
                    std::copy_n(film.aovs[k].values.begin() + ptrdiff_t(first), band.rgba.size(),
                                band.aovs[k].values.begin());
                if (top == 0) {
                    ASSERT_EQ(file.begin(path(name), band, film.height, ColorEncoding::Srgb, texts),
                              "");
                }
                ASSERT_EQ(file.write(band), "");
                EXPECT_FALSE(fs::exists(path(name)));
            }
            ASSERT_EQ(file.end(), "");
            EXPECT_EQ(bytes_of(path(name)), whole) << name << planes;
        }
}

// Smooth, noisy and constant pictures, of sizes that end a chunk of 16 rows anywhere, in bands that
// do not; read by OpenEXR.
TEST_F(ImageIo, AnExrIsReadBackBitForBit) {
    const std::string kLong = "a_parameter_with_a_name_of_more_than_31_characters";
    std::mt19937 random(5);
    auto number = [&](int kind, int x, int y) {
        if (kind == 0) return 0.25f;
        if (kind == 1) return float(x) * 0.01f + float(y) * 0.002f;
        return std::ldexp(float(random()) / 4294967296.0f - 0.5f, int(random() % 34) - 20);
    };
    for (auto [width, height] : {std::pair{1, 1}, {7, 16}, {33, 17}, {130, 61}})
        for (int kind : {0, 1, 2})
            for (PictureDepth depth : {PictureDepth::Half, PictureDepth::Float}) {
                raytrace::Film film(width, height);
                film.add_aov(kLong);
                for (int y = 0; y < height; ++y)
                    for (int x = 0; x < width; ++x) {
                        for (int k = 0; k < 4; ++k) film.at(x, y)[k] = number(kind, x, y);
                        film.aovs[0].values[size_t(y * width + x)] = number(kind, x, y);
                    }
                PictureFile file;
                for (int top = 0; top < height; top += 5) {
                    raytrace::Film band;
                    band.add_aov(kLong);
                    band.hold_band(width, top, std::min(5, height - top));
                    const auto first = ptrdiff_t(top) * width;
                    std::copy_n(film.rgba.begin() + first, band.rgba.size(), band.rgba.begin());
                    std::copy_n(film.aovs[0].values.begin() + first, band.rgba.size(),
                                band.aovs[0].values.begin());
                    if (top == 0) {
                        ASSERT_EQ(file.begin(path("a.exr"), band, height, ColorEncoding::Srgb,
                                             {{"k", "v"}}, depth),
                                  "");
                    }
                    ASSERT_EQ(file.write(band), "");
                }
                ASSERT_EQ(file.end(), "");
                Imf::InputFile back(path("a.exr").c_str());
                ASSERT_TRUE(back.isComplete());
                EXPECT_EQ(back.header().compression(), Imf::ZIP_COMPRESSION);
                const size_t row = sizeof(float) * size_t(width);
                std::vector<std::vector<float>> read(5, std::vector<float>(film.rgba.size()));
                Imf::FrameBuffer buffer;
                const std::string names[] = {"R", "G", "B", "A", kLong};
                for (size_t k = 0; k < 5; ++k)
                    buffer.insert(names[k],
                                  Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(read[k].data()),
                                             sizeof(float), row));
                back.setFrameBuffer(buffer);
                back.readPixels(0, height - 1);
                for (size_t i = 0; i < film.rgba.size(); ++i) {
                    for (int k = 0; k < 4; ++k) {
                        const float written = film.rgba[i][k];
                        ASSERT_EQ(read[size_t(k)][i],
                                  depth == PictureDepth::Half ? float(half(written)) : written);
                    }
                    ASSERT_EQ(read[4][i], film.aovs[0].values[i]);
                }
            }
}

TEST_F(ImageIo, APictureThatDoesNotEndLeavesNoFile) {
    const size_t before = files();
    {
        PictureFile file;
        raytrace::Film film = ramp(8, 8);
        ASSERT_EQ(file.begin(path("b.exr"), film, 16, ColorEncoding::Srgb, {}), "");
        ASSERT_EQ(file.write(film), "");
    }
    EXPECT_EQ(files(), before);
}

// IEC 61966-2-1: linear 0.5 is 188, 0.21586 is 128 (of 255).
TEST_F(ImageIo, PngHoldsSrgbAndUnassociatedAlpha) {
    raytrace::Film film(4, 1);
    film.at(0, 0) = vec4(0.5f, 0.21586f, 0.0f, 1.0f);
    film.at(1, 0) = vec4(0.25f, 0.25f, 0.25f, 0.5f);
    film.at(2, 0) = vec4(std::nanf(""), 7.0f, -1.0f, 1.0f);
    film.at(3, 0) = vec4(std::numeric_limits<float>::infinity(), 0, 0, 0);
    Image8 image = to_8_bit(film, ColorEncoding::Srgb);
    EXPECT_EQ(std::vector<uint8_t>(image.rgba.begin(), image.rgba.begin() + 4),
              (std::vector<uint8_t>{188, 128, 0, 255}));
    EXPECT_EQ(std::vector<uint8_t>(image.rgba.begin() + 4, image.rgba.begin() + 8),
              (std::vector<uint8_t>{188, 188, 188, 128}));
    EXPECT_EQ(std::vector<uint8_t>(image.rgba.begin() + 8, image.rgba.begin() + 12),
              (std::vector<uint8_t>{0, 255, 0, 255}));
    EXPECT_EQ(image.rgba[12], 255);
    EXPECT_EQ(to_8_bit(film, ColorEncoding::Linear).rgba[0], 128);
}

TEST_F(ImageIo, NoTemporaryFileStays) {
    for (const char* name : {"a.png", "b.exr"})
        ASSERT_EQ(write_image(path(name), ramp(8, 8), ColorEncoding::Srgb, {}), "") << name;
    EXPECT_EQ(files(), 2u);
}

TEST_F(ImageIo, AFolderIsMadeWhereThatIsAskedForAlone) {
    int number = 0;
    for (const char* name : {"deep/er/c.png", "deep/er/c.exr"})
        EXPECT_NE(write_image(path(name), ramp(8, 8), ColorEncoding::Srgb, {}, &number), "");
    EXPECT_EQ(number, ENOENT);
    EXPECT_FALSE(fs::exists(path("deep")));
    EXPECT_EQ(write_image_and_folder(path("deep/er/c.png"), ramp(8, 8), ColorEncoding::Srgb, {}),
              "");
    EXPECT_EQ(files(), 1u);
}

TEST_F(ImageIo, AFileIsReplacedAsAWhole) {
    ASSERT_EQ(write_image(path("a.png"), ramp(8, 8), ColorEncoding::Srgb, {{"k", "old"}}), "");
    int old_file = open(path("a.png").c_str(), O_RDONLY);
    struct stat before {};
    fstat(old_file, &before);
    ASSERT_EQ(write_image(path("a.png"), ramp(8, 8), ColorEncoding::Srgb, {{"k", "new"}}), "");
    struct stat after {};
    ASSERT_EQ(stat(path("a.png").c_str(), &after), 0);
    EXPECT_NE(before.st_ino, after.st_ino);  // whoever reads the old one reads it to its end
    close(old_file);
    EXPECT_EQ(read_image_text(path("a.png"), "k"), "new");
}

TEST_F(ImageIo, SaysWhyItCannotWrite) {
    std::ofstream(path("plain")) << "a file";
    for (const char* name : {"plain/a.png", "plain/a.exr"}) {
        int number = 0;
        EXPECT_NE(write_image(path(name), ramp(4, 4), ColorEncoding::Srgb, {}, &number), "");
        EXPECT_EQ(number, ENOTDIR) << name;
    }
    fs::create_directories(folder_ / "taken.png");
    int number = 0;
    EXPECT_NE(write_image(path("taken.png"), ramp(4, 4), ColorEncoding::Srgb, {}, &number), "");
    EXPECT_EQ(number, EISDIR);
    std::string longest(300, 'n');
    for (const char* ending : {".png", ".exr"}) {
        EXPECT_NE(write_image(path(longest + ending), ramp(4, 4), ColorEncoding::Srgb, {}, &number),
                  "");
        EXPECT_EQ(number, ENAMETOOLONG) << ending;
    }
    EXPECT_EQ(files(), 1u);
}

TEST_F(ImageIo, ToldBeforehandWhetherAPathCanBeWritten) {
    std::ofstream(path("plain")) << "a file";
    fs::create_directories(folder_ / "taken.png");
    int number = 0;
    EXPECT_EQ(try_image_path(path("a.png")), "");
    EXPECT_NE(try_image_path(path("new/folder/a.png"), &number), "");
    EXPECT_EQ(number, ENOENT);
    EXPECT_NE(try_image_path(path("plain/a.png"), &number), "");
    EXPECT_EQ(number, ENOTDIR);
    EXPECT_NE(try_image_path(path("taken.png"), &number), "");
    EXPECT_EQ(number, EISDIR);
    EXPECT_NE(try_image_path(path(std::string(300, 'n') + ".png"), &number), "");
    EXPECT_EQ(number, ENAMETOOLONG);
    EXPECT_NE(try_image_path("/dev/full/a.png", &number), "");
    EXPECT_EQ(files(), 1u);
}

// A limit on the file size makes write(2) fail as a full disk does, at any size one likes.
TEST_F(ImageIo, AWriteThatFailsAnywhereLeavesNothing) {
    rlimit saved{};
    getrlimit(RLIMIT_FSIZE, &saved);
    auto handler = std::signal(SIGXFSZ, SIG_IGN);
    raytrace::Film film(64, 64);  // noise does not compress
    uint32_t state = 1;
    for (vec4& p : film.rgba)
        for (int k = 0; k < 4; ++k)
            p[k] = float((state = state * 1664525u + 1013904223u) >> 8) * 0x1p-24f;
    auto expect_nothing_stays = [&](const std::string& name, const raytrace::Film& picture,
                                    rlim_t size) {
        rlimit limit{size, saved.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
        int number = 0;
        std::string error = write_image(path(name), picture, ColorEncoding::Srgb, {}, &number);
        setrlimit(RLIMIT_FSIZE, &saved);
        EXPECT_EQ(number, EFBIG) << name << " " << size << " " << error;
        EXPECT_NE(error, "") << name << " " << size;
        EXPECT_EQ(files(), 0u) << name << " " << size;
    };
    for (const char* name : {"a.png", "a.exr"}) {
        for (rlim_t size : {0, 1, 100, 1000, 5000, 12000}) expect_nothing_stays(name, film, size);
        // So small that it is written when the file is closed.
        for (rlim_t size : {0, 40, 60}) expect_nothing_stays(name, ramp(4, 4), size);
        // The last byte alone.
        ASSERT_EQ(write_image(path(name), film, ColorEncoding::Srgb, {}), "");
        rlim_t whole = fs::file_size(path(name));
        fs::remove(path(name));
        expect_nothing_stays(name, film, whole - 1);
    }
    std::signal(SIGXFSZ, handler);
}

TEST_F(ImageIo, ATruncatedOrForeignFileHasNoPicture) {
    ASSERT_EQ(write_image(path("a.png"), ramp(16, 16), ColorEncoding::Srgb, {{"k", "v"}}), "");
    ASSERT_EQ(write_image(path("a.exr"), ramp(16, 16), ColorEncoding::Srgb, {{"k", "v"}}), "");
    for (const char* name : {"a.png", "a.exr"}) {
        auto size = fs::file_size(path(name));
        for (auto part : {size - 1, size / 2, size / 8, size * 0}) {
            fs::copy_file(path(name), path("cut") + fs::path(name).extension().string(),
                          fs::copy_options::overwrite_existing);
            std::string cut = path("cut") + fs::path(name).extension().string();
            fs::resize_file(cut, part);
            if (cut.ends_with(".png")) {
                EXPECT_FALSE(read_png(cut)) << part;
            }
            EXPECT_FALSE(read_image_text(cut, "k")) << cut << " " << part;
        }
    }
    std::ofstream(path("text.png")) << "no picture";
    EXPECT_FALSE(read_png(path("text.png")));
    EXPECT_FALSE(read_image_text(path("text.png"), "k"));
    EXPECT_FALSE(read_image_text(path("none.exr"), "k"));
}

raytrace::Film noise(int width, int height) {
    raytrace::Film film(width, height);
    std::mt19937 random(7);
    for (vec4& p : film.rgba)
        for (int k = 0; k < 4; ++k) p[k] = float(random() >> 8) * 0x1p-24f;
    return film;
}

// XXH3 of the bytes in hexadecimal, by the library's own function.
std::string hash_of(const std::vector<uint8_t>& bytes) {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx",
                  static_cast<unsigned long long>(XXH3_64bits(bytes.data(), bytes.size())));
    return digits;
}

TEST_F(ImageIo, APngsChecksumIsThatOfItsRows) {
    Image8 image{7, 5, {}};
    for (int i = 0; i < 7 * 5 * 4; ++i) image.rgba.push_back(uint8_t(i * 37));
    ASSERT_EQ(write_png(path("a.png"), image, {{kChecksumText, ""}, {"k", "v"}}), "");
    const std::string bytes = bytes_of(path("a.png"));
    const std::string chunk = std::string("tEXt") + kChecksumText + '\0' + hash_of(image.rgba);
    ASSERT_NE(bytes.find(chunk), bytes.npos);
    EXPECT_GT(bytes.find(chunk), bytes.find("IDAT"));
    EXPECT_EQ(read_image_text(path("a.png"), "k"), "v");
    EXPECT_TRUE(has_intact_pixels(path("a.png")));
}

// The rows of an EXR: A B G R one behind the other, halves, little-endian.
TEST_F(ImageIo, AnExrsChecksumIsThatOfItsRows) {
    raytrace::Film film(3, 2);
    std::vector<uint8_t> rows;
    for (int y = 0; y < 2; ++y)
        for (int k : {3, 2, 1, 0})
            for (int x = 0; x < 3; ++x) {
                film.at(x, y)[k] = float(x + 10 * y) / 8 + float(k);
                const uint16_t bits = half(film.at(x, y)[k]).bits();
                rows.push_back(uint8_t(bits));
                rows.push_back(uint8_t(bits >> 8));
            }
    ASSERT_EQ(write_image(path("a.exr"), film, ColorEncoding::Srgb, {{kChecksumText, ""}}), "");
    EXPECT_EQ(read_image_text(path("a.exr"), kChecksumText), hash_of(rows));
    EXPECT_TRUE(has_intact_pixels(path("a.exr")));
}

TEST_F(ImageIo, PicturesWithAChecksumAreIntactInEveryForm) {
    const ImageTexts texts{{"kinora/fingerprint", "0123"}, {kChecksumText, ""}};
    raytrace::Film film = noise(33, 50);
    film.add_aov("z"), film.add_aov("a.x");
    for (raytrace::AovPlane& plane : film.aovs)
        for (size_t i = 0; i < plane.values.size(); ++i) plane.values[i] = float(i) / 7;
    for (PictureDepth depth : {PictureDepth::Half, PictureDepth::Float})
        for (const char* name : {"a.exr", "a.png"}) {
            ASSERT_EQ(write_image(path(name), film, ColorEncoding::Srgb, texts, nullptr, depth),
                      "");
            EXPECT_TRUE(has_intact_pixels(path(name))) << name;
            EXPECT_EQ(read_image_text(path(name), "kinora/fingerprint"), "0123");
            // In bands: the same file.
            const std::string whole = bytes_of(path(name));
            PictureFile file;
            ASSERT_EQ(file.begin(path(name), film, 50, ColorEncoding::Srgb, texts, depth), "");
            for (int top = 0; top < 50; top += 20) {
                raytrace::Film band(33, std::min(20, 50 - top));
                band.top = top;
                const size_t first = size_t(top) * 33, count = band.rgba.size();
                std::copy_n(film.rgba.begin() + ptrdiff_t(first), count, band.rgba.begin());
                for (const raytrace::AovPlane& plane : film.aovs) {
                    raytrace::AovPlane part = plane;
                    part.values.assign(plane.values.begin() + ptrdiff_t(first),
                                       plane.values.begin() + ptrdiff_t(first + count));
                    band.aovs.push_back(part);
                }
                ASSERT_EQ(file.write(band), "");
            }
            ASSERT_EQ(file.end(), "");
            EXPECT_EQ(bytes_of(path(name)), whole) << name;
        }
}

TEST_F(ImageIo, WithoutAChecksumNoPictureIsIntact) {
    const raytrace::Film film = noise(16, 16);
    for (const char* name : {"a.png", "a.exr"}) {
        ASSERT_EQ(write_image(path(name), film, ColorEncoding::Srgb, {{"k", "v"}}), "");
        EXPECT_FALSE(has_intact_pixels(path(name))) << name;
        PictureFile file;
        ASSERT_EQ(file.begin(path(name), film, 16, ColorEncoding::Srgb, {{kChecksumText, ""}}), "");
        ASSERT_EQ(file.write(film), "");
        ASSERT_EQ(file.end(false), "");
        EXPECT_FALSE(has_intact_pixels(path(name))) << name;
        EXPECT_TRUE(read_image(path(name), ColorEncoding::Srgb)) << name;
    }
    EXPECT_FALSE(has_intact_pixels(path("none.png")));
    EXPECT_FALSE(has_intact_pixels(path("none.exr")));
}

// Each byte of the pixels, one after the other; those of the header are not the checksum's matter.
TEST_F(ImageIo, NoByteOfThePixelsChangesUnseen) {
    for (const char* name : {"a.png", "a.exr"}) {
        ASSERT_EQ(write_image(path(name), noise(8, 20), ColorEncoding::Srgb, {{kChecksumText, ""}}),
                  "");
        const std::string whole = bytes_of(path(name));
        const size_t pixels = name == std::string("a.png") ? whole.find("IDAT") + 4 : 400;
        for (size_t at = pixels; at < whole.size(); at += 3) {
            std::string changed = whole;
            changed[at] = char(changed[at] ^ 0x10);
            std::ofstream(path("changed") + name, std::ios::binary) << changed;
            const bool intact = has_intact_pixels(path("changed") + name);
            if (!intact) continue;
            // Then it is one that no reader looks at: the pixels are the same.
            EXPECT_EQ(read_image(path("changed") + name, ColorEncoding::Srgb)->rgba,
                      read_image(path(name), ColorEncoding::Srgb)->rgba)
                << name << " " << at;
        }
        for (size_t size : {whole.size() - 1, whole.size() / 2, size_t(0)}) {
            std::ofstream(path("cut") + name, std::ios::binary) << whole.substr(0, size);
            EXPECT_FALSE(has_intact_pixels(path("cut") + name)) << size;
        }
    }
}

TEST_F(ImageIo, KnowsItsExtensions) {
    for (const char* name : {"a.png", "a.EXR", "x/y.PNG"}) EXPECT_TRUE(is_image_path(name));
    for (const char* name : {"a.jpg", "png", "a.png.txt", "", ".png"})
        EXPECT_FALSE(is_image_path(name)) << name;
}

}  // namespace
}  // namespace kinora
