// runtime/programs/play/raster/span_portable.cpp: the span kernels in plain C++, one pixel at a
// time.
#include <cmath>
#include <cstring>

#include "runtime/programs/play/raster/span_kernel_p.h"

namespace kinora::play {
namespace {

struct Portable {
    static constexpr int kLanes = 1;
    using Int = int32_t;
    using Float = float;
    static Int set(int32_t v) { return v; }
    static Int iota() { return 0; }
    static Int add(Int a, Int b) { return a + b; }
    static Int sub(Int a, Int b) { return a - b; }
    static Int mul(Int a, Int b) { return a * b; }
    static Int min(Int a, Int b) { return a < b ? a : b; }
    static Int max(Int a, Int b) { return a > b ? a : b; }
    static Int bits_and(Int a, Int b) { return a & b; }
    static Int bits_or(Int a, Int b) { return a | b; }
    template <int kBits>
    static Int shift_left(Int a) {
        return static_cast<Int>(static_cast<uint32_t>(a) << kBits);
    }
    template <int kBits>
    static Int shift_right(Int a) {
        return static_cast<Int>(static_cast<uint32_t>(a) >> kBits);
    }
    template <int kBits>
    static Int shift_signed(Int a) {
        return a >> kBits;
    }
    static Float setf(float v) { return v; }
    static Float addf(Float a, Float b) { return a + b; }
    static Float mulf(Float a, Float b) { return a * b; }
    static Float to_float(Int a) { return static_cast<float>(a); }
    // To the nearest, ties to even; as AVX2 has it, what does not fit is the least integer.
    static Int round(Float a) {
        const float rounded = std::nearbyint(a);
        return rounded >= -0x1p31f && rounded < 0x1p31f ? static_cast<Int>(rounded) : INT32_MIN;
    }
    static Int gather8(const uint8_t* base, Int index) { return base[index]; }
    static Int gather32(const uint8_t* base, Int index) {
        Int word;
        std::memcpy(&word, base + 4 * static_cast<size_t>(index), 4);
        return word;
    }
    static Int load8(const uint8_t* p, int) { return *p; }
    static Int load(const uint32_t* p) { return static_cast<Int>(*p); }
    static void store(uint32_t* p, Int a) { *p = static_cast<uint32_t>(a); }
    static Int load_some(const uint32_t*, int) { return 0; }  // one lane is never a part
    static void store_some(uint32_t*, int, Int) {}
};

}  // namespace

extern const SpanKernel kPortableSpans = make_spans<Portable>("portable");

}  // namespace kinora::play
