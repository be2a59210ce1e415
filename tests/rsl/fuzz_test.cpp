// tests/rsl/fuzz_test.cpp: random shaders mean the same to the reference, the interpreter and every
// target. KINORA_FUZZ_RSL=N sets the number of shaders, KINORA_FUZZ_SEED the first seed; a tenth
// more run from a fresh seed, which is printed.
#include <gtest/gtest.h>

#include "tests/folders.h"
#include "tests/fuzz_settings.h"
#include "tests/rsl/random_shader.h"
#include "tests/rsl/reduce_text.h"
#include "tests/rsl/shader_difference.h"

namespace kinora::rsl {
namespace {

constexpr uint64_t kDefaultShaders = 150;
const std::string kKept = project_folder() + "/tests/rsl/kept";

std::string source_of(uint64_t seed) {
    return random_shader(seed, seed % 8 == 7);
}

// What shows the normals that a displacement bends; "" for shaders that are none.
std::string joined(const std::string& source) {
    if (source.find("\ndisplacement ") == std::string::npos) return "";
    return source +
           "\nsurface shown() { Oi = 1; Ci = color(xcomp(N), ycomp(N), zcomp(N)) + comp(P, 0); }\n";
}

// "// world 12" on the first line of a kept file.
uint64_t world_in(const std::string& source) {
    size_t at = source.find("// world ");
    return at == std::string::npos ? 1 : std::strtoull(source.c_str() + at + 9, nullptr, 10);
}

// What kind of failure: the words before the first ':'. A reduced shader fails in the same way.
std::string kind_of(const std::string& wrong) {
    return wrong.substr(0, wrong.find(':'));
}

std::string reduced(const std::string& source, uint64_t world, const std::string& kind) {
    return reduce_text(source, [&](const std::string& text) {
        DifferenceCounts unused;
        std::string wrong = shader_difference(text, world, unused);
        return !wrong.empty() && kind_of(wrong) == kind;
    });
}

void fuzz_one(const std::string& source, uint64_t seed, DifferenceCounts& counts) {
    std::string wrong = shader_difference(source, seed, counts);
    if (wrong.empty()) return;
    std::string small = reduced(source, seed, kind_of(wrong));
    DifferenceCounts unused;
    std::string text = "// world " + std::to_string(seed) + "\n" + small;
    FAIL() << "seed " << seed << ": " << wrong
           << "\nreduced: " << shader_difference(small, seed, unused) << "\nin "
           << keep_reduced(kKept, "seed" + std::to_string(seed) + ".sl", text) << "\n"
           << text;
}

void fuzz(uint64_t first, uint64_t shaders, DifferenceCounts& counts) {
    for (uint64_t seed = first; seed < first + shaders; ++seed)
        for (const std::string& source : {source_of(seed), joined(source_of(seed))})
            if (!source.empty() && !testing::Test::HasFatalFailure())
                fuzz_one(source, seed, counts);
}

void print(const DifferenceCounts& c) {
    std::printf(
        "%zu shaders (%zu rejected): %zu values agree with the reference, %zu undecided, %zu "
        "extreme, %zu unstable, %zu without reference; %zu values equal in bits\n",
        c.shaders, c.rejected, c.values, c.undecided, c.extreme, c.unstable, c.no_reference,
        c.bits);
    if (c.rejected) std::printf("first rejected: %s\n", c.first_rejection.c_str());
}

TEST(ShaderFuzz, ReferenceInterpreterAndTargetsAgree) {
    uint64_t shaders = fuzz_setting("KINORA_FUZZ_RSL", kDefaultShaders);
    DifferenceCounts counts;
    fuzz(fuzz_setting("KINORA_FUZZ_SEED", 1), shaders, counts);
    if (!HasFatalFailure()) {
        std::printf("fresh seed %llu (KINORA_FUZZ_FRESH)\n",
                    static_cast<unsigned long long>(fresh_seed()));
        fuzz(fresh_seed(), (shaders + 9) / 10, counts);
    }
    print(counts);
    EXPECT_LE(counts.rejected * 20, counts.shaders) << counts.first_rejection;
    EXPECT_GT(counts.values, 3 * (counts.undecided + counts.extreme + counts.unstable));
}

TEST(ShaderFuzz, KeptShadersAgree) {
    DifferenceCounts counts;
    for (auto& entry : std::filesystem::directory_iterator(kKept)) {
        if (entry.path().extension() != ".sl") continue;
        std::ifstream file(entry.path());
        std::string source(std::istreambuf_iterator<char>(file), {});
        EXPECT_EQ(shader_difference(source, world_in(source), counts), "") << entry.path();
    }
    print(counts);
    EXPECT_EQ(counts.rejected, 0u);
    EXPECT_GT(counts.shaders, 0u);
}

TEST(CompileTwice, GivesTheSameBytesForEveryShaderOfAssets) {
    int shaders = 0;
    std::filesystem::path folder = std::filesystem::path(project_folder()) / "assets/shaders";
    for (auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.path().extension() != ".sl") continue;
        Diagnostics diagnostics;
        CompileOptions options;
        options.include_directories = {(folder / "include").string()};
        for (auto& shader : compile_file(entry.path().string(), options, diagnostics)) {
            Layer layer{shader.get(), {}};
            auto lowered = lower({&layer, 1}, {}, diagnostics);
            if (!lowered) continue;
            EXPECT_EQ(emission_difference(lowered->module), "") << entry.path();
            ++shaders;
        }
    }
    std::printf("%d shaders\n", shaders);
    EXPECT_GT(shaders, 10);
}

TEST(ShaderFuzz, TheSameSeedGivesTheSameShader) {
    for (uint64_t seed = 1; seed < 20; ++seed) EXPECT_EQ(source_of(seed), source_of(seed));
    EXPECT_NE(source_of(1), source_of(6));
}

// A stand-in for a fault: a loop around a call of noise that reaches Ci.
TEST(ReduceText, KeepsOnlyWhatFails) {
    std::string source =
        "float f(float a; float b;) {\n    if (a < b) return a;\n    return b;\n}\n"
        "surface t(float Kd = 1;) {\n    float x = f(u, v) * 2;\n    float i;\n"
        "    color c = color (x, x, Kd);\n    for (i = 0; i < 4; i += 1) {\n"
        "        if (i > 2) {\n            x += float noise(P * (i + 2)) + sin(x);\n        }\n"
        "        c += color (x, 0, 1);\n    }\n    Oi = Os;\n    Ci = c * Cs + x;\n}\n";
    auto fails = [](const std::string& text) {
        RunShader run(text);
        return run.ok() && text.find("for") < text.find("noise") &&
               text.find("noise") != std::string::npos;
    };
    ASSERT_TRUE(fails(source));
    std::string small = reduce_text(source, fails);
    EXPECT_TRUE(fails(small));
    EXPECT_LE(std::count(small.begin(), small.end(), '\n'), 8) << small;
    EXPECT_EQ(small.find("sin"), std::string::npos) << small;
}

}  // namespace
}  // namespace kinora::rsl
