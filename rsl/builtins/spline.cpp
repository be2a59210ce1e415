// rsl/builtins/spline.cpp: cubic curves through or near knots.
#include <fmt/format.h>

#include <array>
#include <string_view>
#include <vector>

#include "rsl/builtins/table.h"
#include "rsl/lower/builtin_call.h"
#include "rsl/reference/reference_p.h"
#include "rsl/text/literal_names.h"

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
    {"hermite", 2, {{2, 1, -2, 1}, {-3, -2, 3, -1}, {0, 1, 0, 0}, {1, 0, 0, 0}}},
    {"linear", 1, {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, -1, 1, 0}, {0, 1, 0, 0}}},
    {"constant", 1, {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 1, 0, 0}}},
};

// Other spellings.
struct Alias {
    std::string_view name, basis;
};
constexpr Alias kAliases[] = {{"b-spline", "bspline"},
                              {"catmullrom", "catmull-rom"},
                              {"catrom", "catmull-rom"},
                              {"cubic", "catmull-rom"},
                              {"", "catmull-rom"}};  // "solve" alone
constexpr std::string_view kSolve = "solve";

const Basis* basis_named(std::string_view name) {
    for (const Alias& alias : kAliases)
        if (alias.name == name) name = alias.basis;
    for (const Basis& basis : kBases)
        if (basis.name == name) return &basis;
    return nullptr;
}

// "solve" before a basis asks for x instead of the value.
bool cut_solve(std::string_view& name) {
    bool solve = name.starts_with(kSolve);
    if (solve) name.remove_prefix(kSolve.size());
    return solve;
}

// The basis of a call, and whether it asks for x instead of the value.
const Basis* find_basis(LowerCall& c, bool named, bool* solve) {
    if (!named) return &kBases[0];
    const std::string* text = c.text(0);
    if (!text) return nullptr;
    std::string_view name = *text;
    *solve = cut_solve(name);
    const Basis* basis = *solve || !name.empty() ? basis_named(name) : nullptr;
    if (!basis) c.context.error(Code::RSL_SPLINE_BASIS, c.call.args[0]->span.where, *text);
    return basis;
}

struct Curve {
    const Basis& basis;
    std::vector<Lowered> knots;
    int pieces;
    // Of a length that is known at run time: the knots in an array, and the pieces as a float.
    int array = -1;
    Value varying_pieces = jit::kNone, enough = jit::kNone;

    Value piece_count(jit::Builder& b) const {
        return array < 0 ? b.f(float(pieces)) : varying_pieces;
    }
};

// Component j of the knot that piece `piece` begins `offset` knots from: constants are looked up,
// others chosen by comparisons.
Value knot_of(LowerCall& c, const Curve& curve, Value piece, int offset, size_t j) {
    constexpr int kFewPieces = 3, kMostPieces = 16;
    if (curve.array >= 0) {
        Value at = c.b.add(c.b.mul(piece, c.b.f(float(curve.basis.step))), c.b.f(float(offset)));
        return c.variables.arrays().load(curve.array, c.b.ftoi(at)).c[j];
    }
    auto knot = [&](int k) { return curve.knots[size_t(k * curve.basis.step + offset)].c[j]; };
    std::vector<float> constants(size_t(curve.pieces));
    bool constant = curve.pieces >= kFewPieces && curve.pieces <= kMostPieces;
    for (int k = 0; k < curve.pieces; ++k)
        constant = constant && c.b.constant_f(knot(k), &constants[size_t(k)]);
    if (constant) return c.b.lookup(constants, c.b.ftoi(piece));
    Value r = knot(0);
    for (int k = 1; k < curve.pieces; ++k)
        r = c.b.select(c.b.le(c.b.f(float(k)), piece), knot(k), r);
    return r;
}

// The curve at x, clamped to 0..1; NaN counts as 0.
Lowered point_at(LowerCall& c, const Curve& curve, Value x) {
    auto& b = c.b;
    Value pieces = curve.piece_count(b);
    Value scaled = b.mul(c.e.clamp(x, b.f(0), b.f(1)), pieces);
    Value piece = b.min(b.floor(scaled), b.sub(pieces, b.f(1)));
    Value t = b.sub(scaled, piece);
    // Weights first: at t = 0 and 1 they are exact, so the curve meets its knots exactly.
    std::array<Value, 4> weight;
    for (size_t k = 0; k < 4; ++k) {
        weight[k] = b.f(curve.basis.m[0][k]);
        for (size_t r = 1; r < 4; ++r) weight[k] = c.e.fma(weight[k], t, b.f(curve.basis.m[r][k]));
    }
    Lowered result{
        curve.array < 0 ? curve.knots[0].type : c.variables.arrays().element(curve.array), {}};
    for (size_t j = 0; j < size_t(result.size()); ++j) {
        Value sum = b.f(0);
        for (size_t k = 4; k-- > 0;)
            sum = c.e.fma(weight[k], knot_of(c, curve, piece, int(k), j), sum);
        result.c[j] = sum;
    }
    return result;
}

