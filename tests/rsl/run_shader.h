// tests/rsl/run_shader.h: compiles shader source and runs it on a few points: what the tests of the
// language and of its programs share.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "jit/compiler.h"
#include "jit/ir/kernel_call.h"
#include "rsl/compile.h"
#include "rsl/link.h"
#include "rsl/lower/lower.h"
#include "rsl/model/kernel_keys.h"
#include "rsl/model/service_table.h"
#include "rsl/model/string_functions.h"
#include "runtime/base/arena.h"

namespace kinora::rsl {

// One light's answer, the same for all points unless columns are given.
struct TestLight {
    LightKind kind = kLightIlluminate;
    float L[3] = {0, 0, 1};
    float Cl[3] = {1, 1, 1};
    float Ol[3] = {1, 1, 1};
    int lit = 1;
    uint32_t categories = 0;  // bits by LoweredShader::categories
    float nondiffuse = 0;
    float nonspecular = 0;
    std::vector<float> messages = {};  // components in the order of LoweredShader::light_messages
    // If given: the first kLightMessages columns (LightColumn), a value a point, in place of L to
    // lit.
    std::vector<std::vector<float>> columns = {};
};

// A stack of shaders from source text to outputs. Inputs are named as kernel_keys.h says and 0
// unless set; spaces are the identity. Services that a shader calls are looked up in `services`.
class RunShader {
  public:
    // Compiles every shader of the source and lowers the last one, or with `stack` all in order.
    explicit RunShader(const std::string& source, LowerOptions options = {},
                       std::vector<ParamBinding> params = {}, bool stack = false,
                       const char* target = "interp") {
        ShaderSource text{source, {}};
        text.map.file = diagnostics.files.add("test.sl", source);
        text.map.segments = {{0, 0}};
        shaders = compile(text, {}, diagnostics);
        build(options, params, stack, target);
    }
    // A shader and its co-shaders as one shader.
    explicit RunShader(const std::vector<LinkedSource>& sources, LowerOptions options = {},
                       std::vector<ParamBinding> params = {}, const char* target = "interp") {
        std::vector<LinkedSource> located = sources;
        for (LinkedSource& one : located) {
            one.source.map.file =
                diagnostics.files.add(one.handle + ".sl", std::string(one.source.text));
            one.source.map.segments = {{0, 0}};
        }
        if (auto linked = compile_linked(located, {}, diagnostics))
            shaders.push_back(std::move(linked));
        build(options, params, false, target);
    }

    bool ok() const { return kernels.point != nullptr; }
    void set_services(const ServiceTable& table) {
        for (Service service : kServices) services[service] = table[service];
    }
    // All findings, as a user sees them.
    std::string findings() const {
        std::string all = verdict;
        for (const Finding& f : diagnostics.findings()) all += format_finding(f, diagnostics.files);
        return all;
    }

    void set(const std::string& name, std::vector<float> points) { inputs[name] = points; }
    void set(const std::string& name, float value) { inputs[name] = {value}; }
    void set3(const std::string& name, float x, float y, float z, const char* parts = "xyz") {
        const float values[] = {x, y, z};
        for (int c = 0; c < 3; ++c) set(name + "." + parts[c], values[c]);
    }
    void set_int(const std::string& name, int32_t value) { set(name, std::bit_cast<float>(value)); }

    // Runs `count` points; outputs by name.
    std::map<std::string, std::vector<float>> run(int count = 1) {
        arena.reset();
        faults = 0, told = 0;
        std::vector<float> frame;
        if (kernels.frame) frame = run_kernel(*kernels.frame, 1, {}, {});
        const jit::RecordSet records[] = {light_records(), {}};  // kNoRecords: what a gather finds
        std::vector<float> flat = run_kernel(*kernels.point, count, frame, records);
        std::map<std::string, std::vector<float>> result;
        for (size_t k = 0; k < kernels.point->outputs.size(); ++k)
            result[kernels.point->outputs[k].name] = {flat.begin() + long(k) * count,
                                                      flat.begin() + long(k + 1) * count};
        return result;
    }
    // One output at one point.
    float value(const std::string& name) {
        auto all = run(1);
        return all.count(name) ? all[name][0] : std::nanf("");
    }

    Diagnostics diagnostics;
    std::vector<std::unique_ptr<Shader>> shaders;
    LoweredShader lowered;
    std::string verdict;  // of jit::verify: "" when well formed
    jit::KernelPair kernels;
    std::map<std::string, std::vector<float>> inputs;
    std::vector<TestLight> lights;
    std::map<Service, jit::ServiceFn> services;
    static constexpr int32_t kNoRecords = 1;  // the handle of a record set without records
    int faults = 0;  // sites that reported in the last run, of the frame kernel too
    // For services with effects, which get this RunShader as their grid: a hash of all they were
    // told in the last run.
    uint64_t told = 0;

  private:
    void build(const LowerOptions& options, const std::vector<ParamBinding>& params, bool stack,
               const char* target) {
        if (shaders.empty()) return;
        std::vector<Layer> layers;
        for (auto& shader : shaders)
            if (stack || &shader == &shaders.back()) layers.push_back({shader.get(), params});
        std::optional<LoweredShader> result = lower(layers, options, diagnostics);
        if (!result) return;
        lowered = std::move(*result);
        verdict = jit::verify(lowered.module);
        if (!verdict.empty()) return;
        kernels = jit::compile(lowered.module, {jit::find_target(target), nullptr});
    }

