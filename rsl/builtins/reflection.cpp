// rsl/builtins/reflection.cpp: reflection, refraction and the side that faces the eye.
#include "rsl/builtins/table.h"
#include "rsl/lower/builtin_call.h"
#include "rsl/reference/reference_p.h"

namespace kinora::rsl {

namespace lower_reflection {

// The incoming normal turned against I: N itself where I . Nref is 0 (docs/numerics.md#vectors).
void faceforward(LowerCall& c) {
    auto& e = c.e;
    V3 N = c.v3(0), I = c.v3(1);
    V3 reference = c.args.size() == 3 ? c.v3(2) : c.globals.read(Global::Ng).v3();
    c.set(e.select(c.b.lt(e.f(0), e.dot(I, reference)), e.neg(N), N));
}

V3 reflected(Emitter& e, const V3& I, const V3& N) {
    return e.fma(N, e.mul(e.f(-2), e.dot(I, N)), I);
}
void reflect(LowerCall& c) {
    c.set(reflected(c.e, c.v3(0), c.v3(1)));
}

// RI 3.2: k = 1 - eta^2 (1 - (I.N)^2); k < 0 is total reflection.
struct Refraction {
    V3 direction;
    Value total;  // mask
};
Refraction refracted(Emitter& e, const V3& I, const V3& N, Value eta) {
    Value cosine = e.dot(I, N);
    Value eta2 = e.mul(eta, eta);
    Value sine2 = e.b.fma(e.b.neg(cosine), cosine, e.f(1));
    Value k = e.b.fma(e.b.neg(eta2), sine2, e.f(1));
    Value along_N = e.b.fma(eta, cosine, e.sqrt(k));
    V3 direction = e.sub(e.scale(I, eta), e.scale(N, along_N));
    Value total = e.b.lt(k, e.f(0));
    return {e.select(total, e.f3(0), direction), total};
}
void refract(LowerCall& c) {
    c.set(refracted(c.e, c.v3(0), c.v3(1), c.f(2)).direction);
}

// Fresnel's equations for unpolarised light; I and N of length 1, eta the ratio of the outer to
// the inner index. Total reflection, grazing light and eta = 0 give kr = 1, kt = 0.
void fresnel(LowerCall& c) {
    auto& e = c.e;
    auto& b = c.b;
    V3 I = c.v3(0), N = c.v3(1);
    Value eta = c.f(2);
    Value ratio = e.div(e.f(1), eta);  // inner over outer
    Value cosine = b.abs(e.dot(I, N));
    Value g2 = b.sub(b.fma(cosine, cosine, e.mul(ratio, ratio)), e.f(1));
    Value g = e.sqrt(g2);
    Value minus = b.sub(g, cosine), plus = b.add(g, cosine);
    Value a = e.div(minus, plus);
    Value d = e.div(b.fma(cosine, plus, e.f(-1)), b.fma(cosine, minus, e.f(1)));
    Value a2 = e.mul(a, a);
    Value kr = e.mul(b.mul(e.f(0.5f), a2), b.fma(d, d, e.f(1)));
    Value all = b.logical_or(b.le(g2, e.f(0)), b.lt(eta, e.f(1.17549435e-38f)));
    all = b.logical_or(all, b.eq(cosine, e.f(0)));
    kr = b.select(all, e.f(1), e.clamp(kr, e.f(0), e.f(1)));
    c.set_output(3, lowered(BaseType::Float, kr));
    c.set_output(4, lowered(BaseType::Float, b.sub(e.f(1), kr)));
    if (c.args.size() < 7) return;
    c.set_output(5, lowered(BaseType::Vector, reflected(e, I, N)));
    V3 direction = e.select(all, e.f3(0), refracted(e, I, N, eta).direction);
    c.set_output(6, lowered(BaseType::Vector, direction));
}

}  // namespace lower_reflection

namespace ref {
namespace {

template <class Real>
struct Bent {
    Vec<Real> direction;
    bool total;
};
// RenderMan Interface 3.2: k = 1 - eta^2 (1 - (I.N)^2); total reflection where k < 0.
template <class Real>
Bent<Real> bend(RefCall<Real>& c, const Vec<Real>& I, const Vec<Real>& N, const Dual<Real>& eta) {
    using Number = Dual<Real>;
    Number IN = dot(I, N);
    Number k = Number(1) - eta * eta * (Number(1) - IN * IN);
    if (c.eval.decide(k.x < 0)) return {{}, true};
    return {eta * I - (eta * IN + rsl::sqrt(k)) * N, false};
}

template <class Real>
Vec<Real> mirrored(const Vec<Real>& I, const Vec<Real>& N) {
    return I - (Real(2) * dot(I, N)) * N;
}

// Row 64: N where I . Nref = 0.
template <class Real>
void faceforward(RefCall<Real>& c) {
    Vec<Real> ref = c.args.size() == 3 ? c.v(2) : vec(c.eval.global(Global::Ng));
    bool away = c.eval.decide(dot(c.v(1), ref).x > 0);
    c.set(away ? Dual<Real>(-1) * c.v(0) : c.v(0));
}

template <class Real>
void reflect(RefCall<Real>& c) {
    c.set(mirrored(c.v(0), c.v(1)));
}

template <class Real>
void refract(RefCall<Real>& c) {
    c.set(bend(c, c.v(0), c.v(1), c.f(2)).direction);
}

// Fresnel's equations for unpolarised light; I and N of length 1. Row 62: total reflection, and
// eta = 0, give kr = 1.
template <class Real>
void fresnel(RefCall<Real>& c) {
    using Number = Dual<Real>;
    Vec<Real> I = c.v(0), N = c.v(1);
    Number eta = c.f(2);
    auto unit = [](const Vec<Real>& a) { return std::fabs(dot(a, a).x - 1) < Real(1e-3); };
    if (!unit(I) || !unit(N)) c.eval.no_promise();
    Bent<Real> t = bend(c, I, N, eta);
    Number kr(1);
    bool passes = !t.total && eta.x > 0 && dot(I, N).x != 0;
    if (passes) {
        Number cos_i = rsl::abs(dot(I, N)), cos_t = rsl::abs(dot(t.direction, N));
        Number s = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
        Number p = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
        kr = rsl::clamp(Real(0.5) * (s * s + p * p), Number(0), Number(1));
    }
    c.args[3].c[0] = kr;
    c.args[4].c[0] = Number(1) - kr;
    if (c.args.size() < 7) return;
    c.set_output(5, mirrored(I, N));
    c.set_output(6, passes ? t.direction : Vec<Real>{});
}

}  // namespace
}  // namespace ref

namespace {

namespace lower = lower_reflection;

const Builtin kRows[] = {
    // Two rows: only the form without Nref reads Ng.
    {"faceforward", "v=vv", lower::faceforward, KINORA_RSL_REF(ref::faceforward), kPure, 0,
     "N or -N, whichever faces against I by Ng: faceforward(N, I).", kAnyShader, "Ng"},
    {"faceforward", "v=vvv", lower::faceforward, KINORA_RSL_REF(ref::faceforward), kPure, 0,
     "N or -N, whichever faces against I by Nref: faceforward(N, I, Nref)."},
    {"reflect", "v=vv", lower::reflect, KINORA_RSL_REF(ref::reflect), kPure, 2,
     "I mirrored at N: reflect(I, N), N of length 1."},
    {"refract", "v=vvf", lower::refract, KINORA_RSL_REF(ref::refract), kPure, 4,
     "I bent at N by the ratio of indices eta; zero at total reflection."},
    {"fresnel", "x=vvfFF x=vvfFFVV", lower::fresnel, KINORA_RSL_REF(ref::fresnel), kPure, 8,
     "Reflected and transmitted shares kr, kt (and directions R, T): fresnel(I, N, eta, kr, kt [, "
     "R, T])."},
};

}  // namespace

std::span<const Builtin> builtins_reflection() {
    return kRows;
}

}  // namespace kinora::rsl