// The x at which a curve that only rises, or only falls, has the value: by bisection. Values beyond
// its ends give 0 or 1.
constexpr int kHalvings = 24;  // the digits of a float in 0..1
Value solve(LowerCall& c, const Curve& curve, Value wanted) {
    auto& b = c.b;
    Value first = point_at(c, curve, b.f(0)).c[0], last = point_at(c, curve, b.f(1)).c[0];
    Value falls = b.lt(last, first);
    b.begin_loop(b.m(true), b.fault_site(c.where(), "a spline took too long to solve"));
    Value turn = b.loop_var(b.i(0)), low = b.loop_var(b.f(0)), high = b.loop_var(b.f(1));
    Value middle = b.mul(b.add(low, high), b.f(0.5f));
    Value here = point_at(c, curve, middle).c[0];
    Value below = b.select(falls, b.lt(wanted, here), b.lt(here, wanted));
    Value next[] = {b.iadd(turn, b.i(1)), b.select(below, middle, low),
                    b.select(below, high, middle)};
    b.end_loop(b.op(jit::Op::ILt, next[0], b.i(kHalvings)), next);
    Value x = b.loop_out(high);
    // Where the start is enough, x is 0 and no small number.
    Value at_start = b.select(falls, b.le(first, wanted), b.le(wanted, first));
    return b.select(at_start, b.f(0), x);
}

// The pieces of so many knots. Fewer than four give 0, and those behind the last piece are left
// out; both are a finding at run time.
void count_pieces(LowerCall& c, Value count, Curve& curve) {
    auto& b = c.b;
    Value step = b.f(float(curve.basis.step)), behind = b.sub(count, b.f(4));
    Value more = b.floor(b.div(behind, step));
    curve.enough = b.le(b.f(0), behind);
    curve.varying_pieces = b.max(b.add(more, b.f(1)), b.f(1));
    Value fits = b.logical_and(curve.enough, b.eq(b.mul(more, step), behind));
    b.fault(b.fault_site(c.where(), fmt::format("a number of knots that a {} spline does not take",
                                                curve.basis.name)),
            b.and_not(c.e.running, fits));
}

}  // namespace

namespace lower_spline {

// The knots of an array; false where it can never hold enough.
bool take_knots(LowerCall& c, size_t first, Curve& curve) {
    const Expr& knots = *c.call.args[first];
    int array = c.variables.array_of(*as<VariableExpr>(knots).symbol), count = 0;
    if (c.variables.arrays().known_count(array, &count)) {
        curve.knots = c.variables.array_values(knots);
        return true;
    }
    if (int room = c.variables.arrays().length(array); room < 4) {
        c.context.error(Code::RSL_SPLINE_KNOTS, c.where(), curve.basis.name, room);
        return false;
    }
    curve.array = array;
    count_pieces(c, c.variables.arrays().count(array), curve);
    return true;
}

// spline([basis,] x, knots...) or with an array of knots.
void spline(LowerCall& c) {
    bool named = c.args[0].type == BaseType::String;
    bool solving = false;
    const Basis* basis = find_basis(c, named, &solving);
    if (!basis) return;
    size_t first = named ? 2 : 1;
    bool solvable = !solving || c.result_type() == BaseType::Float;
    Curve curve{*basis, {c.args.begin() + long(first), c.args.end()}, 0};
    if (c.call.args[first]->type.is_array() && !take_knots(c, first, curve)) return;
    if (curve.array < 0) {
        int count = int(curve.knots.size());
        if (count < 4 || (count - 4) % basis->step != 0 || !solvable)
            return c.context.error(Code::RSL_SPLINE_KNOTS, c.where(), basis->name, count);
        curve.pieces = (count - 4) / basis->step + 1;
    } else if (!solvable) {
        return c.context.error(Code::RSL_SPLINE_KNOTS, c.where(), basis->name, "an array of");
    }
    Value x = c.args[first - 1].c[0];
    Lowered value = solving ? lowered(BaseType::Float, solve(c, curve, x)) : point_at(c, curve, x);
    for (size_t j = 0; j < size_t(c.result.size()); ++j)
        c.result.c[j] =
            curve.array < 0 ? value.c[j] : c.b.select(curve.enough, value.c[j], c.b.f(0));
}

}  // namespace lower_spline

namespace ref {
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
    if (c.call.args[first]->type.is_array()) knots = c.arrays[first];
    int behind = int(knots.size()) - 4;
    if (behind < 0 || behind % basis.step != 0) ++c.eval.result.faults;
    if (behind < 0) return;
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

}  // namespace
}  // namespace ref

namespace {

namespace lower = lower_spline;

const Builtin kRows[] = {
    {"spline",
     "f=ffffff* c=fccccc* p=fppppp* v=fvvvvv* n=fnnnnn* f=sffffff* "
     "c=sfccccc* p=sfppppp* v=sfvvvvv* n=sfnnnnn* f=ff[] c=fc[] p=fp[] "
     "v=fv[] n=fn[] f=sff[] c=sfc[] p=sfp[] v=sfv[] n=sfn[]",
     lower::spline, KINORA_RSL_REF(ref::spline), kPure, 4,
     "Value at x of the spline through the knots (Catmull-Rom unless a basis is named)."},
};

}  // namespace

std::span<const Builtin> builtins_spline() {
    return kRows;
}

bool is_spline_basis(std::string_view name) {
    bool solve = cut_solve(name);
    return (solve || !name.empty()) && basis_named(name);
}

std::vector<std::string_view> spline_basis_names() {
    std::vector<std::string_view> names;
    for (const Basis& basis : kBases) names.push_back(basis.name);
    return names;
}

}  // namespace kinora::rsl
