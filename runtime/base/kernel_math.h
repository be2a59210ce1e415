// runtime/base/kernel_math.h: small parts that kernels of several rooms share.
//
// Files compiled for one instruction set include this: every function is always inlined, so that
// the linker has no copy to choose from.
#pragma once

#include <cstddef>
#include <cstdint>

namespace kinora {

#define KINORA_KERNEL_PART __attribute__((always_inline)) inline

using FourFloats = float __attribute__((vector_size(16)));

// x, y and z of four corners, four floats each as meshes have them, into places i to i + 3 of three
// rows.
template <size_t kPlaces>
KINORA_KERNEL_PART void corners_to_rows(const float (*corner)[4], size_t i,
                                        float (&rows)[3][kPlaces]) {
    FourFloats a, b, c, d;
    __builtin_memcpy(&a, corner[0], 16);
    __builtin_memcpy(&b, corner[1], 16);
    __builtin_memcpy(&c, corner[2], 16);
    __builtin_memcpy(&d, corner[3], 16);
    const FourFloats ab = __builtin_shufflevector(a, b, 0, 4, 1, 5),
                     cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
    const FourFloats x = __builtin_shufflevector(ab, cd, 0, 1, 4, 5),
                     y = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
    const FourFloats zab = __builtin_shufflevector(a, b, 2, 6, 2, 6),
                     zcd = __builtin_shufflevector(c, d, 2, 6, 2, 6);
    const FourFloats z = __builtin_shufflevector(zab, zcd, 0, 1, 4, 5);
    __builtin_memcpy(rows[0] + i, &x, 16);
    __builtin_memcpy(rows[1] + i, &y, 16);
    __builtin_memcpy(rows[2] + i, &z, 16);
}

// The neighbour of x above or below it; x is finite.
KINORA_KERNEL_PART float neighbour(float x, bool up) {
    const uint32_t bits = __builtin_bit_cast(uint32_t, x);
    const uint32_t next = up == (x > 0) ? bits + 1 : bits - 1;
    const uint32_t of_zero = up ? 1u : 0x80000001u;
    return __builtin_bit_cast(float, x == 0 ? of_zero : next);
}

#undef KINORA_KERNEL_PART

}  // namespace kinora
