// rsl/objects/handle_sets.cpp: which shaders a variable of type shader can mean.
#include "rsl/objects/handle_sets.h"

#include <algorithm>

#include "rsl/objects/paths.h"
#include "rsl/objects/tree_parts.h"

namespace kinora::rsl {

namespace {

constexpr int kOfStruct = -1;

std::string result_of(std::string_view function) {
    return std::string(function) + "()";
}

}  // namespace

std::vector<size_t> units_of(HandleSet set) {
    std::vector<size_t> units;
    for (size_t k = 0; k < kMostUnits; ++k)
        if (set & handle_of(k)) units.push_back(k);
    return units;
}

HandleSets::HandleSets(const Ast& ast, const std::vector<Unit>& units)
    : ast_(ast), units_(units), mentioned_(units.size()) {
    for (size_t k = 0; k < units.size(); ++k) unit_definitions(k);
    for (const StructDefinition* structure : ast.structs)
        for (const Function* method : structure->methods) {
            size_t unit = unit_at(units, structure->span.token);
            functions_[{kOfStruct, std::string(method->name)}].push_back({unit, method});
            if (method->result_handle) giving_.insert({kOfStruct, std::string(method->name)});
            list_nested(unit, *method->body);
        }
    do {
        changed_ = false;
        calls_.clear();
        walked_.clear();
        for (size_t k = 0; k < units.size(); ++k) {
            parameters(k);
            for (const Function* f : units[k].functions) function(k, *f);
            std::vector<ShaderDefinition*> shaders = ast.shaders;
            if (units[k].shader) shaders = {units[k].shader};
            for (const ShaderDefinition* shader : shaders) {
                statement(k, nullptr, *shader->body);
                if (!shader->shader_class) continue;
                for (const Stmt* member : shader->shader_class->members)
                    statement(k, nullptr, *member);
                for (const Function* method : shader->shader_class->methods) function(k, *method);
            }
        }
        for (const StructDefinition* structure : ast.structs)
            for (const Function* method : structure->methods)
                function(unit_at(units, structure->span.token), *method);
    } while (changed_);
}

HandleSet HandleSets::at(const Key& key) const {
    auto found = sets_.find(key);
    return found == sets_.end() ? 0 : found->second;
}

void HandleSets::add(const Key& key, HandleSet set) {
    if (!set) return;
    HandleSet& known = sets_[key];
    changed_ = changed_ || (known | set) != known;
    known |= set;
}

// ---- definitions --------------------------------------------------------------------------------

void HandleSets::list(size_t unit, const Function& f) {
    Key key{int(unit), std::string(f.name)};
    functions_[key].push_back({unit, &f});
    if (f.result_handle) giving_.insert(key);
    list_nested(unit, *f.body);
}

void HandleSets::list_nested(size_t unit, const Stmt& stmt) {
    if (const auto* nested = as_if<FunctionStmt>(&stmt)) list(unit, *nested->function);
    for (const Stmt* inner : statements_of(stmt)) list_nested(unit, *inner);
}

void HandleSets::unit_definitions(size_t unit) {
    for (const Function* f : units_[unit].functions) list(unit, *f);
    std::vector<ShaderDefinition*> shaders = ast_.shaders;
    if (units_[unit].shader) shaders = {units_[unit].shader};
    for (const ShaderDefinition* shader : shaders) {
        list_nested(unit, *shader->body);
        if (!shader->shader_class) continue;
        for (const Function* method : shader->shader_class->methods) list(unit, *method);
    }
}

// A parameter is what it is bound to, else its default.
void HandleSets::parameters(size_t unit) {
    const Unit& u = units_[unit];
    for (const Symbol* symbol : u.shader ? u.shader->parameters : std::span<Symbol*>()) {
        auto bound = u.bound.find(symbol->name);
        if (!symbol->handle || bound == u.bound.end()) {
            declared(unit, *symbol);
            continue;
        }
        for (const std::string& handle : bound->second) {
            size_t named = unit_named(units_, handle);
            add({int(unit), std::string(symbol->name)}, named ? handle_of(named) : kNullHandle);
        }
    }
}

void HandleSets::declared(size_t unit, const Symbol& symbol) {
    if (!symbol.handle) return;
    bool zeros = symbol.type.array_length > 0 || symbol.length || !symbol.type.is_array();
    add({int(unit), std::string(symbol.name)},
        symbol.initial ? of(unit, *symbol.initial) : HandleSet(zeros));
}

void HandleSets::function(size_t unit, const Function& f) {
    for (const Symbol* parameter : f.parameters)
        if (parameter->initial) {
            expression(unit, &f, *parameter->initial);
            if (parameter->handle) declared(unit, *parameter);
        }
    statement(unit, &f, *f.body);
}

void HandleSets::statement(size_t unit, const Function* f, const Stmt& stmt) {
    for (const Expr* e : expressions_of(stmt)) expression(unit, f, *e);
    if (const auto* declaration = as_if<DeclareStmt>(&stmt))
        for (const Symbol* symbol : declaration->symbols) declared(unit, *symbol);
    if (const auto* given = as_if<ReturnStmt>(&stmt); given && given->value && f)
        add({int(unit), result_of(f->name)}, of(unit, *given->value));
    if (const auto* nested = as_if<FunctionStmt>(&stmt)) function(unit, *nested->function);
    for (const Stmt* inner : statements_of(stmt)) statement(unit, f, *inner);
}

// ---- expressions --------------------------------------------------------------------------------

void HandleSets::expression(size_t unit, const Function* f, const Expr& e) {
    for (const Expr* operand : operands_of(e)) expression(unit, f, *operand);
    mentioned_[unit] |= of(unit, e);
    if (const auto* assign = as_if<AssignExpr>(&e))
        for (const Key& key : keys_of(unit, *assign->target)) add(key, of(unit, *assign->value));
    if (const auto* node = as_if<CallExpr>(&e)) call(unit, f, *node);
}

// The variables that a name, or an element of it, can mean.
std::vector<HandleSets::Key> HandleSets::keys_of(size_t unit, const Expr& target) const {
    if (const auto* element = as_if<IndexExpr>(&target)) return keys_of(unit, *element->array);
    const auto* named = as_if<VariableExpr>(&target);
    if (!named) return {};
    if (!is_member(named->name)) return {{int(unit), std::string(named->name)}};
    std::vector<Key> keys{{kOfStruct, std::string(last_name(named->name))}};
    if (first_name(named->name) == "this" && last_path(named->name) == "this")
        keys.push_back({int(unit), std::string(last_name(named->name))});
    return keys;
}

HandleSet HandleSets::of_path(size_t unit, std::string_view path) const {
    if (path == "null") return kNullHandle;
    if (path == "this") return handle_of(unit);
    HandleSet set = at({int(unit), std::string(path)});
    if (!is_member(path)) {
        set |= at({kOfStruct, std::string(path)});  // a member, alone in a method
        return path == "surface" && !set ? handle_of(0) : set;
    }
    std::string last(last_name(path));
    set |= at({kOfStruct, last});
    std::string_view object = last_path(path);
    if (object == "this") return set | at({int(unit), last});
    for (size_t k : units_of(of_path(unit, object))) set |= at({int(k), last});
    return set;
}

HandleSet HandleSets::of(size_t unit, const Expr& e) const {
    switch (e.kind) {
        case ExprKind::Variable:
            return of_path(unit, as<VariableExpr>(e).name);
        case ExprKind::Index:
            return of(unit, *as<IndexExpr>(e).array);
        case ExprKind::Select:
            return of(unit, *as<SelectExpr>(e).yes) | of(unit, *as<SelectExpr>(e).no);
        case ExprKind::Assign:
            return of(unit, *as<AssignExpr>(e).value);
        case ExprKind::Call:
            return of_call(unit, as<CallExpr>(e));
        case ExprKind::ArrayLiteral: {
            HandleSet set = 0;
            for (const Expr* item : as<ArrayLiteralExpr>(e).items) set |= of(unit, *item);
            return set;
        }
        default:
            return 0;
    }
}

// What getshader() can give for the expression.
HandleSet HandleSets::of_text(size_t unit, const Expr& e) const {
    if (std::optional<std::string> handle = text_of(units_[unit], e)) {
        size_t named = unit_named(units_, *handle);
        return named ? handle_of(named) : kNullHandle;
    }
    HandleSet set = kNullHandle;
    for (size_t k = 1; k < units_.size(); ++k) set |= handle_of(k);
    return set;
}

HandleSet HandleSets::of_call(size_t unit, const CallExpr& e) const {
    HandleSet set = 0;
    std::string result = result_of(e.name);
    if (e.method) {
        for (size_t k : units_of(of(unit, *e.args[0]))) set |= at({int(k), result});
        if (auto found = functions_.find({kOfStruct, std::string(e.name)});
            found != functions_.end())
            for (const auto& [owner, f] : found->second) set |= at({int(owner), result});
        return set;
    }
    if (e.name == "getshader" && e.args.size() == 1) return of_text(unit, *e.args[0]);
    if (e.name == "getlights" || e.name == "lighthandle") return kLightHandles;
    if (e.name == "getshaders") {
        std::string query;
        if (e.args.size() == 2) query = text_of(units_[unit], *e.args[1]).value_or("");
        for (size_t k = 1; k < units_.size(); ++k)
            if (in_category(units_[k], query)) set |= handle_of(k);
        return set;
    }
    return at({int(unit), result});
}

void HandleSets::call(size_t unit, const Function* f, const CallExpr& e) {
    if (e.name == "push" && e.args.size() == 2)
        for (const Key& key : keys_of(unit, *e.args[0])) add(key, of(unit, *e.args[1]));
    if (e.name == "resize" && !e.args.empty() && of(unit, *e.args[0]))
        for (const Key& key : keys_of(unit, *e.args[0])) add(key, kNullHandle);
    auto named = [&](int owner) {
        auto found = functions_.find({owner, std::string(e.name)});
        return found == functions_.end() ? decltype(found->second)() : found->second;
    };
    auto pass_all = [&](int owner) {
        for (const auto& [callee_unit, callee] : named(owner))
            pass(unit, f, e, callee_unit, *callee);
    };
    if (e.name == "getvar" && e.args.size() == 3)
        if (const auto* name = as_if<StringExpr>(e.args[1]))
            for (size_t k : units_of(of(unit, *e.args[0])))
                for (const Key& key : keys_of(unit, *e.args[2]))
                    add(key, at({int(k), std::string(name->value)}));
    if (!e.method) return pass_all(int(unit));
    HandleSet set = of(unit, *e.args[0]);
    for (size_t k : units_of(set)) pass_all(int(k));
    if (!set) pass_all(kOfStruct);
}

void HandleSets::pass(size_t unit, const Function* f, const CallExpr& e, size_t callee_unit,
                      const Function& callee) {
    calls_.push_back({unit, callee_unit, f, &callee, e.span});
    auto args = e.args.subspan(e.method);
    for (size_t k = 0; k < std::min(args.size(), callee.parameters.size()); ++k) {
        const Symbol& formal = *callee.parameters[k];
        if (!formal.handle) continue;
        Key key{int(callee_unit), std::string(formal.name)};
        add(key, of(unit, *args[k]));
        if (!formal.output) continue;
        for (const Key& target : keys_of(unit, *args[k])) add(target, at(key));
    }
}

// ---- results ------------------------------------------------------------------------------------

HandleSet HandleSets::used() const {
    HandleSet used = handle_of(0);
    for (const auto& [key, set] : sets_)
        if (key.first == kOfStruct) used |= set;
    for (HandleSet before = 0; before != used;) {
        before = used;
        for (size_t unit : units_of(used)) {
            used |= mentioned_[unit];
            for (const auto& [key, set] : sets_)
                if (key.first == int(unit)) used |= set;
        }
    }
    return used & ~(kNullHandle | kLightHandles);
}

std::vector<size_t> HandleSets::in_order(HandleSet used) const {
    std::vector<size_t> order;
    std::set<const Function*> seen;
    HandleSet done = 0;
    // Before a unit's own: the units whose functions are called on the way.
    auto visit = [&](auto&& self, size_t unit) -> void {
        if (done & handle_of(unit)) return;
        done |= handle_of(unit);
        std::vector<const Function*> open;
        for (const Method& method : units_[unit].methods)
            if (method.name == "construct" || method.name == "begin")
                open.push_back(method.function);
        while (!open.empty()) {
            const Function* f = open.back();
            open.pop_back();
            if (!seen.insert(f).second) continue;
            for (const UnitCall& call : calls_) {
                if (call.caller != f) continue;
                if (call.callee_unit != unit && (used & handle_of(call.callee_unit)))
                    self(self, call.callee_unit);
                open.push_back(call.callee);
            }
        }
        order.push_back(unit);
    };
    for (size_t unit : units_of(used))
        if (unit > 0) visit(visit, unit);
    std::erase(order, 0u);
    return order;
}

// Depth first from a call on; `path` is what leads there.
bool HandleSets::search(const UnitCall& from, std::vector<UnitCall>& path,
                        std::set<const Function*>& done) const {
    path.push_back(from);
    for (size_t k = 0; k < path.size(); ++k) {
        if (path[k].caller != from.callee) continue;
        bool several = std::any_of(path.begin() + long(k), path.end(), [](const UnitCall& call) {
            return call.unit != call.callee_unit;
        });
        if (!several) continue;
        path.erase(path.begin(), path.begin() + long(k));
        return true;
    }
    if (done.insert(from.callee).second)
        for (const UnitCall& next : calls_)
            if (next.caller == from.callee && search(next, path, done)) return true;
    path.pop_back();
    return false;
}

std::vector<UnitCall> HandleSets::cycle() const {
    std::vector<UnitCall> path;
    std::set<const Function*> done;
    for (const UnitCall& call : calls_)
        if (call.caller && !done.contains(call.callee) && search(call, path, done)) return path;
    return {};
}

}  // namespace kinora::rsl
