// rsl/lower/math.cpp: RSL's arithmetic as IR.
#include "rsl/lower/math.h"

#include <cfloat>
#include <cmath>

#include "rsl/model/renderer_services.h"

namespace kinora::rsl {

bool Emitter::is_zero(Value v) {
    float x;
    return b.constant_f(v, &x) && x == 0;
}

const std::string* Emitter::constant_text(Value string_id) {
    int32_t id;
    return b.constant_i(string_id, &id) ? &interned(id) : nullptr;
}

Value Emitter::mul(Value x, Value y) {
    return is_zero(x) || is_zero(y) ? b.f(0) : b.mul(x, y);
}

Value Emitter::fma(Value x, Value y, Value z) {
    if (is_zero(x) || is_zero(y)) return z;
    return is_zero(z) ? b.mul(x, y) : b.fma(x, y, z);
}

Value Emitter::div(Value x, Value y) {
    float divisor;
    if (is_zero(x)) return b.f(0);
    if (!b.constant_f(y, &divisor))
        return b.select(b.lt(b.abs(y), b.f(FLT_MIN)), b.f(0), b.div(x, y));
    float size = std::fabs(divisor);
    if (size < FLT_MIN) return b.f(0);
    // The fast tier multiplies by the reciprocal, 1.5 ULP, unless that is subnormal.
    bool multiply = !precise() && size <= 0x1p126f;
    return multiply ? b.mul(x, b.f(1 / divisor)) : b.div(x, y);
}

Value Emitter::sqrt(Value x) {
    // NaN stays NaN: max(x, 0) would make it 0.
    return b.select(b.lt(x, b.f(0)), b.f(0), b.sqrt(x));
}

Value Emitter::pow(Value x, Value y) {
    float k;
    if (b.constant_f(y, &k)) {  // whole powers are exact for any sign
        if (k == 0) return b.f(1);
        if (k == 1) return x;
        if (k == 2) return b.mul(x, x);
    }
    Value p = pow_positive(b.abs(x), y);  // 0 to a negative power is 0
    Value whole = b.eq(b.floor(y), y);
    Value half = b.mul(y, b.f(0.5f));
    Value odd = b.ne(b.floor(half), half);
    Value negative = b.select(whole, b.select(odd, b.neg(p), p), b.f(0));
    return b.select(b.lt(x, b.f(0)), negative, p);
}

Value Emitter::pow_positive(Value x, Value y) {
    Value p = jit::math::pow(b, x, y, tier);
    float k;
    if (b.constant_f(y, &k) && k >= 0) return p;
    return b.select(b.logical_and(b.eq(x, b.f(0)), b.lt(y, b.f(0))), b.f(0), p);
}

Value Emitter::mod(Value x, Value y) {
    Value turns = b.floor(b.div(x, y));  // the last line has an eye on y = 0
    Value r = b.fma(b.neg(y), turns, x);
    // An infinite y times no turn is 0, not NaN: mod(x, infinity) is x.
    float divisor;
    if (!b.constant_f(y, &divisor) || std::isinf(divisor)) r = b.select(b.eq(turns, b.f(0)), x, r);
    // A quotient beyond 2^24 has no fraction and leaves junk: keep the result in [0, y).
    Value below = b.select(b.lt(y, b.f(0)), b.lt(b.f(0), r), b.lt(r, b.f(0)));
    Value beyond = b.le(b.abs(y), b.abs(r));
    r = b.select(b.logical_or(below, beyond), b.f(0), r);
    return b.select(b.lt(b.abs(y), b.f(FLT_MIN)), b.f(0), r);
}

Value Emitter::smoothstep(Value low, Value high, Value x) {
    Value t = clamp(div(b.sub(x, low), b.sub(high, low)), b.f(0), b.f(1));
    Value ramp = b.mul(b.mul(t, t), b.fma(b.f(-2), t, b.f(3)));
    // Known edges in order: clamping alone makes it 0 below (and for NaN) and 1 above.
    float from, to;
    if (b.constant_f(low, &from) && b.constant_f(high, &to) && to - from >= FLT_MIN &&
        to - from <= FLT_MAX)
        return ramp;
    Value above = b.select(b.ge(x, high), b.f(1), ramp);
    return b.select(b.lt(x, low), b.f(0), above);
}

// RISpec's clamp(): the lower limit is asked first.
Value Emitter::limited(Value x, Value low, Value high) {
    float from, to;
    Value inside = clamp(x, low, high);
    if (b.constant_f(low, &from) && b.constant_f(high, &to) && from <= to) return inside;
    return b.select(b.lt(x, low), low, inside);
}

Value Emitter::index(Value x, int length) {
    // max(NaN, 0) is 0: no NaN reaches the conversion.
    return b.ftoi(b.min(b.max(x, b.f(0)), b.f(float(length - 1))));
}

V3 Emitter::add(const V3& x, const V3& y) {
    return {b.add(x[0], y[0]), b.add(x[1], y[1]), b.add(x[2], y[2])};
}
V3 Emitter::sub(const V3& x, const V3& y) {
    return {b.sub(x[0], y[0]), b.sub(x[1], y[1]), b.sub(x[2], y[2])};
}
V3 Emitter::mul(const V3& x, const V3& y) {
    return {mul(x[0], y[0]), mul(x[1], y[1]), mul(x[2], y[2])};
}
V3 Emitter::scale(const V3& x, Value k) {
    return {mul(x[0], k), mul(x[1], k), mul(x[2], k)};
}
V3 Emitter::fma(const V3& x, Value k, const V3& z) {
    return {fma(x[0], k, z[0]), fma(x[1], k, z[1]), fma(x[2], k, z[2])};
}
V3 Emitter::neg(const V3& x) {
    return {b.neg(x[0]), b.neg(x[1]), b.neg(x[2])};
}
V3 Emitter::select(Value mask, const V3& x, const V3& y) {
    return {b.select(mask, x[0], y[0]), b.select(mask, x[1], y[1]), b.select(mask, x[2], y[2])};
}

Value Emitter::dot(const V3& x, const V3& y) {
    return fma(x[0], y[0], fma(x[1], y[1], mul(x[2], y[2])));
}

// Without Fma, so that the cross product of parallel vectors is exactly 0.
V3 Emitter::cross(const V3& x, const V3& y) {
    return {b.sub(mul(x[1], y[2]), mul(x[2], y[1])), b.sub(mul(x[2], y[0]), mul(x[0], y[2])),
            b.sub(mul(x[0], y[1]), mul(x[1], y[0]))};
}

Emitter::Scaled Emitter::scaled(const V3& x, bool want_unscale) {
    Value squared = dot(x, x);
    if (!precise()) return {x, squared, b.f(1)};
    Value inside = b.logical_and(b.le(b.f(1e-30f), squared), b.le(squared, b.f(1e30f)));
    Value rare = b.and_not(running, inside);
    std::array<Value, 5> values = {x[0], x[1], x[2], squared, b.f(1)};
    rarely(rare, std::span(values.data(), want_unscale ? 5 : 4), [&](std::span<Value> inner) {
        Value small = b.lt(squared, b.f(1));
        Value k = b.select(small, b.f(0x1p96f), b.f(0x1p-96f));
        V3 y = {b.mul(x[0], k), b.mul(x[1], k), b.mul(x[2], k)};
        for (int i = 0; i < 3; ++i) inner[i] = y[i];
        inner[3] = dot(y, y);
        if (want_unscale) inner[4] = b.select(small, b.f(0x1p-96f), b.f(0x1p96f));
    });
    return {{values[0], values[1], values[2]}, values[3], values[4]};
}

Value Emitter::length(const V3& x) {
    Scaled s = scaled(x, true);
    return b.mul(b.sqrt(s.squared), s.unscale);
}

V3 Emitter::normalize(const V3& x) {
    Scaled s = scaled(x, false);
    // sqrt and division round correctly: as exact as an inverse square root made from them.
    Value inverse = b.div(b.f(1), b.sqrt(s.squared));
    return scale(s.x, b.select(b.lt(b.f(0), s.squared), inverse, b.f(0)));
}

}  // namespace kinora::rsl
