// runtime/scene/images/environment_table.h: directions of an environment map by its brightness.
#pragma once

#include <span>
#include <vector>

#include "runtime/base/math.h"

namespace kinora {

// The sphere in cells: rows of equal angle from the top (y = 1), columns of equal angle about y.
struct SphereCells {
    uint32_t columns, rows;

    uint32_t count() const { return columns * rows; }
    vec3 middle(uint32_t cell) const { return at(cell, {0.5f, 0.5f}); }
    // `within` the cell, in [0, 1] squared: even in solid angle.
    vec3 at(uint32_t cell, vec2 within) const;
    uint32_t cell_of(vec3 direction) const;
    double solid_angle(uint32_t row) const;
};

class EnvironmentTable {
  public:
    // Brightness of each cell; what is not above 0 counts as 0.
    EnvironmentTable(SphereCells cells, std::span<const float> brightness);

    // Whether so small a part is bright that directions by brightness find more than even ones.
    bool uneven() const { return uneven_; }
    // For u in [0, 1) squared: cells by their light, even within each.
    vec3 direction(dvec2 u) const;
    // Of those directions, per solid angle, at a direction of length 1.
    float density(vec3 direction) const;

  private:
    void add_row(uint32_t row, std::span<const double> light);

    SphereCells cells_;
    std::vector<double> below_row_;  // light of the rows before and with each, summed
    std::vector<float> below_;       // of a row's: shares of the cells before and with each
    bool uneven_ = false;
};

}  // namespace kinora
