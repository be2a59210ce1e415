// rsl/check/inference.h: what type an expression may have, before it is checked.
#pragma once

#include "rsl/check/scopes.h"
#include "rsl/model/builtin.h"
#include "rsl/syntax/ast.h"

namespace kinora::rsl {

using TypeSet = uint32_t;  // a bit each BaseType

// What is known of an operand before it is checked.
struct OperandTypes {
    bool flexible = false;
    bool picture = false;  // is_picture()
    TypeSet possible = 0;  // of a flexible one

    bool can_be(BaseType type) const { return possible >> unsigned(type) & 1; }
};

class TypeInference {
  public:
    // Looks names up in the scopes as they are at each question.
    explicit TypeInference(Scopes& scopes) : scopes_(scopes) {}

    // Whether the context may choose the type of the unchecked expression: a (x, y, z), a call of a
    // built-in like noise(), or an operator or another built-in on such.
    bool is_flexible(const Expr& expr) const;
    // The same, and nobody has chosen yet.
    bool is_open(const Expr& expr) const {
        return expr.type.base == BaseType::Invalid && is_flexible(expr);
    }
    // Whether the unchecked, flexible expression can have exactly this type.
    bool can_be(const Expr& expr, BaseType type) const;
    OperandTypes operand(const Expr& expr) const;
    // Of a chain's operators, in order: what each has at its left, and at the end the whole chain.
    std::vector<OperandTypes> left_operands(std::span<const BinaryExpr* const> operators) const;

  private:
    bool is_flexible_call(const CallExpr& e) const;
    BaseType natural_type(const Expr& expr) const;
    BaseType natural_chain_type(const BinaryExpr& last) const;
    BaseType natural_call_type(const CallExpr& e) const;
    TypeSet possible_types(const Expr& part) const;
    TypeSet possible_results(const CallExpr& e) const;

    Scopes& scopes_;
};

// Whether a flexible expression shows a picture: beside a color those are colors, where noise()
// is a factor.
bool is_picture(const Expr& expr);

}  // namespace kinora::rsl
