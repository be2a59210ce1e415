// runtime/picture/compare/picture.cpp: separable convolution.
#include "runtime/picture/compare/picture.h"

#include <algorithm>
#include <cmath>

namespace kinora {

namespace {

// Adds `weight` times a row to another.
void add_row(double* to, const double* from, double weight, size_t count) {
    for (size_t i = 0; i < count; ++i) to[i] += weight * from[i];
}

Plane convolve_x(const Plane& from, const Kernel1& kernel) {
    Plane to(from.width, from.height);
    const size_t radius = kernel.size() / 2, width = size_t(from.width);
    std::vector<double> row(width + 2 * radius);  // with the border's pixels repeated
    for (size_t y = 0; y < size_t(from.height); ++y) {
        const double* pixels = &from.values[y * width];
        std::fill_n(row.begin(), radius, pixels[0]);
        std::copy_n(pixels, width, row.begin() + ptrdiff_t(radius));
        std::fill_n(row.end() - ptrdiff_t(radius), radius, pixels[width - 1]);
        for (size_t k = 0; k < kernel.size(); ++k)
            add_row(&to.values[y * width], &row[k], kernel[k], width);
    }
    return to;
}

Plane convolve_y(const Plane& from, const Kernel1& kernel) {
    Plane to(from.width, from.height);
    const int radius = int(kernel.size()) / 2;
    const size_t width = size_t(from.width);
    for (int y = 0; y < from.height; ++y)
        for (int k = -radius; k <= radius; ++k) {
            int at = std::clamp(y + k, 0, from.height - 1);
            add_row(&to.values[size_t(y) * width], &from.values[size_t(at) * width],
                    kernel[size_t(k + radius)], width);
        }
    return to;
}

}  // namespace

Kernel1 gaussian_kernel(double sigma, int radius) {
    Kernel1 kernel;
    for (int k = -radius; k <= radius; ++k)
        kernel.push_back(std::exp(-0.5 * double(k) * double(k) / (sigma * sigma)));
    return kernel;
}

Plane convolve(const Plane& plane, const Kernel1& along_x, const Kernel1& along_y) {
    return plane.size() ? convolve_y(convolve_x(plane, along_x), along_y) : plane;
}

}  // namespace kinora
