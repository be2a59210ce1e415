// tests/raytrace/pixels/pixels_test.cpp: samples, camera rays and sums against the definitions, in
// long double, by every kernel that this CPU runs.
#include "raytrace/pixels/pixels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

namespace kinora::raytrace::test {
namespace {

using Real = long double;

// ---- the definitions ----------------------------------------------------------------------------

// C. Wellons, "lowbias32".
uint32_t lowbias32(uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}
uint32_t hash_of(uint32_t a, uint32_t b) {
    return lowbias32(a ^ (lowbias32(b) + 0x9e3779b9u));
}

uint32_t reversed(uint32_t x) {
    uint32_t y = 0;
    for (int i = 0; i < 32; ++i) y |= (x >> i & 1) << (31 - i);
    return y;
}

// Bit 31 - j of the second coordinate: the parity of binomial(k, j) over the bits k of the index.
uint32_t sobol_by_pascal(uint32_t index) {
    std::vector<std::vector<int>> odd(33, std::vector<int>(33, 0));
    for (size_t k = 0; k <= 32; ++k)
        for (size_t j = 0; j <= k; ++j)
            odd[k][j] = j == 0 || j == k ? 1 : odd[k - 1][j - 1] ^ odd[k - 1][j];
    uint32_t result = 0;
    for (size_t j = 0; j < 32; ++j) {
        int parity = 0;
        for (size_t k = 0; k < 32; ++k) parity ^= int(index >> k & 1) & odd[k][j];
        result |= uint32_t(parity) << (31 - j);
    }
    return result;
}

// N. Vegdahl's constants for the hash of Laine and Karras, on reversed bits.
uint32_t owen(uint32_t x, uint32_t seed) {
    x = reversed(x);
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return reversed(x);
}

struct Sample {
    uint32_t u, v;
};
Sample sample_of(uint32_t x, uint32_t y, uint32_t seed, uint32_t index) {
    const uint32_t own = hash_of(hash_of(x, y), seed);
    return {owen(reversed(index), hash_of(own, 0x68bc21ebu)),
            owen(sobol_by_pascal(index), hash_of(own, 0x02e5be93u))};
}

Real offset_of(const FilterTable& filter, uint32_t bits) {
    const Real at = Real(bits) / 4294967296.0L * kFilterCells;
    const size_t cell = size_t(at);
    return Real(filter.cells[cell].value) + Real(filter.cells[cell].step) * (at - Real(cell));
}

// ---- views, filters, pixels ---------------------------------------------------------------------

PixelView make_view(double fov_degrees, int width, int height, bool orthographic = false,
                    double turn = 0.7) {
    PixelView view{};
    view.orthographic = orthographic;
    view.centre_x = 0.5 * width;
    view.centre_y = 0.5 * height;
    view.znear = 0.25;
    view.zfar = 1234.5;
    const double half = std::tan(fov_degrees * (3.14159265358979323846 / 360));
    const double pixel = 2 * half / width;
    const double c = std::cos(turn), s = std::sin(turn);
    const double right[3] = {c, 0, -s}, up[3] = {s * s, c, c * s}, forward[3] = {s * c, -s, c * c};
    for (int k = 0; k < 3; ++k) {
        view.eye[k] = 3.0 - 2.5 * k;
        view.forward[k] = forward[k];
        view.dx[k] = right[k] * pixel;
        view.dy[k] = -up[k] * pixel;
        view.dx_square += view.dx[k] * view.dx[k];
        view.dy_square += view.dy[k] * view.dy[k];
    }
    return view;
}

FilterTable make_filter(bool linear) {
    FilterTable filter{};
    filter.linear = linear;
    auto at = [&](uint32_t i) {
        const double x = 2.0 * i / kFilterCells - 1;
        return linear ? x * 0.75 : std::copysign(x * x, x);
    };
    for (uint32_t i = 0; i < kFilterCells; ++i) filter.cells[i] = {at(i), at(i + 1) - at(i)};
    return filter;
}

struct Pixels {
    std::vector<uint32_t> x, y, scramble[2];
    PixelSet set{};
    Pixels(size_t count, uint32_t width) {
        for (uint32_t i = 0; i < count; ++i) x.push_back(i % width), y.push_back(i / width);
        for (auto& s : scramble) s.assign(count, 0);
        set = {count, 128, 64, x.data(), y.data(), {scramble[0].data(), scramble[1].data()}};
    }
};

// Columns with a value behind their end that must stay.
constexpr float kUntouched = -77;
struct Rays {
    size_t count;
    std::vector<std::vector<float>> columns;
    std::vector<uint32_t> x, y, sample;
    PixelRays to{};
    explicit Rays(size_t n)
        : count(n),
          columns(17, std::vector<float>(n + 16, kUntouched)),
          x(n + 16),
          y(n + 16),
          sample(n + 16) {
        size_t next = 0;
        for (auto* triple : {&to.org, &to.first_org, &to.dir, &to.ddir_dx, &to.ddir_dy})
            for (float*& column : *triple) column = columns[next++].data();
        to.tnear = columns[next++].data();
        to.tfar = columns[next++].data();
        to.pixel_x = x.data();
        to.pixel_y = y.data();
        to.sample = sample.data();
    }
};

class EachKernel : public testing::TestWithParam<size_t> {
  protected:
    const PixelKernels& kernels() const { return *usable_pixel_kernels().kernels[GetParam()]; }
};
INSTANTIATE_TEST_SUITE_P(All, EachKernel, testing::Range<size_t>(0, usable_pixel_kernels().count),
                         [](const auto& kernel) {
                             return std::string(usable_pixel_kernels().kernels[kernel.param]->name);
                         });

// The float nearest to the true value, or its neighbour where rounding twice matters.
void expect_nearest(float value, Real truth, Real scale, const char* what) {
    const float nearest = float(truth);
    if (value == nearest) return;
    EXPECT_LE(std::abs(Real(value) - truth), std::abs(Real(nearest) - truth) + scale * 1e-14L)
        << what << ' ' << value << ' ' << double(truth);
}

// ---- tests --------------------------------------------------------------------------------------

TEST(SampleBits, AreThoseOfSobolsFirstTwoDimensionsReversed) {
    for (uint32_t i = 0; i < 5000; ++i) {
        EXPECT_EQ(sample_bits(i).index, i);
        EXPECT_EQ(sample_bits(i).sobol_reversed, reversed(sobol_by_pascal(i)));
    }
    for (uint32_t i : {0x7fffffffu, 0x80000000u, 0xffffffffu})
        EXPECT_EQ(sample_bits(i).sobol_reversed, reversed(sobol_by_pascal(i)));
}

// An orthographic camera of unit pixels shows where its samples lie.
TEST_P(EachKernel, SamplesLieWhereTheSequenceAndTheFilterPutThem) {
    PixelView view{};
    view.orthographic = true;
    view.dx[0] = view.dy[1] = view.forward[2] = view.dx_square = view.dy_square = 1;
    for (bool linear : {true, false}) {
        const FilterTable filter = make_filter(linear);
        for (uint32_t n : {1u, 2u, 3u, 4u, 16u, 31u, 64u, 65u, 150u}) {
            const uint32_t begin = n == 1 ? 12345u : 3 * n;
            Pixels pixels(50, 9);
            Rays rays(50 * n);
            const uint32_t seed = 0xabcdef01u + n;
            std::vector<SampleBits> samples;
            for (uint32_t s = 0; s < n; ++s) samples.push_back(sample_bits(begin + s));
            kernels().scrambles(pixels.set, seed);
            kernels().rays(view, pixels.set, samples.data(), n, &filter, rays.to);
            for (size_t i = 0; i < 50 * n; ++i) {
                const uint32_t x = 128 + pixels.x[i / n], y = 64 + pixels.y[i / n];
                const uint32_t index = begin + uint32_t(i % n);
                const Sample s = sample_of(x, y, seed, index);
                EXPECT_EQ(rays.sample[i], index);
                expect_nearest(rays.to.org[0][i], x + 0.5L + offset_of(filter, s.u), 128, "x");
                expect_nearest(rays.to.org[1][i], y + 0.5L + offset_of(filter, s.v), 128, "y");
                EXPECT_EQ(rays.to.first_org[0][i], rays.to.org[0][i]);
                EXPECT_EQ(rays.x[i], x);
                EXPECT_EQ(rays.y[i], y);
            }
        }
    }
}

TEST_P(EachKernel, WithoutAFilterRaysGoThroughThePixelsCentres) {
    PixelView view{};
    view.orthographic = true;
    view.dx[0] = view.dy[1] = view.forward[2] = view.dx_square = view.dy_square = 1;
    Pixels pixels(5, 5);
    Rays rays(5);
    const SampleBits sample = sample_bits(3);
    kernels().rays(view, pixels.set, &sample, 1, nullptr, rays.to);
    for (size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(rays.to.org[0][i], 128.5f + float(i));
        EXPECT_EQ(rays.to.org[1][i], 64.5f);
    }
}

TEST_P(EachKernel, DirectionsAndDifferentialsAreTheNearestFloats) {
    for (double fov : {0.001, 0.5, 40.0, 90.0, 170.0, 179.9})
        for (double turn : {0.0, 0.7, 3.0}) {
            const PixelView view = make_view(fov, 640, 480, false, turn);
            Pixels pixels(61, 31);
            pixels.set.x0 = 300;
            Rays rays(61);
            const SampleBits sample = sample_bits(0);
            kernels().rays(view, pixels.set, &sample, 1, nullptr, rays.to);
            for (size_t i = 0; i < 61; ++i) {
                Real v[3], square = 0;
                const Real across = Real(300 + pixels.x[i]) + 0.5L - view.centre_x;
                const Real down = Real(64 + pixels.y[i]) + 0.5L - view.centre_y;
                for (int k = 0; k < 3; ++k) {
                    v[k] =
                        Real(view.forward[k]) + across * Real(view.dx[k]) + down * Real(view.dy[k]);
                    square += v[k] * v[k];
                }
                const Real length = std::sqrt(square);
                Real dx = 0, dy = 0, size_x = 0, size_y = 0;  // n . dx, |dx|
                for (int k = 0; k < 3; ++k) {
                    dx += v[k] / length * Real(view.dx[k]);
                    dy += v[k] / length * Real(view.dy[k]);
                    size_x += Real(view.dx[k]) * Real(view.dx[k]);
                    size_y += Real(view.dy[k]) * Real(view.dy[k]);
                }
                size_x = std::sqrt(size_x) / length, size_y = std::sqrt(size_y) / length;
                for (int k = 0; k < 3; ++k) {
                    const Real n = v[k] / length;
                    expect_nearest(rays.to.dir[k][i], n, 1, "dir");
                    // Of the length at the picture's centre: what is left there of 1 cancels.
                    expect_nearest(rays.to.ddir_dx[k][i], (Real(view.dx[k]) - n * dx) / length,
                                   size_x, "ddx");
                    expect_nearest(rays.to.ddir_dy[k][i], (Real(view.dy[k]) - n * dy) / length,
                                   size_y, "ddy");
                }
            }
        }
}

TEST_P(EachKernel, ClipPlanesLieAtDepthsAlongTheAxis) {
    for (bool orthographic : {false, true}) {
        PixelView view = make_view(100, 64, 64, orthographic);
        view.clip = true;
        Pixels pixels(33, 8);
        pixels.set.x0 = pixels.set.y0 = 0;
        Rays rays(33);
        const SampleBits sample = sample_bits(0);
        kernels().rays(view, pixels.set, &sample, 1, nullptr, rays.to);
        for (size_t i = 0; i < 33; ++i) {
            Real cosine = 0;
            for (int k = 0; k < 3; ++k) cosine += Real(rays.to.dir[k][i]) * Real(view.forward[k]);
            EXPECT_NEAR(rays.to.tnear[i], double(Real(view.znear) / cosine), 1e-6);
            EXPECT_NEAR(rays.to.tfar[i], double(Real(view.zfar) / cosine), 1e-2);
        }
    }
}

TEST_P(EachKernel, SumsAddWhatSamplesShowAndCover) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0, 1);
    const float background[3] = {0.25f, 0.5f, 3.0f};
    for (size_t pixels : {1u, 3u, 16u, 37u})
        for (size_t n : {1u, 2u, 3u, 4u, 5u, 8u, 16u, 31u})
            for (const float* back : {static_cast<const float*>(nullptr), background}) {
                std::vector<float> in[6];
                std::vector<double> sums(4 * pixels + 8, 2.5);
                std::vector<Real> truth(4 * pixels, 2.5L);
                for (int chunk = 0; chunk < 3; ++chunk) {
                    for (auto& column : in) {
                        column.resize(pixels * n);
                        for (float& f : column) f = unit(random);
                    }
                    const float* color[3] = {in[0].data(), in[1].data(), in[2].data()};
                    const float* through[3] = {in[3].data(), in[4].data(), in[5].data()};
                    kernels().add(pixels, n, color, through, back, sums.data());
                    for (size_t i = 0; i < pixels * n; ++i) {
                        Real through_all = 0;
                        for (size_t k = 0; k < 3; ++k) {
                            truth[4 * (i / n) + k] += Real(in[k][i]);
                            if (back) truth[4 * (i / n) + k] += Real(in[3 + k][i]) * Real(back[k]);
                            through_all += Real(in[3 + k][i]);
                        }
                        truth[4 * (i / n) + 3] += back ? 1 : 1 - through_all / 3;
                    }
                }
                for (size_t i = 0; i < truth.size(); ++i)
                    EXPECT_NEAR(sums[i], double(truth[i]), 1e-14 * 300);
                for (size_t i = truth.size(); i < sums.size(); ++i) EXPECT_EQ(sums[i], 2.5);
            }
}

