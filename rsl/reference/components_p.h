// rsl/reference/components_p.h: meanings of built-ins that work on each component of their
// arguments.
#pragma once

#include "rsl/reference/reference_p.h"

namespace kinora::rsl::ref {

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

}  // namespace kinora::rsl::ref
