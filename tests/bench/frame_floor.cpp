// tests/bench/frame_floor.cpp: how near a frame is to its rays and kernels.
//
//     build/release/bench/frame_floor SCENE [WIDTHxHEIGHT [SAMPLES [TIME]]]
//
// Renders a frame on one thread, records its rays and the launches of its kernels, and replays them
// bare. Rays twice: as sent (same packets, same order), and best: the same rays in full packets of
// 16, sorted by the cell of their origin and by direction. Kernels with the recorded results of
// their services. Times are CPU time, the least of some runs.
//
// overhead = (frame - animate - skin - refit) / (best rays + kernels)
#include <ctime>

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "runtime/base/parallel.h"
#include "runtime/base/stats.h"
#include "runtime/picture/frame/frame.h"
#include "runtime/scene/build/build_scene.h"
#include "runtime/scene/description/play_range.h"
#include "runtime/scene/load/import_scene.h"
#include "runtime/scene/quality/quality.h"
#include "tests/bench/recorded_frame.h"

namespace kinora {
namespace {

using raytrace::kPacket;
using raytrace::RayPacket16;
constexpr struct {
    RayUse use;
    const char* name;
} kUses[] = {{RayUse::Camera, "camera"}, {RayUse::Nested, "nested"}, {RayUse::Shadow, "shadow"}};

constexpr int kRuns = 5;

double cpu_ms() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return double(t.tv_sec) * 1e3 + double(t.tv_nsec) * 1e-6;
}

template <class F>
double least_ms(F&& work) {
    double least = std::numeric_limits<double>::infinity();
    for (int run = 0; run < kRuns; ++run) {
        const double begin = cpu_ms();
        work();
        least = std::min(least, cpu_ms() - begin);
    }
    return least;
}

double trace_ms(const raytrace::Accel& accel, const std::vector<RayPacket16>& packets, RayUse use) {
    raytrace::HitPacket16 hits;
    raytrace::TraceCounters counters;
    uint32_t found = 0;
    const double ms = least_ms([&] {
        for (const RayPacket16& p : packets)
            found += use == RayUse::Shadow ? accel.occluded16(p, counters)
                                           : accel.intersect16(p, hits, counters);
    });
    if (found == 0xdeadbeef) std::puts("");  // the work is wanted
    return ms;
}

// Of the wall clock, which the counter follows: the least of some runs of a kernel is one that
// nobody interrupted.
double ticks_a_ms() {
    const Stopwatch watch;
    const uint64_t begin = cpu_ticks();
    while (watch.ms() < 50) {
    }
    return double(cpu_ticks() - begin) / watch.ms();
}

// ---- the frame ----------------------------------------------------------------------------------

struct Job {
    std::string scene;
    FrameSettings settings;
    double time = 0;
};

std::unique_ptr<Scene> load(Job& job) {
    Diagnostics diagnostics;
    std::optional<SceneDescription> description = import_scene(job.scene, {}, diagnostics);
    if (!description) return nullptr;
    SceneOptions options;
    options.quality = *find_quality("preview");
    options.background_rebuilds = false;
    const PlayRange range = play_range(*description);
    options.frame_rate = range.rate;
    options.start_time = range.start;
    options.end_time = range.end;
    options.width = job.settings.width;
    options.height = job.settings.height;
    return build_scene(std::make_shared<SceneDescription>(std::move(*description)), options,
                       diagnostics);
}

int measure(Job& job) {
    set_thread_count(1);
    std::unique_ptr<Scene> scene = load(job);
    if (!scene) {
        std::fprintf(stderr, "frame_floor: '%s' cannot be rendered\n", job.scene.c_str());
        return 1;
    }
    Pose pose(*scene);
    Diagnostics diagnostics;
    raytrace::Film film;
    FrameStats stats;
    auto render = [&] {
        return render_frame(*scene, pose, job.time, job.settings, film, stats, diagnostics);
    };
    if (!render()) return 1;
    double own = std::numeric_limits<double>::infinity();  // without animate, skin and refit
    const double frame = least_ms([&] {
        const double begin = cpu_ms();
        render();
        const double before_rays = stats.stages[size_t(Stage::Animate)] +
                                   stats.stages[size_t(Stage::Skin)] +
                                   stats.stages[size_t(Stage::Refit)];
        own = std::min(own, (cpu_ms() - begin) * (1 - before_rays / stats.total));
    });
    RecordedRays rays;
    raytrace::record_packets(&rays);
    render();
    raytrace::record_packets(nullptr);
    ReplayedKernels kernels(kRuns);
    probe_kernels(&kernels);
    render();
    probe_kernels(nullptr);
    const double kernel_ms = double(kernels.ticks) / ticks_a_ms();

    std::printf("%s, %dx%d, %d samples: %.2f ms, %.2f without animate, skin and refit\n",
                job.scene.c_str(), job.settings.width, job.settings.height,
                job.settings.integrator.samples_per_pixel, frame, own);
    double sent_all = 0, best_all = 0;
    for (const auto& [use, name] : kUses) {
        const std::vector<RayPacket16> sent = rays.as_sent(use);
        if (sent.empty()) continue;
        const std::vector<RayPacket16> sorted = rays.sorted(use);
        uint64_t count = 0;
        for (const RayPacket16& p : sent) count += uint64_t(std::popcount(p.active));
        const double sent_ms = trace_ms(pose.accel, sent, use);
        // What was sent may be the better order.
        const double best_ms = std::min(sent_ms, trace_ms(pose.accel, sorted, use));
        std::printf("%s rays: %llu, packets %.0f %% full; as sent %.2f ms, best %.2f\n", name,
                    static_cast<unsigned long long>(count),
                    100.0 * double(count) / double(kPacket * sent.size()), sent_ms, best_ms);
        sent_all += sent_ms;
        best_all += best_ms;
    }
    std::printf("kernels: %llu launches, %llu points, %.2f ms; %llu launches left out\n",
                static_cast<unsigned long long>(kernels.launches),
                static_cast<unsigned long long>(kernels.points), kernel_ms,
                static_cast<unsigned long long>(kernels.left_out));
    std::printf("floor: as sent %.2f ms, best %.2f; overhead %.2f (as sent %.2f)\n",
                sent_all + kernel_ms, best_all + kernel_ms, own / (best_all + kernel_ms),
                own / (sent_all + kernel_ms));
    return 0;
}

}  // namespace
}  // namespace kinora

int main(int argc, char** argv) {
    using namespace kinora;
    Job job;
    if (argc < 2 || argc > 5) {
        std::fprintf(stderr, "frame_floor SCENE [WIDTHxHEIGHT [SAMPLES [TIME]]]\n");
        return 2;
    }
    job.scene = argv[1];
    job.settings.integrator.samples_per_pixel = argc > 3 ? std::max(1, std::atoi(argv[3])) : 4;
    job.settings.integrator.filter = raytrace::find_pixel_filter("gaussian");
    job.time = argc > 4 ? std::atof(argv[4]) : 0;
    if (argc > 2 && std::sscanf(argv[2], "%dx%d", &job.settings.width, &job.settings.height) != 2) {
        std::fprintf(stderr, "frame_floor: the size is WIDTHxHEIGHT, not '%s'\n", argv[2]);
        return 2;
    }
    return measure(job);
}
