// tests/runtime/picture/compare/errors_test.cpp: errors of pictures against arithmetic by hand and
// against what their definitions promise.
#include "runtime/picture/compare/errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "runtime/picture/compare/flip.h"

namespace kinora {
namespace {

constexpr int kWidth = 40, kHeight = 30;

struct Picture {
    std::vector<vec4> rgba;
    int width = kWidth, height = kHeight;
    PictureView view() const { return {width, height, rgba}; }
};

Picture constant(const vec3& color, float alpha = 1) {
    return {std::vector<vec4>(size_t(kWidth * kHeight), vec4(color, alpha))};
}

// Colours between 0 and 1 that vary over the picture, with an edge and noise on top.
Picture pattern(double noise = 0, unsigned seed = 1) {
    Picture picture = constant(vec3(0));
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            double base = 0.3 + 0.2 * std::sin(0.3 * x) + (x + y > 30 ? 0.25 : 0);
            vec4& c = picture.rgba[size_t(y * kWidth + x)];
            for (int k = 0; k < 3; ++k)
                c[k] = float(std::clamp(base * (0.6 + 0.2 * k) + noise * normal(random), 0.0, 1.0));
        }
    return picture;
}

TEST(Errors, OfEqualPicturesAreNone) {
    Picture p = pattern();
    PictureErrors e = picture_errors(p.view(), p.view());
    EXPECT_EQ(e.non_finite, 0u);
    EXPECT_EQ(e.mask_mismatch, 0);
    EXPECT_EQ(e.rmse, 0);
    EXPECT_EQ(e.relative_mse, 0);
    EXPECT_EQ(e.psnr, std::numeric_limits<double>::infinity());
    EXPECT_NEAR(e.ssim, 1, 1e-12);
    EXPECT_EQ(e.flip, 0);
    EXPECT_EQ(e.flip_p99, 0);
    EXPECT_EQ(e.hdr_flip, 0);
}

TEST(Errors, OfConstantsAreThoseByHand) {
    PictureErrors e = picture_errors(constant(vec3(0.75f)).view(), constant(vec3(0.5f)).view());
    EXPECT_NEAR(e.rmse, 0.25, 1e-12);
    EXPECT_NEAR(e.relative_mse, 0.0625 / 0.26, 1e-12);
    EXPECT_NEAR(e.max_error, 0.25, 1e-12);
    // sRGB of 0.75 is 0.880825, of 0.5 is 0.735357: 20 log10(1 / 0.145468) = 16.744 dB.
    EXPECT_NEAR(e.psnr, 16.744, 2e-3);
    // Without variance: (2ab + 0.0001) / (a^2 + b^2 + 0.0001).
    const double a = 0.880825, b = 0.735357;
    EXPECT_NEAR(e.ssim, (2 * a * b + 1e-4) / (a * a + b * b + 1e-4), 1e-6);
}

TEST(Errors, CountNonFiniteAndUncoveredPixels) {
    Picture p = constant(vec3(0.5f)), r = p;
    p.rgba[3].x = std::numeric_limits<float>::quiet_NaN();
    p.rgba[5].w = std::numeric_limits<float>::infinity();
    for (size_t i = 100; i < 112; ++i) p.rgba[i].w = 0;
    PictureErrors e = picture_errors(p.view(), r.view());
    EXPECT_EQ(e.non_finite, 2u);
    EXPECT_NEAR(e.mask_mismatch, 12.0 / (kWidth * kHeight), 1e-12);
    EXPECT_NEAR(e.rmse, std::sqrt(2 * 0.25 / (kWidth * kHeight)), 1e-12);
    EXPECT_TRUE(std::isfinite(e.flip) && std::isfinite(e.hdr_flip) && std::isfinite(e.ssim));
}

TEST(Errors, GrowWithNoise) {
    Picture clean = pattern();
    PictureErrors last;
    for (double noise : {0.01, 0.03, 0.1, 0.3}) {
        PictureErrors e = picture_errors(pattern(noise, 7).view(), clean.view());
        EXPECT_GT(e.rmse, last.rmse);
        EXPECT_GT(e.relative_mse, last.relative_mse);
        EXPECT_GT(e.flip, last.flip);
        EXPECT_GT(e.hdr_flip, last.hdr_flip);
        EXPECT_LT(e.ssim, last.ssim);
        last = e;
    }
}

// Section III.B of the 2004 paper, pixel by pixel: moments about the mean under an 11 by 11
// Gaussian of sigma 1.5 whose weights sum to 1.
double ssim_by_the_paper(const Plane& x, const Plane& y) {
    double all = 0;
    for (int py = 0; py < x.height; ++py)
        for (int px = 0; px < x.width; ++px) {
            auto sum = [&](auto&& value) {
                double total = 0, weights = 0;
                for (int dy = -5; dy <= 5; ++dy)
                    for (int dx = -5; dx <= 5; ++dx) {
                        const double w = std::exp(-(dx * dx + dy * dy) / 4.5);
                        const int at_x = std::clamp(px + dx, 0, x.width - 1);
                        const int at_y = std::clamp(py + dy, 0, x.height - 1);
                        total += w * value(size_t(at_y * x.width + at_x));
                        weights += w;
                    }
                return total / weights;
            };
            const double mx = sum([&](size_t i) { return x[i]; });
            const double my = sum([&](size_t i) { return y[i]; });
            const double sx = sum([&](size_t i) { return (x[i] - mx) * (x[i] - mx); });
            const double sy = sum([&](size_t i) { return (y[i] - my) * (y[i] - my); });
            const double sxy = sum([&](size_t i) { return (x[i] - mx) * (y[i] - my); });
            all += (2 * mx * my + 1e-4) * (2 * sxy + 9e-4) /
                   ((mx * mx + my * my + 1e-4) * (sx + sy + 9e-4));
        }
    return all / double(x.size());
}

TEST(Ssim, IsThePapers) {
    const Plane a = encoded_luma(pattern(0.1, 3).view()), b = encoded_luma(pattern().view());
    EXPECT_NEAR(ssim(a, b), ssim_by_the_paper(a, b), 1e-9);
    EXPECT_LT(ssim(a, b), 0.95);
}

// Its three conditions: symmetry, at most 1, and 1 for equal pictures alone. Of a negative, whose
// structure is the opposite, it is negative.
TEST(Ssim, KeepsThePapersConditions) {
    const Plane a = encoded_luma(pattern(0.2, 3).view()), b = encoded_luma(pattern(0.2, 4).view());
    EXPECT_DOUBLE_EQ(ssim(a, b), ssim(b, a));
    EXPECT_LT(ssim(a, b), 1);
    EXPECT_NEAR(ssim(a, a), 1, 1e-12);
    Plane noise = a, negative = a;
    for (size_t i = 0; i < a.size(); ++i) {
        noise[i] = 0.5 + 0.2 * ((i * 2654435761u >> 7) % 2 ? 1 : -1);
        negative[i] = 1 - noise[i];
    }
    EXPECT_LT(ssim(noise, negative), -0.5);
}

TEST(Percentile, IsTheValueThatAShareDoesNotExceed) {
    std::vector<double> values;
    for (int i = 100; i >= 1; --i) values.push_back(i);
    EXPECT_EQ(percentile(values, 0.99), 99);
    EXPECT_EQ(percentile(values, 1), 100);
    EXPECT_EQ(percentile(values, 0), 1);
    EXPECT_EQ(percentile({}, 0.5), 0);
}

// 3840 pixels on 0.7 m seen from 0.7 m: the 67 pixels per degree of the paper, section 4.
TEST(Flip, SeesThePapersPixelsPerDegree) {
    EXPECT_NEAR(flip_pixels_per_degree(), 67.02, 0.01);
}

// CIE Lab (D65) of the primaries: green 87.735, -86.183, 83.180; blue 32.30, 79.19, -107.86. With
// 0.01 L: -75.61, 72.98 and 25.58, -34.84. Their distance is 55.43 + |(101.19, 107.82)| = 203.3,
// and 203.3^0.7 = 41.28.
TEST(Flip, LargestColorErrorIsThatOfGreenAndBlue) {
    dvec3 green = hunt_lab({0, 1, 0}), blue = hunt_lab({0, 0, 1});
    EXPECT_NEAR(green.x, 87.735, 0.01);
    EXPECT_NEAR(green.y, -75.61, 0.03);
    EXPECT_NEAR(blue.z, -34.84, 0.03);
    EXPECT_NEAR(hyab(green, blue), 203.3, 0.1);
    EXPECT_NEAR(flip_largest_color_error(), 41.28, 0.02);
    EXPECT_NEAR(mean(ldr_flip(constant({0, 1, 0}).view(), constant({0, 0, 1}).view())), 1, 1e-9);
}

// Black and white: HyAB is 100, 100^0.7 = 25.119 and 0.4 * 41.28 = 16.51 is past the bend:
// 0.95 + (25.119 - 16.51) / (41.28 - 16.51) * 0.05 = 0.9674.
TEST(Flip, OfConstantsIsThatByHand) {
    EXPECT_NEAR(mean(ldr_flip(constant(vec3(1)).view(), constant(vec3(0)).view())), 0.9674, 2e-4);
    // Below the bend: L of 0.2 is 51.837, of 0.25 is 57.075: 5.238^0.7 * 0.95 / 16.51 = 0.1834.
    EXPECT_NEAR(mean(ldr_flip(constant(vec3(0.25f)).view(), constant(vec3(0.2f)).view())), 0.1834,
                1e-3);
}

TEST(Flip, IsSymmetricAndFrom0To1) {
    Picture a = pattern(0.2, 3), b = pattern(0.05, 4);
    Plane ab = ldr_flip(a.view(), b.view()), ba = ldr_flip(b.view(), a.view());
    for (size_t i = 0; i < ab.size(); ++i) {
        EXPECT_DOUBLE_EQ(ab[i], ba[i]);
        EXPECT_GE(ab[i], 0);
        EXPECT_LE(ab[i], 1);
    }
    EXPECT_GT(mean(ab), 0.01);
}

// From further away, details are seen less.
TEST(Flip, OfNoiseFallsWithDistance) {
    Picture a = pattern(0.1, 3), b = pattern();
    EXPECT_LT(mean(ldr_flip(a.view(), b.view(), 134)), mean(ldr_flip(a.view(), b.view(), 67)));
}

// An edge that is missing costs more than a shade of the same size without one.
TEST(Flip, WeighsEdges) {
    Picture flat = constant(vec3(0.5f)), edge = flat, shade = constant(vec3(0.55f));
    for (int y = 0; y < kHeight; ++y)
        for (int x = kWidth / 2; x < kWidth; ++x)
            edge.rgba[size_t(y * kWidth + x)] = vec4(0.55f, 0.55f, 0.55f, 1);
    Plane missing = ldr_flip(edge.view(), flat.view()),
          shaded = ldr_flip(shade.view(), flat.view());
    const size_t beside = size_t(kHeight / 2 * kWidth + kWidth / 2);
    EXPECT_GT(missing[beside], shaded[beside]);
    EXPECT_LT(missing[0], 1e-9);
}

TEST(HdrFlip, ExposuresSpanTheReference) {
    Picture p = constant(vec3(0.5f));
    FlipExposures e = flip_exposures(p.view());
    EXPECT_EQ(e.count, 2);
    EXPECT_NEAR(e.first, e.last, 1e-9);
    p.rgba[0] = vec4(512, 512, 512, 1);  // 10 stops above the median
    e = flip_exposures(p.view());
    EXPECT_NEAR(e.last - e.first, 10, 1e-6);
    EXPECT_EQ(e.count, 10);
}

// Scaling both pictures changes the exposures and nothing else.
TEST(HdrFlip, DoesNotDependOnTheScale) {
    Picture a = pattern(0.1, 3), b = pattern();
    double before = mean(hdr_flip(a.view(), b.view()));
    for (vec4& c : a.rgba) c = vec4(vec3(c) * 1024.0f, c.w);
    for (vec4& c : b.rgba) c = vec4(vec3(c) * 1024.0f, c.w);
    EXPECT_NEAR(mean(hdr_flip(a.view(), b.view())), before, 1e-6);
    EXPECT_GT(before, 0.01);
}

// ACES as the 2021 paper has it, by hand: (0.9036 x^2 + 0.018 x) / (0.8748 x^2 + 0.354 x + 0.14).
TEST(HdrFlip, IsAtLeastTheFlipAtEachExposure) {
    Picture a = pattern(0.1, 3), b = pattern();
    for (Picture* p : {&a, &b})
        for (size_t i = 0; i < p->rgba.size(); i += 7) p->rgba[i] *= 8.0f;
    const FlipExposures exposures = flip_exposures(b.view());
    const Plane whole = hdr_flip(a.view(), b.view());
    Plane most(whole.width, whole.height);
    for (int e = 0; e < exposures.count; ++e) {
        Picture shown[2] = {a, b};
        for (Picture& p : shown)
            for (vec4& c : p.rgba)
                for (int k = 0; k < 3; ++k) {
                    const double x = std::exp2(exposures.at(e)) * double(c[k]);
                    c[k] = float(std::clamp(
                        (0.9036 * x * x + 0.018 * x) / (0.8748 * x * x + 0.354 * x + 0.14), 0.0,
                        1.0));
                }
        const Plane ldr = ldr_flip(shown[0].view(), shown[1].view());
        for (size_t i = 0; i < ldr.size(); ++i) most[i] = std::max(most[i], ldr[i]);
    }
    for (size_t i = 0; i < whole.size(); ++i) EXPECT_NEAR(whole[i], most[i], 1e-5);
    EXPECT_GT(exposures.count, 2);
}

// Differences above 1 are clamped by the one and seen by the other.
TEST(HdrFlip, SeesWhatIsBrighterThanWhite) {
    Picture a = constant(vec3(8)), b = constant(vec3(4));
    EXPECT_EQ(mean(ldr_flip(a.view(), b.view())), 0);
    EXPECT_GT(mean(hdr_flip(a.view(), b.view())), 0.05);
}

}  // namespace
}  // namespace kinora
