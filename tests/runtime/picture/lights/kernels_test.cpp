// tests/runtime/picture/lights/kernels_test.cpp: every light kernel that this CPU runs against the
// definition in double, point by point, at counts that fill no vector.
#include "runtime/picture/lights/kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace kinora::test {
namespace {

class EachLightKernel : public testing::TestWithParam<size_t> {
  protected:
    const LightKernels& kernels() const { return *usable_light_kernels().kernels[GetParam()]; }
};
INSTANTIATE_TEST_SUITE_P(All, EachLightKernel,
                         testing::Range<size_t>(0, usable_light_kernels().count),
                         [](const auto& kernel) {
                             return std::string(usable_light_kernels().kernels[kernel.param]->name);
                         });

constexpr float kInfinity = std::numeric_limits<float>::infinity(), kNaN = NAN;
constexpr size_t kCounts[] = {0, 1, 3, 15, 16, 17, 100, 1023};

// Three columns of numbers, some of them 0, endless or none.
struct Columns {
    std::vector<float> at[3];
    Columns(size_t count, std::mt19937& random) {
        std::uniform_real_distribution<float> number(-2, 2);
        const float special[] = {0, -0.0f, kInfinity, -kInfinity, kNaN, 3e38f, 1e-30f};
        for (std::vector<float>& column : at)
            for (size_t i = 0; i < count; ++i)
                column.push_back(random() % 16 ? number(random) : special[random() % 7]);
    }
    const float* const* rows() {
        for (int k = 0; k < 3; ++k) row_[k] = at[k].data();
        return row_;
    }
    float* const* written() {
        for (int k = 0; k < 3; ++k) written_[k] = at[k].data();
        return written_;
    }

  private:
    const float* row_[3];
    float* written_[3];
};

double dot(const Columns& a, const Columns& b, size_t i) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += double(a.at[k][i]) * double(b.at[k][i]);
    return sum;
}

// The cosine of their angle; NaN where a float may overflow or vanish on the way.
double cosine(const Columns& a, const Columns& b, size_t i) {
    const double lengths = std::sqrt(dot(a, a, i) * dot(b, b, i));
    return lengths > 1e-10 && lengths < 1e10 ? dot(a, b, i) / lengths : kNaN;
}

// Whether a cosine is far enough from 90 degrees, or from the margin about it, for floats to agree.
bool is_clear(double c) {
    return std::abs(c) > 1.1e-4;
}

// The largest component, 0 of colors that hold no number.
float strength(const Columns& Cl, size_t i) {
    const float r = std::abs(Cl.at[0][i]), g = std::abs(Cl.at[1][i]), b = std::abs(Cl.at[2][i]);
    return double(r) + double(g) + double(b) <= double(std::numeric_limits<float>::max())
               ? std::max({r, g, b})
               : 0;
}

TEST_P(EachLightKernel, FindsBounds) {
    std::mt19937 random(1);
    for (size_t count : kCounts) {
        const Columns columns(count, random);
        for (const std::vector<float>& column : columns.at) {
            float low = 0, high = 0, least = kInfinity, most = -kInfinity;
            for (float x : column) {
                if (std::isnan(x)) continue;
                least = std::min(least, x);
                most = std::max(most, x);
            }
            kernels().bounds(column.data(), count, low, high);
            EXPECT_EQ(low, least) << count;
            EXPECT_EQ(high, most) << count;
        }
    }
}

// By division into a table of bits, axis by axis.
TEST_P(EachLightKernel, NumbersCells) {
    constexpr uint32_t kBits[8] = {0, 1, 8, 9, 64, 65, 72, 73};
    const float low[3] = {-2, 0.5f, 0}, scale[3] = {4, 0.25f, 0};
    std::mt19937 random(7);
    for (size_t count : kCounts) {
        Columns P(count, random);
        std::vector<uint32_t> cell(count, 99u);
        kernels().cells(P.rows(), low, scale, count, cell.data());
        for (size_t i = 0; i < count; ++i) {
            uint32_t expected = 0;
            for (size_t k = 0; k < 3; ++k) {
                const float at = (P.at[k][i] - low[k]) * scale[k];
                size_t index = 0;
                while (index < 7 && at >= float(index + 1)) ++index;
                expected |= kBits[index] << k;
            }
            EXPECT_EQ(cell[i], expected) << count << ' ' << i;
        }
    }
}

TEST_P(EachLightKernel, TellsWhereASideLooks) {
    std::mt19937 random(2);
    size_t compared = 0;
    for (size_t count : kCounts) {
        Columns V(count, random), I(count, random);
        std::vector<float> signs(count, 1.0f);
        kernels().turn_signs(V.rows(), I.rows(), count, signs.data());
        for (size_t i = 0; i < count; ++i) {
            const double c = cosine(V, I, i);
            if (!is_clear(c)) continue;
            EXPECT_EQ(signs[i], c > 0 ? -1.0f : 1.0f) << count << ' ' << i;
            ++compared;
        }
    }
    EXPECT_GT(compared, 500u);
}

