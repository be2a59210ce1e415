// rsl/check/convert.h: implicit conversions.
#pragma once

#include "rsl/syntax/ast.h"

namespace kinora::rsl {

// How well a value of type `from` serves where `to` is wanted: 0 the same, more is worse, -1 not.
int conversion_cost(BaseType from, BaseType to);

// What to write where a value of type `from` stands and `to` is wanted; "" when there is no advice.
const char* conversion_help(BaseType from, BaseType to);

// The type that both operands are brought to; Invalid if there is none.
BaseType common_type(BaseType a, BaseType b);

// Puts casts around the checked expression; false when there is no conversion.
// The float in the slot as a condition: != 0.
void convert_to_condition(Ast& ast, Expr*& slot);
bool convert(Ast& ast, Expr*& slot, BaseType to);

}  // namespace kinora::rsl
