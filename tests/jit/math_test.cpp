// tests/jit/math_test.cpp: jit/math against the C++ library in double precision.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdio>
#include <functional>
#include <mutex>
#include <string_view>
#include <thread>

#include "jit/target.h"
#include "tests/fuzz_settings.h"
#include "tests/jit/math_harness.h"

namespace kinora::jit {
namespace {

using math::Tier;
using testing::edge_values;
using testing::MathKernel;
using testing::Samples;
using testing::ulp_error;

constexpr float kInf = HUGE_VALF;
constexpr double kSmallest = 1.17549435082228751e-38;

using Unary = Value (*)(Builder&, Value, Tier);
struct UnaryRow {
    const char* name;
    Unary function;
    double (*reference)(double);
    float lo, hi;  // where most samples are taken; the rest are any float
};

double clamped(double x) {
    return std::isnan(x) ? x : std::clamp(x, -1.0, 1.0);
}
// docs/numerics.md#powers-roots-logarithms, docs/numerics.md#arcs
double ref_asin(double x) {
    return std::asin(clamped(x));
}
double ref_acos(double x) {
    return std::acos(clamped(x));
}
double ref_log(double x) {
    return std::isnan(x) ? x : std::log(std::max(x, kSmallest));
}
double ref_log2(double x) {
    return std::isnan(x) ? x : std::log2(std::max(x, kSmallest));
}
double ref_inversesqrt(double x) {
    return x <= 0 ? 0 : 1 / std::sqrt(x);
}

const UnaryRow kUnary[] = {
    {"sin", math::sin, std::sin, -30, 30},
    {"cos", math::cos, std::cos, -30, 30},
    {"tan", math::tan, std::tan, -30, 30},
    {"asin", math::asin, ref_asin, -1, 1},
    {"acos", math::acos, ref_acos, -1, 1},
    {"atan", math::atan, std::atan, -10, 10},
    {"exp", math::exp, std::exp, -104, 89},
    {"exp2", math::exp2, std::exp2, -150, 128},
    {"log", math::log, ref_log, 0, 4},
    {"log2", math::log2, ref_log2, 0, 4},
    {"inversesqrt", math::inversesqrt, ref_inversesqrt, 0, 100},
};

std::string name_of(const ::testing::TestParamInfo<UnaryRow>& info) {
    return info.param.name;
}

std::vector<float> unary_samples(const UnaryRow& row) {
    std::vector<float> x = edge_values();
    Samples s;
    for (int i = 0; i < 600'000; ++i) x.push_back(s.uniform(row.lo, row.hi));
    for (int i = 0; i < 300'000; ++i) x.push_back(s.pattern());
    for (int i = 0; i < 100'000; ++i) x.push_back(s.uniform(-1e7f, 1e7f));
    for (int i = -20'000; i <= 20'000; ++i) {
        x.push_back(float(i * 1.5707963267948966));  // where sin, cos and tan cancel
        x.push_back(std::nextafter(1.0f, 2.0f) + float(i) * 0x1p-23f);
    }
    return x;
}

struct Worst {
    double ulp = 0;
    float at = 0, got = 0;
    double exact = 0;
    void see(double error, float x, float y, double reference) {
        if (error > ulp) *this = {error, x, y, reference};
    }
};

// The last of the targets that this CPU runs is the fastest.
const char* fastest_target() {
    const char* name = "interp";
    for (const Target& target : targets())
        if (target.supported() && std::string_view(target.name) != "interp") return target.name;
    return name;
}

// Runs task(0) to task(count - 1) on all cores.
void on_all_cores(uint64_t count, const std::function<void(uint64_t)>& task) {
    std::atomic<uint64_t> next = 0;
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i)
        threads.emplace_back([&] {
            for (uint64_t k = next++; k < count; k = next++) task(k);
        });
    for (std::thread& thread : threads) thread.join();
}

constexpr uint64_t kSweepChunk = 1 << 16;

// Of all 2^32 floats each `step`th, in chunks on all cores; precise, fast.
std::array<Worst, 2> sweep(const UnaryRow& row, uint64_t step) {
    MathKernel kernel(
        1,
        [&](Builder& b, std::span<const Value> in) {
            return std::vector<Value>{row.function(b, in[0], Tier::Precise),
                                      row.function(b, in[0], Tier::Fast)};
        },
        fastest_target());
    EXPECT_EQ(kernel.fault(), "");
    std::array<Worst, 2> worst;
    std::mutex mutex;
    const uint64_t samples = ((uint64_t(1) << 32) + step - 1) / step;
    on_all_cores((samples + kSweepChunk - 1) / kSweepChunk, [&](uint64_t chunk) {
        std::vector<float> x;
        for (uint64_t i = chunk * kSweepChunk; i < std::min(samples, (chunk + 1) * kSweepChunk);
             ++i)
            x.push_back(std::bit_cast<float>(uint32_t(i * step)));
        auto y = kernel.run({x});
        std::array<Worst, 2> here;
        for (size_t i = 0; i < x.size(); ++i) {
            const double exact = row.reference(x[i]);
            here[0].see(ulp_error(y[0][i], exact), x[i], y[0][i], exact);
            if (std::fabs(x[i]) < kSmallest || std::fabs(exact) < 0x1p-125) continue;
            here[1].see(ulp_error(y[1][i], exact), x[i], y[1][i], exact);
        }
        std::lock_guard lock(mutex);
        for (size_t t = 0; t < 2; ++t)
            worst[t].see(here[t].ulp, here[t].at, here[t].got, here[t].exact);
    });
    return worst;
}

Worst worst_of(const UnaryRow& row, Tier tier, bool flush) {
    MathKernel kernel(1, [&](Builder& b, std::span<const Value> in) {
        return std::vector<Value>{row.function(b, in[0], tier)};
    });
    EXPECT_EQ(kernel.fault(), "");
    std::vector<float> x = unary_samples(row);
    std::vector<float> y = kernel.run({x})[0];
    Worst worst;
    for (size_t i = 0; i < x.size(); ++i) {
        double exact = row.reference(x[i]);
        bool tiny = std::fabs(x[i]) < kSmallest || std::fabs(exact) < 0x1p-125;
        if (flush && tiny) continue;  // docs/numerics.md#two-tiers
        worst.see(ulp_error(y[i], exact), x[i], y[i], exact);
    }
    std::printf("%-12s %-8s %4d ops  max %.3f ULP at %.9g: %.9g, exactly %.17g\n", row.name,
                tier == Tier::Fast ? "fast" : "precise", kernel.instructions(), worst.ulp,
                double(worst.at), double(worst.got), worst.exact);
    return worst;
}

class UnaryMath : public ::testing::TestWithParam<UnaryRow> {};

TEST_P(UnaryMath, PreciseIsWithinOneUlp) {
    EXPECT_LE(worst_of(GetParam(), Tier::Precise, false).ulp, 1.0);
}

TEST_P(UnaryMath, FastIsWithinFourUlp) {
    EXPECT_LE(worst_of(GetParam(), Tier::Fast, true).ulp, 4.0);
}

// scripts/nightly math sets KINORA_SWEEP_STEP to 1: every float.
TEST_P(UnaryMath, HoldsOverAllFloats) {
    auto [precise, fast] = sweep(GetParam(), fuzz_setting("KINORA_SWEEP_STEP", 8191));
    for (const Worst& w : {precise, fast})
        std::printf("%-12s max %.4f ULP at %.9g: %.9g, exactly %.17g\n", GetParam().name, w.ulp,
                    double(w.at), double(w.got), w.exact);
    EXPECT_LE(precise.ulp, 1.0);
    EXPECT_LE(fast.ulp, 4.0);
}

// pow as jit/math/math.h has it: 0 to any power but 0 is 0
// (docs/numerics.md#powers-roots-logarithms), a NaN power gives NaN.
double ref_pow(double x, double y) {
    return std::isnan(y) ? y : x == 0 && y != 0 ? 0 : std::pow(x, y);
}

struct Pairs {
    std::vector<float> x, y;
    void add(float a, float b) { x.push_back(a), y.push_back(b); }
};

Pairs edge_pairs() {
    Pairs pairs;
    for (float a : edge_values())
        for (float b : edge_values()) pairs.add(a, b);
    return pairs;
}

MathKernel binary_kernel(Value (*f)(Builder&, Value, Value, Tier), Tier tier) {
    return MathKernel(2, [=](Builder& b, std::span<const Value> in) {
        return std::vector<Value>{f(b, in[0], in[1], tier)};
    });
}

Pairs pow_samples() {
    Pairs pairs = edge_pairs();
    Samples s;
    for (int i = 0; i < 400'000; ++i) pairs.add(s.uniform(0, 10), s.uniform(-40, 40));
    for (int i = 0; i < 200'000; ++i) pairs.add(s.uniform(0.99f, 1.01f), s.uniform(-9000, 9000));
    for (int i = 0; i < 200'000; ++i) pairs.add(std::fabs(s.pattern()), s.uniform(-1, 1));
    for (int i = 0; i < 200'000; ++i) pairs.add(std::fabs(s.pattern()), s.pattern());
    return pairs;
}

Worst worst_pow(Tier tier) {
    MathKernel kernel = binary_kernel(math::pow, tier);
    EXPECT_EQ(kernel.fault(), "");
    Pairs p = pow_samples();
    std::vector<float> z = kernel.run({p.x, p.y})[0];
    Worst worst;
    for (size_t i = 0; i < z.size(); ++i) {
        if (!(p.x[i] >= 0)) continue;  // x < 0 is lowered in rsl
        double exact = ref_pow(p.x[i], p.y[i]);
        double error = ulp_error(z[i], exact);
        if (tier == Tier::Fast) {
            if ((p.x[i] < kSmallest && p.x[i] > 0) || std::fabs(exact) < 0x1p-125) continue;
            double slack = 2 * std::fabs(p.y[i] * std::log2(double(p.x[i])));
            if (std::isfinite(slack)) error = std::max(0.0, error - slack);
        }
        if (error > worst.ulp)
            std::printf("pow(%.9g, %.9g) = %.9g, exactly %.17g: %.3f\n", double(p.x[i]),
                        double(p.y[i]), double(z[i]), exact, error);
        worst.see(error, p.x[i], z[i], exact);
    }
    std::printf("pow %d ops\n", kernel.instructions());
    return worst;
}

TEST(Pow, PreciseIsWithinOneUlp) {
    EXPECT_LE(worst_pow(Tier::Precise).ulp, 1.0);
}

// 4 + 2 |y log2 x|
TEST(Pow, FastGrowsWithTheExponent) {
    EXPECT_LE(worst_pow(Tier::Fast).ulp, 4.0);
}

// Small whole powers are multiplied; the bound is the same.
TEST(Pow, FastSmallWholePowersAreWithinTheBoundToo) {
    for (int n = 1; n <= 9; ++n) {
        MathKernel kernel(1, [=](Builder& b, std::span<const Value> in) {
            return std::vector<Value>{math::pow(b, in[0], b.f(float(n)), Tier::Fast)};
        });
        EXPECT_LT(kernel.instructions(), 12);
        std::vector<float> x;
        Samples s;
        for (int i = 0; i < 200'000; ++i) x.push_back(s.uniform(0.25f, 4));
        std::vector<float> z = kernel.run({x})[0];
        double worst = 0;
        for (size_t i = 0; i < x.size(); ++i) {
            double slack = 2 * std::fabs(n * std::log2(double(x[i])));
            worst = std::max(worst, ulp_error(z[i], std::pow(double(x[i]), n)) - slack);
        }
        EXPECT_LE(worst, 4.0) << n;
    }
}

double ref_atan2(double y, double x) {
    return x == 0 && y == 0 ? 0 : std::atan2(y, x);
}

Worst worst_atan2(Tier tier) {
    MathKernel kernel = binary_kernel(math::atan2, tier);
    EXPECT_EQ(kernel.fault(), "");
    Pairs p = edge_pairs();
    Samples s;
    for (int i = 0; i < 500'000; ++i) p.add(s.uniform(-2, 2), s.uniform(-2, 2));
    for (int i = 0; i < 500'000; ++i) p.add(s.pattern(), s.pattern());
    std::vector<float> z = kernel.run({p.x, p.y})[0];
    Worst worst;
    for (size_t i = 0; i < z.size(); ++i) {
        double exact = ref_atan2(p.x[i], p.y[i]);
        bool tiny = std::fabs(p.x[i]) < kSmallest || std::fabs(p.y[i]) < kSmallest ||
                    std::fabs(exact) < 0x1p-125;
        if (tier == Tier::Fast && tiny) continue;
        double error = ulp_error(z[i], exact);
        if (error > worst.ulp)
            std::printf("atan2(%.9g, %.9g) = %.9g, exactly %.17g: %.3f\n", double(p.x[i]),
                        double(p.y[i]), double(z[i]), exact, error);
        worst.see(error, p.x[i], z[i], exact);
    }
    std::printf("atan2 %d ops\n", kernel.instructions());
    return worst;
}

TEST(Atan2, PreciseIsWithinOneUlp) {
    EXPECT_LE(worst_atan2(Tier::Precise).ulp, 1.0);
}

TEST(Atan2, FastIsWithinFourUlp) {
    EXPECT_LE(worst_atan2(Tier::Fast).ulp, 4.0);
}

// Random pairs, half of them any floats; scripts/nightly math sets KINORA_SWEEP_PAIRS to 10^9.
struct BinaryRow {
    const char* name;
    Value (*function)(Builder&, Value, Value, Tier);
    double (*reference)(double, double);
    float lo, hi, lo2, hi2;
};
const BinaryRow kBinary[] = {
    {"pow", math::pow, ref_pow, 0, 10, -40, 40},
    {"atan2", math::atan2, ref_atan2, -2, 2, -2, 2},
};

class BinaryMath : public ::testing::TestWithParam<BinaryRow> {};

TEST_P(BinaryMath, HoldsOverRandomPairs) {
    const BinaryRow& row = GetParam();
    const bool is_pow = row.function == &math::pow;
    MathKernel kernel(
        2,
        [&](Builder& b, std::span<const Value> in) {
            return std::vector<Value>{row.function(b, in[0], in[1], Tier::Precise)};
        },
        fastest_target());
    Worst worst;
    std::mutex mutex;
    on_all_cores(fuzz_setting("KINORA_SWEEP_PAIRS", 1000000) / kSweepChunk + 1,
                 [&](uint64_t chunk) {
                     Samples s{0x9e3779b97f4a7c15u * (2 * chunk + 1)};
                     Pairs p;
                     for (uint64_t i = 0; i < kSweepChunk; i += 2) {
                         p.add(s.uniform(row.lo, row.hi), s.uniform(row.lo2, row.hi2));
                         p.add(is_pow ? std::fabs(s.pattern()) : s.pattern(), s.pattern());
                     }
                     std::vector<float> z = kernel.run({p.x, p.y})[0];
                     Worst here;
                     for (size_t i = 0; i < z.size(); ++i) {
                         if (is_pow && !(p.x[i] >= 0)) continue;  // x < 0 is lowered in rsl
                         const double exact = row.reference(p.x[i], p.y[i]);
                         here.see(ulp_error(z[i], exact), p.x[i], z[i], exact);
                     }
                     std::lock_guard lock(mutex);
                     worst.see(here.ulp, here.at, here.got, here.exact);
                 });
    std::printf("%-12s max %.4f ULP at %.9g: %.9g, exactly %.17g\n", row.name, worst.ulp,
                double(worst.at), double(worst.got), worst.exact);
    EXPECT_LE(worst.ulp, 1.0);
}

INSTANTIATE_TEST_SUITE_P(Rows, BinaryMath, ::testing::ValuesIn(kBinary),
                         [](const auto& row) { return std::string(row.param.name); });

bool same_bits(float a, float b) {
    return std::bit_cast<int32_t>(a) == std::bit_cast<int32_t>(b) ||
           (std::isnan(a) && std::isnan(b));
}

// docs/decisions.md#exact-arithmetic; in the IEEE default mode this holds for the fast tier as
// well.
TEST_P(UnaryMath, GivesTheSameBitsOnEveryTarget) {
    std::vector<float> x = edge_values();
    Samples s;
    for (int i = 0; i < 20'000; ++i) x.push_back(s.pattern());
    for (int i = 0; i < 20'000; ++i) x.push_back(s.uniform(GetParam().lo, GetParam().hi));
    auto write = [&](Builder& b, std::span<const Value> in) {
        return std::vector<Value>{GetParam().function(b, in[0], Tier::Precise),
                                  GetParam().function(b, in[0], Tier::Fast)};
    };
    auto expected = MathKernel(1, write).run({x});
    for (const Target& target : targets()) {
        if (!target.supported()) continue;
        auto got = MathKernel(1, write, target.name).run({x});
        for (size_t tier = 0; tier < 2; ++tier)
            for (size_t i = 0; i < x.size(); ++i)
                ASSERT_TRUE(same_bits(expected[tier][i], got[tier][i]))
                    << target.name << " tier " << tier << " at " << x[i];
    }
}

INSTANTIATE_TEST_SUITE_P(Rows, UnaryMath, ::testing::ValuesIn(kUnary), name_of);

}  // namespace
}  // namespace kinora::jit
