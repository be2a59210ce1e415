// rsl/objects/handle_calls.h: expressions with shaders in them become numbers and plain calls.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "rsl/objects/build_tree.h"
#include "rsl/objects/handle_sets.h"
#include "rsl/objects/units.h"
#include "rsl/syntax/ast.h"

namespace kinora::rsl {

class ObjectExpander;

// Where only one shader can be meant, h->f(x) becomes the call h.f(x) and h->m the variable h.m;
// else a call of a function that goes by the handle's number.
class HandleCalls {
  public:
    HandleCalls(Ast& ast, const std::vector<Unit>& units, const HandleSets& sets,
                ObjectExpander& expander)
        : ast_(ast), units_(units), sets_(sets), expander_(expander) {}

    // A value of type shader, or an array of them.
    bool is_handle(const Expr& e) const;
    // Reports a shader where something else is needed, in the node itself.
    void check(const Expr& e);
    // False where it is no such expression: then nothing is changed.
    bool rewrite(Expr*& slot);

    // h->f(...), and what it becomes; its arguments stay as they are. False if there is no shader
    // that could be called.
    bool is_call(const CallExpr& e) const { return e.method && is_handle(*e.args[0]); }
    bool resolve(CallExpr& e);

    // A variable's first value.
    void declaration(Symbol& symbol);
    // "shader a[] = getlights(...)": null if it is something else; else the array is filled by
    // fill_with_lights() behind its declaration.
    const CallExpr* take_lights(Symbol& symbol);
    Stmt* fill_with_lights(const CallExpr& e, std::string_view variable);
    // "a = getshaders(...);": through a variable, which is declared in `out`.
    void list_to_variable(ExpressionStmt& s, std::vector<Stmt*>& out);

  private:
    struct Member {
        size_t unit;
        const Symbol* symbol;  // the last of the path
    };

    const Symbol* symbol_at(std::string_view path) const;
    bool is_handle_path(std::string_view path) const;
    std::string_view object_of(std::string_view path) const;
    std::vector<Member> members(HandleSet set, std::string_view path) const;
    bool knows(HandleSet set, const std::vector<Member>& found) const;

    bool variable(Expr*& slot);
    void read_member(Expr*& slot, VariableExpr& member, Expr* index);
    bool call(Expr*& slot);
    Expr* handle(const CallExpr& e);
    Expr* variable_read(CallExpr& e);
    const Symbol* global_symbol(std::string_view name) const;
    Expr* light_value(CallExpr& e, HandleSet set);
    Expr* has_method(const CallExpr& e);
    Expr* vertex_value(CallExpr& e);
    std::optional<Type> written_type(const Expr& e) const;
    Expr* read_by_text(CallExpr& e);
    Stmt* choice_by_text(size_t unit, std::optional<Type> wanted, bool own, SourceSpan span);
    ArrayLiteralExpr* list(const CallExpr& e);

    // ---- functions that go by a handle; their names
    static constexpr size_t kOfLights = ~size_t(0);
    struct Case {
        size_t unit;  // kOfLights: any light; the last case
        std::vector<Stmt*> body;
    };
    // `unanswered`: some shader that is possible has no such method, or is null.
    std::string_view method_function(std::string_view method, HandleSet set, size_t count,
                                     bool unanswered, SourceSpan span);
    void add_function(std::string_view name, const Symbol& result, std::vector<Symbol*> formals,
                      const std::vector<Case>& cases, SourceSpan span, Stmt* otherwise = nullptr);
    void add_reader(std::string_view name, const Symbol& result, std::vector<Symbol*> formals,
                    const std::vector<Case>& cases, SourceSpan span);
    Expr* call_by_handle(std::string_view name, Expr* object, std::vector<Expr*> args,
                         SourceSpan span);
    void stands_in_body();

    Ast& ast_;
    const std::vector<Unit>& units_;
    const HandleSets& sets_;
    ObjectExpander& expander_;
    std::set<std::string, std::less<>> made_;
};

}  // namespace kinora::rsl
