// rsl/check/expression.h: types and conversions of expressions. Names get their symbols, calls
// their callees; an expression that cannot be typed becomes Invalid after one finding.
#pragma once

#include <string>

#include "rsl/check/aovs.h"
#include "rsl/check/assignments.h"
#include "rsl/check/call.h"
#include "rsl/check/convert.h"
#include "rsl/check/inference.h"
#include "rsl/check/overloads.h"
#include "rsl/check/scopes.h"
#include "rsl/check/tree_reporter.h"
#include "rsl/check/unknown_names.h"
#include "rsl/syntax/parse_recovery.h"

namespace kinora::rsl {

// `wanted` is the type the context would like, Invalid for any. A slot holds the expression; casts
// are put into it.
class ExpressionChecker {
  public:
    ExpressionChecker(Ast& ast, TreeReporter& reporter, const CompileOptions& options,
                      const ParseRecovery& recovery, Scopes& scopes, UnknownNames& unknown,
                      Assignments& assignments, NamedOutputs& outputs, CallGraph& graph)
        : ast_(ast),
          reporter_(reporter),
          recovery_(recovery),
          scopes_(scopes),
          unknown_(unknown),
          assignments_(assignments),
          outputs_(outputs),
          types_(scopes),
          overloads_(types_),
          calls_(ast, reporter, options, scopes, overloads_, assignments, graph) {}

    void expression(Expr*& slot, BaseType wanted);
    // As a single value; its type, or Invalid after a finding.
    BaseType value(Expr*& slot, BaseType wanted);
    // As a value brought to the type; `what` names who needs it.
    void convert_to(Expr*& slot, Type type, const std::string& what);
    // The same for an expression that has been checked.
    void bring_to(Expr*& slot, Type type, const std::string& what);
    // As a Bool.
    void condition(Expr*& slot);

  private:
    // expression.cpp
    void array_value(Expr*& slot, Type type, const std::string& what);
    void to_condition(Expr*& slot);
    void string_condition(Expr*& slot);
    void check_number(Expr*& slot, const char* what);
    bool convert(Expr*& slot, BaseType to) { return rsl::convert(ast_, slot, to); }
    void check(Expr*&, NumberExpr& e, BaseType wanted);
    void check(Expr*&, StringExpr& e, BaseType wanted);
    void check(Expr*&, VariableExpr& e, BaseType wanted);
    void check(Expr*& slot, IndexExpr& e, BaseType wanted);
    void check(Expr*&, ComponentExpr& e, BaseType wanted);
    void check(Expr*&, SelectExpr& e, BaseType wanted);
    void check(Expr*&, AssignExpr& e, BaseType wanted);
    void check(Expr*& slot, CallExpr& e, BaseType wanted);
    void check(Expr*&, CastExpr& e, BaseType wanted);
    void check(Expr*&, TripleExpr& e, BaseType wanted);
    void check(Expr*&, SixteenExpr& e, BaseType wanted);
    void check(Expr*&, ArrayLiteralExpr& e, BaseType wanted);
    bool add_defaults(CallExpr& e, const Function& f);
    void no_struct_form(CallExpr& e);
    void no_form(CallExpr& e, std::span<Function* const> functions);

    // operator.cpp
    void check(Expr*&, UnaryExpr& e, BaseType wanted);
    void check(Expr*&, BinaryExpr& e, BaseType wanted);
    struct OperatorSides {
        OperandTypes left;
        bool right_flexible = false, right_checked = false;
        bool component = false;               // "P.x"
        BaseType wanted = BaseType::Invalid;  // of flexible operands
    };
    BaseType before_left(BinaryExpr& e, OperatorSides& sides, BaseType wanted);
    void after_left(BinaryExpr& e, const OperatorSides& sides);
    void check_arithmetic(BinaryExpr& e);
    bool is_component_by_name(const BinaryExpr& e) const;
    void component_by_name(BinaryExpr& e);
    void check_product(BinaryExpr& e);
    void check_comparison(BinaryExpr& e);
    bool compare_arrays(Expr*& slot, BinaryExpr& e);
    void bad_operands(BinaryExpr& e);

    Ast& ast_;
    TreeReporter& reporter_;
    const ParseRecovery& recovery_;
    Scopes& scopes_;
    UnknownNames& unknown_;
    Assignments& assignments_;
    NamedOutputs& outputs_;
    TypeInference types_;
    OverloadResolution overloads_;
    CallBinder calls_;
    int defaults_ = 0;               // defaults of arguments within one another
    bool endless_defaults_ = false;  // was told; each call would tell it again, exponentially often
};

}  // namespace kinora::rsl
