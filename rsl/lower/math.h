// rsl/lower/math.h: RSL's arithmetic as IR: the rules that differ from the IR's own ops (division,
// powers, zero vectors) and the vector formulas that several built-ins share.
#pragma once

#include <array>
#include <span>
#include <string>

#include "jit/ir/builder.h"
#include "jit/math/math.h"
#include "rsl/syntax/types.h"

namespace kinora::rsl {

using jit::Value;
using V3 = std::array<Value, 3>;

// One RSL value as IR values: component_count(type) of them. Matrices are row-major for row
// vectors, as in the source: p' = p * m. Strings are intern ids, Bools masks.
struct Lowered {
    BaseType type = BaseType::Void;
    std::array<Value, 16> c{};

    int size() const { return component_count(type); }
    V3 v3() const { return {c[0], c[1], c[2]}; }
};
inline Lowered lowered(BaseType type, Value x) {
    return {type, {x}};
}
inline Lowered lowered(BaseType type, const V3& v) {
    return {type, {v[0], v[1], v[2]}};
}

// Writes arithmetic at the builder's end. `running` is the mask of the lanes that execute.
class Emitter {
  public:
    Emitter(jit::Builder& builder, jit::math::Tier math_tier) : b(builder), tier(math_tier) {
        running = b.m(true);
    }

    jit::Builder& b;
    const jit::math::Tier tier;
    Value running;

    bool precise() const { return tier == jit::math::Tier::Precise; }
    Value f(float x) { return b.f(x); }
    V3 f3(float x) { return {b.f(x), b.f(x), b.f(x)}; }
    bool is_zero(Value v);
    // The text of a string id that is known, else null.
    const std::string* constant_text(Value string_id);
    // Bool to float: 1 or 0.
    Value flag(Value mask) { return b.select(mask, b.f(1), b.f(0)); }

    // x * 0 is 0 (docs/decisions.md#specialise-on-shape-only), so fma(x, 0, c) is c.
    Value mul(Value x, Value y);
    Value fma(Value x, Value y, Value z);
    // RSL's division: 0 where |y| < FLT_MIN (docs/numerics.md#division).
    Value div(Value x, Value y);
    Value clamp(Value x, Value low, Value high) { return b.min(b.max(x, low), high); }
    Value limited(Value x, Value low,
                  Value high);  // the same; below `low` it is low, though > high
    // Exact at alpha 0 and 1.
    Value mix(Value x, Value y, Value alpha) { return fma(y, alpha, mul(x, b.sub(b.f(1), alpha))); }
    Value sqrt(Value x);                   // 0 for negative x
    Value pow(Value x, Value y);           // any x: docs/numerics.md#powers-roots-logarithms
    Value pow_positive(Value x, Value y);  // x >= 0
    Value mod(Value x, Value y);           // docs/numerics.md#modulo
    Value smoothstep(Value low, Value high, Value x);
    // floor(x) as an int, for 0 <= x < length; anything outside is clamped, NaN gives 0.
    Value index(Value x, int length);

    V3 add(const V3& x, const V3& y);
    V3 sub(const V3& x, const V3& y);
    V3 mul(const V3& x, const V3& y);
    V3 scale(const V3& x, Value k);
    V3 fma(const V3& x, Value k, const V3& z);  // x * k + z
    V3 neg(const V3& x);
    V3 select(Value mask, const V3& x, const V3& y);
    Value dot(const V3& x, const V3& y);
    V3 cross(const V3& x, const V3& y);
    Value length(const V3& x);                                 // docs/numerics.md#vectors
    V3 normalize(const V3& x);                                 // docs/numerics.md#vectors
    V3 du(const V3& x) { return derivative(jit::Op::Du, x); }  // of all components
    V3 dv(const V3& x) { return derivative(jit::Op::Dv, x); }

    // Where `mask`: the values `body` returns, else `outer`; body's code runs only when some lane
    // needs it.
    template <class Body>
    void rarely(Value mask, std::span<Value> values, Body&& body);

  private:
    V3 derivative(jit::Op op, const V3& x) {
        return {b.op(op, x[0]), b.op(op, x[1]), b.op(op, x[2])};
    }
    // x scaled by a power of two so that its square neither over- nor underflows, its squared
    // length, and (if wanted) what undoes the scale.
    struct Scaled {
        V3 x;
        Value squared;
        Value unscale;
    };
    Scaled scaled(const V3& x, bool want_unscale);
};

template <class Body>
void Emitter::rarely(Value mask, std::span<Value> values, Body&& body) {
    bool known;
    if (b.constant_m(mask, &known) && !known) return;
    b.begin_if(mask);
    std::array<Value, 16> inner{};
    body(std::span<Value>(inner.data(), values.size()));
    b.end_if();
    for (size_t i = 0; i < values.size(); ++i) values[i] = b.merge(inner[i], values[i]);
}

}  // namespace kinora::rsl
