// raytrace/pixels/pixels.h: samples of pixels to camera rays, and colours of samples to pixels,
// many at a time; one source, compiled per instruction set and chosen at run time.
//
// The kernel files are compiled for one instruction set each, so this header must hold no inline
// function of the library: the linker could keep the wrong copy of it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "runtime/base/kernel_table.h"

namespace kinora::raytrace {

// The inverse of a filter's integral, tabulated: FilterSampler::offset as value + step * fraction.
inline constexpr uint32_t kFilterCells = 1024;
struct FilterTable {
    struct Cell {
        double value, step;  // to the next cell's value
    };
    Cell cells[kFilterCells];
    bool linear;  // all steps are the same, so the first cell is enough
};

// A camera as its rays need it; raytrace/camera.h. Axes are unit and at right angles.
struct PixelView {
    bool orthographic;
    bool clip;
    bool without_spread;  // nobody reads how rays spread
    double znear, zfar;
    double eye[3], forward[3];
    double dx[3], dy[3];          // from one pixel to the next, and to the one below
    double dx_square, dy_square;  // their squared lengths
    double centre_x, centre_y;    // where it looks, pixels
};

// The pixels of a tile in the order of their rays.
struct PixelSet {
    size_t count;
    uint32_t x0, y0;  // added to x and y
    const uint32_t* x;
    const uint32_t* y;
    uint32_t*
        scramble[2];  // filled by `scrambles`, read by the others: what permutes a pixel's samples
};

// Numbers of one sample that all pixels share (raytrace/sampling.h, stratified_sample).
struct SampleBits {
    uint32_t index;           // first dimension: van der Corput's, reversed
    uint32_t sobol_reversed;  // second
};
SampleBits sample_bits(uint32_t sample);

// Columns of RayBatch, at the first sample of the set's first pixel.
struct PixelRays {
    float* org[3];  // orthographic: written; perspective: not, nor first_org
    float* first_org[3];
    float* dir[3];
    float* ddir_dx[3];  // perspective: written, but for PixelView::without_spread
    float* ddir_dy[3];
    float* tnear;  // with PixelView::clip: written
    float* tfar;
    uint32_t* pixel_x;
    uint32_t* pixel_y;
    uint32_t* sample;  // SampleBits::index
};

inline constexpr size_t kLaid = 16;

// What sixteen hits of as many samples show: opacity may be out of 0..1. Behind a hit a sample sees
// `onward` times what is there.
struct LaidHits {
    const float* Ci[3];
    const float* Oi[3];
    float onward[kLaid];
};

struct PixelKernels {
    const char* name;
    // PixelSet::scramble from the pixels and the frame's seed.
    void (*scrambles)(const PixelSet& pixels, uint32_t seed);
    // Rays of n samples of all pixels, those of a pixel one behind the other. `filter` null:
    // through the pixels' centres.
    void (*rays)(const PixelView& view, const PixelSet& pixels, const SampleBits* samples, size_t n,
                 const FilterTable* filter, const PixelRays& out);
    // Whether sixteen numbers of each column, from `first` on, are finite.
    bool (*finite)(const float* const* columns, size_t count, size_t first);
    // Lays the hits behind what the samples show. A bit for each sample that still lets more than
    // `least` through in some component.
    uint32_t (*lay)(const LaidHits& hits, float least, float* const color[3],
                    float* const through[3]);
    // Adds n samples of each of `pixels` pixels, in the order of their rays, to the pixels' sums:
    // colour and coverage, four a pixel. What a sample shows lies before `background` where that is
    // not null.
    void (*add)(size_t pixels, size_t n, const float* const color[3], const float* const through[3],
                const float* background, double* sums);
};
KINORA_KERNEL_TABLES(PixelKernels, Pixels);

// Those this CPU can run, and the widest of them.
const UsableKernels<PixelKernels>& usable_pixel_kernels();
const PixelKernels& pixel_kernels();

}  // namespace kinora::raytrace
