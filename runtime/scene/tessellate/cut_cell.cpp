// runtime/scene/tessellate/cut_cell.cpp: slabs between all ends and crossings of the segments in a
// cell; within a slab no two of them cross.
#include "runtime/scene/tessellate/cut_cell_p.h"

#include <algorithm>
#include <cmath>

namespace kinora::tessellation {

namespace {

constexpr double kThinSlab = 1e-10;  // of the cell

double cross2(dvec2 a, dvec2 b) {
    return a.x * b.y - a.y * b.x;
}

// The height at which two segments cross, where they do.
bool crossing(const Segment& a, const Segment& b, double& y) {
    const dvec2 along = a.high - a.low, other = b.high - b.low, to = b.low - a.low;
    const double sine = cross2(along, other);
    if (sine == 0) return false;
    const double t = cross2(to, other) / sine, s = cross2(to, along) / sine;
    if (!(t >= 0 && t <= 1 && s >= 0 && s <= 1)) return false;
    y = a.low.y + t * along.y;
    return true;
}

// A piece in a slab: where it is at the slab's bottom, middle and top.
struct Side {
    double bottom, middle, top;
};

class CellCutter {
  public:
    CellCutter(const Rectangle& cell, std::span<const Segment> pieces, bool inside)
        : cell_(cell), pieces_(pieces.begin(), pieces.end()), inside_(inside) {
        std::sort(pieces_.begin(), pieces_.end(),
                  [](const Segment& a, const Segment& b) { return a.low.y < b.low.y; });
        anchor_ = cell.low + kAnchor * (cell.high - cell.low);
    }

    bool find_slabs(CutBudget& budget) {
        const Segment diagonal{cell_.low, cell_.high};
        heights_ = {cell_.low.y, cell_.high.y};
        double y;
        for (size_t a = 0; a < pieces_.size(); ++a) {
            heights_.push_back(pieces_[a].low.y);
            heights_.push_back(pieces_[a].high.y);
            if (crossing(pieces_[a], diagonal, y)) heights_.push_back(y);
            for (size_t b = a + 1; b < pieces_.size(); ++b) {
                if (pieces_[b].low.y > pieces_[a].high.y) break;
                if (!budget.take(1)) return false;
                if (crossing(pieces_[a], pieces_[b], y)) heights_.push_back(y);
            }
        }
        std::sort(heights_.begin(), heights_.end());
        find_anchor_crossings();
        return true;
    }

    bool keep_slabs(CutBudget& budget, KeepTrapezoid keep) {
        const double thin = kThinSlab * (cell_.high.y - cell_.low.y);
        std::vector<size_t> active;
        size_t next = 0;
        double bottom = cell_.low.y;
        for (double height : heights_) {
            const double top = std::min(height, cell_.high.y);
            if (!(top - bottom > thin) || (top < cell_.high.y && !(cell_.high.y - top > thin)))
                continue;
            const double middle = 0.5 * (bottom + top);
            while (next < pieces_.size() && pieces_[next].low.y <= middle) active.push_back(next++);
            std::erase_if(active, [&](size_t k) { return !(pieces_[k].high.y > middle); });
            if (!budget.take(active.size() + 1)) return false;
            keep_slab(bottom, middle, top, active, keep);
            bottom = top;
        }
        return true;
    }

  private:
    void find_anchor_crossings() {
        for (const Segment& piece : pieces_) {
            const auto [least, most] = std::minmax(piece.low.x, piece.high.x);
            if (!(least <= anchor_.x && anchor_.x < most)) continue;
            const double t = (anchor_.x - piece.low.x) / (piece.high.x - piece.low.x);
            anchor_crossings_.push_back((1 - t) * piece.low.y + t * piece.high.y);
        }
        std::sort(anchor_crossings_.begin(), anchor_crossings_.end());
    }

    // From the anchor up or down to the height, then to the left.
    bool inside_at_left(double y) const {
        auto below = [&](double height) {
            return std::lower_bound(anchor_crossings_.begin(), anchor_crossings_.end(), height) -
                   anchor_crossings_.begin();
        };
        bool inside = inside_ ^ bool((below(y) - below(anchor_.y)) & 1);
        for (const Side& side : sides_) inside ^= side.middle < anchor_.x;
        return inside;
    }

    void keep_slab(double bottom, double middle, double top, const std::vector<size_t>& active,
                   KeepTrapezoid keep) {
        auto in_cell = [&](double x) { return std::clamp(x, cell_.low.x, cell_.high.x); };
        sides_.clear();
        for (size_t k : active)
            sides_.push_back({in_cell(pieces_[k].x_at(bottom)), in_cell(pieces_[k].x_at(middle)),
                              in_cell(pieces_[k].x_at(top))});
        std::sort(sides_.begin(), sides_.end(),
                  [](const Side& a, const Side& b) { return a.middle < b.middle; });
        bool inside = inside_at_left(middle);
        const Segment diagonal{cell_.low, cell_.high};
        const Side across{diagonal.x_at(bottom), diagonal.x_at(middle), diagonal.x_at(top)};
        auto between = [&](const Side& left, const Side& right, bool below) {
            if (left.middle < right.middle)
                keep({left.bottom, bottom}, {right.bottom, bottom}, {left.top, top},
                     {right.top, top}, below);
        };
        Side left{cell_.low.x, cell_.low.x, cell_.low.x};
        auto until = [&](const Side& right) {
            if (inside && across.middle > left.middle && across.middle < right.middle) {
                between(left, across, false);
                between(across, right, true);
            } else if (inside) {
                between(left, right, left.middle >= across.middle);
            }
            left = right;
            inside = !inside;
        };
        for (const Side& side : sides_) until(side);
        until({cell_.high.x, cell_.high.x, cell_.high.x});
    }

    Rectangle cell_;
    std::vector<Segment> pieces_;
    bool inside_;
    dvec2 anchor_{0.0};
    std::vector<double> heights_, anchor_crossings_;
    std::vector<Side> sides_;
};

}  // namespace

// Liang and Barsky (A new concept and method for line clipping, 1984).
bool clip(const Segment& segment, const Rectangle& cell, Segment& piece) {
    const dvec2 along = segment.high - segment.low;
    double enter = 0, leave = 1;
    for (int axis = 0; axis < 2; ++axis) {
        double low = cell.low[axis] - segment.low[axis], high = cell.high[axis] - segment.low[axis];
        if (along[axis] == 0) {
            if (low > 0 || high < 0) return false;
            continue;
        }
        low /= along[axis];
        high /= along[axis];
        enter = std::max(enter, std::min(low, high));
        leave = std::min(leave, std::max(low, high));
    }
    if (!(enter <= leave)) return false;
    auto at = [&](double t) {
        dvec2 p = t == 0 ? segment.low : t == 1 ? segment.high : segment.low + t * along;
        return glm::clamp(p, cell.low, cell.high);
    };
    piece = {at(enter), at(leave)};
    return true;
}

bool cut_cell(const Rectangle& cell, std::span<const Segment> pieces, bool inside,
              CutBudget& budget, KeepTrapezoid keep) {
    CellCutter cutter(cell, pieces, inside);
    return cutter.find_slabs(budget) && cutter.keep_slabs(budget, keep);
}

}  // namespace kinora::tessellation
