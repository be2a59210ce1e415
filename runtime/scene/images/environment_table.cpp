// runtime/scene/images/environment_table.cpp: directions of an environment map by its brightness.
#include "runtime/scene/images/environment_table.h"

#include <algorithm>
#include <cmath>

#include "runtime/base/check.h"

namespace kinora {

// ---- cells --------------------------------------------------------------------------------------

vec3 SphereCells::at(uint32_t cell, vec2 within) const {
    const double row = cell / columns, top = std::cos(kPi * row / rows),
                 bottom = std::cos(kPi * (row + 1) / rows);
    const double y = top + (bottom - top) * double(within.y);
    const double phi = 2 * kPi * (cell % columns + double(within.x)) / columns;
    const double out = std::sqrt(std::max(0.0, 1 - y * y));
    return {float(out * std::cos(phi)), float(y), float(out * std::sin(phi))};
}

uint32_t SphereCells::cell_of(vec3 d) const {
    const double phi = std::atan2(double(d.z), double(d.x));
    const double column = (phi < 0 ? phi + 2 * kPi : phi) / (2 * kPi) * columns;
    const double row = std::acos(std::clamp(double(d.y), -1.0, 1.0)) / kPi * rows;
    return uint32_t(std::clamp(row, 0.0, rows - 1.0)) * columns +
           uint32_t(std::clamp(column, 0.0, columns - 1.0));
}

double SphereCells::solid_angle(uint32_t row) const {
    return 2 * kPi / columns *
           (std::cos(kPi * double(row) / rows) - std::cos(kPi * double(row + 1) / rows));
}

// ---- the table ----------------------------------------------------------------------------------

namespace {

// Part of the sphere that the light comes from: (sum of b)^2 / (4 pi sum of b^2), over solid
// angles. Above it, directions by brightness find no more than even ones.
constexpr double kConcentrated = 0.5;

// What is not above 0 counts as 0. Half of each cell's light is shared with its neighbours: a
// lookup in a dark cell beside a bright one may see it, and must not be as rare as dark ones.
std::vector<double> shared_with_neighbours(const SphereCells& cells,
                                           std::span<const float> brightness) {
    const int columns = int(cells.columns), rows = int(cells.rows);
    std::vector<double> out(brightness.size(), 0.0);
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const double b = double(brightness[size_t(y) * size_t(columns) + size_t(x)]);
            if (!(std::isfinite(b) && b > 0)) continue;
            out[size_t(y) * size_t(columns) + size_t(x)] += b / 2;
            for (int dy : {-1, 0, 1})
                for (int dx : {-1, 0, 1}) {
                    const int row = std::clamp(y + dy, 0, rows - 1);
                    const int column = (x + dx + columns) % columns;
                    out[size_t(row) * size_t(columns) + size_t(column)] += b / 18;
                }
        }
    return out;
}

}  // namespace

EnvironmentTable::EnvironmentTable(SphereCells cells, std::span<const float> brightness)
    : cells_(cells), below_(cells.count()) {
    CHECK_EQ(brightness.size(), size_t(cells.count()));
    const std::vector<double> shared = shared_with_neighbours(cells, brightness);
    const std::span<const double> all = shared;
    double squares = 0;
    for (uint32_t row = 0; row < cells.rows; ++row) {
        const std::span<const double> own = all.subspan(size_t(row) * cells.columns, cells.columns);
        for (double b : own) squares += b * b * cells.solid_angle(row);
        add_row(row, own);
    }
    const double sum = below_row_.back();
    uneven_ = sum > 0 && sum * sum < kConcentrated * 4 * kPi * squares;
}

// A row of no light has even shares, which nothing chooses.
void EnvironmentTable::add_row(uint32_t row, std::span<const double> light) {
    double sum = 0, so_far = 0;
    for (double b : light) sum += b;
    for (size_t c = 0; c < light.size(); ++c) {
        so_far += light[c];
        below_[size_t(row) * cells_.columns + c] =
            float(sum > 0 ? so_far / sum : double(c + 1) / double(light.size()));
    }
    const double before = row ? below_row_.back() : 0.0;
    below_row_.push_back(before + sum * cells_.solid_angle(row));
}

vec3 EnvironmentTable::direction(dvec2 u) const {
    const double wanted = u.x * below_row_.back();
    const auto found_row = std::upper_bound(below_row_.begin(), below_row_.end(), wanted);
    const size_t row = std::min(size_t(found_row - below_row_.begin()), below_row_.size() - 1);
    const double before = row ? below_row_[row - 1] : 0.0, own = below_row_[row] - before;
    const std::span<const float> below(below_.data() + row * cells_.columns, cells_.columns);
    const auto found = std::upper_bound(below.begin(), below.end(), float(u.y));
    const size_t c = std::min(size_t(found - below.begin()), below.size() - 1);
    const float from = c ? below[c - 1] : 0.0f, share = below[c] - from;
    const float x = share > 0 ? std::clamp((float(u.y) - from) / share, 0.0f, 1.0f) : 0.5f;
    const float y = own > 0 ? float(std::clamp((wanted - before) / own, 0.0, 1.0)) : 0.5f;
    return cells_.at(uint32_t(row) * cells_.columns + uint32_t(c), {x, y});
}

float EnvironmentTable::density(vec3 d) const {
    const uint32_t cell = cells_.cell_of(d), row = cell / cells_.columns;
    const float share = below_[cell] - (cell % cells_.columns ? below_[cell - 1] : 0.0f);
    const double own = below_row_[row] - (row ? below_row_[row - 1] : 0.0);
    return float(own / below_row_.back() * double(share) / cells_.solid_angle(row));
}

}  // namespace kinora
