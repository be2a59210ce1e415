// tests/rsl/differential_shaders_test.cpp: every shader of assets, of every kind, and those of our
// tests: lowered code against the reference at random points, every target against the interpreter
// at random ones and at edges.
#include <gtest/gtest.h>

#include "jit/target.h"
#include "tests/rsl/edge_world.h"
#include "tests/rsl/shader_difference.h"
#include "tests/rsl/source_text.h"

namespace kinora::rsl {
namespace {

namespace fs = std::filesystem;

struct File {
    fs::path path;
    std::string text;
};

std::vector<File> sources_of(const char* folder) {
    std::vector<File> files;
    for (const fs::path& path : shader_files(folder)) files.push_back({path, read_file(path)});
    return files;
}

// Every shader of assets.
std::vector<File> assets() {
    return sources_of("assets");
}

// Those of our tests, but for what is wrong and two that include what lies beside them: here
// sources have no place.
std::vector<File> shaders_of_tests() {
    std::vector<File> files = sources_of("tests/rsl/files/good");
    for (File& file : sources_of("tests/rsl/constructs")) {
        std::string name = file.path.filename().string();
        bool includes = name == "preprocessor_include.sl" || name == "preprocessor_other_case.sl";
        bool wrong = file.path.parent_path().filename() == "rejected";
        if (!includes && !wrong) files.push_back(std::move(file));
    }
    return files;
}

std::vector<File> all_shaders() {
    std::vector<File> files = assets();
    for (File& file : shaders_of_tests()) files.push_back(std::move(file));
    return files;
}

TEST(Shaders, OfAssetsAreOfEveryKind) {
    std::set<ShaderKind> kinds;
    std::vector<File> files = assets();
    for (const File& file : files) {
        RunShader run(file.text);
        ASSERT_TRUE(run.ok()) << file.path << "\n" << run.findings();
        EXPECT_EQ(run.shaders.size(), 1u) << file.path << ": only the last would be run";
        kinds.insert(run.shaders.back()->kind);
    }
    EXPECT_EQ(kinds.size(), 6u);
    EXPECT_GE(files.size(), 156u);
}

// Of shader_difference's worlds, those of 13, 37, 24 and 1 points.
TEST(Shaders, AgreeWithTheReferenceAndOnEveryTargetAtRandomPoints) {
    DifferenceCounts counts;
    std::vector<File> files = all_shaders();
    for (size_t k = 0; k < files.size(); ++k)
        for (uint64_t world : {37 * k + 12, 37 * k + 36, 37 * k + 23, 37 * k})
            EXPECT_EQ(shader_difference(files[k].text, world, counts), "")
                << files[k].path << " in world " << world;
    std::printf(
        "%zu files, %zu values compared with the reference, %zu undecided, %zu extreme, "
        "%zu unstable, %zu without reference; %zu bits\n",
        files.size(), counts.values, counts.undecided, counts.extreme, counts.unstable,
        counts.no_reference, counts.bits);
    EXPECT_EQ(counts.rejected, 0u) << counts.first_rejection;
    EXPECT_EQ(counts.shaders, 4 * files.size());
    EXPECT_LT(counts.undecided + counts.extreme + counts.unstable, counts.values / 20);
    EXPECT_LT(counts.no_reference, counts.values / 10);
}

LowerOptions all_outputs(const Shader& shader) {
    LowerOptions options;
    options.want_N = shader.kind != ShaderKind::Light;
    options.want_P = options.want_N;
    for (const ShaderParameter& p : shader.parameters)
        if (p.output && !p.type.is_array() && p.type.base != BaseType::String)
            options.aovs.emplace_back(p.name);
    return options;
}

// Loops whose rounds a wild parameter sets end with a fault, which is compared too.
constexpr int kLoopBudget = 60;

// One shader at `points` edges, its parameters bound to edges or as written.
std::string edge_difference(const File& file, uint64_t seed, size_t points, bool bound,
                            DifferenceCounts& counts) {
    RunShader plain(file.text);
    if (!plain.ok()) return plain.findings() + " does not compile";
    const Shader& shader = *plain.shaders.back();
    Random random{seed};
    std::vector<ParamBinding> params;
    Columns columns = edge_points(seed, points);
    if (bound) bind_edges(shader, random, points, params, columns);
    LowerOptions options = all_outputs(shader);
    options.loop_budget = kLoopBudget;
    RunShader run(file.text, options, params);
    if (!run.ok()) return run.findings() + run.verdict + " does not compile when bound";
    run.inputs = columns;
    add_edge_world(run, seed, points);
    ++counts.shaders;
    return target_difference(run, points, counts);
}

TEST(Shaders, GiveTheSameBitsOnEveryTargetAtEdges) {
    DifferenceCounts counts;
    std::vector<File> files = all_shaders();
    for (size_t k = 0; k < files.size(); ++k)
        for (bool bound : {false, true})
            for (size_t points : {size_t(41), size_t(8 + k % 8), size_t(1 + k % 7)}) {
                uint64_t seed = 1000 * k + points;
                EXPECT_EQ(edge_difference(files[k], seed, points, bound, counts), "")
                    << files[k].path << " at " << points << " points" << (bound ? ", bound" : "");
            }
    std::printf("%zu files, %zu values the same on each target\n", files.size(), counts.bits);
    std::printf("digest of shaders: %016llx\n", static_cast<unsigned long long>(counts.digest));
    EXPECT_EQ(counts.shaders, 6 * files.size());
}

}  // namespace
}  // namespace kinora::rsl
