// jit/math/exp_p.h: powers of two, shared by exp2 and pow.
#pragma once

#include "jit/math/expr_p.h"

namespace kinora::jit::math {

// 2^(hi + lo) for |lo| far below |hi| or tiny, within 1 ULP; lo must be finite (or the NaN of hi).
Num exp2_of_sum(Num hi, Num lo);

// 2^x in the fast tier.
Num exp2_fast(Num x);

}  // namespace kinora::jit::math
