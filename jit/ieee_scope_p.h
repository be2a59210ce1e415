// jit/ieee_scope_p.h: the IEEE default while folding, whatever denormal mode the thread is in.
#pragma once

#if defined(__SSE__)
#include <immintrin.h>
#endif

namespace kinora::jit {

// Constants fold as a precise kernel computes: denormals kept, rounding to nearest even.
class IeeeScope {
  public:
#if defined(__SSE__)
    IeeeScope() : saved_(_mm_getcsr()) {
        _mm_setcsr(0x1f80);
    }  // power-on default, all masked
    ~IeeeScope() {
        _mm_setcsr(saved_);
    }
    IeeeScope(const IeeeScope&) = delete;
    IeeeScope& operator=(const IeeeScope&) = delete;

  private:
    unsigned saved_;
#else
    IeeeScope() {}
#endif
};

}  // namespace kinora::jit
