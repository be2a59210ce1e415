// jit/math/math.h: the transcendental functions and noise as IR, written once for all targets.
// Two tiers: Precise <= 1 ULP, Fast <= 4 ULP (pow within 4 + 2|y log2 x|). No function here traps,
// and none lets a NaN reach an int op. Values at the edges follow docs/numerics.md
// (named per function); RSL's own rules (division, pow of negatives) are lowered in rsl.
#pragma once

#include <array>

#include "jit/ir/builder.h"

namespace kinora::jit::math {

enum class Tier : uint8_t { Precise, Fast };

// Each appends the IR that computes the function of x (radians where angles).
Value sin(Builder& b, Value x, Tier tier);
Value cos(Builder& b, Value x, Tier tier);
Value tan(Builder& b, Value x, Tier tier);
Value asin(Builder& b, Value x, Tier tier);  // x clamped to [-1, 1]
Value acos(Builder& b, Value x, Tier tier);  // x clamped to [-1, 1]
Value atan(Builder& b, Value x, Tier tier);
Value atan2(Builder& b, Value y, Value x, Tier tier);  // atan2(0, 0) = 0
Value exp(Builder& b, Value x, Tier tier);             // overflow gives +inf, NaN stays NaN
Value exp2(Builder& b, Value x, Tier tier);
Value log(Builder& b, Value x, Tier tier);  // of max(x, FLT_MIN)
Value log2(Builder& b, Value x, Tier tier);
Value pow(Builder& b, Value x, Value y, Tier tier);  // x >= 0; pow(0, y > 0) = 0, pow(x, 0) = 1
Value inversesqrt(Builder& b, Value x, Tier tier);   // 0 for x <= 0

// Noise (docs/decisions.md#noise-by-hash): an integer hash of the lattice, no table. `p` has 1 to 4
// coordinates (the fourth of 4-D noise is RSL's float after the point). Values in 0..1 around 0.5,
// 0.5 on lattice points; finite for any p. `components` 1 (float) or 3 (color, point, vector).
// `period` (pnoise): same length as p, or empty. Emitted as a function of the module and called,
// one copy per (dimensions, components, periodic).
std::vector<Value> noise(Builder& b, Value mask, std::span<const Value> p, int components,
                         std::span<const Value> period = {});
// 0..1, constant on each unit cell of floor(p).
std::vector<Value> cellnoise(Builder& b, std::span<const Value> p, int components);
// A uniform number in [0, 1) from integer keys: two multiply-xorshift rounds
// (docs/decisions.md#noise-by-hash).
Value hash01(Builder& b, std::span<const Value> int_keys);

// The same noise in plain C++ for the reference evaluator; T = float gives the IR's bits in the
// lattice hash, T = double measures accuracy.
template <class T>
void noise_reference(const T* p, int dimensions, int components, const T* period, T* out);
template <class T>
void cellnoise_reference(const T* p, int dimensions, int components, T* out);
float hash01_reference(std::span<const int32_t> keys);

}  // namespace kinora::jit::math
