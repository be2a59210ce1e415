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

// Sine and cosine, |x| <= pi/4: Taylor series to the last bits of a double, as the term left out is
// under 2^-58.
KINORA_KERNEL_PART double small_sine(double x) {
    double s = x * x;
    double p = -7.6471637318198164759e-13;
    p = p * s + 1.6059043836821614599e-10;
    p = p * s - 2.5052108385441718775e-8;
    p = p * s + 2.7557319223985890653e-6;
    p = p * s - 1.9841269841269841270e-4;
    p = p * s + 8.3333333333333333333e-3;
    p = p * s - 1.6666666666666666667e-1;
    return x + x * (s * p);
}
KINORA_KERNEL_PART double small_cosine(double x) {
    double s = x * x;
    double p = 4.7794773323873852974e-14;
    p = p * s - 1.1470745597729724714e-11;
    p = p * s + 2.0876756987868098979e-9;
    p = p * s - 2.7557319223985890653e-7;
    p = p * s + 2.4801587301587301587e-5;
    p = p * s - 1.3888888888888888889e-3;
    p = p * s + 4.1666666666666666667e-2;
    return (1 - 0.5 * s) + s * s * p;
}

// Cosine and sine of 2 pi turn, turn in [0, 1], by the nearest quarter turn and the series of the
// rest.
KINORA_KERNEL_PART void turn_to(double turn, double& x, double& y) {
    double quarter = double(int32_t(turn * 4 + 0.5));
    double rest = (turn - quarter * 0.25) * 6.283185307179586477;
    double s = small_sine(rest), co = small_cosine(rest);
    bool odd = quarter == 1 || quarter == 3;
    double cx = odd ? s : co, sx = odd ? co : s;
    x = quarter == 1 || quarter == 2 ? -cx : cx;
    y = quarter == 2 || quarter == 3 ? -sx : sx;
}

#undef KINORA_KERNEL_PART

}  // namespace kinora
