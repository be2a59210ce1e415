// rsl/check/scopes.h: what each name means at a point of the source.
#pragma once

#include <string_view>
#include <unordered_map>
#include <vector>

#include "rsl/model/globals.h"
#include "rsl/syntax/ast.h"

namespace kinora::rsl {

class Scopes {
  public:
    // The symbols of globals are made in the tree when they are first named.
    explicit Scopes(Ast& ast) : ast_(ast), globals_(size_t(Global::Count)) {}

    // An innermost scope for the life of the guard: of a block, or of a function's (null: a
    // shader's) parameters and body.
    class Guard {
      public:
        explicit Guard(Scopes& scopes) : Guard(scopes, scopes.function()) {}
        Guard(Scopes& scopes, const Function* function) : scopes_(scopes) {
            scopes_.scopes_.push_back({{}, {}, function});
        }
        ~Guard() { scopes_.scopes_.pop_back(); }
        Guard(const Guard&) = delete;

      private:
        Scopes& scopes_;
    };

    // The function that the innermost scope belongs to; null in a shader or file.
    const Function* function() const { return scopes_.empty() ? nullptr : scopes_.back().function; }

    // Both declare in the innermost scope. They return what is declared there already: a variable
    // of the name, which the new one hides, or a function of the same form, which it replaces.
    const Symbol* declare(Symbol& symbol);
    const Function* declare(Function& function);
    // The name means this variable, which is declared further out.
    void refer_to(Symbol& symbol);

    // Innermost first, the globals last; null when there is none.
    Symbol* find_variable(std::string_view name);
    // Only what is declared outside the innermost function.
    Symbol* find_variable_outside(std::string_view name);
    // The overloads of the innermost scope that has any.
    std::vector<Function*> find_functions(std::string_view name) const;

    std::vector<std::string_view> variable_names() const;
    std::vector<std::string_view> function_names() const;

  private:
    struct Scope {
        struct Named {
            Symbol *first, *last;  // declared by the name
        };
        std::vector<Symbol*> variables;  // as declared
        std::vector<Function*> functions;
        const Function* function = nullptr;
        std::unordered_map<std::string_view, Named> by_name{};  // of the variables
    };
    static Symbol* find_in(const Scope& scope, std::string_view name);
    Symbol* find_global_symbol(std::string_view name);

    Ast& ast_;
    std::vector<Scope> scopes_;
    std::vector<Symbol*> globals_;  // by Global, made when first named
};

}  // namespace kinora::rsl
