// tests/rsl/differential_shaders_test.cpp: every shader of ours at random points: lowered code
// against the reference, and every target against the interpreter.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/rsl/differential.h"
#include "tests/rsl/shading_world.h"

namespace kinora::rsl {
namespace {

constexpr size_t kPoints = 48;

std::string read_file(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

std::vector<std::filesystem::path> shader_files() {
    std::vector<std::filesystem::path> files;
    std::filesystem::path root = KINORA_SOURCE_DIR;
    // Volumes and imagers change what is there already, which these runs do not give them.
    auto add = [&](const std::filesystem::path& path) {
        if (path.extension() != ".sl") return;
        std::string text = "\n" + read_file(path);
        if (text.find("\nvolume ") == text.npos && text.find("\nimager ") == text.npos)
            files.push_back(path);
    };
    for (auto& entry : std::filesystem::directory_iterator(root / "assets/shaders"))
        add(entry.path());
    for (auto& entry : std::filesystem::directory_iterator(root / "tests/rsl/files"))
        if (entry.path().filename().string().rfind("good", 0) == 0) add(entry.path());
    for (auto& entry : std::filesystem::directory_iterator(root / "tests/rsl/constructs"))
        add(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

LowerOptions all_outputs(const Shader& shader) {
    LowerOptions options;
    options.want_N = shader.kind != ShaderKind::Light;
    for (const ShaderParameter& p : shader.parameters)
        if (p.output && !p.type.is_array() && p.type.base != BaseType::String)
            options.aovs.emplace_back(p.name);
    return options;
}

// A file's last shader, compiled once to learn its outputs, then with all of them.
std::unique_ptr<RunShader> compile_shader(const std::filesystem::path& path, const char* target) {
    std::string source = read_file(path);
    RunShader first(source);
    if (!first.ok()) return nullptr;
    return std::make_unique<RunShader>(source, all_outputs(*first.shaders.back()),
                                       std::vector<ParamBinding>{}, false, target);
}

struct Outcome {
    int compared = 0, undecided = 0;
    double worst = 0;  // absolute and relative error, whichever is less
    std::string where;
    std::string missing;  // a built-in without reference
};

Outcome compare_shader(RunShader& run) {
    Outcome outcome;
    Columns columns = random_point(7, kPoints);
    ReferenceInputs shared;
    add_lights(run, shared);
    add_services(run);
    run.inputs = columns;
    auto got = run.run(int(kPoints));
    Layer layer{run.shaders.back().get(), {}};
    for (size_t i = 0; i < kPoints; ++i) {
        ReferenceInputs inputs = at_point(columns, {"rng"}, i);
        inputs.lights = shared.lights;
        inputs.service = reference_service;
        ReferenceResult exact = run_reference<double>({&layer, 1}, inputs);
        ReferenceResult single = run_reference<float>({&layer, 1}, inputs);
        if (exact.decisions != single.decisions || !exact.missing.empty()) {
            ++outcome.undecided;
            outcome.missing = exact.missing;
            continue;
        }
        for (auto& [name, values] : got) {
            if (name.find(":lit") != std::string::npos) {
                bool lit = std::bit_cast<int32_t>(values[i]) != 0;
                EXPECT_EQ(lit, exact.values.at(name) != 0);
                continue;
            }
            double want = exact.values.at(name), lost = std::fabs(single.values.at(name) - want);
            double error = std::fabs(double(values[i]) - want);
            double excess = std::max(0.0, error - 4 * lost) / (1 + std::fabs(want));
            if (std::isnan(want) && std::isnan(values[i])) excess = 0;
            ++outcome.compared;
            if (!(excess <= outcome.worst)) {
                outcome.worst = std::isnan(excess) ? 1e30 : excess;
                outcome.where = name + " float " + std::to_string(single.values.at(name)) +
                                " got " + std::to_string(values[i]) + ", exactly " +
                                std::to_string(want) + " at point " + std::to_string(i);
            }
        }
    }
    return outcome;
}

TEST(Shaders, LoweredCodeAgreesWithTheReference) {
    int files = 0, left_out = 0, points = 0, undecided = 0;
    for (auto& path : shader_files()) {
        auto run = compile_shader(path, "interp");
        if (!run || !run->ok()) {
            std::printf("left out: %s\n", path.filename().c_str());
            ++left_out;
            continue;
        }
        Outcome outcome = compare_shader(*run);
        if (!outcome.missing.empty())
            std::printf("%s: no reference for %s\n", path.filename().c_str(),
                        outcome.missing.c_str());
        ++files, points += outcome.compared, undecided += outcome.undecided;
        EXPECT_LE(outcome.worst, 2e-5) << path.filename() << " " << outcome.where;
    }
    std::printf("%d shaders, %d left out, %d values compared, %d points undecided\n", files,
                left_out, points, undecided);
    EXPECT_GT(files, 20);
}

TEST(Shaders, GiveTheSameBitsOnEveryTarget) {
    for (const jit::Target& target : jit::targets()) {
        if (!target.supported() || std::string_view(target.name) == "interp") continue;
        int values = 0;
        for (auto& path : shader_files()) {
            auto one = compile_shader(path, "interp"), other = compile_shader(path, target.name);
            if (!one || !one->ok()) continue;
            ASSERT_TRUE(other && other->ok()) << path.filename() << " " << target.name;
            for (RunShader* run : {one.get(), other.get()}) {
                ReferenceInputs unused;
                add_lights(*run, unused);
                add_services(*run);
                run->inputs = random_point(11, kPoints);
            }
            auto expected = one->run(int(kPoints)), got = other->run(int(kPoints));
            for (auto& [name, column] : expected)
                for (size_t i = 0; i < column.size(); ++i, ++values)
                    ASSERT_TRUE(same_bits(column[i], got.at(name)[i]))
                        << path.filename() << " " << target.name << " " << name << " at " << i;
        }
        std::printf("%s: %d values\n", target.name, values);
    }
}

}  // namespace
}  // namespace kinora::rsl
