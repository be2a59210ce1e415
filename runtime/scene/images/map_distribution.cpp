// runtime/scene/images/map_distribution.cpp: texels by their light, and a tent about the middle of
// each. The density is then what a lookup between four texels makes of the texels' chances, so it
// follows the map between the middles, too, and is 0 only where the map is black.
#include "runtime/scene/images/map_distribution.h"

#include <algorithm>
#include <cmath>

#include "runtime/base/check.h"
#include "runtime/scene/images/texture_sample.h"

namespace kinora {

namespace {

constexpr float kLeastSine = 1e-6f;  // of the angle to a pole, where the density has no end
constexpr double kAlike = 1e-5;      // rounding of lookups in a map of one color

double light_of(float brightness) {
    return std::isfinite(brightness) && brightness > 0 ? double(brightness) : 0.0;
}

double within_unit(double u) {
    return u > 0 ? std::min(u, 1 - 0x1p-32) : 0.0;
}

// Of a texel's neighbours the share that a tent reaches: -1 to 1.
double tent(double u) {
    return u < 0.5 ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u);
}

// s from the picture's left, v from its top.
vec3 direction_at(double s, double v) {
    const double theta = kPi * v, phi = 2 * kPi * (s - 0.5), out = std::sin(theta);
    return {float(-out * std::sin(phi)), float(std::cos(theta)), float(out * std::cos(phi))};
}

vec3 even_direction(vec2 u) {
    const double y = 1 - 2 * within_unit(double(u.x)), phi = 2 * kPi * double(u.y);
    const double out = std::sqrt(std::max(0.0, 1 - y * y));
    return {float(out * std::cos(phi)), float(y), float(out * std::sin(phi))};
}

}  // namespace

MapDistribution::MapDistribution(uint32_t columns, uint32_t rows, std::span<const float> brightness)
    : columns_(columns), rows_(rows) {
    CHECK_EQ(brightness.size(), size_t(columns) * rows);
    double least = light_of(brightness[0]), most = least;
    for (float b : brightness) {
        least = std::min(least, light_of(b));
        most = std::max(most, light_of(b));
    }
    if (least > 0 && most - least <= kAlike * most) {
        columns_ = rows_ = 0;
        return;
    }
    for (uint32_t row = 0; row < rows; ++row)
        add_row(brightness.subspan(size_t(row) * columns, columns));
}

// A row of no light has even shares, which nothing chooses.
void MapDistribution::add_row(std::span<const float> brightness) {
    double sum = 0, so_far = 0;
    for (float b : brightness) sum += light_of(b);
    for (size_t c = 0; c < brightness.size(); ++c) {
        so_far += light_of(brightness[c]);
        below_.push_back(float(sum > 0 ? so_far / sum : double(c + 1) / double(brightness.size())));
    }
    const double before = below_row_.empty() ? 0.0 : below_row_.back();
    below_row_.push_back(before +
                         sum * std::sin(kPi * (double(below_row_.size()) + 0.5) / double(rows_)));
}

MapDistribution::Choice MapDistribution::choose_row(double u) const {
    const double wanted = within_unit(u) * below_row_.back();
    const auto found = std::upper_bound(below_row_.begin(), below_row_.end(), wanted);
    const size_t row = std::min(size_t(found - below_row_.begin()), below_row_.size() - 1);
    const double before = row ? below_row_[row - 1] : 0.0, own = below_row_[row] - before;
    return {uint32_t(row), own > 0 ? within_unit((wanted - before) / own) : 0.5};
}

MapDistribution::Choice MapDistribution::choose_column(uint32_t row, float u) const {
    const std::span<const float> below(below_.data() + size_t(row) * columns_, columns_);
    const float wanted = u > 0 ? std::min(u, below.back()) : 0.0f;
    const auto found = std::upper_bound(below.begin(), below.end(), wanted);
    const size_t column = std::min(size_t(found - below.begin()), below.size() - 1);
    const double before = column ? double(below[column - 1]) : 0.0,
                 own = double(below[column]) - before;
    return {uint32_t(column), own > 0 ? within_unit((double(wanted) - before) / own) : 0.5};
}

vec3 MapDistribution::direction(vec2 u, float& density_there) const {
    vec3 d = vec3(0.0f, 1.0f, 0.0f);
    if (columns_ == 0) {
        d = even_direction(u);
    } else if (below_row_.back() > 0) {
        const Choice row = choose_row(double(u.x)), column = choose_column(row.index, u.y);
        // Above the first row's middle and below the last one's, lookups see that row alone.
        double v = (row.index + 0.5 + tent(row.within)) / rows_;
        v = v < 0 ? -v : v > 1 ? 2 - v : v;
        d = direction_at((column.index + 0.5 + tent(column.within)) / columns_, v);
    }
    density_there = density(d);
    return d;
}

float MapDistribution::share_of_row(uint32_t row) const {
    const double before = row ? below_row_[row - 1] : 0.0;
    return float((below_row_[row] - before) / below_row_.back());
}

float MapDistribution::share(uint32_t row, uint32_t column) const {
    const float* below = below_.data() + size_t(row) * columns_;
    return below[column] - (column ? below[column - 1] : 0.0f);
}

float MapDistribution::density(vec3 d) const {
    const float large = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    if (!(large > 0 && large < HUGE_VALF)) return 0;
    if (columns_ == 0) return 1 / (4 * float(kPi));
    if (!(below_row_.back() > 0)) return 0;
    d /= large;
    const float out = std::sqrt(d.x * d.x + d.z * d.z);
    float s = 0, t = 0;
    latlong_of_direction(d.x, d.y, d.z, s, t);
    const float x = s * float(columns_) - 0.5f, y = (1 - t) * float(rows_) - 0.5f;
    const float left = std::floor(x), top = std::floor(y), right = x - left, bottom = y - top;
    float chance = 0;
    for (int j : {0, 1}) {
        const auto row = uint32_t(std::clamp(int(top) + j, 0, int(rows_) - 1));
        float of_row = 0;
        for (int i : {0, 1}) {
            const int column = (int(left) + i + int(columns_)) % int(columns_);
            of_row += (i ? right : 1 - right) * share(row, uint32_t(column));
        }
        chance += (j ? bottom : 1 - bottom) * share_of_row(row) * of_row;
    }
    const float sine = out / std::sqrt(out * out + d.y * d.y);
    return chance * float(columns_) * float(rows_) /
           (2 * float(kPi * kPi) * std::max(sine, kLeastSine));
}

}  // namespace kinora
