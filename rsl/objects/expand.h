// rsl/objects/expand.h: rewrites the functions and shaders of a source without structs.
#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rsl/objects/structs.h"
#include "rsl/syntax/ast.h"
#include "rsl/text/reporter.h"

namespace kinora::rsl {

// ---- names of members, as "a->b->c" -------------------------------------------------------------

constexpr std::string_view kArrow = "->";

inline std::string_view first_name(std::string_view path) {
    return path.substr(0, path.find(kArrow));
}
inline bool is_member(std::string_view path) {
    return path.find(kArrow) != std::string_view::npos;
}

// Methods and functions of struct arguments have names that no source can have: the checker then
// needs to know nothing of structs. The part that the user wrote comes first.
inline std::string method_name(const StructDefinition& owner, std::string_view name) {
    return std::string(owner.name) + "->" + std::string(name);
}

// -------------------------------------------------------------------------------------------------

// Functions that nothing calls are left out, unread: headers hold many.
class ObjectExpander {
  public:
    ObjectExpander(Ast& ast, Reporter& reporter) : ast_(ast), reporter_(reporter) {}
    void run();

  private:
    // A function at file level, or a method of a struct, which becomes one.
    struct Candidate {
        Function* function;
        std::string_view name;          // as written
        const StructDefinition* owner;  // null: no method
        bool wanted = false, done = false;
    };
    struct Scope {
        std::vector<const Symbol*> symbols;
        std::vector<std::string_view> functions;
    };

    template <class... Args>
    Finding& report(const FindingInfo& info, const SourceSpan& span, const Args&... args) {
        const Token& token = ast_.tokens.tokens[span.token];
        return reporter_.report(info, span.where, token.macro, token.spelling, args...);
    }

    // ---- names
    const Symbol* find(std::string_view name) const;
    const Symbol* member_of_object(std::string_view name) const;
    bool is_local_function(std::string_view name) const;
    void declare(const Symbol& symbol) { scopes_.back().symbols.push_back(&symbol); }
    // "a->b->c" from the variable a on; null where a is no struct, or has no such member.
    const Symbol* resolve(std::string_view path, const SourceSpan& span, StructValue* value);
    StructValue struct_value(Expr& e);
    std::vector<Expr*> parts(const StructValue& value, const SourceSpan& span);
    void want(std::string_view name, const StructDefinition* owner);

    // ---- definitions
    void function(Function& f, const StructDefinition* owner);
    void shader(ShaderDefinition& shader);
    void formals(Function& f, const StructDefinition* owner);

    // ---- statements; what they become is appended
    using Stmts = std::vector<Stmt*>;
    void statement(Stmt* stmt, Stmts& out);
    Stmt* single(Stmt* stmt);
    std::span<Stmt*> list(std::span<Stmt*> body);
    void declaration(DeclareStmt& s, Stmts& out);
    void effect(ExpressionStmt& s, Stmts& out);
    bool assign_struct(AssignExpr& e, Stmts& out);
    bool array_call(CallExpr& e, Stmts& out);
    void give_back(ReturnStmt& s, Stmts& out);
    void assign_parts(const std::vector<Expr*>& targets, const std::vector<Expr*>& values,
                      const SourceSpan& span, Stmts& out);

    // ---- expressions
    void expr(Expr*& slot);
    void exprs(std::span<Expr*> items);
    void judge_constant(const Expr& target);
    void variable(VariableExpr& e);
    void call(CallExpr& e, std::vector<Expr*> results = {});
    bool object_call(CallExpr& e, std::vector<Expr*>& args);
    const Function* function_giving_struct(const Expr& e);

    Ast& ast_;
    Reporter& reporter_;
    std::vector<Candidate> candidates_;
    std::vector<Scope> scopes_;
    Function* function_ = nullptr;              // being rewritten; null in the shader's body
    const StructDefinition* owner_ = nullptr;   // of the method being rewritten
    const StructDefinition* result_ = nullptr;  // of the function being rewritten
    const ShaderDefinition* class_ = nullptr;   // the class being rewritten
    std::map<const Function*, const StructDefinition*> results_;
    int temporaries_ = 0;
    size_t copied_ = 0;  // nodes of indices
};

// The body of the class's shader: its members, its methods, and the calls in the pipeline's order.
// Sets the kind. Works on a class whose members and methods have been rewritten.
void make_pipeline(Ast& ast, Reporter& reporter, ShaderDefinition& shader);

}  // namespace kinora::rsl
