// tests/bench/shade_bench.cpp: marble, plastic and wood of assets/shaders, and fbm_ramp.sl beside
// this file, through the JIT, against the same mathematics hand-written with intrinsics
// (hand_shaders.h). Fast tier, one thread.
//
// One row: TARGET/SHADER/KIND/points/grid. The points are shaded in grids of `grid`; code and data
// are warm. KIND:
//   surface  the surface alone, over light records (a distant and an ambient light) already filled
//   lit      the light kernels or functions fill the records, then the surface runs
//   bound    as surface, but every parameter that is not 0 or 1 is read from the frame block, as
//            when a scene sets it (the hand-written code keeps its constants)
// JIT and hand-written code take turns within one row, both in CPU time. `jit` and `hand` are
// Mpoints/s in the best iteration of each (others share their caches with whatever else runs),
// `ratio` is jit / hand. `differs` is the largest difference of Ci between the two.
// specular/*: plastic with Ks = 0 (its shape), with Ks = 0.5, and matte, which has no such term.
// divergent/*: a shader that takes one of four ways at random by point, against the sum of the four
// shaders that take one way each.
#include <benchmark/benchmark.h>
#include <xmmintrin.h>

#include "jit/target.h"
#include "tests/bench/hand_shaders.h"
#include "tests/bench/shade_kernels.h"

namespace kinora {
namespace {

// The light kernels and the records over their outputs.
class JitLights {
  public:
    JitLights(const jit::Target& target, const Points& points, size_t grid)
        : count_(grid),
          solar_(compile("distantlight", target, false)),
          ambient_(compile("ambientlight", target, false)),
          solar_run_(*solar_, points, grid),
          ambient_run_(*ambient_, points, grid) {
        size_t grids = points.count / grid;
        sets_.resize(grids);
        for (size_t g = 0; g < grids; ++g) {
            auto records = arena_.allocate_span<jit::Record>(2);
            records[0] = record(solar_run_, g, rsl::kLightSolar);
            records[1] = record(ambient_run_, g, rsl::kLightAmbient);
            sets_[g] = {2, records.data()};
        }
    }
    const jit::RecordSet* set(size_t g) const { return &sets_[g]; }
    void run(size_t g) {
        solar_run_.run(g);
        ambient_run_.run(g);
    }

  private:
    jit::Record record(Run& run, size_t g, int kind) {
        auto columns = arena_.allocate_span<const float*>(rsl::kLightMessages);
        // What is no output of the kernel is 0 everywhere, and lit is 1.
        const char* names[] = {"L.x",  "L.y",  "L.z", "Cl.r",    "Cl.g",   "Cl.b",   "Ol.r",
                               "Ol.g", "Ol.b", "lit", "density", "bare.r", "bare.g", "bare.b"};
        for (size_t k = 0; k < std::size(names); ++k) {
            auto output = run.out.find(std::string("light:0:") + names[k]);
            bool missing = output == run.out.end();
            columns[k] = missing ? constant(k == rsl::kLightLit) : output->second + g * count_;
        }
        auto uniforms = arena_.allocate_span<float>(rsl::kLightUniforms);
        uniforms[rsl::kLightKind] = jit::float_of(kind);
        uniforms[rsl::kLightCategories] = 0;
        uniforms[rsl::kLightHandle] = uniforms[rsl::kLightSampled] = 0;
        uniforms[rsl::kLightNondiffuse] = uniforms[rsl::kLightNonspecular] = 0;
        return {columns.data(), uniforms.data()};
    }

    const float* constant(bool one) {
        std::span<float>& column = constants_[one];
        if (column.empty()) {
            column = arena_.allocate_span<float>(count_);
            std::fill(column.begin(), column.end(), jit::float_of(one));
        }
        return column.data();
    }

    size_t count_;
    std::unique_ptr<Compiled> solar_, ambient_;
    Run solar_run_, ambient_run_;
    Arena arena_;
    std::span<float> constants_[2];
    std::vector<jit::RecordSet> sets_;
};

// ---- the hand-written side ----------------------------------------------------------------------

struct HandGrids {
    HandGrids(const Points& points, size_t grid) : count(grid) {
        size_t grids = points.count / grid;
        for (auto* rows : {Ci, Oi, L, Cl, ambient})
            for (int k = 0; k < 3; ++k) rows[k] = arena.allocate_span<float>(points.count).data();
        for (size_t g = 0; g < grids; ++g) {
            size_t at = g * grid;
            Grid one;
            for (int k = 0; k < 3; ++k) {
                one.in.P[k] = points.P[k] + at;
                one.in.N[k] = points.N[k] + at;
                one.in.Ng[k] = points.Ng[k] + at;
                one.in.I[k] = points.I[k] + at;
                for (int c = 0; c < 4; ++c) one.in.object[k][c] = points.object[k][c] + at;
                one.out.Ci[k] = Ci[k] + at;
                one.out.Oi[k] = Oi[k] + at;
                one.records[0].L[k] = L[k] + at;
                one.records[0].Cl[k] = Cl[k] + at;
                one.records[1].Cl[k] = ambient[k] + at;
            }
            one.records[1].ambient = true;
            list.push_back(one);
        }
    }
    void lights(const hand::Shaders& shaders, size_t g) {
        const hand::Light sun{{kAxis[0], kAxis[1], kAxis[2]}, {1, 1, 1}};
        const hand::Light sky{{0, 0, 0}, {1, 1, 1}};
        shaders.solar(sun, list[g].records[0], count);
        shaders.ambient(sky, list[g].records[1], count);
    }
    void surface(hand::Shaders::Surface shade, size_t g) {
        shade(list[g].in, list[g].out, list[g].records, 2, count);
    }

