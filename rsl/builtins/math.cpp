// rsl/builtins/math.cpp: mathematics of floats and, componentwise, of triples.
#include "rsl/builtins/table.h"
#include "rsl/lower/builtin_call.h"
#include "rsl/reference/components_p.h"
#include "rsl/reference/reference_p.h"

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
    for (size_t k = 0; k < size_t(r.size()); ++k) r.c[k] = function(c.b, c.args[0].c[k], c.e.tier);
    c.result = r;
}

Value to_radians(LowerCall& c, Value x) {
    return c.b.mul(x, c.b.f(0.017453292519943295f));
}
Value to_degrees(LowerCall& c, Value x) {
    return c.b.mul(x, c.b.f(57.29577951308232f));
}
Value sqrt(LowerCall& c, Value x) {
    return c.e.sqrt(x);
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
    return c.e.pow(x, y);
}
Value mod(LowerCall& c, Value x, Value y) {
    return c.e.mod(x, y);
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
    c.set(c.args.size() == 1 ? jit::math::atan(c.b, c.f(0), c.e.tier)
                             : jit::math::atan2(c.b, c.f(0), c.f(1), c.e.tier));
}

void log(LowerCall& c) {
    if (c.args.size() == 1) return of_math<jit::math::log>(c);
    Value x = jit::math::log(c.b, c.f(0), c.e.tier);
    c.set(c.e.div(x, jit::math::log(c.b, c.f(1), c.e.tier)));
}

void clamp(LowerCall& c) {
    Lowered r{c.result_type(), {}};
    for (size_t k = 0; k < size_t(r.size()); ++k)
        r.c[k] = c.e.limited(c.args[0].c[k], c.args[1].c[k], c.args[2].c[k]);
    c.result = r;
}

// mix(a, b, alpha): alpha is a float or has a component for each.
void mix(LowerCall& c) {
    Lowered r{c.result_type(), {}};
    bool one = c.args[2].size() == 1;
    for (size_t k = 0; k < size_t(r.size()); ++k)
        r.c[k] = c.e.mix(c.args[0].c[k], c.args[1].c[k], c.args[2].c[one ? 0 : k]);
    c.result = r;
}

void smoothstep(LowerCall& c) {
    Lowered r{c.result_type(), {}};
    for (size_t k = 0; k < size_t(r.size()); ++k)
        r.c[k] = c.e.smoothstep(c.args[0].c[k], c.args[1].c[k], c.args[2].c[k]);
    c.result = r;
}

}  // namespace lower_math

