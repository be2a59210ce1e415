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
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "raytrace/packet_recorder.h"
#include "runtime/base/parallel.h"
#include "runtime/base/stats.h"
#include "runtime/build/build_scene.h"
#include "runtime/description/play_range.h"
#include "runtime/frame/frame.h"
#include "runtime/load/import_scene.h"
#include "runtime/shading/kernels/kernel_probe.h"
#include "runtime/trade/quality.h"

namespace kinora {
namespace {

using raytrace::kPacket;
using raytrace::RayPacket16;

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

// ---- rays ---------------------------------------------------------------------------------------

enum Kind : uint8_t { Camera, Nested, Shadow, Kinds };
constexpr const char* kKinds[] = {"camera", "nested", "shadow"};

struct Ray {
    float org[3], dir[3], tnear, tfar, window;
    uint32_t mask, passed_first, passed_last;
};

Ray ray_at(const RayPacket16& p, int i) {
    return {{p.org_x[i], p.org_y[i], p.org_z[i]},
            {p.dir_x[i], p.dir_y[i], p.dir_z[i]},
            p.tnear[i],
            p.tfar[i],
            p.passing ? p.window[i] : 0,
            p.mask[i],
            p.passing ? p.passed_first[i] : 0,
            p.passing ? p.passed_last[i] : 0};
}

void set_ray_at(const Ray& ray, int i, RayPacket16& p) {
    p.org_x[i] = ray.org[0], p.org_y[i] = ray.org[1], p.org_z[i] = ray.org[2];
    p.dir_x[i] = ray.dir[0], p.dir_y[i] = ray.dir[1], p.dir_z[i] = ray.dir[2];
    p.tnear[i] = ray.tnear, p.tfar[i] = ray.tfar, p.time[i] = 0;
    p.mask[i] = ray.mask;
    p.window[i] = ray.window;
    p.passed_first[i] = ray.passed_first, p.passed_last[i] = ray.passed_last;
}

// All packets of a frame, without the lanes that are not in use.
struct Rays : raytrace::PacketRecorder {
    struct Packet {
        uint32_t active;
        Kind kind;
        bool passing;
    };
    std::vector<Packet> packets;
    std::vector<Ray> rays;  // of the packets, one behind the other

