// tests/rsl/differential_test.cpp: the reference evaluator against lowered code: every built-in row
// over edge and random values, every shader at random points, on every target.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "rsl/reference.h"
#include "tests/rsl/run_shader.h"

namespace kinora::rsl {
namespace {

// ---- points -------------------------------------------------------------------------------------

struct Random {
    uint64_t state;
    uint32_t next() {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return uint32_t(state >> 32);
    }
    float uniform(float lo, float hi) { return lo + (hi - lo) * float(next() * 0x1p-32); }
    float argument(bool moderate) {
        if (moderate) return uniform(-2, 2);
        static const float kEdges[] = {0,    -0.0f, 1,     -1,          0.5f,      -0.5f,
                                       2,    3,     1e-7f, 1e-30f,      1e-40f,    100,
                                       1e9f, -3e9f, 1e20f, 0.99999994f, 1.0000001f};
        switch (next() % 8) {
            case 0:
                return kEdges[next() % std::size(kEdges)];
            case 1:
            case 2:
                return uniform(0, 1);
            case 3:
                return uniform(-100, 100);
            default:
                return uniform(-2, 2);
        }
    }
};

// Columns by input name, and what the reference sees at one point of them.
using Columns = std::map<std::string, std::vector<float>>;

ReferenceInputs at_point(const Columns& columns, const std::set<std::string>& ints, size_t i) {
    ReferenceInputs inputs;
    for (auto& [name, values] : columns) {
        float x = values[values.size() == 1 ? 0 : i];
        inputs.values[name] = ints.count(name) ? double(std::bit_cast<int32_t>(x)) : double(x);
    }
    return inputs;
}

double ulp(double exact) {
    int exponent = exact == 0 ? -126 : std::max(std::ilogb(exact), -126);
    return std::ldexp(1.0, exponent - 23);
}

// ---- rows ---------------------------------------------------------------------------------------

const char* sample_text(std::string_view function) {
    if (function == "ctransform") return "hsv";
    if (function == "spline") return "bspline";
    return "world";
}

// Rows that add terms of unlike size: any formula loses the small ones beside huge ones.
bool moderate(std::string_view name) {
    static const std::set<std::string_view> kRows = {"spline",  "ptlined", "rotate",
                                                     "refract", "fresnel", "specularbrdf"};
    return kRows.count(name) > 0;
}

// A surface that calls one overload with parameters a0, a1, ... and puts what comes out into r0,
// ...
struct RowShader {
    std::string source;
    std::vector<ParamBinding> params;
    Columns columns;
    std::vector<std::string> outputs;  // with component suffixes
    std::vector<std::string> aovs;
};

class RowWriter {
  public:
    RowWriter(const Builtin& row, const Signature& signature, uint64_t seed)
        : row_(row), signature_(signature), random_{seed} {}

    RowShader write() {
        std::vector<Signature::Argument> arguments = signature_.arguments;
        if (signature_.repeats) arguments.insert(arguments.end(), 2, signature_.repeated);
        for (size_t k = 0; k < arguments.size(); ++k) argument(k, arguments[k]);
        std::string_view row_name = row_.name;
        if (row_name == "refract" || row_name == "fresnel")
            for (const char* name : {"param:0:a0", "param:0:a1"}) make_unit(name);
        for (const char* ratio : {"param:0:a2", "param:0:a3"})  // eta, roughness: positive
            if (auto found = shader_.columns.find(ratio);
                found != shader_.columns.end() &&
                (row_name == "fresnel" || row_name == "specularbrdf"))
                for (float& x : found->second) x = 0.1f + std::fabs(x);
        std::string call = std::string(row_.name) + "(" + call_ + ")";
        if (signature_.result.base == BaseType::Void)
            body_ += call + "; ";
        else
            body_ += result(signature_.result.base) + " = " + call + "; ";
        shader_.source =
            "surface t(" + parameters_ + ") { " + body_ + after_ + "Ci = Cs; Oi = Os; }";
        return shader_;
    }

    static constexpr size_t kPoints = 160;