// In the order of the samples, each sum rounded: what no tile and no chunk changes.
TEST_P(EachKernel, SumsAreRoundedSampleBySample) {
    const float big = 0x1p60f, one = 1;
    for (size_t n : {3u, 4u, 8u}) {
        std::vector<float> color(n, one), clear(n, one);
        color[0] = big, color[2] = -big;  // 2^60 + 1 is 2^60 in double
        const float *red[3] = {color.data(), color.data(), color.data()},
                    *through[3] = {clear.data(), clear.data(), clear.data()};
        double sums[4] = {};
        kernels().add(1, n, red, through, nullptr, sums);
        for (int k = 0; k < 3; ++k) EXPECT_EQ(sums[k], double(n - 3));
        EXPECT_EQ(sums[3], 0);
    }
}

TEST_P(EachKernel, TheMeanOfAMillionSamplesDoesNotDrift) {
    constexpr size_t kPixels = 64, kAtOnce = 16;
    constexpr size_t kSamples = 1000000;
    const float value = 1.0f / 3;
    std::vector<float> shown(kPixels * kAtOnce, value), through(kPixels * kAtOnce, 0.0f);
    const float* color[3] = {shown.data(), shown.data(), shown.data()};
    const float* behind[3] = {through.data(), through.data(), through.data()};
    std::vector<double> sums(4 * kPixels, 0.0);
    for (size_t i = 0; i < kSamples; i += kAtOnce)
        kernels().add(kPixels, kAtOnce, color, behind, nullptr, sums.data());
    for (size_t i = 0; i < kPixels; ++i) {
        for (size_t k = 0; k < 3; ++k)
            EXPECT_NEAR(sums[4 * i + k] / kSamples, double(value), double(value) * 0x1p-20);
        EXPECT_EQ(sums[4 * i + 3], kSamples);
    }
}

