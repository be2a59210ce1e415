// rsl/lint/indices.cpp: constant indices outside of what they index.
#include <fmt/format.h>

#include <string>

#include "rsl/lint/lint_p.h"
#include "rsl/text/findings.h"

namespace kinora::rsl {

namespace {

// The index where it is known without running; that of a variable that has its first value only.
std::optional<double> known_index(const Expr& index) {
    const auto* variable = as_if<VariableExpr>(&index);
    if (!variable) return number_of(index);
    const Symbol& symbol = *variable->symbol;
    bool first_value = symbol.kind == SymbolKind::Local && !symbol.global && !symbol.assigned;
    return first_value && symbol.initial ? number_of(*symbol.initial) : std::nullopt;
}

class IndexLint {
  public:
    explicit IndexLint(LintSource& source) : source_(source) {}

    void at(const Expr& e) {
        if (const auto* element = as_if<IndexExpr>(&e))
            in_array(*element);
        else if (const auto* component = as_if<ComponentExpr>(&e))
            check(*component->index, 3, fmt::format("a {}", type_name(component->operand->type)));
        else if (const auto* call = as_if<CallExpr>(&e))
            of_builtin(*call);
    }

  private:
    // Of arrays whose length may change only what lies before the first element is known.
    void in_array(const IndexExpr& e) {
        const auto* array = as_if<VariableExpr>(e.array);
        if (!array) return;
        const Symbol& symbol = *array->symbol;
        bool fixed = symbol.type.array_length > 0 && !symbol.open && !symbol.resizable;
        check(*e.index, fixed ? symbol.type.array_length : 0,
              fmt::format("array '{}'", symbol.name));
    }

    // comp(c, i), comp(m, row, column) and setcomp().
    void of_builtin(const CallExpr& e) {
        if (!e.builtin || (e.name != "comp" && e.name != "setcomp")) return;
        BaseType type = e.args[0]->type.base;
        bool matrix = type == BaseType::Matrix;
        for (size_t k = 1; k < (matrix ? 3u : 2u); ++k)
            check(*e.args[k], matrix ? 4 : 3, fmt::format("a {}", type_name(type)));
    }

    // `length` 0: not known.
    void check(const Expr& index, int length, const std::string& what) {
        std::optional<double> known =
            source_.is_own(index.span) ? known_index(index) : std::nullopt;
        if (!known || (*known >= 0 && (length == 0 || *known < length))) return;
        source_.reporter.report(Code::RSL_INDEX_RANGE, index.span, fmt::format("{:g}", *known),
                                what,
                                length == 0   ? "0 and above"
                                : length == 1 ? "0"
                                              : fmt::format("0 to {}", length - 1));
    }

    LintSource& source_;
};

}  // namespace

void lint_indices(LintSource& source) {
    IndexLint lint(source);
    for_each_node(
        source, [&](const Expr& e) { lint.at(e); }, [](const Stmt&) {});
}

}  // namespace kinora::rsl
