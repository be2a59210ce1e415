// tests/jit/noise_test.cpp: noise against its reference, and its quality.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/jit/math_harness.h"

namespace kinora::jit {
namespace {

using testing::MathKernel;
using testing::Samples;

using Columns = std::vector<std::vector<float>>;

MathKernel noise_kernel(int dimensions, int components, bool periodic) {
    return MathKernel(periodic ? 2 * dimensions : dimensions,
                      [=](Builder& b, std::span<const Value> in) {
                          auto n = size_t(dimensions);
                          return math::noise(b, b.m(true), in.first(n), components, in.subspan(n));
                      });
}

Columns random_points(int columns, int count, float range) {
    Samples s;
    Columns c(static_cast<size_t>(columns), std::vector<float>(static_cast<size_t>(count)));
    for (auto& column : c)
        for (float& x : column) x = s.uniform(-range, range);
    return c;
}

// Largest difference from the reference in double.
double worst_difference(const Columns& in, const Columns& out, int dimensions, bool periodic) {
    double worst = 0;
    for (size_t i = 0; i < in[0].size(); ++i) {
        double p[4], period[4], expected[3];
        for (int d = 0; d < dimensions; ++d) {
            p[d] = double(in[size_t(d)][i]);
            if (periodic) period[d] = double(in[size_t(dimensions + d)][i]);
        }
        math::noise_reference(p, dimensions, int(out.size()), periodic ? period : nullptr,
                              expected);
        for (size_t k = 0; k < out.size(); ++k)
            worst = std::max(worst, std::fabs(double(out[k][i]) - expected[k]));
    }
    return worst;
}

struct Form {
    int dimensions, components;
    bool periodic;
};
class NoiseForms : public ::testing::TestWithParam<Form> {};

TEST_P(NoiseForms, EqualsTheReference) {
    Form f = GetParam();
    MathKernel kernel = noise_kernel(f.dimensions, f.components, f.periodic);
    ASSERT_EQ(kernel.fault(), "");
    Columns in = random_points(f.periodic ? 2 * f.dimensions : f.dimensions, 20'000, 40);
    EXPECT_LT(worst_difference(in, kernel.run(in), f.dimensions, f.periodic), 2e-6);
    std::printf("noise %d-D, %d component(s)%s: %d instructions\n", f.dimensions, f.components,
                f.periodic ? ", periodic" : "", kernel.instructions());
}

std::vector<Form> all_forms() {
    std::vector<Form> forms;
    for (int d = 1; d <= 4; ++d)
        for (int components : {1, 3})
            for (bool periodic : {false, true}) forms.push_back({d, components, periodic});
    return forms;
}
INSTANTIATE_TEST_SUITE_P(All, NoiseForms, ::testing::ValuesIn(all_forms()));

TEST(Noise, IsAHalfOnTheLattice) {
    Columns in(3);
    for (int i = -50; i < 50; ++i)
        for (auto& c : in) c.push_back(float(i * 3));
    Columns out = noise_kernel(3, 1, false).run(in);
    for (float value : out[0]) EXPECT_EQ(value, 0.5f);
}

// docs/numerics.md#noise
TEST(Noise, IsFiniteForAnyCoordinate) {
    std::vector<float> edges = testing::edge_values();
    Columns in(3);
    for (float x : edges)
        for (float y : edges) in[0].push_back(x), in[1].push_back(y), in[2].push_back(0.3f);
    Columns out = noise_kernel(3, 3, false).run(in);
    Columns any_period = noise_kernel(1, 1, true).run({in[0], in[1]});
    out.push_back(any_period[0]);
    for (auto& column : out)
        for (float value : column) EXPECT_TRUE(value >= 0 && value <= 1);
}

// docs/numerics.md#noise: a period below 1 is 1.
TEST(Noise, RepeatsWithItsPeriod) {
    MathKernel kernel = noise_kernel(2, 1, true);
    Columns in = random_points(2, 5000, 50), shifted = in;
    for (float& x : shifted[0]) x += 7;
    for (float& y : shifted[1]) y -= 3;
    for (Columns* c : {&in, &shifted}) {
        c->push_back(std::vector<float>(5000, 7));
        c->push_back(std::vector<float>(5000, 0));
    }
    std::vector<float> a = kernel.run(in)[0], b = kernel.run(shifted)[0];
    for (size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 4e-5);
}

TEST(Noise, HugePeriodsAndCellsWrapExactly) {
    Columns in(2);
    for (float x : {-0.25f, -1e6f - 0.5f, 123456.5f, 8388607.5f})
        for (float period : {1e9f, 16777217.0f, 3.0f, 1e20f, 0.0f, 7.9f})
            in[0].push_back(x), in[1].push_back(period);
    EXPECT_LT(worst_difference(in, noise_kernel(1, 1, true).run(in), 1, true), 2e-6);
}

struct Moments {
    double mean, deviation, lowest, highest;
};
Moments moments(const std::vector<float>& values) {
    double sum = 0, squares = 0, lo = 1, hi = 0;
    for (double v : values) {
        sum += v, squares += v * v;
        lo = std::min(lo, v), hi = std::max(hi, v);
    }
    double n = double(values.size());
    return {sum / n, std::sqrt(squares / n - sum / n * sum / n), lo, hi};
}

TEST(NoiseQuality, IsSpreadAroundAHalf) {
    for (int d = 1; d <= 4; ++d) {
        Moments m = moments(noise_kernel(d, 1, false).run(random_points(d, 400'000, 300))[0]);
        std::printf("%d-D: mean %.4f deviation %.4f range %.3f .. %.3f\n", d, m.mean, m.deviation,
                    m.lowest, m.highest);
        EXPECT_NEAR(m.mean, 0.5, 0.01);
        EXPECT_GT(m.deviation, 0.11);
        EXPECT_LT(m.deviation, 0.13);
        EXPECT_LT(m.lowest, 0.15);
        EXPECT_GT(m.highest, 0.85);
    }
}

double correlation(const std::vector<float>& a, const std::vector<float>& b) {
    Moments ma = moments(a), mb = moments(b);
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i) sum += (a[i] - ma.mean) * (b[i] - mb.mean);
    return sum / double(a.size()) / (ma.deviation * mb.deviation);
}

// Points in the middle of cells see eight gradients; those two cells away share none.
TEST(NoiseQuality, DistantCellsAreIndependent) {
    MathKernel kernel = noise_kernel(3, 1, false);
    constexpr int kSide = 32;
    for (int axis = 0; axis < 3; ++axis) {
        Columns in(3), moved(3);
        for (int i = 0; i < kSide * kSide * kSide; ++i) {
            int cell[3] = {i % kSide, i / kSide % kSide, i / kSide / kSide};
            for (size_t d = 0; d < 3; ++d) {
                in[d].push_back(float(cell[d]) - 16 + 0.5f);
                moved[d].push_back(in[d].back() + (int(d) == axis ? 2.0f : 0.0f));
            }
        }
        EXPECT_LT(std::fabs(correlation(kernel.run(in)[0], kernel.run(moved)[0])), 0.03);
    }
}

TEST(NoiseQuality, ComponentsAreIndependent) {
    Columns out = noise_kernel(3, 3, false).run(random_points(3, 200'000, 200));
    EXPECT_LT(std::fabs(correlation(out[0], out[1])), 0.03);
    EXPECT_LT(std::fabs(correlation(out[0], out[2])), 0.03);
    EXPECT_LT(std::fabs(correlation(out[1], out[2])), 0.03);
}

// The plain product h C repeats every 25 cells along an axis; this shows no such lag up to 1000.
TEST(NoiseQuality, HasNoPeriodAlongAnAxis) {
    MathKernel kernel = noise_kernel(3, 1, false);
    for (size_t axis = 0; axis < 3; ++axis) {
        Columns in(3);
        for (int i = -2500; i < 2500; ++i)
            for (size_t d = 0; d < 3; ++d)
                in[d].push_back(d == axis ? float(i) + 0.5f : 3.25f + float(d));
        std::vector<float> v = kernel.run(in)[0];
        double worst = 0;
        for (size_t lag = 2; lag <= 1000; ++lag) {
            std::vector<float> a(v.begin(), v.end() - long(lag)), b(v.begin() + long(lag), v.end());
            worst = std::max(worst, std::fabs(correlation(a, b)));
        }
        std::printf("axis %zu: largest correlation at lags 2 to 1000: %.3f\n", axis, worst);
        EXPECT_LT(worst, 0.12);
    }
}

TEST(CellNoise, EqualsTheReferenceAndIsConstantOnCells) {
    for (int d = 1; d <= 4; ++d) {
        MathKernel kernel(
            d, [](Builder& b, std::span<const Value> in) { return math::cellnoise(b, in, 3); });
        Columns in = random_points(d, 10'000, 100);
        in[0][0] = -0.5f, in[0][1] = -0.0f, in[0][2] = 0.0f;  // docs/numerics.md#noise
        for (size_t k = 1; k < size_t(d); ++k) in[k][0] = in[k][1] = in[k][2] = 0.5f;
        Columns out = kernel.run(in);
        for (size_t i = 0; i < in[0].size(); ++i) {
            float p[4], expected[3];
            for (size_t k = 0; k < size_t(d); ++k) p[k] = in[k][i];
            math::cellnoise_reference(p, d, 3, expected);
            for (size_t k = 0; k < 3; ++k) EXPECT_EQ(out[k][i], expected[k]);
        }
        EXPECT_NE(out[0][0], out[0][1]);
        EXPECT_EQ(out[0][1], out[0][2]);
        EXPECT_NEAR(moments(out[0]).mean, 0.5, 0.02);
        EXPECT_NEAR(moments(out[1]).deviation, std::sqrt(1.0 / 12), 0.02);
    }
}

// Flipping any bit of a key flips each bit of the result half of the time.
TEST(Hash01, EveryKeyBitReachesEveryResultBit) {
    Samples s;
    double worst = 0;
    for (int bit = 0; bit < 32; ++bit) {
        int flips[24] = {};
        constexpr int kTrials = 4000;
        for (int i = 0; i < kTrials; ++i) {
            int32_t keys[2] = {int32_t(s.next()), int32_t(s.next())};
            auto a = uint32_t(math::hash01_reference(keys) * 0x1p24f);
            keys[1] ^= int32_t(1u << bit);
            auto b = uint32_t(math::hash01_reference(keys) * 0x1p24f);
            for (int j = 0; j < 24; ++j) flips[j] += (a ^ b) >> j & 1;
        }
        for (int f : flips) worst = std::max(worst, std::fabs(f / double(kTrials) - 0.5));
    }
    EXPECT_LT(worst, 0.06);
}

TEST(Hash01, EqualsTheReference) {
    MathKernel kernel(2, [](Builder& b, std::span<const Value> in) {
        Value keys[] = {b.bits(in[0]), b.bits(in[1])};
        return std::vector<Value>{math::hash01(b, keys)};
    });
    Columns in = random_points(2, 1000, 1e6f);
    std::vector<float> out = kernel.run(in)[0];
    for (size_t i = 0; i < out.size(); ++i) {
        int32_t keys[] = {bits_of(in[0][i]), bits_of(in[1][i])};
        EXPECT_EQ(out[i], math::hash01_reference(keys));
    }
}

}  // namespace
}  // namespace kinora::jit
