// jit/ir/scalar_p.h: the meaning of every pure arithmetic op on one lane, as ops.def states it. The
// interpreter runs these sixteen at a time, folding runs them once.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace kinora::jit::scalar {

// One type per IR type, so that a function's signature tells how its operands are read. A mask
// lane is all ones or zero.
struct Mask {
    int32_t bits;
    Mask() = default;
    constexpr explicit Mask(bool set) : bits(-static_cast<int32_t>(set)) {}
    static constexpr Mask of(int32_t bits) {
        Mask m(false);
        m.bits = bits;
        return m;
    }
};

inline uint32_t u(int32_t x) {
    return static_cast<uint32_t>(x);
}
inline int32_t s(uint32_t x) {
    return static_cast<int32_t>(x);
}

inline float Add(float a, float b) {
    return a + b;
}
inline float Sub(float a, float b) {
    return a - b;
}
inline float Mul(float a, float b) {
    return a * b;
}
inline float Div(float a, float b) {
    return a / b;
}
inline float Fma(float a, float b, float c) {
    return std::fma(a, b, c);
}
inline float Min(float a, float b) {
    return a < b ? a : b;
}
inline float Max(float a, float b) {
    return a > b ? a : b;
}
inline float Neg(float a) {
    return std::bit_cast<float>(std::bit_cast<uint32_t>(a) ^ 0x80000000u);
}
inline float Abs(float a) {
    return std::bit_cast<float>(std::bit_cast<uint32_t>(a) & 0x7fffffffu);
}
inline float Sqrt(float a) {
    return std::sqrt(a);
}
inline float Floor(float a) {
    return std::floor(a);
}
inline float Ceil(float a) {
    return std::ceil(a);
}
inline float Trunc(float a) {
    return std::trunc(a);
}
inline float Round(float a) {
    return std::nearbyint(a);
}

// Through unsigned: signed overflow is undefined in C++.
inline int32_t IAdd(int32_t a, int32_t b) {
    return s(u(a) + u(b));
}
inline int32_t ISub(int32_t a, int32_t b) {
    return s(u(a) - u(b));
}
inline int32_t IMul(int32_t a, int32_t b) {
    return s(u(a) * u(b));
}
inline int32_t IAnd(int32_t a, int32_t b) {
    return a & b;
}
inline int32_t IOr(int32_t a, int32_t b) {
    return a | b;
}
inline int32_t IXor(int32_t a, int32_t b) {
    return a ^ b;
}
inline int32_t IMin(int32_t a, int32_t b) {
    return a < b ? a : b;
}
inline int32_t IMax(int32_t a, int32_t b) {
    return a > b ? a : b;
}

// Shift counts are immediates.
struct Imm {
    int32_t value;
};
inline int32_t IShl(int32_t a, Imm n) {
    return s(u(a) << n.value);
}
inline int32_t IShr(int32_t a, Imm n) {
    return s(u(a) >> n.value);
}
inline int32_t ISar(int32_t a, Imm n) {
    return a >> n.value;
}

inline int32_t FToI(float a) {
    constexpr float kTwo31 = 2147483648.0f;
    return a >= -kTwo31 && a < kTwo31 ? static_cast<int32_t>(a)
                                      : std::numeric_limits<int32_t>::min();
}
inline float IToF(int32_t a) {
    return static_cast<float>(a);
}
inline int32_t BitsFI(float a) {
    return std::bit_cast<int32_t>(a);
}
inline float BitsIF(int32_t a) {
    return std::bit_cast<float>(a);
}

inline Mask Lt(float a, float b) {
    return Mask(a < b);
}
inline Mask Le(float a, float b) {
    return Mask(a <= b);
}
inline Mask Eq(float a, float b) {
    return Mask(a == b);
}
inline Mask ILt(int32_t a, int32_t b) {
    return Mask(a < b);
}
inline Mask IEq(int32_t a, int32_t b) {
    return Mask(a == b);
}
inline Mask MAnd(Mask a, Mask b) {
    return Mask::of(a.bits & b.bits);
}
inline Mask MOr(Mask a, Mask b) {
    return Mask::of(a.bits | b.bits);
}
inline Mask MXor(Mask a, Mask b) {
    return Mask::of(a.bits ^ b.bits);
}
inline Mask MAndNot(Mask a, Mask b) {
    return Mask::of(a.bits & ~b.bits);
}
inline Mask MNot(Mask a) {
    return Mask::of(~a.bits);
}
// Whatever the type, Select moves bits.
inline int32_t Select(Mask m, int32_t a, int32_t b) {
    return (a & m.bits) | (b & ~m.bits);
}

// The rows above, for tables: KINORA_SCALAR_OPS(X) is X(name) for each.
// Laid out by hand: clang-format lays such lists out anew each time.
// clang-format off
#define KINORA_SCALAR_OPS(X) \
    X(Add) X(Sub) X(Mul) X(Div) X(Fma) X(Min) X(Max) X(Neg) X(Abs) X(Sqrt) X(Floor) X(Ceil) \
    X(Trunc) X(Round) X(IAdd) X(ISub) X(IMul) X(IAnd) X(IOr) X(IXor) X(IShl) X(IShr) X(ISar) \
    X(IMin) X(IMax) X(FToI) X(IToF) X(BitsFI) X(BitsIF) X(Lt) X(Le) X(Eq) X(ILt) X(IEq) X(MAnd) \
    X(MOr) X(MXor) X(MAndNot) X(MNot) X(Select)
// clang-format on

// Reads an operand of type T from its bits, and back.
template <class T>
T from_bits(int32_t bits) {
    if constexpr (sizeof(T) == sizeof(int32_t)) return std::bit_cast<T>(bits);
}
template <class T>
int32_t to_bits(T value) {
    return std::bit_cast<int32_t>(value);
}

}  // namespace kinora::jit::scalar
