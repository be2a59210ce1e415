// runtime/base/polygons/triangulate.cpp: ear clipping on the plane nearest the polygon; holes are
// first joined to the outline by bridges (Eberly, "Triangulation by Ear Clipping"), and what
// touches itself then is taken apart.
#include "runtime/base/polygons/triangulate.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <tuple>
#include <unordered_set>

namespace kinora {

namespace {

// Newell's normal: twice the area vector of the outline.
dvec3 area_vector(std::span<const dvec3> loop) {
    const dvec3& origin = loop[0];  // differences keep far polygons exact
    dvec3 sum(0.0), a = loop[1] - origin;
    for (size_t i = 2; i < loop.size(); ++i) {
        dvec3 b = loop[i] - origin;
        sum += glm::cross(a, b);
        a = b;
    }
    return sum;
}

double cross(dvec2 a, dvec2 b, dvec2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool in_triangle(dvec2 a, dvec2 b, dvec2 c, dvec2 p) {
    return cross(a, b, p) >= 0 && cross(b, c, p) >= 0 && cross(c, a, p) >= 0;
}

bool same(dvec2 a, dvec2 b) {
    return a.x == b.x && a.y == b.y;
}

struct PointHash {
    size_t operator()(dvec2 p) const {
        std::hash<double> hash;
        return hash(p.x) * 31 + hash(p.y);
    }
};

class EarClipper {
  public:
    EarClipper(std::span<const dvec2> points, std::vector<uint32_t>& triangles)
        : points_(points), triangles_(triangles) {}

    // Joins a hole (corner numbers, clockwise) to the outline; false if it sees no outline.
    bool bridge(std::span<const uint32_t> hole);  // or when the budget of work is spent
    // Joins a hole that has a corner where the outline has one; false if it has none.
    bool join_touching(std::span<const uint32_t> hole);
    void set_outline(std::vector<uint32_t> ring) { ring_ = std::move(ring); }
    // Where outline and holes have corners at one point, the inside of the ring is not told by the
    // order of its corners: what holes that touch twice part becomes rings of their own.
    void take_apart();
    bool clip();  // false: the polygon crosses itself

  private:
    bool clip_ring();
    dvec2 at(uint32_t i) const { return points_[ring_[i]]; }
    bool reflex(uint32_t i) const { return cross(at(previous_[i]), at(i), at(next_[i])) <= 0; }
    bool opens_to(uint32_t i, dvec2 p) const;
    void insert(uint32_t i, std::span<const uint32_t> hole, size_t first);
    bool is_ear(uint32_t i);
    void cut(uint32_t i, bool emit);
    bool cut_stuck(uint32_t& start, uint32_t left);

    static constexpr uint64_t kBudget = 100'000'000;
    static constexpr uint32_t kMostAtOnePoint = 256;  // corners; what has more crosses itself
    std::span<const dvec2> points_;
    std::vector<uint32_t>& triangles_;
    std::vector<uint32_t> ring_;                // corner numbers around the (bridged) outline
    std::vector<std::vector<uint32_t>> rings_;  // what take_apart made of it
    std::unordered_set<dvec2, PointHash> corner_points_;  // of ring_, once holes are joined
    std::vector<uint32_t> next_, previous_;               // linked positions of ring_
    std::vector<uint32_t> reflex_;  // positions that were reflex when last looked at
    uint64_t work_ = 0;
    bool crosses_ = false;
};

bool EarClipper::bridge(std::span<const uint32_t> hole) {
    work_ += 4 * ring_.size();
    if (work_ > kBudget) return false;
    size_t rightmost = 0;
    for (size_t i = 1; i < hole.size(); ++i)
        if (points_[hole[i]].x > points_[hole[rightmost]].x) rightmost = i;
    dvec2 m = points_[hole[rightmost]];
    // The nearest edge to the right of m that goes upwards, and its end further right.
    double best_x = INFINITY;
    size_t best = SIZE_MAX;
    for (size_t i = 0; i < ring_.size(); ++i) {
        dvec2 a = at(uint32_t(i)), b = at(uint32_t((i + 1) % ring_.size()));
        if (!(a.y <= m.y && b.y >= m.y) || a.y == b.y) continue;
        double hit = a.x + (m.y - a.y) / (b.y - a.y) * (b.x - a.x);
        if (hit < m.x || hit >= best_x) continue;
        best_x = hit;
        best = a.x > b.x ? i : (i + 1) % ring_.size();
    }
    if (best == SIZE_MAX) return false;
    // A reflex corner inside the triangle m, hit, best hides `best`: take that of least angle.
    dvec2 hit(best_x, m.y), p = at(uint32_t(best));
    double best_slope = INFINITY, best_distance = INFINITY;
    size_t visible = best;
    for (size_t i = 0; i < ring_.size(); ++i) {
        dvec2 q = at(uint32_t(i));
        if (q.x < m.x || same(q, m)) continue;
        bool inside = p.y < m.y ? in_triangle(m, p, hit, q) : in_triangle(m, hit, p, q);
        if (!inside) continue;
        if (!opens_to(uint32_t(i), m)) continue;
        double slope = std::abs(q.y - m.y) / (q.x - m.x), distance = q.x - m.x;
        if (slope < best_slope || (slope == best_slope && distance < best_distance)) {
            best_slope = slope;
            best_distance = distance;
            visible = i;
        }
    }
    insert(uint32_t(visible), hole, rightmost);
    return true;
}

bool EarClipper::join_touching(std::span<const uint32_t> hole) {
    if (corner_points_.empty())
        for (uint32_t i = 0; i < ring_.size(); ++i) corner_points_.insert(at(i));
    for (size_t k = 0; k < hole.size() && work_ <= kBudget; ++k) {
        dvec2 p = points_[hole[k]];
        if (!corner_points_.contains(p)) continue;
        work_ += ring_.size();
        for (uint32_t i = 0; i < ring_.size(); ++i)
            if (same(at(i), p)) {
                insert(i, hole, k);
                return true;
            }
    }
    return false;
}

// Half turns and then signs of areas order directions without angles: whether `p` comes before `q`
// when one turns clockwise around `o`, beginning behind the direction to `from`.
bool turns_sooner(dvec2 o, dvec2 from, dvec2 p, dvec2 q) {
    auto half = [&](dvec2 x) {  // 0: to the right of `from`, 1: opposite or left, 2: `from` itself
        double side = cross(o, from, x);
        if (side < 0) return 0;
        double along = (from.x - o.x) * (x.x - o.x) + (from.y - o.y) * (x.y - o.y);
        return side == 0 && along > 0 ? 2 : 1;
    };
    int a = half(p), b = half(q);
    return a != b ? a < b : cross(o, p, q) < 0;
}

// At each point every edge that arrives goes on by the edge that comes first clockwise: between
// the two lies the inside.
void EarClipper::take_apart() {
    uint32_t size = uint32_t(ring_.size());
    std::vector<uint32_t> order(size), follows(size);
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](uint32_t i, uint32_t k) {
        dvec2 p = at(i), q = at(k);
        return std::tie(p.x, p.y, i) < std::tie(q.x, q.y, k);
    });
    for (uint32_t first = 0, end; first < size; first = end) {
        for (end = first + 1; end < size && same(at(order[first]), at(order[end])); ++end) {
        }
        bool crowded = end - first > kMostAtOnePoint;
        crosses_ |= crowded;
        for (uint32_t n = first; n < end; ++n) {
            uint32_t i = order[n], best = i;
            dvec2 before = at((i + size - 1) % size);
            for (uint32_t m = first; m < end && !crowded; ++m)
                if (turns_sooner(at(i), before, at((order[m] + 1) % size), at((best + 1) % size)))
                    best = order[m];
            follows[i] = (best + 1) % size;
        }
    }
    std::vector<bool> seen(size);
    for (uint32_t i = 0; i < size; ++i) {
        std::vector<uint32_t> ring;
        for (uint32_t k = i; !seen[k]; k = follows[k]) {
            seen[k] = true;
            ring.push_back(ring_[k]);
        }
        if (ring.size() > 2) rings_.push_back(std::move(ring));
    }
}

bool EarClipper::clip() {
    if (rings_.empty()) return clip_ring();
    bool clean = !crosses_;
    for (std::vector<uint32_t>& ring : rings_) {
        ring_ = std::move(ring);
        clean = clip_ring() && clean;
    }
    return clean;
}

// Whether a line from the ring's corner i to p begins inside the polygon.
bool EarClipper::opens_to(uint32_t i, dvec2 p) const {
    uint32_t size = uint32_t(ring_.size());
    dvec2 before = at((i + size - 1) % size), q = at(i), after = at((i + 1) % size);
    bool convex = cross(before, q, after) > 0;
    bool left = cross(before, q, p) > 0, right = cross(q, after, p) > 0;
    return convex ? left && right : left || right;
}

// From the ring's corner i to the hole's corner `first`, once around, and back; where both are one
// point, no way leads there or back.
void EarClipper::insert(uint32_t i, std::span<const uint32_t> hole, size_t first) {
    size_t skip = same(at(i), points_[hole[first]]);
    std::vector<uint32_t> joined(ring_.begin(), ring_.begin() + std::ptrdiff_t(i) + 1);
    for (size_t k = skip; k <= hole.size(); ++k) joined.push_back(hole[(first + k) % hole.size()]);
    joined.insert(joined.end(), ring_.begin() + std::ptrdiff_t(i + skip), ring_.end());
    ring_ = std::move(joined);
    for (uint32_t corner : hole) corner_points_.insert(points_[corner]);
}

bool EarClipper::is_ear(uint32_t i) {
    uint32_t before = previous_[i], after = next_[i];
    dvec2 a = at(before), b = at(i), c = at(after);
    if (!(cross(a, b, c) > 0)) return false;
    size_t kept = 0;
    for (size_t k = 0; k < reflex_.size(); ++k) {
        ++work_;
        uint32_t r = reflex_[k];
        if (next_[r] == r || !reflex(r)) continue;  // cut off, or convex by now
        std::swap(reflex_[kept++], reflex_[k]);
        if (r == before || r == i || r == after) continue;
        dvec2 q = at(r);
        if (same(q, a) || same(q, b) || same(q, c)) continue;  // the other side of a bridge
        if (in_triangle(a, b, c, q)) return false;
    }
    reflex_.resize(kept);
    return true;
}

void EarClipper::cut(uint32_t i, bool emit) {
    uint32_t before = previous_[i], after = next_[i];
    if (emit) triangles_.insert(triangles_.end(), {ring_[before], ring_[i], ring_[after]});
    next_[before] = after;
    previous_[after] = before;
    next_[i] = previous_[i] = i;  // marks it as gone
}

// No ear is left although corners are: take one that does the least harm.
bool EarClipper::cut_stuck(uint32_t& start, uint32_t left) {
    uint32_t flat = UINT32_MAX, convex = UINT32_MAX;
    uint32_t i = start;
    work_ += left;
    for (uint32_t k = 0; k < left; ++k, i = next_[i]) {
        double turn = cross(at(previous_[i]), at(i), at(next_[i]));
        if (turn == 0 && flat == UINT32_MAX) flat = i;
        if (turn > 0 && convex == UINT32_MAX) convex = i;
    }
    uint32_t chosen = flat != UINT32_MAX ? flat : convex != UINT32_MAX ? convex : start;
    start = next_[chosen];
    cut(chosen, true);
    return chosen == flat;  // a corner on a straight line is no crossing
}

bool EarClipper::clip_ring() {
    uint32_t left = uint32_t(ring_.size());
    next_.resize(left);
    previous_.resize(left);
    for (uint32_t i = 0; i < left; ++i) {
        next_[i] = i + 1 < left ? i + 1 : 0;
        previous_[i] = i > 0 ? i - 1 : left - 1;
    }
    reflex_.clear();
    for (uint32_t i = 0; i < left; ++i)
        if (reflex(i)) reflex_.push_back(i);
    bool clean = true;
    uint32_t i = 0, tried = 0;
    while (left > 3) {
        if (work_ < kBudget && tried < left) {
            work_ += 1 + reflex_.size() / 8;
            uint32_t after = next_[i];
            if (is_ear(i)) {
                cut(i, true);
                --left;
                tried = 0;
                i = next_[after];  // alternate corners give rounder triangles
            } else {
                ++tried;
                i = after;
            }
            continue;
        }
        if (work_ < kBudget) {
            clean = cut_stuck(i, left) && clean;
        } else {
            uint32_t after = next_[i];
            cut(after, true);
            clean = false;
        }
        tried = 0;
        --left;
    }
    cut(i, true);
    return clean;
}

// Drops the coordinate along which the polygon is thinnest, keeping its orientation positive.
void project(std::span<const dvec3> corners, dvec3 normal, std::vector<dvec2>& points) {
    double dvec3::*drop = &dvec3::z;
    double dvec3::*u = &dvec3::x;
    double dvec3::*v = &dvec3::y;
    if (std::abs(normal.x) > std::abs(normal.y) && std::abs(normal.x) > std::abs(normal.z))
        drop = &dvec3::x, u = &dvec3::y, v = &dvec3::z;
    else if (std::abs(normal.y) > std::abs(normal.z))
        drop = &dvec3::y, u = &dvec3::z, v = &dvec3::x;
    if (normal.*drop < 0) std::swap(u, v);
    points.resize(corners.size());
    for (size_t i = 0; i < corners.size(); ++i) points[i] = {corners[i].*u, corners[i].*v};
}

bool is_convex_fan(std::span<const dvec2> p) {
    dvec2 a = p[p.size() - 2], b = p[p.size() - 1];
    for (dvec2 c : p) {
        if (!(cross(a, b, c) >= 0)) return false;
        a = b, b = c;
    }
    for (size_t i = 2; i < p.size(); ++i)
        if (!(cross(p[0], p[i - 1], p[i]) > 0)) return false;
    return true;
}

void add_triangle(std::vector<uint32_t>& triangles, uint32_t a, uint32_t b, uint32_t c) {
    for (uint32_t corner : {a, b, c}) triangles.push_back(corner);
}

void fan(uint32_t count, std::vector<uint32_t>& triangles) {
    for (uint32_t i = 2; i < count; ++i) add_triangle(triangles, 0, i - 1, i);
}

// Corners of other loops that stand on a loop's edges become corners of that loop, too.
void share_corners(std::span<const dvec2> points, std::vector<std::vector<uint32_t>>& loops) {
    constexpr uint64_t kMost = 10'000'000;  // pairs of an edge and a corner
    uint64_t corners = points.size();
    if (corners * corners > kMost) return;
    std::vector<std::pair<double, uint32_t>> on_edge;
    for (std::vector<uint32_t>& loop : loops) {
        std::vector<uint32_t> shared;
        for (size_t i = 0; i < loop.size(); ++i) {
            dvec2 a = points[loop[i]], b = points[loop[i + 1 < loop.size() ? i + 1 : 0]];
            on_edge.clear();
            for (const std::vector<uint32_t>& other : loops)
                for (uint32_t corner : other) {
                    dvec2 p = points[corner];
                    double along = glm::dot(p - a, b - a);
                    if (&other == &loop || cross(a, b, p) != 0 || along <= 0) continue;
                    if (along < glm::dot(b - a, b - a)) on_edge.emplace_back(along, corner);
                }
            std::sort(on_edge.begin(), on_edge.end());
            shared.push_back(loop[i]);
            for (auto [along, corner] : on_edge)
                if (!same(points[corner], points[shared.back()])) shared.push_back(corner);
        }
        loop = std::move(shared);
    }
}

double signed_area(std::span<const dvec2> points, std::span<const uint32_t> loop) {
    double area = 0;
    for (size_t i = 1; i + 1 < loop.size(); ++i)
        area += cross(points[loop[0]], points[loop[i]], points[loop[i + 1]]);
    return area;
}

}  // namespace