    struct Grid {
        hand::Inputs in;
        hand::Outputs out;
        hand::Record records[2];
    };
    size_t count;
    Arena arena;
    float *Ci[3], *Oi[3], *L[3], *Cl[3], *ambient[3];
    std::vector<Grid> list;
};

// ---- rows ---------------------------------------------------------------------------------------

struct ShaderRow {
    const char* name;
    hand::Shaders::Surface hand::Shaders::*surface;
};
constexpr ShaderRow kShaders[] = {{"marble", &hand::Shaders::marble},
                                  {"plastic", &hand::Shaders::plastic},
                                  {"wood", &hand::Shaders::wood},
                                  {"fbm_ramp", &hand::Shaders::fbm_ramp}};
struct WidthRow {
    const char* target;
    const hand::Shaders* (*shaders)();
};
constexpr WidthRow kWidths[] = {{"avx512", hand::avx512}, {"avx2", hand::avx2}};
enum class Kind { Surface, Lit, Bound };
struct KindRow {
    const char* name;
    Kind kind;
};
constexpr KindRow kKinds[] = {
    {"surface", Kind::Surface}, {"lit", Kind::Lit}, {"bound", Kind::Bound}};

double largest_difference(const Run& run, const HandGrids& by_hand, size_t count) {
    double largest = 0;
    const char* names[] = {"Ci.r", "Ci.g", "Ci.b"};
    for (int k = 0; k < 3; ++k)
        for (size_t i = 0; i < count; ++i)
            largest = std::max(
                largest, std::abs(double(run.out.at(names[k])[i]) - double(by_hand.Ci[k][i])));
    return largest;
}

void shade_row(benchmark::State& state, const WidthRow& width, const ShaderRow& shader, Kind kind) {
    size_t count = size_t(state.range(0)), grid = size_t(state.range(1));
    const jit::Target& target = *jit::find_target(width.target);
    Points points(count);
    auto surface = compile(shader.name, target, kind == Kind::Bound);
    Run run(*surface, points, grid);
    JitLights lights(target, points, grid);
    HandGrids by_hand(points, grid);
    const hand::Shaders& shaders = *width.shaders();
    for (size_t g = 0; g < run.grids(); ++g) {
        run.set_records(g, lights.set(g));
        lights.run(g);
        by_hand.lights(shaders, g);
    }
    _mm_setcsr(_mm_getcsr() | 0x8040);  // FTZ and DAZ, as around all fast kernels
    double jit_time = 1e30, hand_time = 1e30;
    size_t repeats = std::max<size_t>(1, 32768 / count);
    for (auto _ : state) {
        double start = cpu_seconds();
        for (size_t r = 0; r < repeats; ++r)
            for (size_t g = 0; g < run.grids(); ++g) {
                if (kind == Kind::Lit) lights.run(g);
                run.run(g);
            }
        double middle = cpu_seconds();
        for (size_t r = 0; r < repeats; ++r)
            for (size_t g = 0; g < run.grids(); ++g) {
                if (kind == Kind::Lit) by_hand.lights(shaders, g);
                by_hand.surface(shaders.*shader.surface, g);
            }
        double end = cpu_seconds();
        jit_time = std::min(jit_time, middle - start);
        hand_time = std::min(hand_time, end - middle);
        state.SetIterationTime(middle - start);
    }
    double shaded = double(count * repeats) * 1e-6;
    state.counters["jit"] = shaded / jit_time;
    state.counters["hand"] = shaded / hand_time;
    state.counters["ratio"] = hand_time / jit_time;
    state.counters["differs"] = largest_difference(run, by_hand, count);
}

// ---- divergence ---------------------------------------------------------------------------------

// Four ways of about equal work; WAY says which one a point takes. The uniform version reads it
// from the frame block.
const char* const kDivergent = R"(
surface divergent(float w = DEFAULT) {
    point at = transform("object", P);
    float way = WAY, v = 0, k;
    if (way < 1) { for (k = 0; k < 4; k += 1) v += noise(at * (k + 1)); }
    else if (way < 2) { for (k = 0; k < 4; k += 1) v += abs(noise(at * (k + 5)) - 0.5); }
    else if (way < 3) { for (k = 0; k < 4; k += 1) v += sqrt(noise(at * (k + 9))); }
    else { for (k = 0; k < 4; k += 1) v += 1 - noise(at * (k + 13)); }
    Ci = v; Oi = 1;
})";

// `parameter`, if named, is the constant; the others are as a scene sets them.
std::unique_ptr<Compiled> compile_text(const std::string& text, const jit::Target& target,
                                       const std::string& parameter = "", float constant = 0) {
    auto result = std::make_unique<Compiled>();
    result->shader = front_end(text, result->diagnostics);
    result->layer.shader = result->shader.get();
    result->layer.params = bound_parameters(*result->shader);
    for (rsl::ParamBinding& binding : result->layer.params)
        if (binding.name == parameter)
            binding = {parameter, rsl::ParamBinding::Kind::Constant, {constant}, {}};
    result->lowered = lower_fast(result->layer, result->diagnostics);
    result->kernels = jit::compile(result->lowered.module, {&target, nullptr});
    result->frame = frame_block(*result);
    return result;
}

std::unique_ptr<Compiled> compile_way(const std::string& way, const std::string& value,
                                      const jit::Target& target) {
    std::string text = kDivergent;
    text.replace(text.find("WAY"), 3, way);
    text.replace(text.find("DEFAULT"), 7, value);
    return compile_text(text, target);
}

// The best time of each over all iterations, for 8 walks over all points.
std::vector<double> best_times(benchmark::State& state,
                               std::span<const std::unique_ptr<Run>> runs) {
    _mm_setcsr(_mm_getcsr() | 0x8040);
    std::vector<double> best(runs.size(), 1e30);
    for (auto _ : state)
        for (size_t k = 0; k < runs.size(); ++k) {
            double start = cpu_seconds();
            for (int repeat = 0; repeat < 8; ++repeat)
                for (size_t g = 0; g < runs[k]->grids(); ++g) runs[k]->run(g);
            best[k] = std::min(best[k], cpu_seconds() - start);
        }
    return best;
}

void divergent_row(benchmark::State& state, const jit::Target& target) {
    constexpr size_t kCount = 4096, kGrid = 1024;
    Points points(kCount);
    const char* ways[] = {"4 * cellnoise(1000 * at)", "w", "w", "w", "w"};
    const char* values[] = {"0.5", "0.5", "1.5", "2.5", "3.5"};
    std::vector<std::unique_ptr<Compiled>> compiled;
    std::vector<std::unique_ptr<Run>> runs;
    for (size_t k = 0; k < std::size(ways); ++k) {
        compiled.push_back(compile_way(ways[k], values[k], target));
        runs.push_back(std::make_unique<Run>(*compiled.back(), points, kGrid));
    }
    std::vector<double> best = best_times(state, runs);
    double sum = best[1] + best[2] + best[3] + best[4];
    state.counters["Mpoints_divergent"] = 8 * kCount * 1e-6 / best[0];
    state.counters["Mpoints_one_way"] = 8 * kCount * 1e-6 / (sum / 4);
    state.counters["divergent_over_sum"] = best[0] / sum;
}

void specular_row(benchmark::State& state, const jit::Target& target) {
    constexpr size_t kCount = 4096, kGrid = 1024;
    Points points(kCount);
    JitLights lights(target, points, kGrid);
    std::string plastic = shader_text("plastic");
    std::unique_ptr<Compiled> compiled[] = {compile_text(plastic, target, "Ks", 0),
                                            compile_text(plastic, target),
                                            compile_text(shader_text("matte"), target)};
    std::vector<std::unique_ptr<Run>> runs;
    for (const auto& shader : compiled) {
        runs.push_back(std::make_unique<Run>(*shader, points, kGrid));
        for (size_t g = 0; g < runs.back()->grids(); ++g) {
            lights.run(g);
            runs.back()->set_records(g, lights.set(g));
        }
    }
    std::vector<double> best = best_times(state, runs);
    const char* names[] = {"Mpoints_Ks_0", "Mpoints_Ks_half", "Mpoints_matte"};
    for (size_t k = 0; k < 3; ++k) state.counters[names[k]] = 8 * kCount * 1e-6 / best[k];
    state.counters["Ks_0_over_matte"] = best[0] / best[2];
}

void register_rows() {
    for (const WidthRow& width : kWidths) {
        const jit::Target& target = *jit::find_target(width.target);
        if (!target.supported() || !width.shaders()) continue;
        benchmark::RegisterBenchmark((std::string("divergent/") + width.target).c_str(),
                                     divergent_row, target)
            ->Unit(benchmark::kMillisecond);
        benchmark::RegisterBenchmark((std::string("specular/") + width.target).c_str(),
                                     specular_row, target)
            ->Unit(benchmark::kMillisecond);
        for (const ShaderRow& shader : kShaders) {
            std::string name = shader.name;
            auto unit = benchmark::kMicrosecond;
            for (const KindRow& kind : kKinds) {
                std::string label = std::string(width.target) + "/" + name + "/" + kind.name;
                benchmark::RegisterBenchmark(label.c_str(), shade_row, width, shader, kind.kind)
                    ->Args({4096, 1024})
                    ->Args({65536, 1024})
                    ->Args({4096, 16})
                    ->UseManualTime()
                    ->Unit(unit);
            }
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
