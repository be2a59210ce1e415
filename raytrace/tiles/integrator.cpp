// raytrace/tiles/integrator.cpp: shares the picture's tiles among the threads.
#include "raytrace/tiles/integrator.h"

#include <algorithm>
#include <atomic>
#include <mutex>

#include "raytrace/tiles/tile_job_p.h"
#include "runtime/base/check.h"

namespace kinora::raytrace {

IntegratorScratch::IntegratorScratch() = default;
IntegratorScratch::~IntegratorScratch() = default;

void IntegratorCounters::operator+=(const IntegratorCounters& o) {
    trace += o.trace;
    shading_points += o.shading_points;
    non_finite += o.non_finite;
    non_finite_geometry = std::min(non_finite_geometry, o.non_finite_geometry);
    too_deep += o.too_deep;
    stages += o.stages;
}

namespace {

// Rows of tiles from the top, left to right; pixels of the whole picture.
Tile tile_at(const Film& film, int size, int index) {
    const int across = (film.width + size - 1) / size;
    const int x = index % across * size, y = film.top + index / across * size;
    return {x, y, std::min(x + size, film.width), std::min(y + size, film.top + film.height)};
}

// Halved while the rays of all samples would not stay in the second cache.
int tile_size(const IntegratorSettings& settings) {
    constexpr int kRays = 4096, kSmallest = 16;
    int size = settings.tile;
    while (size % 8 == 0 && size / 2 >= kSmallest &&
           int64_t(size) * size * settings.samples_per_pixel > kRays)
        size /= 2;
    return size;
}

int tile_count(const Film& film, int size) {
    return ((film.width + size - 1) / size) * ((film.height + size - 1) / size);
}

void prepare(Film& film, const Camera& camera, const IntegratorSettings& settings, bool misses,
             IntegratorScratch& scratch) {
    if (film.is_band) {
        CHECK_EQ(film.width, camera.width);
        CHECK_LE(film.top + film.height, camera.height);
    } else if (film.width != camera.width || film.height != camera.height) {
        film.resize(camera.width, camera.height);
    }
    const PixelFilter* filter = settings.filter ? settings.filter : &pixel_filters()[0];
    const bool known = scratch.filter && scratch.filter_row == filter &&
                       scratch.filter_width == settings.filter_width;
    if (!known && settings.samples_per_pixel > 1) {
        scratch.filter =
            std::make_unique<FilterTable>(FilterSampler(*filter, settings.filter_width).table());
        scratch.filter_row = filter;
        scratch.filter_width = settings.filter_width;
    }
    while (scratch.threads.size() < size_t(thread_count()))
        scratch.threads.push_back(std::make_unique<IntegratorScratch::Thread>());
    const size_t pixels = size_t(settings.tile) * size_t(settings.tile);
    // A tile at the border is smaller and takes more samples a chunk, but never more rays.
    const size_t rays = std::min(std::max(settings.chunk_rays, pixels),
                                 pixels * size_t(settings.samples_per_pixel));
    for (auto& thread : scratch.threads) {
        thread->reserve(rays, pixels, film.aovs.size());
        thread->planes.reserve(film.aovs, pixels);
        if (misses) thread->misses.reserve(rays);
        thread->counters = {};
        thread->begun = thread->passed = 0;
    }
}

}  // namespace

bool integrate(const Accel& accel, const Camera& camera, SurfaceShading& shading, Film& film,
               const IntegratorSettings& settings, IntegratorScratch& scratch,
               IntegratorCounters& counters, const Progress* progress) {
    CHECK_GE(settings.samples_per_pixel, 1);
    CHECK_GE(settings.tile, kBlock);
    prepare(film, camera, settings, shading.miss_distance() > 0, scratch);
    const int size = tile_size(settings), tiles = tile_count(film, size);
    std::atomic<bool> stop{false};
    std::mutex mutex;
    int done = 0;
    StageScope idle(Stage::Idle);  // but for the tiles, which have clocks of their own
    parallel_for(0, size_t(tiles), 1, [&](size_t first, size_t last) {
        const int thread = thread_index();
        StageClock clock;
        RunningClock running(clock);
        TileJob job(accel, camera, shading, film, settings, scratch.filter.get(),
                    *scratch.threads[size_t(thread)], thread);
        for (size_t i = first;
             i < last && !stop.load(std::memory_order_relaxed) && !shading.stopped(); ++i) {
            job.run(tile_at(film, size, int(i)));
            if (!progress) continue;
            std::lock_guard lock(mutex);
            if (!(*progress)(++done, tiles)) stop = true;
        }
        scratch.threads[size_t(thread)]->counters.stages += clock.ticks();
    });
    IntegratorCounters total;
    for (auto& thread : scratch.threads) total += thread->counters;
    film.non_finite += total.non_finite;
    counters += total;
    return !stop && !shading.stopped();
}

vec4 integrate_sample(const Accel& accel, const Camera& camera, SurfaceShading& shading, Film& film,
                      const IntegratorSettings& settings, IntegratorScratch& scratch, int x, int y,
                      int sample) {
    prepare(film, camera, settings, shading.miss_distance() > 0, scratch);
    CHECK_LT(x, film.width);
    CHECK_LT(y, film.height);
    CHECK_LT(sample, settings.samples_per_pixel);
    vec4 result(0.0f);
    parallel_for(0, 1, 1, [&](size_t, size_t) {
        const int thread = thread_index();
        TileJob job(accel, camera, shading, film, settings, scratch.filter.get(),
                    *scratch.threads[size_t(thread)], thread);
        result = job.run_sample({x, y, x + 1, y + 1}, sample);
    });
    return result;
}

}  // namespace kinora::raytrace
