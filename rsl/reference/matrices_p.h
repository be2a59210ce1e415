// rsl/reference/matrices_p.h: matrices at one point, for row vectors.
#pragma once

#include "rsl/reference/reference_p.h"

namespace kinora::rsl {

template <class Real>
using Matrix = std::array<Dual<Real>, 16>;

template <class Real>
Matrix<Real> identity() {
    Matrix<Real> m{};
    for (size_t k = 0; k < 4; ++k) m[k * 5] = Real(1);
    return m;
}

template <class Real>
Matrix<Real> product(const Matrix<Real>& a, const Matrix<Real>& b) {
    Matrix<Real> r{};
    for (size_t i = 0; i < 4; ++i)
        for (size_t j = 0; j < 4; ++j)
            for (size_t k = 0; k < 4; ++k)
                r[i * 4 + j] = r[i * 4 + j] + a[i * 4 + k] * b[k * 4 + j];
    return r;
}

// By the first row, and so on for the minors.
template <class Real>
Dual<Real> determinant_of(const std::vector<Dual<Real>>& m, size_t n) {
    if (n == 1) return m[0];
    Dual<Real> sum;
    for (size_t j = 0; j < n; ++j) {
        std::vector<Dual<Real>> minor;
        for (size_t i = 1; i < n; ++i)
            for (size_t k = 0; k < n; ++k)
                if (k != j) minor.push_back(m[i * n + k]);
        Dual<Real> term = m[j] * determinant_of(minor, n - 1);
        sum = j % 2 ? sum - term : sum + term;
    }
    return sum;
}

// Cramer's rule; 0 for a singular matrix, by RSL's division.
template <class Real>
Matrix<Real> inverse_of(const Matrix<Real>& m) {
    Dual<Real> d = determinant_of(std::vector(m.begin(), m.end()), 4);
    Matrix<Real> r;
    for (size_t i = 0; i < 4; ++i)
        for (size_t j = 0; j < 4; ++j) {
            std::vector<Dual<Real>> minor;
            for (size_t a = 0; a < 4; ++a)
                for (size_t b = 0; b < 4; ++b)
                    if (a != i && b != j) minor.push_back(m[a * 4 + b]);
            Dual<Real> cofactor = determinant_of(minor, 3) / d;
            r[j * 4 + i] = (i + j) % 2 ? -cofactor : cofactor;
        }
    return r;
}

template <class Real>
Matrix<Real> matrix(const RefValue<Real>& a) {
    return a.c;
}

// RenderMan's rotation by the right hand, for row vectors.
template <class Real>
Matrix<Real> rotation(const Dual<Real>& angle, const Vec<Real>& axis) {
    Vec<Real> a = normalize(axis);
    Dual<Real> s = sin(angle), k = Dual<Real>(1) - cos(angle);
    Matrix<Real> m = identity<Real>();
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j) m[i * 4 + j] = k * a[i] * a[j];
    for (size_t i = 0; i < 3; ++i) m[i * 5] = m[i * 5] + cos(angle);
    size_t next[] = {1, 2, 0};
    for (size_t i = 0; i < 3; ++i) {
        size_t j = next[i], l = next[j];
        m[i * 4 + j] = m[i * 4 + j] + s * a[l];
        m[j * 4 + i] = m[j * 4 + i] - s * a[l];
    }
    return m;
}

template <class Real>
RefValue<Real> moved(const Matrix<Real>& m) {
    RefValue<Real> r(BaseType::Matrix);
    r.c = m;
    return r;
}

namespace ref {

// transform(to, x), (from, to, x), (m, x), (from, m, x); the result has the function's type.
template <class Real>
void change_space(RefCall<Real>& c, BaseType type) {
    RefValue<Real> x = c.args.back();
    x.type = type;
    const RefValue<Real>& last = c.args[c.args.size() - 2];
    std::string from = c.args.size() == 3 ? c.text(0) : "current";
    if (last.type == BaseType::String) {
        c.result = c.eval.to_space(x, from, last.text());
        return;
    }
    x = c.eval.by_matrix(x, c.eval.space(from, "to_current"));
    c.result = c.eval.by_matrix(x, last.c);
}

}  // namespace ref
}  // namespace kinora::rsl
