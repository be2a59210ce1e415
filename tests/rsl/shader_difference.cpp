// tests/rsl/shader_difference.cpp: agreement of reference, interpreter and targets on one source.
#include "tests/rsl/shader_difference.h"

#include <algorithm>
#include <cstring>

#include "jit/passes/passes.h"
#include "jit/target.h"
#include "tests/rsl/shading_world.h"

namespace kinora::rsl {

namespace {

constexpr size_t kReferencePoints = 8;
constexpr double kFloor = 2e-5;  // of 1 + |value|: where all agree to rounding
constexpr double kFactor = 16;
constexpr double kUnstable = 0.25;
constexpr int kLoopBudget = 2000;  // reduction drops what ends loops
constexpr int64_t kStatementBudget = 1'000'000;

bool begins_with(std::string_view text, std::string_view start) {
    return text.substr(0, start.size()) == start;
}

// The same bindings and columns for the same shader and world.
struct Setting {
    std::vector<ParamBinding> params;
    Columns columns;
    LowerOptions options;
    size_t points = 1;
};

// Random numbers for a parameter or a request, and their changes where they vary.
void bind_values(std::string_view name, BaseType type, size_t layer, bool frame, Random& random,
                 Setting& setting) {
    setting.params.push_back({std::string(name),
                              frame ? ParamBinding::Kind::Frame : ParamBinding::Kind::Varying,
                              {},
                              {}});
    for (int c = 0; c < component_count(type); ++c) {
        std::string suffix =
            component_count(type) == 1
                ? ""
                : std::string(".") + (type == BaseType::Color ? "rgb"[c] : "xyz"[c]);
        std::string column = "param:" + std::to_string(layer) + ":" + std::string(name) + suffix;
        for (size_t i = 0; i < (frame ? 1 : setting.points); ++i) {
            setting.columns[column].push_back(random.argument(random.next() % 4 != 0));
            if (!frame)
                for (const char* partial : {":du", ":dv"})
                    setting.columns[column + partial].push_back(random.uniform(-1, 1));
        }
    }
}

void bind_parameter(const ShaderParameter& p, size_t layer, Random& random, Setting& setting) {
    bool frame = begins_with(p.name, "frame_"), vary = begins_with(p.name, "vary_");
    if (p.output && p.type.base != BaseType::String) setting.options.aovs.emplace_back(p.name);
    if (frame || vary) bind_values(p.name, p.type.base, layer, frame, random, setting);
}

// A vertex input that no parameter declares: that of the name, or two where it may be any.
void bind_request(const VertexRequest& request, size_t layer, Random& random, Setting& setting) {
    if (request.type == BaseType::String || request.type == BaseType::Matrix) return;
    for (std::string_view input : {"vary_one", "vary_two"}) {
        if (!request.name.empty() && request.name != input) continue;
        std::string name = vertex_request_name(request.type, input);
        auto same = [&](const ParamBinding& bound) { return bound.name == name; };
        if (std::ranges::none_of(setting.params, same))
            bind_values(name, request.type, layer, false, random, setting);
    }
}

// Of those that a pattern may mean: the one with "1" in place of what is made at run time.
void want_output(const NamedOutput& output, Setting& setting) {
    std::string name = output.pattern;
    std::ranges::replace(name, '*', '1');
    if (std::ranges::find(setting.options.aovs, name) == setting.options.aovs.end())
        setting.options.aovs.push_back(name);
}

// "world" and "object" are scaled and moved, each with its inverse.
void add_spaces(Random& random, Setting& setting) {
    for (const char* space : {"world", "object"}) {
        float scale = random.next() % 2 ? 2.0f : 0.5f;
        std::string stem = "space:" + std::string(space);
        for (char row = '0'; row < '3'; ++row) {
            auto shift = float(int(random.next() % 9) - 4) * 0.5f;
            auto set = [&](const char* direction, char column, float value) {
                setting.columns[stem + direction + row + column] = {value};
            };
            set(":to_current:", row, scale), set(":to_current:", '3', shift);
            set(":from_current:", row, 1 / scale), set(":from_current:", '3', -shift / scale);
        }
    }
}

using Shaders = std::vector<std::unique_ptr<Shader>>;

// Displacements and the surface that shows what they leave.
bool is_stack(const Shaders& shaders) {
    for (auto& shader : shaders)
        if (shader->kind !=
            (&shader == &shaders.back() ? ShaderKind::Surface : ShaderKind::Displacement))
            return false;
    return shaders.size() > 1;
}

// What is compared: the last shader, below it the displacements of a stack.
std::vector<Layer> layers_of(const Shaders& shaders, const std::vector<ParamBinding>& params) {
    std::vector<Layer> layers;
    for (auto& shader : shaders)
        if (is_stack(shaders) || &shader == &shaders.back())
            layers.push_back({shader.get(), params});
    return layers;
}

Setting setting_of(const Shaders& shaders, uint64_t world) {
    const Shader& shader = *shaders.back();
    Setting setting;
    setting.points = 1 + world % 37;
    Random random{world * 7919 + 3};
    setting.columns = random_point(world * 31 + 5, setting.points);
    std::vector<Layer> layers = layers_of(shaders, {});
    for (size_t k = 0; k < layers.size(); ++k) {
        for (const ShaderParameter& p : layers[k].shader->parameters)
            bind_parameter(p, k, random, setting);
        for (const VertexRequest& request : layers[k].shader->vertex_requests)
            bind_request(request, k, random, setting);
        for (const NamedOutput& output : layers[k].shader->named_outputs)
            want_output(output, setting);
    }
    add_spaces(random, setting);
    setting.columns["camera:near"] = {0.5f}, setting.columns["camera:far"] = {100};
    setting.options.want_N = shader.kind != ShaderKind::Light;
    setting.options.want_P = shader.kind == ShaderKind::Displacement ||
                             shader.kind == ShaderKind::Transformation;  // as these leave it
    return setting;
}

// An output that is named at run time is 0 where the point names it not.
double value_of(const ReferenceResult& result, const std::string& name) {
    auto found = result.values.find(name);
    return found == result.values.end() && name.starts_with("aov:") ? 0 : result.values.at(name);
}

// How far the value at one point may be from the exact one; negative: not to be compared.
struct Allowance {
    std::map<std::string, double> by_output;
    bool decided = true;
};

// Nearby inputs and float arithmetic on them, from the point itself on.
Allowance allowance(std::span<const Layer> layers, const ReferenceInputs& inputs,
                    const ReferenceResult& exact, const ReferenceResult& single) {
    Allowance result;
    auto note = [&](const ReferenceResult& a, const ReferenceResult& b) {
        result.decided =
            result.decided && a.decisions == exact.decisions && b.decisions == exact.decisions;
        for (auto& [name, value] : a.values) {
            double moved = std::fabs(value - value_of(b, name));
            double& most = result.by_output[name];
            most = std::isnan(moved) ? 1e300 : std::max(most, moved);
        }
    };
    note(exact, single);
    Random random{17};
    for (int k = 0; k < 5 && result.decided; ++k) {
        ReferenceInputs moved = inputs;
        moved.jitter = 1000 * uint64_t(k + 1);
        for (auto& [name, value] : moved.values)
            if (name != "rng" && std::fabs(value) < 1e30)
                value = double(float(value * (1 + double(random.uniform(-1, 1)) * 0x1p-22)));
        ReferenceResult near = run_reference<double>(layers, moved);
        note(near, exact);
        note(near, run_reference<float>(layers, moved));
    }
    return result;
}

bool extreme(double value) {
    return !(std::fabs(value) < 1e30);
}

std::string text_of(const std::string& name, size_t point, double got, double single, double exact,
                    double allowed) {
    char text[300];
    std::snprintf(text, sizeof text,
                  "reference: output %s at point %zu: got %.9g, float reference %.9g, exactly "
                  "%.17g, allowed %.3g",
                  name.c_str(), point, got, single, exact, allowed);
    return text;
}

// One point of interp against the reference.
std::string compare_point(std::span<const Layer> layers, const ReferenceInputs& inputs, size_t i,
                          const std::map<std::string, std::vector<float>>& got,
                          DifferenceCounts& counts) {
    ReferenceResult exact = run_reference<double>(layers, inputs);
    ReferenceResult single = run_reference<float>(layers, inputs);
    if (!exact.missing.empty()) return counts.no_reference += got.size(), "";
    if (exact.too_long || single.too_long) return counts.undecided += got.size(), "";
    if (exact.decisions != single.decisions) return counts.undecided += got.size(), "";
    Allowance near;  // found when first needed
    for (auto& [name, column] : got) {
        double want = value_of(exact, name), plain = value_of(single, name);
        bool flag = name.find(":lit") != std::string::npos;
        double have = flag ? double(std::bit_cast<int32_t>(column[i]) != 0) : double(column[i]);
        double most = kFloor * (1 + std::fabs(want));
        if (extreme(want) || extreme(plain)) {
            ++counts.extreme;
        } else if (std::fabs(have - want) <= most) {
            ++counts.values;
        } else {
            if (near.by_output.empty()) near = allowance(layers, inputs, exact, single);
            double moved = near.by_output[name];
            if (!near.decided) {
                ++counts.undecided;
            } else if (kFactor * moved > kUnstable * (1 + std::fabs(want))) {
                ++counts.unstable;
            } else if (std::fabs(have - want) <= most + kFactor * moved) {
                ++counts.values;
            } else {
                return text_of(name, i, have, plain, want, most + kFactor * moved);
            }
        }
    }
    return "";
}

std::string against_reference(RunShader& run, const Setting& setting,
                              const std::vector<ReferenceLight>& lights, DifferenceCounts& counts) {
    auto got = run.run(int(setting.points));
    std::vector<Layer> layers = layers_of(run.shaders, setting.params);
    for (size_t i = 0; i < std::min(setting.points, kReferencePoints); ++i) {
        ReferenceInputs inputs = at_point(setting.columns, {"rng"}, i);
        inputs.lights = lights;
        inputs.service = reference_service;
        inputs.loop_budget = run.lowered.module.loop_budget;
        inputs.statement_budget = kStatementBudget;
        std::string wrong = compare_point(layers, inputs, i, got, counts);
        if (!wrong.empty()) return wrong;
    }
    return "";
}

}  // namespace

std::string target_difference(RunShader& run, size_t points, DifferenceCounts& counts) {
    auto want = run.run(int(points));
    int want_faults = run.faults;
    uint64_t want_told = run.told;
    for (auto& [name, column] : want)
        for (float x : column) {
            uint64_t bits = std::isnan(x) ? 0x7fc00000u : std::bit_cast<uint32_t>(x);
            counts.digest = (counts.digest ^ bits) * 0x9e3779b97f4a7c15u;
            counts.digest ^= counts.digest >> 29;
        }
    for (const jit::Target& target : jit::targets()) {
        if (!target.supported() || std::string_view(target.name) == "interp") continue;
        run.kernels = jit::compile(run.lowered.module, {&target, nullptr});
        auto got = run.run(int(points));
        if (run.faults != want_faults) return std::string(target.name) + ": faults differ";
        if (run.told != want_told)
            return std::string(target.name) + ": services are told other things";
        for (auto& [name, column] : want)
            for (size_t i = 0; i < column.size(); ++i, ++counts.bits) {
                if (same_bits(column[i], got.at(name)[i])) continue;
                char text[200];
                std::snprintf(text, sizeof text, "%s: output %s at point %zu: %.9g, interp %.9g",
                              target.name, name.c_str(), i, double(got.at(name)[i]),
                              double(column[i]));
                return text;
            }
    }
    return "";
}

namespace {

// The shader, then its co-shaders; views of the text.
std::vector<LinkedSource> parts_of(std::string_view text) {
    constexpr std::string_view kMark = "\n//// ";
    std::vector<LinkedSource> parts;
    for (std::string handle;;) {
        size_t end = std::min(text.find(kMark), text.size());
        parts.push_back({handle, {text.substr(0, end), {}}, "", {}});
        if (end == text.size()) return parts;
        text.remove_prefix(end + kMark.size());
        handle = text.substr(0, text.find('\n'));
        text.remove_prefix(handle.size());
    }
}

Shaders compiled(const std::string& source, Diagnostics& diagnostics) {
    std::vector<LinkedSource> parts = parts_of(source);
    for (LinkedSource& part : parts) {
        part.source.map.file =
            diagnostics.files.add(part.handle + "fuzz.sl", std::string(part.source.text));
        part.source.map.segments = {{0, 0}};
    }
    if (parts.size() == 1) return compile(parts[0].source, {}, diagnostics);
    Shaders shaders;
    if (auto linked = compile_linked(parts, {}, diagnostics)) shaders.push_back(std::move(linked));
    return shaders;
}

RunShader run_of(const std::string& source, bool stack, const LowerOptions& options,
                 const std::vector<ParamBinding>& params) {
    std::vector<LinkedSource> parts = parts_of(source);
    if (parts.size() > 1) return RunShader(parts, options, params);
    return RunShader(source, options, params, stack);
}

}  // namespace

std::string shader_difference(const std::string& source, uint64_t world, DifferenceCounts& counts) {
    ++counts.shaders;
    // Compiled once for the parameters' names, then with all outputs.
    Diagnostics diagnostics;
    Shaders shaders = compiled(source, diagnostics);
    auto reject = [&](std::string why) {
        if (counts.rejected++ == 0) counts.first_rejection = why + "\n" + source;
        return "";
    };
    if (shaders.empty())
        return reject(diagnostics.findings().empty()
                          ? "no finding"
                          : format_finding(diagnostics.findings()[0], diagnostics.files));
    Setting setting = setting_of(shaders, world);
    setting.options.loop_budget = kLoopBudget;
    RunShader run = run_of(source, is_stack(shaders), setting.options, setting.params);
    if (!run.verdict.empty()) return "verify: " + run.verdict;
    if (!run.ok()) return reject(run.findings());
    ReferenceInputs shared;
    add_lights(run, shared);
    add_services(run);
    run.inputs = setting.columns;
    std::string wrong = against_reference(run, setting, shared.lights, counts);
    if (wrong.empty()) wrong = target_difference(run, setting.points, counts);
    if (wrong.empty()) wrong = emission_difference(run.lowered.module);
    if (counts.shaders % 64 == 0) jit::clear_cache();
    return wrong;
}

std::string emission_difference(const jit::Module& lowered) {
    jit::Module first = lowered, second = lowered, frame, same_frame;
    jit::optimize(first, &frame);
    jit::optimize(second, &same_frame);
    if (jit::print(first) != jit::print(second) || jit::print(frame) != jit::print(same_frame))
        return "optimize twice gives two modules";
    for (const jit::Target& target : jit::targets()) {
        if (!target.supported() || std::string_view(target.name) == "interp") continue;
        for (const jit::Module* module : {&first, &frame}) {
            auto a = target.emit(*module, nullptr), b = target.emit(*module, nullptr);
            if (!a || !b) return std::string(target.name) + ": no executable memory";
            if (a->machine_code.empty())
                return std::string(target.name) + ": a kernel without code";
            if (a->machine_code.size() != b->machine_code.size() ||
                std::memcmp(a->machine_code.data(), b->machine_code.data(),
                            a->machine_code.size()) != 0)
                return std::string(target.name) + ": compiling twice gives different bytes";
        }
    }
    return "";
}

}  // namespace kinora::rsl
