// raytrace/pixels/filter_grid.cpp: inverse sums of a filter's rows and cells.
#include "raytrace/pixels/filter_grid.h"

#include <algorithm>
#include <cmath>

namespace kinora::raytrace {
namespace {

// The cell in which the sum reaches u of its end, and how far it is through it.
double inverse(std::span<const double> sums, double u) {
    const double target = u * sums.back();
    const auto at = std::min(std::ranges::upper_bound(sums, target), sums.end() - 1);
    const double before = at == sums.begin() ? 0 : *(at - 1), step = *at - before;
    const double part = step > 0 ? (target - before) / step : 0.5;
    return double(at - sums.begin()) + std::clamp(part, 0.0, 1.0);
}

}  // namespace

FilterGrid::FilterGrid(std::span<const float> values, double width, double height)
    : side_(size_t(std::lround(std::sqrt(double(values.size()))))),
      size_(width, height),
      positive_(part_of(values, side_, 1)),
      negative_(part_of(values, side_, -1)) {}

FilterGrid::Part FilterGrid::part_of(std::span<const float> values, size_t side, float sign) {
    Part part;
    for (size_t row = 0; row < side; ++row) {
        double sum = 0;
        for (size_t column = 0; column < side; ++column) {
            sum += double(std::max(sign * values[row * side + column], 0.0f));
            part.cells.push_back(sum);
        }
        part.sum += sum;
        part.rows.push_back(part.sum);
    }
    return part;
}

int FilterGrid::negative_samples(int samples) const {
    if (!(negative_.sum > 0)) return 0;
    const double share = negative_.sum / (positive_.sum + negative_.sum);
    return std::clamp(int(std::lround(share * samples)), 1, samples - 1);
}

double FilterGrid::weight(int sample, int samples) const {
    const int negative = negative_samples(samples);
    const double each = samples / (positive_.sum - negative_.sum);
    return sample < negative ? -negative_.sum * each / negative
                             : positive_.sum * each / (samples - negative);
}

dvec2 FilterGrid::offset(int sample, int samples, dvec2 u) const {
    const Part& part = sample < negative_samples(samples) ? negative_ : positive_;
    const double y = inverse(part.rows, u.y);
    const size_t row = std::min(size_t(y), side_ - 1);
    const double x = inverse(std::span(part.cells).subspan(row * side_, side_), u.x);
    return (dvec2(x, y) / double(side_) - 0.5) * size_;
}

}  // namespace kinora::raytrace
