// rsl/objects/handle_reads.cpp: getvar(), readprimvar() and hasmethod(): what a shader has, by
// name.
#include <fmt/format.h>

#include <algorithm>

#include "rsl/model/globals.h"
#include "rsl/objects/expand.h"

namespace kinora::rsl {

namespace {

// Formals that no member can hide.
constexpr std::string_view kValue = "value of call", kName = "name of call";
constexpr std::string_view kResult = "result of call";

bool is_null(const Expr& e) {
    const auto* named = as_if<VariableExpr>(&e);
    return named && named->name == "null";
}

// A variable of one type takes what is of the other.
bool takes(Type variable, Type value) {
    bool bases = variable.base == value.base || (is_triple(variable.base) && is_triple(value.base));
    return bases && variable.is_array() == value.is_array();
}

// Globals that a name known at run time may mean: those that all kinds of shaders have which the
// shader may become.
bool is_read_by_name(const GlobalInfo& info, const ShaderDefinition* shader) {
    constexpr uint8_t kOfClasses = in_kind(ShaderKind::Surface) |
                                   in_kind(ShaderKind::Displacement) | in_kind(ShaderKind::Light) |
                                   in_kind(ShaderKind::Volume);
    uint8_t needed = shader && !shader->shader_class ? in_kind(shader->kind) : kOfClasses;
    bool of_light = info.id == Global::L || info.id == Global::Cl || info.id == Global::Ol;
    return (info.readers & needed) == needed && !of_light;
}

}  // namespace

// hasmethod(h, "f")
Expr* HandleCalls::has_method(const CallExpr& e) {
    TreeBuilder make(ast_, e.span);
    std::string_view method = as<StringExpr>(*e.args[1]).value;
    HandleSet set = sets_.of(expander_.unit_, *e.args[0]), able = 0;
    if (method == "light") able |= set & kLightHandles;
    for (size_t k : units_of(set))
        for (const Method& one : units_[k].methods)
            if (one.name == method) able |= handle_of(k);
    if (!able || able == set) return make.number(able ? 1 : 0);
    std::vector<Case> cases;
    std::vector<size_t> units = units_of(able);
    if (able & kLightHandles) units.push_back(kOfLights);
    for (size_t k : units)
        cases.push_back({k, {make.assign(make.variable("result of call"), make.number(1))}});
    std::string name = fmt::format("hasmethod:{}@{:x}", method, set);
    Symbol result;
    result.type = {BaseType::Float, -1};
    add_function(name, result, {}, cases, e.span);
    return call_by_handle(name, e.args[0], {}, e.span);
}

// A light's parameter has the type of the variable.
Expr* HandleCalls::light_value(CallExpr& e, HandleSet set) {
    const auto* name = as_if<StringExpr>(e.args[1]);
    if (e.args.size() != 3 || (set & ~(kNullHandle | kLightHandles)))
        expander_.report(Code::RSL_LIGHT_MEMBER, e.span, name ? name->value : "...");
    Expr* node = TreeBuilder(ast_, e.span).call("light_value", {e.args.begin(), e.args.end()});
    expander_.call(as<CallExpr>(*node));
    return node;
}

// A global as others see a member; null if there is none of the name.
const Symbol* HandleCalls::global_symbol(std::string_view name) const {
    const GlobalInfo* global = find_global(name);
    if (!global) return nullptr;
    return TreeBuilder(ast_, {}).symbol(SymbolKind::Local, name, global->type);
}

// getvar(h, "name", variable), or without the variable: is there one? Of null it is a parameter or
// a public member of the shader itself, or a global.
Expr* HandleCalls::variable_read(CallExpr& e) {
    TreeBuilder make(ast_, e.span);
    std::string_view path = as<StringExpr>(*e.args[1]).value;
    HandleSet set = sets_.of(expander_.unit_, *e.args[0]);
    Expr* object = e.args[0];
    bool own = is_null(*object);
    if (own) set = handle_of(expander_.unit_), object = make.variable("this");
    std::vector<Member> found = members(set, path);
    const Symbol* global = own && found.empty() ? global_symbol(path) : nullptr;
    if (global) found.push_back({expander_.unit_, global});
    bool reads = e.args.size() > 2;
    if (set & kLightHandles) return light_value(e, set);
    if (found.empty()) return own ? vertex_value(e) : make.number(0);
    std::string name = fmt::format("getvar:{}@{:x}{}", path, set, reads ? "" : "?");
    std::vector<Symbol*> formals;
    if (reads) {
        Symbol* formal = make.symbol(SymbolKind::FunctionParameter, kValue, found[0].symbol->type);
        formal->structure = found[0].symbol->structure;
        formal->handle = found[0].symbol->handle;
        formal->output = true;
        if (formal->type.is_array()) formal->type.array_length = 0;
        formals.push_back(formal);
    }
    std::vector<Case> cases;
    for (const Member& one : found) {
        std::vector<Stmt*> body{make.assign(make.variable("result of call"), make.number(1))};
        std::string from = (global ? "" : units_[one.unit].prefix()) + std::string(path);
        if (reads) body.push_back(make.assign(make.variable(kValue), make.variable(from)));
        cases.push_back({one.unit, body});
    }
    Symbol result;
    result.type = {BaseType::Float, -1};
    add_reader(name, result, formals, cases, e.span);
    std::vector<Expr*> args;
    if (reads) args.push_back(e.args[2]);
    return call_by_handle(name, object, args, e.span);
}

// What the mesh brings, for names that nothing of the shader has.
Expr* HandleCalls::vertex_value(CallExpr& e) {
    TreeBuilder make(ast_, e.span);
    std::vector<Expr*> args(e.args.begin() + 1, e.args.end());
    Expr* node = make.call("vertexvalue", args);
    expander_.call(as<CallExpr>(*node));
    return node;
}

// A function that names members of the first unit stands behind them.
void HandleCalls::add_reader(std::string_view name, const Symbol& result,
                             std::vector<Symbol*> formals, const std::vector<Case>& cases,
                             SourceSpan span) {
    size_t known = expander_.candidates_.size();
    add_function(name, result, std::move(formals), cases, span);
    bool added = expander_.candidates_.size() > known;
    bool of_first =
        std::any_of(cases.begin(), cases.end(), [](const Case& c) { return c.unit == 0; });
    if (added && of_first) expander_.behind_members_.insert(expander_.candidates_.back().function);
}

// The type of a variable or element as it is written.
std::optional<Type> HandleCalls::written_type(const Expr& e) const {
    if (const auto* element = as_if<IndexExpr>(&e)) {
        std::optional<Type> array = written_type(*element->array);
        return array && array->is_array() ? std::optional(array->element()) : std::nullopt;
    }
    const auto* named = as_if<VariableExpr>(&e);
    if (!named) return {};
    const Symbol* symbol = symbol_at(named->name);
    if (symbol)
        return symbol->structure || symbol->handle ? std::nullopt : std::optional(symbol->type);
    const GlobalInfo* global = find_global(named->name);
    return global ? std::optional(global->type) : std::nullopt;
}

// getvar(h, name, variable) of a name that is known at run time: a choice among the names of all
// that the variable can take.
Expr* HandleCalls::read_by_text(CallExpr& e) {
    TreeBuilder make(ast_, e.span);
    HandleSet set = sets_.of(expander_.unit_, *e.args[0]);
    bool reads = e.args.size() > 2, own = is_null(*e.args[0]);
    if (own && !units_[expander_.unit_].shader) return vertex_value(e);  // one of several shaders
    std::optional<Type> type = reads ? written_type(*e.args[2]) : std::optional(Type{});
    if (set & kLightHandles) return light_value(e, set);
    if (!type) {
        expander_.report(Code::RSL_STRING_NOT_CONSTANT, e.span, e.name);
        return make.number(0);
    }
    Expr* object = own ? make.variable("this") : e.args[0];
    if (own) set = handle_of(expander_.unit_);
    std::vector<Case> cases;
    for (size_t k : units_of(set))
        cases.push_back({k, {choice_by_text(k, reads ? type : std::nullopt, own, e.span)}});
    std::vector<Symbol*> formals{
        make.symbol(SymbolKind::FunctionParameter, kName, {BaseType::String, -1})};
    if (reads) {
        Symbol* value = make.symbol(SymbolKind::FunctionParameter, kValue, *type);
        value->output = true;
        if (type->is_array()) value->type.array_length = 0;
        formals.push_back(value);
    }
    Symbol result;
    result.type = {BaseType::Float, -1};
    std::string name =
        fmt::format("getvar:{}@{:x}{}", reads ? type_name(*type) : "?", set, own ? " own" : "");
    add_reader(name, result, formals, cases, e.span);
    return call_by_handle(name, object, {e.args.begin() + 1, e.args.end()}, e.span);
}

// if (name == "a") { value = a; result = 1; } else if ...
Stmt* HandleCalls::choice_by_text(size_t unit, std::optional<Type> wanted, bool own,
                                  SourceSpan span) {
    TreeBuilder make(ast_, span);
    Stmt* chain = nullptr;
    if (own && !(wanted && wanted->is_array())) {
        std::vector<Expr*> args{make.variable(kName)};
        if (wanted) args.push_back(make.variable(kValue));
        chain = make.assign(make.variable(kResult), make.call("vertexvalue", args));
    }
    auto add = [&](std::string_view name, Type type, const std::string& from) {
        if (wanted && !takes(*wanted, type)) return;
        std::vector<Stmt*> body{make.assign(make.variable(kResult), make.number(1))};
        if (wanted) body.push_back(make.assign(make.variable(kValue), make.variable(from)));
        IfStmt* branch = make.branch(make.binary(Op::Equal, make.variable(kName), make.text(name)),
                                     std::move(body));
        branch->no = chain;
        chain = branch;
    };
    if (own)
        for (const GlobalInfo& info : globals())
            if (is_read_by_name(info, units_[unit].shader))
                add(info.name, info.type, std::string(info.name));
    for (const Symbol* member : units_[unit].members)
        if (!member->structure && !member->handle)
            add(member->name, member->type, units_[unit].prefix() + std::string(member->name));
    return chain ? chain : make.block({});
}

}  // namespace kinora::rsl
