// runtime/player/denoise/history_kernels.h: what was seen before, mixed with what is new, over a
// stretch of a row.
//
// C. Schied and others, Spatiotemporal Variance-Guided Filtering, 2017.
#pragma once

#include <cstddef>
#include <cstdint>

#include "runtime/base/kernel_table.h"
#include "runtime/player/denoise/kernels.h"

namespace kinora {

inline constexpr float kNewestShare = 0.2f;  // the least of the newest picture
inline constexpr float kFewPictures = 4;     // say little about a variance

// Of each pixel, in planes with a border two pixels wide.
struct SeenRows {
    const float* c[4];
    const float *first, *second;  // means of the brightness and of its square
    const float* count;           // pictures; 0: nothing was seen there
};

// A pixel that was seen, as Planes has it, in one line of the cache: others find it anywhere.
struct alignas(64) SeenPixel {
    float c[4];
    float first, second, count;  // SeenRows
    float depth;
    float N[3];
    float slope[2];
    uint32_t surface;
};

// A picture that was seen: its first pixel, in rows with a border about them.
struct PictureBefore {
    int width, height;
    ptrdiff_t stride;
    const SeenPixel* pixels;
};

// Where pixels look in the picture before: what they show there and how deep it would lie.
struct LookBack {
    const float *x, *y;  // pixels, between centers; -1 and less: nowhere
    const float* depth;
    const uint32_t* surface;
    const float* N[3];
};
struct SeenResult {
    float* c[4];
    float *first, *second, *count;
};

struct BlendRows {
    const uint32_t* surface;
    const float* variance;  // pixels without stay what they are
    const float* fresh[4];  // the new picture's colors
    SeenRows seen;          // what the picture before has
    float* c[4];            // the new colors; mixed
    float *first, *second, *count;
};

struct HistoryKernels {
    const char* name;
    // What the picture before has at kFilterRun places, between its pixels that show the same
    // surface at the same depth, facing as much the same way; a count of 0 where there are none.
    void (*look_back)(const PictureBefore& before, const LookBack& rows, const SeenResult& to);
    // kFilterRun pixels. A color from before lies within what the surface shows about the pixel
    // now, since what mirrors show, and shadows, does not move with the surface (M. Salvi's
    // variance clipping, 2016). What has changed about the pixel by more than noise makes the new
    // picture's share larger: a shadow that glides over a surface leaves no trail.
    void (*blend)(const BlendRows& rows, ptrdiff_t stride);
    // The variance of each mixed brightness, where there was one; `seen` are the pixel's own
    // pictures. Where less than kFewPictures say so, by the pixels around.
    void (*find_variance)(const uint32_t* surface, const SeenRows& seen, ptrdiff_t stride,
                          float* variance);
};
KINORA_KERNEL_TABLES(HistoryKernels, History);

// Those this CPU can run, and the widest of them.
const UsableKernels<HistoryKernels>& usable_history_kernels();
const HistoryKernels& history_kernels();

}  // namespace kinora
