// runtime/picture/lights/angles.h: angles, sines and cosines in double, with the same bits on all
// machines: only what IEEE 754 rounds exactly is used.
#pragma once

namespace kinora {

struct SineCosine {
    double sine, cosine;
};
// Of any angle in radians of at most some turns; within 1e-15.
SineCosine sine_cosine(double angle);

// The angle of (x, y) from the x axis, in radians, 0 to pi; y >= 0. Within 4e-16 of its size.
double angle_of(double y, double x);

}  // namespace kinora
