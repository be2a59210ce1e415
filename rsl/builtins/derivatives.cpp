// rsl/builtins/derivatives.cpp: derivatives along u and v.
#include "rsl/builtins/table.h"
#include "rsl/lower/builtin_call.h"
#include "rsl/reference/components_p.h"
#include "rsl/reference/reference_p.h"

namespace kinora::rsl {

namespace lower_derivatives {

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
        Value by_u = c.e.div(c.b.op(jit::Op::Du, c.args[0].c[k]), du);
        Value by_v = c.e.div(c.b.op(jit::Op::Dv, c.args[0].c[k]), dv);
        r.c[k] = c.b.add(by_u, by_v);
    }
    c.result = r;
}

}  // namespace lower_derivatives

namespace ref {
namespace {

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

}  // namespace
}  // namespace ref

namespace {

namespace lower = lower_derivatives;

const Builtin kRows[] = {
    {"Du", "f=f c=c v=p v=v v=n", lower::derivative<jit::Op::Du>, KINORA_RSL_REF(ref::Du),
     kDerivative, 8, "Derivative along u.", kSurface | kDisplacement | kVolume},
    {"Dv", "f=f c=c v=p v=v v=n", lower::derivative<jit::Op::Dv>, KINORA_RSL_REF(ref::Dv),
     kDerivative, 8, "Derivative along v.", kSurface | kDisplacement | kVolume},
    {"Deriv", "f=ff c=cf v=pf v=vf v=nf", lower::total_derivative, KINORA_RSL_REF(ref::Deriv),
     kDerivative, 8, "Du(a) / Du(b) + Dv(a) / Dv(b).", kSurface | kDisplacement | kVolume},
};

}  // namespace

std::span<const Builtin> builtins_derivatives() {
    return kRows;
}

}  // namespace kinora::rsl
