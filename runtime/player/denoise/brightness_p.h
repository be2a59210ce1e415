// runtime/player/denoise/brightness_p.h: what the kernels of the filter and of the history compare.
#pragma once

namespace kinora {
namespace {

// Of linear Rec. 709 colors, IEC 61966-2-1. Inlined into each instruction set's own code.
__attribute__((always_inline)) inline float brightness(float r, float g, float b) {
    return 0.2126f * r + 0.7152f * g + 0.0722f * b;
}

}  // namespace
}  // namespace kinora
