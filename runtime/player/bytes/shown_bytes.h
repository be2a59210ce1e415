// runtime/player/bytes/shown_bytes.h: colors to what a screen shows of them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raytrace/film.h"
#include "runtime/player/bytes/byte_kernels.h"
#include "runtime/scene/images/image_io.h"

namespace kinora {

// The bytes of to_8_bit, RGBA, sooner; `to` has four for each pixel.
void shown_bytes(std::span<const vec4> pixels, ColorEncoding encoding, uint8_t* to,
                 const ByteKernels& kernels = byte_kernels());

// Of a whole film, on all threads.
void fast_8_bit(const raytrace::Film& film, ColorEncoding encoding, std::vector<uint8_t>& out);

}  // namespace kinora
