// tests/bench/tessellate_bench.cpp: triangles a second of surfaces by formulas, one thread.
#include <benchmark/benchmark.h>

#include <cmath>

#include "runtime/scene/tessellate/tessellate.h"

namespace kinora {
namespace {

void report(benchmark::State& state, const CurvedSurface& surface, double pixels) {
    PictureScale scale;
    scale.orthographic = true;
    scale.pixels = pixels;
    size_t triangles = 0;
    for (auto _ : state) {
        Tessellation t = tessellate(surface, scale);
        triangles += t.group.triangles.size() / 3;
        benchmark::DoNotOptimize(t.positions.data());
    }
    state.counters["triangles"] = double(triangles) / double(state.iterations());
    state.counters["triangles/s"] =
        benchmark::Counter(double(triangles), benchmark::Counter::kIsRate);
}

void sphere(benchmark::State& state) {
    CurvedSurface s;
    const double numbers[] = {1, -1, 1, 360};
    std::copy(numbers, numbers + 4, s.numbers);
    report(state, s, double(state.range(0)));
}
BENCHMARK(sphere)->Arg(10)->Arg(300)->Arg(100000)->Unit(benchmark::kMicrosecond);

// Waves over n x n points, as B-splines of order 4.
void waves(benchmark::State& state) {
    const uint32_t n = uint32_t(state.range(0));
    CurvedSurface s;
    s.kind = CurvedKind::Nurbs;
    s.u.points = n;
    s.u.order = 4;
    for (uint32_t k = 0; k < n + 4; ++k) s.u.knots.push_back(k);
    s.u.low = 3;
    s.u.high = n;
    s.v = s.u;
    for (uint32_t k = 0; k < n * n; ++k) {
        const double x = double(k % n) / n, y = double(k / n) / n;
        s.points.push_back({x, y, 0.1 * std::sin(9 * x + 5 * y), 1});
    }
    report(state, s, double(state.range(1)));
}
BENCHMARK(waves)
    ->Args({10, 500})
    ->Args({10, 100000})
    ->Args({300, 500})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace kinora

BENCHMARK_MAIN();
