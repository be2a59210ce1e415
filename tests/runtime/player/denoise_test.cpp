// tests/runtime/player/denoise_test.cpp: the noise of pictures that move, and what is no noise.
#include "runtime/player/denoise/denoiser.h"

#include <cmath>
#include <cstdio>
#include <cstring>

#include "runtime/kinora/open_scene.h"
#include "runtime/picture/frame/frame.h"
#include "runtime/player/denoise/kernels.h"
#include "runtime/player/denoise/planes.h"
#include "runtime/player/session/free_camera.h"
#include "runtime/scene/camera.h"
#include "tests/runtime/player/played.h"

namespace kinora {
namespace {

// A pass as its header says it, in double and by another order.
double filtered_red(const Planes& p, int x, int y, int step) {
    const size_t here = p.at(x, y);
    const auto bright = [&](size_t at) {
        return 0.2126 * p.c[0][at] + 0.7152 * p.c[1][at] + 0.0722 * p.c[2][at];
    };
    double sum = 0, weights = 0;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
            const size_t at = p.at(x + dx * step, y + dy * step);
            if (p.surface[at] != p.surface[here]) continue;
            double facing = 0;
            for (int k = 0; k < 3; ++k) facing += double(p.N[k][at]) * p.N[k][here];
            const double apart = 100 *
                                 (p.depth[at] - p.depth[here] -
                                  step * (dx * p.slope[0][here] + dy * p.slope[1][here])) /
                                 std::abs(p.depth[here]);
            const double texture = p.albedo[at] - p.albedo[here];
            const double noise = 6 * (p.variance[here] + 1e-7);
            const double weight = (dx || dy ? std::pow(std::max(facing, 0.0), 32) : 1) *
                                  (dx ? 0.25 : 0.5) * (dy ? 0.25 : 0.5) / (1 + apart * apart) /
                                  (1 + 400 * texture * texture) /
                                  (1 + std::pow(bright(at) - bright(here), 2) / noise);
            sum += weight * p.c[0][at];
            weights += weight;
        }
    return sum / weights;
}

// Two walls that meet in a corner, a texture on one of them, another surface below.
Planes corner() {
    Planes planes;
    planes.resize(64, 32);
    uint32_t state = 1;
    const auto number = [&] {
        state = state * 1664525u + 1013904223u;
        return float(state >> 8) / float(1 << 24);
    };
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) {
            const size_t at = planes.at(x, y);
            const bool left = x < 30;
            planes.surface[at] = y < 24 ? 4 : 9;
            planes.N[0][at] = left ? 0.6f : -0.6f;
            planes.N[2][at] = 0.8f;
            planes.slope[0][at] = left ? 0.01f : -0.01f;
            planes.depth[at] = 1 + (left ? 0.01f : -0.01f) * float(x - 30);
            planes.albedo[at] = left && (x / 4 & 1) ? 0.5f : 0.1f;
            for (int k = 0; k < 4; ++k) planes.c[k][at] = number();
            planes.variance[at] = x == 40 ? 0 : 0.1f * number() + 0.001f;
        }
    return planes;
}

TEST(Denoise, EveryKernelGivesTheSameBitsAndWhatThePassMeans) {
    const Planes planes = corner();
    std::vector<float> first;
    for (size_t k = 0; k < usable_filter_kernels().count; ++k) {
        const FilterKernels& kernels = *usable_filter_kernels().kernels[k];
        std::vector<float> all;
        for (int step : {1, 2, 4, 8})
            for (int y = 0; y < planes.height; ++y) {
                const size_t at = planes.at(0, y);
                alignas(64) float c[4][kFilterRun], variance[kFilterRun], smooth[kFilterRun];
                kernels.pass(
                    {{&planes.N[0][at], &planes.N[1][at], &planes.N[2][at]},
                     &planes.depth[at],
                     {&planes.slope[0][at], &planes.slope[1][at]},
                     &planes.albedo[at],
                     &planes.surface[at]},
                    {{&planes.c[0][at], &planes.c[1][at], &planes.c[2][at], &planes.c[3][at]},
                     &planes.variance[at]},
                    step, planes.stride, {{c[0], c[1], c[2], c[3]}, variance});
                kernels.smooth_variance(&planes.surface[at], &planes.variance[at], planes.stride,
                                        smooth);
                all.insert(all.end(), &c[0][0], &c[0][0] + sizeof(c) / sizeof(float));
                all.insert(all.end(), std::begin(variance), std::end(variance));
                all.insert(all.end(), std::begin(smooth), std::end(smooth));
                for (int x = 0; x < 64; ++x)
                    ASSERT_NEAR(
                        c[0][x],
                        x == 40 ? planes.c[0][planes.at(x, y)] : filtered_red(planes, x, y, step),
                        2e-6)
                        << kernels.name << ' ' << x << ' ' << y << ' ' << step;
                EXPECT_EQ(kernels.exceeds(&planes.variance[at], 0.2f), false);
                EXPECT_EQ(kernels.exceeds(&planes.variance[at], 0.0005f), true);
            }
        if (k == 0) first = all;
        EXPECT_EQ(0, std::memcmp(first.data(), all.data(), all.size() * sizeof(float)))
            << kernels.name;
    }
}

