// tests/runtime/player/denoise_moving_test.cpp: a soft shadow that glides over a floor: the filter
// may neither smear its edge nor leave a trail of it.
//
// The same ten pictures are made many times by other random numbers. The mean of the filtered ones,
// less the true picture, is what the filter does wrong whatever the noise: a trail is a share of
// what the pictures before showed.
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "runtime/kinora/open_scene.h"
#include "runtime/picture/frame/frame.h"
#include "runtime/player/denoise/denoiser.h"
#include "tests/folders.h"
#include "tests/runtime/player/played.h"

namespace kinora {
namespace {

constexpr int kFrames = 10, kRuns = 6, kTruth = 64;
constexpr int64_t kFirst = 8;

float bright(const raytrace::Film& film, size_t pixel) {
    const vec4& c = film.rgba[pixel];
    return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
}

class Gliding {
  public:
    Gliding()
        : request_(small_request(project_folder() + "/tests/runtime/player/moving_shadow.dae")) {
        request_.width = 160;
        request_.height = 90;
        set_thread_count(2);
        auto imported = import_requested(request_, diagnostics_);
        rate_ = imported->rate;
        BuiltScene built = build_imported(std::move(*imported), diagnostics_);
        scene_ = std::move(built.scene);
        pose_ = std::move(built.pose);
        settings_ = frame_settings(request_, *scene_, *pose_, diagnostics_);
    }

    void frame(int64_t at, uint32_t seed, raytrace::Film& film, FirstHits* hits) {
        settings_.integrator.seed = seed;
        settings_.insight.first = hits;
        FrameStats stats;
        EXPECT_TRUE(
            render_frame(*scene_, *pose_, rate_.time(at), settings_, film, stats, diagnostics_));
    }

    // Brightness of a time without noise.
    std::vector<float> truth(int64_t at) {
        raytrace::Film film;
        std::vector<float> sum;
        for (uint32_t k = 0; k < kTruth; ++k) {
            frame(at, 5000 + k, film, nullptr);
            sum.resize(film.rgba.size());
            for (size_t p = 0; p < sum.size(); ++p) sum[p] += bright(film, p) / kTruth;
        }
        return sum;
    }

    // The last of a run's pictures, as it was made and as it is shown.
    void run(uint32_t number, raytrace::Film& raw, raytrace::Film& shown) {
        Denoiser denoiser;
        for (int k = 0; k < kFrames; ++k) {
            frame(kFirst + k, 100 * number + uint32_t(k), shown, &hits_);
            raw = shown;
            EXPECT_TRUE(denoiser.filter(*scene_, *pose_, hits_, shown));
        }
    }

    const FirstHits& hits() const { return hits_; }

  private:
    SceneRequest request_;
    Diagnostics diagnostics_;
    FrameRate rate_;
    std::unique_ptr<Scene> scene_;
    std::unique_ptr<Pose> pose_;
    FrameSettings settings_;
    FirstHits hits_;
};

TEST(DenoiseMoving, AShadowLeavesNoTrail) {
    Gliding scene;
    constexpr int64_t kLast = kFirst + kFrames - 1;
    const std::vector<float> now = scene.truth(kLast), before = scene.truth(kLast - 1);
    std::vector<float> mean(now.size());
    double raw_error = 0, shown_error = 0, moved = 0, edges = 0;
    raytrace::Film raw, shown;
    std::vector<uint8_t> is_edge(now.size());
    for (uint32_t run = 0; run < kRuns; ++run) {
        scene.run(run, raw, shown);
        if (run == 0)
            for (size_t p = 0; p < now.size(); ++p) {
                // The shadow's edge: the floor, where a picture's time changes it.
                is_edge[p] = scene.hits().surface[p] == 0 &&
                             std::abs(now[p] - before[p]) > 0.008f &&
                             std::abs(now[p] - before[p]) < 0.1f;
                edges += is_edge[p];
            }
        for (size_t p = 0; p < now.size(); ++p) {
            mean[p] += bright(shown, p) / kRuns;
            if (!is_edge[p]) continue;
            raw_error += std::pow(bright(raw, p) - now[p], 2) / kRuns;
            shown_error += std::pow(bright(shown, p) - now[p], 2) / kRuns;
        }
    }
    double lag = 0, bias = 0;
    for (size_t p = 0; p < now.size(); ++p) {
        if (!is_edge[p]) continue;
        const double change = double(before[p]) - now[p];
        lag += (mean[p] - now[p]) * change;
        moved += change * change;
        bias += std::pow(mean[p] - now[p], 2);
    }
    std::printf(
        "%.0f pixels of the edge: RMSE %.4f, filtered %.4f; wrong on average %.4f; %.2f pictures "
        "late\n",
        edges, std::sqrt(raw_error / edges), std::sqrt(shown_error / edges),
        std::sqrt(bias / edges), lag / moved);
    EXPECT_GT(edges, 100);
    EXPECT_LT(shown_error, 0.8 * raw_error);
    EXPECT_LT(lag / moved, 0.2);
}

}  // namespace
}  // namespace kinora
