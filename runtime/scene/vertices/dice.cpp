// runtime/scene/vertices/dice.cpp: recursive splitting of triangles at edge midpoints.
#include "runtime/scene/vertices/dice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace kinora {

namespace {

constexpr uint32_t kNotUsed = ~0u;

DicePoint midpoint(DicePoint a, DicePoint b) {
    return {(a.i + b.i) / 2, (a.j + b.j) / 2};
}
bool has_midpoint(DicePoint a, DicePoint b) {
    return ((a.i + b.i) & 1) == 0 && ((a.j + b.j) & 1) == 0;
}

// Whether a ball lies beside, above or behind the picture, by a seventh of its half size.
bool out_of_view(const raytrace::Camera& camera, dvec3 from_eye, double radius) {
    constexpr double kMargin = 1.15;
    double x = glm::dot(from_eye, camera.right), y = glm::dot(from_eye, camera.up);
    double z = glm::dot(from_eye, camera.forward);
    double reach = camera.orthographic ? 1.0 : z + radius;
    if (z + radius < 0) return true;
    x -= camera.middle.x * reach, y -= camera.middle.y * reach;
    return std::abs(x) - radius > kMargin * camera.half_width * reach ||
           std::abs(y) - radius > kMargin * camera.half_height * reach;
}

}  // namespace

// What one call works on.
struct TriangleDicer::Job {
    const DiceMetric& metric;
    EdgeRule longer;
    double part;  // cut(): what is not longer than so many times is a part; dice(): 0
    size_t limit;
    DicedTriangle& out;

    bool over_limit() const { return out.triangles.size() / 3 > limit; }
    double square(DicePoint a, DicePoint b) const {
        double i = double(a.i) - double(b.i), j = double(a.j) - double(b.j);
        return i * i * metric.e11 + 2 * i * j * metric.e12 + j * j * metric.e22;
    }
};

bool TriangleDicer::dice(const DiceMetric& metric, EdgeRule longer, const DiceCorners& whole,
                         size_t limit, DicedTriangle& out) {
    return run({metric, longer, 0, limit, out}, whole);
}

bool TriangleDicer::cut(const DiceMetric& metric, EdgeRule longer, double times, size_t limit,
                        DicedTriangle& parts) {
    return run({metric, longer, times, limit, parts}, kWholeTriangle);
}

bool TriangleDicer::run(const Job& job, const DiceCorners& whole) {
    points_.clear();
    edges_.clear();
    job.out.points.clear();
    job.out.triangles.clear();
    Corners p;
    Edges e;
    for (size_t k = 0; k < 3; ++k) p[k] = add_point(whole[k]);
    for (size_t k = 0; k < 3; ++k) e[k] = add_edge(p[k], p[(k + 1) % 3]);
    split(job, p, e);
    return !job.over_limit();
}

uint32_t TriangleDicer::add_point(DicePoint at) {
    points_.push_back({at, kNotUsed});
    return uint32_t(points_.size() - 1);
}

uint32_t TriangleDicer::add_edge(uint32_t from, uint32_t to) {
    edges_.push_back({from, to, kNotUsed, 0, Edge::NotLookedAt});
    return uint32_t(edges_.size() - 1);
}

bool TriangleDicer::splits(const Job& job, Edge& edge) const {
    if (edge.state == Edge::NotLookedAt) {
        DicePoint a = points_[edge.from].at, b = points_[edge.to].at;
        bool split = has_midpoint(a, b) && job.longer(a, b, 1);
        edge.state = split ? Edge::Splits : Edge::Stays;
    }
    return edge.state == Edge::Splits;
}

bool TriangleDicer::is_part(const Job& job, const Edges& e) const {
    return job.part > 0 && std::ranges::none_of(e, [&](uint32_t k) {
               return job.longer(points_[edges_[k].from].at, points_[edges_[k].to].at, job.part);
           });
}

uint32_t TriangleDicer::middle(uint32_t edge) {
    const auto [from, to, known, halves, state] = edges_[edge];
    if (known != kNotUsed) return known;
    uint32_t made = add_point(midpoint(points_[from].at, points_[to].at));
    uint32_t first = add_edge(from, made);
    add_edge(made, to);
    edges_[edge].middle = made;
    edges_[edge].halves = first;
    return made;
}

