// rsl/objects/expand.cpp: rewrites the functions and shaders of a source without structs.
#include "rsl/objects/expand.h"

#include <algorithm>
#include <utility>

#include "rsl/objects/objects.h"

namespace kinora::rsl {

void ObjectExpander::run() {
    for (Function* f : ast_.functions) candidates_.push_back({f, f->name, nullptr});
    for (const StructDefinition* structure : ast_.structs)
        for (Function* method : structure->methods)
            candidates_.push_back({method, method->name, structure});
    scopes_.emplace_back();
    for (ShaderDefinition* s : ast_.shaders) shader(*s);
    for (bool again = true; again;) {
        again = false;
        for (size_t i = 0; i < candidates_.size(); ++i) {
            Candidate& candidate = candidates_[i];
            if (!candidate.wanted || candidate.done) continue;
            candidate.done = again = true;
            function(*candidate.function, candidate.owner);
        }
    }
    ast_.functions.clear();
    for (const Candidate& candidate : candidates_)
        if (candidate.done) ast_.functions.push_back(candidate.function);
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

void ObjectExpander::shader(ShaderDefinition& shader) {
    scopes_.emplace_back();
    for (Symbol* parameter : shader.parameters) {
        if (parameter->structure)
            report(Code::RSL_2, parameter->span, "a parameter of a shader that is a struct");
        if (parameter->initial) expr(parameter->initial);
        declare(*parameter);
    }
    if (shader.shader_class) {
        ClassDefinition& c = *shader.shader_class;
        class_ = &shader;
        for (Function* method : c.methods) scopes_.back().functions.push_back(method->name);
        for (Function* method : c.methods)
            if (method->result_structure) results_[method] = method->result_structure;
        Stmts members;
        for (Stmt* member : c.members) statement(member, members);
        c.members = ast_.arena.copy(members);
        for (Function* method : c.methods) function(*method, nullptr);
        class_ = nullptr;
    } else {
        shader.body->body = list(shader.body->body);
    }
    scopes_.pop_back();
}

bool expand_objects(Ast& ast, Reporter& reporter) {
    auto arrow = [](const Token& token) { return token.punct == Punct::Arrow; };
    const auto& tokens = ast.tokens.tokens;
    bool classes = std::any_of(ast.shaders.begin(), ast.shaders.end(),
                               [](const ShaderDefinition* s) { return s->shader_class; });
    if (ast.structs.empty() && !classes && std::none_of(tokens.begin(), tokens.end(), arrow))
        return true;
    int errors = reporter.errors();
    if (!check_structs(ast, reporter)) return false;
    ObjectExpander(ast, reporter).run();
    for (ShaderDefinition* shader : ast.shaders)
        if (shader->shader_class) make_pipeline(ast, reporter, *shader);
    return reporter.errors() == errors;
}

}  // namespace kinora::rsl

