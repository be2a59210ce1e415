// rsl/objects/build_tree.cpp: new nodes of an unchecked tree.
#include "rsl/objects/build_tree.h"

#include "rsl/syntax/copy_tree.h"

namespace kinora::rsl {

Expr* TreeBuilder::variable(std::string_view name) {
    auto* node = ast_.make<VariableExpr>(span_);
    node->name = ast_.arena.copy(name);
    return node;
}

Expr* TreeBuilder::text(std::string_view value) {
    auto* node = ast_.make<StringExpr>(span_);
    node->value = ast_.arena.copy(value);
    return node;
}

Expr* TreeBuilder::number(double value) {
    auto* node = ast_.make<NumberExpr>(span_);
    node->value = value;
    return node;
}

Expr* TreeBuilder::element(std::string_view array, const Expr& index, size_t* nodes) {
    auto* node = ast_.make<IndexExpr>(span_);
    node->array = variable(array);
    node->index = copy_tree(ast_, index, nodes);
    return node;
}

Expr* TreeBuilder::binary(Op op, Expr* left, Expr* right) {
    auto* node = ast_.make<BinaryExpr>(span_);
    node->op = op;
    node->left = left;
    node->right = right;
    return node;
}

Expr* TreeBuilder::cast(BaseType to, Expr* operand) {
    auto* node = ast_.make<CastExpr>(span_);
    node->to = to;
    node->operand = operand;
    return node;
}

Expr* TreeBuilder::call(std::string_view name, std::vector<Expr*> args) {
    auto* node = ast_.make<CallExpr>(span_);
    node->name = ast_.arena.copy(name);
    node->args = ast_.arena.copy(args);
    node->site = ast_.site_count++;
    return node;
}

Stmt* TreeBuilder::effect(Expr* expression) {
    auto* node = ast_.make<ExpressionStmt>(span_);
    node->expression = expression;
    return node;
}

Stmt* TreeBuilder::assign(Expr* target, Expr* value) {
    auto* node = ast_.make<AssignExpr>(span_);
    node->target = target;
    node->value = value;
    return effect(node);
}

BlockStmt* TreeBuilder::block(std::vector<Stmt*> body) {
    auto* node = ast_.make<BlockStmt>(span_);
    node->body = ast_.arena.copy(body);
    return node;
}

IfStmt* TreeBuilder::branch(Expr* condition, std::vector<Stmt*> body) {
    auto* node = ast_.make<IfStmt>(span_);
    node->condition = condition;
    node->yes = block(std::move(body));
    return node;
}

Stmt* TreeBuilder::declare(std::vector<Symbol*> symbols) {
    auto* node = ast_.make<DeclareStmt>(span_);
    node->symbols = ast_.arena.copy(symbols);
    return node;
}

Symbol* TreeBuilder::symbol(SymbolKind kind, std::string_view name, Type type) {
    auto* made = ast_.arena.make<Symbol>();
    made->kind = kind;
    made->name = ast_.arena.copy(name);
    made->type = type;
    made->id = ast_.symbol_count++;
    made->span = span_;
    return made;
}

}  // namespace kinora::rsl
