// rsl/reference/math.cpp: mathematical built-ins at one point. Numbers carry derivatives, so each
// formula also says what Du and Dv see.
#include "rsl/reference/reference_p.h"

namespace kinora::rsl::ref {

namespace {

template <class Real, class F>
void each(RefCall<Real>& c, F f) {
    for (size_t k = 0; k < c.result.size(); ++k) c.result.c[k] = f(k);
}
// The component of argument i; floats serve all components.
template <class Real>
Dual<Real> at(RefCall<Real>& c, size_t i, size_t k) {
    return c.args[i].c[c.args[i].size() == 1 ? 0 : k];
}
// Values without slope that rounding may turn.
template <class Real>
Dual<Real> whole(RefCall<Real>& c, Real x) {
    return c.eval.decide(std::isfinite(x) ? x : Real(0)), Dual<Real>(x);
}

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

}  // namespace

#define KINORA_UNARY(name, formula)        \
    template <class Real>                  \
    void name(RefCall<Real>& c) {          \
        each(c, [&](size_t k) {            \
            Dual<Real> x = c.args[0].c[k]; \
            return formula;                \
        });                                \
    }                                      \
    KINORA_RSL_DEFINE_REF(name)

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
    }                                                    \
    KINORA_RSL_DEFINE_REF(name)

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

namespace {

// The RI's filters over -1..1.
double filter_at(std::string_view name, double x) {
    double a = std::fabs(x);
    if (name == "triangle") return 1 - a;
    if (name == "gaussian") return std::exp(-2 * x * x);
    if (name != "catmull-rom") return 1;
    a *= 2;
    return a < 1 ? 1.5 * a * a * a - 2.5 * a * a + 1 : -0.5 * a * a * a + 2.5 * a * a - 4 * a + 2;
}

// Below u, by the middle of small steps.
double share_below(std::string_view name, double u) {
    constexpr int kSteps = 4000;
    double below = 0, all = 0;
    for (int k = 0; k < kSteps; ++k) {
        double x = (2 * k + 1.0) / kSteps - 1, f = filter_at(name, x);
        all += f;
        if (x < u) below += f;
    }
    return below / all;
}

}  // namespace

// The share of the interval s1..s2 (or of the width of s around it) that lies beyond the edge.
template <class Real>
void filterstep(RefCall<Real>& c) {
    using Number = Dual<Real>;
    Number s = c.f(1), low, high;
    if (c.args.size() == 3) {
        low = rsl::min(s, c.f(2)), high = rsl::max(s, c.f(2));
    } else {
        Real width = std::fabs(s.u * c.eval.global(Global::du).c[0].x) +
                     std::fabs(s.v * c.eval.global(Global::dv).c[0].x);
        low = s - Number(width / 2), high = s + Number(width / 2);
    }
    Number middle = Real(0.5) * (low + high);
    bool apart = false;  // "swidth" counts before "width"
    for (auto& [name, value] : c.pairs) apart = apart || name == "swidth";
    Number half = Real(0.5) * (high - low) * c.pair(apart ? "swidth" : "width", 1);
    low = middle - half, high = middle + half;
    Number edge = c.f(0);
    if ((high - low).x < Real(FLT_MIN)) return c.set(whole(c, Real(s.x < edge.x ? 0 : 1)));
    Number share = (high - edge) / (high - low);
    for (auto& [name, value] : c.pairs)
        if (name == "filter" && value.text() != "box")
            share = Number(Real(share_below(value.text(), double(2 * share.x - 1))));
    c.set(rsl::clamp(share, Number(0), Number(1)));
}

// The derivative of a derivative is 0 (docs/decisions.md#dual-numbers).
template <class Real>
void Du(RefCall<Real>& c) {
    each(c, [&](size_t k) { return Dual<Real>(at(c, 0, k).u); });
}
template <class Real>
void Dv(RefCall<Real>& c) {
    each(c, [&](size_t k) { return Dual<Real>(at(c, 0, k).v); });
}
template <class Real>
void Deriv(RefCall<Real>& c) {
    using Number = Dual<Real>;
    Number b = c.f(1);
    each(c, [&](size_t k) {
        Number a = at(c, 0, k);
        return Number(a.u) / Number(b.u) + Number(a.v) / Number(b.v);
    });
}

KINORA_RSL_DEFINE_REF(atan)
KINORA_RSL_DEFINE_REF(log)
KINORA_RSL_DEFINE_REF(clamp)
KINORA_RSL_DEFINE_REF(mix)
KINORA_RSL_DEFINE_REF(smoothstep)
KINORA_RSL_DEFINE_REF(filterstep)
KINORA_RSL_DEFINE_REF(Du)
KINORA_RSL_DEFINE_REF(Dv)
KINORA_RSL_DEFINE_REF(Deriv)

}  // namespace kinora::rsl::ref
