// runtime/scene/curves/reduce_keys.h: keys whose straight pieces follow a curve within a tolerance.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace kinora {

// Numbers as a function of time (seconds). A rotation is x y z w of a unit quaternion: its pieces
// are slerps, its distances angles in radians.
struct Curve {
    uint32_t width = 1;
    bool rotation = false;
    std::function<void(double time, double* numbers)> at;

    // The largest difference of two sets of numbers.
    double distance(const double* a, const double* b) const;
};

// Where between two keys, as a part of their distance in time, a curve is looked at.
inline constexpr double kProbes[] = {0.5, 0.25, 0.75, 0.13};

// Most keys of one curve, and the shortest piece, in seconds, that is worth one.
inline constexpr size_t kMostKeys = 200000;
inline constexpr double kShortestPiece = 1e-4;

struct StraightKeys {
    std::vector<double> times;    // ascending, floats exactly
    std::vector<double> numbers;  // width each
    double worst = 0;             // largest distance from the curve, where it was looked at
};

// Pieces between `times` (ascending, at least one) are halved until they keep to the tolerance, or
// are too short or too many; then keys that the line through their neighbours passes are left out.
StraightKeys reduce_keys(const Curve& curve, std::span<const double> times, double tolerance);

}  // namespace kinora
