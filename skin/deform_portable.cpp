// skin/deform_portable.cpp: the skinning kernel in plain C++, one vertex a vector.
#include "skin/deform_kernel_p.h"

namespace kinora::skin {
namespace {

struct Portable {
    static constexpr uint32_t kLanes = 1;
    struct Vec {
        float f[4];
    };
    template <class F>
    static Vec each(F f) {
        return {{f(0), f(1), f(2), f(3)}};
    }
    static Vec load(const float* p) { return {{p[0], p[1], p[2], p[3]}}; }
    static void store(float* p, Vec a) {
        for (int i = 0; i < 4; ++i) p[i] = a.f[i];
    }
    static Vec set(float v) { return {{v, v, v, v}}; }
    static Vec mul(Vec a, Vec b) {
        return each([&](int i) { return a.f[i] * b.f[i]; });
    }
    static Vec fma(Vec a, Vec b, Vec c) {
        return each([&](int i) { return __builtin_fmaf(a.f[i], b.f[i], c.f[i]); });
    }
    static Vec fnma(Vec a, Vec b, Vec c) {
        return each([&](int i) { return __builtin_fmaf(-a.f[i], b.f[i], c.f[i]); });
    }
    static Vec sqrt(Vec a) {
        return each([&](int i) { return __builtin_sqrtf(a.f[i]); });
    }
    static Vec div(Vec a, Vec b) {
        return each([&](int i) { return a.f[i] / b.f[i]; });
    }
    static Vec copysign(Vec a, Vec b) {
        return each([&](int i) { return __builtin_copysignf(a.f[i], b.f[i]); });
    }
    static Vec yzx(Vec a) { return {{a.f[1], a.f[2], a.f[0], a.f[3]}}; }
    template <int I>
    static Vec splat(Vec a) {
        return set(a.f[I]);
    }
    static float sum(Vec a) { return (a.f[0] + a.f[2]) + (a.f[1] + a.f[3]); }
    static Vec transpose_sum(Vec a, Vec b, Vec c, Vec d) {
        return {{sum(a), sum(b), sum(c), sum(d)}};
    }
    static uint32_t outside(Vec square, Vec det) {
        uint32_t bits = 0;
        for (int i = 0; i < 4; ++i) {
            float size = __builtin_fabsf(det.f[i]);
            bool safe = square.f[i] >= kLeastSafe && square.f[i] <= kMostSafe &&
                        size >= kLeastSafe && size <= kMostSafe;
            bits |= uint32_t{!safe} << i;
        }
        return bits;
    }
    using Weights = const float*;
    static Weights weights(const float* p) { return p; }
    template <int I>
    static Vec weight(Weights w) {
        return set(w[I]);
    }
    static void transpose_lanes(const Vec m[4], Vec c[4]) {
        for (int i = 0; i < 4; ++i) c[i] = m[i];
    }
};

}  // namespace

extern const DeformKernel kPortableKernel = make_kernel<Portable>("portable");

}  // namespace kinora::skin
