// rsl/check/assignments.cpp: targets of assignments and outputs of calls.
#include "rsl/check/assignments.h"

#include "rsl/builtins/table.h"

namespace kinora::rsl {

Symbol* lvalue_symbol(Expr& target) {
    if (auto* e = as_if<VariableExpr>(&target)) return e->symbol;
    if (auto* e = as_if<IndexExpr>(&target)) return lvalue_symbol(*e->array);
    if (auto* e = as_if<ComponentExpr>(&target)) return lvalue_symbol(*e->operand);
    return nullptr;
}

bool Assignments::assign(Expr& target) {
    if (target.type.base == BaseType::Invalid) return false;
    Symbol* symbol = lvalue_symbol(target);
    if (!symbol) {
        const auto* call = as_if<CallExpr>(&target);
        Finding& finding = reporter_.report(Code::RSL_NOT_ASSIGNABLE, target.span);
        std::string setter = call ? "set" + std::string(call->name) : "";
        if (call && !find_builtin(setter).empty())
            finding.help = fmt::format("write '{}(target, ..., value)'", setter);
        return false;
    }
    mark(*symbol, target.span);
    return true;
}

void Assignments::assign_result(Expr& argument, size_t index, std::string_view callee) {
    if (argument.type.base == BaseType::Invalid) return;
    if (Symbol* symbol = lvalue_symbol(argument); symbol && !argument.type.is_array())
        mark(*symbol, argument.span);
    else
        reporter_.report(Code::RSL_OUTPUT_ARGUMENT, argument.span, index + 1, callee);
}

void Assignments::mark(Symbol& symbol, const SourceSpan& span) {
    symbol.assigned = true;
    bool parameter =
        symbol.kind == SymbolKind::Parameter || symbol.kind == SymbolKind::FunctionParameter;
    if (parameter && !symbol.output && warned_.insert(&symbol).second)
        reporter_.report(Code::RSL_PARAMETER_ASSIGNED, span, symbol.name);
}

}  // namespace kinora::rsl