// 5e-5 beside 90 degrees rounding may decide.
TEST_P(EachLightKernel, DoesNotTellWithinTheMargin) {
    const float one[] = {1}, none[] = {0}, little[] = {5e-5f};
    const float *const V[3] = {one, none, none}, *const I[3] = {little, one, none};
    float sign[] = {1}, Cl[3][1] = {{1}, {1}, {1}};
    float* const color[3] = {Cl[0], Cl[1], Cl[2]};
    kernels().turn_signs(V, I, 1, sign);
    EXPECT_EQ(sign[0], 0.0f);
    kernels().darken_unseen(V, I, none, none, 1, color);
    EXPECT_EQ(Cl[0][0], 1.0f);
}

TEST_P(EachLightKernel, DarkensWhatNoSideSees) {
    std::mt19937 random(3);
    size_t dark = 0, kept = 0;
    for (size_t count : kCounts) {
        Columns N(count, random), L(count, random), Cl(count, random);
        const Columns before = Cl;
        std::vector<float> along(count), against(count);
        for (size_t i = 0; i < count; ++i) {
            along[i] = float(random() % 2);
            against[i] = float(random() % 2);
        }
        kernels().darken_unseen(N.rows(), L.rows(), along.data(), against.data(), count,
                                Cl.written());
        for (size_t i = 0; i < count; ++i) {
            const double c = cosine(N, L, i);
            if (!is_clear(c)) continue;
            const bool seen = (c > 0 ? along[i] : against[i]) != 0;
            const bool goes = !seen && strength(before, i) > 0;
            for (int k = 0; k < 3; ++k) {
                const float was = before.at[k][i], is = Cl.at[k][i];
                EXPECT_TRUE(goes ? is == 0 : is == was || (std::isnan(is) && std::isnan(was)));
            }
            ++(goes ? dark : kept);
        }
    }
    EXPECT_GT(dark, 200u);
    EXPECT_GT(kept, 200u);
}

TEST_P(EachLightKernel, MarksWhatIsWeak) {
    std::mt19937 random(4);
    size_t marked = 0;
    for (size_t count : kCounts) {
        Columns Cl(count, random);
        std::vector<float> limits(count, 0.25f);
        kernels().add_strengths(Cl.rows(), 0.5f, count, limits.data());
        for (size_t i = 0; i < count; ++i)
            EXPECT_EQ(limits[i], 0.25f + 0.5f * strength(Cl, i)) << count << ' ' << i;
        std::fill(limits.begin(), limits.end(), 1.0f);
        std::vector<uint32_t> weak(count, 0u);
        const bool any = kernels().mark_weak(Cl.rows(), limits.data(), count, weak.data());
        for (size_t i = 0; i < count; ++i) {
            const float x = strength(Cl, i);
            EXPECT_EQ(weak[i] != 0, x > 0 && x <= 1) << count << ' ' << i;
            marked += weak[i] != 0;
        }
        EXPECT_EQ(any, std::any_of(weak.begin(), weak.end(), [](uint32_t w) { return w != 0; }));
    }
    EXPECT_GT(marked, 50u);
}

TEST_P(EachLightKernel, ChoosesWhatIsSent) {
    std::mt19937 random(11);
    for (size_t count : kCounts)
        for (int turn = 0; turn < 12; ++turn) {
            Columns Cl(count, random);
            std::vector<float> lit(count);  // integers, bit by bit
            for (size_t i = 0; i < count; ++i) {
                const bool dark = turn % 3 == 0 ? false : random() % 4 == 0;
                for (int k = 0; dark && k < 3; ++k) Cl.at[k][i] = random() % 2 ? 0.0f : -0.0f;
                const uint32_t bits = turn % 3 == 2 && random() % 3 == 0 ? 0u : 1u;
                std::memcpy(&lit[i], &bits, sizeof(bits));
            }
            const bool some_lit = turn % 2;
            std::vector<uint32_t> wanted, chosen(count + 1, 77u);
            for (size_t i = 0; i < count; ++i) {
                uint32_t bits;
                std::memcpy(&bits, &lit[i], sizeof(bits));
                const bool black = Cl.at[0][i] == 0 && Cl.at[1][i] == 0 && Cl.at[2][i] == 0;
                if (!black && (!some_lit || bits != 0)) wanted.push_back(uint32_t(i));
            }
            const size_t found =
                kernels().choose(Cl.rows(), some_lit ? lit.data() : nullptr, count, chosen.data());
            ASSERT_EQ(found, wanted.size());
            EXPECT_EQ(chosen[count], 77u);
            chosen.resize(found);
            EXPECT_EQ(chosen, wanted);
        }
}

}  // namespace
}  // namespace kinora::test
