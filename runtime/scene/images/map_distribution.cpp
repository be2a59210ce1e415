// runtime/scene/images/map_distribution.cpp: texels by their light, and a tent about the middle of
// each. The density is then what a lookup between four texels makes of the texels' chances, so it
// follows the map between the middles, too, and is 0 only where the map is black.
#include "runtime/scene/images/map_distribution.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "runtime/base/check.h"
#include "runtime/scene/images/latlong/kernels.h"

namespace kinora {

namespace {

constexpr float kLeastCosine = 1e-6f;  // of the latitude; at the poles the density has no end
constexpr float kEvenDensity = 1 / (4 * float(kPi));
constexpr double kAlike = 1e-5;  // rounding of lookups in a map of one color

double light_of(float brightness) {
    return std::isfinite(brightness) && brightness > 0 ? double(brightness) : 0.0;
}

double within_unit(double u) {
    return u > 0 ? std::min(u, 1 - 0x1p-32) : 0.0;
}

// A search begins at the cell of a number: four texels a cell are found in as many steps as one.
uint32_t cells_of(uint32_t columns) {
    return columns / 4 + 1;
}
// Grows with the share, which is in [0, 1].
uint32_t cell_of(float share, uint32_t cells) {
    return uint32_t(double(share) * cells);
}

// Of a texel's neighbours the share that a tent reaches: -1 to 1.
double tent(double u) {
    return u < 0.5 ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u);
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
    uint32_t column = 0;
    const uint32_t cells = cells_of(columns_);
    for (uint32_t cell = 0; cell <= cells; ++cell) {
        while (column < columns_ &&
               cell_of(below_[below_.size() - columns_ + column], cells) < cell)
            ++column;
        first_in_cell_.push_back(column);
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
    const uint32_t cells = cells_of(columns_);
    const uint32_t* first = first_in_cell_.data() + size_t(row) * (cells + 1) +
                            std::min(cell_of(wanted, cells), cells - 1);
    const auto found = std::upper_bound(below.begin() + first[0], below.begin() + first[1], wanted);
    const size_t column = std::min(size_t(found - below.begin()), below.size() - 1);
    const double before = column ? double(below[column - 1]) : 0.0,
                 own = double(below[column]) - before;
    return {uint32_t(column), own > 0 ? within_unit((double(wanted) - before) / own) : 0.5};
}

vec3 MapDistribution::direction(vec2 u, float& density) const {
    float x[kLatlongLanes] = {u.x}, y[kLatlongLanes] = {u.y}, d[3 * kLatlongLanes],
          densities[kLatlongLanes];
    directions(1, x, y, d, densities);
    density = densities[0];
    return {d[0], d[kLatlongLanes], d[2 * kLatlongLanes]};
}

// Places of the chosen texels' tents; the density follows from these, without the direction.
void MapDistribution::directions(uint32_t mask, const float* x, const float* y, float* to,
                                 float* density) const {
    alignas(64) double s[kLatlongLanes] = {}, v[kLatlongLanes] = {};
    alignas(64) float d[3 * kLatlongLanes], around[kLatlongLanes], chances[kLatlongLanes];
    const bool shines = columns_ > 0 && below_row_.back() > 0;
    for (uint32_t left = shines ? mask : 0; left; left &= left - 1) {
        const int i = std::countr_zero(left);
        const Choice row = choose_row(double(x[i])), column = choose_column(row.index, y[i]);
        const double right = tent(column.within), down = tent(row.within);
        // The picture goes on at its other side. Above the first row's middle and below the last
        // one's, lookups see that row alone.
        const double at = (column.index + 0.5 + right) / columns_,
                     below = (row.index + 0.5 + down) / rows_;
        s[i] = at < 0 ? at + 1 : at > 1 ? at - 1 : at;
        v[i] = below < 0 ? -below : below > 1 ? 2 - below : below;
        chances[i] =
            chance({int(column.index) - (right < 0), int(row.index) - (down < 0),
                    float(right < 0 ? 1 + right : right), float(down < 0 ? 1 + down : down)});
    }
    latlong_kernels().directions(s, v, d, around);
    for (; mask; mask &= mask - 1) {
        const int i = std::countr_zero(mask);
        const vec3 lane(d[i], d[kLatlongLanes + i], d[2 * kLatlongLanes + i]);
        const vec3 out = shines ? lane : columns_ ? vec3(0, 1, 0) : even_direction({x[i], y[i]});
        for (int k = 0; k < 3; ++k) to[k * kLatlongLanes + i] = out[k];
        density[i] = shines     ? by_solid_angle(chances[i], around[i])
                     : columns_ ? 0.0f
                                : kEvenDensity;
    }
}

float MapDistribution::share_of_row(uint32_t row) const {
    const double before = row ? below_row_[row - 1] : 0.0;
    return float((below_row_[row] - before) / below_row_.back());
}

float MapDistribution::share(uint32_t row, uint32_t column) const {
    const float* below = below_.data() + size_t(row) * columns_;
    return below[column] - (column ? below[column - 1] : 0.0f);
}

// What a lookup between four texels makes of their chances.
float MapDistribution::chance(const Place& place) const {
    float sum = 0;
    for (int j : {0, 1}) {
        const auto row = uint32_t(std::clamp(place.row + j, 0, int(rows_) - 1));
        float of_row = 0;
        for (int i : {0, 1}) {
            const int column = (place.column + i + int(columns_)) % int(columns_);
            of_row += (i ? place.right : 1 - place.right) * share(row, uint32_t(column));
        }
        sum += (j ? place.bottom : 1 - place.bottom) * share_of_row(row) * of_row;
    }
    return sum;
}

// `around`: cosine of the latitude.
float MapDistribution::by_solid_angle(float chance, float around) const {
    return chance * float(columns_) * float(rows_) /
           (2 * float(kPi * kPi) * std::max(around, kLeastCosine));
}

float MapDistribution::density(vec3 direction) const {
    alignas(64) float d[3 * kLatlongLanes] = {};
    for (int k = 0; k < 3; ++k) d[k * kLatlongLanes] = direction[k];
    LatlongPlaces places;
    latlong_kernels().places(d, places);
    float densities[kLatlongLanes];
    this->densities(1, places, densities);
    return densities[0];
}

void MapDistribution::densities(uint32_t mask, const LatlongPlaces& places, float* to) const {
    const bool shines = columns_ > 0 && below_row_.back() > 0;
    for (; mask; mask &= mask - 1) {
        const int i = std::countr_zero(mask);
        to[i] = 0;
        if (!places.usable[i]) continue;
        if (columns_ == 0) to[i] = kEvenDensity;
        if (!shines) continue;
        const float x = places.s[i] * float(columns_) - 0.5f,
                    y = (1 - places.t[i]) * float(rows_) - 0.5f;
        const float left = std::floor(x), top = std::floor(y);
        to[i] = by_solid_angle(chance({int(left), int(top), x - left, y - top}), places.around[i]);
    }
}

}  // namespace kinora
