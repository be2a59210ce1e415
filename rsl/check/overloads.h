// rsl/check/overloads.h: which function a call means. Overloads are chosen by the arguments first,
// by the type that is wanted of the result second, by the order of the row third.
#pragma once

#include <span>

#include "rsl/check/inference.h"
#include "rsl/model/builtin.h"
#include "rsl/syntax/ast.h"

namespace kinora::rsl {

// A function of the source or an overload of a built-in one.
struct Callee {
    Function* function = nullptr;
    const Overload* builtin = nullptr;
    explicit operator bool() const { return function || builtin; }
};

// A function's name as the source has it: behind a blank, the name that expand_objects() gives has
// the structs among the arguments.
std::string_view written_name(std::string_view name);
// How many parameters the source has of it: a struct is one, and a method's object none.
size_t written_parameters(const Function& f);

// Whether the function may be called with so many arguments: those left out have defaults.
bool takes_count(const Function& f, size_t arguments);

class OverloadResolution {
  public:
    explicit OverloadResolution(const TypeInference& types) : types_(types) {}

    // The best of the visible functions of the call's name, else of the built-in ones; none when no
    // form fits. A single function of as many parameters is chosen even where its types do not fit.
    Callee choose(const CallExpr& e, std::span<Function* const> functions, BaseType wanted) const;
    // How well the argument serves as such a parameter, as conversion_cost() has it.
    int argument_cost(const Expr& argument, Type type, bool output) const;

  private:
    const Overload* choose_builtin(const CallExpr& e, BaseType wanted) const;
    int function_cost(const CallExpr& e, const Function& f, BaseType wanted) const;
    int builtin_cost(const CallExpr& e, const Signature& s, BaseType wanted) const;

    const TypeInference& types_;
};

}  // namespace kinora::rsl
