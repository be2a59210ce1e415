// raytrace/film.cpp: the film's memory and the table of pixel filters.
#include "raytrace/film.h"

#include <algorithm>
#include <cmath>

#include "raytrace/pixels/pixels.h"
#include "runtime/base/check.h"

namespace kinora::raytrace {

void Film::resize(int w, int h) {
    CHECK_GE(w, 1);
    CHECK_GE(h, 1);
    width = w;
    height = h;
    top = 0;
    is_band = false;
    rgba.resize(size_t(w) * size_t(h));
    for (AovPlane& plane : aovs) plane.values.resize(rgba.size());
    clear();
}

void Film::hold_band(int w, int first, int rows) {
    resize(w, rows);
    top = first;
    is_band = true;
}

AovPlane& Film::add_aov(std::string name, AovFilter filter) {
    return aovs.emplace_back(AovPlane{std::move(name), filter, std::vector<float>(rgba.size())});
}

void Film::clear() {
    std::fill(rgba.begin(), rgba.end(), vec4(0.0f));
    for (AovPlane& plane : aovs) std::fill(plane.values.begin(), plane.values.end(), 0.0f);
    non_finite = 0;
}

namespace {

constexpr PixelFilter kPixelFilters[] = {
    {"box", 1, [](double) { return 1.0; }},
    {"triangle", 2, [](double x) { return 1 - std::abs(x); }},
    // RISpec 3.2, RiGaussianFilter: exp(-2 (2x/width)^2), cut off at the support.
    {"gaussian", 2, [](double x) { return std::exp(-2 * x * x); }},
};

constexpr int kCells = 1024;     // of the inverse
constexpr int kSteps = 1 << 14;  // of the integral

}  // namespace

std::span<const PixelFilter> pixel_filters() {
    return kPixelFilters;
}

const PixelFilter* find_pixel_filter(std::string_view name) {
    for (const PixelFilter& filter : kPixelFilters)
        if (filter.name == name) return &filter;
    return nullptr;
}

FilterSampler::FilterSampler(const PixelFilter& filter, double width) {
    const double half = 0.5 * (width > 0 ? width : filter.width);
    std::vector<double> integral(kSteps + 1);
    for (int i = 0; i < kSteps; ++i)  // midpoint rule
        integral[size_t(i) + 1] = integral[size_t(i)] + filter.density((2 * i + 1.0) / kSteps - 1);
    inverse_.resize(kCells + 1);
    for (int i = 0; i <= kCells; ++i) {
        const double target = integral.back() * i / kCells;
        auto above = std::lower_bound(integral.begin() + 1, integral.end() - 1, target);
        const double step = *above - *(above - 1);
        const double part = step > 0 ? (target - *(above - 1)) / step : 0;
        const double x = (double(above - integral.begin()) - 1 + part) * 2 / kSteps - 1;
        inverse_[size_t(i)] = half * std::clamp(x, -1.0, 1.0);
    }
}

double FilterSampler::offset(double u) const {
    const double x = std::clamp(u, 0.0, 1.0) * kCells;
    const size_t cell = std::min<size_t>(size_t(x), kCells - 1);
    return inverse_[cell] + (inverse_[cell + 1] - inverse_[cell]) * (x - double(cell));
}

FilterTable FilterSampler::table() const {
    static_assert(kCells == kFilterCells);
    FilterTable table;
    const double first = inverse_.front(), mean = (inverse_.back() - first) / kCells;
    table.linear = true;
    for (size_t i = 0; i < kCells; ++i) {
        table.cells[i] = {inverse_[i], inverse_[i + 1] - inverse_[i]};
        table.linear &= std::abs(inverse_[i] - (first + mean * double(i))) <= 0x1p-48 * -first;
    }
    if (table.linear) table.cells[0].step = mean;
    return table;
}

}  // namespace kinora::raytrace
