// runtime/scene/images/texture_sample.h: filtered lookups in a pyramid.
#pragma once

#include <cstdint>

#include "jit/ir/kernel.h"
#include "runtime/scene/description/texture_name.h"
#include "runtime/scene/images/texture_pyramid.h"

namespace kinora {

// Rows of kMaxLanes floats. The footprint is the parallelogram of (dsdx, dtdx), (dsdy, dtdy), in
// units of the image, widened by swidth and twidth and then by blur, a share of the image.
struct TextureLanes {
    const float *channel, *s, *t, *dsdx, *dtdx, *dsdy, *dtdy, *blur, *swidth, *twidth, *fill;
    float* results;  // [4][kMaxLanes], from `channel` on
};

inline constexpr int kMaxTaps = 16;

// Looks up the lanes of `mask`; the others are not written.
void sample_texture(const TexturePyramid& pyramid, const TextureName& modes, TextureFilter filter,
                    uint32_t mask, const TextureLanes& lanes);

}  // namespace kinora
