// rsl/objects/handle_methods.cpp: calls of methods of a shader that may be one of several.
#include <fmt/format.h>

#include <algorithm>

#include "rsl/objects/expand.h"

namespace kinora::rsl {

namespace {

constexpr std::string_view kWhich = "which shader";  // no name that a source can have

bool takes(const Method& method, size_t count) {
    if (count > method.parameters.size()) return false;
    auto left_out = method.parameters.subspan(count);
    return std::all_of(left_out.begin(), left_out.end(),
                       [](const Symbol* parameter) { return parameter->initial; });
}

// Methods of the same form are called by one function.
std::string form_of(const Method& method, size_t count) {
    auto type = [](Type t, const StructDefinition* structure, bool handle) {
        return structure ? std::string(structure->name) : handle ? "shader" : type_name(t);
    };
    std::string text = type(method.result, method.result_structure, method.result_handle);
    for (const Symbol* formal : method.parameters.subspan(0, count))
        text += (formal->output ? ",output " : ",") +
                type(formal->type, formal->structure, formal->handle);
    return text;
}

}  // namespace

// What uses it cannot stand at file level, where the shader's members and methods are not known.
void HandleCalls::stands_in_body() {
    if (expander_.top_) expander_.in_body_.insert(expander_.top_);
}

bool HandleCalls::resolve(CallExpr& e) {
    HandleSet set = sets_.of(expander_.unit_, *e.args[0]), named = 0, able = 0;
    size_t count = e.args.size() - 1;
    if (set & kLightHandles) {
        if (e.name != "light" || count != 2) {
            expander_.report(Code::RSL_LIGHT_METHOD, e.span, e.name, count);
            return false;
        }
        if (!(set & ~(kLightHandles | kNullHandle))) {
            e.method = false;
            e.name = "light_of";
            return true;
        }
        named = able = kLightHandles;
    }
    for (size_t k : units_of(set))
        for (const Method& method : units_[k].methods) {
            if (method.name != e.name) continue;
            named |= handle_of(k);
            if (takes(method, count)) able |= handle_of(k);
        }
    if (!named) {
        if (set == handle_of(expander_.unit_))  // this->
            expander_.report(Code::RSL_UNKNOWN_FUNCTION, e.span, e.name);
        else if (set & ~kNullHandle)
            expander_.report(Code::RSL_CO_SHADER_METHOD, e.span, e.name);
        return false;
    }
    e.method = false;
    stands_in_body();
    constexpr HandleSet kUnknown = kNullHandle | kLightHandles;
    if (std::vector<size_t> units = units_of(set); units.size() == 1 && !(set & kUnknown)) {
        e.name = ast_.arena.copy(units_[units[0]].prefix() + std::string(e.name));
        e.args = e.args.subspan(1);
        return true;
    }
    if (!able) {  // the checker says what they take
        size_t first = units_of(named)[0];
        e.name = ast_.arena.copy(units_[first].prefix() + std::string(e.name));
        e.args = e.args.subspan(1);
        return true;
    }
    e.name = method_function(e.name, able, count, able != set, e.span);
    return true;
}

std::string_view HandleCalls::method_function(std::string_view method, HandleSet set, size_t count,
                                              bool unanswered, SourceSpan span) {
    std::string name = fmt::format("{}@{:x}:{}{}", method, set, count, unanswered ? "?" : "");
    std::string_view kept = ast_.arena.copy(name);
    if (made_.contains(name)) return kept;
    std::vector<std::string> forms;
    for (size_t k : units_of(set))
        for (const Method& one : units_[k].methods)
            if (one.name == method && takes(one, count) &&
                std::find(forms.begin(), forms.end(), form_of(one, count)) == forms.end())
                forms.push_back(form_of(one, count));
    TreeBuilder make(ast_, span);
    for (const std::string& form : forms) {
        made_.erase(name);  // overloads have one name
        std::vector<Symbol*> formals;
        std::vector<Case> cases;
        Symbol result;
        for (size_t k : units_of(set))
            for (const Method& one : units_[k].methods) {
                if (one.name != method || !takes(one, count) || form_of(one, count) != form)
                    continue;
                if (cases.empty()) {
                    result.type = one.result;
                    result.structure = one.result_structure;
                    result.handle = one.result_handle;
                    for (const Symbol* formal : one.parameters.subspan(0, count)) {
                        Symbol* copy =
                            make.symbol(SymbolKind::FunctionParameter, formal->name, formal->type);
                        copy->output = formal->output;
                        copy->structure = formal->structure;
                        copy->handle = formal->handle;
                        formals.push_back(copy);
                    }
                }
                std::vector<Expr*> args;
                for (const Symbol* formal : formals) args.push_back(make.variable(formal->name));
                Expr* value = make.call(units_[k].prefix() + std::string(method), args);
                bool gives = result.structure || result.type.base != BaseType::Void;
                cases.push_back({k,
                                 {gives ? make.assign(make.variable("result of call"), value)
                                        : make.effect(value)}});
                break;
            }
        if (set & kLightHandles) {
            std::vector<Expr*> args{make.variable(kWhich)};
            for (const Symbol* formal : formals) args.push_back(make.variable(formal->name));
            cases.push_back({kOfLights, {make.effect(make.call("light_of", args))}});
        }
        Stmt* reports =
            unanswered ? make.effect(make.call("nullcall", {make.text(method)})) : nullptr;
        add_function(name, result, formals, cases, span, reports);
    }
    return kept;
}

// Type name(shader which; formals) { Type result; if (which == 2) {...} else ... return result; }
void HandleCalls::add_function(std::string_view name, const Symbol& result,
                               std::vector<Symbol*> formals, const std::vector<Case>& cases,
                               SourceSpan span, Stmt* otherwise) {
    if (!made_.insert(std::string(name)).second) return;
    TreeBuilder make(ast_, span);
    auto* f = ast_.arena.make<Function>();
    f->name = ast_.arena.copy(name);
    f->result = result.type;
    f->result_structure = result.structure;
    f->result_handle = result.handle;
    f->span = span;
    f->id = ast_.function_count++;
    Symbol* which = make.symbol(SymbolKind::FunctionParameter, kWhich, {BaseType::Float, -1});
    which->handle = true;
    formals.insert(formals.begin(), which);
    for (Symbol* formal : formals) formal->function = f;
    f->parameters = ast_.arena.copy(formals);

    std::vector<Stmt*> body;
    bool gives = result.structure || result.type.base != BaseType::Void;
    Symbol* value = make.symbol(SymbolKind::Local, "result of call", result.type);
    value->structure = result.structure;
    value->handle = result.handle;
    value->function = f;
    if (gives) body.push_back(make.declare({value}));
    Stmt* chain = otherwise;
    for (size_t k = cases.size(); k-- > 0;) {
        bool lights = cases[k].unit == kOfLights;
        Expr* number =
            lights ? make.variable("null") : make.variable(fmt::format("@{}", cases[k].unit + 1));
        IfStmt* branch = make.branch(
            make.binary(lights ? Op::NotEqual : Op::Equal, make.variable(kWhich), number),
            cases[k].body);
        branch->no = chain;
        chain = branch;
    }
    if (chain) body.push_back(chain);
    if (gives) {
        auto* given = ast_.make<ReturnStmt>(span);
        given->value = make.variable(value->name);
        body.push_back(given);
    }
    f->body = make.block(std::move(body));
    f->returns = gives;
    expander_.candidates_.push_back({f, f->name, nullptr, 0, true});
    expander_.in_body_.insert(f);
}

Expr* HandleCalls::call_by_handle(std::string_view name, Expr* object, std::vector<Expr*> args,
                                  SourceSpan span) {
    stands_in_body();
    args.insert(args.begin(), object);
    Expr* node = TreeBuilder(ast_, span).call(name, args);
    expander_.call(as<CallExpr>(*node));
    return node;
}

}  // namespace kinora::rsl
