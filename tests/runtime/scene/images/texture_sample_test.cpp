// tests/runtime/scene/images/texture_sample_test.cpp: the sampler against double arithmetic on the
// pixels.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/runtime/scene/images/texture_lookup.h"

namespace kinora {
namespace {

constexpr TextureWrap kWraps[] = {TextureWrap::Wrap, TextureWrap::Mirror, TextureWrap::Clamp,
                                  TextureWrap::Border};

// What texel i of an endless row of n shows: by modular arithmetic on the index.
int reference_index(TextureWrap wrap, long i, long n) {
    long two = ((i % (2 * n)) + 2 * n) % (2 * n);
    switch (wrap) {
        case TextureWrap::Wrap:
            return int(two % n);
        case TextureWrap::Mirror:
            return int(two < n ? two : 2 * n - 1 - two);
        case TextureWrap::Clamp:
            return int(std::min(std::max(i, 0L), n - 1));
        case TextureWrap::Border:
            return i < 0 || i >= n ? -1 : int(i);
    }
    return 0;
}

double reference_texel(const TextureImage& image, const TextureName& modes, long x, long y, int c) {
    int i = reference_index(modes.wrap_s, x, image.width);
    int j = reference_index(modes.wrap_t, y, image.height);
    if (i < 0 || j < 0) return modes.border[size_t(c)];
    size_t at = (size_t(image.height - 1 - j) * size_t(image.width) + size_t(i)) * 4;
    return image.floats[at + size_t(c)];
}

double reference_bilinear(const TextureImage& image, const TextureName& modes, double s, double t,
                          int c) {
    double a = s - 0.5, b = t - 0.5, cosine = modes.turn[0], sine = modes.turn[1];
    s = cosine * a - sine * b + 0.5;
    t = sine * a + cosine * b + 0.5;
    double x = (s * modes.uv[0] + modes.uv[2]) * image.width - 0.5;
    double y = (t * modes.uv[1] + modes.uv[3]) * image.height - 0.5;
    double i = std::floor(x), j = std::floor(y), fx = x - i, fy = y - j;
    auto at = [&](int dx, int dy) {
        return reference_texel(image, modes, long(i) + dx, long(j) + dy, c);
    };
    return (at(0, 0) * (1 - fx) + at(1, 0) * fx) * (1 - fy) +
           (at(0, 1) * (1 - fx) + at(1, 1) * fx) * fy;
}

TextureQuery at(float s, float t) {
    TextureQuery query;
    query.s = s;
    query.t = t;
    return query;
}

TEST(TextureSampler, BilinearFollowsEveryWrapModeAtEverySize) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> place(-3, 4);
    const int sizes[][2] = {{1, 1}, {1, 7}, {7, 1}, {5, 3}, {8, 8}, {33, 17}};
    for (auto [width, height] : sizes) {
        TextureImage image = float_image(width, height);
        TexturePyramid pyramid(image, false);
        for (TextureWrap s : kWraps)
            for (TextureWrap t : kWraps) {
                TextureName modes;
                modes.wrap_s = s;
                modes.wrap_t = t;
                modes.border = {0.2f, 0.4f, 0.6f, 0.8f};
                modes.uv = {1.25f, 0.75f, 0.125f, -0.25f};
                for (int k = 0; k < 200; ++k) {
                    TextureQuery q = at(place(random), place(random));
                    if (s == TextureWrap::Border) q.s = std::clamp(q.s, -0.8f, 1.5f);
                    if (t == TextureWrap::Border) q.t = std::clamp(q.t, -0.8f, 1.5f);
                    Rgba got = look_up(pyramid, modes, TextureFilter::Bilinear, q);
                    for (int c = 0; c < 4; ++c)
                        ASSERT_NEAR(got[size_t(c)], reference_bilinear(image, modes, q.s, q.t, c),
                                    1e-4)
                            << width << "x" << height << " wraps " << int(s) << int(t) << " at "
                            << q.s << " " << q.t;
                }
            }
    }
}

TEST(TextureSampler, TurnsAboutTheMiddleOfTheImageBeforeItRepeats) {
    TextureImage image = float_image(9, 6);
    TexturePyramid pyramid(image, false);
    TextureName modes;
    modes.turn = {0.6f, 0.8f};
    modes.uv = {1.25f, 0.75f, 0.125f, -0.25f};
    for (int k = 0; k < 100; ++k) {
        TextureQuery q = at(float(k) * 0.017f, 1 - float(k) * 0.011f);
        Rgba got = look_up(pyramid, modes, TextureFilter::Bilinear, q);
        for (int c = 0; c < 4; ++c)
            ASSERT_NEAR(got[size_t(c)], reference_bilinear(image, modes, q.s, q.t, c), 1e-4);
    }
    TextureName back = parse_texture_name(texture_name_string(modes));
    EXPECT_EQ(back.turn, modes.turn);
    EXPECT_EQ(back.uv, modes.uv);
}

TEST(TextureSampler, NearestMayHoldForLargeOrSmallTexelsOnly) {
    TexturePyramid pyramid(byte_image(64, 64, [](int x, int) { return 4 * x; }), false);
    auto value = [&](TextureName modes, float texels) {
        TextureQuery q = at(20.25f / 64, 0.5f);
        q.dsdx = q.dtdy = texels / 64;
        modes = parse_texture_name(texture_name_string(modes));
        return 255 * look_up(pyramid, modes, TextureFilter::Anisotropic, q)[0];
    };
    TextureName magnified, minified;
    magnified.path = minified.path = "x";
    magnified.nearest_magnified = true;
    minified.nearest_minified = true;
    minified.mip = TextureMip::None;
    EXPECT_NEAR(value(magnified, 0.5f), 80, 0.01);  // texel 20
    EXPECT_NEAR(value(minified, 0.5f), 79, 0.1);    // a quarter of texel 19 beside it
    EXPECT_NEAR(value(minified, 8), 80, 0.01);
    EXPECT_GT(std::abs(value(magnified, 8) - 80), 0.5);
}

// Level k of a ramp of 64 texels has one of 64 >> k, each the mean of those it stands for.
TEST(TextureSampler, LevelsAreChosenByMipFilterBiasAndLimit) {
    TexturePyramid pyramid(byte_image(64, 64, [](int x, int) { return 4 * x; }), false);
    auto value = [&](TextureMip mip, bool nearest, float texels, float bias = 0, int limit = 0) {
        TextureName modes;
        modes.path = "x";
        modes.mip = mip;
        modes.nearest_minified = nearest;
        modes.mip_bias = bias;
        modes.mip_max_level = uint8_t(limit);
        modes = parse_texture_name(texture_name_string(modes));
        TextureQuery q = at(20.25f / 64, 0.5f);
        q.dsdx = q.dtdy = texels / 64;
        return 255 * look_up(pyramid, modes, TextureFilter::Trilinear, q)[0];
    };
    auto mean = [](int first, int count) { return 4 * (first + (count - 1) / 2.0f); };
    EXPECT_NEAR(value(TextureMip::None, true, 8), 80, 0.1);              // texel 20
    EXPECT_NEAR(value(TextureMip::Nearest, true, 4), mean(20, 4), 0.1);  // texel 5 of 16
    EXPECT_NEAR(value(TextureMip::Nearest, true, 5), mean(20, 4), 0.1);  // nearer to 4 than to 8
    EXPECT_NEAR(value(TextureMip::Nearest, true, 7), mean(16, 8), 0.1);  // texel 2 of 8
    EXPECT_NEAR(value(TextureMip::Linear, true, 4), mean(20, 4), 0.5);
    EXPECT_NEAR(value(TextureMip::Linear, true, 5.656854f), (mean(20, 4) + mean(16, 8)) / 2, 0.5);
    EXPECT_NEAR(value(TextureMip::Nearest, true, 8, -3), 80, 0.1);  // three levels nearer
    EXPECT_NEAR(value(TextureMip::Nearest, true, 32, 0, 2), mean(20, 4), 0.1);
}

TEST(TextureSampler, NearestTakesTheTexelThatHoldsThePoint) {
    TexturePyramid pyramid(byte_image(4, 2, [](int x, int y) { return 10 * x + 100 * y; }), false);
    TextureName modes;
    modes.nearest = true;
    auto value = [&](float s, float t) {
        return std::lround(255 * look_up(pyramid, modes, TextureFilter::Anisotropic, at(s, t))[0]);
    };
    EXPECT_EQ(value(0.0f, 0.0f), 0);  // t = 0 is the bottom row
    EXPECT_EQ(value(0.24f, 0.49f), 0);
    EXPECT_EQ(value(0.26f, 0.51f), 110);
    EXPECT_EQ(value(0.99f, 0.99f), 130);
    EXPECT_EQ(value(1.26f, -0.1f), 110);
}

TEST(TextureSampler, FootprintChoosesTheLevel) {
    auto checks = [](int x, int y) { return (x + y) & 1 ? 0 : 255; };
    TexturePyramid pyramid(byte_image(64, 64, checks), false);
    auto value = [&](float texels) {
        TextureQuery q = at(0.5f / 64, 0.5f / 64);  // the centre of a white texel
        q.dsdx = q.dtdy = texels / 64;
        return look_up(pyramid, TextureName(), TextureFilter::Anisotropic, q)[0];
    };
    EXPECT_NEAR(value(0), 1, 1e-6);
    EXPECT_NEAR(value(1), 1, 1e-6);
    EXPECT_NEAR(value(std::sqrt(2.0f)), 0.75, 1e-3);  // halfway between levels 0 and 1
    EXPECT_NEAR(value(2), 0.5, 1e-3);
    EXPECT_NEAR(value(64), 0.5, 1e-3);
    EXPECT_NEAR(value(1e30f), 0.5, 1e-3);
    EXPECT_NEAR(value(INFINITY), 0.5, 1e-3);
}

TEST(TextureSampler, ALongFootprintKeepsDetailAcrossIt) {
    auto stripes = [](int x, int) { return x & 1 ? 0 : 255; };
    TexturePyramid pyramid(byte_image(64, 64, stripes), false);
    TextureQuery q = at(0.5f / 64, 0.5f);
    q.dsdx = 1.0f / 64;
    q.dtdy = 12.0f / 64;
    EXPECT_NEAR(look_up(pyramid, TextureName(), TextureFilter::Anisotropic, q)[0], 1, 1e-5);
    EXPECT_NEAR(look_up(pyramid, TextureName(), TextureFilter::Trilinear, q)[0], 0.5, 1e-3);
}

TEST(TextureSampler, AFilteredLookupIsNearTheMeanOfItsFootprint) {
    auto waves = [](int x, int y) {
        return 127.5 + 60 * std::sin(x * 2 * kPi / 64) + 60 * std::cos(y * 4 * kPi / 128);
    };
    TexturePyramid pyramid(byte_image(128, 128, waves), false);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(0, 1);
    for (int k = 0; k < 300; ++k) {
        TextureQuery q = at(uniform(random), uniform(random));
        float angle = 6.2831853f * uniform(random), along = 0.08f * uniform(random);
        float across = along * uniform(random);
        q.dsdx = along * std::cos(angle), q.dtdx = along * std::sin(angle);
        q.dsdy = -across * std::sin(angle), q.dtdy = across * std::cos(angle);
        double sum = 0;
        for (int i = 0; i < 16; ++i)
            for (int j = 0; j < 16; ++j) {
                double a = (i + 0.5) / 16 - 0.5, b = (j + 0.5) / 16 - 0.5;
                double x = (q.s + a * q.dsdx + b * q.dsdy) * 128 - 0.5;
                double y = (q.t + a * q.dtdx + b * q.dtdy) * 128 - 0.5;
                sum +=
                    (127.5 + 60 * std::sin(x * 2 * kPi / 64) + 60 * std::cos(y * 4 * kPi / 128)) /
                    255 / 256;
            }
        Rgba got = look_up(pyramid, TextureName(), TextureFilter::Anisotropic, q);
        ASSERT_NEAR(got[0], sum, 0.04) << q.s << " " << q.t;
    }
}

TEST(TextureSampler, BlurOfOneIsTheMeanOfTheImage) {
    TexturePyramid pyramid(byte_image(32, 16, [](int x, int y) { return (x * 7 + y * 5) & 255; }),
                           false);
    double mean = 0;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 32; ++x) mean += ((x * 7 + y * 5) & 255) / 255.0 / 512;
    TextureQuery q = at(0.3f, 0.7f);
    q.blur = 1;
    EXPECT_NEAR(look_up(pyramid, TextureName(), TextureFilter::Anisotropic, q)[0], mean, 1e-3);
}

