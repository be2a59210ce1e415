// runtime/scene/description/display_color.cpp: the curve of sRGB, carried on above 1 and below 0.
#include "runtime/scene/description/display_color.h"

#include <algorithm>
#include <cmath>

namespace kinora {

namespace {

// IEC 61966-2-1: below kToe the curve is a line of this slope.
constexpr double kSlope = 12.92;
constexpr double kToe = 0.04045;

double decode(double x) {
    return x <= kToe ? x / kSlope : std::pow((x + 0.055) / 1.055, 2.4);
}

// Written so that 1 gives 1.
double encode(double x) {
    return x <= kToe / kSlope ? x * kSlope : 1 + 1.055 * (std::pow(x, 1 / 2.4) - 1);
}

// `curve` within 0..1; `slope` is its slope at 0.
template <class Curve>
dvec3 carried_on(dvec3 color, Curve curve, double slope) {
    double most = 0;
    for (int k = 0; k < 3; ++k) {
        if (std::isnan(color[k])) color[k] = 0;
        most = std::max(most, std::abs(color[k]));
    }
    for (int k = 0; k < 3; ++k) {
        double size = std::abs(color[k]);
        if (std::isinf(most))
            size *= slope;
        else
            size = most > 1 ? most * curve(size / most) : curve(size);
        color[k] = std::copysign(size, color[k]);
    }
    return color;
}

}  // namespace

dvec3 linear_of_display(const dvec3& color) {
    return carried_on(color, decode, 1 / kSlope);
}

dvec3 display_of_linear(const dvec3& color) {
    return carried_on(color, encode, kSlope);
}

}  // namespace kinora
