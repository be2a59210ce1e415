// rsl/reference_spline.cpp: spline() at one point.
#include "rsl/reference_p.h"

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
    {"b-spline",
     1,
     {{-1 / 6., 0.5, -0.5, 1 / 6.},
      {0.5, -1, 0.5, 0},
      {-0.5, 0, 0.5, 0},
      {1 / 6., 2 / 3., 1 / 6., 0}}},
    {"hermite", 2, {{2, 1, -2, 1}, {-3, -2, 3, -1}, {0, 1, 0, 0}, {1, 0, 0, 0}}},
    {"linear", 1, {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, -1, 1, 0}, {0, 1, 0, 0}}},
};

const Basis& basis_of(std::string_view name) {
    for (const Basis& basis : kBases)
        if (name == basis.name) return basis;
    return kBases[0];
}

}  // namespace

template <class Real>
void spline(RefCall<Real>& c) {
    using Number = Dual<Real>;
    bool named = c.args[0].type == BaseType::String;
    const Basis& basis = named ? basis_of(c.text(0)) : kBases[0];
    size_t first = named ? 2 : 1;
    Number x = c.f(first - 1);
    std::vector<RefValue<Real>> knots(c.args.begin() + long(first), c.args.end());
    if (!c.arrays[first].empty()) knots = c.arrays[first];
    int segments = (int(knots.size()) - 4) / basis.step + 1;
    // Row 65: clamped to the ends, NaN to the first.
    Number t = x.x >= 0 ? (x.x >= 1 ? Number(1) : x) : Number(0);
    t = Number(Real(segments)) * t;
    int segment = std::min(int(c.eval.decide(std::floor(t.x))), segments - 1);
    t = t - Number(Real(segment));
    Number powers[4] = {t * t * t, t * t, t, Number(1)};
    for (size_t k = 0; k < c.result.size(); ++k) {
        Number sum;
        for (size_t j = 0; j < 4; ++j) {
            Number weight;
            for (size_t i = 0; i < 4; ++i) weight = weight + Real(basis.m[i][j]) * powers[i];
            sum = sum + weight * knots[size_t(segment * basis.step) + j].c[k];
        }
        c.result.c[k] = sum;
    }
}
KINORA_RSL_DEFINE_REF(spline)

}  // namespace kinora::rsl::ref
