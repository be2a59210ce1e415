// rsl/check/check.h: the checker: names to symbols and callees, types, overloads and conversions.
// It completes the tree in place; expressions that cannot be typed become Invalid after one
// finding, and nothing more is said of what contains them.
#pragma once

#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "rsl/model/builtin.h"
#include "rsl/model/globals.h"
#include "rsl/model/shader.h"
#include "rsl/syntax/parse_recovery.h"
#include "rsl/text/compile_options.h"
#include "rsl/text/reporter.h"

namespace kinora::rsl {

// A call from one user function (null: a shader) to another, for the call graph.
struct CallEdge {
    const Function* caller;
    Function* callee;
    const CallExpr* call;
};

using TypeSet = uint32_t;  // a bit each BaseType

class Checker {
  public:
    // Names that `recovery` hides are not reported.
    Checker(Ast& ast, Reporter& reporter, const CompileOptions& options,
            const ParseRecovery& recovery);
    void run();

  private:
    struct Scope {
        std::vector<Symbol*> variables;
        std::vector<Function*> functions;
        const Function* owner = nullptr;
    };
    // A scope for the life of the guard.
    struct ScopeGuard {
        explicit ScopeGuard(Checker& checker) : checker_(checker) {
            checker_.scopes_.push_back({{}, {}, checker_.function_});
        }
        ~ScopeGuard() { checker_.scopes_.pop_back(); }
        Checker& checker_;
    };
    // A value set for the life of the guard.
    template <class T>
    struct Within {
        Within(T& variable, T value) : variable_(variable), before_(std::move(variable)) {
            variable_ = std::move(value);
        }
        ~Within() { variable_ = std::move(before_); }
        T& variable_;
        T before_;
    };

    // check.cpp: definitions, scopes
    void check_shader(ShaderDefinition& shader);
    void warn_of_hidden_outputs(const ShaderDefinition& shader);
    void check_function(Function& f);
    void check_parameters(std::span<Symbol*> parameters);
    void default_in_shader_space(Symbol& symbol);
    void put_in_shader_space(Expr*& value, BaseType base);
    void check_initial(Symbol& symbol);
    void declare(Symbol& symbol);
    void declare_function(Function& f);
    Symbol* find_variable(std::string_view name, bool outside_function);
    const Symbol* find_symbol(std::string_view name) const;
    Symbol* global_symbol(const GlobalInfo& info);
    std::vector<std::string_view> variable_names() const;
    void mark_recursion();

    template <class... Args>
    Finding& report(const FindingInfo& info, const SourceSpan& span, const Args&... args) {
        const Token& token = ast_.tokens.tokens[span.token];
        return reporter_.report(info, span.where, token.macro, token.spelling, args...);
    }

    // statement.cpp
    void statement(Stmt& stmt);
    void check(BlockStmt& s);
    void check(DeclareStmt& s);
    void check(ExternStmt& s);
    void check(FunctionStmt& s);
    void check(ExpressionStmt& s);
    void check(IfStmt& s);
    void check(WhileStmt& s);
    void check(ForStmt& s);
    void check(BreakStmt& s);
    void check(ContinueStmt& s);
    void check(ReturnStmt& s);
    void check(IlluminanceStmt& s);
    void check(IlluminateStmt& s);
    void check(SolarStmt& s);
    void check(GatherStmt& s);
    void loop_body(Stmt& loop, Stmt& body);
    Stmt* jump_target(const Stmt& jump, const char* word, int levels);
    bool sort_illuminance(IlluminanceStmt& s, size_t next);
    void output_pairs(std::span<Expr*> pairs, const char* statement_name,
                      bool (*is_output)(std::string_view name));
    void drop_unfit(std::span<Expr*>& args, size_t first, std::string_view callee);
    void cone(Expr*& axis, Expr*& angle, const char* statement_name);
    Expr* assumed_angle(const Stmt& s, const char* statement_name, double angle, const char* text);

