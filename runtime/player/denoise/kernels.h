// runtime/player/denoise/kernels.h: one pass of a joint a-trous filter over a stretch of a row.
//
// H. Dammertz, D. Sewtz, J. Hanika, H. Lensch, Edge-Avoiding A-Trous Wavelet Transform for fast
// Global Illumination Filtering, 2010; the noise's part of the weight as C. Schied and others,
// Spatiotemporal Variance-Guided Filtering, 2017.
#pragma once

#include <cstddef>
#include <cstdint>

#include "runtime/base/kernel_table.h"

namespace kinora {

inline constexpr size_t kFilterRun = 64;  // pixels that a kernel does at once

// What lies at each pixel: pointers to the first pixel of the stretch, in planes with a border as
// wide as the widest step.
struct FilterGuide {
    const float* N[3];        // length 1, or 0 where there is none
    const float* depth;       // linear over the picture on a plane (Planes::depth)
    const float* slope[2];    // its change from a pixel to the next one, and to the one below
    const float* albedo;      // brightness of the diffuse texture; 0 where there is none
    const uint32_t* surface;  // pixels of different ones are never mixed
};

// The colors of a pass and the variance of their brightness.
struct FilterColors {
    const float* c[4];
    const float* variance;
};
struct FilterResult {
    float* c[4];
    float* variance;
};

struct FilterKernels {
    const char* name;
    // kFilterRun pixels: each the mean of nine that are `step` pixels apart, those counting less
    // that lie on another plane, face elsewhere, have another texture, or differ by more than the
    // noise. Planes have rows of `stride` floats.
    void (*pass)(const FilterGuide& guide, const FilterColors& from, int step, ptrdiff_t stride,
                 const FilterResult& to);
    // Whether any of kFilterRun numbers exceeds `limit`.
    bool (*exceeds)(const float* numbers, float limit);
    // Variances of a stretch, each the mean of those of the nine pixels about it that are on its
    // surface.
    void (*smooth_variance)(const uint32_t* surface, const float* variance, ptrdiff_t stride,
                            float* to);
};
KINORA_KERNEL_TABLES(FilterKernels, Filter);

// Those this CPU can run, and the widest of them.
const UsableKernels<FilterKernels>& usable_filter_kernels();
const FilterKernels& filter_kernels();

}  // namespace kinora