TEST(TextureSampler, WidthScalesTheFootprint) {
    auto stripes = [](int x, int) { return x & 1 ? 0 : 255; };
    TexturePyramid pyramid(byte_image(64, 64, stripes), false);
    TextureQuery q = at(0.5f / 64, 0.5f);
    q.dsdx = q.dtdy = 8.0f / 64;
    q.swidth = q.twidth = 0;
    EXPECT_NEAR(look_up(pyramid, TextureName(), TextureFilter::Anisotropic, q)[0], 1, 1e-5);
}

TEST(TextureSampler, ExtremeCoordinatesWrapAndNanGivesTheFillColour) {
    TexturePyramid pyramid(float_image(16, 16), false);
    for (TextureWrap wrap : kWraps)
        for (float s : {1e9f, -1e9f, 3e38f, -3e38f, INFINITY, -INFINITY, 1e-40f, -1e-40f}) {
            TextureName modes;
            modes.wrap_s = modes.wrap_t = wrap;
            TextureQuery q = at(s, -s);
            q.dsdx = 1e30f;
            q.dtdy = NAN;
            for (float x : look_up(pyramid, modes, TextureFilter::Anisotropic, q))
                EXPECT_TRUE(x >= 0 && x <= 1) << int(wrap) << " " << s;
        }
    TextureQuery q = at(NAN, 0.5f);
    q.fill = 0.25f;
    EXPECT_EQ(look_up(pyramid, TextureName(), TextureFilter::Anisotropic, q),
              (Rgba{0.25f, 0.25f, 0.25f, 0.25f}));
}

