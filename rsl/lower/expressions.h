// rsl/lower/expressions.h: expressions as IR values.
#pragma once

#include <initializer_list>

#include "rsl/lower/builtin_call.h"
#include "rsl/lower/calls.h"
#include "rsl/lower/context.h"
#include "rsl/lower/slots.h"
#include "rsl/lower/spaces.h"
#include "rsl/lower/variables.h"

namespace kinora::rsl {

class Expressions {
  public:
    Expressions(const BuiltinTools& tools, Slots& slots, Regions& regions, Arrays& arrays,
                Calls& calls)
        : e_(tools.e),
          b_(tools.e.b),
          context_(tools.context),
          spaces_(tools.spaces),
          slots_(slots),
          regions_(regions),
          arrays_(arrays),
          variables_(tools.variables),
          calls_(calls),
          tools_(tools) {}

    Lowered expr(const Expr& e);

  private:
    Value value(const Expr& e) { return expr(e).c[0]; }
    bool as_product(const Expr& e, BaseType type, Lowered& x, Lowered& y);
    Lowered chain(const Expr& last);
    Lowered product_and(const BinaryExpr& e, const Lowered& x, const Lowered& y);
    Lowered operated(const BinaryExpr& e, const Lowered& left);
    Lowered sum_of(Op op, const Lowered& x, const Expr& right);
    Lowered select_expr(const SelectExpr& e);
    Lowered logical(const BinaryExpr& e, Value left);
    bool runs_apart(std::initializer_list<const Expr*> sides, uint32_t effects) const;
    Lowered assign(const AssignExpr& e);
    Lowered cast(const CastExpr& e);

    Emitter& e_;
    jit::Builder& b_;
    LoweringContext& context_;
    Spaces& spaces_;
    Slots& slots_;
    Regions& regions_;
    Arrays& arrays_;
    Variables& variables_;
    Calls& calls_;
    BuiltinTools tools_;
    Location where_;
};

}  // namespace kinora::rsl
