// tests/runtime/scene/images/latlong/kernels_test.cpp: directions and places sixteen at a time
// against their definitions in double precision; all instruction sets give the same bits.
#include "runtime/scene/images/latlong/kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <span>

namespace kinora {
namespace {

constexpr int kLanes = kLatlongLanes;
constexpr double kPiHere = 3.141592653589793;

std::span<const LatlongKernels* const> all_kernels() {
    const UsableKernels<LatlongKernels>& usable = usable_latlong_kernels();
    return {usable.kernels, usable.count};
}

struct Directions {
    alignas(64) float of[9 * kLanes];
    float at(int k, int i) const { return of[k * kLanes + i]; }
};
Directions random_directions(std::mt19937& random) {
    std::normal_distribution<float> normal;
    Directions d;
    for (float& x : d.of) x = normal(random);
    return d;
}

TEST(LatlongKernels, PlacesFollowTheDefinition) {
    std::mt19937 random(5);
    for (int k = 0; k < 1000; ++k) {
        const Directions d = random_directions(random);
        LatlongPlaces at;
        latlong_kernels().footprints(d.of, at);
        for (int i = 0; i < kLanes; ++i) {
            const double x = double(d.at(0, i)), y = double(d.at(1, i)), z = double(d.at(2, i));
            const double out = std::hypot(x, z), length = std::hypot(out, y);
            ASSERT_EQ(at.usable[i], 1u);
            ASSERT_NEAR(at.s[i], std::atan2(-x, z) / (2 * kPiHere) + 0.5, 2e-7);
            ASSERT_NEAR(at.t[i], std::atan2(y, out) / kPiHere + 0.5, 2e-7);
            ASSERT_NEAR(at.around[i], out / length, 3e-7);
            double widest = 0;
            for (int axis : {3, 6})
                widest =
                    std::max(widest, std::hypot(double(d.at(axis, i)), double(d.at(axis + 1, i)),
                                                double(d.at(axis + 2, i))));
            const double dt = widest / length / kPiHere;
            ASSERT_NEAR(at.dt[i], dt, 1e-6 * dt);
            ASSERT_NEAR(at.ds[i], std::min(dt / 2 / std::max(out / length, 1e-4), 1.0), 1e-5);
        }
    }
}

TEST(LatlongKernels, WhatIsNoDirectionIsNotUsable) {
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(), kInfinity = HUGE_VALF;
    const float bad[][3] = {{0, 0, 0},         {kNaN, 1, 1},       {1, kNaN, 1},  {1, 1, kNaN},
                            {kInfinity, 0, 1}, {0, -kInfinity, 1}, {1e-44f, 0, 0}};
    for (const auto& row : bad) {
        Directions d{};
        for (int i = 0; i < kLanes; ++i) d.of[2 * kLanes + i] = 1;
        for (int k = 0; k < 3; ++k) d.of[k * kLanes + 5] = row[k];
        for (const LatlongKernels* kernels : all_kernels()) {
            LatlongPlaces at;
            kernels->places(d.of, at);
            for (int i = 0; i < kLanes; ++i)
                EXPECT_EQ(at.usable[i], i == 5 ? 0u : 1u) << kernels->name << ' ' << row[0];
        }
    }
}

// Back from the places of directions, also of the poles and of the picture's edges.
TEST(LatlongKernels, DirectionsFollowTheDefinition) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> uniform;
    for (int k = 0; k < 1000; ++k) {
        alignas(64) double s[kLanes], v[kLanes];
        for (int i = 0; i < kLanes; ++i) s[i] = uniform(random), v[i] = uniform(random);
        s[0] = 0, s[1] = 1, v[2] = 0, v[3] = 1, v[4] = 1e-9, v[5] = 1 - 1e-9;
        alignas(64) float d[3 * kLanes], around[kLanes];
        latlong_kernels().directions(s, v, d, around);
        for (int i = 0; i < kLanes; ++i) {
            const double theta = kPiHere * v[i], phi = 2 * kPiHere * (s[i] - 0.5);
            ASSERT_NEAR(d[i], -std::sin(theta) * std::sin(phi), 1e-7);
            ASSERT_NEAR(d[kLanes + i], std::cos(theta), 1e-7);
            ASSERT_NEAR(d[2 * kLanes + i], std::sin(theta) * std::cos(phi), 1e-7);
            ASSERT_NEAR(around[i], std::sin(theta), 1e-7 * std::sin(theta) + 1e-15);
        }
    }
}

TEST(LatlongKernels, AllInstructionSetsGiveTheSameBits) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform;
    for (int k = 0; k < 1000; ++k) {
        const Directions d = random_directions(random);
        alignas(64) double s[kLanes], v[kLanes];
        for (int i = 0; i < kLanes; ++i) s[i] = uniform(random), v[i] = uniform(random);
        LatlongPlaces first{};
        alignas(64) float first_back[3 * kLanes], first_around[kLanes];
        for (const LatlongKernels* kernels : all_kernels()) {
            LatlongPlaces at{};
            alignas(64) float back[3 * kLanes], around[kLanes];
            kernels->footprints(d.of, at);
            kernels->directions(s, v, back, around);
            if (kernels == all_kernels()[0]) {
                first = at;
                std::copy_n(back, 3 * kLanes, first_back);
                std::copy_n(around, kLanes, first_around);
            }
            ASSERT_EQ(std::memcmp(&at, &first, sizeof(at)), 0) << kernels->name;
            ASSERT_EQ(std::memcmp(back, first_back, sizeof(back)), 0) << kernels->name;
            ASSERT_EQ(std::memcmp(around, first_around, sizeof(around)), 0) << kernels->name;
        }
    }
}

}  // namespace
}  // namespace kinora
