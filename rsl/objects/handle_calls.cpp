// rsl/objects/handle_calls.cpp: expressions with shaders in them become numbers and plain calls.
#include "rsl/objects/handle_calls.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "rsl/objects/expand.h"
#include "rsl/syntax/copy_tree.h"
#include "runtime/base/numbers.h"

namespace kinora::rsl {

namespace {

// "@3": the handle of that number, in trees that are made here.
constexpr char kNumber = '@';

bool names(const Expr& e, std::string_view name) {
    const auto* named = as_if<VariableExpr>(&e);
    return named && named->name == name;
}

const CallExpr* list_call(const Expr* e) {
    const auto* node = as_if<CallExpr>(e);
    bool list = node && (node->name == "getshaders" || node->name == "getlights");
    return list && !node->method ? node : nullptr;
}

bool of_lights(const CallExpr& list) {
    return list.name == "getlights";
}

}  // namespace

// ---- what is a handle ---------------------------------------------------------------------------

// The last member of a path from a variable on; null where it leads through a shader, or nowhere.
const Symbol* HandleCalls::symbol_at(std::string_view path) const {
    std::string_view first = first_name(path);
    if (first == "this" && !expander_.owner_ && expander_.class_ && is_member(path))
        return symbol_at(path.substr(first.size() + kArrow.size()));
    const Symbol* symbol = expander_.find(first);
    if (!symbol) symbol = expander_.member_of_object(first);
    const StructDefinition* structure = symbol ? symbol->structure : nullptr;
    if (first == "this" && expander_.owner_) structure = expander_.owner_;
    for (path.remove_prefix(first.size()); !path.empty();) {
        path.remove_prefix(kArrow.size());
        std::string_view next = first_name(path);
        symbol = structure ? find_member(*structure, next) : nullptr;
        if (!symbol) return nullptr;
        structure = symbol->structure;
        path.remove_prefix(next.size());
    }
    return symbol;
}

bool HandleCalls::is_handle_path(std::string_view path) const {
    if (!path.empty() && path[0] == kNumber) return true;
    if (const Symbol* symbol = symbol_at(path)) return symbol->handle;
    if (path == "this") return !expander_.owner_;
    if (!is_member(path)) return path == "null" || path == "surface";
    std::string_view object = object_of(path);
    if (object.empty()) return false;
    VariableExpr e;
    e.kind = ExprKind::Variable;
    e.name = object;
    auto found = members(sets_.of(expander_.unit_, e), path.substr(object.size() + kArrow.size()));
    return !found.empty() && found[0].symbol->handle;
}

// The shader in "a->b->c" whose member the rest is: "a", or "a->b"; "" if there is none.
std::string_view HandleCalls::object_of(std::string_view path) const {
    for (std::string_view object = path; is_member(object);) {
        object = last_path(object);
        if (object != "this" && is_handle_path(object)) return object;
    }
    return {};
}

bool HandleCalls::is_handle(const Expr& e) const {
    switch (e.kind) {
        case ExprKind::Variable:
            return is_handle_path(as<VariableExpr>(e).name);
        case ExprKind::Index:
            return is_handle(*as<IndexExpr>(e).array);
        case ExprKind::Select:
            return is_handle(*as<SelectExpr>(e).yes);
        case ExprKind::Assign:
            return is_handle(*as<AssignExpr>(e).target);
        case ExprKind::Call:
            break;
        default:
            return false;
    }
    const auto& node = as<CallExpr>(e);
    if (!node.method)
        return node.name == "getshader" || node.name == "lighthandle" || list_call(&node) ||
               sets_.gives_handle(expander_.unit_, node.name);
    if (!is_handle(*node.args[0])) return false;
    std::vector<size_t> units = units_of(sets_.of(expander_.unit_, *node.args[0]));
    return std::any_of(units.begin(), units.end(),
                       [&](size_t k) { return sets_.gives_handle(k, node.name); });
}

void HandleCalls::check(const Expr& e) {
    auto no_handle = [&](const Expr* operand) {
        if (operand && is_handle(*operand))
            expander_.report(Code::RSL_HANDLE_AS_VALUE, operand->span);
    };
    if (const auto* node = as_if<BinaryExpr>(&e)) {
        bool left = is_handle(*node->left), right = is_handle(*node->right);
        bool compares = node->op == Op::Equal || node->op == Op::NotEqual;
        bool tests = node->op == Op::And || node->op == Op::Or;
        if (!tests && (left || right) && !(compares && left && right))
            expander_.report(Code::RSL_HANDLE_AS_VALUE, (left ? node->left : node->right)->span);
    } else if (const auto* cast = as_if<CastExpr>(&e)) {
        no_handle(cast->operand);
    } else if (const auto* triple = as_if<TripleExpr>(&e)) {
        for (const Expr* item : triple->items) no_handle(item);
    } else if (const auto* unary = as_if<UnaryExpr>(&e)) {
        if (unary->op == Op::Negate) no_handle(unary->operand);
    } else if (const auto* assign = as_if<AssignExpr>(&e)) {
        const Expr* target = assign->target;
        if (const auto* element = as_if<IndexExpr>(target)) target = element->array;
        const auto* named = as_if<VariableExpr>(target);
        if (named && !object_of(named->name).empty())
            expander_.report(Code::RSL_CO_SHADER_WRITE, target->span);
        else if (is_handle(*assign->target) && !is_handle(*assign->value))
            expander_.report(Code::RSL_HANDLE_WANTED, assign->value->span);
        else if (!is_handle(*assign->target))
            no_handle(assign->value);
    }
}

// ---- values -------------------------------------------------------------------------------------

bool HandleCalls::rewrite(Expr*& slot) {
    if (slot->kind == ExprKind::Variable) return variable(slot);
    if (slot->kind == ExprKind::Call) return call(slot);
    auto* element = as_if<IndexExpr>(slot);
    auto* array = element ? as_if<VariableExpr>(element->array) : nullptr;
    if (!array || object_of(array->name).empty()) return false;
    read_member(slot, *array, element->index);
    return true;
}

bool HandleCalls::variable(Expr*& slot) {
    auto& e = as<VariableExpr>(*slot);
    TreeBuilder make(ast_, e.span);
    if (e.name[0] == kNumber) {
        slot = make.number(number_of<double>(e.name.substr(1)).value_or(0));
        return true;
    }
    if (is_member(e.name)) {
        if (object_of(e.name).empty()) return false;
        read_member(slot, e, nullptr);
        return true;
    }
    if (symbol_at(e.name) || !is_handle_path(e.name)) return false;
    size_t own = e.name == "surface" ? 0 : expander_.unit_;
    slot = make.number(e.name == "null" ? 0 : double(own + 1));
    return true;
}

std::vector<HandleCalls::Member> HandleCalls::members(HandleSet set, std::string_view path) const {
    std::vector<Member> found;
    for (size_t k : units_of(set)) {
        std::string_view first = first_name(path), rest = path.substr(first.size());
        const Symbol* symbol = units_[k].find_member(first);
        while (symbol && !rest.empty()) {
            rest.remove_prefix(kArrow.size());
            std::string_view next = first_name(rest);
            symbol = symbol->structure ? find_member(*symbol->structure, next) : nullptr;
            rest.remove_prefix(next.size());
        }
        bool same = symbol && (found.empty() || found[0].symbol->type == symbol->type);
        if (same) found.push_back({k, symbol});
    }
    return found;
}

// Whether the one that was found is the only shader that is possible.
bool HandleCalls::knows(HandleSet set, const std::vector<Member>& found) const {
    return found.size() == 1 && set == handle_of(found[0].unit);
}

// a->b and a->b[index]; where there is no such member: 0.
void HandleCalls::read_member(Expr*& slot, VariableExpr& member, Expr* index) {
    TreeBuilder make(ast_, member.span);
    std::string_view object = object_of(member.name);
    std::string_view path = member.name.substr(object.size() + kArrow.size());
    Expr* handle = make.variable(object);
    if (const Symbol* list = symbol_at(object); index && list && list->type.is_array()) {
        size_t nodes = 0;  // all[i]->member
        expander_.expr(index);
        handle = make.element(object, *std::exchange(index, nullptr), &nodes);
    }
    HandleSet set = sets_.of(expander_.unit_, *handle);
    std::vector<Member> found = members(set, path);
    if (index) expander_.expr(index);
    if (set & kLightHandles) {
        if (index || (set & ~(kNullHandle | kLightHandles))) {
            expander_.report(Code::RSL_LIGHT_MEMBER, member.span, path);
            slot = make.number(0);
            return;
        }
        slot = make.call("light_member", {handle, make.text(path)});
        return expander_.call(as<CallExpr>(*slot));
    }
    if (found.empty()) {
        if (set & ~kNullHandle) expander_.report(Code::RSL_CO_SHADER_MEMBER, member.span, path);
        slot = make.number(0);
        return;
    }
    stands_in_body();
    if (knows(set, found)) {
        member.name = ast_.arena.copy(units_[found[0].unit].prefix() + std::string(path));
        return;
    }
    const Symbol& first = *found[0].symbol;
    if (first.structure || first.type.is_array() != (index != nullptr)) {
        expander_.report(Code::RSL_HANDLE_UNKNOWN, member.span, path);
        return;
    }
    std::string name = fmt::format("{}{}@{:x}", path, index ? "[]" : "", set);
    Symbol result = first;
    result.type = first.type.element();
    std::vector<Symbol*> formals;
    if (index)
        formals.push_back(
            make.symbol(SymbolKind::FunctionParameter, "index", {BaseType::Float, -1}));
    std::vector<Case> cases;
    for (const Member& one : found) {
        std::string from = units_[one.unit].prefix() + std::string(path);
        size_t nodes = 0;
        Expr* value =
            index ? make.element(from, *make.variable("index"), &nodes) : make.variable(from);
        cases.push_back({one.unit, {make.assign(make.variable("result of call"), value)}});
    }
    add_function(name, result, formals, cases, member.span);
    slot = call_by_handle(name, handle, index ? std::vector<Expr*>{index} : std::vector<Expr*>(),
                          member.span);
}

// ---- calls --------------------------------------------------------------------------------------

bool HandleCalls::call(Expr*& slot) {
    auto& e = as<CallExpr>(*slot);
    TreeBuilder make(ast_, e.span);
    if (is_call(e)) {
        std::string_view method = e.name;
        if (resolve(e)) {
            expander_.call(e);
            return true;
        }
        slot = make.number(0);
        if (sets_.of(expander_.unit_, *e.args[0]) & kNullHandle)
            slot = make.call("nullcall", {make.text(method)});
        return true;
    }
    if (e.method) return false;
    if (expander_.outputs_.rewrite(e)) {
        stands_in_body();
        expander_.exprs(e.args);
        return true;
    }
    if (e.name == "getshader" && e.args.size() == 1) {
        slot = handle(e);
        if (slot->kind != ExprKind::Number) expander_.expr(slot);
        return true;
    }
    if (list_call(&e)) {
        expander_.report(Code::RSL_ARRAY_AS_VALUE, e.span);
        return true;
    }
    if (e.name == "readprimvar") {  // getvar(null, ...)
        std::vector<Expr*> args(e.args.begin(), e.args.end());
        args.insert(args.begin(), make.variable("null"));
        e.args = ast_.arena.copy(args);
        e.name = "getvar";
    }
    bool of_handle = !e.args.empty() && is_handle(*e.args[0]);
    if (!of_handle || (e.name != "getvar" && e.name != "hasmethod")) return false;
    bool named = e.args.size() > 1 && e.args[1]->kind == ExprKind::String;
    if (!named && (e.name == "hasmethod" || e.args.size() < 2)) {
        expander_.report(Code::RSL_STRING_NOT_CONSTANT, e.span, e.name);
        slot = make.number(0);
        return true;
    }
    slot = e.name == "hasmethod" ? has_method(e) : named ? variable_read(e) : read_by_text(e);
    return true;
}

// getshader(): the number, or a choice by the text.
Expr* HandleCalls::handle(const CallExpr& e) {
    TreeBuilder make(ast_, e.span);
    HandleSet set = sets_.of(expander_.unit_, e);
    std::string wanted = text_of(units_[expander_.unit_], *e.args[0]).value_or("");
    if (units_.size() > 1 && set == kNullHandle && !wanted.empty() && wanted != "null")
        expander_.report(Code::RSL_GETSHADER_NULL, e.span, wanted);
    if (e.args[0]->kind == ExprKind::String) return make.number(double(std::countr_zero(set)));
    Expr* chosen = make.number(0);
    for (size_t k : units_of(set)) {
        auto* text = ast_.make<StringExpr>(e.span);
        text->value = ast_.arena.copy(units_[k].handle);
        auto* choice = ast_.make<SelectExpr>(e.span);
        choice->condition = make.binary(Op::Equal, copy_tree(ast_, *e.args[0]), text);
        choice->yes = make.number(double(k + 1));
        choice->no = chosen;
        chosen = choice;
    }
    return chosen;
}

ArrayLiteralExpr* HandleCalls::list(const CallExpr& e) {
    TreeBuilder make(ast_, e.span);
    if (of_lights(e)) return nullptr;
    std::optional<std::string> category;
    if (e.args.size() == 2) category = text_of(units_[expander_.unit_], *e.args[1]);
    if (!e.args.empty() && !category)
        expander_.report(Code::RSL_STRING_NOT_CONSTANT, e.span, e.name);
    if (units_.size() > 1 && category && !sets_.of(expander_.unit_, e))
        expander_.report(Code::RSL_CATEGORY_EMPTY, e.span, *category);
    auto* node = ast_.make<ArrayLiteralExpr>(e.span);
    std::vector<Expr*> items;
    for (size_t k : units_of(sets_.of(expander_.unit_, e)))
        items.push_back(make.variable(fmt::format("{}{}", kNumber, k + 1)));
    node->items = ast_.arena.copy(items);
    return node;
}

void HandleCalls::declaration(Symbol& symbol) {
    if (!symbol.initial) return;
    bool array = symbol.type.is_array();
    if (!symbol.handle) {
        if (is_handle(*symbol.initial))
            expander_.report(Code::RSL_HANDLE_AS_VALUE, symbol.initial->span);
    } else if (const CallExpr* call = list_call(symbol.initial); call && array) {
        symbol.initial = list(*call);
        if (symbol.type.array_length > 0)
            symbol.type.array_length = std::max(
                symbol.type.array_length, int(as<ArrayLiteralExpr>(*symbol.initial).items.size()));
    } else if (array &&
               (names(*symbol.initial, "null") || symbol.initial->kind == ExprKind::Number)) {
        symbol.initial = nullptr;  // "shader a[] = null;"
    } else if (!array && !is_handle(*symbol.initial) && symbol.initial->kind != ExprKind::Number) {
        expander_.report(Code::RSL_HANDLE_WANTED, symbol.initial->span);
    }
}

// "get_lights(category, lights);" for the variable that getlights() was written for.
Stmt* HandleCalls::fill_with_lights(const CallExpr& e, std::string_view variable) {
    TreeBuilder make(ast_, e.span);
    Expr* category = ast_.make<StringExpr>(e.span);
    const auto* kind = e.args.empty() ? nullptr : as_if<StringExpr>(e.args[0]);
    if (!e.args.empty() && !(e.args.size() == 2 && kind && kind->value == "category"))
        expander_.report(Code::RSL_LIGHT_QUERY, e.span);
    else if (e.args.size() == 2)
        category = e.args[1];
    Expr* node = make.call("get_lights", {category, make.variable(variable)});
    expander_.call(as<CallExpr>(*node));
    return make.effect(node);
}

// "shader a[] = getlights(...)": an array that is filled behind its declaration; else null.
const CallExpr* HandleCalls::take_lights(Symbol& symbol) {
    const CallExpr* given =
        symbol.handle && symbol.type.is_array() ? list_call(symbol.initial) : nullptr;
    if (!given || !of_lights(*given)) return nullptr;
    symbol.initial = nullptr;
    symbol.type.array_length = 0;
    symbol.resizable = ast_.resizable_arrays = true;
    return given;
}

void HandleCalls::list_to_variable(ExpressionStmt& s, std::vector<Stmt*>& out) {
    auto* assign = as_if<AssignExpr>(s.expression);
    const CallExpr* given = assign ? list_call(assign->value) : nullptr;
    if (!given || !is_handle(*assign->target)) return;
    TreeBuilder make(ast_, s.span);
    Symbol* symbol =
        make.symbol(SymbolKind::Local, fmt::format("shaders@{}", expander_.temporaries_++),
                    {BaseType::Float, 0});
    symbol->handle = symbol->resizable = ast_.resizable_arrays = true;
    symbol->function = expander_.function_;
    symbol->initial = list(*given);
    if (symbol->initial) expander_.expr(symbol->initial);
    expander_.declare(*symbol);
    out.push_back(make.declare({symbol}));
    if (of_lights(*given)) out.push_back(fill_with_lights(*given, symbol->name));
    assign->value = make.variable(symbol->name);
}

}  // namespace kinora::rsl
