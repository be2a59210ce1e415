// jit/math/noise_p.h: the numbers that define Kinora's noise, shared by the IR and the reference.
//
// Lattice point (x, y, z, w): h = xP0 ^ yP1 ^ zP2 ^ wP3 ^ seed. Component k of the noise takes its
// gradient from g = h (h ^ C[k]) modulo 2^32 (the plain product h C has a
// short period along an axis): the gradient's coordinates are the signed integers
// g, g << 6, g << 12, g << 17, that is, a vector uniform in a cube, which costs fewer instructions
// than selecting one of a few directions and needs no table. The noise is the interpolation of
// gradient . (p - lattice point) with the weights 6t^5 - 15t^4 + 10t^3 (Perlin 2002).
#pragma once

#include <cstdint>

namespace kinora::jit::math {

inline constexpr uint32_t kLattice[4] = {0xbc43d731u, 0xf61106fbu, 0x92e65ec9u, 0xcd0cf7e1u};
inline constexpr uint32_t kLatticeSeed = 0x45151fb1u;
inline constexpr uint32_t kGradient[3] = {0xbd2db7f7u, 0x2c1b3c6fu, 0x94d049bbu};
inline constexpr int kGradientShift[4] = {0, 6, 12, 17};

// Multiplies the signed sum so that its deviation is about 0.24 of the
// range -1..1 in any number of dimensions; what lies outside (more than 4 deviations) is clamped.
inline constexpr float kNoiseScale[4] = {1.75f, 1.35f, 1.25f, 1.23f};

// Coordinates are clamped to this before they become integers (docs/numerics.md#noise).
inline constexpr float kLatticeLimit = 1073741824.0f;  // 2^30

// Two rounds of multiply and xorshift, for cellnoise and random numbers: odd multipliers with about
// half of their bits set. Each key is multiplied and mixed in before.
inline constexpr uint32_t kKeySeed = 0x6a09e667u;
inline constexpr uint32_t kKeyMultiplier = 0x9e3779b1u;
inline constexpr uint32_t kRoundMultiplier[2] = {0x7a5662dbu, 0xb4b82e39u};
// Added to the hash for the second and third component.
inline constexpr uint32_t kComponentStep = 0x632be5abu;

}  // namespace kinora::jit::math
