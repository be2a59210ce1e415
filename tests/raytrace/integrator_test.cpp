// tests/raytrace/integrator_test.cpp: whole pictures with looks simple enough to know the answer.
#include "raytrace/tiles/integrator.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <functional>
#include <mutex>

#include "raytrace/sampling.h"
#include "tests/raytrace/meshes.h"

namespace kinora::raytrace::test {
namespace {

// Shades by a function of (batch, hit) -> colour and opacity.
class Looks final : public SurfaceShading {
  public:
    using Function = std::function<void(const HitBatch&, size_t, vec3& Ci, vec3& Oi)>;
    explicit Looks(Function f) : function_(std::move(f)) {}
    void shade(const HitBatch& hits, int thread, ShadeResult& result) override {
        EXPECT_LT(thread, thread_count());
        for (size_t k = 0; k < hits.count; ++k) {
            vec3 Ci(1.0f), Oi(1.0f);
            function_(hits, k, Ci, Oi);
            for (int c = 0; c < 3; ++c) result.Ci[c][k] = Ci[c], result.Oi[c][k] = Oi[c];
            if (!result.aov.empty()) result.aov[0][k] = hits.t[k];
        }
        std::lock_guard lock(mutex_);
        largest_batch = std::max(largest_batch, hits.count);
        ++batches;
    }
    size_t largest_batch = 0, batches = 0;

