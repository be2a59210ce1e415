// rsl/check/flow.h: what is known of a value while rates are inferred (rates.cpp).
#pragma once

namespace kinora::rsl {

// Whether it differs between points, and whether a variable that is declared uniform may not take
// it.
struct Flow {
    bool constant = true;
    bool varying = false;
    bool illegal = false;
};

inline Flow join(Flow a, Flow b) {
    return {a.constant && b.constant, a.varying || b.varying, a.illegal || b.illegal};
}

inline constexpr Flow kConstant{true, false, false};
inline constexpr Flow kUniform{false, false, false};
inline constexpr Flow kVaryingFlow{false, true, true};

inline bool same(Flow a, Flow b) {
    return a.constant == b.constant && a.varying == b.varying && a.illegal == b.illegal;
}

// Whether some points that could be here are not: `any` of them, or of those that the function
// being walked was called for (`own`). What is the function's own lasts as long as the call, so
// that the caller's control does not make it vary. Control by what counts as uniform is legal.
struct Control {
    Flow any = kConstant;
    Flow own = kConstant;
    Control under(Flow f) const {
        Flow by{true, f.varying, f.illegal};
        return {join(any, by), join(own, by)};
    }
};

}  // namespace kinora::rsl
