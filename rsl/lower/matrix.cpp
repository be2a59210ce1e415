// rsl/lower/matrix.cpp: matrices of four rows, for row vectors.
#include "rsl/lower/values.h"

namespace kinora::rsl {

bool is_affine(Emitter& e, const Lowered& m) {
    float one = 0;
    return e.is_zero(m.c[3]) && e.is_zero(m.c[7]) && e.is_zero(m.c[11]) &&
           e.b.constant_f(m.c[15], &one) && one == 1;
}

V3 transform_point(Emitter& e, const V3& p, const Lowered& m) {
    auto column = [&](size_t k) {
        return e.fma(p[0], m.c[k], e.fma(p[1], m.c[4 + k], e.fma(p[2], m.c[8 + k], m.c[12 + k])));
    };
    V3 q = {column(0), column(1), column(2)};
    if (is_affine(e, m)) return q;
    Value w = column(3);
    return {e.div(q[0], w), e.div(q[1], w), e.div(q[2], w)};
}

V3 transform_vector(Emitter& e, const V3& v, const Lowered& m) {
    auto column = [&](size_t k) {
        return e.fma(v[0], m.c[k], e.fma(v[1], m.c[4 + k], e.mul(v[2], m.c[8 + k])));
    };
    return {column(0), column(1), column(2)};
}

V3 transform_normal(Emitter& e, const V3& n, const Lowered& inverse) {
    auto row = [&](size_t k) {
        return e.fma(n[0], inverse.c[4 * k],
                     e.fma(n[1], inverse.c[4 * k + 1], e.mul(n[2], inverse.c[4 * k + 2])));
    };
    return {row(0), row(1), row(2)};
}

Lowered multiply(Emitter& e, const Lowered& x, const Lowered& m) {
    Lowered r{BaseType::Matrix, {}};
    for (size_t i = 0; i < 4; ++i)
        for (size_t k = 0; k < 4; ++k)
            r.c[i * 4 + k] =
                e.fma(x.c[i * 4], m.c[k],
                      e.fma(x.c[i * 4 + 1], m.c[4 + k],
                            e.fma(x.c[i * 4 + 2], m.c[8 + k], e.mul(x.c[i * 4 + 3], m.c[12 + k]))));
    return r;
}

namespace {

// The 2x2 minors of the upper and lower two rows, as the Laplace expansion by pairs needs them.
struct Minors {
    std::array<Value, 6> upper, lower;
};

Minors minors(Emitter& e, const Lowered& m) {
    constexpr size_t kPairs[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
    Minors result{};
    auto minor = [&](size_t row, size_t i, size_t k) {
        return e.b.sub(e.mul(m.c[row * 4 + i], m.c[row * 4 + 4 + k]),
                       e.mul(m.c[row * 4 + k], m.c[row * 4 + 4 + i]));
    };
    for (size_t p = 0; p < 6; ++p) {
        result.upper[p] = minor(0, kPairs[p][0], kPairs[p][1]);
        result.lower[p] = minor(2, kPairs[p][0], kPairs[p][1]);
    }
    return result;
}

Value determinant_of(Emitter& e, const Minors& n) {
    Value d = e.mul(n.upper[0], n.lower[5]);
    d = e.fma(e.b.neg(n.upper[1]), n.lower[4], d);
    d = e.fma(n.upper[2], n.lower[3], d);
    d = e.fma(n.upper[3], n.lower[2], d);
    d = e.fma(e.b.neg(n.upper[4]), n.lower[1], d);
    return e.fma(n.upper[5], n.lower[0], d);
}

}  // namespace

Value determinant(Emitter& e, const Lowered& m) {
    return determinant_of(e, minors(e, m));
}

// By cofactors; a singular matrix gives 0, by RSL's division.
Lowered invert(Emitter& e, const Lowered& m) {
    Minors n = minors(e, m);
    Value scale = e.div(e.b.f(1), determinant_of(e, n));
    auto& s = n.upper;
    auto& c = n.lower;
    // a*x - b*y + d*z
    auto cofactor = [&](size_t i, Value x, size_t j, Value y, size_t k, Value z) {
        Value sum = e.fma(m.c[k], z, e.fma(e.b.neg(m.c[j]), y, e.mul(m.c[i], x)));
        return e.mul(sum, scale);
    };
    auto negative = [&](Value v) { return e.b.neg(v); };
    Lowered r{BaseType::Matrix, {}};
    r.c[0] = cofactor(5, c[5], 6, c[4], 7, c[3]);
    r.c[1] = negative(cofactor(1, c[5], 2, c[4], 3, c[3]));
    r.c[2] = cofactor(13, s[5], 14, s[4], 15, s[3]);
    r.c[3] = negative(cofactor(9, s[5], 10, s[4], 11, s[3]));
    r.c[4] = negative(cofactor(4, c[5], 6, c[2], 7, c[1]));
    r.c[5] = cofactor(0, c[5], 2, c[2], 3, c[1]);
    r.c[6] = negative(cofactor(12, s[5], 14, s[2], 15, s[1]));
    r.c[7] = cofactor(8, s[5], 10, s[2], 11, s[1]);
    r.c[8] = cofactor(4, c[4], 5, c[2], 7, c[0]);
    r.c[9] = negative(cofactor(0, c[4], 1, c[2], 3, c[0]));
    r.c[10] = cofactor(12, s[4], 13, s[2], 15, s[0]);
    r.c[11] = negative(cofactor(8, s[4], 9, s[2], 11, s[0]));
    r.c[12] = negative(cofactor(4, c[3], 5, c[1], 6, c[0]));
    r.c[13] = cofactor(0, c[3], 1, c[1], 2, c[0]);
    r.c[14] = negative(cofactor(12, s[3], 13, s[1], 14, s[0]));
    r.c[15] = cofactor(8, s[3], 9, s[1], 10, s[0]);
    return r;
}

}  // namespace kinora::rsl
