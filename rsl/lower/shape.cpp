// rsl/lower/shape.cpp: which parameters decide a kernel's shape.
#include <utility>
#include <vector>

#include "rsl/lower/lower.h"
#include "rsl/model/changes.h"

namespace kinora::rsl {

namespace {

// Follows uniform values from parameters into conditions, through the variables between.
class ShapeWalk {
  public:
    explicit ShapeWalk(const Shader& shader) : sources_(shader.ast->symbol_count) {
        visit(shader.definition->body);
        for (const Function* function : shader.functions) visit(function->body);
        std::vector<const Symbol*> open(conditions_.begin(), conditions_.end());
        reached.resize(shader.ast->symbol_count);
        while (!open.empty()) {
            const Symbol* symbol = open.back();
            open.pop_back();
            if (std::exchange(reached[symbol->id], 1)) continue;
            auto& from = sources_[symbol->id];
            open.insert(open.end(), from.begin(), from.end());
        }
    }

    std::vector<uint8_t> reached;  // by Symbol::id

  private:
    template <class F>
    void for_each_variable(const Expr& e, F&& f) {
        if (auto* variable = as_if<VariableExpr>(&e)) f(variable->symbol);
        for_each_operand(e, [&](const Expr* operand) { for_each_variable(*operand, f); });
    }

    void condition(const Expr* e) {
        if (!e || e->rate == Rate::Varying) return;
        for_each_variable(*e, [&](const Symbol* symbol) { conditions_.push_back(symbol); });
    }

    void flows(const Expr& from, const Symbol* to) {
        for_each_variable(from, [&](const Symbol* s) { sources_[to->id].push_back(s); });
    }

    void visit(const Stmt* stmt) {
        for_each_part(
            *stmt, [&](const Expr* e) { visit(e); }, [&](const Stmt* part) { visit(part); });
        if (auto* node = as_if<IfStmt>(stmt)) condition(node->condition);
        if (auto* node = as_if<WhileStmt>(stmt)) condition(node->condition);
        if (auto* node = as_if<ForStmt>(stmt)) condition(node->condition);
        if (auto* node = as_if<DeclareStmt>(stmt))
            for (const Symbol* symbol : node->symbols)
                if (symbol->initial) flows(*symbol->initial, symbol);
    }

    void visit(const Expr* e) {
        for_each_operand(*e, [&](const Expr* operand) { visit(operand); });
        if (auto* node = as_if<SelectExpr>(e)) condition(node->condition);
        if (auto* node = as_if<AssignExpr>(e)) {
            for_each_variable(*node->target,
                              [&](const Symbol* symbol) { flows(*node->value, symbol); });
        }
        auto* call = as_if<CallExpr>(e);
        if (!call || !call->function) return;
        for (size_t k = 0; k < call->args.size(); ++k)
            flows(*call->args[k], call->function->parameters[k]);
    }

    std::vector<std::vector<const Symbol*>> sources_;  // by Symbol::id
    std::vector<const Symbol*> conditions_;
};

}  // namespace

std::vector<bool> shape_parameters(const Shader& shader) {
    ShapeWalk walk(shader);
    std::vector<bool> result;
    for (const ShaderParameter& parameter : shader.parameters)
        result.push_back(parameter.type.base == BaseType::String ||
                         walk.reached[parameter.symbol->id]);
    return result;
}

}  // namespace kinora::rsl
