// tests/bench/raytrace_bench.cpp: what updating and tracing cost, beside bare Embree. Single thread
// (set_thread_count(1)): CPU times, meant to be read as ratios of one run.
#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include "raytrace/tiles/integrator.h"
#include "runtime/base/parallel.h"
#include "tests/raytrace/meshes.h"

namespace kinora::raytrace::test {
namespace {

constexpr int kAcross = 140, kAlong = 250;  // 70 000 triangles

// The least that refitting a mesh can cost: Embree alone, same settings.
void bare_embree(benchmark::State& state, RTCBuildQuality quality, bool robust) {
    TestMesh rest = tube(kAcross, kAlong);
    std::vector<std::vector<vec4>> poses(2);
    bend(rest, 0.3, poses[0]);
    bend(rest, 0.5, poses[1]);
    std::vector<vec4> positions = poses[0];
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_LOW);
    rtcSetSceneFlags(scene, RTCSceneFlags(RTC_SCENE_FLAG_DYNAMIC |
                                          (robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE)));
    RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions.data(),
                               0, 16, positions.size());
    rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               rest.triangles.data(), 0, 12, rest.triangles.size() / 3);
    rtcSetGeometryBuildQuality(mesh, quality);
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(scene, mesh);
    rtcCommitScene(scene);
    size_t frame = 0;
    for (auto _ : state) {
        state.PauseTiming();
        positions = poses[++frame % 2];
        state.ResumeTiming();
        rtcUpdateGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0);
        rtcCommitGeometry(mesh);
        rtcCommitScene(scene);
    }
    rtcReleaseGeometry(mesh);
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
}

void update(benchmark::State& state, AccelPolicy policy) {
    TestMesh rest = tube(kAcross, kAlong);
    std::vector<std::vector<vec4>> poses(2);
    bend(rest, 0.3, poses[0]);
    bend(rest, 0.5, poses[1]);
    TestMesh mesh{poses[0], rest.triangles};
    std::vector<Geometry> rows{mesh.geometry(0, GeometryKind::Deforming)};
    Accel accel(policy);
    accel.update(rows);
    for (auto _ : state) {
        state.PauseTiming();
        const std::vector<vec4>& pose = poses[++rows[0].positions_version % 2];
        std::copy(pose.begin(), pose.end(), mesh.positions.begin());
        state.ResumeTiming();
        accel.update(rows);
    }
}

void static_update(benchmark::State& state) {
    TestMesh mesh = tube(kAcross, kAlong);
    std::vector<Geometry> rows;
    for (uint32_t i = 0; i < uint32_t(state.range(0)); ++i) rows.push_back(mesh.geometry(i));
    Accel accel;
    accel.update(rows);
    for (auto _ : state) accel.update(rows);
}

// Coherent rays: 640x480 pinhole on the bent tube.
void trace_rate(benchmark::State& state, AccelPolicy policy, bool any_hit) {
    TestMesh mesh = tube(kAcross, kAlong);
    bend(TestMesh(mesh), 0.8, mesh.positions);
    Accel accel(policy);
    std::vector<Geometry> rows{mesh.geometry(0, GeometryKind::Deforming)};
    accel.update(rows);
    std::vector<RayPacket16> packets;
    for (int by = 0; by < 480; by += 4)
        for (int bx = 0; bx < 640; bx += 4) {
            RayPacket16& p = packets.emplace_back();
            for (int i = 0; i < kPacket; ++i)
                set_lane(p, i, {4, 0.3f, 0},
                         {-1, float(bx + i % 4 - 320) / 320, float(by + i / 4 - 240) / 320});
        }
    HitPacket16 hits;
    TraceCounters counters;
    uint64_t found = 0;
    for (auto _ : state)
        for (const RayPacket16& p : packets)
            found += any_hit ? accel.occluded16(p, counters) : accel.intersect16(p, hits, counters);
    benchmark::DoNotOptimize(found);
    state.SetItemsProcessed(int64_t(counters.rays + counters.shadow_rays));
}

class White final : public SurfaceShading {
  public:
    void shade(const HitBatch& hits, int, ShadeResult& result) override {
        for (int c = 0; c < 3; ++c)
            for (size_t k = 0; k < hits.count; ++k) result.Ci[c][k] = result.Oi[c][k] = 1;
    }
};

void whole_integrator(benchmark::State& state) {
    TestMesh mesh = tube(kAcross, kAlong);
    bend(TestMesh(mesh), 0.8, mesh.positions);
    Accel accel;
    std::vector<Geometry> rows{mesh.geometry(0, GeometryKind::Deforming)};
    accel.update(rows);
    Camera camera;
    CameraOptics optics;
    optics.x = 1.2;
    dmat4 node(1.0);
    node[3] = dvec4(0, 0, 4, 1);
    make_camera(optics, node, 640, 480, dvec3(0.0), 4, camera);
    Film film;
    IntegratorScratch scratch;
    IntegratorCounters counters;
    IntegratorSettings settings;
    settings.chunk_rays = size_t(state.range(0));
    settings.samples_per_pixel = int(state.range(1));
    White white;
    for (auto _ : state) integrate(accel, camera, white, film, settings, scratch, counters);
    state.SetItemsProcessed(int64_t(counters.trace.rays));
    state.counters["hits"] = double(counters.shading_points) / double(counters.trace.rays);
    for (Stage s : {Stage::Sample, Stage::Trace, Stage::Points, Stage::Film})
        state.counters[stage_name(s)] = double(counters.stages[s]) / double(counters.stages.sum());
}

const AccelPolicy kFast{.robust = false};
const AccelPolicy kAnyWinner{.fixed_winner = false};
const AccelPolicy kRebuild{.always_rebuild = true};

BENCHMARK_CAPTURE(bare_embree, refit, RTC_BUILD_QUALITY_REFIT, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(update, refit, AccelPolicy{})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bare_embree, refit_not_robust, RTC_BUILD_QUALITY_REFIT, false)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(update, refit_not_robust, kFast)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bare_embree, medium, RTC_BUILD_QUALITY_MEDIUM, true)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(update, rebuild, kRebuild)->Unit(benchmark::kMillisecond);
BENCHMARK(static_update)->Arg(1)->Arg(100)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(trace_rate, closest, AccelPolicy{}, false);
BENCHMARK_CAPTURE(trace_rate, closest_any_winner, kAnyWinner, false);
BENCHMARK_CAPTURE(trace_rate, closest_not_robust, kFast, false);
BENCHMARK_CAPTURE(trace_rate, occluded, AccelPolicy{}, true);
BENCHMARK(whole_integrator)
    ->Args({4096, 1})
    ->Args({8192, 4})
    ->Args({16384, 4})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace kinora::raytrace::test

int main(int argc, char** argv) {
    kinora::set_thread_count(1);
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
