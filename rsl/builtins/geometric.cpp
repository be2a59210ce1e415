// rsl/builtins/geometric.cpp: rows of the built-in table: points, vectors, normals, spaces.
#include "rsl/builtins/table.h"
#include "rsl/lower/lower_p.h"
#include "rsl/reference/builtins.h"

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
    c.set(c.low.length(c.v3(0)));
}
void normalize(LowerCall& c) {
    c.set(c.low.normalize(c.v3(0)));
}
void distance(LowerCall& c) {
    c.set(c.low.length(c.low.sub(c.v3(0), c.v3(1))));
}

// ptlined(q, p0, p1): to the nearest point of the segment.
void ptlined(LowerCall& c) {
    auto& e = c.low;
    V3 along = e.sub(c.v3(2), c.v3(1)), to_q = e.sub(c.v3(0), c.v3(1));
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
    auto& e = c.low;
    Value sine = jit::math::sin(c.b, c.f(1), e.tier), cosine = jit::math::cos(c.b, c.f(1), e.tier);
    if (c.result_type() != BaseType::Matrix) {
        V3 axis = e.normalize(e.sub(c.v3(3), c.v3(2)));
        V3 v = e.sub(c.v3(0), c.v3(2));
        return c.set(e.add(c.v3(2), rotated(e, v, axis, sine, cosine)));
    }
    V3 axis = e.normalize(c.v3(2));
    Lowered turn = e.convert(lowered(BaseType::Float, e.f(1)), BaseType::Matrix);
    for (size_t row = 0; row < 3; ++row) {
        V3 unit = e.f3(0);
        unit[row] = e.f(1);
        V3 image = rotated(e, unit, axis, sine, cosine);
        for (size_t k = 0; k < 3; ++k) turn.c[row * 4 + k] = image[k];
    }
    c.result = e.multiply(turn, c.args[0]);
}

// |Du(p) du ^ Dv(p) dv|
void area(LowerCall& c) {
    auto& e = c.low;
    V3 along_u = e.scale(e.du(c.v3(0)), e.read_global(Global::du).c[0]);
    V3 along_v = e.scale(e.dv(c.v3(0)), e.read_global(Global::dv).c[0]);
    c.set(e.length(e.cross(along_u, along_v)));
}

// The incoming normal turned against I: N itself where I . Nref is 0 (docs/numerics.md#vectors).
void faceforward(LowerCall& c) {
    auto& e = c.low;
    V3 N = c.v3(0), I = c.v3(1);
    V3 reference = c.args.size() == 3 ? c.v3(2) : e.read_global(Global::Ng).v3();
    c.set(e.select(c.b.lt(e.f(0), e.dot(I, reference)), e.neg(N), N));
}

V3 reflected(Emitter& e, const V3& I, const V3& N) {
    return e.fma(N, e.mul(e.f(-2), e.dot(I, N)), I);
}
void reflect(LowerCall& c) {
    c.set(reflected(c.low, c.v3(0), c.v3(1)));
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
    c.set(refracted(c.low, c.v3(0), c.v3(1), c.f(2)).direction);
}

// Fresnel's equations for unpolarised light; I and N of length 1, eta the ratio of the outer to
// the inner index. Total reflection, grazing light and eta = 0 give kr = 1, kt = 0.
void fresnel(LowerCall& c) {
    auto& e = c.low;
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

// transform and its kin: ("to", x), ("from", "to", x), (m, x), ("from", m, x).
void transform(LowerCall& c) {
    auto& e = c.low;
    size_t last = c.args.size() - 1;
    Lowered x = c.args[last];
    x.type = c.result_type();
    for (size_t k = 0; k < last; ++k) {
        const Location& where = c.call.args[k]->span.where;
        if (c.args[k].type == BaseType::Matrix) {
            const Lowered& m = c.args[k];
            if (x.type == BaseType::Point)
                x = lowered(x.type, e.transform_point(x.v3(), m));
            else if (x.type == BaseType::Normal)
                x = lowered(x.type, e.transform_normal(x.v3(), e.invert(m)));
            else
                x = lowered(x.type, e.transform_vector(x.v3(), m));
        } else if (k + 1 < last) {
            x = e.to_current(x, e.space(c.args[k].c[0], where));
        } else {
            x = e.from_current(x, e.space(c.args[k].c[0], where));
        }
    }
    c.result = x;
}

// 0 at the near, 1 at the far clipping plane.
void depth(LowerCall& c) {
    auto camera = c.low.space(c.b.i(intern("camera")), c.where());
    V3 p = c.low.from_current(lowered(BaseType::Point, c.v3(0)), camera).v3();
    Value near = c.low.scalar_input("camera:near", jit::Type::F, jit::Rate::Frame);
    Value far = c.low.scalar_input("camera:far", jit::Type::F, jit::Rate::Frame);
    c.set(c.low.div(c.b.sub(p[2], near), c.b.sub(far, near)));
}

// Du(p) ^ Dv(p), turned so that for the unmodified P it points along Ng: the space may be mirrored,
// and the winding may run against u, v.
void calculatenormal(LowerCall& c) {
    c.set(c.low.normal_of(c.v3(0)));
}

}  // namespace lower_geometric

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
     "Distance of a point from a line segment: ptlined(q, p0, p1)."},
    {"rotate", "p=pfpp m=mfv", lower::rotate, KINORA_RSL_REF(ref::rotate), kPure, 8,
     "Rotates a point around the line p0 p1, or a matrix around an axis, by an angle in radians."},
    {"area", "f=p f=ps", lower::area, KINORA_RSL_REF(ref::area), kDerivative, 8,
     "Area of the shading point: length(Du(p) * du ^ Dv(p) * dv).",
     kSurface | kDisplacement | kVolume, "du dv"},
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
    {"transform", "p=sp p=ssp p=mp p=smp", lower::transform, KINORA_RSL_REF(ref::transform), kPure,
     8, "A point from one space to another: transform([from,] to, p)."},
    {"vtransform", "v=sv v=ssv v=mv v=smv", lower::transform, KINORA_RSL_REF(ref::vtransform),
     kPure, 8, "A vector from one space to another."},
    {"ntransform", "n=sn n=ssn n=mn n=smn", lower::transform, KINORA_RSL_REF(ref::ntransform),
     kPure, 8, "A normal from one space to another (inverse transpose)."},
    {"depth", "f=p", lower::depth, KINORA_RSL_REF(ref::depth), kPure, 8,
     "0 at the near, 1 at the far clipping plane."},
    {"calculatenormal", "n=p", lower::calculatenormal, KINORA_RSL_REF(ref::calculatenormal),
     kDerivative, 16,
     "Normal of the surface with positions p: Du(p) ^ Dv(p), oriented as Ng. Where a displacement "
     "only bends normals P changes as on a surface with the normal N: no faces show.",
     kSurface | kDisplacement | kVolume, "Ng"},
};

}  // namespace

std::span<const Builtin> builtins_geometric() {
    return kRows;
}

}  // namespace kinora::rsl
