// raytrace/pixels/filter_grid.h: pixel filters of any shape, also with values below 0.
//
// A fixed number of a pixel's samples is drawn where the filter is below 0, the others where it is
// above, each with the filter's density there. Both have fixed weights, so that no sum of weights
// is divided by, and what is even stays even.
#pragma once

#include <span>
#include <vector>

#include "runtime/base/math.h"

namespace kinora::raytrace {

class FilterGrid {
  public:
    // Values in as many rows as columns, from the top, of a rectangle around the pixel's centre;
    // the sides are in pixels. Their sum is above 0.
    FilterGrid(std::span<const float> values, double width, double height);

    // Of one of the pixel's samples, of which there are at least two: the parts of the picture that
    // it counts for; all together are their number.
    double weight(int sample, int samples) const;
    // Where it lies, pixels from the centre; u is in [0, 1) in both directions.
    dvec2 offset(int sample, int samples, dvec2 u) const;

  private:
    // A density, cell by cell.
    struct Part {
        double sum = 0;
        std::vector<double> rows;   // sums of the rows up to each
        std::vector<double> cells;  // likewise within each row
    };
    static Part part_of(std::span<const float> values, size_t side, float sign);
    int negative_samples(int samples) const;

    size_t side_;
    dvec2 size_;
    Part positive_, negative_;
};

}  // namespace kinora::raytrace
