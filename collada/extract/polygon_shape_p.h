// collada/extract/polygon_shape_p.h: whether polygons are flat, convex, and there at all.
#pragma once

#include <cstdint>
#include <span>

#include "runtime/base/math.h"

namespace kinora::collada {

struct PolygonShape {
    bool empty = false;      // corners fall on one another or on one line
    bool concave = false;    // seen along its normal, a corner turns the other way
    bool crossing = false;   // two of its edges cross; asked of flat polygons of up to 256 corners
    double deviation = 0.0;  // largest distance of a corner from its plane / its size
};

// Of one outline of at least three finite corners. Thresholds are relative: no unit matters.
PolygonShape polygon_shape(std::span<const dvec3> corners);

// The shapes of one primitive element, summed.
struct PolygonStatistics {
    uint32_t polygons = 0, empty = 0, concave = 0, crossing = 0, bent = 0;
    double worst_deviation = 0.0;
    void add(std::span<const dvec3> corners);
};

}  // namespace kinora::collada
