// runtime/player/bytes/byte_kernels.h: colors to bytes by tables of functions that grow.
#pragma once

#include <cstddef>
#include <cstdint>

#include "runtime/base/kernel_table.h"

namespace kinora {

inline constexpr size_t kByteRun = 16;  // pixels at a time

// 128 steps in each power of two, from 2^-14 (byte 0 in either encoding) to 1, which is the last.
// A step is `from << 8 | byte`: the byte where it begins, which is one more for numbers whose lower
// kStepShift bits are `from` or above.
inline constexpr int kStepShift = 16;
inline constexpr int32_t kFirstStep = (127 - 14) << 7, kStepCount = (14 << 7) + 1;

struct ByteKernels {
    const char* name;
    // The bytes of kByteRun pixels, RGBA, by a table for colors, which are divided by the alpha
    // where that is above 0, and one for alphas. False, and nothing that counts in `to`, where a
    // number is not finite.
    bool (*bytes)(const float* rgba, const int32_t* steps, const int32_t* alphas, uint8_t* to);
};
KINORA_KERNEL_TABLES(ByteKernels, Byte);

// Those this CPU can run, and the widest of them.
const UsableKernels<ByteKernels>& usable_byte_kernels();
const ByteKernels& byte_kernels();

}  // namespace kinora