TEST_P(EachKernel, SamplesThatStopAllOrNothingSumExactly) {
    std::vector<float> zero(16, 0.0f), one(16, 1.0f);
    std::vector<double> sums(64, 0.0);
    const float *black[3] = {zero.data(), zero.data(), zero.data()},
                *white[3] = {one.data(), one.data(), one.data()};
    for (int i = 0; i < 7; ++i) kernels().add(16, 1, white, black, nullptr, sums.data());
    for (int i = 0; i < 5; ++i) kernels().add(16, 1, black, white, nullptr, sums.data());
    for (double total : sums) EXPECT_EQ(total, 7);
}

// Every instruction set, every count, and nothing behind the end.
TEST(PixelKernels, GiveTheSameBits) {
    const UsableKernels<PixelKernels>& usable = usable_pixel_kernels();
    const PixelKernels& plain = *usable.kernels[usable.count - 1];
    const FilterTable tables[2] = {make_filter(true), make_filter(false)};
    std::mt19937 random(1);
    for (size_t k = 0; k < usable.count; ++k)
        for (size_t count = 1; count < 135; ++count) {
            PixelView view = make_view(std::exp2(random() % 14 / 2.0 - 1) - 0.5, 640, 480,
                                       count % 5 == 0, double(random() % 100));
            view.clip = count % 3 == 0;
            const FilterTable* filter = count % 4 ? &tables[count % 2] : nullptr;
            const uint32_t seed = uint32_t(random());
            const size_t n = size_t(random() % (count % 2 ? 5 : 90) + 1);
            std::vector<SampleBits> samples;
            for (size_t i = 0; i < n; ++i)
                samples.push_back(sample_bits(uint32_t(random() % 4096)));
            Pixels a(count, 13), b(count, 13);
            a.set.x0 = b.set.x0 = uint32_t(random() % 60000);
            plain.scrambles(a.set, seed);
            usable.kernels[k]->scrambles(b.set, seed);
            EXPECT_EQ(a.scramble[0], b.scramble[0]);
            EXPECT_EQ(a.scramble[1], b.scramble[1]);
            Rays one(count * n), other(count * n);
            plain.rays(view, a.set, samples.data(), n, filter, one.to);
            usable.kernels[k]->rays(view, b.set, samples.data(), n, filter, other.to);
            EXPECT_EQ(one.x, other.x);
            EXPECT_EQ(one.y, other.y);
            EXPECT_EQ(one.sample, other.sample);
            for (size_t c = 0; c < one.columns.size(); ++c) {
                ASSERT_EQ(std::memcmp(one.columns[c].data(), other.columns[c].data(),
                                      one.columns[c].size() * sizeof(float)),
                          0)
                    << usable.kernels[k]->name << " column " << c << " of " << count;
                for (size_t i = count * n; i < count * n + 16; ++i)
                    ASSERT_EQ(other.columns[c][i], kUntouched);
            }
        }
}