    // expression.cpp. `wanted` is the type the context would like, Invalid for any.
    void expression(Expr*& slot, BaseType wanted);
    BaseType value(Expr*& slot, BaseType wanted);
    void convert_to(Expr*& slot, Type type, const std::string& what);
    void bring_to(Expr*& slot, Type type, const std::string& what);
    void condition(Expr*& slot);
    void string_condition(Expr*& slot);
    void check_number(Expr*& slot, const char* what);
    void check(Expr*&, NumberExpr& e, BaseType wanted);
    void check(Expr*&, StringExpr& e, BaseType wanted);
    void check(Expr*&, VariableExpr& e, BaseType wanted);
    void check(Expr*& slot, IndexExpr& e, BaseType wanted);
    void check(Expr*&, ComponentExpr& e, BaseType wanted);
    void check(Expr*&, SelectExpr& e, BaseType wanted);
    void check(Expr*&, AssignExpr& e, BaseType wanted);
    void check(Expr*&, CastExpr& e, BaseType wanted);
    void check(Expr*&, TripleExpr& e, BaseType wanted);
    void check(Expr*&, SixteenExpr& e, BaseType wanted);
    void check(Expr*&, ArrayLiteralExpr& e, BaseType wanted);
    void array_value(Expr*& slot, Type type, const std::string& what);
    Symbol* lvalue_symbol(Expr& target);
    bool check_lvalue(Expr*& slot);
    void mark_assigned(Symbol& symbol, const SourceSpan& span);

    // operator.cpp
    void check(Expr*&, UnaryExpr& e, BaseType wanted);
    void check(Expr*&, BinaryExpr& e, BaseType wanted);
    void check_arithmetic(BinaryExpr& e, BaseType wanted);
    bool component_by_name(BinaryExpr& e);
    void check_product(BinaryExpr& e);
    void check_comparison(BinaryExpr& e);
    template <class Hint>
    void both_sides(Expr*& left, Expr*& right, BaseType wanted, Hint hint);
    BaseType common_type(BaseType a, BaseType b) const;
    void bad_operands(BinaryExpr& e);
    bool invalid(const BinaryExpr& e) const;

    // call.cpp
    struct Candidate {
        Function* function = nullptr;
        const Overload* builtin = nullptr;
        int cost = -1;  // -1: does not fit
    };
    void check(Expr*&, CallExpr& e, BaseType wanted);
    void take_channel(CallExpr& e);
    void check_arguments(CallExpr& e);
    std::vector<Function*> visible_functions(std::string_view name) const;
    void call_function(CallExpr& e, std::span<Function* const> functions, BaseType wanted);
    void call_builtin(CallExpr& e, BaseType wanted);
    bool fits_builtin(const CallExpr& e, BaseType wanted) const;
    void bind_function(CallExpr& e, Function& f);
    void bind_builtin(CallExpr& e, const Overload& overload);
    void check_file_name(const CallExpr& e);
    void bind_argument(CallExpr& e, size_t index, Type type, bool output);
    int function_cost(const CallExpr& e, const Function& f, BaseType wanted) const;
    int builtin_cost(const CallExpr& e, const Signature& s, BaseType wanted) const;
    int pairs_cost(const CallExpr& e, size_t first) const;
    int argument_cost(const Expr& argument, Type type, bool output) const;
    void unknown_function(CallExpr& e);
    void no_overload(CallExpr& e);
    std::string argument_types(const CallExpr& e) const;

    // convert.cpp
    bool convert(Expr*& slot, BaseType to);
    bool can_be(const Expr& expr, BaseType type) const;
    TypeSet possible_types(const Expr& part) const;
    TypeSet possible_results(const CallExpr& e) const;
    bool is_flexible(const Expr& expr) const;
    bool is_picture(const Expr& expr) const;
    bool is_flexible_call(const CallExpr& e) const;
    BaseType natural_type(const Expr& expr) const;
    BaseType natural_call_type(const CallExpr& e) const;
    static bool is_result(std::span<const Overload> overloads, BaseType type);

    Ast& ast_;
    Reporter& reporter_;
    const CompileOptions& options_;
    const ParseRecovery& recovery_;
    std::vector<Scope> scopes_;
    std::vector<Symbol*> globals_;  // by Global, made when first named
    std::vector<Stmt*> loops_;      // around the statement, outermost first
    std::vector<CallEdge> edges_;
    Function* function_ = nullptr;                  // being checked
    bool returned_ = false;                         // a return was met in it
    const char* light_statement_ = nullptr;         // the illuminance, illuminate or solar around
    std::unordered_set<std::string_view> unknown_;  // variables already reported
    std::unordered_set<std::string_view> unknown_functions_;
    std::unordered_set<const Symbol*> warned_;  // parameters already warned of
};

// How well a value of type `from` serves where `to` is wanted: 0 the same, more is worse, -1 not.
int conversion_cost(BaseType from, BaseType to);

// What to write where a value of type `from` stands and `to` is wanted; "" when there is no advice.
const char* conversion_help(BaseType from, BaseType to);

}  // namespace kinora::rsl
