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
    // Fills the rows for all points but what is the same everywhere (kConstantColumns).
    virtual void fill(const PointColumns& columns) = 0;
    // Whether fill() fills these too, since some are not the same everywhere.
    virtual bool fills_constants() const { return false; }
};

void fill_constants(const PointColumns& columns);

// All rows that are not null, with padding lanes: copies of the last point.
void fill_columns(PointSource& source, const PointColumns& columns);

}  // namespace kinora
