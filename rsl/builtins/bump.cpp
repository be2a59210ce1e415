// rsl/builtins/bump.cpp: normals bent by a map of heights.
#include "rsl/builtins/maps_p.h"
#include "rsl/builtins/table.h"
#include "rsl/lower/builtin_call.h"
#include "rsl/reference/reference_p.h"

namespace kinora::rsl {

namespace lower_bump {

using namespace lower_maps;

// J. F. Blinn, Simulation of Wrinkled Surfaces, 1978: the surface P + h n has the normal
// dPds ^ dPdt + h_s (n ^ dPdt) + h_t (dPds ^ n). Slopes are differences over the footprint. Here
// n |dPds ^ dPdt| is the first term: the N given is bent, not the face's.
void bump(LowerCall& c) {
    c.report_unknown_pairs();
    auto& e = c.e;
    auto& b = c.b;
    V3 N = c.v3(1), along_s = c.v3(2), along_t = c.v3(3);
    bool given_st = c.args.size() == 6;
    Lookup at = with_derivatives(c, given_st ? c.f(4) : c.globals.read(Global::s).c[0],
                                 given_st ? c.f(5) : c.globals.read(Global::t).c[0]);
    Value least = e.f(1.0f / 1024);  // a texel of a large map
    Value ds = b.max(b.add(b.abs(at.dsdx), b.abs(at.dsdy)), least);
    Value dt = b.max(b.add(b.abs(at.dtdx), b.abs(at.dtdy)), least);
    auto height = [&](float s, float t) {
        Lookup beside = {b.fma(ds, e.f(s), at.s), b.fma(dt, e.f(t), at.t), ds, e.f(0), e.f(0), dt};
        return look_up(c, beside, c.pair("blur", 0), e.f(1), e.f(1))[0];
    };
    Value slope_s = e.div(b.sub(height(0.5f, 0), height(-0.5f, 0)), ds);
    Value slope_t = e.div(b.sub(height(0, 0.5f), height(0, -0.5f)), dt);
    V3 n = e.normalize(N), flat = e.cross(along_s, along_t);
    Value behind = b.lt(e.dot(flat, N), e.f(0));
    Value side = b.select(behind, e.f(-1), e.f(1));
    V3 terms = e.fma(e.cross(n, along_t), slope_s, e.scale(e.cross(along_s, n), slope_t));
    V3 bent = e.fma(terms, side, e.scale(n, e.length(flat)));
    V3 result = e.scale(e.normalize(bent), e.length(N));
    c.set(e.select(b.eq(e.dot(bent, bent), e.f(0)), N, result));
}

}  // namespace lower_bump

namespace ref {
namespace {

// The normal of P + h n for heights h of a map, whose slopes are differences over the footprint (J.
// F. Blinn, Simulation of Wrinkled Surfaces, 1978).
template <class Real>
void bump(RefCall<Real>& c) {
    using Number = Dual<Real>;
    bool given_st = c.args.size() == 6;
    Number s = given_st ? c.f(4) : c.eval.global(Global::s).c[0];
    Number t = given_st ? c.f(5) : c.eval.global(Global::t).c[0];
    Real du = c.eval.global(Global::du).c[0].x, dv = c.eval.global(Global::dv).c[0].x;
    auto width = [&](const Number& x) {
        return std::max(std::fabs(x.u * du) + std::fabs(x.v * dv), Real(1.0 / 1024));
    };
    Real ds = width(s), dt = width(t);
    double channel = c.call.channel ? double(c.eval.expr(*c.call.channel).c[0].x) : 0;
    auto height = [&](Real by_s, Real by_t) {
        std::vector<double> texels = c.eval.service(
            Service::texture,
            {double(c.f(0).x), channel, double(s.x + by_s * ds), double(t.x + by_t * dt)});
        return texels.empty() ? Real(0) : Real(texels[0]);
    };
    Number slope_s = (height(Real(0.5), 0) - height(Real(-0.5), 0)) / ds;
    Number slope_t = (height(0, Real(0.5)) - height(0, Real(-0.5))) / dt;
    Vec<Real> N = c.v(1), n = rsl::normalize(N), along_s = c.v(2), along_t = c.v(3);
    Vec<Real> flat = c.eval.cross(along_s, along_t);
    Number side(Real(c.eval.decide(dot(flat, N).x < 0) ? -1 : 1));
    Vec<Real> terms = slope_s * cross(n, along_t) + slope_t * cross(along_s, n);
    Vec<Real> bent = rsl::length(flat) * n + side * terms;
    bool none = c.eval.decide(dot(bent, bent).x == 0);
    c.set(none ? N : rsl::length(N) * rsl::normalize(bent));
}

}  // namespace
}  // namespace ref

namespace {

namespace lower = lower_bump;

const Builtin kRows[] = {
    {"bump", "n=snvv~ n=snvvff~", lower::bump, KINORA_RSL_REF(ref::bump),
     kService | kNamesFile | kDerivative, 0,
     "N bent by a map of heights: bump(name, N, dPds, dPdt [, s, t]).", kSurface | kDisplacement,
     "s t"},
};

}  // namespace

std::span<const Builtin> builtins_bump() {
    return kRows;
}

}  // namespace kinora::rsl
