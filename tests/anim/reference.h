// tests/anim/reference.h: curves by their definitions, in long double, by bisection. Shares nothing
// with the library but the meaning of the arrays.
#pragma once

#include <vector>

namespace kinora::anim::reference {

struct Point {
    long double time, value;
};

// Bernstein form of a cubic Bezier.
inline long double bezier(long double p0, long double p1, long double p2, long double p3,
                          long double s) {
    long double r = 1 - s;
    return r * r * r * p0 + 3 * r * r * s * p1 + 3 * r * s * s * p2 + s * s * s * p3;
}

// The value at `time` of the Bezier with 2-D points p0 c0 c1 p1, times growing along it.
inline double bezier_at(Point p0, Point c0, Point c1, Point p1, long double time) {
    // about p0, since long double has no more than 64 bits for a time of 1e6 s
    long double x0 = c0.time - p0.time, x1 = c1.time - p0.time, end = p1.time - p0.time;
    long double target = time - p0.time, low = 0, high = 1;
    for (int i = 0; i < 120; ++i) {
        long double s = (low + high) / 2;
        (bezier(0, x0, x1, end, s) < target ? low : high) = s;
    }
    return static_cast<double>(bezier(p0.value, c0.value, c1.value, p1.value, (low + high) / 2));
}

// Hermite by its basis: h00 p0 + h10 m0 + h01 p1 + h11 m1.
inline double hermite(long double p0, long double m0, long double p1, long double m1,
                      long double s) {
    long double s2 = s * s, s3 = s2 * s;
    return static_cast<double>((2 * s3 - 3 * s2 + 1) * p0 + (s3 - 2 * s2 + s) * m0 +
                               (-2 * s3 + 3 * s2) * p1 + (s3 - s2) * m1);
}

// Catmull-Rom and uniform B-spline by their matrices.
inline double cardinal(long double a, long double b, long double c, long double d, long double s) {
    return static_cast<double>(0.5L * (2 * b + (c - a) * s + (2 * a - 5 * b + 4 * c - d) * s * s +
                                       (3 * b - a - 3 * c + d) * s * s * s));
}
inline double bspline(long double a, long double b, long double c, long double d, long double s) {
    return static_cast<double>(((a + 4 * b + c) + (3 * c - 3 * a) * s +
                                (3 * a - 6 * b + 3 * c) * s * s +
                                (d - a + 3 * b - 3 * c) * s * s * s) /
                               6);
}

}  // namespace kinora::anim::reference
