// runtime/vertices/dice.cpp: recursive splitting of triangles at edge midpoints.
#include "runtime/vertices/dice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/description/pair_numbers.h"

namespace kinora {

namespace {

DicePoint midpoint(DicePoint a, DicePoint b) {
    return {(a.i + b.i) / 2, (a.j + b.j) / 2};
}
bool has_midpoint(DicePoint a, DicePoint b) {
    return ((a.i + b.i) & 1) == 0 && ((a.j + b.j) & 1) == 0;
}

class Splitter {
  public:
    Splitter(const DiceMetric& metric, FunctionRef<bool(DicePoint, DicePoint)> too_long,
             size_t limit, DicedTriangle& out)
        : metric_(metric), too_long_(too_long), limit_(limit), out_(out) {}

    bool run() {
        const std::array<DicePoint, 3> corners = {DicePoint{0, 0}, DicePoint{kDiceOne, 0},
                                                  DicePoint{0, kDiceOne}};
        for (DicePoint p : corners) number(p);
        split(corners, {true, true, true});
        return out_.triangles.size() / 3 <= limit_;
    }

  private:
    using Corners = std::array<DicePoint, 3>;
    using Open = std::array<bool, 3>;  // edge k, from corner k to the next, is not known to stay

    void split(const Corners& p, Open open) {
        if (out_.triangles.size() / 3 > limit_) return;
        int count = 0;
        for (int k = 0; k < 3; ++k) {
            DicePoint a = p[size_t(k)], b = p[size_t((k + 1) % 3)];
            bool& o = open[size_t(k)];
            o = o && has_midpoint(a, b) && too_long_(a, b);
            count += o;
        }
        if (count == 0) return emit(p);
        if (count == 3) return split_three(p);
        // Turned so that edge 0 is the only one split, or edge 2 the only one that stays.
        size_t first = 0;
        while (count == 1 ? !open[first] : open[(first + 2) % 3]) ++first;
        Corners q = {p[first], p[(first + 1) % 3], p[(first + 2) % 3]};
        count == 1 ? split_one(q) : split_two(q);
    }

    void split_one(const Corners& p) {
        DicePoint m = midpoint(p[0], p[1]);
        split({p[0], m, p[2]}, {true, true, false});
        split({m, p[1], p[2]}, {true, false, true});
    }

    // Edges 0 and 1: a corner triangle and a quadrilateral, cut along its shorter diagonal.
    void split_two(const Corners& p) {
        DicePoint m = midpoint(p[0], p[1]), n = midpoint(p[1], p[2]);
        split({m, p[1], n}, {true, true, true});
        if (square(p[0], n) <= square(m, p[2])) {
            split({p[0], m, n}, {true, true, true});
            split({p[0], n, p[2]}, {true, true, false});
        } else {
            split({p[0], m, p[2]}, {true, true, false});
            split({m, n, p[2]}, {true, true, true});
        }
    }

    void split_three(const Corners& p) {
        DicePoint m = midpoint(p[0], p[1]), n = midpoint(p[1], p[2]), o = midpoint(p[2], p[0]);
        constexpr Open kAll = {true, true, true};
        split({p[0], m, o}, kAll);
        split({m, p[1], n}, kAll);
        split({o, n, p[2]}, kAll);
        split({m, n, o}, kAll);
    }

    double square(DicePoint a, DicePoint b) const {
        double i = double(a.i) - double(b.i), j = double(a.j) - double(b.j);
        return i * i * metric_.e11 + 2 * i * j * metric_.e12 + j * j * metric_.e22;
    }

    uint32_t number(DicePoint p) {
        uint32_t next = uint32_t(out_.points.size());
        uint32_t n = numbers_.number(p.i, p.j, next);
        if (n == next) out_.points.push_back(p);
        return n;
    }
    void emit(const Corners& p) {
        for (DicePoint point : p) out_.triangles.push_back(number(point));
    }

    DiceMetric metric_;
    FunctionRef<bool(DicePoint, DicePoint)> too_long_;
    size_t limit_;
    DicedTriangle& out_;
    PairNumbers numbers_;
};

// Whether a ball lies beside, above or behind the picture, by a seventh of its half size.
bool out_of_view(const raytrace::Camera& camera, dvec3 from_eye, double radius) {
    constexpr double kMargin = 1.15;
    double x = glm::dot(from_eye, camera.right), y = glm::dot(from_eye, camera.up);
    double z = glm::dot(from_eye, camera.forward);
    double reach = camera.orthographic ? 1.0 : z + radius;
    if (z + radius < 0) return true;
    return std::abs(x) - radius > kMargin * camera.half_width * reach ||
           std::abs(y) - radius > kMargin * camera.half_height * reach;
}

}  // namespace

bool dice_triangle(const DiceMetric& metric, FunctionRef<bool(DicePoint, DicePoint)> too_long,
                   size_t limit, DicedTriangle& out) {
    out.points.clear();
    out.triangles.clear();
    return Splitter(metric, too_long, limit, out).run();
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