Triangulation triangulate(std::span<const dvec3> corners, std::span<const uint32_t> loops,
                          std::vector<uint32_t>& triangles) {
    Triangulation result;
    uint32_t outline = loops[0];
    if (outline < 3) return result;
    if (outline == 3 && loops.size() == 1) {
        add_triangle(triangles, 0, 1, 2);
        return result;
    }
    dvec3 normal = area_vector(corners.first(outline));
    bool flat = normal.x == 0 && normal.y == 0 && normal.z == 0;
    thread_local std::vector<dvec2> points;  // of one polygon after the other
    project(corners, normal, points);
    if (flat || (loops.size() == 1 && is_convex_fan(points))) {
        fan(outline, triangles);
        return result;
    }
    std::vector<std::vector<uint32_t>> holes(1);  // with the outline as the first
    holes[0].resize(outline);
    std::iota(holes[0].begin(), holes[0].end(), 0u);
    uint32_t first = outline;
    for (size_t l = 1; l < loops.size(); first += loops[l], ++l) {
        if (loops[l] < 3) continue;
        std::vector<uint32_t> hole(loops[l]);
        std::iota(hole.begin(), hole.end(), first);
        if (signed_area(points, hole) > 0) std::reverse(hole.begin(), hole.end());
        holes.push_back(std::move(hole));
    }
    if (holes.size() > 1) share_corners(points, holes);
    EarClipper clipper(points, triangles);
    clipper.set_outline(std::move(holes[0]));
    holes.erase(holes.begin());
    // Rightmost holes first, so that later bridges may end on them.
    auto right_end = [&](const std::vector<uint32_t>& hole) {
        double x = -INFINITY;
        for (uint32_t c : hole) x = std::max(x, points[c].x);
        return x;
    };
    std::stable_sort(holes.begin(), holes.end(),
                     [&](const auto& a, const auto& b) { return right_end(a) > right_end(b); });
    bool touching = false;
    for (const auto& hole : holes) {
        bool touches = clipper.join_touching(hole);
        touching |= touches;
        if (!touches && !clipper.bridge(hole)) ++result.lost_holes;
    }
    if (touching) clipper.take_apart();
    result.self_intersecting = !clipper.clip();
    return result;
}

}  // namespace kinora
