// runtime/scene/tessellate/limit.cpp: where points of a cage end, and the normals there.
//
// Halstead, Kass, DeRose: Efficient, fair interpolation using Catmull-Clark surfaces (SIGGRAPH
// 1993), appendix A: limits and tangents inside. Biermann, Levin, Zorin: Piecewise smooth
// subdivision surfaces with normal control (SIGGRAPH 2000): tangents on boundaries.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/scene/tessellate/cage_p.h"

namespace kinora::tessellation {

namespace {

struct Corner {
    uint32_t quad, corner;
};

// The corners of quads at each point.
struct CornerLists {
    std::vector<uint32_t> first;
    std::vector<Corner> corners;

    explicit CornerLists(const Cage& cage) : first(cage.points() + 1, 0) {
        for (const auto& quad : cage.quads)
            for (uint32_t p : quad) ++first[p + 1];
        for (size_t p = 1; p < first.size(); ++p) first[p] += first[p - 1];
        corners.resize(4 * cage.quads.size());
        std::vector<uint32_t> next(first.begin(), first.end() - 1);
        for (uint32_t q = 0; q < cage.quads.size(); ++q)
            for (uint32_t k = 0; k < 4; ++k) corners[next[cage.quads[q][k]]++] = {q, k};
    }
};

dvec3 unit_or_nothing(dvec3 v) {
    const double length = glm::length(v);
    return length > 0 && std::isfinite(length) ? v / length : dvec3(0.0);
}

// What is around a point, counter-clockwise: neighbours along edges, and across quads. On a
// boundary there is one edge more than quads.
struct Ring {
    std::vector<uint32_t> edges, across;
    bool closed = false;
};

// One quad at a point: the points after it, opposite and before.
struct Wedge {
    uint32_t next, across, before;
};

class RingFinder {
  public:
    // False where the quads do not form one fan, or not all face the same side.
    bool find(const Cage& cage, const Corner* corners, size_t count, Ring& ring) {
        wedges_.clear();
        for (size_t k = 0; k < count; ++k) {
            const auto& quad = cage.quads[corners[k].quad];
            const uint32_t c = corners[k].corner;
            wedges_.push_back({quad[(c + 1) & 3], quad[(c + 2) & 3], quad[(c + 3) & 3]});
        }
        std::sort(wedges_.begin(), wedges_.end(),
                  [](const Wedge& a, const Wedge& b) { return a.next < b.next; });
        before_.clear();
        for (const Wedge& w : wedges_) before_.push_back(w.before);
        std::sort(before_.begin(), before_.end());
        const Wedge* wedge = &wedges_[0];
        for (const Wedge& w : wedges_)
            if (!std::binary_search(before_.begin(), before_.end(), w.next)) wedge = &w;
        ring.edges = {wedge->next};
        ring.across.clear();
        while (true) {
            ring.across.push_back(wedge->across);
            const uint32_t end = wedge->before;
            ring.closed = end == ring.edges[0];
            if (!ring.closed) ring.edges.push_back(end);
            if (ring.across.size() == count) return true;
            if (ring.closed) return false;
            auto at = std::lower_bound(wedges_.begin(), wedges_.end(), end,
                                       [](const Wedge& w, uint32_t p) { return w.next < p; });
            if (at == wedges_.end() || at->next != end) return false;
            wedge = &*at;
        }
    }

