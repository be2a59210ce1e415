// rsl/builtins/spaces.cpp: coordinate systems, and the normal of a surface.
#include "rsl/builtins/table.h"
#include "rsl/lower/builtin_call.h"
#include "rsl/reference/matrices_p.h"
#include "rsl/reference/reference_p.h"

namespace kinora::rsl {

namespace lower_spaces {

// transform and its kin: ("to", x), ("from", "to", x), (m, x), ("from", m, x).
void transform(LowerCall& c) {
    size_t last = c.args.size() - 1;
    Lowered x = c.args[last];
    x.type = c.result_type();
    for (size_t k = 0; k < last; ++k) {
        const Location& where = c.call.args[k]->span.where;
        if (c.args[k].type == BaseType::Matrix) {
            const Lowered& m = c.args[k];
            if (x.type == BaseType::Point)
                x = lowered(x.type, transform_point(c.e, x.v3(), m));
            else if (x.type == BaseType::Normal)
                x = lowered(x.type, transform_normal(c.e, x.v3(), invert(c.e, m)));
            else
                x = lowered(x.type, transform_vector(c.e, x.v3(), m));
        } else if (k + 1 < last) {
            x = c.spaces.to_current(x, c.spaces.space(c.args[k].c[0], where));
        } else {
            x = c.spaces.from_current(x, c.spaces.space(c.args[k].c[0], where));
        }
    }
    c.result = x;
}

// 0 at the near, 1 at the far clipping plane.
void depth(LowerCall& c) {
    auto camera = c.spaces.space(c.b.i(intern("camera")), c.where());
    V3 p = c.spaces.from_current(lowered(BaseType::Point, c.v3(0)), camera).v3();
    auto plane = [&](KeyKind kind) {
        return scalar_input(c.b, plain_key(kind), jit::Type::F, jit::Rate::Frame);
    };
    Value near = plane(KeyKind::CameraNear), far = plane(KeyKind::CameraFar);
    c.set(c.e.div(c.b.sub(p[2], near), c.b.sub(far, near)));
}

// Du(p) ^ Dv(p), turned so that for the unmodified P it points along Ng: the space may be mirrored,
// and the winding may run against u, v.
void calculatenormal(LowerCall& c) {
    c.set(c.globals.normal_of(c.v3(0)));
}

}  // namespace lower_spaces

namespace ref {
namespace {

template <class Real>
void transform(RefCall<Real>& c) {
    change_space(c, BaseType::Point);
}

template <class Real>
void vtransform(RefCall<Real>& c) {
    change_space(c, BaseType::Vector);
}

template <class Real>
void ntransform(RefCall<Real>& c) {
    change_space(c, BaseType::Normal);
}

template <class Real>
void depth(RefCall<Real>& c) {
    using Number = Dual<Real>;
    Number near(c.eval.number(plain_key(KeyKind::CameraNear), 0));
    Number far(c.eval.number(plain_key(KeyKind::CameraFar), 0));
    RefValue<Real> p = c.args[0];
    p.type = BaseType::Point;
    c.set((c.eval.out_of_layer(p).c[2] - near) / (far - near));  // along the camera's z
}

// Du(p) ^ Dv(p) on the side of Ng; its own derivatives are those of N as it came.
template <class Real>
void calculatenormal(RefCall<Real>& c) {
    c.set(c.eval.normal_of(c.v(0)));
}

}  // namespace
}  // namespace ref

namespace {

namespace lower = lower_spaces;

const Builtin kRows[] = {
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

std::span<const Builtin> builtins_spaces() {
    return kRows;
}

}  // namespace kinora::rsl
