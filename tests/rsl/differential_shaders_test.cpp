// tests/rsl/differential_shaders_test.cpp: every shader of ours at random points: lowered code
// against the reference, and every target against the interpreter.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/rsl/differential.h"

namespace kinora::rsl {
namespace {

constexpr size_t kPoints = 48;

// A curved patch lit from three sides.
Columns random_point(uint64_t seed) {
    Random r{seed};
    Columns c;
    auto triple = [&](const std::string& name, auto make, const char* parts = "xyz") {
        for (int k = 0; k < 3; ++k)
            for (size_t i = 0; i < kPoints; ++i) c[name + "." + parts[k]].push_back(make(k));
    };
    triple("P", [&](int) { return r.uniform(-3, 3); });
    triple("Ps", [&](int) { return r.uniform(-3, 3); });
    triple("dPdu", [&](int k) { return k == 0 ? r.uniform(0.5f, 2) : r.uniform(-0.3f, 0.3f); });
    triple("dPdv", [&](int k) { return k == 1 ? r.uniform(0.5f, 2) : r.uniform(-0.3f, 0.3f); });
    for (const char* name : {"dNdu", "dNdv", "dIdu", "dIdv"})
        triple(name, [&](int) { return r.uniform(-0.2f, 0.2f); });
    for (const char* name : {"Ci", "Oi"})  // behind a volume or imager
        triple(
            name, [&](int) { return r.uniform(0, 1); }, "rgb");
    for (const char* name : {"N", "Ng", "Ns"})
        triple(name, [&](int k) { return k == 2 ? r.uniform(-1, -0.5f) : r.uniform(-0.5f, 0.5f); });
    triple("I", [&](int k) { return k == 2 ? r.uniform(1, 5) : r.uniform(-1, 1); });
    for (const char* name : {"u", "v", "s", "t", "alpha"})
        for (size_t i = 0; i < kPoints; ++i) c[name].push_back(r.uniform(0, 1));
    for (const char* name : {"dsdu", "dsdv", "dtdu", "dtdv", "du", "dv"})
        for (size_t i = 0; i < kPoints; ++i) c[name].push_back(r.uniform(0.01f, 0.1f));
    for (size_t i = 0; i < kPoints; ++i) c["rng"].push_back(std::bit_cast<float>(r.next() >> 4));
    c["time"] = {0.25f};
    c["dtime"] = {0.02f};
    return c;
}

// What services answer, the same for kernels and the reference: smooth in a few arguments.
double answer(std::string_view name, const double* args, int result) {
    int first = name == "texture" || name == "environment" ? 2 : name == "shadow" ? 1 : 0;
    if (name == "trace" || name == "transmission") first = 2;  // behind the seed
    int count = name == "texture" ? 2 : 3;
    double sum = 0.3 * result;
    for (int k = 0; k < count; ++k) sum += args[first + k] * (0.7 + 0.2 * k);
    return 0.5 + 0.4 * std::sin(sum);
}

template <int kService>
void kernel_service(const jit::ServiceCall& call) {
    std::string_view name = kServiceNames[kService];
    int results = name == "lights" || name == "print" ? 0 : name == "transform" ? 24 : 4;
    if (name == "shadow" || name == "transmission") results = 3;
    for (int lane = 0; lane < call.lanes; ++lane) {
        double args[6];
        for (int k = 0; k < 6 && results; ++k)
            args[k] = double(call.args[k * jit::kMaxLanes + lane]);
        for (int k = 0; k < results; ++k)
            call.results[k * jit::kMaxLanes + lane] = float(answer(name, args, k));
        if (name == "lights") call.results[lane] = std::bit_cast<float>(0);
    }
}

// Services behind the first eight answer 0 to both.
template <int results>
void zero_service(const jit::ServiceCall& call) {
    std::fill_n(call.results, results * jit::kMaxLanes, 0.0f);
}

std::vector<double> reference_service(std::string_view name, std::span<const double> args) {
    auto known = std::find(std::begin(kServiceNames), std::end(kServiceNames), name);
    if (known - std::begin(kServiceNames) >= 8) return {};
    double padded[6] = {};
    std::copy_n(args.begin(), std::min<size_t>(args.size(), 6), padded);
    std::vector<double> results;
    for (int k = 0; k < 4; ++k) results.push_back(double(float(answer(name, padded, k))));
    return results;
}

void add_services(RunShader& run) {
    run.services = {{"lights", kernel_service<0>},        {"texture", kernel_service<1>},
                    {"environment", kernel_service<2>},   {"shadow", kernel_service<3>},
                    {"trace", kernel_service<4>},         {"transmission", kernel_service<5>},
                    {"transform", kernel_service<6>},     {"print", kernel_service<7>},
                    {"query", zero_service<17>},          {"occlusion", zero_service<4>},
                    {"indirectdiffuse", zero_service<3>}, {"photons", zero_service<3>},
                    {"texture3d", zero_service<33>},      {"bake3d", zero_service<0>}};
}

void add_lights(RunShader& run, ReferenceInputs& inputs) {
    for (int k = 0; k < 4; ++k) {
        TestLight light;
        ReferenceLight same;
        light.kind = same.kind = k == 0 ? kLightAmbient : k == 1 ? kLightSolar : kLightIlluminate;
        const float L[4][3] = {{0, 0, 0}, {0.6f, 0, -0.8f}, {1, 2, -3}, {-2, 0.5f, -0.5f}};
        for (size_t c = 0; c < 3; ++c) {
            light.L[c] = L[k][c], same.L[c] = double(L[k][c]);
            light.Cl[c] = 0.2f * float(k + 1) + 0.1f * float(c), same.Cl[c] = double(light.Cl[c]);
            same.Ol[c] = 1;
        }
        if (k == 3) light.nonspecular = 1, same.nonspecular = 1;
        for (size_t j = 0; j < run.lowered.categories.size(); ++j)
            if (int(j) % 2 == k % 2) {
                light.categories |= 1u << j;
                same.categories.push_back(run.lowered.categories[j]);
            }
        for (size_t j = 0; j < run.lowered.light_messages.size(); ++j) {
            std::vector<double> value;
            for (int c = 0; c < run.lowered.light_message_components[j]; ++c) {
                light.messages.push_back(0.25f * float(k + c));
                value.push_back(double(light.messages.back()));
            }
            same.messages[run.lowered.light_messages[j]] = value;
        }
        run.lights.push_back(light);
        inputs.lights.push_back(same);
    }
}

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
    Columns columns = random_point(7);
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

bool same_bits(float a, float b) {
    return std::bit_cast<int32_t>(a) == std::bit_cast<int32_t>(b) ||
           (std::isnan(a) && std::isnan(b));
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
                run->inputs = random_point(11);
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
