// jit/ir/ieee_scope_p.h: the IEEE default while folding, whatever denormal mode the thread is in.
#pragma once

#include <cstdint>
#if defined(__SSE__)
#include <immintrin.h>
#endif

namespace kinora::jit {

// The thread's register of rounding and denormal modes, and its power-on default (no traps).
#if defined(__SSE__)
using FloatModes = unsigned;
inline constexpr FloatModes kIeeeModes = 0x1f80;
inline FloatModes float_modes() {
    return _mm_getcsr();
}
inline void set_float_modes(FloatModes modes) {
    _mm_setcsr(modes);
}
#elif defined(__aarch64__)
using FloatModes = uint64_t;
inline constexpr FloatModes kIeeeModes = 0;
inline FloatModes float_modes() {
    FloatModes modes;
    asm volatile("mrs %0, fpcr" : "=r"(modes));
    return modes;
}
inline void set_float_modes(FloatModes modes) {
    asm volatile("msr fpcr, %0" : : "r"(modes));
}
#else
#error "name this CPU's register of rounding and denormal modes"
#endif

// Constants fold as a precise kernel computes: denormals kept, rounding to nearest even.
class IeeeScope {
  public:
    IeeeScope() : saved_(float_modes()) { set_float_modes(kIeeeModes); }
    ~IeeeScope() { set_float_modes(saved_); }
    IeeeScope(const IeeeScope&) = delete;
    IeeeScope& operator=(const IeeeScope&) = delete;

  private:
    FloatModes saved_;
};

}  // namespace kinora::jit
