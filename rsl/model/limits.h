// rsl/model/limits.h: limits of running shaders.
#pragma once

namespace kinora::rsl {

// A function that calls itself (docs/numerics.md#recursion): so many activations at once, and so
// many calls below the first one, that it cannot hang. Beyond that: a fault, and 0.
inline constexpr int kMaxCallDepth = 64;
inline constexpr int kMaxRecursiveCalls = 1'000'000;

}  // namespace kinora::rsl
