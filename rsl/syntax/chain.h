// rsl/syntax/chain.h: a + b * c - d as a chain of operators. A sum may have 100,000 terms: walks of
// the tree go along chains by loops, and recurse into the operands at their sides.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "rsl/syntax/ast.h"

namespace kinora::rsl {

// Where the chain goes on: the left operand of an operator, what the checker's cast converts. Null
// elsewhere.
inline Expr* const* left_in_chain(const Expr& e) {
    if (const auto* node = as_if<BinaryExpr>(&e)) return &node->left;
    const auto* cast = as_if<CastExpr>(&e);
    return cast && cast->implicit && !cast->space ? &cast->operand : nullptr;
}

inline Expr** left_in_chain(Expr& e) {
    return const_cast<Expr**>(left_in_chain(std::as_const(e)));
}

// The leftmost operand, and the operators and casts behind it in the order of evaluation; `e` is
// the last.
template <class ExprRef>
struct Chain {
    ExprRef* first;
    std::vector<ExprRef*> links;
};
template <class ExprRef>
Chain<ExprRef> chain_of(ExprRef& e) {
    Chain<ExprRef> chain{&e, {}};
    while (auto* left = left_in_chain(*chain.first)) {
        chain.links.push_back(chain.first);
        chain.first = *left;
    }
    std::reverse(chain.links.begin(), chain.links.end());
    return chain;
}

// The operators alone, of a tree that has no casts yet. `last` is the last.
template <class Binary>
std::vector<Binary*> operators_of(Binary& last) {
    std::vector<Binary*> operators;
    for (Binary* node = &last; node; node = as_if<BinaryExpr>(node->left))
        operators.push_back(node);
    std::reverse(operators.begin(), operators.end());
    return operators;
}

}  // namespace kinora::rsl
