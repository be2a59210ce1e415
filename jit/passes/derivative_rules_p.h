// jit/passes/derivative_rules_p.h: the derivative of each op and of each named function of
// jit/math.
#pragma once

#include <string_view>

#include "jit/ir/builder.h"

namespace kinora::jit {

// A value's derivative; kNone stands for zero, so that nothing is written for it.
using Dual = Value;

// r = op(x[0], x[1], x[2]) with the operands' derivatives dx.
struct RuleSite {
    Builder& b;
    Op op;
    Value x[3];
    Dual dx[3];
    Value r;
};
Dual differentiate_op(const RuleSite& site);

// r = name(x...) for the functions of jit/math that are differentiated by rule, since their bodies
// work on bits: "sin.p", "exp.f", ... False if the name has no rule.
bool has_function_rule(std::string_view name);
Dual differentiate_function(Builder& b, std::string_view name, std::span<const Value> x,
                            std::span<const Dual> dx, Value r);

}  // namespace kinora::jit
