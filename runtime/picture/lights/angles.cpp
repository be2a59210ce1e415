// runtime/picture/lights/angles.cpp: the series of the arctangent.
#include "runtime/picture/lights/angles.h"

#include <cmath>

#include "runtime/base/math.h"

namespace kinora {

namespace {

// 1/1, -1/3, 1/5, ...: the terms left out are under 2^-56 for squares below .04.
constexpr double kTerms[] = {1.0,      -1.0 / 3,  1.0 / 5,  -1.0 / 7,  1.0 / 9,  -1.0 / 11,
                             1.0 / 13, -1.0 / 15, 1.0 / 17, -1.0 / 19, 1.0 / 21, -1.0 / 23};

// The angle whose tangent is t, 0 <= t <= 1: halved twice, t is below .2 and the series is short.
double arc(double t) {
    for (int k = 0; k < 2; ++k) t = t / (1 + std::sqrt(1 + t * t));
    const double square = t * t;
    double sum = 0;
    for (size_t k = std::size(kTerms); k-- > 0;) sum = kTerms[k] + square * sum;
    return 4 * t * sum;
}

}  // namespace

double angle_of(double y, double x) {
    const double wide = std::abs(x);
    const double acute = y <= wide ? (wide > 0 ? arc(y / wide) : 0) : 0.5 * kPi - arc(wide / y);
    return x < 0 ? kPi - acute : acute;
}

}  // namespace kinora
