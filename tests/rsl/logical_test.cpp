// tests/rsl/logical_test.cpp: what ?:, && and || do not ask for does nothing and warns of nothing:
// every target against the reference.
#include <gtest/gtest.h>

#include "jit/target.h"
#include "tests/rsl/differential.h"

namespace kinora::rsl {
namespace {

constexpr int kLogicalPoints = 21;

struct Answer {
    std::vector<float> values;  // of Ci.r
    bool faults = false;
};

// At s = 0, 1, 2, ..., t = -s, on every target; the reference must agree, with its faults.
Answer answer_of(const std::string& source) {
    Answer answer;
    for (const jit::Target& target : jit::targets()) {
        if (!target.supported()) continue;
        RunShader run(source, {}, {}, false, target.name);
        EXPECT_TRUE(run.ok()) << source << run.findings();
        if (!run.ok()) return answer;
        Columns columns;
        for (int i = 0; i < kLogicalPoints; ++i) {
            columns["s"].push_back(float(i));
            columns["t"].push_back(float(-i));
        }
        run.inputs = columns;
        answer.values = run.run(kLogicalPoints)["Ci.r"];
        answer.faults = run.faults > 0;
        bool reference_faults = false;
        Layer layer{run.shaders.back().get(), {}};
        for (size_t i = 0; i < kLogicalPoints; ++i) {
            auto reference = run_reference<float>({&layer, 1}, at_point(columns, {}, i));
            reference_faults = reference_faults || reference.faults > 0;
            EXPECT_EQ(answer.values[i], float(reference.values.at("Ci.r")))
                << source << " on " << target.name << " at " << i;
        }
        EXPECT_EQ(answer.faults, reference_faults) << source << " on " << target.name;
    }
    return answer;
}

std::string surface(const std::string& body) {
    return "surface t() { float a[3] = {10, 20, 30}; float r = 0; " + body + " Ci = r; }";
}

// The body's r at a point against what C would give.
template <class F>
void expect_each(const std::string& body, bool faults, F&& expected) {
    Answer answer = answer_of(surface(body));
    ASSERT_EQ(answer.values.size(), size_t(kLogicalPoints)) << body;
    for (int i = 0; i < kLogicalPoints; ++i)
        EXPECT_EQ(answer.values[size_t(i)], float(expected(i))) << body << " at " << i;
    EXPECT_EQ(answer.faults, faults) << body;
}

TEST(Logical, AnIndexThatIsNotAskedForIsNoFault) {
    auto element = [](int s) { return s < 3 ? 10 * s + 10 : 0; };
    expect_each("r = s < 3 ? a[s] : 0;", false, element);
    expect_each("r = s >= 3 ? 0 : a[s];", false, element);
    expect_each("if (s < 3 && a[s] > 10) r = 1;", false, [](int s) { return s == 1 || s == 2; });
    expect_each("if (s >= 3 || a[s] > 10) r = 1;", false, [](int s) { return s > 0; });
    expect_each("if (s < 9 && (s >= 3 || a[s] > 10)) r = 1;", false,
                [](int s) { return s > 0 && s < 9; });
    expect_each("r = s < 3 ? (s < 2 ? a[s + 1] : a[s]) : 0;", false,
                [](int s) { return s < 3 ? (s < 2 ? 10 * s + 20 : 30) : 0; });
    expect_each("float i = 0; while (i < 3 && a[i] < 25) i += 1; r = i + 0 * s;", false,
                [](int) { return 2; });
}

TEST(Logical, AnIndexThatIsAskedForIsStillOne) {
    expect_each("r = s < 4 ? a[s] : 0;", true,
                [](int s) { return s < 4 ? 10 * s + 10 - 10 * (s == 3) : 0; });
    expect_each("r = s > 3 ? 0 : a[s] + (s < 3 ? a[s] : 0);", true, [](int s) {
        return s > 3 ? 0 : s == 3 ? 30 : 20 * s + 20;
    });
    expect_each("if (s < 4 && a[s] > 25) r = 1;", true, [](int s) { return s == 2 || s == 3; });
    expect_each("if (a[s] > 25 && s < 3) r = 1;", true, [](int s) { return s == 2; });
}

// The function runs for the lanes that ask for it: those that do not would call it for ever.
TEST(Logical, ARightSideThatCallsRunsOnlyWhereItIsAskedFor) {
    std::string even = "float even(float n) { return n == 0 || (n > 1 && even(n - 2)); } ";
    Answer answer = answer_of(even + "surface t() { Ci = even(s); }");
    ASSERT_EQ(answer.values.size(), size_t(kLogicalPoints));
    for (int i = 0; i < kLogicalPoints; ++i) EXPECT_EQ(answer.values[size_t(i)], float(i % 2 == 0)) << i;
    EXPECT_FALSE(answer.faults);

    std::string count = "float met(output float n;) { n += 1; return 1; } ";
    answer = answer_of(count +
                       "surface t() { float n = 0, k = 0; for (k = 0; k < 5; k += 1)"
                       " if (k < s && met(n) > 0) n += 10; Ci = n; }");
    ASSERT_EQ(answer.values.size(), size_t(kLogicalPoints));
    for (int i = 0; i < kLogicalPoints; ++i)
        EXPECT_EQ(answer.values[size_t(i)], float(11 * std::min(i, 5))) << i;
}

TEST(Logical, ARightSideAssignsOnlyWhereItIsAskedFor) {
    expect_each("if (s > 5 && (r = s) > 7) r += 100;", false, [](int s) {
        return s > 7 ? s + 100 : s > 5 ? s : 0;
    });
    expect_each("if (s > 5 || (r = s) > 3) r += 100;", false, [](int s) {
        return s > 5 ? 100 : s > 3 ? s + 100 : s;
    });
}

// An index in a function that is called there.
TEST(Logical, FunctionsIndexForTheLanesThatCall) {
    std::string get =
        "float get(float i; float x[3]) { return x[i]; } surface t() { "
        "float a[3] = {10, 20, 30}; ";
    Answer answer = answer_of(get + "Ci = s < 3 && get(s, a) > 15 ? 1 : 0; }");
    ASSERT_EQ(answer.values.size(), size_t(kLogicalPoints));
    for (int i = 0; i < kLogicalPoints; ++i)
        EXPECT_EQ(answer.values[size_t(i)], float(i == 1 || i == 2)) << i;
    EXPECT_FALSE(answer.faults);
}

}  // namespace
}  // namespace kinora::rsl