    static constexpr size_t kMessages = 64;  // numbers that lightsource() may ask for

    float* column(float value, int count) {
        float* data = arena.allocate_span<float>(jit::padded(size_t(count))).data();
        std::fill_n(data, jit::padded(size_t(count)), value);
        return data;
    }

    const float* column_of(const std::vector<float>& points) {
        float* data = column(points.back(), 256);
        std::copy_n(points.begin(), std::min<size_t>(points.size(), 256), data);
        return data;
    }

    // Spaces are the identity; "1" is 1.
    static float missing(const KernelKey& key) {
        bool diagonal = key.is_space() && key.row() == key.column();
        return key.kind == KeyKind::One || diagonal ? 1 : 0;
    }

    const float* input_column(const jit::InputInfo& input, int count) {
        auto found = inputs.find(input.name);
        if (found == inputs.end()) return column(missing(key_of(input)), count);
        const std::vector<float>& points = found->second;
        float* data = column(points.back(), count);
        if (points.size() > 1)
            std::copy_n(points.begin(), std::min(points.size(), size_t(count)), data);
        return data;
    }

    jit::RecordSet light_records() {
        auto list = arena.allocate_span<jit::Record>(lights.size());
        for (size_t k = 0; k < lights.size(); ++k) {
            const TestLight& light = lights[k];
            auto columns = arena.allocate_span<const float*>(kLightMessages + kMessages);
            for (size_t c = 0; c < 3; ++c) {
                columns[kLightL + c] = column(light.L[c], 256);
                columns[kLightCl + c] = column(light.Cl[c], 256);
                columns[kLightOl + c] = column(light.Ol[c], 256);
            }
            columns[kLightLit] = column(std::bit_cast<float>(light.lit), 256);
            columns[kLightDensity] = column(0, 256);
            for (size_t c = 0; c < 3; ++c)
                columns[kLightBare + c] = column(light.Cl[c], 256);  // nothing shadows it
            for (size_t c = 0; c < light.columns.size(); ++c)
                columns[c] = column_of(light.columns[c]);
            for (size_t c = 0; c < kMessages; ++c)
                columns[kLightMessages + c] =
                    column(c < light.messages.size() ? light.messages[c] : 0, 256);
            auto uniforms = arena.allocate_span<float>(kLightUniforms + kMessages);
            uniforms[kLightKind] = std::bit_cast<float>(int(light.kind));
            uniforms[kLightCategories] = std::bit_cast<float>(light.categories);
            uniforms[kLightNondiffuse] = light.nondiffuse;
            uniforms[kLightNonspecular] = light.nonspecular;
            uniforms[kLightNumber] = std::bit_cast<float>(int32_t(k));
            uniforms[kLightHandle] = std::bit_cast<float>(int32_t(k));
            uniforms[kLightSampled] = 0;
            for (size_t c = 0; c < kMessages; ++c)
                uniforms[kLightUniforms + c] = std::bit_cast<float>(light.messages.empty() ? 0 : 1);
            list[k] = {columns.data(), uniforms.data()};
        }
        return {int32_t(lights.size()), list.data()};
    }

    jit::ServiceFn function_of(const std::string& name) const {
        Service service = find_service(name).value();
        auto given = services.find(service);
        jit::ServiceFn function = given != services.end() ? given->second : string_service(service);
        if (!function) {
            fprintf(stderr, "the test gives no service '%s'\n", name.c_str());
            abort();
        }
        return function;
    }

    std::vector<float> run_kernel(const jit::Kernel& kernel, int count,
                                  std::span<const float> frame,
                                  std::span<const jit::RecordSet> records) {
        auto in = arena.allocate_span<const float*>(kernel.inputs.size());
        for (size_t k = 0; k < kernel.inputs.size(); ++k)
            in[k] = input_column(kernel.inputs[k], count);
        auto outs = arena.allocate_span<float*>(kernel.outputs.size());
        for (size_t k = 0; k < kernel.outputs.size(); ++k) outs[k] = column(0, count);
        auto functions = arena.allocate_span<jit::ServiceFn>(kernel.services.size());
        for (size_t k = 0; k < kernel.services.size(); ++k)
            functions[k] = function_of(kernel.services[k].name);
        auto reported = arena.allocate_span<uint8_t>(kernel.fault_sites.size());
        std::fill(reported.begin(), reported.end(), uint8_t(0));
        jit::KernelCall{.kernel = kernel,
                        .count = size_t(count),
                        .in = in,
                        .out = outs,
                        .row_floats = jit::padded(size_t(count)),
                        .frame = frame,
                        .scratch = arena.allocate_span<std::byte>(kernel.scratch_bytes),
                        .faults = reported,
                        .services = functions,
                        .record_sets = records,
                        .host = this}
            .run();
        faults += int(std::count(reported.begin(), reported.end(), uint8_t(1)));
        std::vector<float> flat;
        for (size_t k = 0; k < kernel.outputs.size(); ++k)
            flat.insert(flat.end(), outs[k], outs[k] + count);
        return flat;
    }

    Arena arena;
};

// A float expression's value in a surface shader, with the declarations in `setup` before it.
inline float evaluate(const std::string& expression, const std::string& setup = "") {
    RunShader shader("surface t() { " + setup + " Ci = color(float(" + expression + ")); }");
    if (!shader.ok()) {
        fprintf(stderr, "%s", shader.findings().c_str());
        return std::nanf("");
    }
    return shader.value("Ci.r");
}

}  // namespace kinora::rsl
