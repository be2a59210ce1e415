// rsl/reference/spline.cpp: spline() at one point.
#include "rsl/reference/reference_p.h"

namespace kinora::rsl::ref {

namespace {

// RenderMan Interface 3.2, section 15: value = (t^3 t^2 t 1) M (k0 k1 k2 k3); the knots advance by
// `step` from one segment to the next.
struct Basis {
    const char* name;
    int step;
    double m[4][4];
};
const Basis kBases[] = {
    {"catmull-rom",
     1,
     {{-0.5, 1.5, -1.5, 0.5}, {1, -2.5, 2, -0.5}, {-0.5, 0, 0.5, 0}, {0, 1, 0, 0}}},
    {"bezier", 3, {{-1, 3, -3, 1}, {3, -6, 3, 0}, {-3, 3, 0, 0}, {1, 0, 0, 0}}},
    {"bspline",
     1,
     {{-1 / 6., 0.5, -0.5, 1 / 6.},
      {0.5, -1, 0.5, 0},
      {-0.5, 0, 0.5, 0},
      {1 / 6., 2 / 3., 1 / 6., 0}}},
    {"hermite", 2, {{2, 1, -2, 1}, {-3, -2, 3, -1}, {0, 1, 0, 0}, {1, 0, 0, 0}}},
    {"linear", 1, {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, -1, 1, 0}, {0, 1, 0, 0}}},
    {"constant", 1, {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 1, 0, 0}}},
};

const Basis& basis_of(std::string_view name) {
    if (name == "b-spline") name = "bspline";
    for (const Basis& basis : kBases)
        if (name == basis.name) return basis;
    return kBases[0];
}

template <class Real>
RefValue<Real> point_at(RefCall<Real>& c, const Basis& basis,
                        const std::vector<RefValue<Real>>& knots, const Dual<Real>& x) {
    using Number = Dual<Real>;
    int segments = (int(knots.size()) - 4) / basis.step + 1;
    // Row 65: clamped to the ends, NaN to the first.
    Number t = x.x >= 0 ? (x.x >= 1 ? Number(1) : x) : Number(0);
    t = Number(Real(segments)) * t;
    int segment = std::min(int(c.eval.decide(std::floor(t.x))), segments - 1);
    t = t - Number(Real(segment));
    Number powers[4] = {t * t * t, t * t, t, Number(1)};
    RefValue<Real> result(knots[0].type);
    for (size_t k = 0; k < result.size(); ++k) {
        Number sum;
        for (size_t j = 0; j < 4; ++j) {
            Number weight;
            for (size_t i = 0; i < 4; ++i) weight = weight + Real(basis.m[i][j]) * powers[i];
            sum = sum + weight * knots[size_t(segment * basis.step) + j].c[k];
        }
        result.c[k] = sum;
    }
    return result;
}

}  // namespace

template <class Real>
void spline(RefCall<Real>& c) {
    using Number = Dual<Real>;
    bool named = c.args[0].type == BaseType::String;
    std::string name = named ? c.text(0) : "catmull-rom";
    bool solve = name.rfind("solve", 0) == 0;
    const Basis& basis = basis_of(solve ? name.substr(5) : name);
    size_t first = named ? 2 : 1;
    Number x = c.f(first - 1);
    std::vector<RefValue<Real>> knots(c.args.begin() + long(first), c.args.end());
    if (!c.arrays[first].empty()) knots = c.arrays[first];
    if (!solve) {
        RefValue<Real> value = point_at(c, basis, knots, x);
        for (size_t k = 0; k < c.result.size(); ++k) c.result.c[k] = value.c[k];
        return;
    }
    Real low = 0, high = 1, at_low = point_at(c, basis, knots, Number(low)).c[0].x;
    bool falls = point_at(c, basis, knots, Number(high)).c[0].x < at_low;
    for (int k = 0; k < 60; ++k) {
        Real middle = (low + high) / 2, value = point_at(c, basis, knots, Number(middle)).c[0].x;
        bool below = falls ? x.x < value : value < x.x;
        (below ? low : high) = middle;
    }
    c.set(Number(high));
    if (falls ? at_low <= x.x : x.x <= at_low) c.set(Number(0));
}
KINORA_RSL_DEFINE_REF(spline)

}  // namespace kinora::rsl::ref
