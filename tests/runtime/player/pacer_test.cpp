// tests/runtime/player/pacer_test.cpp: sizes by times that were recorded or made up.
#include "runtime/player/pace/pacer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "runtime/player/pace/patience.h"

namespace kinora {
namespace {

constexpr double kTarget = 33.3;

// Frames whose whole pictures cost that much; the steps' scales.
std::vector<double> scales(Pacer& pacer, const std::vector<double>& whole_ms, double fixed_ms = 0) {
    std::vector<double> out;
    for (double ms : whole_ms) {
        double scale = pacer.scale();
        out.push_back(scale);
        pacer.add(fixed_ms + ms * scale * scale);
    }
    return out;
}

int changes(const std::vector<double>& scales, size_t first) {
    int count = 0;
    for (size_t k = first + 1; k < scales.size(); ++k) count += scales[k] != scales[k - 1];
    return count;
}

Pacer pacer_at_target() {
    Pacer pacer;
    pacer.aim_at(kTarget);
    return pacer;
}

TEST(Pacer, KeepsAllPixelsWhereTheyFit) {
    Pacer pacer = pacer_at_target();
    for (double scale : scales(pacer, std::vector<double>(100, 30))) EXPECT_EQ(scale, 1);
}

TEST(Pacer, ASpikeOfOneAndAHalfChangesNothing) {
    Pacer pacer = pacer_at_target();
    std::vector<double> ms(100, 30);
    for (size_t k = 10; k < ms.size(); k += 7) ms[k] = 45;
    EXPECT_EQ(changes(scales(pacer, ms), 0), 0);
}

// The whole picture costs three times as much from one frame on.
TEST(Pacer, IsBackInTimeFourFramesAfterAStepOfThree) {
    Pacer pacer = pacer_at_target();
    std::vector<double> ms(20, 30);
    ms.resize(60, 90);
    std::vector<double> scale = scales(pacer, ms);
    for (size_t k = 24; k < 60; ++k) EXPECT_LE(90 * scale[k] * scale[k], kTarget) << k;
    EXPECT_GT(90 * scale[59] * scale[59], 0.5 * kTarget);  // no smaller than need be
}

TEST(Pacer, GrowsAgainWhenFramesBecomeCheap) {
    Pacer pacer = pacer_at_target();
    std::vector<double> ms(20, 90);
    ms.resize(200, 20);
    EXPECT_EQ(scales(pacer, ms).back(), 1);
}

TEST(Pacer, NeverSwingsUnderASteadyLoad) {
    for (double load : {20.0, 34.0, 40.0, 47.0, 60.0, 95.0, 140.0, 400.0, 3000.0})
        for (double fixed : {0.0, 8.0, 20.0}) {
            Pacer pacer = pacer_at_target();
            std::vector<double> scale = scales(pacer, std::vector<double>(1000, load), fixed);
            // After it has found its size: tries of a larger one become rare.
            EXPECT_LE(changes(scale, 40), 8) << load << " " << fixed;
        }
}

// Loads that jitter by a quarter, by a fixed generator: the size does not follow them.
TEST(Pacer, NeverSwingsUnderJitter) {
    Pacer pacer = pacer_at_target();
    uint32_t state = 1;
    std::vector<double> ms;
    for (int k = 0; k < 1000; ++k) {
        state = state * 1664525u + 1013904223u;
        ms.push_back(60 * (0.875 + 0.25 * (state >> 8) / double(1 << 24)));
    }
    EXPECT_LE(changes(scales(pacer, ms), 40), 8);
}

// A part of each frame costs the same whatever its size: what is left of the time goes to pixels.
TEST(Pacer, SpendsTheTimeThatItHas) {
    for (double fixed : {0.0, 8.0, 20.0})
        for (double whole : {40.0, 60.0, 75.0, 95.0, 140.0}) {
            Pacer pacer = pacer_at_target();
            double ms = 0;
            for (int k = 0; k < 600; ++k) {
                ms = fixed + whole * pacer.scale() * pacer.scale();
                pacer.add(ms, fixed);
            }
            EXPECT_LE(ms, kTarget) << fixed << " " << whole;
            // The next size has 2^(1/4) times the pixels.
            double larger = fixed + (ms - fixed) * std::exp2(0.25);
            EXPECT_GT(larger, 0.95 * kTarget) << fixed << " " << whole;
        }
}

// What small pictures need besides counts where they are small, and keeps none from becoming
// larger.
TEST(Pacer, CountsWhatSmallPicturesNeed) {
    constexpr double kGuide = 4;
    for (double fixed : {0.0, 8.0})
        for (double whole : {40.0, 60.0, 75.0, 95.0, 110.0, 125.0, 140.0, 200.0}) {
            Pacer pacer = pacer_at_target();
            const auto guide = [&] { return pacer.scale() < Pacer::kNeedsGuide ? kGuide : 0.0; };
            std::vector<double> scale;
            double ms = 0;
            for (int k = 0; k < 1000; ++k) {
                scale.push_back(pacer.scale());
                ms = fixed + guide() + whole * pacer.scale() * pacer.scale();
                pacer.add(ms, fixed, guide());
            }
            EXPECT_LE(ms, kTarget) << fixed << " " << whole;
            EXPECT_LE(changes(scale, 40), 8) << fixed << " " << whole;
            const double larger = pacer.scale() * std::exp2(0.125);
            const double more = larger < Pacer::kNeedsGuide - 1e-6 ? kGuide : 0;
            EXPECT_GT(fixed + more + whole * larger * larger, 0.95 * kTarget)
                << fixed << " " << whole;
        }
}

// A scene of which nothing is known: a picture soon, then all pixels, where even few fit.
TEST(Pacer, BeginsWithTheFewestPixels) {
    Pacer pacer = pacer_at_target();
    pacer.begin();
    std::vector<double> fast = scales(pacer, {60, 20, 20});
    EXPECT_EQ(fast, (std::vector<double>{0.25, 1, 1}));
    pacer.begin();
    std::vector<double> slow = scales(pacer, {1400, 1400, 1400});
    EXPECT_EQ(slow, (std::vector<double>{0.25, 0.25, 0.25}));
}

// Load from outside that makes everything eight times as slow for a while. That each frame takes
// 2 ms whatever its size is not told: the size is found in two steps.
TEST(Pacer, IsBackWithinFiveFramesAfterALoad) {
    Pacer pacer = pacer_at_target();
    std::vector<double> ms(60, 40);
    ms.resize(90, 320);
    ms.resize(200, 40);
    const std::vector<double> scale = scales(pacer, ms, 2);
    EXPECT_LE(scale[89], 0.36);
    for (size_t k = 95; k < 200; ++k) EXPECT_GE(scale[k], 0.8 * scale[59]) << k;
    for (size_t k = 115; k < 200; ++k) EXPECT_EQ(scale[k], scale[59]) << k;
    EXPECT_GT(scale[59], 0.8);
}

// A frame that nobody has waited for: the next one has a sixteenth of its pixels, and the size that
// holds the rate follows from its time.
TEST(Pacer, ACutFrameIsFollowedByASmallOne) {
    Pacer pacer = pacer_at_target();
    scales(pacer, std::vector<double>(20, 30));
    EXPECT_LT(pacer.limit(true), 250);
    EXPECT_GT(pacer.limit(true), 4 * kTarget);
    pacer.cut(pacer.limit(true));
    EXPECT_EQ(pacer.scale(), 0.25);
    const std::vector<double> slow = scales(pacer, std::vector<double>(20, 500));
    EXPECT_EQ(slow.back(), 0.25);  // 31 ms
    pacer.cut(pacer.limit(true));
    EXPECT_EQ(pacer.scale(), 1 / 16.0);
    EXPECT_TRUE(std::isinf(pacer.limit(false)));  // there is none that would be done sooner
    EXPECT_EQ(scales(pacer, std::vector<double>(20, 20)).back(), 1);
}

// A shader of which not even one pixel is ready: while the scene plays, each frame is let go in
// time, and after two seconds one may take as long as it needs.
TEST(Pacer, SomePictureComesEvenIfNoneIsInTime) {
    Pacer pacer = pacer_at_target();
    double waited = 0;
    int frames = 0;
    for (; std::isfinite(pacer.limit(true)); ++frames) {
        const double ms = pacer.limit(true);
        EXPECT_LT(ms, 250);
        pacer.cut(ms);
        waited += ms;
    }
    EXPECT_GE(waited, 2000);
    EXPECT_LT(waited, 2500);
    pacer.add(3000);
    EXPECT_TRUE(std::isfinite(pacer.limit(true)));
}

// Where the usual sizes take several times what they may, still smaller ones do not.
TEST(Pacer, IsStillSmallerWhereFewPixelsTakeLong) {
    for (double whole : {1000.0, 1500.0}) {
        Pacer pacer = pacer_at_target();
        EXPECT_EQ(scales(pacer, std::vector<double>(20, whole)).back(), 0.25) << whole;
    }
    for (double whole : {3000.0, 8000.0, 20000.0}) {
        Pacer pacer = pacer_at_target();
        const double scale = scales(pacer, std::vector<double>(20, whole)).back();
        EXPECT_LE(whole * scale * scale, 3 * kTarget) << whole;
        EXPECT_GT(whole * scale * scale, 1.8 * kTarget) << whole;
    }
    // What takes the time whatever the size is no reason to be smaller.
    Pacer pacer = pacer_at_target();
    double ms = 0;
    for (int k = 0; k < 100; ++k) {
        ms = 400 + 300 * pacer.scale() * pacer.scale();
        pacer.add(ms, 400);
    }
    EXPECT_EQ(pacer.scale(), 0.25);
}

TEST(Pacer, StopsAtItsSmallestSize) {
    Pacer pacer = pacer_at_target();
    EXPECT_EQ(scales(pacer, std::vector<double>(50, 1e5)).back(),
              Pacer::scale_of(Pacer::kSteps - 1));
}

// An orbit that never rests gets a picture of a scene that takes 3 s at its lowest resolution, and
// a shader that loops for ever holds no picture for longer than 7 s.
TEST(Patience, DoublesUntilAPictureIsWhole) {
    EXPECT_DOUBLE_EQ(patience_ms(30, 0), 50);
    EXPECT_DOUBLE_EQ(patience_ms(30, 1), 100);
    size_t ended = 0;
    while (patience_ms(30, ended) < 3000) ++ended;
    EXPECT_EQ(ended, 6u);
    EXPECT_LT(patience_ms(30, 1000), 7000);
    EXPECT_EQ(patience_ms(30, 1000), patience_ms(30, 100));
    EXPECT_GT(patience_ms(0, 0), 0);
}

}  // namespace
}  // namespace kinora
