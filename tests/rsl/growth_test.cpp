// tests/rsl/growth_test.cpp: compiling takes time in proportion to the source, by ratios.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <time.h>

#include <algorithm>
#include <functional>

#include "rsl/lower/lower.h"
#include "tests/rsl/source_text.h"

namespace kinora::rsl {
namespace {

double thread_ms() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e3 * double(t.tv_sec) + 1e-6 * double(t.tv_nsec);
}

// From text to IR: the least of several, in CPU time.
double compile_ms(const std::string& text) {
    double least = 1e30;
    for (int i = 0; i < 5; ++i) {
        const double begin = thread_ms();
        TestSource source(text);
        auto shaders = compile(source.source, {}, source.diagnostics);
        EXPECT_EQ(shaders.size(), 1u) << source.messages();
        if (shaders.empty()) return 0;
        const Layer layer{.shader = shaders[0].get()};
        EXPECT_TRUE(lower({&layer, 1}, {}, source.diagnostics)) << source.messages();
        least = std::min(least, thread_ms() - begin);
    }
    return least;
}

using Statement = std::function<std::string(int)>;
std::string shader_of(int statements, const Statement& statement) {
    std::string text = "surface t() { float v0 = u;";
    for (int i = 1; i <= statements; ++i) text += statement(i);
    return text + fmt::format(" Ci = v{}; }}", statements);
}

// Of a square law the ratio were 16.
void expect_growth_in_proportion(const Statement& statement) {
    const double few = compile_ms(shader_of(4000, statement));
    const double many = compile_ms(shader_of(16000, statement));
    EXPECT_LT(many / few, 8) << few << " ms, " << many << " ms";
}

TEST(Growth, OfLocalsIsInProportion) {
    expect_growth_in_proportion(
        [](int i) { return fmt::format(" float v{} = v{} * 1.5 + u;\n", i, i - 1); });
}

TEST(Growth, OfConstantsIsInProportion) {
    expect_growth_in_proportion(
        [](int i) { return fmt::format(" float v{0} = v{1} + {0}.5;\n", i, i - 1); });
}

}  // namespace
}  // namespace kinora::rsl
