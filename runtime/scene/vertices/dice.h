// runtime/scene/vertices/dice.h: how finely triangles are split, and where.
//
// A triangle is split at the midpoints of those of its edges that are too long, again and again.
// Whether an edge is too long depends on its two ends alone, so both triangles at it agree and
// nothing cracks, however different their sizes; and a large triangle is fine only where the camera
// is near.
#pragma once

#include <array>
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

// What one triangle becomes: points in the order of their first use, and triangles of them that
// wind as it does. Empty: itself alone.
struct DicedTriangle {
    std::vector<DicePoint> points;
    std::vector<uint32_t> triangles;
};

using DiceCorners = std::array<DicePoint, 3>;
inline constexpr DiceCorners kWholeTriangle = {DicePoint{0, 0}, DicePoint{kDiceOne, 0},
                                               DicePoint{0, kDiceOne}};

// Inner products of a triangle's edges from corner 0: e1.e1, e1.e2, e2.e2. The shorter diagonal of
// a quadrilateral is chosen by them.
struct DiceMetric {
    double e11 = 1, e12 = 0, e22 = 1;
};

// Whether an edge is longer than `times` what is allowed. The same for (b, a).
using EdgeRule = FunctionRef<bool(DicePoint a, DicePoint b, double times)>;

// Splits triangles, or parts of them, one after another. Not for several threads at once.
class TriangleDicer {
  public:
    // Splits `whole` until no edge is too long. False when that came to more than `limit` triangles
    // (`out` is then unfinished).
    bool dice(const DiceMetric& metric, EdgeRule longer, const DiceCorners& whole, size_t limit,
              DicedTriangle& out);

    // The first steps of the same: until no edge of a part is longer than `times` what is allowed.
    // Dicing each part comes to the triangles of dicing the whole, in their order. False when there
    // came to be more than `limit` parts.
    bool cut(const DiceMetric& metric, EdgeRule longer, double times, size_t limit,
             DicedTriangle& parts);

  private:
    struct Point {
        DicePoint at;
        uint32_t number;  // in the result; kNotUsed: no triangle has it yet
    };
    // Both triangles at an edge find its middle and its halves here.
    struct Edge {
        uint32_t from, to, middle;  // points
        uint32_t halves;            // the edge from `from` to the middle, and the one after it
        enum State : uint8_t { NotLookedAt, Stays, Splits } state;
    };
    using Corners = std::array<uint32_t, 3>;  // points
    using Edges = std::array<uint32_t, 3>;    // edge k is from corner k to the next
    struct Job;

    bool run(const Job& job, const DiceCorners& whole);
    void split(const Job& job, const Corners& p, const Edges& e);
    bool splits(const Job& job, Edge& edge) const;
    bool is_part(const Job& job, const Edges& e) const;
    uint32_t add_point(DicePoint at);
    uint32_t add_edge(uint32_t from, uint32_t to);
    uint32_t half(uint32_t edge, uint32_t at) const;
    uint32_t middle(uint32_t edge);
    void emit(const Job& job, const Corners& p);

    std::vector<Point> points_;
    std::vector<Edge> edges_;
};

// Splits one triangle as a whole.
bool dice_triangle(const DiceMetric& metric, FunctionRef<bool(DicePoint, DicePoint)> too_long,
                   size_t limit, DicedTriangle& out);

// Length in pixels of the edge from a to b (accel space) as the camera could see it: from the
// edge's own distance, whatever its direction. Beyond the picture (with a margin) a quarter, for
// what reflections and shadows show. The same bits for (b, a).
double edge_pixels(const raytrace::Camera& camera, dvec3 a, dvec3 b);

}  // namespace kinora
