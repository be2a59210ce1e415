// jit/math/reduce_p.h: angles modulo pi/2, for the trigonometric functions.
#pragma once

#include "jit/math/expr_p.h"

namespace kinora::jit::math {

// x = hi + lo + quadrant * pi/2, |hi| <= pi/4 and a little; of quadrant the low 2 bits are right.
struct Reduced {
    Num hi;
    Num lo;
    Int quadrant;
};

// Any |x| above 2^10 by exact integer arithmetic (Payne and Hanek); for x outside
// (2^10, infinity) hi is meaningless, for infinities and NaN it is NaN.
Reduced reduce_huge(Num x);

}  // namespace kinora::jit::math
