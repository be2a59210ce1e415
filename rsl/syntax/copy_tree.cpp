// rsl/syntax/copy_tree.cpp: copies of expressions.
#include "rsl/syntax/copy_tree.h"

#include "rsl/syntax/ast_visit.h"
#include "rsl/syntax/chain.h"

namespace kinora::rsl {

namespace {

class Copier {
  public:
    explicit Copier(Ast& ast) : ast_(ast) {}

    Expr* copy(const Expr* e) {
        if (!e) return nullptr;
        Expr* top = node_alone(*e);
        for (Expr* made = top;;) {
            Expr** left = left_in_chain(*made);
            if (!left) {
                visit_expr(*made, [&](auto& node) { parts(node); });
                return top;
            }
            if (auto* node = as_if<BinaryExpr>(made)) node->right = copy(node->right);
            made = *left = node_alone(**left);
        }
    }

    size_t nodes = 0;

  private:
    Expr* node_alone(const Expr& e) {
        ++nodes;
        return visit_expr(e, [&](const auto& node) -> Expr* {
            auto* made = ast_.arena.make<std::remove_cvref_t<decltype(node)>>();
            *made = node;
            return made;
        });
    }
    void parts(NumberExpr&) {}
    void parts(StringExpr&) {}
    void parts(VariableExpr&) {}
    void parts(IndexExpr& e) { e.array = copy(e.array), e.index = copy(e.index); }
    void parts(ComponentExpr& e) { e.operand = copy(e.operand), e.index = copy(e.index); }
    void parts(UnaryExpr& e) { e.operand = copy(e.operand); }
    void parts(BinaryExpr&) {}  // copy()
    void parts(SelectExpr& e) {
        e.condition = copy(e.condition), e.yes = copy(e.yes), e.no = copy(e.no);
    }
    void parts(AssignExpr& e) { e.target = copy(e.target), e.value = copy(e.value); }
    void parts(CallExpr& e) {
        e.args = list(e.args), e.channel = copy(e.channel);
        e.site = ast_.site_count++;
    }
    void parts(CastExpr& e) { e.space = copy(e.space), e.operand = copy(e.operand); }
    void parts(TripleExpr& e) {
        for (Expr*& item : e.items) item = copy(item);
    }
    void parts(SixteenExpr& e) { e.items = list(e.items); }
    void parts(ArrayLiteralExpr& e) { e.items = list(e.items); }
    std::span<Expr*> list(std::span<Expr*> items) {
        std::vector<Expr*> copies;
        for (const Expr* item : items) copies.push_back(copy(item));
        return ast_.arena.copy(copies);
    }

    Ast& ast_;
};

}  // namespace

Expr* copy_tree(Ast& ast, const Expr& e, size_t* nodes) {
    Copier copier(ast);
    Expr* made = copier.copy(&e);
    if (nodes) *nodes += copier.nodes;
    return made;
}

}  // namespace kinora::rsl