  private:
    void argument(size_t k, const Signature::Argument& argument) {
        if (!call_.empty()) call_ += ", ";
        BaseType type = argument.type.base;
        if (type == BaseType::String) {
            call_ += std::string("\"") + sample_text(row_.name) + "\"";
            return;
        }
        std::string name = "a" + std::to_string(k);
        bool array = argument.type.is_array();
        parameters_ += std::string(array ? "uniform " : "varying ") + type_name(type) + " " + name +
                       (array ? "[6] = {0}" : " = 0") + "; ";
        shader_.params.push_back(
            {name, array ? ParamBinding::Kind::Frame : ParamBinding::Kind::Varying, {}, {}});
        for (int e = 0; e < (array ? 6 : 1); ++e)
            column("param:0:" + name + (array ? "[" + std::to_string(e) + "]" : ""), type, array);
        if (!argument.output) {
            call_ += name;
            return;
        }
        std::string local = "o" + std::to_string(k);
        body_ += std::string(type_name(type)) + " " + local + " = " + name + "; ";
        call_ += local;
        after_ += result(type) + " = " + local + "; ";
    }

    void column(const std::string& name, BaseType type, bool one) {
        for (int c = 0; c < component_count(type); ++c)
            for (size_t i = 0; i < (one ? 1 : kPoints); ++i)
                shader_.columns[name + suffix(type, c)].push_back(
                    random_.argument(moderate(row_.name)));
    }

    // Directions that the row expects to have length 1.
    void make_unit(const std::string& name) {
        auto& columns = shader_.columns;
        for (size_t i = 0; i < kPoints; ++i) {
            float* v[] = {&columns[name + ".x"][i], &columns[name + ".y"][i],
                          &columns[name + ".z"][i]};
            float length = std::sqrt(*v[0] * *v[0] + *v[1] * *v[1] + *v[2] * *v[2]);
            for (float* x : v) *x /= length;
        }
    }

    static std::string suffix(BaseType type, int c) {
        if (type == BaseType::Matrix) return "." + std::to_string(c);
        if (type == BaseType::Color) return std::string(".") + "rgb"[c];
        return is_triple(type) ? std::string(".") + "xyz"[c] : "";
    }

    // A new output parameter.
    std::string result(BaseType type) {
        std::string name = "r" + std::to_string(shader_.aovs.size());
        parameters_ += std::string("output varying ") + type_name(type) + " " + name + " = 0; ";
        shader_.aovs.push_back(name);
        for (int c = 0; c < component_count(type); ++c)
            shader_.outputs.push_back("aov:" + name + suffix(type, c));
        return name;
    }

