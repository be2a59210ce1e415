// runtime/scene/ri/state/trim_curves.cpp: rational B-spline curves by de Boor's algorithm.
#include "runtime/scene/ri/state/trim_curves.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace kinora::ri {
namespace {

struct Curve {
    int order;
    std::span<const float> knots, u, v, w;
    double low, high;
};

dvec3 control_point(const Curve& curve, int i) {
    size_t at = size_t(i);
    return {double(curve.u[at]), double(curve.v[at]), double(curve.w[at])};
}

dvec2 place(const Curve& curve, double t) {
    const int degree = curve.order - 1, points = int(curve.u.size());
    int span = degree;
    while (span < points - 1 && t >= double(curve.knots[size_t(span) + 1])) ++span;
    std::vector<dvec3> d;
    for (int j = 0; j <= degree; ++j) d.push_back(control_point(curve, span - degree + j));
    for (int r = 1; r <= degree; ++r)
        for (int j = degree; j >= r; --j) {
            size_t k = size_t(j + span - degree);
            double a = double(curve.knots[k]), b = double(curve.knots[size_t(j + 1 + span - r)]);
            double part = b > a ? (t - a) / (b - a) : 0;
            d[size_t(j)] = (1 - part) * d[size_t(j) - 1] + part * d[size_t(j)];
        }
    const dvec3& p = d[size_t(degree)];
    return p.z != 0 ? dvec2(p.x / p.z, p.y / p.z) : dvec2(p.x, p.y);
}

void append(TrimLoop& loop, const Curve& curve) {
    constexpr int kStepsOfSpan = 24;
    const int spans = int(curve.u.size()) - curve.order + 1;
    const int steps = curve.order == 2 ? std::max(spans, 1) : std::min(spans, 2000) * kStepsOfSpan;
    for (int i = 0; i < steps; ++i) {
        dvec2 p = place(curve, curve.low + (curve.high - curve.low) * i / steps);
        if (std::isfinite(p.x) && std::isfinite(p.y)) loop.push_back(p);
    }
}

}  // namespace

std::vector<TrimLoop> trim_loops(const Call& call, std::string& why) {
    auto counts = call.arguments[0].integers(), orders = call.arguments[1].integers();
    auto knots = call.arguments[2].floats(), low = call.arguments[3].floats();
    auto high = call.arguments[4].floats();
    auto points = call.arguments[5].integers();
    auto u = call.arguments[6].floats(), v = call.arguments[7].floats(),
         w = call.arguments[8].floats();
    std::vector<TrimLoop> loops;
    size_t curve = 0, knot = 0, point = 0;
    for (int count : counts) {
        TrimLoop& loop = loops.emplace_back();
        for (int i = 0; i < count; ++i, ++curve) {
            bool there = curve < orders.size() && curve < points.size() && curve < low.size() &&
                         curve < high.size();
            int order = there ? orders[curve] : 0, n = there ? points[curve] : 0;
            size_t end = point + size_t(std::max(n, 0)),
                   knots_end = knot + size_t(std::max(n + order, 0));
            if (order < 2 || n < order || end > std::min({u.size(), v.size(), w.size()}) ||
                knots_end > knots.size()) {
                why = "a curve has fewer numbers than its order and its points need";
                return {};
            }
            append(loop, {order, knots.subspan(knot, size_t(n + order)),
                          u.subspan(point, size_t(n)), v.subspan(point, size_t(n)),
                          w.subspan(point, size_t(n)), double(low[curve]), double(high[curve])});
            knot = knots_end, point = end;
        }
    }
    std::erase_if(loops, [](const TrimLoop& loop) { return loop.size() < 3; });
    return loops;
}

}  // namespace kinora::ri