    void closest(const RayPacket16& p) override { add(p, p.coherent ? Camera : Nested); }
    void any(const RayPacket16& p) override { add(p, Shadow); }
    void add(const RayPacket16& p, Kind kind) {
        packets.push_back({p.active & 0xffffu, kind, p.passing});
        for (uint32_t left = p.active & 0xffffu; left; left &= left - 1)
            rays.push_back(ray_at(p, std::countr_zero(left)));
    }
};

// Packets ready to be traced, of one kind.
std::vector<RayPacket16> as_sent(const Rays& all, Kind kind) {
    std::vector<RayPacket16> result;
    const Ray* next = all.rays.data();
    for (const Rays::Packet& from : all.packets) {
        const Ray* ray = next;
        next += std::popcount(from.active);
        if (from.kind != kind) continue;
        RayPacket16& p = result.emplace_back();
        for (int i = 0; i < kPacket; ++i) set_ray_at(*ray, i, p);  // lanes out of use: any rays
        p.active = from.active;
        p.passing = from.passing;
        p.coherent = kind == Camera;
        for (uint32_t left = from.active; left; left &= left - 1)
            set_ray_at(*ray++, std::countr_zero(left), p);
    }
    return result;
}

// Bits of up to three small numbers in turns.
uint64_t interleave(const uint32_t v[3], int count) {
    uint64_t key = 0;
    for (int bit = 9; bit >= 0; --bit)
        for (int k = 0; k < count; ++k) key = key << 1 | (v[k] >> bit & 1);
    return key;
}

// By the cell of the origin (of 32 in each axis of all origins' box), then the direction's place on
// an octahedron.
std::vector<RayPacket16> best(const Rays& all, Kind kind) {
    std::vector<std::pair<Ray, uint64_t>> rays[2];  // not passing, passing
    const Ray* next = all.rays.data();
    vec3 low(std::numeric_limits<float>::infinity()), high(-low);
    for (const Rays::Packet& from : all.packets)
        for (int i = std::popcount(from.active); i > 0; --i, ++next) {
            if (from.kind != kind) continue;
            rays[from.passing].push_back({*next, 0});
            for (int c = 0; c < 3; ++c) {
                low[c] = std::min(low[c], next->org[c]);
                high[c] = std::max(high[c], next->org[c]);
            }
        }
    std::vector<RayPacket16> result;
    for (bool passing : {false, true}) {
        for (auto& [ray, key] : rays[passing]) {
            uint32_t cell[3], way[2];
            float sum = std::abs(ray.dir[0]) + std::abs(ray.dir[1]) + std::abs(ray.dir[2]);
            for (int c = 0; c < 3; ++c) {
                const float side = high[c] - low[c];
                cell[c] = side > 0 ? uint32_t(31.99f * (ray.org[c] - low[c]) / side) : 0;
            }
            float x = ray.dir[0] / sum, y = ray.dir[1] / sum;
            if (ray.dir[2] < 0) {
                const float folded = (1 - std::abs(y)) * std::copysign(1.0f, x);
                y = (1 - std::abs(x)) * std::copysign(1.0f, y);
                x = folded;
            }
            way[0] = uint32_t(1023 * std::clamp(0.5f * x + 0.5f, 0.0f, 1.0f));
            way[1] = uint32_t(1023 * std::clamp(0.5f * y + 0.5f, 0.0f, 1.0f));
            key = interleave(cell, 3) << 20 | interleave(way, 2);
        }
        std::stable_sort(rays[passing].begin(), rays[passing].end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
        for (size_t first = 0; first < rays[passing].size(); first += kPacket) {
            RayPacket16& p = result.emplace_back();
            const size_t n = std::min<size_t>(kPacket, rays[passing].size() - first);
            for (size_t i = 0; i < kPacket; ++i)
                set_ray_at(rays[passing][first + std::min(i, n - 1)].first, int(i), p);
            p.active = n == kPacket ? 0xffffu : (1u << n) - 1;
            p.passing = passing;
            p.coherent = kind == Camera;
        }
    }
    return result;
}

double trace_ms(const raytrace::Accel& accel, const std::vector<RayPacket16>& packets, Kind kind) {
    raytrace::HitPacket16 hits;
    raytrace::TraceCounters counters;
    uint32_t found = 0;
    const double ms = least_ms([&] {
        for (const RayPacket16& p : packets)
            found += kind == Shadow ? accel.occluded16(p, counters)
                                    : accel.intersect16(p, hits, counters);
    });
    if (found == 0xdeadbeef) std::puts("");  // the work is wanted
    return ms;
}

// ---- kernels ------------------------------------------------------------------------------------

constexpr size_t kMostSlots = 32;

// Runs each launch, keeping what services answer, and then again with the same answers.
class Kernels : public KernelProbe {
  public:
    uint64_t ticks = 0, points = 0, launches = 0, left_out = 0;

    void run(const jit::KernelCall& call) override {
        const std::vector<jit::ServiceInfo>& services = call.kernel.services;
        const bool records = std::any_of(services.begin(), services.end(), [](const auto& s) {
            return s.name == "lights" || s.name == "gather";  // whose memory is let go again
        });
        if (services.size() > kMostSlots || records) {
            ++left_out;
            call.run();
            return;
        }
        Log log{call, {}, 0};
        std::array<jit::ServiceFn, kMostSlots> functions =
            keepers(std::make_index_sequence<kMostSlots>{});
        jit::KernelCall own = call;
        own.services = {functions.data(), services.size()};
        own.host = &log;
        own.run();
        functions.fill(answer);
        uint64_t least = ~uint64_t{0};
        for (int run = 0; run < kRuns; ++run) {
            log.next = 0;
            const jit::CheckedCall checked(own);
            const uint64_t begin = cpu_ticks();
            checked.run();
            least = std::min(least, cpu_ticks() - begin);
        }
        ticks += least;
        points += call.count;
        ++launches;
    }

  private:
    struct Log {
        const jit::KernelCall& call;
        std::vector<std::vector<float>> results;
        size_t next;
    };

    template <size_t slot>
    static void keep(const jit::ServiceCall& asked) {
        Log& log = *static_cast<Log*>(asked.grid);
        jit::ServiceCall real = asked;
        real.grid = log.call.host;
        log.call.services[slot](real);
        const size_t floats = log.call.kernel.services[slot].results.size() * jit::kMaxLanes;
        log.results.emplace_back(asked.results, asked.results + floats);
    }
    static void answer(const jit::ServiceCall& asked) {
        Log& log = *static_cast<Log*>(asked.grid);
        const std::vector<float>& kept = log.results[log.next++];
        std::copy(kept.begin(), kept.end(), asked.results);
    }
    template <size_t... slots>
    static constexpr std::array<jit::ServiceFn, kMostSlots> keepers(std::index_sequence<slots...>) {
        return {keep<slots>...};
    }
};

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
    const Quality& quality = *find_quality("preview");
    SceneOptions options;
    options.math = quality.math;
    options.ray_depth = quality.ray_depth;
    options.diffuse_depth = quality.diffuse_depth;
    options.split = quality.split;
    options.accel.robust = quality.robust;
    options.accel.background = false;
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
    Diagnostics diagnostics;
    raytrace::Film film;
    FrameStats stats;
    auto render = [&] {
        return render_frame(*scene, job.time, job.settings, film, stats, diagnostics);
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
    Rays rays;
    raytrace::record_packets(&rays);
    render();
    raytrace::record_packets(nullptr);
    Kernels kernels;
    probe_kernels(&kernels);
    render();
    probe_kernels(nullptr);
    const double kernel_ms = double(kernels.ticks) / ticks_a_ms();

    std::printf("%s, %dx%d, %d samples: %.2f ms, %.2f without animate, skin and refit\n",
                job.scene.c_str(), job.settings.width, job.settings.height,
                job.settings.integrator.samples_per_pixel, frame, own);
    double sent_all = 0, best_all = 0;
    for (Kind kind : {Camera, Nested, Shadow}) {
        const std::vector<RayPacket16> sent = as_sent(rays, kind);
        if (sent.empty()) continue;
        const std::vector<RayPacket16> sorted = best(rays, kind);
        uint64_t count = 0;
        for (const RayPacket16& p : sent) count += uint64_t(std::popcount(p.active));
        const double sent_ms = trace_ms(scene->accel, sent, kind);
        // What was sent may be the better order.
        const double best_ms = std::min(sent_ms, trace_ms(scene->accel, sorted, kind));
        std::printf("%s rays: %llu, packets %.0f %% full; as sent %.2f ms, best %.2f\n",
                    kKinds[kind], static_cast<unsigned long long>(count),
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
