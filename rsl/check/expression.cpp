// rsl/check/expression.cpp: values, variables, calls, assignments, and what the context wants of
// them.
#include "rsl/check/expression.h"

#include <algorithm>

#include "rsl/builtins/table.h"
#include "rsl/check/convert.h"
#include "rsl/syntax/ast_visit.h"
#include "rsl/syntax/copy_tree.h"

namespace kinora::rsl {

void ExpressionChecker::expression(Expr*& slot, BaseType wanted) {
    visit_expr(*slot, [&](auto& node) { check(slot, node, wanted); });
}

BaseType ExpressionChecker::value(Expr*& slot, BaseType wanted) {
    expression(slot, wanted);
    if (slot->type.base == BaseType::Void) {
        const auto* call = as_if<CallExpr>(slot);
        reporter_.report(Code::RSL_VOID_VALUE, slot->span,
                         call ? call->name : std::string_view("this"));
        slot->type = {BaseType::Invalid, -1};
    } else if (slot->type.is_array()) {
        reporter_.report(Code::RSL_ARRAY_AS_VALUE, slot->span);
        slot->type = {BaseType::Invalid, -1};
    }
    return slot->type.base;
}

void ExpressionChecker::convert_to(Expr*& slot, Type type, const std::string& what) {
    if (type.is_array()) return array_value(slot, type, what);
    value(slot, type.base);
    bring_to(slot, type, what);
}

void ExpressionChecker::bring_to(Expr*& slot, Type type, const std::string& what) {
    BaseType from = slot->type.base;
    if (from == BaseType::Invalid || type.base == BaseType::Invalid) return;
    if (convert(slot, type.base)) return;
    reporter_.report(Code::RSL_TYPE_MISMATCH, slot->span, what, type_name(type), type_name(from))
        .help = conversion_help(from, type.base);
    slot->type = {BaseType::Invalid, -1};
}

void ExpressionChecker::array_value(Expr*& slot, Type type, const std::string& what) {
    if (auto* literal = as_if<ArrayLiteralExpr>(slot)) {
        for (Expr*& item : literal->items) convert_to(item, type.element(), "the array element");
        if (type.array_length > 0 && literal->items.size() > size_t(type.array_length))
            reporter_.report(Code::RSL_ARRAY_LENGTH, slot->span, literal->items.size(),
                             type.array_length);
        literal->type = type;
        return;
    }
    expression(slot, type.base);
    if (slot->type.base == BaseType::Invalid) return;
    bool fits = slot->type.base == type.base && slot->type.is_array() &&
                (slot->type.array_length == type.array_length || type.array_length == 0 ||
                 slot->type.array_length == 0);
    if (!fits)
        reporter_.report(Code::RSL_TYPE_MISMATCH, slot->span, what, type_name(type),
                         type_name(slot->type));
}

void ExpressionChecker::condition(Expr*& slot) {
    value(slot, BaseType::Float);
    to_condition(slot);
}

// The same of a value that has been checked.
void ExpressionChecker::to_condition(Expr*& slot) {
    const BaseType type = slot->type.base;
    if (type == BaseType::Bool || type == BaseType::Invalid) return;
    if (type == BaseType::String) return string_condition(slot);
    if (type != BaseType::Float) {
        reporter_.report(Code::RSL_CONDITION, slot->span, type_name(type));
        return;
    }
    convert_to_condition(ast_, slot);
}

// A string alone: is it not empty?
void ExpressionChecker::string_condition(Expr*& slot) {
    reporter_.report(Code::RSL_STRING_CONDITION, slot->span);
    auto* empty = ast_.make<StringExpr>(slot->span);
    empty->type = {BaseType::String, -1};
    auto* node = ast_.make<BinaryExpr>(slot->span);
    node->op = Op::NotEqual;
    node->left = slot;
    node->right = empty;
    node->type = {BaseType::Bool, -1};
    slot = node;
}

void ExpressionChecker::check_number(Expr*& slot, const char* what) {
    convert_to(slot, {BaseType::Float, -1}, what);
}

// ---- values -------------------------------------------------------------------------------------

void ExpressionChecker::check(Expr*&, NumberExpr& e, BaseType) {
    e.type = {BaseType::Float, -1};
}

void ExpressionChecker::check(Expr*&, StringExpr& e, BaseType) {
    e.type = {BaseType::String, -1};
}

// (x, y, z) is what the context wants, a point if it does not say.
void ExpressionChecker::check(Expr*&, TripleExpr& e, BaseType wanted) {
    for (Expr*& item : e.items) check_number(item, "a component");
    e.type = {is_triple(wanted) ? wanted : BaseType::Point, -1};
}

void ExpressionChecker::check(Expr*&, SixteenExpr& e, BaseType) {
    for (Expr*& item : e.items) check_number(item, "a component");
    e.type = {BaseType::Matrix, -1};
}

// Only initialisers may be { }: those go to array_value().
void ExpressionChecker::check(Expr*&, ArrayLiteralExpr& e, BaseType wanted) {
    Finding& finding = reporter_.report(Code::RSL_ARRAY_AS_VALUE, e.span);
    if (is_triple(wanted)) finding.help = "write (a, b, c)";
}

void ExpressionChecker::check(Expr*&, SelectExpr& e, BaseType wanted) {
    condition(e.condition);
    // Where nothing is wanted, the side of fixed type says what the other one is asked to be.
    bool no_first =
        wanted == BaseType::Invalid && types_.is_flexible(*e.yes) && !types_.is_flexible(*e.no);
    Expr*& first = no_first ? e.no : e.yes;
    Expr*& second = no_first ? e.yes : e.no;
    BaseType type = value(first, wanted);
    value(second, wanted == BaseType::Invalid ? type : wanted);
    BaseType yes = e.yes->type.base, no = e.no->type.base;
    if (yes == BaseType::Invalid || no == BaseType::Invalid) return;
    BaseType common = common_type(yes, no);
    if (common == BaseType::Invalid) {
        reporter_.report(Code::RSL_BAD_OPERANDS, e.span, "?:", type_name(yes), type_name(no));
        return;
    }
    convert(e.yes, common);
    convert(e.no, common);
    e.type = {common, -1};
}

void ExpressionChecker::check(Expr*&, CastExpr& e, BaseType) {
    if (e.to == BaseType::Void) {
        value(e.operand, BaseType::Invalid);
        reporter_.report(Code::RSL_BAD_OPERAND, e.span, "void", "a value");
        return;
    }
    if (e.space) value(e.space, BaseType::String);
    BaseType from = value(e.operand, e.to);
    e.type = {e.to, -1};
    if (from == BaseType::Invalid) return;
    if (e.space && !is_triple(e.to) && e.to != BaseType::Matrix) {
        reporter_.report(Code::RSL_BAD_SPACE, e.span, type_name(e.to));
    } else if (conversion_cost(from, e.to) < 0) {
        reporter_
            .report(Code::RSL_TYPE_MISMATCH, e.span, fmt::format("'{}'", type_name(e.to)),
                    "a value that converts to it", type_name(from))
            .help = conversion_help(from, e.to);
    } else if (e.space || from == BaseType::Bool) {
        convert(e.operand, from == BaseType::Bool ? BaseType::Float : e.to);
        if (e.space) convert(e.operand, e.to);
    }
}

// ---- variables ----------------------------------------------------------------------------------

void ExpressionChecker::check(Expr*&, VariableExpr& e, BaseType) {
    e.symbol = scopes_.find_variable(e.name);
    bool global = e.symbol && e.symbol->global;  // perhaps hidden by what was skipped
    if (global && recovery_.declares(e.name, e.span.token)) e.symbol = nullptr;
    if (e.symbol) {
        e.type = e.symbol->type;
        return;
    }
    unknown_.variable(e);
}

// array[i], or a component of a triple.
void ExpressionChecker::check(Expr*& slot, IndexExpr& e, BaseType) {
    bool triple = types_.is_flexible(*e.array) && types_.can_be(*e.array, BaseType::Color);
    expression(e.array, triple ? BaseType::Color : BaseType::Invalid);
    check_number(e.index, "an index");
    if (e.array->type.base == BaseType::Invalid) return;
    if (e.array->type.is_array()) {
        e.type = e.array->type.element();
        return;
    }
    if (!is_triple(e.array->type)) {
        Finding& finding = reporter_.report(Code::RSL_NOT_ARRAY, e.span, type_name(e.array->type));
        if (e.array->type.base == BaseType::Matrix) finding.help = "use comp(m, row, column)";
        return;
    }
    auto* component = ast_.make<ComponentExpr>(e.span);
    component->operand = e.array;
    component->index = e.index;
    component->type = {BaseType::Float, -1};
    slot = component;
}

void ExpressionChecker::check(Expr*&, ComponentExpr& e, BaseType) {
    e.type = {BaseType::Float, -1};
}

// ---- calls --------------------------------------------------------------------------------------

// Arguments are checked before the callee is chosen, except those whose type it will choose.
void ExpressionChecker::check(Expr*& slot, CallExpr& e, BaseType wanted) {
    std::vector<Function*> functions = scopes_.find_functions(e.name);
    if (functions.empty() && NamedOutputs::is_call(e.name)) {
        for (Expr*& argument : e.args) expression(argument, BaseType::Invalid);
        return outputs_.bind(slot, e);
    }
    bool builtin = functions.empty() && !find_builtin(e.name).empty();
    if (builtin && calls_.take_channel(e)) check_number(e.channel, "a channel");
    if (builtin) {
        calls_.group_source(e);
        calls_.split_channels(e);
    }
    for (Expr*& argument : e.args) {
        if (auto* corners = as_if<ArrayLiteralExpr>(argument); corners && corners->type.is_array())
            for (Expr*& corner : corners->items)
                convert_to(corner, corners->type.element(), "a corner of \"source\"");
        else if (!types_.is_flexible(*argument))
            expression(argument, BaseType::Invalid);
    }
    if (functions.empty() && !builtin && written_name(e.name) != e.name) return no_struct_form(e);
    if (functions.empty() && !builtin) return unknown_.function(e);
    Callee callee = overloads_.choose(e, functions, wanted);
    if (!callee) return no_form(e, functions);
    size_t written = e.args.size();
    if (callee.function && !add_defaults(e, *callee.function)) {
        e.type = callee.function->result;
        return;
    }
    calls_.begin(e, callee);
    bool defaults = e.args.size() > written;
    defaults_ += defaults;
    for (size_t i = 0; i < e.args.size(); ++i) {
        if (types_.is_open(*e.args[i])) expression(e.args[i], calls_.parameter(e, i).type.base);
        calls_.bind_argument(e, i);
    }
    defaults_ -= defaults;
    calls_.end(e);
}

// Arguments that are left out: the parameters' defaults, which were checked where they stand, or,
// before that, mean what they mean here. False: they call each other without end.
bool ExpressionChecker::add_defaults(CallExpr& e, const Function& f) {
    if (e.args.size() >= f.parameters.size()) return true;
    constexpr int kMostDefaults = 4;
    if (endless_defaults_) return false;
    if (defaults_ == kMostDefaults) {
        endless_defaults_ = true;
        reporter_.report(Code::RSL_TOO_DEEP, e.span, fmt::format("{} defaults", kMostDefaults));
        return false;
    }
    ++defaults_;
    std::vector<Expr*> args(e.args.begin(), e.args.end());
    for (size_t k = args.size(); k < f.parameters.size() && f.parameters[k]->initial; ++k) {
        args.push_back(copy_tree(ast_, *f.parameters[k]->initial));
        if (args[k]->type.base == BaseType::Invalid)
            convert_to(args[k], f.parameters[k]->type, fmt::format("'{}'", f.parameters[k]->name));
    }
    --defaults_;
    e.args = ast_.arena.copy(args);
    return true;
}

// A struct is no argument of any function of that name.
void ExpressionChecker::no_struct_form(CallExpr& e) {
    std::string_view name = written_name(e.name), structs = e.name.substr(name.size());
    std::vector<std::string_view> known = scopes_.function_names();
    bool exists = !find_builtin(name).empty() ||
                  std::any_of(known.begin(), known.end(),
                              [&](std::string_view other) { return written_name(other) == name; });
    e.name = name;
    if (!exists) return unknown_.function(e);
    std::string types;
    for (size_t at = 1; at < structs.size();) {
        size_t end = std::min(structs.find(' ', at), structs.size());
        std::string type(structs.substr(at, end - at));
        types += (types.empty() ? "" : ", ") + (type == "shader" ? type : "struct " + type);
        at = end + 1;
    }
    reporter_.report(Code::RSL_NO_OVERLOAD, e.span, name, types);
}

// Neither a function of the source nor a built-in one takes these arguments.
void ExpressionChecker::no_form(CallExpr& e, std::span<Function* const> functions) {
    if (functions.size() == 1) {
        const Function& only = *functions[0];
        e.type = only.result;
        if (only.damaged) return;  // its parameters may be among what is missing
        size_t written = written_parameters(only);
        reporter_
            .report(Code::RSL_ARGUMENT_COUNT, e.span, written_name(e.name), written,
                    e.args.size() + written - only.parameters.size())
            .notes.push_back({only.span.where, "defined here"});
        return;
    }
    std::string types;
    for (const Expr* argument : e.args) {
        if (argument->type.base == BaseType::Invalid && !types_.is_flexible(*argument)) return;
        if (!types.empty()) types += ", ";
        bool triple = argument->kind == ExprKind::Triple;
        types += !types_.is_open(*argument) ? type_name(argument->type)
                 : triple                   ? "triple"
                                            : "float or triple";
    }
    calls_.report_no_form(e, functions, types);
}

// ---- assignment ---------------------------------------------------------------------------------

void ExpressionChecker::check(Expr*&, AssignExpr& e, BaseType) {
    expression(e.target, BaseType::Invalid);
    Type type = e.target->type;
    if (!assignments_.assign(*e.target)) {
        type = {BaseType::Invalid, -1};
        value(e.value, BaseType::Invalid);
        return;
    }
    const Symbol& symbol = *lvalue_symbol(*e.target);
    bool factor = (e.op == Op::Multiply || e.op == Op::Divide) && is_triple(type) &&
                  types_.is_flexible(*e.value) && types_.can_be(*e.value, BaseType::Float) &&
                  !(type.base == BaseType::Color && is_picture(*e.value));
    if (type.is_array() && e.op != Op::None) {
        reporter_.report(Code::RSL_ARRAY_AS_VALUE, e.target->span);
    } else if (factor) {
        value(e.value, BaseType::Float);
        bring_to(e.value, type, "the factor");
    } else {
        convert_to(e.value, type, fmt::format("'{}'", symbol.name));
    }
    bool string = type.base == BaseType::String && e.op != Op::None;
    bool matrix = type.base == BaseType::Matrix && (e.op == Op::Add || e.op == Op::Subtract);
    if ((string || matrix) && e.value->type.base != BaseType::Invalid)
        reporter_.report(Code::RSL_BAD_OPERANDS, e.span, fmt::format("{}=", op_text(e.op)),
                         type_name(type), type_name(e.value->type));
    e.type = type;
}

}  // namespace kinora::rsl
