// tests/runtime/player/display_test.cpp: what a screen shows of a film.
#include "runtime/player/display.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "runtime/picture/frame/frame.h"
#include "runtime/player/bytes/byte_kernels.h"
#include "runtime/player/bytes/shown_bytes.h"
#include "runtime/player/picture/guide.h"
#include "tests/runtime/player/played.h"

namespace kinora {
namespace {

raytrace::Film random_film() {
    raytrace::Film film(256, 64);
    uint32_t state = 3;
    auto number = [&] {
        state = state * 1664525u + 1013904223u;
        return float(state >> 8) / float(1 << 24);
    };
    for (vec4& pixel : film.rgba) {
        pixel = {number() * 1.2f, number() * number() * number(), -0.1f + number(), number()};
        if (number() < 0.1f) pixel.w = 0;
        if (number() < 0.02f) pixel.x = std::numeric_limits<float>::quiet_NaN();
        if (number() < 0.02f) pixel.y = std::numeric_limits<float>::infinity();
        if (&pixel - film.rgba.data() >= 256 * 32) pixel.w = 1;  // as most pictures are
        if (number() < 0.1f) pixel.z = std::exp2(-30 * number());
    }
    return film;
}

TEST(Display, IsThePngOfTheFilm) {
    raytrace::Film film = random_film();
    for (ColorEncoding encoding : {ColorEncoding::Srgb, ColorEncoding::Linear}) {
        std::vector<uint8_t> shown;
        DisplaySettings settings;
        settings.encoding = encoding;
        display(film, {}, {}, settings, shown);
        EXPECT_EQ(shown, to_8_bit(film, encoding).rgba);
        for (size_t number = 0; number < usable_byte_kernels().count; ++number) {
            std::ranges::fill(shown, uint8_t(0));
            shown_bytes(film.rgba, encoding, shown.data(), *usable_byte_kernels().kernels[number]);
            EXPECT_EQ(shown, to_8_bit(film, encoding).rgba);
        }
    }
}

// Every float around each byte's threshold.
TEST(Display, HasTheSameBytesAtEveryThreshold) {
    raytrace::Film film(1, 1);
    film.rgba.clear();
    for (int v = 0; v < 255; ++v) {
        double encoded = (v + 0.5) / 255;
        double linear =
            encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
        uint32_t bits = std::bit_cast<uint32_t>(float(linear));
        for (uint32_t k = 0; k < 64; ++k) {
            float c = std::bit_cast<float>(bits + k - 32);
            film.rgba.push_back({c, c, c, 1});
        }
    }
    film.width = int(film.rgba.size());
    const std::vector<uint8_t> expected = to_8_bit(film, ColorEncoding::Srgb).rgba;
    for (size_t number = 0; number < usable_byte_kernels().count; ++number) {
        const ByteKernels& kernels = *usable_byte_kernels().kernels[number];
        std::vector<uint8_t> shown(4 * film.rgba.size());
        shown_bytes(film.rgba, ColorEncoding::Srgb, shown.data(), kernels);
        EXPECT_EQ(shown, expected) << kernels.name;
    }
}

TEST(Display, FalseColorsGrowFromBlackOverBlueToRedAndWhite) {
    EXPECT_EQ(false_color(-1), vec3(0.0f));
    EXPECT_GT(false_color(0.2f).z, false_color(0.2f).x);
    EXPECT_EQ(false_color(1), vec3(1, 0, 0));
    EXPECT_EQ(false_color(1.01f), vec3(1.0f));
}

TEST(Display, AKeptPictureStandsLeftOfTheWipe) {
    auto kept = std::make_shared<Picture>();
    kept->width = 4;
    kept->height = 1;
    kept->rgba.assign(16, 7);
    raytrace::Film film(4, 1);
    for (vec4& pixel : film.rgba) pixel = vec4(1.0f);
    DisplaySettings settings;
    settings.kept = kept;
    settings.wipe_at = 0.25;
    std::vector<uint8_t> shown;
    display(film, {}, {}, settings, shown);
    EXPECT_EQ(shown[3], 7);
    EXPECT_EQ(shown[4], 255);
}

// Two surfaces that meet in the middle: neither color reaches over.
TEST(Enlarge, KeepsTheEdgesOfSurfaces) {
    constexpr int kSmall = 8, kLarge = 32;
    raytrace::Film small(kSmall, kSmall), large;
    for (int y = 0; y < kSmall; ++y)
        for (int x = 0; x < kSmall; ++x) small.at(x, y) = vec4(x < 4 ? 0.0f : 1.0f);
    PictureGuide guide;
    guide.width = guide.height = kLarge;
    for (int k = 0; k < kLarge * kLarge; ++k) {
        guide.surface.push_back(k % kLarge < 16 ? 0 : 1);
        guide.Ng.push_back({0, 0, 1});
        guide.depth.push_back(1);
    }
    enlarge(small, guide, kLarge, kLarge, large);
    for (int y = 0; y < kLarge; ++y)
        for (int x = 0; x < kLarge; ++x) EXPECT_NEAR(large.at(x, y).x, x < 16 ? 0 : 1, 1e-2) << x;
}

// By a guide of half the size, where the edge lies between two of its pixels.
TEST(Enlarge, TakesAGuideOfHalfTheSize) {
    raytrace::Film small(4, 1), large;
    for (int x = 0; x < 4; ++x) small.at(x, 0) = vec4(x < 2 ? 0.25f : 0.75f);
    PictureGuide guide;
    guide.width = 5, guide.height = 1;
    for (int k = 0; k < 5; ++k) {  // of 9 x 2 pixels
        guide.surface.push_back(k < 2 ? 0 : 1);
        guide.Ng.push_back({0, 0, 1});
        guide.depth.push_back(1);
    }
    enlarge(small, guide, 9, 2, large);
    for (int x = 0; x < 9; ++x) EXPECT_NEAR(large.at(x, 1).x, x < 4 ? 0.25f : 0.75f, 1e-2f) << x;
}

// A guide with rays beside edges alone enlarges a quarter of the width as one with rays everywhere.
TEST(Guide, RaysBesideEdgesSuffice) {
    SceneRequest request = small_request(scene_path("scenes/walker.dae"));
    request.width = 160;
    request.height = 90;
    OpenedScene opened(request);
    ASSERT_TRUE(opened.scene);
    FirstHits hits;
    hits.places = true;
    opened.settings.insight.first = &hits;
    raytrace::Film film;
    FrameStats stats;
    ASSERT_TRUE(render_frame(*opened.scene, *opened.pose, 0, opened.settings, film, stats,
                             opened.diagnostics));
    PictureGuide small, whole, refined;
    take_guide(hits, opened.pose->view, small);
    make_guide(*opened.pose, 320, 180, whole);
    refine_guide(*opened.pose, small, 320, 180, refined);
    size_t taken = 0, surfaces = 0;
    for (size_t k = 0; k < whole.surface.size(); ++k) {
        taken += refined.depth[k] != whole.depth[k];
        surfaces += refined.surface[k] != whole.surface[k];
    }
    EXPECT_GT(double(taken), 0.5 * double(whole.surface.size()));  // so many rays less
    EXPECT_LT(double(surfaces), 0.005 * double(whole.surface.size()));
    raytrace::Film by_whole, by_refined;
    enlarge(film, whole, 640, 360, by_whole);
    enlarge(film, refined, 640, 360, by_refined);
    double apart = 0;
    size_t far = 0;
    for (size_t k = 0; k < by_whole.rgba.size(); ++k) {
        const double one = std::abs(double(by_whole.rgba[k].y) - double(by_refined.rgba[k].y));
        apart += one / double(by_whole.rgba.size());
        far += one > 0.02;
    }
    EXPECT_LT(apart, 1e-3);
    EXPECT_LT(double(far), 0.005 * double(by_whole.rgba.size()));
    std::printf("rays %zu of %zu, %zu other surfaces, %.6f apart, %zu far\n",
                whole.surface.size() - taken, whole.surface.size(), surfaces, apart, far);
}

TEST(Display, NamesAovsByTheirLayersAndOnce) {
    raytrace::Film film(1, 1);
    for (const char* name : {"P.X", "P.Y", "P.Z", "uv.u", "uv.v", "motion.next.x", "motion.next.y",
                             "crypto_object00.R", "crypto_object00.A", "lamps.2", "Z", "depth"})
        film.add_aov(name);
    const std::vector<std::string> names = shown_names(film.aovs);
    const std::vector<std::string> first{"",        "P", "uv", "motion.next", "crypto_object00",
                                         "lamps.2", "Z"};
    ASSERT_GT(names.size(), first.size());
    EXPECT_TRUE(std::equal(first.begin(), first.end(), names.begin()));
    EXPECT_EQ(std::count(names.begin(), names.end(), "depth"), 1);
}

// The background of a distance is no part of its scale.
TEST(Display, ScalesDistancesByWhatIsSeen) {
    raytrace::Film film(3, 1);
    film.add_aov("Z").values = {2, 6, raytrace::kNoDepth};
    DisplaySettings settings;
    settings.aov = "Z";
    const auto scale = number_scale(film, {}, {}, settings);
    ASSERT_TRUE(scale);
    EXPECT_EQ(scale->low, 2);
    EXPECT_EQ(scale->high, 6);
}

}  // namespace
}  // namespace kinora
