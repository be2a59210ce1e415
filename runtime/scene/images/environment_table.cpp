// runtime/scene/images/environment_table.cpp: directions of an environment map by its brightness.
#include "runtime/scene/images/environment_table.h"

#include <algorithm>
#include <cmath>

#include "runtime/base/check.h"

namespace kinora {

namespace {

// Part of the sphere that the light comes from, (sum of b)^2 / (cells sum of b^2). Above it even
// directions find as much, since their wide looks leave nothing out.
constexpr double kConcentrated = 0.1;

// What is not above 0 counts as 0. Half of each cell's light is shared with its neighbours: a
// lookup in a dark cell beside a bright one may see it, and must not be as rare as dark ones.
std::vector<double> shared_with_neighbours(std::span<const float> brightness) {
    constexpr int kColumns = int(EnvironmentTable::kColumns), kRows = int(EnvironmentTable::kRows);
    std::vector<double> out(brightness.size(), 0.0);
    for (int y = 0; y < kRows; ++y)
        for (int x = 0; x < kColumns; ++x) {
            double b = brightness[size_t(y * kColumns + x)];
            if (!(std::isfinite(b) && b > 0)) continue;
            out[size_t(y * kColumns + x)] += b / 2;
            for (int dy : {-1, 0, 1})
                for (int dx : {-1, 0, 1}) {
                    int row = std::clamp(y + dy, 0, kRows - 1);
                    int column = (x + dx + kColumns) % kColumns;
                    out[size_t(row * kColumns + column)] += b / 18;
                }
        }
    return out;
}

}  // namespace

EnvironmentTable::EnvironmentTable(std::span<const float> brightness) : below_(kCells) {
    CHECK_EQ(brightness.size(), size_t(kCells));
    std::vector<double> shared = shared_with_neighbours(brightness);
    double sum = 0, squares = 0;
    for (double b : shared) {
        sum += b;
        squares += b * b;
    }
    uneven_ = sum > 0 && sum * sum < kConcentrated * kCells * squares;
    if (!uneven_) return;
    double so_far = 0;
    for (size_t c = 0; c < kCells; ++c) below_[c] = float((so_far += shared[c]) / sum);
}

vec3 EnvironmentTable::at(uint32_t cell, vec2 within) {
    double y = -1 + 2 * (cell / kColumns + double(within.y)) / kRows;
    double phi = 2 * kPi * (cell % kColumns + double(within.x)) / kColumns;
    double out = std::sqrt(std::max(0.0, 1 - y * y));
    return {float(out * std::cos(phi)), float(y), float(out * std::sin(phi))};
}

vec3 EnvironmentTable::direction(dvec2 u) const {
    float wanted = float(u.x) * below_.back();
    auto found = std::upper_bound(below_.begin(), below_.end(), wanted);
    size_t c = std::min(size_t(found - below_.begin()), below_.size() - 1);
    float from = c ? below_[c - 1] : 0.0f, share = below_[c] - from;
    float within = share > 0 ? std::clamp((wanted - from) / share, 0.0f, 1.0f) : 0.5f;
    return at(uint32_t(c), {within, float(u.y)});
}

float EnvironmentTable::density(vec3 d) const {
    double phi = std::atan2(double(d.z), double(d.x));
    double column = (phi < 0 ? phi + 2 * kPi : phi) / (2 * kPi) * kColumns;
    double row = (double(d.y) + 1) / 2 * kRows;
    size_t c = size_t(std::clamp(row, 0.0, kRows - 1.0)) * kColumns +
               size_t(std::clamp(column, 0.0, kColumns - 1.0));
    float share = below_[c] - (c ? below_[c - 1] : 0.0f);
    return share * float(kCells / (4 * kPi));
}

}  // namespace kinora
