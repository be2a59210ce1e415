// rsl/syntax/print.h: trees as text, with room for notes at each expression and variable.
#pragma once

#include <functional>
#include <string>

#include "rsl/syntax/ast.h"

namespace kinora::rsl {

// Given an expression and its text, the text to print. Null: none, and implicit casts are left out.
using ExprNote = std::function<std::string(const Expr& expr, std::string text)>;
// Text behind a variable's declaration. Null: none.
using SymbolNote = std::function<std::string(const Symbol& symbol)>;

// Source text that parses to the same tree, with the notes where they give text.
std::string print_expr(const Expr& expr, const ExprNote& note = {});
std::string print_tree(const Ast& ast, const ExprNote& note = {}, const SymbolNote& symbols = {});

std::string number_text(double value);      // shortest text that reads back as the same double
std::string quoted(std::string_view text);  // a string literal

}  // namespace kinora::rsl