TEST(TextureSampler, ResultsStartAtTheChannelAndEndInTheFillColour) {
    TextureImage image = float_image(1, 1);
    image.floats = {0.1f, 0.2f, 0.3f, 0.4f};
    TexturePyramid pyramid(image, false);
    TextureQuery q = at(0.5f, 0.5f);
    q.fill = 9;
    auto from = [&](float channel) {
        q.channel = channel;
        return look_up(pyramid, TextureName(), TextureFilter::Anisotropic, q);
    };
    EXPECT_EQ(from(0), (Rgba{0.1f, 0.2f, 0.3f, 0.4f}));
    EXPECT_EQ(from(2), (Rgba{0.3f, 0.4f, 9, 9}));
    EXPECT_EQ(from(3), (Rgba{0.4f, 9, 9, 9}));
    EXPECT_EQ(from(4), (Rgba{9, 9, 9, 9}));
    EXPECT_EQ(from(-1), (Rgba{9, 0.1f, 0.2f, 0.3f}));
    EXPECT_EQ(from(1e30f), (Rgba{9, 9, 9, 9}));
    image.colors = 2;
    TexturePyramid two(image, false);
    q.channel = 0;
    EXPECT_EQ(look_up(two, TextureName(), TextureFilter::Anisotropic, q),
              (Rgba{0.1f, 0.2f, 9, 0.4f}));
}

