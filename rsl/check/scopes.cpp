// rsl/check/scopes.cpp: declarations and the search for names.
#include "rsl/check/scopes.h"

#include <algorithm>
#include <utility>

namespace kinora::rsl {

const Symbol* Scopes::declare(Symbol& symbol) {
    Scope& scope = scopes_.back();
    auto found = scope.by_name.find(symbol.name);
    const Symbol* earlier = found == scope.by_name.end() ? nullptr : found->second.first;
    refer_to(symbol);
    return earlier;
}

void Scopes::refer_to(Symbol& symbol) {
    Scope& scope = scopes_.back();
    scope.variables.push_back(&symbol);
    scope.by_name.try_emplace(symbol.name, Scope::Named{&symbol, &symbol}).first->second.last =
        &symbol;
}

const Function* Scopes::declare(Function& f) {
    std::vector<Function*>& functions = scopes_.back().functions;
    auto same_types = [](const Symbol* a, const Symbol* b) { return a->type == b->type; };
    for (Function*& other : functions) {
        bool same = other->name == f.name && other->result == f.result &&
                    std::equal(other->parameters.begin(), other->parameters.end(),
                               f.parameters.begin(), f.parameters.end(), same_types);
        if (same) return std::exchange(other, &f);
    }
    functions.push_back(&f);
    return nullptr;
}

Symbol* Scopes::find_in(const Scope& scope, std::string_view name) {
    auto found = scope.by_name.find(name);
    return found == scope.by_name.end() ? nullptr : found->second.last;
}

Symbol* Scopes::find_variable(std::string_view name) {
    for (size_t i = scopes_.size(); i-- > 0;)
        if (Symbol* symbol = find_in(scopes_[i], name)) return symbol;
    return find_global_symbol(name);
}

Symbol* Scopes::find_variable_outside(std::string_view name) {
    const Function* inside = function();
    for (size_t i = scopes_.size(); i-- > 0;) {
        if (inside && scopes_[i].function == inside) continue;
        if (Symbol* symbol = find_in(scopes_[i], name)) return symbol;
    }
    return find_global_symbol(name);
}

Symbol* Scopes::find_global_symbol(std::string_view name) {
    const GlobalInfo* info = find_global(name);
    if (!info) return nullptr;
    Symbol*& symbol = globals_[size_t(info->id)];
    if (symbol) return symbol;
    symbol = ast_.arena.make<Symbol>();
    symbol->kind = SymbolKind::Global;
    symbol->name = info->name;
    symbol->type = info->type;
    symbol->detail = info->rate == Rate::Varying ? Detail::Varying : Detail::Uniform;
    symbol->varying = info->rate == Rate::Varying;
    symbol->output = true;
    symbol->id = ast_.symbol_count++;
    symbol->global = info;
    return symbol;
}

std::vector<Function*> Scopes::find_functions(std::string_view name) const {
    std::vector<Function*> found;
    for (size_t i = scopes_.size(); i-- > 0 && found.empty();)
        for (Function* f : scopes_[i].functions)
            if (f->name == name) found.push_back(f);
    return found;
}

std::vector<std::string_view> Scopes::variable_names() const {
    std::vector<std::string_view> names;
    for (const Scope& scope : scopes_)
        for (const Symbol* symbol : scope.variables) names.push_back(symbol->name);
    for (const GlobalInfo& info : globals()) names.push_back(info.name);
    return names;
}

std::vector<std::string_view> Scopes::function_names() const {
    std::vector<std::string_view> names;
    for (const Scope& scope : scopes_)
        for (const Function* f : scope.functions) names.push_back(f->name);
    return names;
}

}  // namespace kinora::rsl
