// raytrace/tiles/tile_job_p.h: one thread's work on one tile.
#pragma once

#include <algorithm>
#include <vector>

#include "raytrace/pixels/pixels.h"
#include "raytrace/tiles/integrator.h"
#include "raytrace/tiles/tile_planes_p.h"
#include "raytrace/zeroed_vector.h"

namespace kinora::raytrace {

struct Tile {
    int x0, y0, x1, y1;  // pixels [x0, x1) x [y0, y1)
    int width() const { return x1 - x0; }
    size_t pixels() const { return size_t(x1 - x0) * size_t(y1 - y0); }
};

inline constexpr int kBlock = 4;  // a packet of one sample is 4x4 pixels

// The pixels of a tile in the order of their rays: in blocks of four by four, of two by two, so
// that packets hold neighbours whatever number of samples a pixel has. The same for all tiles of a
// size.
struct TileOrder {
    int width = 0, height = 0;
    ZeroedVector<uint32_t> x, y;         // within the tile
    ZeroedVector<uint32_t> scramble[2];  // PixelSet::scramble

    void reserve(size_t pixels);
    void set_size(int w, int h);
    PixelSet pixels(const Tile& tile);
};

// What one thread needs for the tile it is at.
struct IntegratorScratch::Thread {
    RayBatch rays;
    HitStore hits, misses;
    IntegratorCounters counters;
    ZeroedVector<float> color[3], through[3];  // by slot (sample of the chunk)
    ZeroedVector<float> shaded[6];             // Ci, Oi by hit
    std::vector<Passage> passages;             // by hit
    std::vector<ZeroedVector<float>> shaded_aov;
    std::vector<float*> aov_pointers;
    TileOrder order;
    std::vector<SampleBits> samples;  // of the chunk, which all pixels share
    size_t begun = 0;   // rays from the first that hold what all rays of the camera share ...
    size_t passed = 0;  // but for so many, which went on behind hits
    ZeroedVector<double> sum;   // colour and coverage, by pixel of the tile, in its order
    ZeroedVector<double> held;  // of mattes: how much they hide, three a pixel
    PlaneMemory planes;

    void reserve(size_t chunk, size_t tile_pixels, size_t aovs);
};

PixelView pixel_view(const Camera& camera, bool spreads = true);

class TileJob {
  public:
    TileJob(const Accel& accel, const Camera& camera, SurfaceShading& shading, Film& film,
            const IntegratorSettings& settings, const FilterTable* filter,
            IntegratorScratch::Thread& scratch, int thread)
        : accel_(accel),
          camera_(camera),
          view_(pixel_view(camera, shading.reads_footprints())),
          shading_(shading),
          film_(film),
          settings_(settings),
          filter_(filter),
          m_(scratch),
          planes_(film, settings, filter, scratch.planes),
          thread_(thread) {}

    void run(const Tile& tile);
    // One sample of the tile's first pixel, over no background.
    vec4 run_sample(const Tile& tile, int sample);

  private:
    void begin_tile();
    void make_rays(int first_sample, int end_sample);
    void begin_rays(size_t begin, size_t end);
    void cut_rays(const dvec4& plane);
    void draw_from_grid();
    bool has_grid() const { return settings_.filter_grid && settings_.samples_per_pixel > 1; }
    double weight_of(size_t slot) const;
    void weigh_samples();
    void follow_layers();
    enum class Ends : uint8_t { Surfaces, Nothing };
    void shade(const HitBatch& hits, Ends ends = Ends::Surfaces);
    void shade_misses(const HitBatch& hits);
    void mend(const HitBatch& hits);
    bool mend_hit(size_t k);
    bool shows_first(const HitBatch& hits, size_t k) const;
    double hidden_by(const HitBatch& hits, size_t k) const;
    TilePlanes::Hit plane_hit(const HitBatch& hits, size_t k) const;
    void lay_light(const TilePlanes::Hit& hit, const HitBatch& hits, size_t k);
    void keep_planes(const HitBatch& hits);
    void count_samples();
    void composite(const HitBatch& hits);
    void hold_out(const HitBatch& hits);
    vec4 behind_mattes(size_t pixel) const;
    void lay_behind(const HitBatch& hits, size_t k);
    uint32_t lay_sixteen(const HitBatch& hits, size_t k);
    float largest_through(size_t slot) const;
    bool passes(size_t slot) const;
    void finish_samples();
    // Slots lie pixel by pixel, the samples of a pixel one behind the other.
    size_t pixel_of(size_t slot) const { return slot / m_.samples.size(); }
    void write_tile() const;

    const Accel& accel_;
    const Camera& camera_;
    const PixelView view_;
    const PixelKernels& kernels_ = pixel_kernels();
    SurfaceShading& shading_;
    Film& film_;
    const IntegratorSettings& settings_;
    const FilterTable* filter_;  // with several samples a pixel
    IntegratorScratch::Thread& m_;
    TilePlanes planes_;
    int thread_;
    Tile tile_{};
};

}  // namespace kinora::raytrace
