// rsl/reference/dual_p.h: numbers that carry their derivatives along u and v, and RSL's arithmetic
// on them. Comparisons and conversions look at the value alone.
#pragma once

#include <cfloat>
#include <cmath>

namespace kinora::rsl {

template <class Real>
struct Dual {
    Real x = 0, u = 0, v = 0;
    Dual() = default;
    Dual(Real value) : x(value) {}
    Dual(Real value, Real by_u, Real by_v) : x(value), u(by_u), v(by_v) {}
};

// f(a), where slope = f'(a)
template <class Real>
Dual<Real> chain(const Dual<Real>& a, Real value, Real slope) {
    // A constant stays one even where the slope is infinite.
    return {value, a.u == 0 ? 0 : slope * a.u, a.v == 0 ? 0 : slope * a.v};
}

template <class Real>
Dual<Real> operator+(const Dual<Real>& a, const Dual<Real>& b) {
    return {a.x + b.x, a.u + b.u, a.v + b.v};
}
template <class Real>
Dual<Real> operator-(const Dual<Real>& a, const Dual<Real>& b) {
    return {a.x - b.x, a.u - b.u, a.v - b.v};
}
template <class Real>
Dual<Real> operator-(const Dual<Real>& a) {
    return {-a.x, -a.u, -a.v};
}
template <class Real>
Dual<Real> operator*(const Dual<Real>& a, const Dual<Real>& b) {
    return {a.x * b.x, a.u * b.x + a.x * b.u, a.v * b.x + a.x * b.v};
}
template <class Real>
Dual<Real> operator*(Real k, const Dual<Real>& a) {
    return {k * a.x, k * a.u, k * a.v};
}
// RSL's division (docs/numerics.md#division): 0 where the divisor is 0 or subnormal.
template <class Real>
Dual<Real> operator/(const Dual<Real>& a, const Dual<Real>& b) {
    if (std::fabs(b.x) < Real(FLT_MIN)) return {};
    Real q = a.x / b.x;
    return {q, (a.u - q * b.u) / b.x, (a.v - q * b.v) / b.x};
}
template <class Real>
bool operator<(const Dual<Real>& a, const Dual<Real>& b) {
    return a.x < b.x;
}
template <class Real>
Dual<Real> constant(const Dual<Real>& a) {
    return {a.x, 0, 0};
}

template <class Real>
Dual<Real> abs(const Dual<Real>& a) {
    return a.x < 0 ? -a : Dual<Real>(std::fabs(a.x), a.u, a.v);
}
// a < b ? a : b, so that b wins against NaN
template <class Real>
Dual<Real> min(const Dual<Real>& a, const Dual<Real>& b) {
    return a.x < b.x ? a : b;
}
template <class Real>
Dual<Real> max(const Dual<Real>& a, const Dual<Real>& b) {
    return a.x > b.x ? a : b;
}
template <class Real>
Dual<Real> clamp(const Dual<Real>& x, const Dual<Real>& lo, const Dual<Real>& hi) {
    return x.x < lo.x ? lo : min(max(x, lo), hi);
}
template <class Real>
Dual<Real> sqrt(const Dual<Real>& a) {
    if (a.x < 0) return {};  // docs/numerics.md#powers-roots-logarithms
    Real r = std::sqrt(a.x);
    return chain(a, r, r == 0 ? 0 : Real(0.5) / r);
}
template <class Real>
Dual<Real> sin(const Dual<Real>& a) {
    return chain(a, std::sin(a.x), std::cos(a.x));
}
template <class Real>
Dual<Real> cos(const Dual<Real>& a) {
    return chain(a, std::cos(a.x), -std::sin(a.x));
}
template <class Real>
Dual<Real> tan(const Dual<Real>& a) {
    Real t = std::tan(a.x);
    return chain(a, t, 1 + t * t);
}
template <class Real>
Dual<Real> asin(const Dual<Real>& a) {  // docs/numerics.md#arcs
    if (std::fabs(a.x) >= 1) return std::copysign(std::asin(Real(1)), a.x);
    return chain(a, std::asin(a.x), 1 / std::sqrt(1 - a.x * a.x));
}
template <class Real>
Dual<Real> acos(const Dual<Real>& a) {
    if (std::fabs(a.x) >= 1) return a.x > 0 ? Real(0) : std::acos(Real(-1));
    return chain(a, std::acos(a.x), -1 / std::sqrt(1 - a.x * a.x));
}
template <class Real>
Dual<Real> atan2(const Dual<Real>& y, const Dual<Real>& x) {
    if (x.x == 0 && y.x == 0) return {};  // docs/numerics.md#arcs
    Real n = x.x * x.x + y.x * y.x;
    return {std::atan2(y.x, x.x), (y.u * x.x - x.u * y.x) / n, (y.v * x.x - x.v * y.x) / n};
}
template <class Real>
Dual<Real> exp(const Dual<Real>& a) {
    Real e = std::exp(a.x);
    return chain(a, e, e);
}
template <class Real>
Dual<Real> log(const Dual<Real>& a) {  // docs/numerics.md#powers-roots-logarithms
    if (a.x < Real(FLT_MIN)) return std::log(Real(FLT_MIN));
    return chain(a, std::log(a.x), 1 / a.x);
}
// Rows 44 to 46: a negative x to a power that is no whole number is 0, 0 to a negative power too.
template <class Real>
Dual<Real> pow(const Dual<Real>& a, const Dual<Real>& b) {
    if (a.x == 0 && b.x < 0) return {};
    if (a.x < 0 && std::floor(b.x) != b.x) return {};
    // docs/numerics.md#powers-roots-logarithms: a NaN power gives NaN; the C library gives 1 for 1.
    Real p = std::isnan(b.x) ? b.x : std::pow(a.x, b.x);
    Real by_a = b.x == 0 ? 0 : b.x * std::pow(a.x, b.x - 1);
    Real by_b = a.x > 0 ? p * std::log(a.x) : 0;
    auto along = [&](Real da, Real db) {
        return (da == 0 ? 0 : by_a * da) + (db == 0 ? 0 : by_b * db);
    };
    return {p, along(a.u, b.u), along(a.v, b.v)};
}

}  // namespace kinora::rsl
