// raytrace/tiles/tile_planes_p.h: what the pixels of a tile keep of their samples for the film's
// planes.
#pragma once

#include <span>
#include <vector>

#include "raytrace/film.h"
#include "raytrace/pixels/pixels.h"
#include "raytrace/tiles/integrator.h"
#include "raytrace/zeroed_vector.h"

namespace kinora::raytrace {

// A thread's memory for one tile.
struct PlaneMemory {
    // Some of a pixel that something covers.
    struct Covered {
        uint32_t pixel;
        float id;
        double part;
    };
    std::vector<ZeroedVector<double>> sums;  // by plane, by pixel of the tile, in its order
    ZeroedVector<uint32_t> hit;              // samples of the pixel that hit
    ZeroedVector<uint32_t> nearest;          // the pixel's sample nearest to its centre
    // Of the samples' colours, three a pixel: B. P. Welford 1962.
    ZeroedVector<double> mean, squares;
    ZeroedVector<uint32_t> counted;             // samples in them
    std::vector<std::vector<Covered>> covered;  // by plane; empty but for the first of twelve

    void reserve(std::span<const AovPlane> planes, size_t pixels);
};

class TilePlanes {
  public:
    TilePlanes(const Film& film, const IntegratorSettings& settings, const FilterTable* filter,
               PlaneMemory& memory);

    // A hit of a sample.
    struct Hit {
        size_t at;  // in the shaded columns
        size_t pixel;
        uint32_t sample;
        double weight;  // of the sample, in the pixel filter
    };

    void begin(const PixelSet& pixels);
    // The first hit of a sample that is there at all.
    void keep(const Hit& hit, std::span<float* const> shaded);
    // Any hit of a sample, and how much of what lay behind it hides: once Ci and Oi are known.
    void cover(const Hit& hit, double part, std::span<float* const> shaded);
    // Composites a hit or a miss; `through`: the transmission of the layers before it.
    void lay(const Hit& hit, const float through[3], std::span<float* const> shaded);
    bool has_light() const { return has_light_; }
    bool has_coverage() const { return has_coverage_; }
    // After the last sample.
    void finish();
    bool has_variance() const { return has_variance_; }
    // A sample's colour; samples of a pixel come in their order.
    void count(size_t pixel, const vec3& color);
    // What the film gets, once all samples have been kept.
    float value(size_t plane, size_t pixel) const;

  private:
    void find_nearest(const PixelSet& pixels);
    dvec2 offset_of(uint32_t sample, uint32_t x, uint32_t y) const;
    void rank(size_t first_plane);
    float variance(size_t pixel, int component) const;

    const Film& film_;
    const IntegratorSettings& settings_;
    const FilterTable* filter_;
    PlaneMemory& m_;
    bool has_nearest_ = false, has_variance_ = false, has_coverage_ = false, has_light_ = false;
};

}  // namespace kinora::raytrace
