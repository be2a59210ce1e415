// runtime/vertices/dice.h: how finely triangles are split, and where.
//
// A triangle is split at the midpoints of those of its edges that are too long, again and again.
// Whether an edge is too long depends on its two ends alone, so both triangles at it agree and
// nothing cracks, however different their sizes; and a large triangle is fine only where the camera
// is near.
#pragma once

#include <cstdint>
#include <vector>

#include "raytrace/camera.h"
#include "runtime/base/math.h"
#include "runtime/base/parallel.h"

namespace kinora {

// A point of a triangle: barycentrics of corners 1 and 2 in units of 1 / kDiceOne. Midpoints are
// exact for twenty halvings; an edge that has no midpoint in these units stays.
inline constexpr uint32_t kDiceOne = 1u << 20;
struct DicePoint {
    uint32_t i = 0, j = 0;
    uint32_t weight(int corner) const {
        return corner == 0 ? kDiceOne - i - j : corner == 1 ? i : j;
    }
};

// Halving leaves edges between half of the longest and the longest: for their mean to be as asked,
// none may be longer than this times what is asked.
inline constexpr double kLongestEdge = 1.41421356;

// What one triangle becomes: points 0, 1, 2 are its corners; triangles wind as it does. Empty:
// itself alone.
struct DicedTriangle {
    std::vector<DicePoint> points;
    std::vector<uint32_t> triangles;
};

// Inner products of a triangle's edges from corner 0: e1.e1, e1.e2, e2.e2. The shorter diagonal of
// a quadrilateral is chosen by them.
struct DiceMetric {
    double e11 = 1, e12 = 0, e22 = 1;
};

// Splits one triangle. False when it came to more than `limit` triangles (`out` is then
// unfinished).
bool dice_triangle(const DiceMetric& metric, FunctionRef<bool(DicePoint, DicePoint)> too_long,
                   size_t limit, DicedTriangle& out);

// Length in pixels of the edge from a to b (accel space) as the camera could see it: from the
// edge's own distance, whatever its direction. Beyond the picture (with a margin) a quarter, for
// what reflections and shadows show. The same bits for (b, a).
double edge_pixels(const raytrace::Camera& camera, dvec3 a, dvec3 b);

}  // namespace kinora
