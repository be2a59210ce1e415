// runtime/programs/kinora_shade_bench.cpp: what compiling costs and how fast the code runs.
#include <algorithm>
#include <cstdio>

#include "runtime/base/stats.h"
#include "runtime/programs/exit_codes.h"
#include "runtime/programs/kinora_shade_kernel.h"

namespace kinora {

namespace {

constexpr int kCompiles = 20;  // after the cold one; medians are told
constexpr int kRuns = 11;

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

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
    copy.map.file = copy.diagnostics.files.add("bench", source.text);
    Stopwatch watch;
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

void print_row(const char* label, const CompileTimes& t) {
    std::printf("  %-6s %8.3f %8.3f %8.3f %8.3f %8.3f\n", label, t.front, t.lower, t.optimise,
                t.emit, t.total());
}

int bench_compile(const ShadeOptions& options, const ShadeSource& source, const Patch& patch,
                  const jit::Target& target) {
    int code = 0;
    std::vector<CompileTimes> warm;
    int count = options.iterations ? options.iterations : kCompiles;
    for (int i = 0; i <= count; ++i) {
        jit::clear_cache();
        CompileTimes times = compile_once(options, source, patch, target, code);
        if (code) return code;
        if (i == 0) {
            std::printf("%s: ms     front    lower   passes     emit    total\n", target.name);
            print_row("first", times);
        } else {
            warm.push_back(times);
        }
    }
    auto middle = [&](double CompileTimes::*part) {
        std::vector<double> values;
        for (const CompileTimes& t : warm) values.push_back(t.*part);
        return median(values);
    };
    print_row("median", {middle(&CompileTimes::front), middle(&CompileTimes::lower),
                         middle(&CompileTimes::optimise), middle(&CompileTimes::emit)});
    return kExitOk;
}

void bench_run(const ShadeOptions& options, const ShadeStack& stack, const Patch& patch,
               const jit::Target& target, Diagnostics& diagnostics) {
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
    std::printf("  runs at %.2f Mpoints/s (best %.2f), %zu points, %zu bytes of code\n",
                points / median(ms), points / *std::min_element(ms.begin(), ms.end()),
                patch.count(), kernel.pair().point->code_bytes);
}

}  // namespace

int shade_bench(const ShadeOptions& options) {
    ShadeSource source;
    if (std::optional<int> code = compile_shade_source(options, source)) return *code;
    const rsl::Shader* shader = choose_shader(options, source);
    if (!shader) return kExitUsage;
    if (!can_run(*shader)) return kExitUsage;
    Patch patch(options.width, options.height, options.sphere);
    if (shader->kind == rsl::ShaderKind::Light) patch.place_light(options.flip);
    ShadeStack stack;
    if (int code = bind_stack(options, source, *shader, patch, stack)) return code;
    std::printf("%s %s, %s, one thread\n", rsl::shader_kind_name(shader->kind),
                shader->name.c_str(), options.math == jit::math::Tier::Fast ? "fast" : "precise");
    for (const jit::Target& target : jit::targets()) {
        if (!target.supported() || (options.target && options.target != &target)) continue;
        if (int code = bench_compile(options, source, patch, target)) return code;
        bench_run(options, stack, patch, target, source.diagnostics);
    }
    return kExitOk;
}

}  // namespace kinora