TEST(PixelKernels, OfSumsGiveTheSameBits) {
    const UsableKernels<PixelKernels>& usable = usable_pixel_kernels();
    std::mt19937 random(2);
    auto any = [&] { return std::ldexp(float(random()), int(random() % 40) - 50); };
    for (size_t count = 1; count < 50; ++count) {
        std::vector<float> in[6];
        for (auto& column : in)
            for (size_t i = 0; i < count; ++i) column.push_back(any());
        in[0][count / 2] = std::numeric_limits<float>::infinity();
        const float* color[3] = {in[0].data(), in[1].data(), in[2].data()};
        const float* through[3] = {in[3].data(), in[4].data(), in[5].data()};
        const float background[3] = {0.1f, 0.7f, 1e-3f};
        std::vector<double> first;
        for (size_t k = 0; k < usable.count; ++k) {
            std::vector<double> all(16 * count, 0.3);
            double* at = all.data();
            for (const float* back : {static_cast<const float*>(nullptr), background})
                for (auto [pixels, n] : {std::pair(count, size_t(1)), {size_t(1), count}}) {
                    usable.kernels[k]->add(pixels, n, color, through, back, at);
                    at += 4 * count;
                }
            if (k == 0) first = all;
            ASSERT_EQ(std::memcmp(first.data(), all.data(), all.size() * sizeof(double)), 0);
        }
    }
}

