// rsl/objects/units.cpp: the shaders that become one: the shader itself and its co-shaders.
#include "rsl/objects/units.h"

#include <algorithm>

#include "rsl/objects/tree_parts.h"

namespace kinora::rsl {

const Symbol* Unit::find_member(std::string_view name) const {
    for (const Symbol* member : members)
        if (member->name == name) return member;
    return nullptr;
}

const Symbol* Unit::find_parameter(std::string_view name) const {
    for (const Symbol* parameter : shader ? shader->parameters : std::span<Symbol*>())
        if (parameter->name == name) return parameter;
    return nullptr;
}

namespace {

struct Formal {
    BaseType type;
    std::string_view name;
};

// Parameters of the method that the body of a shader of this kind becomes.
std::vector<Formal> formals_of(ShaderKind kind) {
    switch (kind) {
        case ShaderKind::Surface:
        case ShaderKind::Volume:
        case ShaderKind::Imager:
            return {{BaseType::Color, "Ci"}, {BaseType::Color, "Oi"}};
        case ShaderKind::Displacement:
        case ShaderKind::Transformation:
            return {{BaseType::Point, "P"}, {BaseType::Normal, "N"}};
        case ShaderKind::Light:
            break;
    }
    return {};
}

// What the body of a shader declares now is the function's.
void move_into(Function& f, const Stmt& stmt) {
    if (const auto* declared = as_if<DeclareStmt>(&stmt))
        for (Symbol* symbol : declared->symbols) symbol->function = &f;
    if (const auto* nested = as_if<FunctionStmt>(&stmt)) nested->function->parent = &f;
    for (const Stmt* inner : statements_of(stmt)) move_into(f, *inner);
}

}  // namespace

void make_class(Ast& ast, Unit& unit) {
    ShaderDefinition& shader = *unit.shader;
    if (shader.shader_class) return;
    auto* f = ast.arena.make<Function>();
    f->name = shader.co_shader ? "begin" : shader_kind_name(shader.kind);
    f->result = {BaseType::Void, -1};
    f->span = shader.span;
    f->id = ast.function_count++;
    f->body = shader.body;
    move_into(*f, *shader.body);
    std::vector<Symbol*> formals;
    for (const Formal& row : shader.co_shader ? std::vector<Formal>() : formals_of(shader.kind)) {
        auto* formal = ast.arena.make<Symbol>();
        formal->kind = SymbolKind::FunctionParameter;
        formal->name = row.name;
        formal->type = {row.type, -1};
        formal->output = true;
        formal->id = ast.symbol_count++;
        formal->span = shader.span;
        formal->function = f;
        formals.push_back(formal);
    }
    f->parameters = ast.arena.copy(formals);
    shader.shader_class = ast.arena.make<ClassDefinition>();
    shader.shader_class->methods = ast.arena.copy(std::vector<Function*>{f});
    shader.body = ast.make<BlockStmt>(shader.span);
}

namespace {

// The parts between separators, without spaces around them.
std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    while (true) {
        size_t end = std::min(text.find(separator), text.size());
        std::string_view part = text.substr(0, end);
        while (part.starts_with(' ')) part.remove_prefix(1);
        while (part.ends_with(' ')) part.remove_suffix(1);
        parts.push_back(part);
        if (end == text.size()) return parts;
        text.remove_prefix(end + 1);
    }
}

}  // namespace

void list_members(Unit& unit) {
    if (!unit.shader) return;
    unit.members.assign(unit.shader->parameters.begin(), unit.shader->parameters.end());
    for (const Symbol* parameter : unit.shader->parameters) {
        auto bound = unit.bound.find(parameter->name);
        if (!parameter->handle || !parameter->type.is_array() || bound == unit.bound.end())
            continue;
        std::vector<std::string> handles;
        for (const std::string& text : bound->second)
            for (std::string_view handle : split(text, ','))
                if (!handle.empty()) handles.emplace_back(handle);
        bound->second = handles;
    }
    const ClassDefinition* c = unit.shader->shader_class;
    if (!c) return;
    for (const Stmt* stmt : c->members)
        for (const Symbol* symbol : as<DeclareStmt>(*stmt).symbols)
            if (symbol->accessible) unit.members.push_back(symbol);
    for (Function* f : c->methods)
        unit.methods.push_back(
            {f->name, f, f->parameters, f->result, f->result_structure, f->result_handle});
}

std::optional<std::string> text_of(const Unit& unit, const Expr& e) {
    if (const auto* literal = as_if<StringExpr>(&e)) return std::string(literal->value);
    const auto* named = as_if<VariableExpr>(&e);
    const Symbol* parameter = named ? unit.find_parameter(named->name) : nullptr;
    if (!parameter || parameter->type != Type{BaseType::String, -1}) return {};
    auto bound = unit.bound.find(named->name);
    if (bound != unit.bound.end() && !bound->second.empty()) return bound->second[0];
    if (!parameter->initial) return "";
    return parameter->initial->kind == ExprKind::String ? text_of(unit, *parameter->initial)
                                                        : std::nullopt;
}

size_t unit_named(const std::vector<Unit>& units, std::string_view handle) {
    for (size_t k = 1; k < units.size(); ++k)
        if (units[k].handle == handle) return k;
    return 0;
}

size_t unit_at(const std::vector<Unit>& units, uint32_t token) {
    size_t unit = 0;
    for (size_t k = 1; k < units.size(); ++k)
        if (units[k].first_token <= token) unit = k;
    return unit;
}

bool in_category(const Unit& unit, std::string_view query) {
    if (query.empty()) return true;
    VariableExpr category;
    category.kind = ExprKind::Variable;
    category.name = "__category";
    std::string own = text_of(unit, category).value_or("");
    std::vector<std::string_view> categories = split(own, ',');
    auto fits = [&](std::string_view term) {
        bool without = term.starts_with('-');
        if (without) term.remove_prefix(1);
        return without !=
               (std::find(categories.begin(), categories.end(), term) != categories.end());
    };
    for (std::string_view choice : split(query, ',')) {
        std::vector<std::string_view> terms = split(choice, '&');
        if (std::all_of(terms.begin(), terms.end(), fits)) return true;
    }
    return false;
}

}  // namespace kinora::rsl
