// jit/math/expr_p.h: formulas over IR values with the usual operators, for jit/math*.cpp.
// `a * b + c` here is two rounded operations, as everywhere (docs/decisions.md#exact-arithmetic); a
// fused one is written fma(a, b, c).
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "jit/ir/builder.h"
#include "jit/math/math.h"

namespace kinora::jit::math {

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

// A float, int or mask value together with the builder that holds it.
struct Num {
    Builder* b;
    Value v;
};
struct Int {
    Builder* b;
    Value v;
};
struct Mask {
    Builder* b;
    Value v;
};

inline Num num(Num like, float c) {
    return {like.b, like.b->f(c)};
}
inline Int integer(Int like, int32_t c) {
    return {like.b, like.b->i(c)};
}

inline Num operator+(Num a, Num b) {
    return {a.b, a.b->add(a.v, b.v)};
}
inline Num operator-(Num a, Num b) {
    return {a.b, a.b->sub(a.v, b.v)};
}
inline Num operator*(Num a, Num b) {
    return {a.b, a.b->mul(a.v, b.v)};
}
inline Num operator/(Num a, Num b) {
    return {a.b, a.b->div(a.v, b.v)};
}
inline Num operator-(Num a) {
    return {a.b, a.b->neg(a.v)};
}
inline Num operator+(Num a, float b) {
    return a + num(a, b);
}
inline Num operator-(Num a, float b) {
    return a - num(a, b);
}
inline Num operator*(Num a, float b) {
    return a * num(a, b);
}
inline Num operator+(float a, Num b) {
    return num(b, a) + b;
}
inline Num operator-(float a, Num b) {
    return num(b, a) - b;
}
inline Num operator*(float a, Num b) {
    return num(b, a) * b;
}
inline Num operator/(float a, Num b) {
    return num(b, a) / b;
}
inline Num fma(Num a, Num b, Num c) {
    return {a.b, a.b->fma(a.v, b.v, c.v)};
}
inline Num fma(Num a, float b, Num c) {
    return fma(a, num(a, b), c);
}
inline Num fma(Num a, Num b, float c) {
    return fma(a, b, num(a, c));
}
inline Num fma(Num a, float b, float c) {
    return fma(a, num(a, b), num(a, c));
}
inline Num abs(Num a) {
    return {a.b, a.b->abs(a.v)};
}
inline Num sqrt(Num a) {
    return {a.b, a.b->sqrt(a.v)};
}
inline Num floor(Num a) {
    return {a.b, a.b->floor(a.v)};
}
// If either is NaN these give b: at_least(1, x) keeps a NaN x, at_least(x, 1) drops it.
inline Num at_least(Num a, Num b) {
    return {a.b, a.b->max(a.v, b.v)};
}
inline Num at_most(Num a, Num b) {
    return {a.b, a.b->min(a.v, b.v)};
}

inline Int operator+(Int a, Int b) {
    return {a.b, a.b->iadd(a.v, b.v)};
}
inline Int operator-(Int a, Int b) {
    return {a.b, a.b->isub(a.v, b.v)};
}
inline Int operator*(Int a, Int b) {
    return {a.b, a.b->imul(a.v, b.v)};
}
inline Int operator&(Int a, Int b) {
    return {a.b, a.b->iand(a.v, b.v)};
}
inline Int operator^(Int a, Int b) {
    return {a.b, a.b->ixor(a.v, b.v)};
}
inline Int operator+(Int a, int32_t b) {
    return a + integer(a, b);
}
inline Int operator-(Int a, int32_t b) {
    return a - integer(a, b);
}
inline Int operator*(Int a, int32_t b) {
    return a * integer(a, b);
}
inline Int operator&(Int a, int32_t b) {
    return a & integer(a, b);
}
inline Int operator^(Int a, int32_t b) {
    return a ^ integer(a, b);
}
inline Int operator<<(Int a, int n) {
    return {a.b, a.b->shl(a.v, n)};
}
inline Int shift_right(Int a, int n) {
    return {a.b, a.b->shr(a.v, n)};
}  // zeros enter
inline Int shift_right_signed(Int a, int n) {
    return {a.b, a.b->sar(a.v, n)};
}  // the sign enters
inline Int bits(Num a) {
    return {a.b, a.b->bits(a.v)};
}
inline Num from_bits(Int a) {
    return {a.b, a.b->from_bits(a.v)};
}
inline Int truncate(Num a) {
    return {a.b, a.b->ftoi(a.v)};
}
inline Num to_float(Int a) {
    return {a.b, a.b->itof(a.v)};
}

inline Mask operator<(Num a, Num b) {
    return {a.b, a.b->lt(a.v, b.v)};
}
inline Mask operator<(Num a, float b) {
    return a < num(a, b);
}
inline Mask operator<(float a, Num b) {
    return num(b, a) < b;
}
inline Mask operator==(Num a, Num b) {
    return {a.b, a.b->eq(a.v, b.v)};
}
inline Mask operator==(Num a, float b) {
    return a == num(a, b);
}
inline Mask operator<=(Num a, float b) {
    return {a.b, a.b->le(a.v, num(a, b).v)};
}
inline Mask operator==(Int a, int32_t b) {
    return {a.b, a.b->op(Op::IEq, a.v, a.b->i(b))};
}
inline Mask operator<(Int a, int32_t b) {
    return {a.b, a.b->op(Op::ILt, a.v, a.b->i(b))};
}
inline Mask bit_set(Int a, int bit) {
    return {a.b, a.b->logical_not(((a & (1 << bit)) == 0).v)};
}
inline Mask operator!(Mask a) {
    return {a.b, a.b->logical_not(a.v)};
}
inline Num select(Mask m, Num a, Num b) {
    return {a.b, a.b->select(m.v, a.v, b.v)};
}
inline Num select(Mask m, float a, Num b) {
    return select(m, num(b, a), b);
}
inline Num select(Mask m, Num a, float b) {
    return select(m, a, num(a, b));
}
inline Int select(Mask m, Int a, Int b) {
    return {a.b, a.b->select(m.v, a.v, b.v)};
}
inline Num merge(Num inner, Num outer) {
    return {outer.b, outer.b->merge(inner.v, outer.v)};
}
inline Int merge(Int inner, Int outer) {
    return {outer.b, outer.b->merge(inner.v, outer.v)};
}

// a with its sign flipped where bit 31 of sign is set.
inline Num flip_sign(Num a, Int sign) {
    return from_bits(bits(a) ^ sign);
}
inline Int sign_bit(Num a) {
    return bits(a) & INT32_MIN;
}

// c[0] + x c[1] + x^2 c[2] + ...
template <size_t N>
Num horner(Num x, const float (&c)[N]) {
    Num sum = num(x, c[N - 1]);
    for (size_t i = N - 1; i-- > 0;) sum = fma(sum, x, c[i]);
    return sum;
}

// Adding and subtracting it rounds to an integer, left in the low bits of the sum.
inline constexpr float kRoundingMagic = 12582912.0f;  // 1.5 * 2^23

// Calls the function `name` of the module with `args`, after writing it by body(params) when the
// module does not have it yet. All parameters are floats; `types` are those of the results.
template <class Body>
std::vector<Value> call_function(Builder& b, const std::string& name, std::vector<Type> types,
                                 Value mask, std::span<const Value> args, Body body) {
    Module& module = b.module();
    size_t index = 0;
    while (index < module.functions.size() && module.functions[index].name != name) ++index;
    if (index == module.functions.size()) {
        index = add_function(module, name, std::move(types));
        Builder inner(module, index);
        std::vector<Num> params;
        for (size_t i = 0; i < args.size(); ++i) params.push_back({&inner, inner.param(Type::F)});
        inner.ret(body(std::span<const Num>(params)));
    }
    return b.call(index, mask, args);
}

// The same for the usual case: one float result, one function for each tier ("sin.p", "sin.f").
template <class Body>
Value call_tiered(Builder& b, const char* name, Tier tier, std::initializer_list<Value> args,
                  Body body) {
    std::string full = std::string(name) + (tier == Tier::Precise ? ".p" : ".f");
    auto write = [&](std::span<const Num> p) { return std::vector<Value>{body(p).v}; };
    std::span<const Value> arguments(args.begin(), args.size());
    return call_function(b, full, {Type::F}, b.m(true), arguments, write)[0];
}

}  // namespace kinora::jit::math
