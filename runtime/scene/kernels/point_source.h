// runtime/scene/kernels/point_source.h: where the points come from that kernels run on: hits of
// rays, the points of kinora-shade's square.
#pragma once

#include <cstddef>
#include <span>

namespace kinora {

// Rows by Column of padded(count) floats; null where nobody asked. "current" space.
struct PointColumns {
    size_t count;
    std::span<float* const> rows;
};

class PointSource {
  public:
    virtual ~PointSource() = default;
    // Fills the rows for all points; those of kConstantColumns are, and may be filled otherwise.
    virtual void fill(const PointColumns& columns) = 0;
};

// All rows that are not null, with padding lanes: copies of the last point.
void fill_columns(PointSource& source, const PointColumns& columns);

}  // namespace kinora
