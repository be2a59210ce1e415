// rsl/check/check.cpp: the checker's definitions and scopes.
#include "rsl/check/check.h"

#include <algorithm>

namespace kinora::rsl {

Checker::Checker(Ast& ast, Reporter& reporter, const CompileOptions& options,
                 const ParseRecovery& recovery)
    : ast_(ast),
      reporter_(reporter),
      options_(options),
      recovery_(recovery),
      globals_(size_t(Global::Count)) {}

void Checker::run() {
    ScopeGuard file_scope(*this);
    for (Function* f : ast_.functions) declare_function(*f);
    for (Function* f : ast_.functions) check_function(*f);
    for (size_t i = 0; i < ast_.shaders.size(); ++i) {
        for (size_t k = 0; k < i; ++k)
            if (ast_.shaders[k]->name == ast_.shaders[i]->name)
                report(Code::RSL_SHADER_REDEFINED, ast_.shaders[i]->span, ast_.shaders[i]->name);
        check_shader(*ast_.shaders[i]);
    }
    mark_recursion();
}

// "color Ci = 0;" in a surface, which then hands out nothing.
void Checker::warn_of_hidden_outputs(const ShaderDefinition& shader) {
    for (const Stmt* stmt : shader.body->body) {
        const auto* declaration = as_if<DeclareStmt>(stmt);
        for (size_t k = 0; declaration && k < declaration->symbols.size(); ++k) {
            const Symbol& symbol = *declaration->symbols[k];
            const GlobalInfo* global = find_global(symbol.name);
            constexpr std::string_view kOutputs[] = {"Ci", "Oi", "Cl", "Ol"};
            bool output = std::find(std::begin(kOutputs), std::end(kOutputs), symbol.name) !=
                          std::end(kOutputs);
            if (output && (global->writers & in_kind(shader.kind)))
                report(Code::RSL_HIDES_OUTPUT, symbol.span, symbol.name);
        }
    }
}

void Checker::check_shader(ShaderDefinition& shader) {
    unknown_.clear();
    unknown_functions_.clear();
    ScopeGuard scope(*this);
    check_parameters(shader.parameters);
    statement(*shader.body);
    warn_of_hidden_outputs(shader);
}

void Checker::check_function(Function& f) {
    Within<Function*> function(function_, &f);
    Within<std::vector<Stmt*>> loops(loops_, {});
    Within<bool> returned(returned_, false);
    Within<const char*> light(light_statement_, nullptr);
    ScopeGuard scope(*this);
    check_parameters(f.parameters);
    statement(*f.body);
    if (f.result.base != BaseType::Void && !returned_ && !f.damaged)
        report(Code::RSL_MISSING_RETURN, f.span, f.name);
}

// A triple or number, perhaps with its sign.
static bool is_written_out(const Expr& value) {
    if (value.kind == ExprKind::Unary) {
        const auto& unary = as<UnaryExpr>(value);
        return unary.op == Op::Negate && is_written_out(*unary.operand);
    }
    return value.kind == ExprKind::Triple || value.kind == ExprKind::Number;
}

// Points, vectors and normals that are written as defaults of a shader's parameters are in "shader"
// space unless they name another, as values given from outside are.
void Checker::default_in_shader_space(Symbol& symbol) {
    if (symbol.kind != SymbolKind::Parameter || !is_spatial(symbol.type.base)) return;
    if (!symbol.initial) return;
    if (symbol.initial->kind != ExprKind::ArrayLiteral)
        return put_in_shader_space(symbol.initial, symbol.type.base);
    for (Expr*& item : as<ArrayLiteralExpr>(*symbol.initial).items)
        put_in_shader_space(item, symbol.type.base);
}

void Checker::put_in_shader_space(Expr*& value, BaseType base) {
    CastExpr* cast = value->kind == ExprKind::Cast ? &as<CastExpr>(*value) : nullptr;
    if (cast && (cast->space || !is_spatial(cast->to))) return;
    if (!is_written_out(*(cast ? cast->operand : value))) return;
    if (!cast) {
        cast = ast_.make<CastExpr>(value->span);
        cast->to = base;
        cast->operand = value;
        value = cast;
    }
    auto* space = ast_.make<StringExpr>(value->span);
    space->value = "shader";
    cast->space = space;
}

// A default may use the parameters before it and the globals.
void Checker::check_parameters(std::span<Symbol*> parameters) {
    for (Symbol* p : parameters) {
        default_in_shader_space(*p);
        check_initial(*p);
        declare(*p);
    }
}

void Checker::check_initial(Symbol& symbol) {
    bool open = symbol.type.array_length == 0;
    if (open && symbol.kind == SymbolKind::Local)
        report(Code::RSL_UNSIZED_ARRAY, symbol.span, symbol.name);
    if (open && symbol.kind == SymbolKind::Parameter) {
        report(Code::RSL_OPEN_ARRAY, symbol.span, symbol.name);
        symbol.type.array_length = 1;
    }
    if (symbol.initial) convert_to(symbol.initial, symbol.type, fmt::format("'{}'", symbol.name));
}

// ---- scopes -------------------------------------------------------------------------------------

void Checker::declare(Symbol& symbol) {
    std::vector<Symbol*>& variables = scopes_.back().variables;
    for (const Symbol* other : variables) {
        if (other->name != symbol.name) continue;
        bool parameter = symbol.kind != SymbolKind::Local;
        report(parameter ? Code::RSL_REDEFINED : Code::RSL_REDECLARED, symbol.span, symbol.name)
            .notes.push_back({other->span.where, "first declared here"});
        break;
    }
    variables.push_back(&symbol);
}

void Checker::declare_function(Function& f) {
    std::vector<Function*>& functions = scopes_.back().functions;
    auto same_types = [](const Symbol* a, const Symbol* b) { return a->type == b->type; };
    for (Function*& other : functions) {
        bool same = other->name == f.name &&
                    std::equal(other->parameters.begin(), other->parameters.end(),
                               f.parameters.begin(), f.parameters.end(), same_types);
        if (!same) continue;
        report(Code::RSL_FUNCTION_REDEFINED, f.span, f.name)
            .notes.push_back({other->span.where, "first defined here"});
        other = &f;
        return;
    }
    functions.push_back(&f);
}

// Innermost first, the globals last. With `outside_function`, only what is declared outside the
// function being checked.
Symbol* Checker::find_variable(std::string_view name, bool outside_function) {
    for (size_t i = scopes_.size(); i-- > 0;) {
        if (outside_function && function_ && scopes_[i].owner == function_) continue;
        const std::vector<Symbol*>& variables = scopes_[i].variables;
        for (size_t k = variables.size(); k-- > 0;)
            if (variables[k]->name == name) return variables[k];
    }
    const GlobalInfo* info = find_global(name);
    return info ? global_symbol(*info) : nullptr;
}

// The same for a look ahead: a global that nobody has named yet is a stand-in.
const Symbol* Checker::find_symbol(std::string_view name) const {
    for (size_t i = scopes_.size(); i-- > 0;) {
        const std::vector<Symbol*>& variables = scopes_[i].variables;
        for (size_t k = variables.size(); k-- > 0;)
            if (variables[k]->name == name) return variables[k];
    }
    const GlobalInfo* info = find_global(name);
    return info ? const_cast<Checker*>(this)->global_symbol(*info) : nullptr;
}

Symbol* Checker::global_symbol(const GlobalInfo& info) {
    Symbol*& symbol = globals_[size_t(info.id)];
    if (symbol) return symbol;
    symbol = ast_.arena.make<Symbol>();
    symbol->kind = SymbolKind::Global;
    symbol->name = info.name;
    symbol->type = info.type;
    symbol->detail = info.rate == Rate::Varying ? Detail::Varying : Detail::Uniform;
    symbol->varying = info.rate == Rate::Varying;
    symbol->output = true;
    symbol->id = ast_.symbol_count++;
    symbol->global = &info;
    return symbol;
}

std::vector<std::string_view> Checker::variable_names() const {
    std::vector<std::string_view> names;
    for (const Scope& scope : scopes_)
        for (const Symbol* symbol : scope.variables) names.push_back(symbol->name);
    for (const GlobalInfo& info : globals()) names.push_back(info.name);
    return names;
}

// ---- recursion ----------------------------------------------------------------------------------

// Depth-first along the calls; an edge back to a function on the path closes a circle. Each circle
// has such an edge, so each has a marked function.
void Checker::mark_recursion() {
    std::vector<std::vector<Function*>> callees(ast_.function_count);
    for (const CallEdge& edge : edges_)
        if (edge.caller) callees[edge.caller->id].push_back(edge.callee);
    enum State : uint8_t { kNew, kOpen, kDone };
    std::vector<State> state(ast_.function_count, kNew);
    std::vector<std::pair<Function*, size_t>> path;  // function, next call to look at
    for (const CallEdge& start : edges_) {
        if (state[start.callee->id] != kNew) continue;
        path.push_back({start.callee, 0});
        state[start.callee->id] = kOpen;
        while (!path.empty()) {
            auto& [function, next] = path.back();
            if (next == callees[function->id].size()) {
                state[function->id] = kDone;
                path.pop_back();
                continue;
            }
            Function* callee = callees[function->id][next++];
            if (state[callee->id] == kOpen)
                for (size_t k = path.size(); k-- > 0;) {
                    path[k].first->recursive = true;
                    if (path[k].first == callee) break;
                }
            if (state[callee->id] != kNew) continue;
            state[callee->id] = kOpen;
            path.push_back({callee, 0});
        }
    }
}

}  // namespace kinora::rsl