// What sixteen samples show behind a layer: in double, sample by sample.
TEST_P(EachKernel, TellsWhetherNumbersAreFinite) {
    constexpr float kEndless = std::numeric_limits<float>::infinity();
    constexpr float kMost = std::numeric_limits<float>::max();
    for (size_t place = 0; place < 2 * kLaid; ++place)
        for (float x : {kMost, -kMost, 1e-40f, kEndless, -kEndless, NAN})
            for (size_t column = 0; column < 2; ++column) {
                float rows[2][2 * kLaid] = {};
                const float* const columns[] = {rows[0], rows[1]};
                rows[column][place] = x;
                const bool within = place >= kLaid;
                EXPECT_EQ(kernels().finite(columns, 2, kLaid), !within || std::isfinite(x));
                EXPECT_EQ(kernels().finite(columns, 0, kLaid), true);
            }
}

TEST_P(EachKernel, LaysHitsBehindWhatSamplesShow) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> number(-0.5f, 1.5f);
    constexpr float kLeast = 1e-4f;
    for (int turn = 0; turn < 300; ++turn) {
        float rows[12][kLaid];  // Ci, Oi, colour, what passes
        for (auto& row : rows)
            for (float& x : row) x = number(random);
        LaidHits hits{};
        float *color[3], *through[3], before[6][kLaid];
        for (int k = 0; k < 3; ++k) {
            hits.Ci[k] = rows[k];
            hits.Oi[k] = rows[3 + k];
            color[k] = rows[6 + k];
            through[k] = rows[9 + k];
            for (float& x : rows[9 + k]) x = std::abs(x);
        }
        for (size_t i = 0; i < kLaid; ++i) {
            hits.onward[i] = i % 5 ? 1.0f : 2 * std::abs(number(random));
            for (int k = 0; k < 3 && i % 4 == 0; ++k) rows[3 + k][i] = i % 8 ? 1.0f : 0.0f;
            if (i == 7) rows[3][i] = NAN;
        }
        std::memcpy(before, rows[6], sizeof(before));
        const uint32_t open = kernels().lay(hits, kLeast, color, through);
        for (size_t i = 0; i < kLaid; ++i) {
            double most = -1;
            for (int k = 0; k < 3; ++k) {
                const double left = before[3 + k][i], Oi = rows[3 + k][i];
                EXPECT_NEAR(color[k][i], before[k][i] + left * rows[k][i], 1e-6);
                const double rest = left * (1 - std::clamp(Oi, 0.0, 1.0)) * hits.onward[i];
                if (i == 7 && k == 0)
                    EXPECT_TRUE(std::isnan(through[k][i]));
                else
                    EXPECT_NEAR(through[k][i], rest, 1e-6);
                most = std::max(most, rest);
            }
            const bool sure = i != 7 && std::abs(most - kLeast) > 1e-6;
            EXPECT_TRUE(!sure || (open >> i & 1) == uint32_t(most > kLeast));
        }
    }
}

