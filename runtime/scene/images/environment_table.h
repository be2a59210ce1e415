// runtime/scene/images/environment_table.h: directions of an environment map by its brightness.
#pragma once

#include <span>
#include <vector>

#include "runtime/base/math.h"

namespace kinora {

// The sphere in cells of one solid angle: rows of equal height along y, columns of equal angle.
class EnvironmentTable {
  public:
    static constexpr uint32_t kColumns = 128, kRows = 64, kCells = kColumns * kRows;
    // Edge of a cell, radians.
    static constexpr float kWidth = 0.0391f;  // root of 4 pi / kCells

    static vec3 middle(uint32_t cell) { return at(cell, {0.5f, 0.5f}); }
    // Of each cell; what is not above 0 counts as 0.
    explicit EnvironmentTable(std::span<const float> brightness);

    // Whether so small a part is bright that directions by brightness find more than even ones.
    bool uneven() const { return uneven_; }
    // For u in [0, 1) squared: cells by their brightness, even within each.
    vec3 direction(dvec2 u) const;
    // Of those directions, per solid angle, at a direction of length 1.
    float density(vec3 direction) const;

  private:
    static vec3 at(uint32_t cell, vec2 within);

    std::vector<float> below_;  // shares of the cells before and with each, summed
    bool uneven_ = false;
};

}  // namespace kinora
