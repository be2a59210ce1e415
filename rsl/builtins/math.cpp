// rsl/builtins/math.cpp: rows of the built-in table: mathematics of floats and, componentwise, of
// triples.
#include "rsl/builtins/table.h"
#include "rsl/lower/lower_p.h"
#include "rsl/reference/builtins.h"

namespace kinora::rsl {

namespace lower_math {

using Unary = Value (*)(LowerCall& c, Value x);
using Binary = Value (*)(LowerCall& c, Value x, Value y);

// A function of one or two floats, componentwise on triples.
template <Unary function>
void unary(LowerCall& c) {
    Lowered r{c.result_type(), {}};
    for (int k = 0; k < r.size(); ++k) r.c[size_t(k)] = function(c, c.args[0].c[size_t(k)]);
    c.result = r;
}
template <Binary function>
void binary(LowerCall& c) {
    Lowered r = c.args[0];
    r.type = c.result_type();
    for (size_t a = 1; a < c.args.size(); ++a)
        for (size_t k = 0; k < size_t(r.size()); ++k) r.c[k] = function(c, r.c[k], c.args[a].c[k]);
    c.result = r;
}
// Functions of jit/math/math.h.
template <Value (*function)(jit::Builder&, Value, jit::math::Tier)>
void of_math(LowerCall& c) {
    Lowered r{c.result_type(), {}};
    for (size_t k = 0; k < size_t(r.size()); ++k)
        r.c[k] = function(c.b, c.args[0].c[k], c.low.tier);
    c.result = r;
}

Value to_radians(LowerCall& c, Value x) {
    return c.b.mul(x, c.b.f(0.017453292519943295f));
}
Value to_degrees(LowerCall& c, Value x) {
    return c.b.mul(x, c.b.f(57.29577951308232f));
}
Value sqrt(LowerCall& c, Value x) {
    return c.low.sqrt(x);
}
Value abs(LowerCall& c, Value x) {
    return c.b.abs(x);
}
Value sign(LowerCall& c, Value x) {
    Value negative = c.b.select(c.b.lt(x, c.b.f(0)), c.b.f(-1), c.b.f(0));
    return c.b.select(c.b.lt(c.b.f(0), x), c.b.f(1), negative);
}
Value floor(LowerCall& c, Value x) {
    return c.b.floor(x);
}
Value ceil(LowerCall& c, Value x) {
    return c.b.op(jit::Op::Ceil, x);
}
// Halves go up: floor(x + 0.5), but exact where x + 0.5 would round.
Value round(LowerCall& c, Value x) {
    Value whole = c.b.floor(x);
    Value fraction = c.b.sub(x, whole);
    return c.b.select(c.b.le(c.b.f(0.5f), fraction), c.b.add(whole, c.b.f(1)), whole);
}
Value pow(LowerCall& c, Value x, Value y) {
    return c.low.pow(x, y);
}
Value mod(LowerCall& c, Value x, Value y) {
    return c.low.mod(x, y);
}
Value min(LowerCall& c, Value x, Value y) {
    return c.b.min(x, y);
}
Value max(LowerCall& c, Value x, Value y) {
    return c.b.max(x, y);
}
Value step(LowerCall& c, Value edge, Value x) {
    return c.b.select(c.b.lt(x, edge), c.b.f(0), c.b.f(1));
}

void atan(LowerCall& c) {
    c.set(c.args.size() == 1 ? jit::math::atan(c.b, c.f(0), c.low.tier)
                             : jit::math::atan2(c.b, c.f(0), c.f(1), c.low.tier));
}

void log(LowerCall& c) {
    if (c.args.size() == 1) return of_math<jit::math::log>(c);
    Value x = jit::math::log(c.b, c.f(0), c.low.tier);
    c.set(c.low.div(x, jit::math::log(c.b, c.f(1), c.low.tier)));
}

void clamp(LowerCall& c) {
    Lowered r{c.result_type(), {}};
    for (size_t k = 0; k < size_t(r.size()); ++k)
        r.c[k] = c.low.limited(c.args[0].c[k], c.args[1].c[k], c.args[2].c[k]);
    c.result = r;
}

// mix(a, b, alpha): alpha is a float or has a component for each.
void mix(LowerCall& c) {
    Lowered r{c.result_type(), {}};
    bool one = c.args[2].size() == 1;
    for (size_t k = 0; k < size_t(r.size()); ++k)
        r.c[k] = c.low.mix(c.args[0].c[k], c.args[1].c[k], c.args[2].c[one ? 0 : k]);
    c.result = r;
}

void smoothstep(LowerCall& c) {
    Lowered r{c.result_type(), {}};
    for (size_t k = 0; k < size_t(r.size()); ++k)
        r.c[k] = c.low.smoothstep(c.args[0].c[k], c.args[1].c[k], c.args[2].c[k]);
    c.result = r;
}

// The change of x across the shading point: |Du(x) du| + |Dv(x) dv|.
Value filter_width(LowerCall& c, Value x) {
    Value du = c.b.mul(c.b.op(jit::Op::Du, x), c.low.read_global(Global::du).c[0]);
    Value dv = c.b.mul(c.b.op(jit::Op::Dv, x), c.low.read_global(Global::dv).c[0]);
    return c.b.add(c.b.abs(du), c.b.abs(dv));
}

// The shares of the RI's filters that lie below u, -1 to 1 over their support: integrals of
// 1 - |x|, of exp(-2 x^2) (an odd polynomial, off by 2e-5 at most), and of Catmull and Rom's cubic.
Value below_box(LowerCall& c, Value u) {
    return c.b.fma(u, c.b.f(0.5f), c.b.f(0.5f));
}
Value below_triangle(LowerCall& c, Value u) {
    auto& b = c.b;
    return b.add(b.f(0.5f), b.mul(u, b.fma(b.abs(u), b.f(-0.5f), b.f(1))));
}
Value below_gaussian(LowerCall& c, Value u) {
    auto& b = c.b;
    constexpr float kOdd[] = {0.028227837f, -0.13371288f, 0.32582935f, -0.55624279f, 0.83589848f};
    Value square = b.mul(u, u), p = b.f(kOdd[0]);
    for (size_t k = 1; k < std::size(kOdd); ++k) p = b.fma(p, square, b.f(kOdd[k]));
    return b.fma(u, p, b.f(0.5f));
}
Value below_catmull_rom(LowerCall& c, Value u) {
    auto& b = c.b;
    Value a = b.abs(b.add(u, u));  // 0 to 2
    auto poly = [&](std::initializer_list<float> coefficients) {
        Value p = b.f(0);
        for (float k : coefficients) p = c.low.fma(p, a, b.f(k));
        return p;
    };
    Value inner = poly({0.375f, -2.5f / 3, 0, 1, 0});
    Value outer = poly({-0.125f, 2.5f / 3, -2, 2, -1.0f / 6});
    Value half = b.select(b.lt(a, b.f(1)), inner, outer);
    return b.add(b.f(0.5f), b.select(b.lt(u, b.f(0)), b.neg(half), half));
}
struct StepFilter {
    std::string_view name;
    Value (*below)(LowerCall& c, Value u);
};
constexpr StepFilter kStepFilters[] = {{"box", below_box},
                                       {"triangle", below_triangle},
                                       {"gaussian", below_gaussian},
                                       {"catmull-rom", below_catmull_rom}};

// Where none is named, and in place of one that is not known.
const StepFilter& filter_of(LowerCall& c) {
    if (!c.has_pair("filter")) return kStepFilters[0];
    const std::string* text = c.low.constant_text(c.text_pair("filter"));
    for (const StepFilter& filter : kStepFilters)
        if (text && filter.name == *text) return filter;
    c.low.report(Code::RSL_FILTER_UNKNOWN, c.where(), text ? *text : "", c.call.name);
    return kStepFilters[0];
}

Value filtered(LowerCall& c, Value share) {
    const StepFilter& filter = filter_of(c);
    if (filter.below == below_box) return share;
    Value u = c.low.clamp(c.b.fma(share, c.b.f(2), c.b.f(-1)), c.b.f(-1), c.b.f(1));
    return filter.below(c, u);
}

// The step averaged over a box: how much of [low, high] lies above the edge.
void filterstep(LowerCall& c) {
    c.report_unknown_pairs();
    auto& b = c.b;
    Value low = c.f(1), high = c.f(1);
    if (c.args.size() == 3) {
        low = b.min(c.f(1), c.f(2));
        high = b.max(c.f(1), c.f(2));
    }
    Value half = c.args.size() == 3 ? b.f(0) : b.mul(filter_width(c, c.f(1)), b.f(0.5f));
    // As in texture(), the one that names the direction counts where both are given.
    Value widen = c.has_pair("swidth") ? c.pair("swidth", 1) : c.pair("width", 1);
    if (c.args.size() == 3) {
        Value centre = b.mul(b.add(low, high), b.f(0.5f));
        half = b.mul(b.sub(high, low), b.f(0.5f));
        low = high = centre;
    }
    half = b.mul(half, widen);
    Value width = b.add(half, half);
    Value share = c.low.div(b.sub(b.add(high, half), c.f(0)), width);
    Value hard = b.select(b.lt(c.f(1), c.f(0)), b.f(0), b.f(1));
    Value soft = c.low.clamp(filtered(c, share), b.f(0), b.f(1));
    c.set(b.select(b.lt(width, b.f(1.17549435e-38f)), hard, soft));
}

template <jit::Op op>
void derivative(LowerCall& c) {
    Lowered r{c.result_type(), {}};
    for (size_t k = 0; k < size_t(r.size()); ++k) r.c[k] = c.b.op(op, c.args[0].c[k]);
    c.result = r;
}

// Deriv(a, b) = Du(a) / Du(b) + Dv(a) / Dv(b).
void total_derivative(LowerCall& c) {
    Lowered r{c.result_type(), {}};
    Value du = c.b.op(jit::Op::Du, c.f(1)), dv = c.b.op(jit::Op::Dv, c.f(1));
    for (size_t k = 0; k < size_t(r.size()); ++k) {
        Value by_u = c.low.div(c.b.op(jit::Op::Du, c.args[0].c[k]), du);
        Value by_v = c.low.div(c.b.op(jit::Op::Dv, c.args[0].c[k]), dv);
        r.c[k] = c.b.add(by_u, by_v);
    }
    c.result = r;
}

void spline(LowerCall& c);  // rsl/builtins/spline.cpp

}  // namespace lower_math

namespace {

namespace lower = lower_math;

const Builtin kRows[] = {
    {"radians", "f=f", lower::unary<lower::to_radians>, KINORA_RSL_REF(ref::radians), kPure, 1,
     "Degrees to radians: x * PI / 180."},
    {"degrees", "f=f", lower::unary<lower::to_degrees>, KINORA_RSL_REF(ref::degrees), kPure, 1,
     "Radians to degrees: x * 180 / PI."},
    {"sin", "f=f c=c p=p v=v n=n", lower::of_math<jit::math::sin>, KINORA_RSL_REF(ref::sin), kPure,
     1, "Sine of an angle in radians."},
    {"cos", "f=f c=c p=p v=v n=n", lower::of_math<jit::math::cos>, KINORA_RSL_REF(ref::cos), kPure,
     1, "Cosine of an angle in radians."},
    {"tan", "f=f", lower::of_math<jit::math::tan>, KINORA_RSL_REF(ref::tan), kPure, 2,
     "Tangent of an angle in radians."},
    {"asin", "f=f", lower::of_math<jit::math::asin>, KINORA_RSL_REF(ref::asin), kPure, 2,
     "Arc sine in radians; the argument is clamped to -1..1."},
    {"acos", "f=f", lower::of_math<jit::math::acos>, KINORA_RSL_REF(ref::acos), kPure, 2,
     "Arc cosine in radians; the argument is clamped to -1..1."},
    {"atan", "f=f f=ff", lower::atan, KINORA_RSL_REF(ref::atan), kPure, 2,
     "Arc tangent of x, or of y / x in the right quadrant: atan(y, x)."},
    {"exp", "f=f c=c p=p v=v n=n", lower::of_math<jit::math::exp>, KINORA_RSL_REF(ref::exp), kPure,
     1, "e to the power x."},
    {"log", "f=f f=ff c=c p=p v=v n=n", lower::log, KINORA_RSL_REF(ref::log), kPure, 2,
     "Natural logarithm, or the logarithm to a base: log(x, base)."},
    {"sqrt", "f=f c=c p=p v=v n=n", lower::unary<lower::sqrt>, KINORA_RSL_REF(ref::sqrt), kPure, 1,
     "Square root; 0 for negative x."},
    {"inversesqrt", "f=f", lower::of_math<jit::math::inversesqrt>, KINORA_RSL_REF(ref::inversesqrt),
     kPure, 2, "1 / sqrt(x); 0 for x <= 0."},
    {"pow", "f=ff c=cc p=pp v=vv n=nn", lower::binary<lower::pow>, KINORA_RSL_REF(ref::pow), kPure,
     4, "x to the power y."},
    {"mod", "f=ff c=cc p=pp v=vv n=nn", lower::binary<lower::mod>, KINORA_RSL_REF(ref::mod), kPure,
     2, "x - y * floor(x / y): the remainder with the sign of y."},
    {"abs", "f=f c=c p=p v=v n=n", lower::unary<lower::abs>, KINORA_RSL_REF(ref::abs), kPure, 0,
     "Absolute value."},
    {"sign", "f=f c=c p=p v=v n=n", lower::unary<lower::sign>, KINORA_RSL_REF(ref::sign), kPure, 0,
     "-1, 0 or 1 by the sign of x."},
    {"floor", "f=f c=c p=p v=v n=n", lower::unary<lower::floor>, KINORA_RSL_REF(ref::floor), kPure,
     0, "Largest integer not above x."},
    {"ceil", "f=f c=c p=p v=v n=n", lower::unary<lower::ceil>, KINORA_RSL_REF(ref::ceil), kPure, 0,
     "Smallest integer not below x."},
    {"round", "f=f c=c p=p v=v n=n", lower::unary<lower::round>, KINORA_RSL_REF(ref::round), kPure,
     0, "Nearest integer."},
    {"min", "f=fff* c=ccc* p=ppp* v=vvv* n=nnn*", lower::binary<lower::min>,
     KINORA_RSL_REF(ref::min), kPure, 0, "The smallest of its arguments, componentwise."},
    {"max", "f=fff* c=ccc* p=ppp* v=vvv* n=nnn*", lower::binary<lower::max>,
     KINORA_RSL_REF(ref::max), kPure, 0, "The largest of its arguments, componentwise."},
    {"clamp", "f=fff c=ccc p=ppp v=vvv n=nnn", lower::clamp, KINORA_RSL_REF(ref::clamp), kPure, 0,
     "x limited to min..max: clamp(x, min, max); min where x < min, though min > max."},
    {"mix", "f=fff c=ccf p=ppf v=vvf n=nnf c=ccc p=ppp v=vvv n=nnn m=mmf", lower::mix,
     KINORA_RSL_REF(ref::mix), kPure, 2, "a * (1 - alpha) + b * alpha: mix(a, b, alpha)."},
    {"step", "f=ff c=cc p=pp v=vv n=nn", lower::binary<lower::step>, KINORA_RSL_REF(ref::step),
     kPure, 0, "0 below min, else 1: step(min, x)."},
    {"smoothstep", "f=fff c=ccc p=ppp v=vvv n=nnn", lower::smoothstep,
     KINORA_RSL_REF(ref::smoothstep), kPure, 2,
     "0 below min, 1 above max, a Hermite ramp between: smoothstep(min, max, x)."},
    {"filterstep", "f=ff~ f=fff~", lower::filterstep, KINORA_RSL_REF(ref::filterstep), kDerivative,
     4,
     "step filtered over the width of s, or from s1 to s2: filterstep(edge, s1 [, s2]); \"filter\" "
     "box (if none is named) triangle gaussian catmull-rom, \"width\" or, before it, \"swidth\".",
     kSurface | kDisplacement | kVolume},
    {"spline",
     "f=ffffff* c=fccccc* p=fppppp* v=fvvvvv* n=fnnnnn* f=sffffff* "
     "c=sfccccc* p=sfppppp* v=sfvvvvv* n=sfnnnnn* f=ff[] c=fc[] p=fp[] "
     "v=fv[] n=fn[] f=sff[] c=sfc[] p=sfp[] v=sfv[] n=sfn[]",
     lower::spline, KINORA_RSL_REF(ref::spline), kPure, 4,
     "Value at x of the spline through the knots (Catmull-Rom unless a basis is named)."},
    {"Du", "f=f c=c v=p v=v v=n", lower::derivative<jit::Op::Du>, KINORA_RSL_REF(ref::Du),
     kDerivative, 8, "Derivative along u.", kSurface | kDisplacement | kVolume},
    {"Dv", "f=f c=c v=p v=v v=n", lower::derivative<jit::Op::Dv>, KINORA_RSL_REF(ref::Dv),
     kDerivative, 8, "Derivative along v.", kSurface | kDisplacement | kVolume},
    {"Deriv", "f=ff c=cf v=pf v=vf v=nf", lower::total_derivative, KINORA_RSL_REF(ref::Deriv),
     kDerivative, 8, "Du(a) / Du(b) + Dv(a) / Dv(b).", kSurface | kDisplacement | kVolume},
};

}  // namespace

std::span<const Builtin> builtins_math() {
    return kRows;
}

}  // namespace kinora::rsl
