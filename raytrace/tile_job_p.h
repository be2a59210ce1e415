// raytrace/tile_job_p.h: one thread's work on one tile.
#pragma once

#include <algorithm>
#include <vector>

#include "raytrace/integrator.h"

namespace kinora::raytrace {

struct Tile {
    int x0, y0, x1, y1;  // pixels [x0, x1) x [y0, y1)
    int width() const { return x1 - x0; }
    size_t pixels() const { return size_t(x1 - x0) * size_t(y1 - y0); }
    size_t pixel(uint32_t x, uint32_t y) const {
        return size_t(int(y) - y0) * size_t(width()) + size_t(int(x) - x0);
    }
};

inline constexpr int kBlock = 4;  // a packet is 4x4 pixels of one sample

// What one thread needs for the tile it is at.
struct IntegratorScratch::Thread {
    RayBatch rays;
    HitStore hits, misses;
    IntegratorCounters counters;
    std::vector<float> color[3], through[3];  // by slot (sample of the chunk)
    std::vector<float> shaded[6];             // Ci, Oi by hit
    std::vector<Passage> passages;            // by hit
    std::vector<std::vector<float>> shaded_aov;
    std::vector<float*> aov_pointers;
    std::vector<uint32_t> slot_pixel;
    std::vector<double> sum[4];  // by pixel of the tile
    std::vector<std::vector<double>> sum_aov;

    void reserve(size_t chunk, size_t tile_pixels, size_t aovs);
};

class TileJob {
  public:
    TileJob(const Accel& accel, const Camera& camera, SurfaceShading& shading, Film& film,
            const IntegratorSettings& settings, const FilterSampler& filter,
            IntegratorScratch::Thread& scratch, int thread)
        : accel_(accel),
          camera_(camera),
          shading_(shading),
          film_(film),
          settings_(settings),
          filter_(filter),
          m_(scratch),
          thread_(thread) {}

    void run(const Tile& tile);

  private:
    void begin_tile();
    void make_rays(int first_sample, int end_sample);
    void add_ray(uint32_t x, uint32_t y, uint32_t sample);
    void follow_layers();
    enum class Ends : uint8_t { Surfaces, Nothing };
    void shade(const HitBatch& hits, Ends ends = Ends::Surfaces);
    void shade_misses(const HitBatch& hits);
    void mend(const HitBatch& hits);
    bool mend_hit(size_t k);
    bool shows_first(const HitBatch& hits, size_t k) const;
    void keep_aovs(const HitBatch& hits);
    void composite(const HitBatch& hits);
    void lay_behind(const HitBatch& hits, size_t k);
    float largest_through(size_t slot) const;
    bool passes(size_t slot) const;
    void finish_samples(size_t slots);
    void write_tile() const;

    const Accel& accel_;
    const Camera& camera_;
    SurfaceShading& shading_;
    Film& film_;
    const IntegratorSettings& settings_;
    const FilterSampler& filter_;
    IntegratorScratch::Thread& m_;
    int thread_;
    Tile tile_{};
};

}  // namespace kinora::raytrace
