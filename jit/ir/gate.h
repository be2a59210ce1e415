// jit/ir/gate.h: results that vanish with others are not computed where those are 0.
#pragma once

#include <span>

#include "jit/ir/ir.h"

namespace kinora::jit {

// Of the kernel of a verified module. `products` and `factors` are indices of Module::outputs.
// Where all factors are 0, products that are sums of multiples of them are +0 from now on, and
// nothing is computed for their sake alone; elsewhere no bit changes. What was infinite or NaN,
// times 0, is 0 too, and what is skipped reports no fault. Calls with effects stay where they are,
// with what they need. False if nothing changed: a product is of another form, or there is too
// little to skip.
bool skip_zero_products(Module& module, std::span<const size_t> products,
                        std::span<const size_t> factors);

}  // namespace kinora::jit