  private:
    Function function_;
    std::mutex mutex_;
};

struct Threads {  // for a scope
    int before = thread_count();
    explicit Threads(int n) { set_thread_count(n); }
    ~Threads() { set_thread_count(before); }
};

Camera front_camera(int width, int height, double z = 5, double fov = 60) {
    CameraOptics optics;
    optics.x = radians(fov);
    dmat4 node(1.0);
    node[3].z = z;
    Camera camera;
    make_camera(optics, node, width, height, dvec3(0.0), 10, camera);
    return camera;
}

// Squares of half side `size` facing +z.
TestMesh square(double size, double z) {
    TestMesh m;
    for (auto [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
        m.positions.push_back(vec4(float(size * x), float(size * y), float(z), 0));
    m.triangles = {0, 1, 2, 0, 2, 3};
    return m;
}

struct Picture {
    Accel accel;
    std::vector<Geometry> rows;
    Camera camera = front_camera(100, 75);
    Film film;
    IntegratorSettings settings;
    IntegratorScratch scratch;
    IntegratorCounters counters;

    bool take(SurfaceShading& looks, const Progress* progress = nullptr) {
        accel.update(rows);
        counters = {};
        return integrate(accel, camera, looks, film, settings, scratch, counters, progress);
    }
};

TEST(Integrator, AWhiteWallGivesExactlyWhiteCoveredPixelsAtAnyFilter) {
    TestMesh wall = square(100, 0);
    Picture p;
    p.rows = {wall.geometry(1)};
    Looks white([](const HitBatch&, size_t, vec3&, vec3&) {});
    for (const PixelFilter& filter : pixel_filters())
        for (int spp : {1, 4, 7, 16}) {
            p.settings.filter = &filter;
            p.settings.samples_per_pixel = spp;
            ASSERT_TRUE(p.take(white));
            for (const vec4& pixel : p.film.rgba) ASSERT_EQ(pixel, vec4(1.0f));
            EXPECT_EQ(p.counters.trace.rays, 100u * 75 * unsigned(spp));
            EXPECT_EQ(p.counters.shading_points, p.counters.trace.rays);
        }
}

// 1/3 has no float: a mean that drifts shows.
TEST(Integrator, TheMeanOfManySamplesDoesNotDrift) {
    TestMesh wall = square(100, 0);
    Looks third(
        [](const HitBatch&, size_t, vec3& Ci, vec3&) { Ci = vec3(1.0f / 3, 1e30f, 1e-30f); });
    Picture p;
    p.camera = front_camera(8, 8);
    p.film.resize(8, 8);
    p.rows = {wall.geometry(1)};
    for (int spp : {1, 1000, 10007}) {
        p.settings.samples_per_pixel = spp;
        ASSERT_TRUE(p.take(third));
        for (const vec4& pixel : p.film.rgba) {
            ASSERT_NEAR(pixel.x, 1.0f / 3, 1.0 / 3 * 0x1p-20) << spp;
            ASSERT_NEAR(pixel.y / 1e30f, 1, 0x1p-20);
            ASSERT_NEAR(pixel.z / 1e-30f, 1, 0x1p-20);
            ASSERT_EQ(pixel.w, 1);
        }
    }
}

TEST(Integrator, NothingThereIsTransparentOrTheBackground) {
    Picture p;
    p.film.add_aov("z");
    Looks white([](const HitBatch&, size_t, vec3&, vec3&) {});
    p.take(white);
    for (const vec4& pixel : p.film.rgba) ASSERT_EQ(pixel, vec4(0.0f));
    p.settings.background = vec3(0.25f, 0.5f, 0.75f);
    p.take(white);
    for (const vec4& pixel : p.film.rgba) ASSERT_EQ(pixel, vec4(0.25f, 0.5f, 0.75f, 1));
    EXPECT_EQ(white.batches, 0u);
}

TEST(Integrator, CoverageOfASquareIsItsArea) {
    TestMesh small = square(0.71, 0);
    Picture p;
    p.rows = {small.geometry(1)};
    p.settings.samples_per_pixel = 64;
    Looks white([](const HitBatch&, size_t, vec3&, vec3&) {});
    for (const PixelFilter& filter : pixel_filters()) {
        p.settings.filter = &filter;
        p.take(white);
        double covered = 0;
        for (const vec4& pixel : p.film.rgba) covered += double(pixel.w);
        const double per_unit = 50 / (5 * std::tan(radians(30)));  // pixels
        EXPECT_NEAR(covered, std::pow(2 * 0.71 * per_unit, 2), 1.5) << filter.name;
    }
}

TEST(Integrator, LayersCompositeFrontToBack) {
    TestMesh front = square(100, 1), middle = square(100, 0), back = square(100, -1);
    Picture p;
    p.rows = {middle.geometry(1), back.geometry(2, GeometryKind::Deforming), front.geometry(0)};
    p.rows[2].opaque = p.rows[0].opaque = false;
    p.settings.samples_per_pixel = 2;
    p.film.add_aov("z");
    Looks looks([](const HitBatch& hits, size_t k, vec3& Ci, vec3& Oi) {
        const vec3 colors[] = {{0.5f, 0, 0}, {0, 0.25f, 0}, {0, 0, 1}};
        const float opacity[] = {0.5f, 0.25f, 1};
        Ci = colors[hits.geometry[k]];
        Oi = vec3(opacity[hits.geometry[k]]);
        EXPECT_EQ(hits.layer[k], hits.geometry[k]);  // front first
        EXPECT_NEAR(hits.P[2][k], 1.0f - float(hits.geometry[k]), 1e-5f);
        EXPECT_EQ(hits.org[2][k], 5);
        EXPECT_NEAR(hits.org[2][k] + hits.t[k] * hits.dir[2][k], hits.P[2][k], 1e-5f);
    });
    p.take(looks);
    for (const vec4& pixel : p.film.rgba) {
        EXPECT_FLOAT_EQ(pixel.x, 0.5f);
        EXPECT_FLOAT_EQ(pixel.y, 0.5f * 0.25f);
        EXPECT_FLOAT_EQ(pixel.z, 0.5f * 0.75f);
        EXPECT_FLOAT_EQ(pixel.w, 1);
    }
    EXPECT_NEAR(p.film.aovs[0].values[37 * 100 + 50], 4, 1e-3);  // the nearest layer's
    p.settings.max_layers = 2;
    p.take(looks);
    EXPECT_FLOAT_EQ(p.film.rgba[0].w, 1 - 0.5f * 0.75f);
}

TEST(Integrator, PicturesAreTheSameBytesForAnyThreadCountTileAndChunk) {
    TestMesh ball = sphere(1, {0, 0, 0}, 60, 30), things = soup(200, 1.5, 0.5, 4);
    Looks looks([](const HitBatch& h, size_t k, vec3& Ci, vec3& Oi) {
        uint32_t bits = hash(h.pixel_x[k], h.pixel_y[k], h.sample[k] * 64 + h.layer[k]);
        Ci = vec3(float(bits & 255) / 255, h.u[k], std::abs(h.Ng[2][k]));
        Oi = vec3(0.3f + 0.5f * h.v[k], 0.5f, 0.9f);
    });
    std::vector<vec4> first;
    std::vector<float> first_z;
    for (int threads : {1, 2, 4})
        for (int tile : {64, 16, 20})
            for (size_t chunk : {size_t(4096), size_t(16384)}) {
                Threads scope(threads);
                Picture p;
                p.film.add_aov("z");
                p.rows = {ball.geometry(1), things.geometry(2, GeometryKind::Deforming)};
                p.rows[0].opaque = p.rows[1].opaque = false;
                p.settings.samples_per_pixel = 5;
                p.settings.tile = tile;
                p.settings.chunk_rays = chunk;
                p.settings.filter = find_pixel_filter("gaussian");
                p.take(looks);
                if (first.empty()) {
                    first = p.film.rgba;
                    first_z = p.film.aovs[0].values;
                }
                ASSERT_EQ(std::memcmp(first.data(), p.film.rgba.data(), first.size() * 16), 0)
                    << threads << " threads, tile " << tile << ", chunk " << chunk;
                ASSERT_EQ(first_z, p.film.aovs[0].values);
            }
}

// Pictures that fill no tile and no packet, clipped or parallel views, any number of samples.
TEST(Integrator, TracesTheCamerasRayOfEachSampleOnce) {
    TestMesh wall = square(1e4, 0);
    const PixelFilter& gaussian = *find_pixel_filter("gaussian");
    const FilterSampler sampler(gaussian, 3);
    for (auto [width, height] : {std::pair(1, 1), {5, 3}, {67, 65}, {64, 1}})
        for (int spp : {1, 2, 3, 17})
            for (bool parallel : {false, true}) {
                if (width * height * spp > 10000 && parallel) continue;
                Picture p;
                p.camera = front_camera(width, height, 5, 100);
                p.camera.orthographic = parallel;
                p.camera.clip = spp == 3;
                p.camera.zfar = 1e6;
                p.rows = {wall.geometry(1)};
                p.settings.samples_per_pixel = spp;
                p.settings.filter = &gaussian;
                p.settings.filter_width = 3;
                p.settings.seed = 99;
                std::vector<int> seen(size_t(width * height * spp), 0);
                Looks looks([&](const HitBatch& h, size_t k, vec3&, vec3&) {
                    const uint32_t x = h.pixel_x[k], y = h.pixel_y[k], sample = h.sample[k];
                    ++seen[(size_t(y) * size_t(width) + x) * size_t(spp) + sample];
                    dvec2 offset(0.0);
                    if (spp > 1) {
                        const dvec2 u = stratified_sample(sample, hash(x, y, 99));
                        offset = {sampler.offset(u.x), sampler.offset(u.y)};
                    }
                    const CameraRay ray =
                        camera_ray(p.camera, x + 0.5 + offset.x, y + 0.5 + offset.y);
                    for (int c = 0; c < 3; ++c) {
                        ASSERT_FLOAT_EQ(h.dir[c][k], ray.dir[c]);
                        ASSERT_FLOAT_EQ(h.org[c][k], ray.org[c]);
                        ASSERT_NEAR(h.dDdx[c][k], ray.ddir_dx[c], 1e-6 * double(ray.ddir_dx.x));
                        ASSERT_NEAR(h.dDdy[c][k], ray.ddir_dy[c], 1e-6 * -double(ray.ddir_dy.y));
                        ASSERT_EQ(h.rays->dOdx[c][h.ray[k]], ray.dorg_dx[c]);
                        ASSERT_EQ(h.rays->dOdy[c][h.ray[k]], ray.dorg_dy[c]);
                    }
                    ASSERT_FLOAT_EQ(h.rays->tnear[h.ray[k]], ray.tnear);
                    ASSERT_FLOAT_EQ(h.rays->tfar[h.ray[k]], ray.tfar);
                });
                p.take(looks);
                for (int times : seen) ASSERT_EQ(times, 1);
            }
}

// What rays that go on leave in their columns must not reach the next samples or the next frame.
TEST(Integrator, RaysBehindHitsLeaveNothingToTheNextSamples) {
    TestMesh front = square(100, 1), back = square(100, 0);
    Picture p;
    p.camera = front_camera(40, 30);
    p.rows = {front.geometry(0), back.geometry(1)};
    p.rows[0].opaque = false;
    p.settings.samples_per_pixel = 23;
    p.settings.tile = 16;
    p.settings.chunk_rays = 256;
    std::atomic<size_t> hits = 0;
    Looks looks([&](const HitBatch& h, size_t k, vec3&, vec3& Oi) {
        ++hits;
        const uint32_t ray = h.ray[k];
        ASSERT_EQ(h.geometry[k], h.layer[k]);
        ASSERT_EQ(h.org[2][k], 5);
        ASSERT_NEAR(h.t[k] * h.dir[2][k], h.layer[k] == 0 ? -4 : -5, 1e-5);
        ASSERT_EQ(h.rays->t_passed[ray] == 0, h.layer[k] == 0);
        if (h.layer[k] == 0) {
            ASSERT_EQ(h.rays->slot[ray], ray);
            ASSERT_EQ(h.rays->weight[ray], 1);
            ASSERT_EQ(h.rays->turns[ray] + h.rays->spent[ray] + h.rays->medium[ray], 0u);
        }
        // A different part of the pixels sees through in each frame.
        Oi = vec3(h.layer[k] == 1 || (h.pixel_x[k] * 7 + h.pixel_y[k]) % 3 == p.settings.seed
                      ? 1.0f
                      : 0.25f);
    });
    for (uint32_t frame = 0; frame < 3; ++frame) {
        p.settings.seed = frame;
        p.take(looks);
    }
    EXPECT_EQ(hits, 3u * 23 * 1200 + 2u * 23 * 1200);
}

// The sum of the stages is what the threads spent, whatever they are.
TEST(Integrator, StagesOfThreadsAreTimedWithinTheFrames) {
    TestMesh wall = square(100, 0);
    Picture p;
    p.rows = {wall.geometry(1)};
    Looks white([](const HitBatch&, size_t, vec3&, vec3&) {});
    StageClock frame;
    {
        RunningClock running(frame);
        p.take(white);
    }
    const StageTicks outer = frame.ticks(), inner = p.counters.stages;
    for (Stage s : {Stage::Sample, Stage::Trace, Stage::Points, Stage::Film, Stage::Gather})
        EXPECT_GT(inner[s], 0u) << stage_name(s);
    EXPECT_GT(outer[Stage::Idle], 0u);
    for (Stage s : {Stage::Sample, Stage::Trace, Stage::Points, Stage::Film, Stage::Gather})
        EXPECT_EQ(outer[s], 0u) << stage_name(s);
}

TEST(Integrator, FootprintsAreThePixelsSizeOnAWallAndCappedAtGrazing) {
    TestMesh wall = square(100, 0);
    Picture p;
    p.rows = {wall.geometry(1)};
    const float pixel = float(2 * 5 * std::tan(radians(30)) / 100);
    Looks looks([&](const HitBatch& h, size_t k, vec3&, vec3&) {
        EXPECT_NEAR(h.dPdx[0][k], pixel, 1e-5f);
        EXPECT_NEAR(h.dPdx[1][k], 0, 1e-5f);
        EXPECT_NEAR(h.dPdx[2][k], 0, 1e-5f);
        EXPECT_NEAR(h.dPdy[1][k], -pixel, 1e-5f);
    });
    p.take(looks);
    TestMesh edge_on = square(3, 0);
    for (vec4& v : edge_on.positions) v = vec4(v.x, v.y * 1e-6f, v.y, 0);
    p.rows = {edge_on.geometry(1)};
    Looks finite([&](const HitBatch& h, size_t k, vec3&, vec3&) {
        for (int c = 0; c < 3; ++c) EXPECT_LT(std::abs(h.dPdx[c][k]) + std::abs(h.dPdy[c][k]), 20);
    });
    p.camera = front_camera(100, 401);
    p.take(finite);
}

TEST(Integrator, ShadesDenselyWholeTilesAtOnce) {
    TestMesh wall = square(100, 0);
    Picture p;
    p.camera = front_camera(128, 64);
    p.rows = {wall.geometry(1)};
    p.settings.samples_per_pixel = 2;
    Looks white([](const HitBatch&, size_t, vec3&, vec3&) {});
    p.take(white);
    EXPECT_EQ(white.largest_batch, 2u * 32 * 32);  // tiles of 64 would have more than 4096 rays
    EXPECT_EQ(white.batches, 8u);
}

TEST(Integrator, ResultsThatAreNotFiniteAreMendedAndCounted) {
    TestMesh wall = square(100, 0);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Picture p;
    p.rows = {wall.geometry(7)};
    Looks bad([&](const HitBatch& h, size_t k, vec3& Ci, vec3& Oi) {
        if (h.pixel_x[k] == 3) Ci.y = nan;
        if (h.pixel_x[k] == 4) Oi.x = std::numeric_limits<float>::infinity();
    });
    p.take(bad);
    EXPECT_EQ(p.counters.non_finite, 2u * 75);
    EXPECT_EQ(p.film.non_finite, 2u * 75);
    EXPECT_EQ(p.counters.non_finite_geometry, 7u);
    EXPECT_EQ(p.film.at(3, 10), vec4(0, 0, 0, 1));
    EXPECT_EQ(p.film.at(4, 10), vec4(0, 0, 0, 1));
    EXPECT_EQ(p.film.at(5, 10), vec4(1.0f));
    p.settings.nan = NanPolicy::Magenta;
    p.take(bad);
    EXPECT_EQ(p.film.at(3, 10), vec4(1, 0, 1, 1));
    p.settings.nan = NanPolicy::Keep;
    p.take(bad);
    EXPECT_TRUE(std::isnan(p.film.at(3, 10).y));
}

TEST(Integrator, ProgressCountsTilesAndCanStop) {
    TestMesh wall = square(100, 0);
    Picture p;
    p.camera = front_camera(256, 256);
    p.rows = {wall.geometry(1)};
    Looks white([](const HitBatch&, size_t, vec3&, vec3&) {});
    int last = 0;
    auto count = [&](int done, int total) {
        EXPECT_EQ(total, 16);
        EXPECT_EQ(done, last + 1);
        last = done;
        return true;
    };
    Progress progress = count;
    EXPECT_TRUE(p.take(white, &progress));
    EXPECT_EQ(last, 16);
    auto stop_at_once = [](int, int) { return false; };
    Progress stop = stop_at_once;
    EXPECT_FALSE(p.take(white, &stop));
}

TEST(Integrator, ShadingMayTraceItsOwnRays) {
    TestMesh wall = square(3, 0), lid = square(0.5, 1);  // the lid shades the wall's middle
    Picture p;
    p.rows = {wall.geometry(1), lid.geometry(2)};
    Looks looks([&](const HitBatch& h, size_t k, vec3& Ci, vec3&) {
        const vec3 P{h.P[0][k], h.P[1][k], h.P[2][k]},
            error{h.P_error[0][k], h.P_error[1][k], h.P_error[2][k]},
            N{h.Ng[0][k], h.Ng[1][k], h.Ng[2][k]}, up{0, 0, 1};
        RayPacket16 packet{};
        packet.active = 1;
        set_lane(packet, 0, offset_ray_origin(P, error, N, up), up);
        TraceCounters counters;
        Ci = vec3(p.accel.occluded16(packet, counters) ? 0.0f : 1.0f);
        const bool under = h.geometry[k] == 1 && std::abs(P.x) < 0.49f && std::abs(P.y) < 0.49f;
        const bool beside = h.geometry[k] == 2 || std::abs(P.x) > 0.51f || std::abs(P.y) > 0.51f;
        if (under) {
            EXPECT_EQ(Ci.x, 0);
        }
        if (beside) {
            EXPECT_EQ(Ci.x, 1);
        }
    });
    p.take(looks);
}

}  // namespace
}  // namespace kinora::raytrace::test
