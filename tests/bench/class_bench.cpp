// tests/bench/class_bench.cpp: what classes and co-shaders cost, and what opacity first saves.
// Fast tier, one thread, CPU time; both sides of a row take turns, and the best of each counts.
//
//   skip/class   a leaf of which a quarter shows: with opacity(), against the same in surface()
//   skip/1.x     a 1.x surface with LowerOptions::skip_transparent, against without
//   members      a pattern that displacement() keeps in a member for opacity() and surface(),
//   against
//                methods that each compute it from the point before it is moved
//   co-shaders   a material of five co-shaders against the same as one shader by hand; `ms` is
//                source to code of the five
// `ratio` is the first side's time divided by the second's.
#include <benchmark/benchmark.h>

#include "jit/target.h"
#include "rsl/link.h"
#include "tests/bench/shade_kernels.h"

namespace kinora {
namespace {

constexpr size_t kPointsInAll = 65536, kGrid = 1024;

// Costly, and a quarter of it shows: strips along x in which whole groups of lanes agree.
const std::string kPattern =
    "color pattern(point q) { color sum = 0; uniform float k; for (k = 1; k < 9; k += 1)\n"
    "sum += color noise(q * k * 2.7) / k; return sum; }\n"
    "float cut(point q) { return mod(floor(xcomp(q) * 2), 4) == 0 ? 1 : 0; }\n";
const std::string kLeafFirst =
    kPattern +
    "class leaf() { public void opacity(output color Oi) { Oi = cut(P); }\n"
    "public void surface(output color Ci, Oi) { Ci = Oi * pattern(P); } }";
const std::string kLeafLast = kPattern +
                              "class leaf() { public void surface(output color Ci, Oi) {\n"
                              "color c = pattern(P); Oi = cut(P); Ci = Oi * c; } }";
const std::string kLeaf1 =
    kPattern + "surface leaf() { color c = pattern(P); Oi = cut(P); Ci = Oi * c; }";

const std::string kMember =
    kPattern +
    "class crust() { color m_pattern = 0; public void displacement(output point P; output normal "
    "N) {\n"
    "m_pattern = pattern(P); P += 0.01 * m_pattern[0] * normalize(N); }\n"
    "public void opacity(output color Oi) { Oi = step(0.2, m_pattern[1]); }\n"
    "public void surface(output color Ci, Oi) { Ci = Oi * m_pattern; } }";
// By a place of its own each time, as shaders without members have to.
const std::string kNoMember =
    kPattern +
    "class crust() { point m_at = 0; public void displacement(output point P; output normal N) {\n"
    "m_at = P; P += 0.01 * comp(pattern(P), 0) * normalize(N); }\n"
    "public void opacity(output color Oi) { Oi = step(0.2, comp(pattern(m_at + 0 * P), 1)); }\n"
    "public void surface(output color Ci, Oi) { Ci = Oi * pattern(m_at - 0 * P); } }";

struct Part {
    const char *handle, *text;
    rsl::LinkTexts texts = {};
};
const Part kFive[] = {
    {"",
     "class layered(shader base = null; shader coat = null; string dirt = \"dirt\";) {\n"
     "shader m_dirt; public void construct() { m_dirt = getshader(dirt); }\n"
     "public void surface(output color Ci, Oi) { color c = 0; if (base != null) base->tint(c);\n"
     "if (m_dirt != null) m_dirt->cover(c); if (coat != null) coat->over(c); Ci = c; Oi = 1; } }",
     {{"base", {"clay"}}, {"coat", {"varnish"}}}},
    {"clay",
     "class clay(shader pattern = null; color tone = color(0.5, 0.25, 0.125);) {\n"
     "public void tint(output color c) { c = tone * (1 + pattern->value(P)); } }",
     {{"pattern", {"waves"}}}},
    {"waves",
     "class waves(float scale = 3; shader ramp = getshader(\"ramp\");) {\n"
     "public float value(point q) { return ramp->map(sin(xcomp(q) * scale) * noise(q)); } }"},
    {"ramp",
     "class ramp(float gain = 2;) { public float map(float x) { return x * gain + noise(x); } }"},
    {"dirt",
     "class dirt(float amount = 0.25;) { public void cover(output color c) {\n"
     "float f = amount * noise(P * 7); c = mix(c, color 0, f); } }"},
    {"varnish",
     "class varnish(float gloss = 8;) { float m_weight; public void begin() {\n"
     "m_weight = pow(1 - abs(normalize(N) . normalize(I)), gloss); }\n"
     "public void over(output color c) { c += m_weight; } }"}};
const std::string kByHand =
    "surface by_hand(color tone = color(0.5, 0.25, 0.125); float scale = 3, gain = 2,\n"
    "amount = 0.25, gloss = 8;) {\n"
    "float weight = pow(1 - abs(normalize(N) . normalize(I)), gloss);\n"
    "float x = sin(xcomp(P) * scale) * noise(P); float ramp = x * gain + noise(x);\n"
    "color c = tone * (1 + ramp); float f = amount * noise(P * 7); c = mix(c, color 0, f);\n"
    "c += weight; Ci = c; Oi = 1; }";

std::unique_ptr<rsl::Shader> link_five(Diagnostics& diagnostics) {
    std::vector<rsl::LinkedSource> sources;
    for (const Part& part : kFive) {
        rsl::LinkedSource one{part.handle, {part.text, {}}, "", part.texts};
        one.source.map.file = diagnostics.files.add(part.handle, part.text);
        one.source.map.segments = {{0, 0}};
        sources.push_back(one);
    }
    auto linked = rsl::compile_linked(sources, {}, diagnostics);
    CHECK(linked != nullptr);
    return linked;
}

std::unique_ptr<Compiled> kernels_of(std::unique_ptr<rsl::Shader> shader, bool skip) {
    auto result = std::make_unique<Compiled>();
    result->shader = std::move(shader);
    result->layer.shader = result->shader.get();
    rsl::LowerOptions options;
    options.math = jit::math::Tier::Fast;
    options.skip_transparent = skip;
    auto lowered = rsl::lower(std::span(&result->layer, 1), options, result->diagnostics);
    CHECK(lowered.has_value());
    result->lowered = std::move(*lowered);
    result->kernels = jit::compile(result->lowered.module, {&jit::best_target(), nullptr});
    result->frame = frame_block(*result);
    return result;
}

std::unique_ptr<Compiled> kernels_of(const std::string& text, bool skip) {
    Diagnostics diagnostics;
    return kernels_of(front_end(text, diagnostics), skip);
}

void against(benchmark::State& state, const Compiled& one, const Compiled& other) {
    Points points(kPointsInAll);
    Run runs[] = {{one, points, kGrid}, {other, points, kGrid}};
    double best[] = {1e30, 1e30};
    for (auto _ : state)
        for (size_t side = 0; side < 2; ++side) {
            double start = cpu_seconds();
            for (size_t g = 0; g < runs[side].grids(); ++g) runs[side].run(g);
            best[side] = std::min(best[side], cpu_seconds() - start);
        }
    float differs = 0;
    for (const char* name : {"Ci.r", "Ci.g", "Ci.b", "Oi.r"})
        for (size_t i = 0; i < kPointsInAll; ++i)
            differs = std::max(differs, std::abs(runs[0].out[name][i] - runs[1].out[name][i]));
    state.counters["differs"] = double(differs);
    state.counters["ratio"] = best[0] / best[1];
}

void co_shaders(benchmark::State& state) {
    Diagnostics diagnostics;
    double least = 1e30;
    for (int turn = 0; turn < 20; ++turn) {
        jit::clear_cache();
        double start = cpu_seconds();
        kernels_of(link_five(diagnostics), true);
        least = std::min(least, cpu_seconds() - start);
    }
    against(state, *kernels_of(link_five(diagnostics), true), *kernels_of(kByHand, true));
    state.counters["ms"] = least * 1e3;
}

void skip_class(benchmark::State& state) {
    against(state, *kernels_of(kLeafFirst, false), *kernels_of(kLeafLast, false));
}
void skip_1x(benchmark::State& state) {
    against(state, *kernels_of(kLeaf1, true), *kernels_of(kLeaf1, false));
}

void members(benchmark::State& state) {
    against(state, *kernels_of(kMember, false), *kernels_of(kNoMember, false));
}

BENCHMARK(skip_class)->Name("skip/class");
BENCHMARK(skip_1x)->Name("skip/1.x");
BENCHMARK(members)->Name("members");
BENCHMARK(co_shaders)->Name("co-shaders");

}  // namespace
}  // namespace kinora

BENCHMARK_MAIN();
