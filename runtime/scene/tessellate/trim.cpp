// runtime/scene/tessellate/trim.cpp: rows of cells, the loops' segments in them, and what is kept.
#include "runtime/scene/tessellate/trim_p.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "runtime/scene/tessellate/cut_cell_p.h"

namespace kinora::tessellation {

namespace {

std::vector<Segment> segments_of(const std::vector<TrimLoop>& loops) {
    std::vector<Segment> segments;
    for (const TrimLoop& loop : loops) {
        std::vector<dvec2> points;
        for (dvec2 p : loop)
            if (std::isfinite(p.x) && std::isfinite(p.y) && (points.empty() || points.back() != p))
                points.push_back(p);
        for (size_t k = 0; k < points.size(); ++k) {
            dvec2 a = points[k], b = points[(k + 1) % points.size()];
            if (a == b) continue;
            if (a.y > b.y || (a.y == b.y && a.x > b.x)) std::swap(a, b);
            segments.push_back({a, b});
        }
    }
    std::sort(segments.begin(), segments.end(),
              [](const Segment& a, const Segment& b) { return a.low.y < b.low.y; });
    return segments;
}

class Trimmer {
  public:
    Trimmer(Grid& grid, const Sheet& sheet, const CurvedSurface& surface, size_t most)
        : grid_(grid),
          segments_(segments_of(surface.trims)),
          outside_(surface.trim_outside),
          most_(most) {
        for (const Line& line : grid.u) u_.push_back(sheet.u.parameter(line));
        for (const Line& line : grid.v) v_.push_back(sheet.v.parameter(line));
        in_cell_.resize(u_.size());
    }

    void run() {
        size_t next = 0;
        std::vector<uint32_t> active;  // segments that reach into the row
        for (size_t j = 0; j + 1 < v_.size(); ++j) {
            if (grid_.v[j + 1].first) continue;
            while (next < segments_.size() && segments_[next].low.y <= v_[j + 1])
                active.push_back(uint32_t(next++));
            std::erase_if(active, [&](uint32_t k) { return segments_[k].high.y < v_[j]; });
            budget_.take(active.size());
            row(j, active);
        }
    }

  private:
    Rectangle cell(size_t i, size_t j) const { return {{u_[i], v_[j]}, {u_[i + 1], v_[j + 1]}}; }

    void row(size_t j, const std::vector<uint32_t>& active) {
        const double height = v_[j] + kAnchor.y * (v_[j + 1] - v_[j]);
        crossings_.clear();
        for (std::vector<Segment>& pieces : in_cell_) pieces.clear();
        for (uint32_t k : active) {
            const Segment& segment = segments_[k];
            if (segment.low.y <= height && height < segment.high.y)
                crossings_.push_back(segment.x_at(height));
            share_out(segment, j);
        }
        std::sort(crossings_.begin(), crossings_.end());
        for (size_t i = 0; i + 1 < u_.size(); ++i) {
            if (grid_.u[i + 1].first) continue;
            if (grid_.corners.size() / 3 + 2 > most_) return;
            const double x = u_[i] + kAnchor.x * (u_[i + 1] - u_[i]);
            const auto left = std::lower_bound(crossings_.begin(), crossings_.end(), x);
            const bool inside = (((left - crossings_.begin()) & 1) != 0) != outside_;
            if (!in_cell_[i].empty() && cut(i, j, inside)) continue;
            if (inside) add_cell(grid_, i, j);
        }
    }

