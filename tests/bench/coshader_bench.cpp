// tests/bench/coshader_bench.cpp: a material of five co-shaders against the same shading written by
// hand as one shader, both through the JIT. They take turns within a row, in CPU time of the best
// iteration: `ratio` is linked / by hand, and must be at most 1.10. `jit_ms` is the linked one's
// whole way from source to code, in the best of ten, and must be under 5. `differs` counts floats
// of Ci that are not the same bits.
#include <benchmark/benchmark.h>
#include <xmmintrin.h>

#include <bit>

#include "jit/target.h"
#include "rsl/link.h"
#include "tests/bench/shade_kernels.h"

namespace kinora {
namespace {

struct Part {
    const char *handle, *text;
    rsl::LinkTexts texts;
};
const Part kParts[] = {
    {"",
     "class layered(shader base = null; shader dirt = null; shader coat = null;) {\n"
     "public void surface(output color Ci, Oi) { point Q = transform(\"object\", P); color c = 0;\n"
     "base->tint(Q, c); dirt->cover(Q, c); coat->over(c); Ci = c; Oi = 1; } }",
     {{"base", {"clay"}}, {"dirt", {"dirt"}}, {"coat", {"varnish"}}}},
    {"clay",
     "class clay(shader pattern = getshader(\"waves\"); color tone = color(0.5, 0.25, 0.125);) {\n"
     "public void tint(point Q; output color c;) { c = tone * (1 + pattern->value(Q)); } }",
     {}},
    {"waves",
     "class waves(float scale = 3; shader ramp = getshader(\"ramp\");) {\n"
     "public float value(point Q) { float sum = 0, i;\n"
     "for (i = 1; i <= 4; i += 1) sum += float noise(scale * i * Q) / i;\n"
     "return ramp->map(sum); } }",
     {}},
    {"ramp",
     "class ramp(float gain = 2;) { public float map(float x) { return sin(x * gain) + x; } }",
     {}},
    {"dirt",
     "class dirt(float amount = 0.25;) { public void cover(point Q; output color c;) {\n"
     "float f = amount * float noise(7 * Q); c = mix(c, color 0, f); } }",
     {}},
    {"varnish",
     "class varnish(float gloss = 8;) { public void over(output color c) {\n"
     "vector V = -normalize(I); c += pow(abs(V . normalize(N)), gloss); } }",
     {}}};
const char* kByHand =
    "surface by_hand(color tone = color(0.5, 0.25, 0.125); float scale = 3, gain = 2,\n"
    "amount = 0.25, gloss = 8;) { point Q = transform(\"object\", P); float sum = 0, i;\n"
    "for (i = 1; i <= 4; i += 1) sum += float noise(scale * i * Q) / i;\n"
    "color c = tone * (1 + (sin(sum * gain) + sum)); float f = amount * float noise(7 * Q);\n"
    "c = mix(c, color 0, f); vector V = -normalize(I); c += pow(abs(V . normalize(N)), gloss);\n"
    "Ci = c; Oi = 1; }";

std::unique_ptr<rsl::Shader> link_parts(Diagnostics& diagnostics) {
    std::vector<rsl::LinkedSource> sources;
    for (const Part& part : kParts) {
        rsl::ShaderSource source{part.text, {}};
        source.map.file = diagnostics.files.add(std::string(part.handle) + ".sl", part.text);
        sources.push_back({part.handle, source, "", part.texts});
    }
    auto shader = rsl::compile_linked(sources, {}, diagnostics);
    CHECK(shader != nullptr);
    return shader;
}

std::unique_ptr<Compiled> compile_parts(const jit::Target& target) {
    auto result = std::make_unique<Compiled>();
    result->shader = link_parts(result->diagnostics);
    finish(*result, target, true);
    return result;
}

void co_shaders(benchmark::State& state, const char* name) {
    const jit::Target& target = *jit::find_target(name);
    size_t count = 4096, grid = 1024;
    Points points(count);
    auto linked = compile_parts(target);
    auto by_hand = std::make_unique<Compiled>();
    by_hand->shader = front_end(kByHand, by_hand->diagnostics);
    finish(*by_hand, target, true);
    Run one(*linked, points, grid), other(*by_hand, points, grid);
    _mm_setcsr(_mm_getcsr() | 0x8040);  // FTZ and DAZ, as around all fast kernels
    double linked_time = 1e30, hand_time = 1e30, jit_time = 1e30;
    for (int k = 0; k < 10; ++k) {
        double start = cpu_seconds();
        benchmark::DoNotOptimize(compile_parts(target));
        jit_time = std::min(jit_time, cpu_seconds() - start);
    }
    for (auto _ : state) {
        double start = cpu_seconds();
        for (int r = 0; r < 8; ++r)
            for (size_t g = 0; g < one.grids(); ++g) one.run(g);
        double middle = cpu_seconds();
        for (int r = 0; r < 8; ++r)
            for (size_t g = 0; g < other.grids(); ++g) other.run(g);
        double end = cpu_seconds();
        linked_time = std::min(linked_time, middle - start);
        hand_time = std::min(hand_time, end - middle);
        state.SetIterationTime(middle - start);
    }
    size_t differs = 0;
    for (const char* output : {"Ci.r", "Ci.g", "Ci.b"})
        for (size_t i = 0; i < count; ++i)
            differs += std::bit_cast<uint32_t>(one.out.at(output)[i]) !=
                       std::bit_cast<uint32_t>(other.out.at(output)[i]);
    state.counters["ratio"] = linked_time / hand_time;
    state.counters["jit_ms"] = jit_time * 1e3;
    state.counters["differs"] = double(differs);
}

void add_rows() {
    for (const char* name : {"avx512", "avx2"})
        if (const jit::Target* target = jit::find_target(name); target && target->supported())
            benchmark::RegisterBenchmark(
                (std::string(name) + "/five_co_shaders").c_str(),
                [name](benchmark::State& state) { co_shaders(state, name); })
                ->UseManualTime();
}

}  // namespace
}  // namespace kinora

int main(int argc, char** argv) {
    kinora::add_rows();
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
