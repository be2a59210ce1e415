// runtime/scene/tessellate/cut_cell_p.h: one rectangle of parameters cut along segments.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "runtime/base/math.h"
#include "runtime/base/parallel.h"

namespace kinora::tessellation {

// From lower to higher y.
struct Segment {
    dvec2 low{0.0}, high{0.0};
    double x_at(double y) const {
        if (!(high.y > low.y)) return low.x;
        double t = (y - low.y) / (high.y - low.y);
        return t <= 0 ? low.x : t >= 1 ? high.x : (1 - t) * low.x + t * high.x;
    }
};

struct Rectangle {
    dvec2 low{0.0}, high{0.0};
};

// Whether a segment has a point in the rectangle, border included, and the part of it that is in.
bool clip(const Segment& segment, const Rectangle& cell, Segment& piece);

// Work that all cells share: what loops may cost, whatever they are.
struct CutBudget {
    size_t left = 20'000'000;
    bool take(size_t work) {
        const bool enough = work <= left;
        left = enough ? left - work : 0;
        return enough;
    }
};

// A place that is no segment's end, as a part of the rectangle.
inline constexpr dvec2 kAnchor{0.41421356237309503, 0.38196601125010515};

// Calls keep(lower left, lower right, upper left, upper right) for trapezoids between horizontal
// lines, none of which crosses the diagonal from the lower left: those inside by the even-odd rule,
// where `inside` is said of the anchor. False, and nothing kept, where the budget is at its end.
using KeepTrapezoid = FunctionRef<void(dvec2, dvec2, dvec2, dvec2, bool below_diagonal)>;
bool cut_cell(const Rectangle& cell, std::span<const Segment> pieces, bool inside,
              CutBudget& budget, KeepTrapezoid keep);

}  // namespace kinora::tessellation