// Without differentials rays are the same, and the columns stay as they are.
TEST_P(EachKernel, RaysWithoutSpreadsAreTheSameRays) {
    PixelView view{};
    view.centre_x = view.centre_y = 40;
    view.dx[0] = view.dy[1] = 0.01;
    view.dx_square = view.dy_square = 1e-4;
    view.forward[2] = 1;
    for (bool clip : {false, true}) {
        view.clip = clip;
        view.znear = 1, view.zfar = 7;
        Pixels pixels(77, 3);
        Rays with(77), without(77);
        const SampleBits sample = sample_bits(3);
        view.without_spread = false;
        kernels().rays(view, pixels.set, &sample, 1, nullptr, with.to);
        without.to.ddir_dx[0][5] = 123;
        view.without_spread = true;
        kernels().rays(view, pixels.set, &sample, 1, nullptr, without.to);
        for (size_t i = 0; i < 77; ++i) {
            for (int k = 0; k < 3; ++k) EXPECT_EQ(with.to.dir[k][i], without.to.dir[k][i]);
            EXPECT_EQ(with.to.tfar[i], without.to.tfar[i]);
        }
        EXPECT_EQ(without.to.ddir_dx[0][5], 123);
    }
}

}  // namespace
}  // namespace kinora::raytrace::test