TEST(TexturePyramid, TheLastLevelIsTheMeanAtAnySize) {
    const int sizes[][2] = {{1, 1}, {3, 5}, {7, 13}, {100, 37}, {64, 1}, {1, 32768}};
    for (auto [width, height] : sizes) {
        TextureImage image = float_image(width, height);
        TexturePyramid pyramid(image, false);
        const TextureLevel& last = pyramid.levels.back();
        EXPECT_EQ(last.width, 1);
        EXPECT_EQ(last.height, 1);
        double mean = 0;
        for (size_t i = 0; i < image.floats.size(); i += 4) mean += image.floats[i];
        mean /= double(image.floats.size() / 4);
        EXPECT_NEAR(pyramid.texel(int(pyramid.levels.size()) - 1, 0, 0)[0], mean, 1e-5)
            << width << "x" << height;
    }
}

TEST(TexturePyramid, HalvesInLinearLight) {
    auto half_black = [](int x, int) { return x ? 255 : 0; };
    TexturePyramid pyramid(byte_image(2, 1, half_black), true);
    EXPECT_NEAR(pyramid.texel(1, 0, 0)[0], 0.5, 1e-6);
}

TEST(TexturePyramid, BytesSurviveTheHalfTexels) {
    for (bool srgb : {false, true}) {
        TexturePyramid pyramid(byte_image(256, 1, [](int x, int) { return x; }), srgb);
        for (int v = 0; v < 256; ++v) {
            double x = pyramid.texel(0, v, 0)[0];
            double encoded = !srgb            ? x
                             : x <= 0.0031308 ? 12.92 * x
                                              : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
            EXPECT_EQ(std::lround(encoded * 255), v);
        }
    }
}

TEST(TexturePyramid, NonFiniteTexelsDoNotSpread) {
    TextureImage image = float_image(4, 4);
    image.floats[0] = NAN;
    image.floats[5] = INFINITY;
    TexturePyramid pyramid(image, false);
    float4 last = pyramid.texel(2, 0, 0);
    for (int c = 0; c < 4; ++c) EXPECT_TRUE(std::isfinite(last[c]));
}

TEST(SrgbTable, FollowsTheStandard) {
    EXPECT_EQ(srgb_table()[0], 0.0f);
    EXPECT_EQ(srgb_table()[255], 1.0f);
    EXPECT_NEAR(srgb_table()[10], 10 / 255.0 / 12.92, 1e-9);  // the straight part
    EXPECT_NEAR(srgb_table()[128], 0.2158605, 1e-6);
    EXPECT_NEAR(srgb_table()[188], 0.5028865, 1e-6);
    for (int i = 1; i < 256; ++i) EXPECT_GT(srgb_table()[size_t(i)], srgb_table()[size_t(i) - 1]);
}

}  // namespace
}  // namespace kinora
