// jit/math/noise_reference.cpp: noise in plain C++, one point at a time, for the reference
// evaluator and the tests. Written from the definition in jit/math/noise_p.h, apart from the IR.
#include <algorithm>
#include <cmath>

#include "jit/math/math.h"
#include "jit/math/noise_p.h"

namespace kinora::jit::math {
namespace {

template <class T>
T clamped(T x) {
    if (std::isnan(x)) return T(-kLatticeLimit);
    return std::clamp(x, T(-kLatticeLimit), T(kLatticeLimit));
}

int64_t wrapped(int64_t cell, int64_t period) {
    int64_t rest = cell % period;
    return rest < 0 ? rest + period : rest;
}

template <class T>
int64_t whole_period(T period) {
    return int64_t(std::clamp(period >= 1 ? period : T(1), T(1), T(kLatticeLimit)));
}

uint32_t rounds(uint32_t h) {
    h ^= h >> 16;
    h *= kRoundMultiplier[0];
    h ^= h >> 16;
    h *= kRoundMultiplier[1];
    return h ^ h >> 16;
}

uint32_t mixed(std::span<const int32_t> keys) {
    uint32_t h = kKeySeed;
    for (int32_t key : keys) {
        h = (h ^ uint32_t(key)) * kKeyMultiplier;
        h ^= h >> 15;
    }
    return h;
}

}  // namespace

template <class T>
void noise_reference(const T* p, int dimensions, int components, const T* period, T* out) {
    for (int k = 0; k < components; ++k) {
        T sum = 0;
        for (int corner = 0; corner < 1 << dimensions; ++corner) {
            uint32_t hash = kLatticeSeed;
            T weight = 1;
            T distance[4];
            for (int d = 0; d < dimensions; ++d) {
                T x = clamped(p[d]);
                auto cell = int64_t(std::floor(x));
                T t = x - T(cell);
                T s = t * t * t * (t * (t * 6 - 15) + 10);
                int upper = corner >> d & 1;
                weight *= upper ? s : 1 - s;
                distance[d] = t - T(upper);
                int64_t plane = cell + upper;
                if (period) plane = wrapped(plane, whole_period(period[d]));
                hash ^= uint32_t(plane) * kLattice[d];
            }
            uint32_t g = hash * (hash ^ kGradient[k]);
            T dot = 0;
            for (int d = 0; d < dimensions; ++d)
                dot += T(int32_t(g << kGradientShift[d])) * distance[d];
            sum += weight * dot;
        }
        T value = sum * T(kNoiseScale[dimensions - 1]) * T(0x1p-32) + T(0.5);
        out[k] = std::clamp(value, T(0), T(1));
    }
}

template <class T>
void cellnoise_reference(const T* p, int dimensions, int components, T* out) {
    int32_t cells[4];
    for (int d = 0; d < dimensions; ++d) cells[d] = int32_t(std::floor(clamped(p[d])));
    uint32_t h = mixed({cells, size_t(dimensions)});
    for (int k = 0; k < components; ++k)
        out[k] = T(rounds(h + uint32_t(k) * kComponentStep) >> 8) * T(0x1p-24);
}

float hash01_reference(std::span<const int32_t> keys) {
    return float(rounds(mixed(keys)) >> 8) * 0x1p-24f;
}

template void noise_reference<float>(const float*, int, int, const float*, float*);
template void noise_reference<double>(const double*, int, int, const double*, double*);
template void cellnoise_reference<float>(const float*, int, int, float*);
template void cellnoise_reference<double>(const double*, int, int, double*);

}  // namespace kinora::jit::math
