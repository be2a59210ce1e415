// rsl/reference/geometric.cpp: geometric built-ins at one point.
#include "rsl/reference/reference_p.h"

namespace kinora::rsl::ref {

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

}  // namespace

template <class Real>
void xcomp(RefCall<Real>& c) {
    c.set(c.v(0)[0]);
}
template <class Real>
void ycomp(RefCall<Real>& c) {
    c.set(c.v(0)[1]);
}
template <class Real>
void zcomp(RefCall<Real>& c) {
    c.set(c.v(0)[2]);
}
template <class Real>
void setxcomp(RefCall<Real>& c) {
    c.args[0].c[0] = c.f(1);
}
template <class Real>
void setycomp(RefCall<Real>& c) {
    c.args[0].c[1] = c.f(1);
}
template <class Real>
void setzcomp(RefCall<Real>& c) {
    c.args[0].c[2] = c.f(1);
}
template <class Real>
void length(RefCall<Real>& c) {
    c.set(rsl::length(c.v(0)));
}
template <class Real>
void normalize(RefCall<Real>& c) {
    c.set(rsl::normalize(c.v(0)));
}
template <class Real>
void distance(RefCall<Real>& c) {
    c.set(rsl::length(c.v(0) - c.v(1)));
}
template <class Real>
void reflect(RefCall<Real>& c) {
    c.set(mirrored(c.v(0), c.v(1)));
}

template <class Real>
void ptlined(RefCall<Real>& c) {
    using Number = Dual<Real>;
    Vec<Real> aq = c.v(0) - c.v(1), ab = c.v(2) - c.v(1);
    Number t = c.eval.rounded(dot(aq, ab) / dot(ab, ab));
    t = rsl::clamp(t, Number(0), Number(1));
    c.set(rsl::length(aq - t * ab));  // 0 at both ends
}

template <class Real>
void area(RefCall<Real>& c) {
    Vec<Real> p = c.v(0);
    Dual<Real> du = constant(c.eval.global(Global::du).c[0]);
    Dual<Real> dv = constant(c.eval.global(Global::dv).c[0]);
    c.set(constant(rsl::length(c.eval.cross(du * along_u(p), dv * along_v(p)))));
}

// Row 64: N where I . Nref = 0.
template <class Real>
void faceforward(RefCall<Real>& c) {
    Vec<Real> ref = c.args.size() == 3 ? c.v(2) : vec(c.eval.global(Global::Ng));
    bool away = c.eval.decide(dot(c.v(1), ref).x > 0);
    c.set(away ? Dual<Real>(-1) * c.v(0) : c.v(0));
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

template <class Real>
void depth(RefCall<Real>& c) {
    using Number = Dual<Real>;
    Number near(c.eval.number("camera:near", 0)), far(c.eval.number("camera:far", 0));
    RefValue<Real> p = c.args[0];
    p.type = BaseType::Point;
    c.set((c.eval.out_of_layer(p).c[2] - near) / (far - near));  // along the camera's z
}

// Du(p) ^ Dv(p) on the side of Ng; its own derivatives are those of N as it came.
template <class Real>
void calculatenormal(RefCall<Real>& c) {
    c.set(c.eval.normal_of(c.v(0)));
}

KINORA_RSL_DEFINE_REF(xcomp)
KINORA_RSL_DEFINE_REF(ycomp)
KINORA_RSL_DEFINE_REF(zcomp)
KINORA_RSL_DEFINE_REF(setxcomp)
KINORA_RSL_DEFINE_REF(setycomp)
KINORA_RSL_DEFINE_REF(setzcomp)
KINORA_RSL_DEFINE_REF(length)
KINORA_RSL_DEFINE_REF(normalize)
KINORA_RSL_DEFINE_REF(distance)
KINORA_RSL_DEFINE_REF(reflect)
KINORA_RSL_DEFINE_REF(ptlined)
KINORA_RSL_DEFINE_REF(area)
KINORA_RSL_DEFINE_REF(faceforward)
KINORA_RSL_DEFINE_REF(refract)
KINORA_RSL_DEFINE_REF(fresnel)
KINORA_RSL_DEFINE_REF(depth)
KINORA_RSL_DEFINE_REF(calculatenormal)

}  // namespace kinora::rsl::ref
