// runtime/scene/images/latlong/kernels_p.h: the kernels, loops over sixteen that the compiler makes
// vectors of. Included by one file for each instruction set; all names are the file's own.
#pragma once

#include "runtime/base/kernel_math.h"
#include "runtime/scene/images/latlong/kernels.h"

namespace kinora {
namespace {

// No function of a library is called here: compiled for this instruction set, it could be the one
// that the linker takes for all of the program.
#define KINORA_SIXTEEN _Pragma("GCC ivdep") for (int i = 0; i < kLatlongLanes; ++i)

using Row = float[kLatlongLanes];

constexpr float kPiFloat = 3.14159265358979f, kInversePi = 0.318309886183791f;

// atan2 by Abramowitz & Stegun 4.4.49: |error| <= 2e-8 radians before rounding.
__attribute__((always_inline)) inline float atan2_of(float y, float x) {
    const float ax = __builtin_fabsf(x), ay = __builtin_fabsf(y);
    const float large = ax < ay ? ay : ax, small = ay < ax ? ay : ax;
    const float z = large > 0 ? small / large : 0.0f, z2 = z * z;
    float p = 0.0028662257f;
    p = p * z2 + -0.0161657367f;
    p = p * z2 + 0.0429096138f;
    p = p * z2 + -0.0752896400f;
    p = p * z2 + 0.1065626393f;
    p = p * z2 + -0.1420889944f;
    p = p * z2 + 0.1999355085f;
    p = p * z2 + -0.3333314528f;
    p = p * z2 + 1.0f;
    p *= z;
    p = ay > ax ? 0.5f * kPiFloat - p : p;
    p = x < 0 ? kPiFloat - p : p;
    return y < 0 ? -p : p;
}

// Of each direction what brings its largest number to 1; 0 where the direction is not usable.
void find_scales(const float* d, Row& scale, uint32_t* usable) {
    KINORA_SIXTEEN {
        const float x = d[i], y = d[kLatlongLanes + i], z = d[2 * kLatlongLanes + i];
        const float ax = __builtin_fabsf(x), ay = __builtin_fabsf(y), az = __builtin_fabsf(z);
        const float xy = ax < ay ? ay : ax, large = xy < az ? az : xy, sum = x + y + z;
        const float inverse = 1.0f / large;  // infinite for a denormal number
        const bool sound =
            (large > 0) & (large < __builtin_inff()) & (sum == sum) & (inverse < __builtin_inff());
        scale[i] = sound ? inverse : 0.0f;
        usable[i] = sound ? 1u : 0u;
    }
}

void find_places(const float* d, const Row& scale, LatlongPlaces& to, Row& length) {
    KINORA_SIXTEEN {
        const float x = d[i] * scale[i], y = d[kLatlongLanes + i] * scale[i],
                    z = d[2 * kLatlongLanes + i] * scale[i];
        const float out = __builtin_sqrtf(x * x + z * z);
        to.s[i] = atan2_of(-x, z) * (0.5f * kInversePi) + 0.5f;
        to.t[i] = atan2_of(y, out) * kInversePi + 0.5f;
        length[i] = __builtin_sqrtf(x * x + y * y + z * z);
        to.around[i] = out / length[i];
    }
}

void places(const float* d, LatlongPlaces& to) {
    alignas(64) Row scale, length;
    find_scales(d, scale, to.usable);
    find_places(d, scale, to, length);
}

void footprints(const float* d, LatlongPlaces& to) {
    alignas(64) Row scale, length;
    find_scales(d, scale, to.usable);
    find_places(d, scale, to, length);
    KINORA_SIXTEEN {
        float squared[2];
        for (int axis = 0; axis < 2; ++axis) {
            const float* change = d + (3 + 3 * axis) * kLatlongLanes + i;
            const float x = change[0] * scale[i], y = change[kLatlongLanes] * scale[i],
                        z = change[2 * kLatlongLanes] * scale[i];
            squared[axis] = x * x + y * y + z * z;
        }
        const float most = squared[0] < squared[1] ? squared[1] : squared[0];
        const float angle = __builtin_sqrtf(most) / length[i];
        const float around = to.around[i] < 1e-4f ? 1e-4f : to.around[i];
        to.dt[i] = angle / kPiFloat;
        const float ds = 0.5f * to.dt[i] / around;
        to.ds[i] = 1.0f < ds ? 1.0f : ds;
    }
}

void directions(const double* s, const double* v, float* d, float* around) {
    alignas(64) double side[kLatlongLanes], ahead[kLatlongLanes], up[kLatlongLanes],
        out[kLatlongLanes];
    KINORA_SIXTEEN turn_to(s[i], ahead[i], side[i]);
    KINORA_SIXTEEN turn_to(v[i] * 0.5, up[i], out[i]);
    KINORA_SIXTEEN {
        d[i] = float(out[i] * side[i]);
        d[kLatlongLanes + i] = float(up[i]);
        d[2 * kLatlongLanes + i] = float(-out[i] * ahead[i]);
        around[i] = float(out[i]);
    }
}

}  // namespace

extern const LatlongKernels KINORA_KERNEL_TABLE(Latlong);
const LatlongKernels KINORA_KERNEL_TABLE(Latlong) = {KINORA_INSTRUCTION_SET, places, footprints,
                                                     directions};

}  // namespace kinora
