// tests/runtime/scene/images/texture_store_test.cpp: names, files and findings.
#include <gtest/gtest.h>

#include <bit>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>
#include <vector>

#include <unistd.h>

#include "collada/document/findings.h"
#include "rsl/model/renderer_services.h"
#include "runtime/scene/images/image_io.h"
#include "runtime/scene/images/texture.h"
#include "runtime/scene/images/texture_store.h"
#include "tests/anim/allocation_count.h"
#include "tests/runtime/scene/images/texture_lookup.h"

namespace kinora {
namespace {

namespace fs = std::filesystem;

class TextureFiles : public testing::Test {
  protected:
    void SetUp() override {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = fs::temp_directory_path() /
                  ("kinora_texture_" + std::to_string(getpid()) + test->name());
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string file(const std::string& name, const std::string& bytes) {
        std::string path = (folder_ / name).string();
        std::ofstream(path, std::ios::binary) << bytes;
        return path;
    }
    std::string png(const std::string& name, int width, int height, uint8_t grey) {
        Image8 image{width, height, {}};
        for (int i = 0; i < width * height; ++i)
            image.rgba.insert(image.rgba.end(), {grey, grey, grey, 255});
        std::string path = (folder_ / name).string();
        EXPECT_EQ(write_png(path, image, {}), "");
        return path;
    }
    fs::path folder_;
};

struct Results {
    float r[4][jit::kMaxLanes];
};

struct Footprint {
    float dsdx = 0, dtdy = 0;
    TextureFilter best = TextureFilter::Anisotropic;
};

// The "texture" service at one place, the same for all lanes.
Results call_texture(const std::vector<int32_t>& names, float s, float t, float fill = 0,
                     const Footprint& footprint = {}) {
    constexpr int kLanes = jit::kMaxLanes;
    alignas(64) float args[13][kLanes] = {};
    for (int i = 0; i < kLanes; ++i) {
        args[0][i] = jit::float_of(names[size_t(i) % names.size()]);
        args[2][i] = s;
        args[3][i] = t;
        args[4][i] = footprint.dsdx;
        args[7][i] = footprint.dtdy;
        args[9][i] = args[10][i] = 1;
        args[12][i] = fill;
    }
    Results results{};
    lookup_texture({nullptr, args[0], results.r[0], 0xffff, 0, kLanes}, TextureStore::process(),
                   footprint.best);
    return results;
}

Results call_environment(int32_t name, float x, float y, float z, float fill = 0) {
    constexpr int kLanes = jit::kMaxLanes;
    alignas(64) float args[13][kLanes] = {};
    for (int i = 0; i < kLanes; ++i) {
        args[0][i] = jit::float_of(name);
        args[2][i] = x;
        args[3][i] = y;
        args[4][i] = z;
        args[12][i] = fill;
    }
    Results results{};
    lookup_environment({nullptr, args[0], results.r[0], 0xffff, 0, kLanes},
                       TextureStore::process());
    return results;
}

// Rows of white and black. A footprint of a texel by the whole width, in the middle of a white row:
// eight taps along it see the row alone; one tap as wide as the longer side sees the mean of all.
// The lesser filters look at the finest level whatever the footprint.
TEST_F(TextureFiles, AreFilteredAtMostAsTheSceneSays) {
    Image8 image{8, 8, {}};
    for (int i = 0; i < 64; ++i) {
        const uint8_t grey = i / 8 % 2 ? 255 : 0;
        image.rgba.insert(image.rgba.end(), {grey, grey, grey, 255});
    }
    const std::string path = (folder_ / "rows.png").string();
    ASSERT_EQ(write_png(path, image, {}), "");
    const std::vector<int32_t> names{rsl::intern(path)};
    auto seen = [&](float dtdy, TextureFilter best) {
        return call_texture(names, 0.5625f, 0.5625f, 0, {1, dtdy, best}).r[0][0];
    };
    EXPECT_NEAR(seen(0.125f, TextureFilter::Anisotropic), 1, 0.01);
    EXPECT_NEAR(seen(0.125f, TextureFilter::Trilinear), 0.5, 0.01);
    EXPECT_NEAR(seen(1, TextureFilter::Anisotropic), 0.5, 0.01);
    EXPECT_NEAR(seen(1, TextureFilter::Bilinear), 1, 0.01);
    EXPECT_NEAR(seen(1, TextureFilter::Nearest), 1, 0.01);
    // Between two rows the one is halfway and the other on a row.
    auto between = [&](TextureFilter best) {
        return call_texture(names, 0.5625f, 0.5f, 0, {1, 1, best}).r[0][0];
    };
    EXPECT_NEAR(between(TextureFilter::Bilinear), 0.5, 0.01);
    EXPECT_EQ(std::abs(between(TextureFilter::Nearest) - 0.5f), 0.5f);
}

TEST_F(TextureFiles, AMissingFileShowsChecksAndIsReportedOnceAScene) {
    TextureStore store;
    int32_t name = rsl::intern((folder_ / "none.png").string());
    TextureName mirrored;
    mirrored.path = (folder_ / "none.png").string();
    mirrored.wrap_s = TextureWrap::Mirror;
    mirrored.data = true;
    int32_t other = rsl::intern(texture_name_string(mirrored));
    Diagnostics diagnostics;
    const Texture* texture = store.find(name);
    store.report(diagnostics);
    EXPECT_EQ(diagnostics.findings().size(), 0u);  // nobody has looked yet
    texture->image->asked = true;
    store.find(other)->image->asked = true;
    store.report(diagnostics);
    store.report(diagnostics);
    ASSERT_EQ(diagnostics.findings().size(), 1u);
    EXPECT_NE(diagnostics.findings()[0].message.find("no such file"), std::string::npos);
    store.preload({});  // another scene
    store.report(diagnostics);
    EXPECT_EQ(diagnostics.findings().size(), 2u);
    TextureQuery q;
    q.s = q.t = 0.99f;
    EXPECT_EQ(look_up(texture->image->pyramid, texture->modes, TextureFilter::Anisotropic, q),
              (Rgba{1, 0, 1, 1}));
    q.t = 0.8f;
    EXPECT_EQ(look_up(texture->image->pyramid, texture->modes, TextureFilter::Anisotropic, q),
              (Rgba{0, 0, 0, 1}));
}

TEST_F(TextureFiles, AFileTheReaderFoundMissingIsNotReportedAgain) {
    TextureStore store;
    std::string path = (folder_ / "none.png").string();
    Diagnostics diagnostics;
    diagnostics.report(collada::Code::FILE_MISSING, Location{}, path);
    store.find(rsl::intern(path))->image->asked = true;
    store.report(diagnostics);
    EXPECT_EQ(diagnostics.findings().size(), 1u);
}

TEST_F(TextureFiles, BytesBehindTheLastChunkOfAPngAreNoDamage) {
    std::string whole = png("whole.png", 32, 32, 99);
    std::ifstream in(whole, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(in)), {});
    TextureImage image, padded;
    EXPECT_EQ(read_texture_image(whole, image), "");
    EXPECT_EQ(read_texture_image(file("padded.png", bytes + std::string(3, '\0')), padded), "");
    EXPECT_EQ(image.bytes, padded.bytes);
    TextureImage cut;
    EXPECT_NE(read_texture_image(file("cut.png", bytes.substr(0, bytes.size() - 12)), cut), "");
}

TEST_F(TextureFiles, DamagedFilesSayWhy) {
    std::string whole = png("whole.png", 32, 32, 99);
    std::ifstream in(whole, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(in)), {});
    std::string bomb = bytes.substr(0, 33);
    bomb[18] = char(0x80), bomb[19] = 0;  // 32768 x 32768
    bomb[22] = char(0x80), bomb[23] = 0;
    const std::pair<std::string, const char*> rows[] = {
        {file("empty.png", ""), "empty"},
        {file("cut.png", bytes.substr(0, bytes.size() / 2)), "damaged"},
        {file("bomb.png", bomb), "too large"},
        {file("text.tga", "this is no picture"), ""},
        {file("text.jpg", "nor is this"), ""},
        {folder_.string(), "not a file"},
    };
    for (const auto& [path, why] : rows) {
        TextureImage image;
        std::string error = read_texture_image(path, image);
        EXPECT_NE(error, "") << path;
        EXPECT_NE(error.find(why), std::string::npos) << path << ": " << error;
    }
}

// 2 x 2, 24 bits, uncompressed, rows from the bottom: red green / blue white.
const char kTga[] =
    "\0\0\2\0\0\0\0\0\0\0\0\0\2\0\2\0\x18\0"
    "\0\0\xff\0\xff\0\xff\0\0\xff\xff\xff";

TEST_F(TextureFiles, OtherFormatsComeThroughTheModule) {
    TextureImage image;
    std::string path = file("four.tga", std::string(kTga, sizeof kTga - 1));
    ASSERT_EQ(read_texture_image(path, image), "");
    EXPECT_EQ(image.width, 2);
    EXPECT_EQ(image.height, 2);
    EXPECT_TRUE(image.encoded);
    EXPECT_EQ(image.bytes, (std::vector<uint8_t>{0, 0, 255, 255, 255, 255, 255, 255,  //
                                                 255, 0, 0, 255, 0, 255, 0, 255}));
}

TEST_F(TextureFiles, NamesShareThePixelsOfAPath) {
    TextureStore store;
    TextureName name;
    name.path = png("grey.png", 4, 4, 128);
    const Texture* plain = store.find(rsl::intern(texture_name_string(name)));
    name.wrap_s = TextureWrap::Clamp;
    const Texture* clamped = store.find(rsl::intern(texture_name_string(name)));
    EXPECT_NE(plain, clamped);
    EXPECT_EQ(plain->image, clamped->image);
    EXPECT_EQ(store.images(), 1);
    name.data = true;
    const Texture* data = store.find(rsl::intern(texture_name_string(name)));
    EXPECT_EQ(store.images(), 2);
    EXPECT_NEAR(plain->image->pyramid.texel(0, 0, 0)[0], 0.2158605, 1e-4);
    EXPECT_NEAR(data->image->pyramid.texel(0, 0, 0)[0], 128 / 255.0, 2e-4);
}

TEST_F(TextureFiles, PreloadReadsFilesAndPassesOverOtherStrings) {
    TextureStore store;
    std::vector<std::string> names = {png("a.png", 4, 4, 1), png("b.png", 4, 4, 2), "world", "",
                                      (folder_ / "none.png").string()};
    store.preload(names);
    EXPECT_EQ(store.images(), 2);
    Diagnostics diagnostics;
    store.report(diagnostics);
    EXPECT_EQ(diagnostics.findings().size(), 0u);
    EXPECT_EQ(store.find(0), nullptr);
}

TEST_F(TextureFiles, ThreadsMeetTheSameTexture) {
    TextureStore store;
    int32_t name = rsl::intern(png("shared.png", 64, 64, 50));
    std::vector<const Texture*> found(8);
    std::vector<std::thread> threads;
    for (auto& slot : found) threads.emplace_back([&] { slot = store.find(name); });
    for (std::thread& thread : threads) thread.join();
    for (const Texture* texture : found) EXPECT_EQ(texture, found[0]);
    EXPECT_EQ(store.images(), 1);
}

TEST_F(TextureFiles, LanesMayAskForDifferentTexturesWithoutAllocation) {
    std::vector<int32_t> names = {rsl::intern(png("white.png", 4, 4, 255)),
                                  rsl::intern(png("black.png", 4, 4, 0)), 0};
    Results first = call_texture(names, 0.3f, 0.3f, 0.5f);
    size_t before = allocation_count();
    Results second = call_texture(names, 0.3f, 0.3f, 0.5f);
    EXPECT_EQ(allocation_count(), before);
    const float want[3] = {1, 0, 0.5f};
    for (int i = 0; i < jit::kMaxLanes; ++i) {
        EXPECT_EQ(first.r[0][i], want[i % 3]);
        EXPECT_EQ(second.r[0][i], want[i % 3]);
    }
}

// 4 x 2 texels, a column a quarter turn.
TEST_F(TextureFiles, EnvironmentLooksUpByDirection) {
    Image8 image{4, 2, {}};
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 4; ++x)
            image.rgba.insert(image.rgba.end(), {uint8_t(60 * x), uint8_t(y ? 0 : 255), 0, 255});
    TextureName name;
    name.path = (folder_ / "map.png").string();
    name.data = true;
    name.nearest = true;
    ASSERT_EQ(write_png(name.path, image, {}), "");
    int32_t id = rsl::intern(texture_name_string(name));
    auto column = [&](float x, float y, float z) {
        return std::lround(call_environment(id, x, y, z).r[0][0] * 255 / 60);
    };
    EXPECT_EQ(column(1, 0.1f, 1), 1);   // left of the centre
    EXPECT_EQ(column(-1, 0.1f, 1), 2);  // right of it
    EXPECT_EQ(column(1, 0.1f, -1), 0);  // behind
    EXPECT_EQ(column(-1e-30f, 0, -1e-30f), 3);
    EXPECT_EQ(call_environment(id, 0, 1, 0).r[1][0], 1);   // up: the top row
    EXPECT_EQ(call_environment(id, 0, -1, 0).r[1][0], 0);  // down
    for (float bad : {0.0f, NAN, INFINITY})
        EXPECT_EQ(call_environment(id, bad, 0, 0, 0.25f).r[0][3], 0.25f) << bad;
}

}  // namespace
}  // namespace kinora
