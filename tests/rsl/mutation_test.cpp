// tests/rsl/mutation_test.cpp: damaged shader sources end in findings or in a well-formed kernel,
// and soon. KINORA_FUZZ_TEXT=N sets how many; run under the sanitizers in CI.
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>

#include "jit/compiler.h"
#include "jit/passes/passes.h"
#include "rsl/builtins/table.h"
#include "rsl/compile.h"
#include "rsl/lower/lower.h"
#include "tests/folders.h"
#include "tests/fuzz_settings.h"
#include "tests/mutate.h"

namespace kinora::rsl {
namespace {

constexpr uint64_t kDefaultTexts = 1500;
constexpr unsigned kSecondsAText = 60;  // slow machines, sanitizers
constexpr size_t kLongest = 3000;       // of the corpus

std::string current_text;

// The text that hangs or crashes is kept for the report.
void on_death(int signal) {
    write_reduced(signal == SIGALRM ? "hang.sl" : "crash.sl", current_text);
    _exit(9);
}

std::vector<std::string> corpus() {
    std::vector<std::string> texts;
    std::filesystem::path root = project_folder();
    for (const char* folder :
         {"tests/rsl/files/good", "tests/rsl/files/lights", "tests/rsl/files/syntax",
          "tests/rsl/files/types", "tests/rsl/kept", "assets/shaders"})
        for (const auto& entry : std::filesystem::directory_iterator(root / folder)) {
            if (entry.path().extension() != ".sl" || entry.file_size() > kLongest) continue;
            std::ifstream in(entry.path(), std::ios::binary);
            texts.emplace_back(std::istreambuf_iterator<char>(in),
                               std::istreambuf_iterator<char>());
        }
    std::sort(texts.begin(), texts.end());
    return texts;
}

std::vector<std::string> words() {
    std::vector<std::string> list = {
#define WORD(name, text) text,
#include "rsl/text/words.def"
#undef WORD
        "{",
        "}",
        "(",
        ")",
        "[",
        "]",
        ";",
        ",",
        "=",
        "+=",
        "==",
        "!=",
        "<",
        "&&",
        "||",
        "!",
        "?",
        ":",
        ".",
        "^",
        "\"",
        "\\",
        "/*",
        "*/",
        "//",
        "\n#define A(x) x A(x)\n",
        "A(A)",
        "#if 1\n",
        "\n#include \"x\"\n",
        "1e999",
        "-1",
        "0",
        "99999999999",
        "0x7f",
        "1e-40",
        "a[0]",
        "a[-1]",
        "[2147483647]",
        "\xff",
        "\xc3\x28"};
    for (std::string_view name : builtin_names()) list.emplace_back(name);
    for (const GlobalInfo& global : globals()) list.emplace_back(global.name);
    return list;
}

struct Counts {
    size_t texts = 0, checked = 0, kernels = 0;
};

void survive(const std::string& text, Counts& counts) {
    Diagnostics diagnostics;
    ShaderSource source{text, {}};
    source.map.file = diagnostics.files.add("mutated.sl", text);
    source.map.segments = {{0, 0}};
    auto shaders = compile(source, {}, diagnostics);
    ++counts.texts, counts.checked += !shaders.empty();
    EXPECT_EQ(shaders.empty(), diagnostics.has_errors()) << text;
    for (const Finding& finding : diagnostics.findings())
        EXPECT_FALSE(format_finding(finding, diagnostics.files).empty());
    for (const auto& shader : shaders) {
        Layer layer{shader.get(), {}};
        int errors_before = diagnostics.count(Severity::Error);
        auto lowered = lower({&layer, 1}, {}, diagnostics);
        EXPECT_EQ(lowered.has_value(), diagnostics.count(Severity::Error) == errors_before) << text;
        if (!lowered) continue;
        ++counts.kernels;
        EXPECT_EQ(jit::verify(lowered->module), "") << text;
        if (counts.kernels % 8 != 0) continue;
        jit::Module frame;
        jit::optimize(lowered->module, &frame);
        EXPECT_EQ(jit::verify(lowered->module) + jit::verify(frame), "") << text;
    }
}

TEST(Mutation, DamagedSourcesEndInFindingsOrKernels) {
    for (int signal : {SIGALRM, SIGABRT}) std::signal(signal, on_death);
    Counts counts;
    uint64_t seed = fuzz_setting("KINORA_FUZZ_SEED", 1);
    Mutator mutator(corpus(), words(), seed);
    for (uint64_t k = fuzz_setting("KINORA_FUZZ_TEXT", kDefaultTexts); k > 0; --k) {
        current_text = mutator.next();
        alarm(kSecondsAText);
        survive(current_text, counts);
        if (HasFailure()) break;
    }
    alarm(0);
    if (HasFailure()) std::printf("in %s\n", write_reduced("text.sl", current_text).c_str());
    std::printf("%zu texts, %zu check, %zu kernels\n", counts.texts, counts.checked,
                counts.kernels);
    EXPECT_GT(counts.checked * 50, counts.texts);
}

}  // namespace
}  // namespace kinora::rsl