  private:
    std::vector<Wedge> wedges_;
    std::vector<uint32_t> before_;
};

dvec3 inner_side(const Cage& cage, const Ring& ring) {
    const size_t n = ring.across.size();
    const double turn = 2 * kPi / double(n), c = std::cos(turn);
    const double weight = 1 + c + std::cos(turn / 2) * std::sqrt(2 * (9 + c));
    dvec3 along(0.0), up(0.0);
    for (size_t k = 0; k < n; ++k) {
        const dvec3 edge = cage.place(ring.edges[k]), across = cage.place(ring.across[k]);
        const double a = turn * double(k), b = turn * double(k + 1);
        along += weight * std::cos(a) * edge + (std::cos(a) + std::cos(b)) * across;
        up += weight * std::sin(a) * edge + (std::sin(a) + std::sin(b)) * across;
    }
    return glm::cross(along, up);
}

dvec3 boundary_side(const Cage& cage, uint32_t point, const Ring& ring) {
    const size_t n = ring.across.size();
    const dvec3 begin = cage.place(ring.edges.front()), end = cage.place(ring.edges.back());
    dvec3 inwards = begin + end - 2.0 * cage.place(point);
    if (n > 1) {
        const double angle = kPi / double(n), c = std::cos(angle), s = std::sin(angle);
        const double ratio = (1 + c) / s;
        inwards = 4 * ratio * (c - 1) * cage.place(point) - ratio * (1 + 2 * c) * (begin + end);
        for (size_t k = 0; k < n; ++k) {
            const double a = std::sin(angle * double(k)), b = std::sin(angle * double(k + 1));
            inwards += 4 * a * cage.place(ring.edges[k]) + (a + b) * cage.place(ring.across[k]);
        }
    }
    return glm::cross(begin - end, inwards);
}

// Where tangents are not known: of the quads' corners.
dvec3 mean_side(const Cage& cage, uint32_t point, const Corner* corners, size_t count) {
    const dvec3 p = cage.place(point);
    dvec3 sum(0.0);
    for (size_t k = 0; k < count; ++k) {
        const auto& quad = cage.quads[corners[k].quad];
        const uint32_t c = corners[k].corner;
        sum += glm::cross(cage.place(quad[(c + 1) & 3]) - p, cage.place(quad[(c + 3) & 3]) - p);
    }
    return sum;
}

std::vector<dvec3> limit_normals(const Cage& cage, const std::vector<uint32_t>& sharp) {
    const CornerLists lists(cage);
    std::vector<dvec3> normals(cage.points(), dvec3(0.0));
    RingFinder finder;
    Ring ring;
    for (uint32_t p = 0; p < cage.points(); ++p) {
        const Corner* corners = lists.corners.data() + lists.first[p];
        const size_t count = lists.first[p + 1] - lists.first[p];
        if (count == 0) continue;
        dvec3 side(0.0);
        if (!cage.fixed[p] && finder.find(cage, corners, count, ring)) {
            if (ring.closed && sharp[p] == 0 && count > 2) side = inner_side(cage, ring);
            if (!ring.closed && sharp[p] == 2) side = boundary_side(cage, p, ring);
        }
        normals[p] = unit_or_nothing(side);
        if (normals[p] == dvec3(0.0))
            normals[p] = unit_or_nothing(mean_side(cage, p, corners, count));
    }
    return normals;
}

void add_weighted(std::vector<double>& to, size_t point, double weight, const Cage& cage,
                  size_t from) {
    for (uint32_t c = 0; c < cage.stride; ++c)
        to[point * cage.stride + c] += weight * cage.values[from * cage.stride + c];
}

}  // namespace

CageLimit limit_of(const Cage& cage, bool with_normals) {
    const size_t points = cage.points();
    std::vector<uint32_t> valence(points, 0), sharp(points, 0);
    for (const CageEdge& edge : cage.edges)
        for (uint32_t end : {edge.from, edge.to}) {
            ++valence[end];
            sharp[end] += !edge.smooth();
        }
    auto on_curve = [&](size_t p) { return sharp[p] == 2 && !cage.fixed[p]; };
    // Inside: (n^2 S + 4 sum of neighbours + sum of those across) / (n (n + 5)). On a boundary:
    // (1 4 1) / 6.
    auto part = [&](size_t p) { return 1 / (double(valence[p]) * (valence[p] + 5)); };
    CageLimit result;
    result.values.assign(cage.values.size(), 0.0);
    for (size_t p = 0; p < points; ++p) {
        const bool inner = sharp[p] == 0 && valence[p] > 0;
        const double own = inner ? valence[p] / (valence[p] + 5.0) : on_curve(p) ? 4 / 6.0 : 1;
        add_weighted(result.values, p, own, cage, p);
    }
    for (const CageEdge& edge : cage.edges)
        for (auto [end, other] : {std::pair(edge.from, edge.to), std::pair(edge.to, edge.from)}) {
            if (sharp[end] == 0)
                add_weighted(result.values, end, 4 * part(end), cage, other);
            else if (on_curve(end) && !edge.smooth())
                add_weighted(result.values, end, 1 / 6.0, cage, other);
        }
    for (const auto& quad : cage.quads)
        for (uint32_t k = 0; k < 4; ++k)
            if (sharp[quad[k]] == 0)
                add_weighted(result.values, quad[k], part(quad[k]), cage, quad[(k + 2) & 3]);
    if (with_normals) result.normals = limit_normals(cage, sharp);
    return result;
}

}  // namespace kinora::tessellation
