// tests/bench/compile_bench.cpp: what it takes to make shaders into code, caches cleared, fast
// tier. compile/TARGET/SHADER rows: IR to code, and source text to code. compile/assets/TARGET:
// source text to code of every shader in assets (median, largest), and the largest kernel's bytes.
#include <benchmark/benchmark.h>

#include <filesystem>

#include "jit/target.h"
#include "tests/bench/shade_kernels.h"
#include "tests/folders.h"

namespace kinora {
namespace {

void ir_to_code(benchmark::State& state, const std::string& name, const jit::Target& target) {
    auto compiled = compile(name, target, false);
    double emit_ms = 0;
    for (auto _ : state) {
        jit::clear_cache();
        jit::KernelPair pair = jit::compile(compiled->lowered.module, {&target, nullptr});
        emit_ms += pair.emit_ms;
    }
    state.counters["emit_ms"] = emit_ms / double(state.iterations());
    state.counters["code_bytes"] = double(compiled->kernels.point->code_bytes);
}

void source_to_code(benchmark::State& state, const std::string& name, const jit::Target& target) {
    std::string text = shader_text(name);
    for (auto _ : state) {
        jit::clear_cache();
        Diagnostics diagnostics;
        auto shader = front_end(text, diagnostics);
        rsl::Layer layer{shader.get(), {}};
        jit::compile(lower_fast(layer, diagnostics).module, {&target, nullptr});
    }
}

// ---- all of assets ------------------------------------------------------------------------------

// What the front end, the passes and the emitter take for each shader of assets; the largest
// kernel.
void assets_to_code(benchmark::State& state, const jit::Target& target) {
    std::vector<std::string> texts;
    namespace fs = std::filesystem;
    for (auto& entry : fs::recursive_directory_iterator(project_folder() + "/assets/shaders")) {
        if (entry.path().extension() != ".sl") continue;
        std::stringstream text;
        text << std::ifstream(entry.path()).rdbuf();
        texts.push_back(text.str());
    }
    std::vector<double> best(texts.size(), 1e30);
    double largest_code = 0, largest_scratch = 0;
    for (auto _ : state)
        for (size_t k = 0; k < texts.size(); ++k) {
            jit::clear_cache();
            double start = cpu_seconds();
            Diagnostics diagnostics;
            rsl::ShaderSource source{texts[k], {}};
            source.map.file = diagnostics.files.add("bench.sl", texts[k]);
            source.map.segments = {{0, 0}};
            for (auto& shader : rsl::compile(source, {}, diagnostics)) {
                rsl::Layer layer{shader.get(), {}};
                rsl::LowerOptions options;
                options.math = jit::math::Tier::Fast;
                auto lowered = rsl::lower(std::span(&layer, 1), options, diagnostics);
                if (!lowered) continue;
                auto kernels = jit::compile(lowered->module, {&target, nullptr});
                largest_code = std::max(largest_code, double(kernels.point->code_bytes));
                largest_scratch = std::max(largest_scratch, double(kernels.point->scratch_bytes));
            }
            best[k] = std::min(best[k], (cpu_seconds() - start) * 1e3);
        }
    std::sort(best.begin(), best.end());
    state.counters["shaders"] = double(best.size());
    state.counters["median_ms"] = best[best.size() / 2];
    state.counters["largest_ms"] = best.back();
    state.counters["largest_code_bytes"] = largest_code;
    state.counters["largest_scratch_bytes"] = largest_scratch;
}

void register_rows() {
    for (const char* width : {"avx512", "avx2"}) {
        const jit::Target& target = *jit::find_target(width);
        if (!target.supported()) continue;
        auto add = [&](const std::string& name, auto run, benchmark::TimeUnit unit, auto... more) {
            benchmark::RegisterBenchmark(("compile/" + name).c_str(), run, more..., target)
                ->Unit(unit);
        };
        add(std::string("assets/") + width, assets_to_code, benchmark::kMillisecond);
        for (const char* shader : {"marble", "plastic", "wood", "fbm_ramp"}) {
            std::string stem = std::string(width) + "/" + shader;
            add(stem + "/ir_to_code", ir_to_code, benchmark::kMicrosecond, std::string(shader));
            add(stem + "/source_to_code", source_to_code, benchmark::kMicrosecond,
                std::string(shader));
        }
    }
}

}  // namespace
}  // namespace kinora

int main(int argc, char** argv) {
    kinora::register_rows();
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
