// runtime/picture/lights/angles.cpp: series of angles.
#include "runtime/picture/lights/angles.h"

#include <cmath>
#include <utility>

#include "runtime/base/math.h"

namespace kinora {

namespace {

// Taylor series for |x| <= pi/4. The terms left out are below 2^-56.
double sine(double x) {
    double term = x, sum = x;
    for (int k = 2; k <= 16; k += 2) {
        term *= -x * x / double(k * (k + 1));
        sum += term;
    }
    return sum;
}
double cosine(double x) {
    double term = 1, sum = 1;
    for (int k = 1; k <= 17; k += 2) {
        term *= -x * x / double(k * (k + 1));
        sum += term;
    }
    return sum;
}

// The angle whose tangent is t, 0 <= t <= 1: halved twice, t is below .2 and the series is short.
double arc(double t) {
    for (int k = 0; k < 2; ++k) t = t / (1 + std::sqrt(1 + t * t));
    const double square = t * t;
    double sum = 0;
    for (int k = 23; k >= 1; k -= 2) sum = 1.0 / k - square * sum;
    return 4 * t * sum;
}

}  // namespace

SineCosine sine_cosine(double angle) {
    const double quarters = std::floor(angle / (0.5 * kPi) + 0.5);
    const double rest = angle - quarters * (0.5 * kPi);
    SineCosine at{sine(rest), cosine(rest)};
    const int turned = int(quarters) & 3;
    if (turned & 1) at = {at.cosine, -at.sine};
    if (turned & 2) at = {-at.sine, -at.cosine};
    return at;
}

double angle_of(double y, double x) {
    const double wide = std::abs(x);
    const double acute = y <= wide ? (wide > 0 ? arc(y / wide) : 0) : 0.5 * kPi - arc(wide / y);
    return x < 0 ? kPi - acute : acute;
}

}  // namespace kinora