// The half of a split edge at one of its ends.
uint32_t TriangleDicer::half(uint32_t edge, uint32_t at) const {
    return edges_[edge].halves + (edges_[edge].from != at);
}

void TriangleDicer::split(const Job& job, const Corners& p, const Edges& e) {
    if (job.over_limit()) return;
    std::array<bool, 3> open;
    int count = 0;
    for (size_t k = 0; k < 3; ++k) count += open[k] = splits(job, edges_[e[k]]);
    if (count == 0 || is_part(job, e)) return emit(job, p);
    // Turned so that edge 0 is the only one split, or edge 2 the only one that stays.
    size_t first = 0;
    if (count < 3)
        while (count == 1 ? !open[first] : open[(first + 2) % 3]) ++first;
    auto turned = [first](size_t k) { return (first + k) % 3; };
    const uint32_t p0 = p[turned(0)], p1 = p[turned(1)], p2 = p[turned(2)];
    const uint32_t e0 = e[turned(0)], e1 = e[turned(1)], e2 = e[turned(2)];
    const uint32_t m = middle(e0);
    if (count == 1) {
        uint32_t across = add_edge(m, p2);
        split(job, {p0, m, p2}, {half(e0, p0), across, e2});
        split(job, {m, p1, p2}, {half(e0, p1), e1, across});
        return;
    }
    const uint32_t n = middle(e1), across = add_edge(m, n);
    if (count == 3) {
        const uint32_t o = middle(e2), no = add_edge(n, o), om = add_edge(o, m);
        split(job, {p0, m, o}, {half(e0, p0), om, half(e2, p0)});
        split(job, {m, p1, n}, {half(e0, p1), half(e1, p1), across});
        split(job, {o, n, p2}, {no, half(e1, p2), half(e2, p2)});
        split(job, {m, n, o}, {across, no, om});
        return;
    }
    // A corner triangle and a quadrilateral, cut along its shorter diagonal.
    split(job, {m, p1, n}, {half(e0, p1), half(e1, p1), across});
    if (job.square(points_[p0].at, points_[n].at) <= job.square(points_[m].at, points_[p2].at)) {
        uint32_t diagonal = add_edge(p0, n);
        split(job, {p0, m, n}, {half(e0, p0), across, diagonal});
        split(job, {p0, n, p2}, {diagonal, half(e1, p2), e2});
    } else {
        uint32_t diagonal = add_edge(m, p2);
        split(job, {p0, m, p2}, {half(e0, p0), diagonal, e2});
        split(job, {m, n, p2}, {across, half(e1, p2), diagonal});
    }
}

void TriangleDicer::emit(const Job& job, const Corners& p) {
    for (uint32_t k : p) {
        Point& point = points_[k];
        if (point.number == kNotUsed) {
            point.number = uint32_t(job.out.points.size());
            job.out.points.push_back(point.at);
        }
        job.out.triangles.push_back(point.number);
    }
}

bool dice_triangle(const DiceMetric& metric, FunctionRef<bool(DicePoint, DicePoint)> too_long,
                   size_t limit, DicedTriangle& out) {
    TriangleDicer dicer;
    auto longer = [&](DicePoint a, DicePoint b, double) { return too_long(a, b); };
    return dicer.dice(metric, longer, kWholeTriangle, limit, out);
}

double edge_pixels(const raytrace::Camera& camera, dvec3 a, dvec3 b) {
    // From the middle, so that exchanging a and b changes no bit.
    dvec3 middle = 0.5 * (a + b) - camera.eye, half = 0.5 * (b - a);
    double square = glm::dot(half, half), radius = std::sqrt(square);
    if (!(radius > 0)) return 0;
    double pixels = 2 * radius * 0.5 * camera.width / camera.half_width;
    if (!camera.orthographic) {
        double t = std::clamp(-glm::dot(middle, half) / square, -1.0, 1.0);
        pixels /= std::max(glm::length(middle + t * half), camera.znear);
    }
    return out_of_view(camera, middle, radius) ? 0.25 * pixels : pixels;
}

}  // namespace kinora
