// rsl/objects/expand.h: rewrites the functions and shaders of a source without structs.
#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rsl/objects/handle_calls.h"
#include "rsl/objects/handle_sets.h"
#include "rsl/objects/output_tables.h"
#include "rsl/objects/paths.h"
#include "rsl/objects/structs.h"
#include "rsl/objects/units.h"
#include "rsl/syntax/ast.h"
#include "rsl/text/reporter.h"

namespace kinora::rsl {

// Methods and functions of struct arguments have names that no source can have: the checker then
// needs to know nothing of structs. The part that the user wrote comes first.
inline std::string method_name(const StructDefinition& owner, std::string_view name) {
    return std::string(owner.name) + "->" + std::string(name);
}

// Behind the name of a function for each argument that is a shader, as " name" for a struct.
constexpr std::string_view kHandleArgument = " shader";

// Functions that nothing calls are left out, unread: headers hold many.
class ObjectExpander {
  public:
    ObjectExpander(Ast& ast, Reporter& reporter, std::vector<Unit>& units, const HandleSets& sets)
        : ast_(ast),
          reporter_(reporter),
          units_(units),
          sets_(sets),
          handles_(ast, units, sets, *this),
          outputs_(ast) {}
    // Rewrites these units.
    void run(const std::vector<size_t>& used);
    // Functions that name what stands in the shader's body, to be defined there.
    const std::vector<Function*>& nested() const { return nested_; }
    OutputTables& outputs() { return outputs_; }
    // Of these, those that name members of the first unit itself.
    const std::set<const Function*>& behind_members() const { return behind_members_; }

  private:
    friend class HandleCalls;

    // A function at file level, or a method of a struct, which becomes one.
    struct Candidate {
        Function* function;
        std::string_view name;          // as written
        const StructDefinition* owner;  // null: no method
        size_t unit;
        bool wanted = false, done = false;
    };
    struct Scope {
        std::vector<const Symbol*> symbols;
        std::vector<std::string_view> functions;
        std::string prefix = {};  // of what it declares: that of its unit
    };

    template <class... Args>
    Finding& report(const FindingInfo& info, const SourceSpan& span, const Args&... args) {
        // A name that is no member is no struct either: that is said once.
        if (&info == &Code::RSL_NO_MEMBER) no_members_.insert(span.token);
        bool follows = &info == &Code::RSL_NOT_STRUCT || &info == &Code::RSL_STRUCT_VALUE;
        if (follows && no_members_.contains(span.token)) return unsaid_;
        const Token& token = ast_.tokens.tokens[span.token];
        return reporter_.report(info, span.where, token.macro, token.spelling, args...);
    }

    // ---- names
    // The prefix, if wanted, is what the name gets in front.
    const Symbol* find(std::string_view name, std::string* prefix = nullptr) const;
    const Symbol* member_of_object(std::string_view name) const;
    bool is_local_function(std::string_view name) const;
    void declare(const Symbol& symbol) { scopes_.back().symbols.push_back(&symbol); }
    // "a->b->c" from the variable a on; null where a is no struct, or has no such member.
    const Symbol* resolve(std::string_view path, const SourceSpan& span, StructValue* value);
    StructValue struct_value(Expr& e);
    std::vector<Expr*> parts(const StructValue& value, const SourceSpan& span,
                             Parts how = Parts::Whole);
    int inner_length(const Expr& e) const;
    void want(std::string_view name, const StructDefinition* owner);
    std::string_view placed(std::string_view name) const;

    // ---- definitions
    void function(Function& f, const StructDefinition* owner);
    void wanted_functions();
    void list_functions();
    void divide_functions();
    void place_names(const Unit& unit);
    void shader(ShaderDefinition& shader, size_t unit);
    Stmt* handle_parameters(ShaderDefinition& shader);
    void formals(Function& f, const StructDefinition* owner);

    // ---- statements; what they become is appended
    using Stmts = std::vector<Stmt*>;
    void statement(Stmt* stmt, Stmts& out);
    Stmt* single(Stmt* stmt);
    std::span<Stmt*> list(std::span<Stmt*> body);
    void declaration(DeclareStmt& s, Stmts& out);
    void effect(ExpressionStmt& s, Stmts& out);
    void gather_region(GatherStmt& s);
    bool assign_struct(AssignExpr& e, Stmts& out);
    bool array_call(CallExpr& e, Stmts& out);
    void give_back(ReturnStmt& s, Stmts& out);
    void assign_parts(const std::vector<Expr*>& targets, const std::vector<Expr*>& values,
                      const SourceSpan& span, Stmts& out);

    // ---- expressions
    void expr(Expr*& slot);
    void exprs(std::span<Expr*> items);
    void operators(BinaryExpr& last);
    void judge_constant(const Expr& target);
    void variable(VariableExpr& e);
    void call(CallExpr& e, std::vector<Expr*> results = {});
    std::string_view function_name(std::string_view name);
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
    std::vector<Unit>& units_;
    const HandleSets& sets_;
    HandleCalls handles_;
    OutputTables outputs_;
    size_t unit_ = 0;                    // that of what is being rewritten
    Function* top_ = nullptr;            // the candidate being rewritten
    std::set<const Function*> in_body_;  // candidates that name what stands in the shader's body
    std::map<const Function*, std::set<std::string_view>> called_;  // by candidates
    std::vector<Function*> nested_;
    std::set<const Function*> behind_members_;
    std::map<const Function*, const StructDefinition*> results_;
    std::set<uint32_t> no_members_;  // tokens where RSL_NO_MEMBER was reported
    Finding unsaid_;
    int temporaries_ = 0;
    size_t copied_ = 0;  // nodes of indices
};

// The body of the class's shader: its members, its methods, and the calls in the pipeline's order.
// Sets the kind. Works on a class whose members and methods have been rewritten.
void make_pipeline(Ast& ast, Reporter& reporter, ShaderDefinition& shader);

}  // namespace kinora::rsl
