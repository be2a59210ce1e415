// runtime/picture/compare/picture.h: pictures as errors read them, and planes to compute with.
#pragma once

#include <span>
#include <vector>

#include "runtime/base/math.h"

namespace kinora {

// Linear, associated RGBA, rows from the top: a film's own.
struct PictureView {
    int width = 0, height = 0;
    std::span<const vec4> rgba;  // width * height
};

// One number a pixel, rows from the top.
struct Plane {
    int width = 0, height = 0;
    std::vector<double> values;

    Plane() = default;
    Plane(int w, int h) : width(w), height(h), values(size_t(w) * size_t(h)) {}
    double& operator[](size_t i) { return values[i]; }
    double operator[](size_t i) const { return values[i]; }
    size_t size() const { return values.size(); }
};

// Weights of an odd count around the middle one.
using Kernel1 = std::vector<double>;
Kernel1 gaussian_kernel(double sigma, int radius);  // not normalised: 1 in the middle

// The plane times `along_x` and `along_y`; pixels outside are those of the border.
Plane convolve(const Plane& plane, const Kernel1& along_x, const Kernel1& along_y);

}  // namespace kinora
