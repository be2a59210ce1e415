// rsl/check/expression.cpp: values, variables, l-values and conversions that the context asks for.
#include "rsl/builtins/table.h"
#include "rsl/check/check.h"
#include "rsl/syntax/ast_visit.h"
#include "rsl/text/did_you_mean.h"

namespace kinora::rsl {

void Checker::expression(Expr*& slot, BaseType wanted) {
    visit_expr(*slot, [&](auto& node) { check(slot, node, wanted); });
}

// Checks the expression as a single value; its type, or Invalid after a finding.
BaseType Checker::value(Expr*& slot, BaseType wanted) {
    expression(slot, wanted);
    if (slot->type.base == BaseType::Void) {
        const auto* call = as_if<CallExpr>(slot);
        report(Code::RSL_VOID_VALUE, slot->span, call ? call->name : std::string_view("this"));
        slot->type = {BaseType::Invalid, -1};
    } else if (slot->type.is_array()) {
        report(Code::RSL_ARRAY_AS_VALUE, slot->span);
        slot->type = {BaseType::Invalid, -1};
    }
    return slot->type.base;
}

// Checks the expression and brings it to the type; `what` names who needs it.
void Checker::convert_to(Expr*& slot, Type type, const std::string& what) {
    if (type.is_array()) return array_value(slot, type, what);
    value(slot, type.base);
    bring_to(slot, type, what);
}

// The same for an expression that has been checked.
void Checker::bring_to(Expr*& slot, Type type, const std::string& what) {
    BaseType from = slot->type.base;
    if (from == BaseType::Invalid || type.base == BaseType::Invalid) return;
    if (convert(slot, type.base)) return;
    report(Code::RSL_TYPE_MISMATCH, slot->span, what, type_name(type), type_name(from)).help =
        conversion_help(from, type.base);
    slot->type = {BaseType::Invalid, -1};
}

void Checker::array_value(Expr*& slot, Type type, const std::string& what) {
    if (auto* literal = as_if<ArrayLiteralExpr>(slot)) {
        for (Expr*& item : literal->items) convert_to(item, type.element(), "the array element");
        if (literal->items.size() > size_t(type.array_length))
            report(Code::RSL_ARRAY_LENGTH, slot->span, literal->items.size(), type.array_length);
        literal->type = type;
        return;
    }
    expression(slot, type.base);
    if (slot->type.base == BaseType::Invalid) return;
    bool fits = slot->type.base == type.base && slot->type.is_array() &&
                (slot->type.array_length == type.array_length || type.array_length == 0 ||
                 slot->type.array_length == 0);
    if (!fits)
        report(Code::RSL_TYPE_MISMATCH, slot->span, what, type_name(type), type_name(slot->type));
}

void Checker::condition(Expr*& slot) {
    BaseType type = value(slot, BaseType::Float);
    if (type == BaseType::Bool || type == BaseType::Invalid) return;
    if (type == BaseType::String) return string_condition(slot);
    if (type != BaseType::Float) {
        report(Code::RSL_CONDITION, slot->span, type_name(type));
        return;
    }
    auto* cast = ast_.make<CastExpr>(slot->span);
    cast->to = BaseType::Bool;
    cast->implicit = true;
    cast->operand = slot;
    cast->type = {BaseType::Bool, -1};
    slot = cast;
}

// A string alone: is it not empty?
void Checker::string_condition(Expr*& slot) {
    report(Code::RSL_STRING_CONDITION, slot->span);
    auto* empty = ast_.make<StringExpr>(slot->span);
    empty->type = {BaseType::String, -1};
    auto* node = ast_.make<BinaryExpr>(slot->span);
    node->op = Op::NotEqual;
    node->left = slot;
    node->right = empty;
    node->type = {BaseType::Bool, -1};
    slot = node;
}

void Checker::check_number(Expr*& slot, const char* what) {
    convert_to(slot, {BaseType::Float, -1}, what);
}

// ---- values -------------------------------------------------------------------------------------

void Checker::check(Expr*&, NumberExpr& e, BaseType) {
    e.type = {BaseType::Float, -1};
}

void Checker::check(Expr*&, StringExpr& e, BaseType) {
    e.type = {BaseType::String, -1};
}

// (x, y, z) is what the context wants, a point if it does not say.
void Checker::check(Expr*&, TripleExpr& e, BaseType wanted) {
    for (Expr*& item : e.items) check_number(item, "a component");
    e.type = {is_triple(wanted) ? wanted : BaseType::Point, -1};
}

void Checker::check(Expr*&, SixteenExpr& e, BaseType) {
    for (Expr*& item : e.items) check_number(item, "a component");
    e.type = {BaseType::Matrix, -1};
}

// Only initialisers may be { }: those go to array_value().
void Checker::check(Expr*&, ArrayLiteralExpr& e, BaseType wanted) {
    Finding& finding = report(Code::RSL_ARRAY_AS_VALUE, e.span);
    if (is_triple(wanted)) finding.help = "write (a, b, c)";
}

void Checker::check(Expr*&, SelectExpr& e, BaseType wanted) {
    condition(e.condition);
    // Where nothing is wanted, the side of fixed type says what the other one is asked to be.
    bool no_first = wanted == BaseType::Invalid && is_flexible(*e.yes) && !is_flexible(*e.no);
    Expr*& first = no_first ? e.no : e.yes;
    Expr*& second = no_first ? e.yes : e.no;
    BaseType type = value(first, wanted);
    value(second, wanted == BaseType::Invalid ? type : wanted);
    BaseType yes = e.yes->type.base, no = e.no->type.base;
    if (yes == BaseType::Invalid || no == BaseType::Invalid) return;
    BaseType common = common_type(yes, no);
    if (common == BaseType::Invalid) {
        report(Code::RSL_BAD_OPERANDS, e.span, "?:", type_name(yes), type_name(no));
        return;
    }
    convert(e.yes, common);
    convert(e.no, common);
    e.type = {common, -1};
}

void Checker::check(Expr*&, CastExpr& e, BaseType) {
    if (e.to == BaseType::Void) {
        value(e.operand, BaseType::Invalid);
        report(Code::RSL_BAD_OPERAND, e.span, "void", "a value");
        return;
    }
    if (e.space) value(e.space, BaseType::String);
    BaseType from = value(e.operand, e.to);
    e.type = {e.to, -1};
    if (from == BaseType::Invalid) return;
    if (e.space && !is_triple(e.to) && e.to != BaseType::Matrix) {
        report(Code::RSL_BAD_SPACE, e.span, type_name(e.to));
    } else if (conversion_cost(from, e.to) < 0) {
        report(Code::RSL_TYPE_MISMATCH, e.span, fmt::format("'{}'", type_name(e.to)),
               "a value that converts to it", type_name(from))
            .help = conversion_help(from, e.to);
    } else if (e.space || from == BaseType::Bool) {
        convert(e.operand, from == BaseType::Bool ? BaseType::Float : e.to);
        if (e.space) convert(e.operand, e.to);
    }
}

// ---- variables ----------------------------------------------------------------------------------

namespace {

// Names of other languages and what RSL has instead.
constexpr struct {
    std::string_view name;
    const char* help;
} kVariableHints[] = {
    {"true", "write '1'"},    {"TRUE", "write '1'"},          {"false", "write '0'"},
    {"FALSE", "write '0'"},   {"M_PI", "write 'PI'"},         {"pi", "write 'PI'"},
    {"NULL", "write '\"\"'"}, {"Nn", "write 'normalize(N)'"}, {"V", "write '-normalize(I)'"},
};

}  // namespace

void Checker::check(Expr*&, VariableExpr& e, BaseType) {
    e.symbol = find_variable(e.name, false);
    bool global = e.symbol && e.symbol->global;  // perhaps hidden by what was skipped
    if (global && recovery_.declares(e.name, e.span.token)) e.symbol = nullptr;
    if (e.symbol) {
        e.type = e.symbol->type;
        return;
    }
    if (recovery_.hides(e.name, e.span.token) || !unknown_.insert(e.name).second) return;
    Finding& finding = report(Code::RSL_UNKNOWN_VARIABLE, e.span, e.name);
    for (const auto& row : kVariableHints)
        if (row.name == e.name) finding.help = row.help;
    if (!finding.help.empty()) return;
    if (!visible_functions(e.name).empty() || !find_builtin(e.name).empty()) {
        finding.help = fmt::format("it is a function, which is called as '{}(...)'", e.name);
        return;
    }
    std::vector<std::string_view> names = variable_names();
    names.insert(names.end(), {"return", "break", "continue"});  // alone in a statement
    finding.help = meant_help(e.name, names);
    returned_ = returned_ || did_you_mean(e.name, names) == "return";
}

// array[i], or a component of a triple.
void Checker::check(Expr*& slot, IndexExpr& e, BaseType) {
    bool triple = is_flexible(*e.array) && can_be(*e.array, BaseType::Color);
    expression(e.array, triple ? BaseType::Color : BaseType::Invalid);
    check_number(e.index, "an index");
    if (e.array->type.base == BaseType::Invalid) return;
    if (e.array->type.is_array()) {
        e.type = e.array->type.element();
        return;
    }
    if (!is_triple(e.array->type)) {
        Finding& finding = report(Code::RSL_NOT_ARRAY, e.span, type_name(e.array->type));
        if (e.array->type.base == BaseType::Matrix) finding.help = "use comp(m, row, column)";
        return;
    }
    auto* component = ast_.make<ComponentExpr>(e.span);
    component->operand = e.array;
    component->index = e.index;
    component->type = {BaseType::Float, -1};
    slot = component;
}

void Checker::check(Expr*&, ComponentExpr& e, BaseType) {
    e.type = {BaseType::Float, -1};
}

// ---- assignment ---------------------------------------------------------------------------------

// The variable that a Variable, Index or Component expression is (part of); else null.
Symbol* Checker::lvalue_symbol(Expr& target) {
    if (auto* e = as_if<VariableExpr>(&target)) return e->symbol;
    if (auto* e = as_if<IndexExpr>(&target)) return lvalue_symbol(*e->array);
    if (auto* e = as_if<ComponentExpr>(&target)) return lvalue_symbol(*e->operand);
    return nullptr;
}

// The expression has been checked. False, with a finding, if it cannot be written to.
bool Checker::check_lvalue(Expr*& slot) {
    if (slot->type.base == BaseType::Invalid) return false;
    Symbol* symbol = lvalue_symbol(*slot);
    if (!symbol) {
        const auto* call = as_if<CallExpr>(slot);
        Finding& finding = report(Code::RSL_NOT_ASSIGNABLE, slot->span);
        std::string setter = call ? "set" + std::string(call->name) : "";
        if (call && !find_builtin(setter).empty())
            finding.help = fmt::format("write '{}(target, ..., value)'", setter);
        return false;
    }
    mark_assigned(*symbol, slot->span);
    return true;
}

void Checker::mark_assigned(Symbol& symbol, const SourceSpan& span) {
    symbol.assigned = true;
    bool parameter =
        symbol.kind == SymbolKind::Parameter || symbol.kind == SymbolKind::FunctionParameter;
    if (parameter && !symbol.output && warned_.insert(&symbol).second)
        report(Code::RSL_PARAMETER_ASSIGNED, span, symbol.name);
}

void Checker::check(Expr*&, AssignExpr& e, BaseType) {
    expression(e.target, BaseType::Invalid);
    Type type = e.target->type;
    if (!check_lvalue(e.target)) {
        type = {BaseType::Invalid, -1};
        value(e.value, BaseType::Invalid);
        return;
    }
    const Symbol& symbol = *lvalue_symbol(*e.target);
    bool factor = (e.op == Op::Multiply || e.op == Op::Divide) && is_triple(type) &&
                  is_flexible(*e.value) && can_be(*e.value, BaseType::Float) &&
                  !(type.base == BaseType::Color && is_picture(*e.value));
    if (type.is_array() && e.op != Op::None) {
        report(Code::RSL_ARRAY_AS_VALUE, e.target->span);
    } else if (factor) {
        value(e.value, BaseType::Float);
        bring_to(e.value, type, "the factor");
    } else {
        convert_to(e.value, type, fmt::format("'{}'", symbol.name));
    }
    bool string = type.base == BaseType::String && e.op != Op::None;
    bool matrix = type.base == BaseType::Matrix && (e.op == Op::Add || e.op == Op::Subtract);
    if ((string || matrix) && e.value->type.base != BaseType::Invalid)
        report(Code::RSL_BAD_OPERANDS, e.span, fmt::format("{}=", op_text(e.op)), type_name(type),
               type_name(e.value->type));
    e.type = type;
}

}  // namespace kinora::rsl
