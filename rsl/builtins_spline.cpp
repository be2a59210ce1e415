// rsl/builtins_spline.cpp: how spline() is lowered: cubic curves through or near knots.
#include <array>
#include <string_view>

#include "rsl/lower_p.h"

namespace kinora::rsl {

namespace {

// p(t) = (t^3 t^2 t 1) * m * four knots; the next piece begins `step` knots on (RI 3.2, bases).
struct Basis {
    std::string_view name;
    int step;
    float m[4][4];
};
constexpr float kSixth = 1.0f / 6;
const Basis kBases[] = {
    {"catmull-rom",
     1,
     {{-0.5f, 1.5f, -1.5f, 0.5f}, {1, -2.5f, 2, -0.5f}, {-0.5f, 0, 0.5f, 0}, {0, 1, 0, 0}}},
    {"bezier", 3, {{-1, 3, -3, 1}, {3, -6, 3, 0}, {-3, 3, 0, 0}, {1, 0, 0, 0}}},
    {"bspline",
     1,
     {{-kSixth, 0.5f, -0.5f, kSixth},
      {0.5f, -1, 0.5f, 0},
      {-0.5f, 0, 0.5f, 0},
      {kSixth, 4 * kSixth, kSixth, 0}}},
    {"b-spline",
     1,
     {{-kSixth, 0.5f, -0.5f, kSixth},
      {0.5f, -1, 0.5f, 0},
      {-0.5f, 0, 0.5f, 0},
      {kSixth, 4 * kSixth, kSixth, 0}}},
    {"hermite", 2, {{2, 1, -2, 1}, {-3, -2, 3, -1}, {0, 1, 0, 0}, {1, 0, 0, 0}}},
    {"linear", 1, {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, -1, 1, 0}, {0, 1, 0, 0}}},
};

const Basis* find_basis(LowerCall& c, bool named) {
    if (!named) return &kBases[0];
    const std::string* name = c.text(0);
    if (!name) return nullptr;
    for (const Basis& basis : kBases)
        if (basis.name == *name) return &basis;
    c.low.error(Code::RSL_SPLINE_BASIS, c.call.args[0]->place.where, *name);
    return nullptr;
}

// The knot that piece `piece` begins `offset` knots from, chosen by comparisons.
Lowered knot_of(LowerCall& c, const std::vector<Lowered>& knots, const Basis& basis, Value piece,
                int pieces, int offset) {
    Lowered r = knots[size_t(offset)];
    for (int k = 1; k < pieces; ++k) {
        const Lowered& other = knots[size_t(k * basis.step + offset)];
        Value later = c.b.le(c.b.f(float(k)), piece);
        for (size_t j = 0; j < size_t(r.size()); ++j)
            r.c[j] = c.b.select(later, other.c[j], r.c[j]);
    }
    return r;
}

}  // namespace

namespace lower_math {

// spline([basis,] x, knots...) or with an array of knots; x is clamped to 0..1, NaN counts as 0.
void spline(LowerCall& c) {
    bool named = c.args[0].type == BaseType::String;
    const Basis* basis = find_basis(c, named);
    if (!basis) return;
    size_t first = named ? 2 : 1;
    std::vector<Lowered> knots(c.args.begin() + long(first), c.args.end());
    if (c.call.args[first]->type.is_array()) knots = c.low.array_values(*c.call.args[first]);
    int count = int(knots.size());
    if (count < 4 || (count - 4) % basis->step != 0)
        return c.low.error(Code::RSL_SPLINE_KNOTS, c.where(), basis->name, count);

    auto& b = c.b;
    int pieces = (count - 4) / basis->step + 1;
    Value x = c.low.clamp(c.args[first - 1].c[0], b.f(0), b.f(1));
    Value scaled = b.mul(x, b.f(float(pieces)));
    Value piece = b.min(b.floor(scaled), b.f(float(pieces - 1)));
    Value t = b.sub(scaled, piece);
    std::array<Lowered, 4> knot;
    for (int k = 0; k < 4; ++k) knot[size_t(k)] = knot_of(c, knots, *basis, piece, pieces, k);
    // Weights first: at t = 0 and 1 they are exact, so the curve meets its knots exactly.
    std::array<Value, 4> weight;
    for (size_t k = 0; k < 4; ++k) {
        weight[k] = b.f(basis->m[0][k]);
        for (size_t r = 1; r < 4; ++r) weight[k] = c.low.fma(weight[k], t, b.f(basis->m[r][k]));
    }
    for (size_t j = 0; j < size_t(c.result.size()); ++j) {
        Value sum = b.f(0);
        for (size_t k = 4; k-- > 0;) sum = c.low.fma(weight[k], knot[k].c[j], sum);
        c.result.c[j] = sum;
    }
}

}  // namespace lower_math

}  // namespace kinora::rsl
