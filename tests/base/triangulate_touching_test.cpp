// tests/collada/triangulate_touching_test.cpp: holes that touch the outline and each other, at
// corners and along edges, against whole numbers: area, and what covers each cell's middle.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "runtime/base/polygons/triangulate.h"

namespace kinora {
namespace {

struct Point {
    int64_t x, y;
    friend auto operator<=>(const Point&, const Point&) = default;
    Point operator-(Point b) const { return {x - b.x, y - b.y}; }
};

int64_t cross(Point a, Point b) {
    return a.x * b.y - a.y * b.x;
}

using Cell = std::array<Point, 3>;  // counter-clockwise

// A board of squares cut in four by their diagonals, in units that keep the middles whole.
std::vector<Cell> board(int size) {
    std::vector<Cell> cells;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            Point a{6 * x, 6 * y}, b{6 * x + 6, 6 * y}, c{6 * x + 6, 6 * y + 6},
                d{6 * x, 6 * y + 6};
            Point m{6 * x + 3, 6 * y + 3};
            cells.insert(cells.end(), {{a, b, m}, {b, c, m}, {c, d, m}, {d, a, m}});
        }
    return cells;
}

// All cells but some, which hang together by their edges.
std::set<size_t> region_of(std::mt19937& random, const std::vector<Cell>& cells, size_t without) {
    std::map<std::pair<Point, Point>, size_t> by_edge;
    std::set<size_t> region;
    for (size_t i = 0; i < cells.size(); ++i) {
        region.insert(i);
        for (int e = 0; e < 3; ++e) by_edge[{cells[i][e], cells[i][(e + 1) % 3]}] = i;
    }
    auto whole = [&] {
        std::vector<size_t> todo{*region.begin()};
        std::set<size_t> seen{todo[0]};
        while (!todo.empty()) {
            const Cell& c = cells[todo.back()];
            todo.pop_back();
            for (int e = 0; e < 3; ++e) {
                auto next = by_edge.find({c[(e + 1) % 3], c[e]});
                if (next == by_edge.end() || !region.count(next->second)) continue;
                if (seen.insert(next->second).second) todo.push_back(next->second);
            }
        }
        return seen.size() == region.size();
    };
    for (size_t i = 0; i < without; ++i) {
        size_t cell = random() % cells.size();
        if (!region.erase(cell)) continue;
        if (region.empty() || !whole()) region.insert(cell);
    }
    return region;
}

// The region's border as loops with the inside on their left, each going around one piece of the
// outside: outline and holes then touch at corners and corners stand on edges.
std::vector<std::vector<Point>> border(const std::vector<Cell>& cells,
                                       const std::set<size_t>& region) {
    std::set<std::pair<Point, Point>> edges;
    for (size_t i : region)
        for (int e = 0; e < 3; ++e) {
            Point a = cells[i][e], b = cells[i][(e + 1) % 3];
            if (!edges.erase({b, a})) edges.insert({a, b});
        }
    auto angle = [](Point from, Point to) {  // counter-clockwise from `from`, above 0
        double turn = std::atan2(double(cross(from, to)), double(from.x * to.x + from.y * to.y));
        return turn > 1e-9 ? turn : turn + 2 * kPi;
    };
    std::vector<std::vector<Point>> loops;
    while (!edges.empty()) {
        auto [start, at] = *edges.begin();
        std::vector<Point> loop{start};
        Point before = start;
        edges.erase(edges.begin());
        while (at != start) {
            loop.push_back(at);
            Point best{};
            double least = 10;
            for (auto e = edges.lower_bound({at, {INT64_MIN, INT64_MIN}});
                 e != edges.end() && e->first == at; ++e)
                if (double turn = angle(before - at, e->second - at); turn < least)
                    least = turn, best = e->second;
            if (least == 10) return {};
            edges.erase({at, best});
            before = at;
            at = best;
        }
        std::vector<Point> corners;  // without those on straight lines
        for (size_t i = 0; i < loop.size(); ++i) {
            Point a = loop[(i + loop.size() - 1) % loop.size()], c = loop[(i + 1) % loop.size()];
            if (cross(loop[i] - a, c - loop[i]) != 0) corners.push_back(loop[i]);
        }
        loops.push_back(corners);
    }
    auto area = [](const std::vector<Point>& loop) {
        int64_t sum = 0;
        for (size_t i = 0; i < loop.size(); ++i) sum += cross(loop[i], loop[(i + 1) % loop.size()]);
        return sum;
    };
    std::sort(loops.begin(), loops.end(), [&](auto& a, auto& b) { return area(a) > area(b); });
    return loops;
}

struct Cut {
    std::vector<Point> points;
    std::vector<uint32_t> triangles;
    Triangulation result;
};

Cut cut(std::mt19937& random, const std::vector<std::vector<Point>>& loops, const int64_t (&m)[4]) {
    Cut c;
    std::vector<dvec3> corners;
    std::vector<uint32_t> sizes;
    for (size_t l = 0; l < loops.size(); ++l) {
        std::vector<Point> loop = loops[l];
        std::rotate(loop.begin(), loop.begin() + std::ptrdiff_t(random() % loop.size()),
                    loop.end());
        if (l && random() % 2) std::reverse(loop.begin(), loop.end());  // files wind holes freely
        sizes.push_back(uint32_t(loop.size()));
        for (Point p : loop) {
            c.points.push_back(p);
            corners.push_back(
                {double(m[0] * p.x + m[1] * p.y), double(m[2] * p.x + m[3] * p.y), 0});
        }
    }
    c.result = triangulate(corners, sizes, c.triangles);
    return c;
}

// Null when the triangles are just the region.
const char* fault_of(const Cut& c, const std::vector<Cell>& cells, const std::set<size_t>& region) {
    if (c.result.lost_holes) return "a hole was lost";
    if (c.result.self_intersecting) return "it is said to cross itself";
    int64_t sum = 0, wanted = 0;
    for (size_t i : region) wanted += cross(cells[i][1] - cells[i][0], cells[i][2] - cells[i][0]);
    for (size_t t = 0; t < c.triangles.size(); t += 3) {
        Point p = c.points[c.triangles[t]];
        int64_t twice = cross(c.points[c.triangles[t + 1]] - p, c.points[c.triangles[t + 2]] - p);
        if (twice < 0) return "a triangle is turned over";
        sum += twice;
    }
    if (sum != wanted) return "the areas differ";
    for (size_t i = 0; i < cells.size(); ++i) {
        Point middle{(cells[i][0].x + cells[i][1].x + cells[i][2].x) / 3,
                     (cells[i][0].y + cells[i][1].y + cells[i][2].y) / 3};
        int covers = 0;
        for (size_t t = 0; t < c.triangles.size(); t += 3) {
            bool in = true, on_edge = false;
            for (int e = 0; e < 3; ++e) {
                Point a = c.points[c.triangles[t + e]], b = c.points[c.triangles[t + (e + 1) % 3]];
                int64_t side = cross(b - a, middle - a);
                in &= side >= 0;
                on_edge |= side == 0;
            }
            Point p = c.points[c.triangles[t]];
            bool empty =
                cross(c.points[c.triangles[t + 1]] - p, c.points[c.triangles[t + 2]] - p) == 0;
            if (in && !empty) covers += on_edge ? 1 : 2;  // its neighbour has the edge, too
        }
        if (covers != (region.count(i) ? 2 : 0)) return "a cell is covered wrongly";
    }
    return nullptr;
}

TEST(TriangulateTouching, RegionsOfCellsAreCoveredExactly) {
    constexpr int64_t kMaps[][4] = {{1, 0, 0, 1}, {3, 1, -1, 2}, {0, -1, 1, 0}, {5, 3, 2, 7}};
    std::mt19937 random(11);
    size_t holes = 0, wrong = 0;
    for (int round = 0; round < 800; ++round) {
        int size = 2 + round % 5;
        std::vector<Cell> cells = board(size);
        std::set<size_t> region = region_of(random, cells, random() % cells.size() / 2);
        std::vector<std::vector<Point>> loops = border(cells, region);
        ASSERT_FALSE(loops.empty());
        holes += loops.size() - 1;
        Cut c = cut(random, loops, kMaps[random() % 4]);
        if (const char* fault = fault_of(c, cells, region)) {
            ++wrong;
            std::string text;
            for (const auto& loop : loops) {
                text += "\n  ";
                for (Point p : loop) text += std::to_string(p.x) + "," + std::to_string(p.y) + " ";
            }
            if (wrong <= 3) ADD_FAILURE() << "round " << round << ": " << fault << text;
        }
    }
    EXPECT_GT(holes, 2000u);
    EXPECT_EQ(wrong, 0u);
}

}  // namespace
}  // namespace kinora