    // The pieces of a segment, to the cells of the row.
    void share_out(const Segment& segment, size_t j) {
        if (!budget_.take(1)) return;
        Segment piece;
        const Rectangle whole{{u_.front(), v_[j]}, {u_.back(), v_[j + 1]}};
        if (!clip(segment, whole, piece)) return;
        const auto [least, most] = std::minmax(piece.low.x, piece.high.x);
        // The first cell that ends at or behind it; borders belong to both cells.
        auto at = std::lower_bound(u_.begin() + 1, u_.end(), least);
        for (size_t i = size_t(at - u_.begin()) - 1; i + 1 < u_.size() && u_[i] <= most; ++i) {
            if (grid_.u[i + 1].first || !clip(segment, cell(i, j), piece)) continue;
            if (!budget_.take(1)) return;
            in_cell_[i].push_back(piece);
        }
    }

    bool cut(size_t i, size_t j, bool inside) {
        points_.clear();
        trapezoids_.clear();
        const Rectangle rectangle = cell(i, j);
        auto keep = [&](dvec2 a, dvec2 b, dvec2 c, dvec2 d, bool below) {
            trapezoids_.push_back({{a, b, c, d}, below});
        };
        if (!is_finite(corner_sum(i, j))) return true;
        if (!cut_cell(rectangle, in_cell_[i], inside, budget_, keep)) return false;
        for (const Trapezoid& t : trapezoids_) {
            if (grid_.corners.size() / 3 + 2 > most_) break;
            uint32_t corner[4];
            for (int k = 0; k < 4; ++k) corner[k] = point(i, j, t.corners[k], t.below);
            add_piece(corner[0], corner[1], corner[3]);
            add_piece(corner[0], corner[3], corner[2]);
        }
        return true;
    }

    void add_piece(uint32_t a, uint32_t b, uint32_t c) {
        if (a != b && b != c && c != a) add_triangle(grid_, a, b, c);
    }

    dvec3 corner_sum(size_t i, size_t j) const {
        const size_t a = j * u_.size() + i, c = a + u_.size();
        return grid_.places[a] + grid_.places[a + 1] + grid_.places[c] + grid_.places[c + 1];
    }

    // A place in one of the cell's two triangles. Cells that share an edge weigh it alike.
    uint32_t point(size_t i, size_t j, dvec2 at, bool below) {
        constexpr double kSteps = 1 << 30;  // of a cell: what rounds to the same one is one point
        const uint32_t width = uint32_t(u_.size()), a = uint32_t(j * width + i);
        const dvec2 low(u_[i], v_[j]), size = dvec2(u_[i + 1], v_[j + 1]) - low;
        const dvec2 p = glm::clamp((at - low) / size, 0.0, 1.0);
        const auto [known, made] =
            points_.try_emplace({std::lround(kSteps * p.x), std::lround(kSteps * p.y)}, 0);
        if (!made) return known->second;
        const double x = at.x == u_[i + 1] ? 1 : p.x, y = at.y == v_[j + 1] ? 1 : p.y;
        SampleBlend blend{{a, a + width + 1, below ? a + 1 : a + width},
                          {below ? 1 - x : 1 - y, below ? y : x, below ? x - y : y - x}};
        blend.weight[2] = std::max(0.0, blend.weight[2]);
        uint32_t& result = known->second;
        result = uint32_t(grid_.samples() + grid_.blends.size());
        for (int k = 0; k < 3; ++k)
            if (blend.weight[k] == 1) return result = blend.sample[k];
        grid_.blends.push_back(blend);
        return result;
    }

    struct Trapezoid {
        dvec2 corners[4];
        bool below;
    };

    Grid& grid_;
    std::vector<Segment> segments_;
    bool outside_;
    size_t most_;
    std::vector<double> u_, v_;
    std::vector<std::vector<Segment>> in_cell_;  // pieces, of a row
    std::vector<double> crossings_;              // of the row's anchors' height
    std::vector<Trapezoid> trapezoids_;
    std::map<std::pair<long, long>, uint32_t> points_;
    CutBudget budget_;
};

}  // namespace

void add_trimmed_cells(Grid& grid, const Sheet& sheet, const CurvedSurface& surface, size_t most) {
    Trimmer(grid, sheet, surface, most).run();
}

}  // namespace kinora::tessellation
