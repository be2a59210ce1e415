// rsl/objects/join_units.cpp: a shader and its co-shaders as one shader.
#include "rsl/objects/join_units.h"

#include "rsl/objects/build_tree.h"

namespace kinora::rsl {

void join_units(Ast& ast, const std::vector<Unit>& units, const std::vector<size_t>& order,
                const std::vector<Function*>& nested,
                const std::set<const Function*>& behind_members) {
    ShaderDefinition& shader = *units[0].shader;
    std::vector<Symbol*> parameters(shader.parameters.begin(), shader.parameters.end());
    std::vector<Symbol*> handles(shader.handles.begin(), shader.handles.end());
    std::vector<Stmt*> body;
    auto define = [&](Function* f) {
        auto* definition = ast.make<FunctionStmt>(f->span);
        definition->function = f;
        body.push_back(definition);
    };
    std::vector<std::string_view> used;
    for (size_t k : order) used.push_back(ast.arena.copy(units[k].handle));
    for (size_t k : order) {
        const ShaderDefinition& co_shader = *units[k].shader;
        const ClassDefinition& c = *co_shader.shader_class;
        parameters.insert(parameters.end(), co_shader.parameters.begin(),
                          co_shader.parameters.end());
        handles.insert(handles.end(), co_shader.handles.begin(), co_shader.handles.end());
        body.insert(body.end(), c.members.begin(), c.members.end());
    }
    for (size_t k : order)
        for (Function* method : units[k].shader->shader_class->methods) define(method);
    for (Function* f : nested)
        if (!behind_members.contains(f)) define(f);
    for (size_t k : order)
        for (std::string_view name : {"construct", "begin"})
            for (const Method& method : units[k].methods)
                if (method.name == name && method.parameters.empty()) {
                    TreeBuilder make(ast, method.function->span);
                    body.push_back(make.effect(make.call(method.function->name, {})));
                }
    auto own = shader.body->body.begin(), end = shader.body->body.end();
    for (; own != end && (*own)->kind == StmtKind::Declare; ++own) body.push_back(*own);
    for (Function* f : nested)
        if (behind_members.contains(f)) define(f);
    body.insert(body.end(), own, end);
    shader.parameters = ast.arena.copy(parameters);
    shader.handles = ast.arena.copy(handles);
    shader.co_shaders = ast.arena.copy(used);
    shader.body->body = ast.arena.copy(body);
}

}  // namespace kinora::rsl
