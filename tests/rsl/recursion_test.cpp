// tests/rsl/recursion_test.cpp: functions that call themselves, on every target and against the
// reference (docs/numerics.md#recursion).
#include <gtest/gtest.h>

#include "jit/target.h"
#include "tests/rsl/differential.h"

namespace kinora::rsl {
namespace {

constexpr int kRecursionPoints = 21;

// Values of Ci.r at s = 0, 1, 2, ... on each target; they must agree bit for bit with each other
// and closely with the reference, which must find as many faults.
std::vector<float> results_of(const std::string& source, bool* faults = nullptr) {
    std::vector<float> first;
    for (const jit::Target& target : jit::targets()) {
        if (!target.supported()) continue;
        RunShader run(source, {}, {}, false, target.name);
        EXPECT_TRUE(run.ok()) << run.findings();
        if (!run.ok()) return std::vector<float>(kRecursionPoints, std::nanf(""));
        Columns columns;
        for (int i = 0; i < kRecursionPoints; ++i) {
            columns["s"].push_back(float(i)), columns["dsdu"].push_back(1);
            columns["rng"].push_back(std::bit_cast<float>(i * 77 + 5));
        }
        run.inputs = columns;
        std::vector<float> got = run.run(kRecursionPoints)["Ci.r"];
        if (first.empty()) first = got;
        if (faults) *faults = run.faults > 0;
        int reference_faults = 0;
        Layer layer{run.shaders.back().get(), {}};
        for (size_t i = 0; i < kRecursionPoints; ++i) {
            EXPECT_EQ(std::bit_cast<int32_t>(got[i]), std::bit_cast<int32_t>(first[i]))
                << target.name << " at " << i << ": " << got[i] << ", " << first[i];
            auto reference = run_reference<float>({&layer, 1}, at_point(columns, {"rng"}, i));
            reference_faults += reference.faults;
            double expected = reference.values.at("Ci.r");
            EXPECT_NEAR(got[i], expected, 1e-5 * std::fabs(expected)) << target.name << " at " << i;
        }
        EXPECT_EQ(run.faults > 0, reference_faults > 0) << target.name;
    }
    return first;
}

TEST(Recursion, ComputesAFactorialPerPoint) {
    auto got = results_of(
        "float fact(float n) { if (n <= 1) return 1; return n * fact(n - 1); }"
        "surface t() { Ci = fact(mod(s, 11)); }");
    double factorial = 1;
    for (int n = 0; n < 11; ++n) {
        if (n > 0) factorial *= n;
        EXPECT_EQ(got[size_t(n)], float(factorial)) << n;
    }
}

// Matrices, the eye, clipping planes and arrays of parameters, named in the function itself.
TEST(Recursion, ReadsFrameInputsInTheFunction) {
    const char* source =
        "surface t(uniform float table[4] = {1, 2, 3, 4};) { float f(float n) {"
        " if (n <= 0) return 0; point w = transform(\"world\", point(n, 0, 0));"
        " return xcomp(w) + table[mod(n, 4)] + f(n - 1); }"
        " Ci = f(mod(s, 5)); }";
    auto got = results_of(source);
    const float kSums[] = {0, 3, 8, 15, 20};
    for (int n = 0; n < kRecursionPoints; ++n) EXPECT_EQ(got[size_t(n)], kSums[n % 5]) << n;
    for (const jit::Target& target : jit::targets()) {
        if (!target.supported()) continue;
        RunShader run(source, {}, {}, false, target.name);
        ASSERT_TRUE(run.ok()) << run.findings();
        for (const jit::InputInfo& input : run.kernels.point->inputs)
            EXPECT_EQ(input.rate, jit::Rate::Point) << input.name;
    }
}

TEST(Recursion, CallsItselfTwice) {
    auto got = results_of(
        "float fib(float n) { return n < 2 ? n : fib(n - 1) + fib(n - 2); }"
        "surface t() { Ci = fib(mod(s, 13)); }");
    const float kFibonacci[] = {0, 1, 1, 2, 3, 5, 8, 13, 21, 34, 55, 89, 144};
    for (size_t n = 0; n < 13; ++n) EXPECT_EQ(got[n], kFibonacci[n]) << n;
}

TEST(Recursion, MayGoThroughSeveralFunctions) {
    auto got = results_of(
        "float odd(float n) { if (n == 0) return 0; return even(n - 1); }"
        "float even(float n) { if (n == 0) return 1; return odd(n - 1); }"
        "surface t() { Ci = even(s) + 10 * odd(s); }");
    for (size_t n = 0; n < kRecursionPoints; ++n) EXPECT_EQ(got[n], n % 2 == 0 ? 1 : 10) << n;
}

TEST(Recursion, GivesZeroAndAFaultBeyondItsLimit) {
    bool faults = false;
    auto got = results_of(
        "float down(float n) { return 1 + down(n - 1); } surface t() { Ci = down(s); }", &faults);
    EXPECT_TRUE(faults);
    EXPECT_EQ(got[3], 64);  // the 65th call gives 0
    results_of(
        "float sum(float n) { if (n <= 0) return 0; return n + sum(n - 1); }"
        "surface t() { Ci = sum(s * 3); }",
        &faults);
    EXPECT_FALSE(faults);  // 61 deep at most
}

TEST(Recursion, OfATreeWithoutEndStopsByItsCountOfCalls) {
    RunShader run(
        "float tree(float n) { return tree(n - 1) + tree(n + 1); }"
        "surface t() { Ci = tree(s); }");
    ASSERT_TRUE(run.ok()) << run.findings();
    EXPECT_EQ(run.value("Ci.r"), 0);
    EXPECT_GT(run.faults, 0);
}

TEST(Recursion, HasVariablesOfItsOwnAtEachLevel) {
    auto got = results_of(
        "float f(float n) { float mine = n * 2; if (n > 0) f(n - 1); return mine; }"
        "surface t() { Ci = f(mod(s, 5)); }");
    for (size_t n = 0; n < kRecursionPoints; ++n) EXPECT_EQ(got[n], float(n % 5 * 2)) << n;
}

TEST(Recursion, WritesOutputParametersAndVariablesOutside) {
    auto got = results_of(
        "surface t() { float calls = 0;"
        "  void count(float n; output float last) { extern float calls; calls += 1; last = n;"
        "    if (n > 0) { float below; count(n - 1, below); last += below; } }"
        "  float sum = 0; count(mod(s, 6), sum); Ci = sum * 100 + calls; }");
    for (size_t i = 0; i < kRecursionPoints; ++i) {
        size_t n = i % 6;
        EXPECT_EQ(got[i], float(n * (n + 1) / 2 * 100 + n + 1)) << i;
    }
}

TEST(Recursion, TakesAndGivesArrays) {
    auto got = results_of(
        "void reverse(output float a[]; float lo, hi) { if (lo >= hi) return;"
        "  float x = a[lo]; a[lo] = a[hi]; a[hi] = x; reverse(a, lo + 1, hi - 1); }"
        "surface t() { float a[5] = {1, 2, 3, 4, 5}; a[0] = s; reverse(a, 0, 4);"
        "  Ci = a[0] * 1000 + a[1] * 100 + a[3] * 10 + a[4]; }");
    for (size_t i = 0; i < kRecursionPoints; ++i) EXPECT_EQ(got[i], float(5420 + i)) << i;
}

TEST(Recursion, WorksInLoopsAndCarriesItsResultsThroughThem) {
    auto got = results_of(
        "float paths(float x, y) { if (x == 0 || y == 0) return 1; float sum = 0, k;"
        "  for (k = 0; k < 2; k += 1) { if (k == 0) sum += paths(x - 1, y);"
        "  else sum += paths(x, y - 1); } return sum; }"
        "surface t() { Ci = paths(mod(s, 4), 3); }");
    const float kPaths[] = {1, 4, 10, 20};
    for (size_t i = 0; i < kRecursionPoints; ++i) EXPECT_EQ(got[i], kPaths[i % 4]) << i;
}

TEST(Recursion, HasDerivatives) {
    auto got = results_of(
        "float power(float x, n) { return n < 1 ? 1 : x * power(x, n - 1); }"
        "surface t() { Ci = Du(power(s, 3)); }");
    for (size_t i = 0; i < kRecursionPoints; ++i) EXPECT_EQ(got[i], float(3 * i * i)) << i;
}

TEST(Recursion, DrawsRandomNumbersByThePathOfCalls) {
    auto got = results_of(
        "float walk(float n) { return n < 1 ? 0 : random() + walk(n - 1); }"
        "surface t() { float k, a = 0; for (k = 0; k < 2; k += 1) a += walk(3) * (1 + k); Ci = a; "
        "}");
    EXPECT_NE(got[0], got[1]);
}

TEST(Recursion, DrawsOtherNumbersAtEachLevel) {
    auto got = results_of(
        "float differ(float n) { float r = random(); return n < 1 ? r : r - differ(n - 1); }"
        "surface t() { Ci = differ(1); }");
    for (float x : got) EXPECT_NE(x, 0);
}

// Rays' seeds go through the same path of calls.
TEST(Recursion, SendsOtherRaysAtEachLevel) {
    RunShader run(
        "color see(float n) { color c = trace(P, vector (0, 0, 1)); if (n < 1) return c; "
        "return c - see(n - 1); } surface t() { Ci = see(2); }");
    ASSERT_TRUE(run.ok()) << run.findings();
    static std::set<std::pair<int32_t, int32_t>> seeds;
    seeds.clear();
    run.services[Service::trace] = [](const jit::ServiceCall& call) {
        seeds.insert({std::bit_cast<int32_t>(call.args[0]),
                      std::bit_cast<int32_t>(call.args[jit::kMaxLanes])});
        std::fill_n(call.results, 4 * jit::kMaxLanes, 0.0f);
    };
    run.run();
    EXPECT_EQ(seeds.size(), 3u);
}

TEST(Recursion, KeepsStringsAndUniformVariables) {
    auto got = results_of(
        "string pick(uniform float n; string a, b) { if (n <= 0) return a;"
        "  return pick(n - 1, b, a); }"
        "surface t() { uniform float n = 5; string r = pick(n, \"x\", \"y\");"
        "  Ci = r == \"y\" ? 1 : 0; }");
    for (float x : got) EXPECT_EQ(x, 1);
}

}  // namespace
}  // namespace kinora::rsl
