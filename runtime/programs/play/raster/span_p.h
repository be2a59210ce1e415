// runtime/programs/play/raster/span_p.h: what a span kernel is given, and the table of kernels.
//
// A span is a run of pixels of one row. The kernel files are compiled for one instruction set each,
// so this header and what they include must hold no inline function: the linker could keep the
// wrong copy of it.
#pragma once

#include <cstdint>

namespace kinora::play {

// A texture as kernels see it, with one 32-bit word or one byte a texel.
struct SpanTexels {
    const uint8_t* texels;
    int width, height;
    int alpha_only, smooth;
};

// Values at the first pixel's centre, and how they change from a pixel to the next.
struct SpanPaint {
    float color[4], color_dx[4];  // r g b a of the vertices, 0..255
    float u, v, u_dx, v_dx;       // in 1/256 texel, less half a texel
    SpanTexels texture;
};

struct SpanKernel {
    const char* name;
    void (*solid)(uint32_t* pixels, int count, uint32_t rgba);
    void (*masked)(uint32_t* pixels, int count, const uint8_t* mask, uint32_t rgba);
    void (*shaded)(uint32_t* pixels, int count, const SpanPaint& paint);
    void (*textured)(uint32_t* pixels, int count, const SpanPaint& paint);
};
extern const SpanKernel kPortableSpans;
extern const SpanKernel kAvx2Spans;

// The fastest that this CPU runs, or the one of this name.
const SpanKernel& span_kernel(const char* name);

}  // namespace kinora::play