namespace ref {
namespace {

template <class Real>
Dual<Real> smooth(RefCall<Real>& c, const Dual<Real>& lo, const Dual<Real>& hi,
                  const Dual<Real>& x) {
    if (c.eval.decide(x.x < lo.x)) return {};  // docs/numerics.md#steps-and-limits: in this order
    if (c.eval.decide(x.x >= hi.x)) return Real(1);
    Dual<Real> t = clamp((x - lo) / (hi - lo), Dual<Real>(0), Dual<Real>(1));
    return t * t * (Dual<Real>(3) - Real(2) * t);
}

// x - y floor(x / y) in [0, y), as if exact (docs/numerics.md#modulo).
template <class Real>
Dual<Real> modulo(RefCall<Real>& c, const Dual<Real>& x, const Dual<Real>& y) {
    if (std::fabs(y.x) < Real(FLT_MIN)) return {};
    Real turns = c.eval.decide(std::floor(x.x / y.x));
    // Row 54: beyond 2^24 turns only the range is promised.
    if (!(std::fabs(turns) < Real(1 << 24))) c.eval.no_promise();
    Real r = std::fmod(x.x, y.x);
    if (r != 0 && (r < 0) != (y.x < 0)) r += y.x;
    if (c.eval.decide(float(r) == float(y.x))) return {};  // stays below y when rounded
    return {r, x.u - turns * y.u, x.v - turns * y.v};
}

#define KINORA_UNARY(name, formula)        \
    template <class Real>                  \
    void name(RefCall<Real>& c) {          \
        each(c, [&](size_t k) {            \
            Dual<Real> x = c.args[0].c[k]; \
            return formula;                \
        });                                \
    }

KINORA_UNARY(radians, Real(3.14159265358979323846 / 180) * x)
KINORA_UNARY(degrees, Real(180 / 3.14159265358979323846) * x)
KINORA_UNARY(sin, rsl::sin(x))
KINORA_UNARY(cos, rsl::cos(x))
KINORA_UNARY(tan, rsl::tan(x))
KINORA_UNARY(asin, rsl::asin(x))
KINORA_UNARY(acos, rsl::acos(x))
KINORA_UNARY(exp, rsl::exp(x))
KINORA_UNARY(sqrt, rsl::sqrt(x))
KINORA_UNARY(abs, rsl::abs(x))
KINORA_UNARY(sign, whole(c, Real(x.x > 0) - Real(x.x < 0)))
KINORA_UNARY(floor, whole(c, std::floor(x.x)))
KINORA_UNARY(ceil, whole(c, std::ceil(x.x)))
KINORA_UNARY(inversesqrt, x.x > 0
                              ? chain(x, 1 / std::sqrt(x.x), Real(-0.5) / (x.x * std::sqrt(x.x)))
                              : Dual<Real>())
// Half rounds up.
KINORA_UNARY(round, whole(c, std::floor(x.x) + Real(x.x - std::floor(x.x) >= Real(0.5))))
#undef KINORA_UNARY

#define KINORA_FOLD(name, formula)                       \
    template <class Real>                                \
    void name(RefCall<Real>& c) {                        \
        each(c, [&](size_t k) {                          \
            Dual<Real> x = at(c, 0, k);                  \
            for (size_t i = 1; i < c.args.size(); ++i) { \
                Dual<Real> y = at(c, i, k);              \
                x = formula;                             \
            }                                            \
            return x;                                    \
        });                                              \
    }

KINORA_FOLD(pow, rsl::pow(x, y))
KINORA_FOLD(mod, modulo(c, x, y))
KINORA_FOLD(min, rsl::min(x, y))
KINORA_FOLD(max, rsl::max(x, y))
KINORA_FOLD(step, whole(c, Real(y.x < x.x ? 0 : 1)))
#undef KINORA_FOLD

template <class Real>
void atan(RefCall<Real>& c) {
    c.set(c.args.size() == 2 ? atan2(c.f(0), c.f(1))
                             : chain(c.f(0), std::atan(c.f(0).x), 1 / (1 + c.f(0).x * c.f(0).x)));
}
template <class Real>
void log(RefCall<Real>& c) {
    if (c.args.size() == 2) return c.set(rsl::log(c.f(0)) / rsl::log(c.f(1)));
    each(c, [&](size_t k) { return rsl::log(c.args[0].c[k]); });
}
template <class Real>
void clamp(RefCall<Real>& c) {
    each(c, [&](size_t k) { return rsl::clamp(at(c, 0, k), at(c, 1, k), at(c, 2, k)); });
}
template <class Real>
void mix(RefCall<Real>& c) {
    Dual<Real> one(1);  // not a + (b - a) alpha, which loses all of b beside a huge a
    each(c,
         [&](size_t k) { return at(c, 0, k) * (one - at(c, 2, k)) + at(c, 1, k) * at(c, 2, k); });
}
template <class Real>
void smoothstep(RefCall<Real>& c) {
    each(c, [&](size_t k) { return smooth(c, at(c, 0, k), at(c, 1, k), at(c, 2, k)); });
}

}  // namespace
}  // namespace ref

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
};

}  // namespace

std::span<const Builtin> builtins_math() {
    return kRows;
}

}  // namespace kinora::rsl
