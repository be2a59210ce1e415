// tests/rsl/robustness_test.cpp: damaged source gives findings, never a crash or a hang. What it
// must not do is seen by the sanitizers; here it only has to end, and to say why it made no shader.
// Long source takes time in proportion to its length.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <time.h>

#include <functional>
#include <random>

#include "rsl/lower/lower.h"
#include "tests/rsl/source_text.h"

namespace kinora::rsl {
namespace {

std::vector<std::string> samples() {
    std::vector<std::string> texts;
    for (const auto& path : shader_files("tests/rsl/files")) texts.push_back(read_file(path));
    std::sort(texts.begin(), texts.end());
    return texts;
}

void survives(std::string text) {
    TestSource source(std::move(text));
    auto shaders = compile(source.source, front_end_only(), source.diagnostics);
    EXPECT_EQ(shaders.empty(), source.diagnostics.has_errors()) << source.text;
    for (const auto& shader : shaders) print_types(*shader->ast);
    source.messages();
}

TEST(Robustness, TruncatedSource) {
    for (const std::string& text : samples())
        for (size_t length = 0; length < text.size(); length += 7) survives(text.substr(0, length));
}

TEST(Robustness, ChangedBytes) {
    std::mt19937 random(1);
    for (const std::string& text : samples())
        for (int trial = 0; trial < 40; ++trial) {
            std::string damaged = text;
            for (unsigned edits = 1 + random() % 4; edits > 0; --edits)
                damaged[random() % damaged.size()] = char(random());
            survives(damaged);
        }
}

TEST(Robustness, SwappedPieces) {
    std::mt19937 random(2);
    std::vector<std::string> texts = samples();
    for (int trial = 0; trial < 1500; ++trial) {
        const std::string& a = texts[random() % texts.size()];
        const std::string& b = texts[random() % texts.size()];
        size_t cut = random() % a.size(), from = random() % b.size();
        survives(a.substr(0, cut) + b.substr(from, random() % 80) + a.substr(cut));
    }
}

TEST(Robustness, DroppedAndDoubledTokens) {
    std::mt19937 random(3);
    for (const std::string& text : samples()) {
        TestSource source(text);
        TokenStream tokens = preprocess(source.source, {}, source.diagnostics);
        for (int trial = 0; trial < 20; ++trial) {
            size_t at = random() % tokens.tokens.size();
            bool drop = random() % 2;
            std::string damaged;
            for (size_t i = 0; i < tokens.tokens.size(); ++i)
                for (int n = 0; n < (i != at ? 1 : drop ? 0 : 2); ++n)
                    (damaged += tokens.tokens[i].text) += ' ';
            survives(damaged);
        }
    }
}

// ---- long source: time in proportion to it, by ratios
// --------------------------------------------

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
        Layer layer;
        layer.shader = shaders[0].get();
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

}  // namespace
}  // namespace kinora::rsl