    const Builtin& row_;
    const Signature& signature_;
    Random random_;
    RowShader shader_;
    std::string parameters_, body_, call_, after_;
};

struct RowReport {
    int compared = 0, undecided = 0;
    double worst = 0;  // share of what is allowed
    std::string example;
};

// Allowed: the row's ULP, and a few times what rounding the arguments alone changes.
void compare(double got, double single, double exact, double condition, const Builtin& row,
             RowReport& report, const std::string& what) {
    bool extreme = !std::isfinite(exact) || std::fabs(exact) > 1e37 || !std::isfinite(single);
    if (extreme || !std::isfinite(condition)) return;
    double terms = moderate(row.name) ? 2e-6 : 0;  // of size 2, which may cancel
    double allowed = std::max(1, row.tolerance_ulp) * ulp(exact) + condition + terms + 1e-36;
    double share = std::isfinite(got) ? std::fabs(got - exact) / allowed : 1e30;
    ++report.compared;
    if (share <= report.worst) return;
    report.worst = share;
    char text[200];
    std::snprintf(text, sizeof text, "%s: got %.9g, float %.9g, exactly %.17g", what.c_str(), got,
                  single, exact);
    report.example = text;
}

std::string point_text(const ReferenceInputs& inputs) {
    std::string text;
    for (auto& [name, value] : inputs.values) {
        if (name.rfind("param:0:a", 0) != 0) continue;
        char item[60];
        std::snprintf(item, sizeof item, "%s=%.9g ", name.c_str() + 8, value);
        text += item;
    }
    return text;
}

// How far arguments that differ by up to one ULP from these move the results: 6 times the largest
// change, and that of float arithmetic. Empty if they turn a decision.
std::map<std::string, double> conditions(const Layer& layer, const ReferenceInputs& inputs,
                                         const ReferenceResult& exact,
                                         const ReferenceResult& single) {
    std::map<std::string, double> largest;
    Random random{5};
    for (auto& [name, value] : exact.values)
        largest[name] = 6 * std::fabs(single.values.at(name) - value);
    for (int k = 0; k < 6; ++k) {
        ReferenceInputs moved = inputs;
        for (auto& [name, value] : moved.values)
            value *= 1 + double(random.uniform(-1, 1)) * 0x1p-23;
        ReferenceResult result = run_reference<double>({&layer, 1}, moved);
        if (result.decisions != exact.decisions) return {};
        for (auto& [name, value] : exact.values)
            largest[name] = std::max(largest[name], 6 * std::fabs(result.values.at(name) - value));
    }
    return largest;
}

RowReport run_row(const Builtin& row, const Signature& signature) {
    RowReport report;
    RowShader shader = RowWriter(row, signature, 99 + size_t(signature.overload)).write();
    LowerOptions options;
    options.aovs = shader.aovs;
    RunShader run(shader.source, options, shader.params);
    EXPECT_TRUE(run.ok()) << shader.source << "\n" << run.findings();
    if (!run.ok()) return report;
    run.inputs = shader.columns;
    run.set("camera:near", 0.5f), run.set("camera:far", 100);
    shader.columns["camera:near"] = {0.5f}, shader.columns["camera:far"] = {100};
    auto got = run.run(int(RowWriter::kPoints));
    Layer layer{run.shaders.back().get(), shader.params};
    for (size_t i = 0; i < RowWriter::kPoints; ++i) {
        ReferenceInputs inputs = at_point(shader.columns, {}, i);
        ReferenceResult exact = run_reference<double>({&layer, 1}, inputs);
        ReferenceResult single = run_reference<float>({&layer, 1}, inputs);
        auto condition = conditions(layer, inputs, exact, single);
        if (exact.decisions != single.decisions || condition.empty()) {
            ++report.undecided;
            continue;
        }
        for (const std::string& name : shader.outputs)
            compare(got.at(name)[i], single.values.at(name), exact.values.at(name),
                    condition.at(name), row, report, point_text(inputs));
    }
    return report;
}

TEST(Rows, LoweredCodeAgreesWithTheReference) {
    int rows = 0, points = 0, undecided = 0;
    for (std::span<const Builtin> group : builtin_groups()) {
        for (const Builtin& row : group) {
            bool pure = (row.effects & ~uint32_t(kDerivative)) == 0;
            if (!row.lower || !row.ref.single || !pure) continue;
            if (row.signature[0] == 's' || std::string_view(row.name) == "match") continue;
            for (const Signature& signature : parse_signatures(row.signature)) {
                RowReport report = run_row(row, signature);
                ++rows, points += report.compared, undecided += report.undecided;
                EXPECT_LE(report.worst, 1)
                    << row.name << " overload " << signature.overload << " " << report.example;
            }
        }
    }
    std::printf("%d overloads, %d values compared, %d points undecided\n", rows, points, undecided);
    EXPECT_GT(rows, 100);
}

// ---- shaders ------------------------------------------------------------------------------------

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
    for (const char* name : {"N", "Ng", "Ns"})
        triple(name, [&](int k) { return k == 2 ? r.uniform(-1, -0.5f) : r.uniform(-0.5f, 0.5f); });
    triple("I", [&](int k) { return k == 2 ? r.uniform(1, 5) : r.uniform(-1, 1); });
    for (const char* name : {"u", "v", "s", "t"})
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

std::vector<double> reference_service(std::string_view name, std::span<const double> args) {
    double padded[6] = {};
    std::copy_n(args.begin(), std::min<size_t>(args.size(), 6), padded);
    std::vector<double> results;
    for (int k = 0; k < 4; ++k) results.push_back(double(float(answer(name, padded, k))));
    return results;
}

void add_services(RunShader& run) {
    run.services = {{"lights", kernel_service<0>},      {"texture", kernel_service<1>},
                    {"environment", kernel_service<2>}, {"shadow", kernel_service<3>},
                    {"trace", kernel_service<4>},       {"transmission", kernel_service<5>},
                    {"transform", kernel_service<6>},   {"print", kernel_service<7>}};
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
    for (auto& entry : std::filesystem::directory_iterator(root / "assets/shaders"))
        if (entry.path().extension() == ".sl") files.push_back(entry.path());
    for (auto& entry : std::filesystem::directory_iterator(root / "tests/rsl/files"))
        if (entry.path().filename().string().rfind("good", 0) == 0 &&
            entry.path().extension() == ".sl")
            files.push_back(entry.path());
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
