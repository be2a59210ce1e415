// rsl/check/inference.cpp: expressions whose type the context chooses, and what that may be.
#include "rsl/check/inference.h"

#include <algorithm>

#include "rsl/builtins/table.h"
#include "rsl/check/convert.h"
#include "rsl/syntax/chain.h"

namespace kinora::rsl {

namespace {

// Two overloads with the same arguments: only the context tells them apart (noise, texture).
bool chosen_by_context(std::span<const Overload> overloads) {
    auto same = [](const Signature& a, const Signature& b) {
        return std::equal(
            a.arguments.begin(), a.arguments.end(), b.arguments.begin(), b.arguments.end(),
            [](const auto& x, const auto& y) { return x.type == y.type && x.output == y.output; });
    };
    for (size_t i = 0; i < overloads.size(); ++i)
        for (size_t k = 0; k < i; ++k)
            if (overloads[i].signature.result != overloads[k].signature.result &&
                same(overloads[i].signature, overloads[k].signature))
                return true;
    return false;
}

// The same of the source's functions.
bool chosen_by_context(std::span<Function* const> functions) {
    auto same_type = [](const Symbol* a, const Symbol* b) { return a->type == b->type; };
    for (const Function* f : functions)
        for (const Function* other : functions)
            if (f->result != other->result &&
                std::equal(f->parameters.begin(), f->parameters.end(), other->parameters.begin(),
                           other->parameters.end(), same_type))
                return true;
    return false;
}

bool is_arithmetic(Op op) {
    return op >= Op::Add && op <= Op::Divide;
}

bool is_result(std::span<const Overload> overloads, BaseType type) {
    return std::any_of(overloads.begin(), overloads.end(),
                       [&](const Overload& o) { return o.signature.result.base == type; });
}

}  // namespace

bool TypeInference::is_flexible(const Expr& expr) const {
    switch (expr.kind) {
        case ExprKind::Triple:
            return true;
        case ExprKind::Unary:
            return as<UnaryExpr>(expr).op == Op::Negate &&
                   is_flexible(*as<UnaryExpr>(expr).operand);
        case ExprKind::Binary: {
            const Expr* left = &expr;
            for (; left->kind == ExprKind::Binary; left = as<BinaryExpr>(*left).left) {
                if (!is_arithmetic(as<BinaryExpr>(*left).op)) return false;
                if (is_flexible(*as<BinaryExpr>(*left).right)) return true;
            }
            return is_flexible(*left);
        }
        case ExprKind::Select: {
            const auto& e = as<SelectExpr>(expr);
            return is_flexible(*e.yes) || is_flexible(*e.no);
        }
        case ExprKind::Call:
            return is_flexible_call(as<CallExpr>(expr));
        default:
            return false;
    }
}

bool TypeInference::is_flexible_call(const CallExpr& e) const {
    if (std::vector<Function*> functions = scopes_.find_functions(e.name); !functions.empty())
        return chosen_by_context(functions);
    std::span<const Overload> overloads = find_builtin(e.name);
    bool several = std::any_of(overloads.begin(), overloads.end(), [&](const Overload& o) {
        return o.signature.result != overloads[0].signature.result;
    });
    if (!several) return false;
    return std::any_of(e.args.begin(), e.args.end(),
                       [&](const Expr* a) { return is_flexible(*a); }) ||
           chosen_by_context(overloads);
}

// The type that an expression of no flexible parts will get; Invalid when that takes a check.
BaseType TypeInference::natural_type(const Expr& expr) const {
    if (expr.type.base != BaseType::Invalid)
        return expr.type.is_array() ? BaseType::Invalid : expr.type.base;
    switch (expr.kind) {
        case ExprKind::Number:
            return BaseType::Float;
        case ExprKind::String:
            return BaseType::String;
        case ExprKind::Variable: {
            const Symbol* symbol = scopes_.find_variable(as<VariableExpr>(expr).name);
            return symbol && !symbol->type.is_array() ? symbol->type.base : BaseType::Invalid;
        }
        case ExprKind::Index: {
            const auto* array = as_if<VariableExpr>(as<IndexExpr>(expr).array);
            const Symbol* symbol = array ? scopes_.find_variable(array->name) : nullptr;
            if (!symbol) return BaseType::Invalid;
            return symbol->type.is_array() ? symbol->type.base : BaseType::Float;
        }
        case ExprKind::Unary:
            return as<UnaryExpr>(expr).op == Op::Not ? BaseType::Float
                                                     : natural_type(*as<UnaryExpr>(expr).operand);
        case ExprKind::Binary:
            return natural_chain_type(as<BinaryExpr>(expr));
        case ExprKind::Select:
            return common_type(natural_type(*as<SelectExpr>(expr).yes),
                               natural_type(*as<SelectExpr>(expr).no));
        case ExprKind::Cast:
            return as<CastExpr>(expr).to;
        case ExprKind::Sixteen:
            return BaseType::Matrix;
        case ExprKind::Call:
            return natural_call_type(as<CallExpr>(expr));
        default:
            return BaseType::Invalid;
    }
}

BaseType TypeInference::natural_chain_type(const BinaryExpr& last) const {
    std::vector<const BinaryExpr*> operators;  // down to one whose type is known
    const Expr* left = &last;
    for (; left->kind == ExprKind::Binary && left->type.base == BaseType::Invalid;
         left = as<BinaryExpr>(*left).left)
        operators.push_back(&as<BinaryExpr>(*left));
    BaseType type = natural_type(*left);
    for (size_t i = operators.size(); i-- > 0;) {
        Op op = operators[i]->op;
        type = op == Op::Cross ? BaseType::Vector
               : op >= Op::Dot ? BaseType::Float
                               : common_type(type, natural_type(*operators[i]->right));
    }
    return type;
}

BaseType TypeInference::natural_call_type(const CallExpr& e) const {
    std::vector<Function*> functions = scopes_.find_functions(e.name);
    if (!functions.empty()) return functions[0]->result.base;
    std::span<const Overload> overloads = find_builtin(e.name);
    if (overloads.empty()) return BaseType::Invalid;
    BaseType result = overloads[0].signature.result.base;
    for (const Expr* argument : e.args) {
        BaseType type = natural_type(*argument);
        if (is_triple(type) && is_result(overloads, type)) return type;
    }
    return result;
}

// ---- what a flexible expression may be ----------------------------------------------------------

namespace {

constexpr TypeSet one(BaseType type) {
    return 1u << unsigned(type);
}
constexpr TypeSet kTriples =
    one(BaseType::Color) | one(BaseType::Point) | one(BaseType::Vector) | one(BaseType::Normal);

// The types that one of the set converts to.
TypeSet convertible(TypeSet from) {
    TypeSet set = 0;
    for (int f = 0; f < int(BaseType::Invalid); ++f)
        for (int t = 0; from >> f & 1 && t < int(BaseType::Invalid); ++t)
            if (conversion_cost(BaseType(f), BaseType(t)) >= 0) set |= 1u << t;
    return set;
}

}  // namespace

// The types that a part lets the whole have: those that it may have itself, or, where its type is
// fixed, those that this converts to.
TypeSet TypeInference::possible_types(const Expr& part) const {
    if (!is_flexible(part)) {
        BaseType natural = natural_type(part);
        return natural == BaseType::Invalid ? ~TypeSet(0) : convertible(one(natural));
    }
    switch (part.kind) {
        case ExprKind::Triple:
            return kTriples;
        case ExprKind::Unary:
            return possible_types(*as<UnaryExpr>(part).operand);
        case ExprKind::Binary:
            return left_operands(operators_of(as<BinaryExpr>(part))).back().possible;
        case ExprKind::Select:
            return possible_types(*as<SelectExpr>(part).yes) &
                   possible_types(*as<SelectExpr>(part).no);
        case ExprKind::Call:
            return possible_results(as<CallExpr>(part));
        default:
            return 0;
    }
}

// Each operator's left operand is the chain before it, so each is known by the one before.
auto TypeInference::left_operands(std::span<const BinaryExpr* const> operators) const
    -> std::vector<OperandTypes> {
    const Expr* left = operators[0]->left;
    std::vector<OperandTypes> lefts{{is_flexible(*left), is_picture(*left), 0}};
    if (lefts[0].flexible) lefts[0].possible = possible_types(*left);
    for (const BinaryExpr* e : operators) {
        const OperandTypes before = lefts.back();
        OperandTypes whole;
        whole.picture = before.picture || is_picture(*e->right);
        whole.flexible = is_arithmetic(e->op) && (before.flexible || is_flexible(*e->right));
        if (whole.flexible)
            whole.possible = (before.flexible ? before.possible : possible_types(*left)) &
                             possible_types(*e->right);
        lefts.push_back(whole);
        left = e;
    }
    return lefts;
}

// Results of the overloads that the arguments may fit: max(noise(P), Cs) is no float.
TypeSet TypeInference::possible_results(const CallExpr& e) const {
    if (std::vector<Function*> functions = scopes_.find_functions(e.name); !functions.empty()) {
        TypeSet results = 0;
        for (const Function* f : functions)
            if (f->parameters.size() == e.args.size()) results |= one(f->result.base);
        return results;
    }
    std::span<const Overload> overloads = find_builtin(e.name);
    bool by_context = chosen_by_context(overloads);
    std::vector<TypeSet> arguments;
    for (const Expr* argument : e.args)
        arguments.push_back(by_context ? ~TypeSet(0) : convertible(possible_types(*argument)));
    TypeSet results = 0;
    for (const Overload& o : overloads) {
        const Signature& s = o.signature;
        bool fits = true;
        for (size_t i = 0; i < arguments.size() && (i < s.arguments.size() || s.repeats); ++i) {
            Type type = i < s.arguments.size() ? s.arguments[i].type : s.repeated.type;
            bool any = type.base == BaseType::Invalid || type.is_array();
            fits = fits && (any || arguments[i] & one(type.base));
        }
        if (fits) results |= one(s.result.base);
    }
    return results;
}

bool TypeInference::can_be(const Expr& expr, BaseType type) const {
    if (!is_flexible(expr)) return conversion_cost(expr.type.base, type) == 0;
    return possible_types(expr) & one(type);
}

OperandTypes TypeInference::operand(const Expr& expr) const {
    bool flexible = is_flexible(expr);
    return {flexible, is_picture(expr), flexible ? possible_types(expr) : 0};
}

bool is_picture(const Expr& expr) {
    switch (expr.kind) {
        case ExprKind::Unary:
            return is_picture(*as<UnaryExpr>(expr).operand);
        case ExprKind::Binary: {
            const Expr* left = &expr;
            for (; left->kind == ExprKind::Binary; left = as<BinaryExpr>(*left).left)
                if (is_picture(*as<BinaryExpr>(*left).right)) return true;
            return is_picture(*left);
        }
        case ExprKind::Select:
            return is_picture(*as<SelectExpr>(expr).yes) || is_picture(*as<SelectExpr>(expr).no);
        case ExprKind::Call: {
            std::string_view name = as<CallExpr>(expr).name;
            return name == "texture" || name == "environment" || name == "trace";
        }
        default:
            return false;
    }
}

}  // namespace kinora::rsl
