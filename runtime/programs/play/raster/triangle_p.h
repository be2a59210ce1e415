// runtime/programs/play/raster/triangle_p.h: one triangle to spans.
#pragma once

#include <cstdint>

#include "runtime/programs/play/raster/raster.h"
#include "runtime/programs/play/raster/span_p.h"

namespace kinora::play {

// Pixels from (x0, y0) up to (x1, y1), those not included.
struct PixelBox {
    int x0, y0, x1, y1;
    bool empty() const { return x0 >= x1 || y0 >= y1; }
};

// A vertex with its position in 1/256 pixel.
struct Corner {
    int32_t x, y;
    float u, v;  // in 1/256 texel, less half a texel
    uint32_t rgba;
};

inline constexpr int kSubpixels = 256;

// The first pixel whose centre is at or after this coordinate.
constexpr int first_pixel(int32_t coordinate) {
    return (coordinate + kSubpixels / 2 - 1) >> 8;
}

// What a draw command has in common.
struct DrawState {
    const Target& target;
    const SpanKernel& kernel;
    PixelBox clip;
    SpanTexels texture;  // none: texels is null
};

void draw_triangle(const DrawState& state, const Corner& a, const Corner& b, const Corner& c);

}  // namespace kinora::play
