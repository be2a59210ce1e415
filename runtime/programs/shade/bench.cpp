// runtime/programs/shade/bench.cpp: what compiling costs and how fast the code runs.
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "runtime/base/stats.h"
#include "runtime/picture/trade/front.h"
#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/shade/kernel.h"

namespace kinora {

namespace {

constexpr int kCompiles = 20;  // after the cold one; medians are told
constexpr int kRuns = 11;

// One compilation from source to callable code, in ms.
struct CompileTimes {
    double front = 0, lower = 0, optimise = 0, emit = 0;
    double total() const { return front + lower + optimise + emit; }
};

CompileTimes compile_once(const ShadeOptions& options, const ShadeSource& source,
                          const Patch& patch, const jit::Target& target, int& code) {
    CompileTimes times;
    ShadeSource copy;
    copy.text = source.text;
    copy.params = source.params;
    copy.diagnostics.files = source.diagnostics.files;
    copy.map.file = copy.diagnostics.files.add("bench", source.text);
    Stopwatch watch;
    const rsl::Shader* compiled = choose_shader(options, source);
    if (compiled && !compiled->parts.empty())
        copy.shaders.push_back(rsl::compile_linked(rsl::sources_of(compiled->parts),
                                                   options.compile, copy.diagnostics));
    else
        copy.shaders = rsl::compile(copy.view(), options.compile, copy.diagnostics);
    times.front = watch.restart();
    const rsl::Shader* shader = copy.shaders.empty() ? nullptr : choose_shader(options, copy);
    ShadeStack stack;
    code = shader ? bind_stack(options, copy, *shader, patch, stack) : int(kExitShader);
    if (code) return times;
    ShadeKernel kernel;
    if (!kernel.compile(stack, &target, copy.diagnostics)) {
        copy.print_findings(options);
        code = kExitShader;
        return times;
    }
    times.lower = kernel.lower_ms;
    times.optimise = kernel.pair().optimize_ms;
    times.emit = kernel.pair().emit_ms;
    return times;
}

// What one target gives.
struct TargetTimes {
    CompileTimes first, middle;
    double mpoints = 0, best_mpoints = 0;  // points/s * 1e-6: of the median and of the best run
    size_t points = 0, code_bytes = 0;
};

int bench_compile(const ShadeOptions& options, const ShadeSource& source, const Patch& patch,
                  const jit::Target& target, TargetTimes& times) {
    int code = 0;
    std::vector<CompileTimes> warm;
    int count = options.iterations ? options.iterations : kCompiles;
    for (int i = 0; i <= count; ++i) {
        jit::clear_cache();
        CompileTimes one = compile_once(options, source, patch, target, code);
        if (code) return code;
        if (i == 0)
            times.first = one;
        else
            warm.push_back(one);
    }
    auto middle = [&](double CompileTimes::*part) {
        std::vector<double> values;
        for (const CompileTimes& t : warm) values.push_back(t.*part);
        return median_interval(values).median;
    };
    times.middle = {middle(&CompileTimes::front), middle(&CompileTimes::lower),
                    middle(&CompileTimes::optimise), middle(&CompileTimes::emit)};
    return kExitOk;
}

void bench_run(const ShadeOptions& options, const ShadeStack& stack, const Patch& patch,
               const jit::Target& target, Diagnostics& diagnostics, TargetTimes& times) {
    ShadeKernel kernel;
    if (!kernel.compile(stack, &target, diagnostics)) return;
    kernel.bind(stack, patch);
    kernel.run();
    std::vector<double> ms;
    for (int i = 0; i < (options.iterations ? options.iterations : kRuns); ++i) {
        Stopwatch watch;
        kernel.run();
        ms.push_back(watch.ms());
    }
    double points = double(patch.count()) * 1e-3;  // Mpoints/s = points / ms * 1e-3
    times.mpoints = points / median_interval(ms).median;
    times.best_mpoints = points / *std::min_element(ms.begin(), ms.end());
    times.points = patch.count();
    times.code_bytes = kernel.pair().point->code_bytes;
}

void print_row(const char* label, const CompileTimes& t) {
    std::printf("  %-6s %8.3f %8.3f %8.3f %8.3f %8.3f\n", label, t.front, t.lower, t.optimise,
                t.emit, t.total());
}

void print_times(const jit::Target& target, const TargetTimes& times) {
    std::printf("%s: ms     front    lower   passes     emit    total\n", target.name);
    print_row("first", times.first);
    print_row("median", times.middle);
    std::printf("  runs at %.2f Mpoints/s (best %.2f), %zu points, %zu bytes of code\n",
                times.mpoints, times.best_mpoints, times.points, times.code_bytes);
}

nlohmann::ordered_json json_of(const CompileTimes& t) {
    return {{"front_ms", t.front},
            {"lower_ms", t.lower},
            {"passes_ms", t.optimise},
            {"emit_ms", t.emit},
            {"total_ms", t.total()}};
}

nlohmann::ordered_json json_of(const jit::Target& target, const TargetTimes& times) {
    return {{"target", target.name},
            {"lanes", target.lanes},
            {"first", json_of(times.first)},
            {"median", json_of(times.middle)},
            {"mpoints_per_second", times.mpoints},
            {"best_mpoints_per_second", times.best_mpoints},
            {"points", times.points},
            {"code_bytes", times.code_bytes}};
}

}  // namespace

int shade_bench(const ShadeOptions& options) {
    ShadeSource source;
    Patch patch(options.width, options.height, options.sphere);
    ShadeStack stack;
    if (std::optional<int> code = open_stack(options, source, patch, stack)) return *code;
    const rsl::Shader* shader = stack.layers.front().shader;
    const char* kind = rsl::shader_kind_name(shader->kind);
    const char* math = options.math == jit::math::Tier::Fast ? "fast" : "precise";
    if (!options.json) std::printf("%s %s, %s, one thread\n", kind, shader->name.c_str(), math);
    auto rows = nlohmann::ordered_json::array();
    for (const jit::Target& target : jit::targets()) {
        if (!target.supported() || (options.target && options.target != &target)) continue;
        TargetTimes times;
        if (int code = bench_compile(options, source, patch, target, times)) return code;
        bench_run(options, stack, patch, target, source.diagnostics, times);
        if (options.json)
            rows.push_back(json_of(target, times));
        else
            print_times(target, times);
    }
    if (options.json) {
        nlohmann::ordered_json all{
            {"name", shader->name}, {"kind", kind}, {"math", math}, {"targets", std::move(rows)}};
        std::printf("%s\n", all.dump(2).c_str());
    }
    return kExitOk;
}

}  // namespace kinora