struct Filtered {
    double raw = 0, filtered = 0;  // RMSE against a picture of many samples
    bool noisy = false, changed = false;
};

// What a screen shows of a pixel.
vec3 shown(const raytrace::Film& film, size_t pixel) {
    return glm::min(vec3(film.rgba[pixel]), 1.0f);
}

// No edge goes through the pixel: those about it show much the same.
bool is_even(const raytrace::Film& film, size_t pixel) {
    const int x = int(pixel % size_t(film.width)), y = int(pixel / size_t(film.width));
    if (x == 0 || y == 0 || x + 1 == film.width || y + 1 == film.height) return false;
    for (int k = 0; k < 9; ++k) {
        const size_t near = size_t(y + k / 3 - 1) * size_t(film.width) + size_t(x + k % 3 - 1);
        if (glm::length(shown(film, near) - shown(film, pixel)) > 0.06f) return false;
    }
    return true;
}

// Of the even pixels of `wanted`: a filter that moves with the picture softens edges.
double rmse(const raytrace::Film& film, const raytrace::Film& wanted) {
    double sum = 0, count = 0;
    for (size_t k = 0; k < film.rgba.size(); ++k) {
        if (!is_even(wanted, k)) continue;
        const vec3 d = shown(film, k) - shown(wanted, k);
        sum += double(glm::dot(d, d));
        count += 3;
    }
    EXPECT_GT(count, 1.5 * double(film.rgba.size()));
    return std::sqrt(sum / count);
}

// Some frames, moving or not, of one sample a pixel each; the last one is compared with the mean of
// `pictures` like it by other random numbers: the same edges, without the noise.
Filtered filtered(const std::string& name, bool moves, uint32_t pictures, int width = 160) {
    SceneRequest request = small_request(scene_path(name), 1);
    request.quality.diffuse_depth = 1;
    request.width = width;
    request.height = width * 9 / 16;
    OpenedScene opened(request);
    Diagnostics& diagnostics = opened.diagnostics;
    const FrameRate rate = opened.rate;
    const Scene& scene = *opened.scene;
    Pose& pose = *opened.pose;
    FrameSettings& settings = opened.settings;
    Denoiser denoiser;
    FirstHits hits;
    raytrace::Film film, before, wanted;
    FrameStats stats;
    Filtered result;
    std::optional<FreeCamera> camera;
    PlacedCamera placed;
    constexpr int kFrames = 8;
    for (int frame = 0; frame < kFrames; ++frame) {
        const int64_t at = moves ? frame : 0;
        settings.integrator.seed = frame_seed(request, frame);
        settings.insight.first = &hits;
        if (camera) {
            if (moves) orbit(*camera, dvec3(0, 1, 0), 1.0, 0.5);
            placed = placed_camera(scene, pose, *camera, {}, rate.time(at));
            settings.camera = &placed;
        }
        EXPECT_TRUE(render_frame(scene, pose, rate.time(at), settings, film, stats, diagnostics));
        if (!camera) camera = free_camera_of(pose.view, scene.origin, scene.size);
        before = film;
        result.noisy = denoiser.filter(scene, pose, hits, film);
        if (frame + 1 < kFrames) continue;
        settings.insight.first = nullptr;
        raytrace::Film other;
        for (uint32_t k = 0; k < pictures; ++k) {
            settings.integrator.seed = 1000 + k;
            EXPECT_TRUE(
                render_frame(scene, pose, rate.time(at), settings, other, stats, diagnostics));
            if (k == 0) wanted = other;
            for (size_t p = 0; k > 0 && p < other.rgba.size(); ++p)
                wanted.rgba[p] += (other.rgba[p] - wanted.rgba[p]) / float(k + 1);
        }
    }
    result.raw = rmse(before, wanted);
    result.filtered = rmse(film, wanted);
    result.changed =
        std::memcmp(before.rgba.data(), film.rgba.data(), film.rgba.size() * sizeof(vec4)) != 0;
    std::printf("%s %s: RMSE %.4f, filtered %.4f\n", name.c_str(), moves ? "moving" : "still",
                result.raw, result.filtered);
    return result;
}

TEST(Denoise, PicturesComeNearerToTheRefinedOne) {
    const struct {
        const char* name;
        bool moves;
    } cases[] = {
        {"scenes/rays.dae", false}, {"scenes/rays.dae", true}, {"scenes/tintoy.dae", true}};
    for (const auto& [name, moves] : cases) {
        const Filtered picture = filtered(name, moves, 16, 96);
        EXPECT_TRUE(picture.noisy) << name;
        EXPECT_LT(picture.filtered, 0.8 * picture.raw) << name << moves;
    }
}

// Patterns, edges and hard shadows are none.
TEST(Denoise, WhatIsNoNoiseStaysBitForBit) {
    for (const char* name : {"scenes/matte.dae", "scenes/layers.dae", "scenes/attach.dae"}) {
        const Filtered picture = filtered(name, true, 1);
        EXPECT_FALSE(picture.changed) << name;
    }
}

}  // namespace
}  // namespace kinora
