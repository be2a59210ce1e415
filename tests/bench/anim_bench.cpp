// tests/bench/anim_bench.cpp: what a frame's channels cost.
#include <benchmark/benchmark.h>

#include <random>

#include "anim/animation.h"
#include "runtime/base/parallel.h"

namespace kinora::anim {
namespace {

// 2-D tangents, so that BEZIER has a time cubic to solve.
Sampler make_curve(Interpolation interpolation, size_t keys, SampleKind kind) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    uint32_t stride = kind == SampleKind::Matrix ? 16 : 1;
    std::vector<double> times, values, in, out;
    double time = 0;
    for (size_t k = 0; k < keys; ++k) {
        times.push_back(time += 0.01 + unit(random));
        for (uint32_t c = 0; c < stride; ++c) {
            values.push_back(unit(random));
            in.insert(in.end(), {time - 0.005, values.back() + unit(random)});
            out.insert(out.end(), {time + 0.005, values.back() - unit(random)});
        }
    }
    return make_sampler({times, values, stride, std::span(&interpolation, 1), in, out, 2 * stride,
                         2 * stride, Behaviour::Constant, Behaviour::Constant, kind});
}

void thousand_channels(benchmark::State& state, Interpolation interpolation, SampleKind kind) {
    set_thread_count(1);
    uint32_t count = kind == SampleKind::Matrix ? 16 : 1;
    std::vector<Sampler> samplers;
    std::vector<Channel> channels;
    for (uint32_t i = 0; i < 1000; ++i) {
        samplers.push_back(make_curve(interpolation, 50, kind));
        channels.push_back({i, 0, i * count, count, 1, i});
    }
    Animation animation = make_animation(std::move(samplers), std::move(channels));
    std::vector<double> values(animation.slot_count);
    std::vector<uint64_t> changed(changed_words(animation.owner_count));
    double time = 0;
    for (auto _ : state) {
        time = time > 20 ? 0 : time + 1 / 24.0;
        evaluate(animation, time, values, changed);
        benchmark::DoNotOptimize(values.data());
    }
}
BENCHMARK_CAPTURE(thousand_channels, step, Interpolation::Step, SampleKind::Numbers);
BENCHMARK_CAPTURE(thousand_channels, linear, Interpolation::Linear, SampleKind::Numbers);
BENCHMARK_CAPTURE(thousand_channels, bezier_2d, Interpolation::Bezier, SampleKind::Numbers);
BENCHMARK_CAPTURE(thousand_channels, matrix_linear, Interpolation::Linear, SampleKind::Matrix);

void one_of_many_keys(benchmark::State& state) {
    Sampler sampler =
        make_curve(Interpolation::Bezier, static_cast<size_t>(state.range(0)), SampleKind::Numbers);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> at(sampler.first_time(), sampler.last_time());
    double value = 0;
    for (auto _ : state) {
        evaluate(sampler, at(random), 0, std::span(&value, 1));
        benchmark::DoNotOptimize(value);
    }
}
BENCHMARK(one_of_many_keys)->Arg(100)->Arg(10000)->Arg(1000000);

}  // namespace
}  // namespace kinora::anim

BENCHMARK_MAIN();
