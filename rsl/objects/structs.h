// rsl/objects/structs.h: variables of struct types: their members as variables.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "rsl/objects/build_tree.h"
#include "rsl/syntax/ast.h"
#include "rsl/text/reporter.h"

namespace kinora::rsl {

// A member of plain type, however deep: the name behind the variable's, "->a->b".
struct Leaf {
    std::string path;
    const Symbol* member;
};
std::vector<Leaf> leaves_of(const StructDefinition& structure);

const Symbol* find_member(const StructDefinition& structure, std::string_view name);

// A value of struct type: a variable, or an element of an array.
struct StructValue {
    const StructDefinition* structure = nullptr;  // null: no such value
    std::string name;                             // of the variable: "a", "a->b"
    const Expr* index = nullptr;                  // of the element; null for a whole variable
    bool array = false;                           // a whole array of structs
};

// The most nodes that members in place of structs may have, with copies of indices, all together:
// calls within the indices of elements that are arguments multiply.
constexpr size_t kMostCopiedNodes = 1 << 20;

// An array of structs that hold arrays of fixed length is an array of all their elements.
bool has_arrays(const StructDefinition& structure);
// Those of changing length cannot be, nor arrays of structs in arrays of structs.
bool has_open_arrays(const StructDefinition& structure);

// Whole: an array is one expression, which an element of an array of structs has not. Elements: one
// expression for each element of each member.
enum class Parts { Whole, Elements };

// The leaves of a value as expressions, in the order of leaves_of(). `nodes` counts copied nodes;
// beyond the most there are no more expressions.
std::vector<Expr*> parts_of(Ast& ast, const StructValue& value, const SourceSpan& span,
                            size_t* nodes, Parts parts = Parts::Whole);
size_t count_parts(const StructDefinition& structure, Parts parts);

// Element j of the array that element i of an array of structs holds, as an index of all elements:
// -1 where it has none such.
Expr* flat_index(Ast& ast, const SourceSpan& span, Expr* i, int length, Expr* j);

// The variables in place of one of struct type, with the members' defaults.
std::vector<Symbol*> expanded(Ast& ast, const Symbol& symbol);

// A struct that has itself as a member, arrays within arrays, or too many members: reported.
bool check_structs(const Ast& ast, Reporter& reporter);

}  // namespace kinora::rsl
