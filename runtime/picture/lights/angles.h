// runtime/picture/lights/angles.h: angles in double with the same bits on all machines: only what
// IEEE 754 rounds exactly.
//
// Kernel files, compiled for one instruction set each, include this: all is inlined, and has no
// branches, so that loops over lanes become vectors.
#pragma once

namespace kinora {
namespace {

// The angle whose tangent is t, 0 <= t <= 1: halved twice, t is below .2 and the series is short.
__attribute__((always_inline)) inline double arc(double t) {
    t = t / (1 + __builtin_sqrt(1 + t * t));
    t = t / (1 + __builtin_sqrt(1 + t * t));
    const double square = t * t;
    // The terms left out are under 2^-56 for squares below .04.
    double sum = -1.0 / 23;
    sum = 1.0 / 21 + square * sum;
    sum = -1.0 / 19 + square * sum;
    sum = 1.0 / 17 + square * sum;
    sum = -1.0 / 15 + square * sum;
    sum = 1.0 / 13 + square * sum;
    sum = -1.0 / 11 + square * sum;
    sum = 1.0 / 9 + square * sum;
    sum = -1.0 / 7 + square * sum;
    sum = 1.0 / 5 + square * sum;
    sum = -1.0 / 3 + square * sum;
    sum = 1.0 + square * sum;
    return 4 * t * sum;
}

// The angle from the x axis to (x, y), y not below 0: 0 to pi.
__attribute__((always_inline)) inline double angle_of(double y, double x) {
    constexpr double kHalfTurn = 3.141592653589793238;
    const double wide = x < 0 ? -x : x, small = y < wide ? y : wide, large = y < wide ? wide : y;
    const double tangent = small / (large > 0 ? large : 1.0), near = arc(tangent);
    const double acute = y <= wide ? near : 0.5 * kHalfTurn - near;
    return x < 0 ? kHalfTurn - acute : acute;
}

}  // namespace
}  // namespace kinora
