// rsl/objects/expand.cpp: rewrites the functions and shaders of a source without structs.
#include "rsl/objects/expand.h"

#include <algorithm>
#include <utility>

#include "rsl/objects/join_units.h"
#include "rsl/objects/objects.h"
#include "rsl/objects/open_arrays.h"

namespace kinora::rsl {

void ObjectExpander::list_functions() {
    for (size_t k = 0; k < units_.size(); ++k)
        for (Function* f : units_[k].functions) candidates_.push_back({f, f->name, nullptr, k});
    for (const StructDefinition* structure : ast_.structs)
        for (Function* method : structure->methods)
            candidates_.push_back(
                {method, method->name, structure, unit_at(units_, structure->span.token)});
    for (const Unit& unit : units_)
        for (const Method& method : unit.methods) {
            method.function->name = ast_.arena.copy(unit.prefix() + std::string(method.name));
            if (method.result_structure) results_[method.function] = method.result_structure;
        }
}

void ObjectExpander::wanted_functions() {
    for (bool again = true; again;) {
        again = false;
        for (size_t i = 0; i < candidates_.size(); ++i) {
            if (!candidates_[i].wanted || candidates_[i].done) continue;
            candidates_[i].done = again = true;
            Candidate candidate = candidates_[i];
            top_ = candidate.function;
            unit_ = candidate.unit;
            std::string prefix = candidate.owner ? "" : units_[unit_].prefix();
            top_->name = ast_.arena.copy(prefix + std::string(top_->name));
            function(*candidate.function, candidate.owner);
        }
    }
    top_ = nullptr;
}

// Callers of functions that stand in the shader's body stand there too.
void ObjectExpander::divide_functions() {
    std::set<std::string_view> names;
    for (bool again = true; again;) {
        again = false;
        for (const Candidate& candidate : candidates_) {
            const auto& called = called_[candidate.function];
            if (std::any_of(called.begin(), called.end(),
                            [&](std::string_view name) { return names.contains(name); }))
                in_body_.insert(candidate.function);
            if (in_body_.contains(candidate.function))
                again = names.insert(candidate.function->name).second || again;
        }
    }
    ast_.functions.clear();
    for (const Candidate& candidate : candidates_)
        if (candidate.done)
            (in_body_.contains(candidate.function) ? nested_ : ast_.functions)
                .push_back(candidate.function);
}

void ObjectExpander::run(const std::vector<size_t>& used) {
    list_functions();
    scopes_.emplace_back();
    for (size_t k : used) {
        std::vector<ShaderDefinition*> shaders = ast_.shaders;
        if (units_[k].shader) shaders = {units_[k].shader};
        for (ShaderDefinition* s : shaders) shader(*s, k);
    }
    wanted_functions();
    divide_functions();
    for (size_t k : used) place_names(units_[k]);
}

// Parameters of struct types become their members; a method has those of its object before.
void ObjectExpander::formals(Function& f, const StructDefinition* owner) {
    std::vector<Symbol*> parameters;
    auto add_object = [&](std::string_view name, const StructDefinition& structure) {
        Symbol object;
        object.kind = SymbolKind::FunctionParameter;
        object.name = name;
        object.structure = &structure;
        object.span = f.span;
        object.function = &f;
        for (Symbol* part : expanded(ast_, object)) parameters.push_back(part);
    };
    std::string mangled;
    if (owner) add_object("this", *owner);
    for (Symbol* parameter : f.parameters) {
        declare(*parameter);
        if (parameter->structure) {
            mangled += " " + std::string(parameter->structure->name);
            for (Symbol* part : expanded(ast_, *parameter)) parameters.push_back(part);
        } else {
            if (parameter->initial) expr(parameter->initial);
            if (parameter->handle) mangled += kHandleArgument;
            parameters.push_back(parameter);
        }
    }
    if (f.result_structure) add_object("return", *f.result_structure);
    if (f.result_structure) mangled += " return";
    f.parameters = ast_.arena.copy(parameters);
    std::string name = owner ? method_name(*owner, f.name) : std::string(f.name);
    if (owner || !mangled.empty()) f.name = ast_.arena.copy(name + mangled);
}

void ObjectExpander::function(Function& f, const StructDefinition* owner) {
    const StructDefinition* owner_before = owner_;
    const StructDefinition* result_before = std::exchange(result_, f.result_structure);
    Function* function_before = std::exchange(function_, &f);
    if (owner) owner_ = owner;
    scopes_.emplace_back();
    formals(f, owner);
    f.body->body = list(f.body->body);
    scopes_.pop_back();
    function_ = function_before;
    owner_ = owner_before;
    result_ = result_before;
}

// Parameters of type shader are variables of the shader's body, whose values are known.
Stmt* ObjectExpander::handle_parameters(ShaderDefinition& shader) {
    std::vector<Symbol*> handles, others;
    for (Symbol* parameter : shader.parameters)
        (parameter->handle ? handles : others).push_back(parameter);
    shader.parameters = ast_.arena.copy(others);
    shader.handles = ast_.arena.copy(handles);
    for (Symbol* symbol : handles) {
        TreeBuilder make(ast_, symbol->span);
        symbol->kind = SymbolKind::Local;
        symbol->detail = Detail::Unspecified;
        auto bound = units_[unit_].bound.find(symbol->name);
        if (bound != units_[unit_].bound.end()) {
            std::vector<Expr*> items;
            for (const std::string& handle : bound->second) {
                size_t named = unit_named(units_, handle);
                items.push_back(make.number(named ? double(named + 1) : 0));
            }
            if (symbol->type.array_length > 0)
                symbol->type.array_length = std::max(symbol->type.array_length, int(items.size()));
            auto* list = ast_.make<ArrayLiteralExpr>(symbol->span);
            list->items = ast_.arena.copy(items);
            symbol->initial = items.empty() ? nullptr : items[0];
            if (symbol->type.is_array()) symbol->initial = list;
        }
        symbol->resizable = symbol->type.array_length == 0;
        ast_.resizable_arrays = ast_.resizable_arrays || symbol->resizable;
    }
    return handles.empty() ? nullptr : TreeBuilder(ast_, shader.span).declare(handles);
}

void ObjectExpander::shader(ShaderDefinition& shader, size_t unit) {
    unit_ = unit;
    scopes_.push_back({{}, {}, units_[unit].prefix()});
    Stmt* handles = handle_parameters(shader);
    for (Symbol* parameter : shader.parameters) {
        if (parameter->structure)
            report(Code::RSL_2, parameter->span, "a parameter of a shader that is a struct");
        if (parameter->initial) expr(parameter->initial);
        declare(*parameter);
    }
    Stmts members;
    if (handles) statement(handles, members);
    if (shader.shader_class) {
        ClassDefinition& c = *shader.shader_class;
        class_ = &shader;
        for (Function* method : c.methods) scopes_.back().functions.push_back(method->name);
        for (Function* method : c.methods)
            if (method->result_structure) results_[method] = method->result_structure;
        for (Stmt* member : c.members) statement(member, members);
        c.members = ast_.arena.copy(members);
        for (Function* method : c.methods) function(*method, nullptr);
        class_ = nullptr;
    } else {
        auto body = list(shader.body->body);
        members.insert(members.end(), body.begin(), body.end());
        shader.body->body = ast_.arena.copy(members);
    }
    scopes_.pop_back();
}

// Parameters and members of co-shaders get the names that code now has for them.
void ObjectExpander::place_names(const Unit& unit) {
    std::string prefix = unit.prefix();
    if (prefix.empty()) return;
    auto place = [&](Symbol& s) { s.name = ast_.arena.copy(prefix + std::string(s.name)); };
    for (Symbol* parameter : unit.shader->parameters) place(*parameter);
    for (Stmt* member : unit.shader->shader_class->members)
        for (Symbol* symbol : as<DeclareStmt>(*member).symbols) place(*symbol);
}

namespace {

// Whether a token is a word or a mark of RSL 2.0. Most tokens of a 1.x shader are told by a letter.
bool is_of_objects(const Token& token) {
    constexpr std::string_view kWords[] = {"shader",    "getshader", "getshaders", "getvar",
                                           "hasmethod", "null",      "readprimvar"};
    if (token.punct == Punct::Arrow) return true;
    if (token.kind != TokenKind::Identifier || token.text.size() < 4) return false;
    return std::string_view("sghnr").find(token.text[0]) != std::string_view::npos &&
           std::find(std::begin(kWords), std::end(kWords), token.text) != std::end(kWords);
}

// Whether something of RSL 2.0 is in the source, so that there is something to do.
bool has_objects(const Ast& ast) {
    const auto& tokens = ast.tokens.tokens;
    return !ast.structs.empty() ||
           std::any_of(ast.shaders.begin(), ast.shaders.end(),
                       [](const ShaderDefinition* s) { return s->shader_class || s->co_shader; }) ||
           std::any_of(tokens.begin(), tokens.end(), is_of_objects) || OutputTables::are_in(ast);
}

bool report_cycle(const Ast& ast, Reporter& reporter, const std::vector<Unit>& units,
                  const std::vector<UnitCall>& calls) {
    if (calls.empty()) return false;
    std::string text;
    auto add = [&](const UnitCall& call) {
        const std::string& handle = units[call.unit].handle;
        text += fmt::format("{}{}{}()", handle, handle.empty() ? "" : "->", call.caller->name);
    };
    for (const UnitCall& call : calls) add(call), text += ", ";
    add(calls[0]);
    const Token& token = ast.tokens.tokens[calls[0].span.token];
    reporter.report(Code::RSL_CO_SHADER_CYCLE, calls[0].span.where, token.macro, token.spelling,
                    text);
    return true;
}

}  // namespace

bool expand_objects(Ast& ast, Reporter& reporter, std::vector<Unit> units,
                    const BoundCounts& counts) {
    for (size_t k = 1; k < units.size(); ++k) make_class(ast, units[k]);
    set_open_arrays(ast, units, counts);
    if (units.size() < 2 && !has_objects(ast)) return true;
    int errors = reporter.errors();
    if (!check_structs(ast, reporter)) return false;
    if (units.empty()) {
        units.resize(1);
        units[0].functions = ast.functions;
        if (ast.shaders.size() == 1) units[0].shader = ast.shaders[0];
    }
    for (Unit& unit : units) list_members(unit);
    HandleSets sets(ast, units);
    if (report_cycle(ast, reporter, units, sets.cycle())) return false;
    std::vector<size_t> order = sets.in_order(sets.used()), used = order;
    used.push_back(0);
    ObjectExpander expander(ast, reporter, units, sets);
    expander.outputs().begin(units[0].shader);
    expander.run(used);
    for (ShaderDefinition* shader : ast.shaders)
        if (shader->shader_class) make_pipeline(ast, reporter, *shader);
    if (units[0].shader)
        join_units(ast, units, order, expander.nested(), expander.behind_members());
    if (units[0].shader) expander.outputs().end(*units[0].shader);
    return reporter.errors() == errors;
}

}  // namespace kinora::rsl
