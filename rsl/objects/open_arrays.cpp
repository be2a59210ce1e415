// rsl/objects/open_arrays.cpp: parameters of open length, as "float a[] = {1, 2}".
#include "rsl/objects/open_arrays.h"

#include "rsl/objects/build_tree.h"

namespace kinora::rsl {

std::optional<int> open_length(const Symbol& parameter, size_t count) {
    bool text = parameter.type.base == BaseType::String;
    size_t each = text ? 1 : size_t(component_count(parameter.type.base));
    if (count == 1 && each == 3) return 1;
    if (count % each != 0) return {};
    return int(count / each);
}

namespace {

// Numbers that do not come to whole elements change nothing: whoever binds them reports it.
void set_length(Symbol& parameter, const BoundCounts& counts) {
    auto bound = counts.find(parameter.name);
    if (bound == counts.end()) return;
    std::optional<int> length = open_length(parameter, bound->second);
    if (!length || *length == parameter.type.array_length) return;
    parameter.type.array_length = *length;
    parameter.initial = nullptr;
}

void make_variable(Ast& ast, Symbol& parameter) {
    parameter.kind = SymbolKind::Local;
    parameter.detail = Detail::Unspecified;
    parameter.output = false;
    parameter.accessible = true;
    parameter.initial = nullptr;
    parameter.resizable = ast.resizable_arrays = true;
}

void set_open_arrays(Ast& ast, ShaderDefinition& shader, const BoundCounts& counts) {
    std::vector<Symbol*> parameters, open, empty;
    for (Symbol* parameter : shader.parameters) {
        bool is_open = parameter->open && !parameter->handle && !parameter->structure;
        if (is_open) {
            set_length(*parameter, counts);
            open.push_back(parameter);
        }
        bool is_empty = is_open && parameter->type.array_length == 0;
        (is_empty ? empty : parameters).push_back(parameter);
    }
    shader.open_arrays = ast.arena.copy(open);
    if (empty.empty()) return;
    shader.parameters = ast.arena.copy(parameters);
    for (Symbol* parameter : empty) make_variable(ast, *parameter);
    std::vector<Stmt*> body{TreeBuilder(ast, shader.span).declare(empty)};
    std::span<Stmt*>& list =
        shader.shader_class ? shader.shader_class->members : shader.body->body;
    body.insert(body.end(), list.begin(), list.end());
    list = ast.arena.copy(body);
}

}  // namespace

void set_open_arrays(Ast& ast, std::span<const Unit> units, const BoundCounts& counts) {
    if (units.empty())
        for (ShaderDefinition* shader : ast.shaders) set_open_arrays(ast, *shader, counts);
    for (const Unit& unit : units)
        if (unit.shader) set_open_arrays(ast, *unit.shader, unit.counts);
}

}  // namespace kinora::rsl
