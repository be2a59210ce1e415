// rsl/check/statement.h: statements, declarations and the functions that they stand in.
#pragma once

#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "rsl/check/assignments.h"
#include "rsl/check/expression.h"
#include "rsl/check/scopes.h"
#include "rsl/check/tree_reporter.h"
#include "rsl/check/unknown_names.h"
#include "rsl/syntax/parse_recovery.h"

namespace kinora::rsl {

class StatementChecker {
  public:
    StatementChecker(Ast& ast, TreeReporter& reporter, const ParseRecovery& recovery,
                     Scopes& scopes, const UnknownNames& unknown, Assignments& assignments,
                     ExpressionChecker& expressions)
        : ast_(ast),
          reporter_(reporter),
          recovery_(recovery),
          scopes_(scopes),
          unknown_(unknown),
          assignments_(assignments),
          expressions_(expressions) {}

    void statement(Stmt& stmt);
    void function(Function& f);
    // Checks the parameters' defaults and declares them in the innermost scope.
    void parameters(std::span<Symbol*> parameters);
    // Makes the function known in the innermost scope.
    void declare(Function& f);

  private:
    // A value set for the life of the guard.
    template <class T>
    struct Within {
        Within(T& variable, T value)
            : variable_(variable), before_(std::exchange(variable, std::move(value))) {}
        ~Within() { variable_ = std::move(before_); }
        T& variable_;
        T before_;
    };
    // What stands around the statement, inside its function.
    struct Around {
        std::vector<Stmt*> loops;               // outermost first
        const char* light_statement = nullptr;  // the illuminance, illuminate or solar
        bool returned = false;                  // a return was met before
    };

    // statement.cpp
    void declare(Symbol& symbol);
    void check_initial(Symbol& symbol);
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
    void body(Stmt& s);
    void loop_body(Stmt& loop, Stmt& turn);
    Stmt* jump_target(const Stmt& jump, const char* word, int levels);

    // light_statement.cpp
    void check(IlluminanceStmt& s);
    void check(IlluminateStmt& s);
    void check(SolarStmt& s);
    void check(GatherStmt& s);
    bool sort_illuminance(IlluminanceStmt& s, size_t next);
    bool sort_gather(GatherStmt& s);
    void cone(Expr*& axis, Expr*& angle, const char* statement_name);
    Expr* assumed_angle(const Stmt& s, const char* statement_name, double angle, const char* text);
    void emit_body(Stmt& s, Stmt& body, const char* statement_name);
    void output_pairs(std::span<Expr*> pairs, const char* statement_name,
                      bool (*is_output)(std::string_view name));

    Ast& ast_;
    TreeReporter& reporter_;
    const ParseRecovery& recovery_;
    Scopes& scopes_;
    const UnknownNames& unknown_;
    Assignments& assignments_;
    ExpressionChecker& expressions_;
    Around around_;
};

}  // namespace kinora::rsl
