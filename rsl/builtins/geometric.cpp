// rsl/builtins/geometric.cpp: points, vectors and normals.
#include "rsl/builtins/table.h"
#include "rsl/lower/builtin_call.h"
#include "rsl/reference/matrices_p.h"
#include "rsl/reference/reference_p.h"

namespace kinora::rsl {

namespace lower_geometric {

template <int component>
void get(LowerCall& c) {
    c.set(c.args[0].c[component]);
}
template <int component>
void put(LowerCall& c) {
    Lowered v = c.args[0];
    v.c[component] = c.f(1);
    c.set_output(0, v);
}

void length(LowerCall& c) {
    c.set(c.e.length(c.v3(0)));
}
void normalize(LowerCall& c) {
    c.set(c.e.normalize(c.v3(0)));
}
void distance(LowerCall& c) {
    c.set(c.e.length(c.e.sub(c.v3(0), c.v3(1))));
}

// ptlined(p0, p1, q): to the nearest point of the segment. RI 3.2 writes q first; other renderers
// and all public shaders have it last.
void ptlined(LowerCall& c) {
    auto& e = c.e;
    V3 along = e.sub(c.v3(1), c.v3(0)), to_q = e.sub(c.v3(2), c.v3(0));
    Value t = e.clamp(e.div(e.dot(to_q, along), e.dot(along, along)), e.f(0), e.f(1));
    c.set(e.length(e.sub(to_q, e.scale(along, t))));
}

// Rodrigues: v cos + (axis ^ v) sin + axis (axis . v)(1 - cos), axis of length 1.
V3 rotated(Emitter& e, const V3& v, const V3& axis, Value sine, Value cosine) {
    Value rest = e.mul(e.dot(axis, v), e.b.sub(e.f(1), cosine));
    return e.fma(axis, rest, e.fma(e.cross(axis, v), sine, e.scale(v, cosine)));
}

// rotate(p, angle, p0, p1), or rotate(m, angle, axis): the rotation comes before m.
void rotate(LowerCall& c) {
    auto& e = c.e;
    Value sine = jit::math::sin(c.b, c.f(1), e.tier), cosine = jit::math::cos(c.b, c.f(1), e.tier);
    if (c.result_type() != BaseType::Matrix) {
        V3 axis = e.normalize(e.sub(c.v3(3), c.v3(2)));
        V3 v = e.sub(c.v3(0), c.v3(2));
        return c.set(e.add(c.v3(2), rotated(e, v, axis, sine, cosine)));
    }
    V3 axis = e.normalize(c.v3(2));
    Lowered turn = convert(c.e, lowered(BaseType::Float, e.f(1)), BaseType::Matrix);
    for (size_t row = 0; row < 3; ++row) {
        V3 unit = e.f3(0);
        unit[row] = e.f(1);
        V3 image = rotated(e, unit, axis, sine, cosine);
        for (size_t k = 0; k < 3; ++k) turn.c[row * 4 + k] = image[k];
    }
    c.result = multiply(c.e, turn, c.args[0]);
}

// |Du(p) du ^ Dv(p) dv|
void area(LowerCall& c) {
    auto& e = c.e;
    V3 along_u = e.scale(e.du(c.v3(0)), c.globals.read(Global::du).c[0]);
    V3 along_v = e.scale(e.dv(c.v3(0)), c.globals.read(Global::dv).c[0]);
    c.set(e.length(e.cross(along_u, along_v)));
}

}  // namespace lower_geometric

namespace ref {
namespace {

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
void ptlined(RefCall<Real>& c) {
    using Number = Dual<Real>;
    Vec<Real> aq = c.v(2) - c.v(0), ab = c.v(1) - c.v(0);
    Number t = c.eval.rounded(dot(aq, ab) / dot(ab, ab));
    t = rsl::clamp(t, Number(0), Number(1));
    c.set(rsl::length(aq - t * ab));  // 0 at both ends
}

// rotate(p, angle, p0, p1) around a line, or rotate(m, angle, axis).
template <class Real>
void rotate(RefCall<Real>& c) {
    if (c.args[0].type == BaseType::Matrix) {
        c.result = moved(product(rotation(c.f(1), c.v(2)), matrix(c.args[0])));
        return;
    }
    Vec<Real> p = c.v(2), q = c.v(0) - p;
    RefValue<Real> d(BaseType::Vector, q[0], q[1], q[2]);
    c.set(p + vec(c.eval.by_matrix(d, rotation(c.f(1), c.v(3) - p))));
}

template <class Real>
void area(RefCall<Real>& c) {
    Vec<Real> p = c.v(0);
    Dual<Real> du = constant(c.eval.global(Global::du).c[0]);
    Dual<Real> dv = constant(c.eval.global(Global::dv).c[0]);
    c.set(constant(rsl::length(c.eval.cross(du * along_u(p), dv * along_v(p)))));
}

}  // namespace
}  // namespace ref

namespace {

namespace lower = lower_geometric;

const Builtin kRows[] = {
    {"xcomp", "f=p f=v f=n f=c", lower::get<0>, KINORA_RSL_REF(ref::xcomp), kPure, 0,
     "x of a point, vector or normal."},
    {"ycomp", "f=p f=v f=n f=c", lower::get<1>, KINORA_RSL_REF(ref::ycomp), kPure, 0,
     "y of a point, vector or normal."},
    {"zcomp", "f=p f=v f=n f=c", lower::get<2>, KINORA_RSL_REF(ref::zcomp), kPure, 0,
     "z of a point, vector or normal."},
    {"setxcomp", "x=Pf x=Vf x=Nf", lower::put<0>, KINORA_RSL_REF(ref::setxcomp), kPure, 0,
     "Sets x."},
    {"setycomp", "x=Pf x=Vf x=Nf", lower::put<1>, KINORA_RSL_REF(ref::setycomp), kPure, 0,
     "Sets y."},
    {"setzcomp", "x=Pf x=Vf x=Nf", lower::put<2>, KINORA_RSL_REF(ref::setzcomp), kPure, 0,
     "Sets z."},
    {"length", "f=v", lower::length, KINORA_RSL_REF(ref::length), kPure, 2, "Length of a vector."},
    {"normalize", "v=v n=n", lower::normalize, KINORA_RSL_REF(ref::normalize), kPure, 2,
     "The vector of length 1 in the same direction; zero stays zero."},
    {"distance", "f=pp", lower::distance, KINORA_RSL_REF(ref::distance), kPure, 2,
     "Distance of two points."},
    {"ptlined", "f=ppp", lower::ptlined, KINORA_RSL_REF(ref::ptlined), kPure, 4,
     "Distance of a point from a line segment: ptlined(p0, p1, q)."},
    {"rotate", "p=pfpp m=mfv", lower::rotate, KINORA_RSL_REF(ref::rotate), kPure, 8,
     "Rotates a point around the line p0 p1, or a matrix around an axis, by an angle in radians."},
    {"area", "f=p f=ps", lower::area, KINORA_RSL_REF(ref::area), kDerivative, 8,
     "Area of the shading point: length(Du(p) * du ^ Dv(p) * dv).",
     kSurface | kDisplacement | kVolume, "du dv"},
};

}  // namespace

std::span<const Builtin> builtins_geometric() {
    return kRows;
}

}  // namespace kinora::rsl
