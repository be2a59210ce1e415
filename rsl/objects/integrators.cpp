// rsl/objects/integrators.cpp: directlighting() and indirectspecular() of a class.
#include "rsl/objects/integrators.h"

#include <algorithm>
#include <map>
#include <set>

#include "rsl/objects/build_tree.h"
#include "rsl/syntax/ast_parts.h"
#include "rsl/syntax/copy_tree.h"

namespace kinora::rsl {

namespace {

// What a source calls, and the functions of integrators.h that it becomes a call of.
struct Integrator {
    std::string_view name;
    std::string_view function;  // with "_of" of another shader, "_among" of listed lights, and
                                // "_keeping" where "materialsamples" are kept
    std::string_view method;   // of the class, which the functions call
    size_t pairs;              // where the pairs begin
};
constexpr Integrator kIntegrators[] = {
    {"directlighting", "integrate_direct", "evaluateSamples", 2},
    {"indirectspecular", "integrate_indirect", "generateSamples", 1},
};

// Results of directlighting() in the order of the functions' parameters.
constexpr struct {
    std::string_view name;
    int parameter;
    bool shadowed = true;  // false: Kinora has only the shadowed one
} kResults[] = {{"diffuseresult", 0},
                {"specularresult", 1},
                {"irradianceresult", 2},
                {"unshadoweddiffuseresult", 3, false},
                {"unshadowedspecularresult", 4, false}};
constexpr std::string_view kUnwanted = "unwanted result";  // a name that no source can have

// Calls f with each expression below, operands before what holds them.
template <class F>
void each_expr(Expr* e, F& f) {
    for_each_operand(*e, [&](Expr* part) { each_expr(part, f); });
    f(*e);
}
template <class F>
void each_expr(Stmt* stmt, F& f) {
    if (auto* nested = as_if<FunctionStmt>(stmt))
        return each_expr(static_cast<Stmt*>(nested->function->body), f);
    for_each_part(
        *stmt, [&](Expr* e) { each_expr(e, f); }, [&](Stmt* part) { each_expr(part, f); });
}

bool is_named(const Expr& e, std::string_view name) {
    const auto* variable = as_if<VariableExpr>(&e);
    return variable && variable->name == name;
}

const CallExpr* call_of_getlights(const Expr* e) {
    const auto* call = as_if<CallExpr>(e);
    return call && call->name == "getlights" ? call : nullptr;
}

// The pairs of a call, sorted.
struct IntegratorArguments {
    std::vector<Expr*> hints;  // names and values of all others
    std::vector<Expr*> results{std::size(kResults)};
    Expr* samples = nullptr;
    Expr* maxdist = nullptr;
};

class ClassIntegrators {
  public:
    ClassIntegrators(Ast& ast, Reporter& reporter, ShaderDefinition& shader,
                     std::span<Function* const> functions)
        : ast_(ast),
          reporter_(reporter),
          shader_(shader),
          class_(*shader.shader_class),
          functions_(functions) {}

    void run() {
        std::vector<CallExpr*> calls;
        list_handles();
        for (Function* method : class_.methods) {
            calls.clear();
            auto collect = [&](Expr& e) {
                if (auto* call = as_if<CallExpr>(&e)) calls.push_back(call);
            };
            each_expr(static_cast<Stmt*>(method->body), collect);
            for (CallExpr* call : calls)
                for (const Integrator& row : kIntegrators)
                    if (row.name == call->name && !call->method && !bind(row, *call, method->name))
                        call->args = {};  // reported
        }
        if (!names_.empty()) adopt();
    }

  private:
    template <class... Args>
    Finding& report(const FindingInfo& info, const SourceSpan& span, const Args&... args) {
        const Token& token = ast_.tokens.tokens[span.token];
        return reporter_.report(info, span.where, token.macro, token.spelling, args...);
    }

    // Of the form (string what; output __radiancesample samples[]).
    bool has(std::string_view method) const {
        return std::any_of(class_.methods.begin(), class_.methods.end(), [&](const Function* f) {
            return f->name == method && f->parameters.size() == 2 &&
                   f->parameters[0]->type == Type{BaseType::String, -1} &&
                   f->parameters[1]->structure && f->parameters[1]->type.is_array();
        });
    }

    // Whether the expression is of type shader.
    bool is_handle(const Expr& e) const {
        if (const auto* element = as_if<IndexExpr>(&e)) return is_list(*element->array);
        if (const auto* call = as_if<CallExpr>(&e)) return call->name == "getshader";
        const auto* variable = as_if<VariableExpr>(&e);
        return variable && handles_.contains(variable->name);
    }
    bool is_list(const Expr& e) const {
        if (const auto* call = as_if<CallExpr>(&e)) return call->name == "getshaders";
        const auto* variable = as_if<VariableExpr>(&e);
        return variable && lists_.contains(variable->name);
    }

    // Names of variables of type shader, wherever they are declared.
    void list_handles() {
        auto add = [&](const Symbol* symbol) {
            if (symbol->handle) (symbol->type.is_array() ? lists_ : handles_).insert(symbol->name);
        };
        auto look = [&](Stmt* stmt, auto& self) -> void {
            if (auto* declared = as_if<DeclareStmt>(stmt))
                for (const Symbol* symbol : declared->symbols) add(symbol);
            for_each_part(
                *stmt, [](Expr*) {}, [&](Stmt* part) { self(part, self); });
        };
        for (const Symbol* parameter : shader_.parameters) add(parameter);
        for (Stmt* member : class_.members) look(member, look);
        for (Function* method : class_.methods) {
            for (const Symbol* formal : method->parameters) add(formal);
            look(method->body, look);
        }
    }

    // False after a finding.
    bool bind(const Integrator& row, CallExpr& call, std::string_view method) {
        if (call.args.size() < row.pairs) {
            report(Code::RSL_ARGUMENT_COUNT, call.span, row.name, row.pairs, call.args.size());
            return false;
        }
        bool own = is_named(*call.args[0], "this");
        if (!own && !is_handle(*call.args[0]))
            return report(Code::RSL_HANDLE_WANTED, call.args[0]->span), false;
        if (own && !has(row.method)) {
            report(Code::RSL_NO_SAMPLE_METHOD, call.span, row.name, shader_.name, row.method);
            return false;
        }
        IntegratorArguments given;
        if (!sort(row, call, &given)) return false;
        TreeBuilder make(ast_, call.span);
        std::vector<Expr*> args;
        std::string function(row.function);
        if (!own) args.push_back(call.args[0]), function += "_of";
        bool direct = row.pairs == 2;
        if (direct) {
            Expr* category = category_of(*call.args[1]);
            if (!category && !is_list(*call.args[1]))
                return report(Code::RSL_HANDLE_WANTED, call.args[1]->span).help =
                           "the lights are a list: shader lights[] = getlights();",
                       false;
            if (!category) args.push_back(call.args[1]), function += "_among";
            args.push_back(make.call(row.name, given.hints));
            args.push_back(category ? category : make.text(""));
            args.push_back(make.number(method != "specularlighting"));
            args.push_back(make.number(method != "diffuselighting"));
            for (Expr* result : given.results)
                args.push_back(result ? result : make.variable(kUnwanted));
        } else {
            args.push_back(make.call(row.name, given.hints));
            args.push_back(given.maxdist ? given.maxdist : make.number(1e30));
        }
        bool keeps = given.samples && (!own || has("generateSamples"));
        if (keeps) args.push_back(given.samples);
        call.args = ast_.arena.copy(args);
        call.name = bound_name(function + (keeps ? "_keeping" : ""), row);
        if (!direct) bound_name(function + "_keeping", row);
        return true;
    }

    // False after a finding.
    bool sort(const Integrator& row, const CallExpr& call, IntegratorArguments* given) {
        for (size_t k = row.pairs; k < call.args.size(); k += 2) {
            const auto* name = as_if<StringExpr>(call.args[k]);
            if (!name || k + 1 == call.args.size())
                return report(Code::RSL_PAIR_NAME, call.args[k]->span, row.name), false;
            Expr* value = call.args[k + 1];
            if (name->value == "materialsamples")
                given->samples = value;
            else if (row.pairs == 1 && name->value == "maxdist")
                given->maxdist = value;
            else if (row.pairs == 1 || !result(name->value, *value, given))
                given->hints.insert(given->hints.end(), {call.args[k], value});
        }
        return true;
    }

    bool result(std::string_view name, Expr& value, IntegratorArguments* given) {
        for (const auto& row : kResults) {
            if (row.name != name) continue;
            if (value.kind != ExprKind::Variable && value.kind != ExprKind::Index) {
                report(Code::RSL_OUTPUT_ARGUMENT, value.span, fmt::format("\"{}\"", name),
                       "directlighting");
                return true;
            }
            if (!row.shadowed && said_.emplace(name).second)
                report(Code::RSL_WITH_SHADOWS, value.span, name);
            given->results[size_t(row.parameter)] = &value;
            return true;
        }
        return false;
    }

    // The category of the lights that getlights() gives: directly, or to the one variable named.
    // Null for other lists.
    Expr* category_of(Expr& lights) {
        const CallExpr* giver = call_of_getlights(&lights);
        if (const auto* variable = as_if<VariableExpr>(&lights)) giver = giver_of(variable->name);
        if (giver && giver->args.size() == 2) {
            const auto* kind = as_if<StringExpr>(giver->args[0]);
            if (kind && kind->value == "category") return copy_tree(ast_, *giver->args[1]);
        }
        if (giver && giver->args.empty()) return ast_.make<StringExpr>(lights.span);
        return nullptr;
    }

    // The only call of getlights() that the variable takes its value of.
    const CallExpr* giver_of(std::string_view name) {
        const CallExpr* giver = nullptr;
        int givers = 0;
        auto give = [&](const Expr* value) {
            givers += value != nullptr;
            if (value) giver = call_of_getlights(value);
        };
        auto look = [&](Stmt* stmt, auto& self) -> void {
            if (auto* declared = as_if<DeclareStmt>(stmt))
                for (const Symbol* symbol : declared->symbols)
                    if (symbol->name == name) give(symbol->initial);
            auto assigned = [&](Expr& e) {
                auto* assign = as_if<AssignExpr>(&e);
                if (assign && is_named(*assign->target, name)) give(assign->value);
            };
            for_each_part(
                *stmt, [&](Expr* e) { each_expr(e, assigned); },
                [&](Stmt* part) { self(part, self); });
        };
        for (Stmt* member : class_.members) look(member, look);
        for (Function* method : class_.methods) look(method->body, look);
        return givers == 1 ? giver : nullptr;
    }

    // The name of a function of integrators.h in the class. Findings print it up to the space.
    std::string_view bound_name(const std::string& function, const Integrator& row) {
        std::string_view& name = names_[ast_.arena.copy(function)];
        if (name.empty()) name = ast_.arena.copy(fmt::format("{} {}", row.name, function));
        return name;
    }

    // The functions that are called become methods.
    void adopt() {
        std::vector<Function*> methods(class_.methods.begin(), class_.methods.end());
        auto rename = [&](Expr& e) {
            auto* call = as_if<CallExpr>(&e);
            if (auto found = call ? names_.find(call->name) : names_.end(); found != names_.end())
                call->name = found->second;
        };
        for (Function* function : functions_) {
            auto found = names_.find(function->name);
            if (found == names_.end()) continue;
            function->name = found->second;
            each_expr(static_cast<Stmt*>(function->body), rename);
            methods.push_back(function);
        }
        class_.methods = ast_.arena.copy(methods);
        TreeBuilder make(ast_, shader_.span);
        std::vector<Stmt*> members(class_.members.begin(), class_.members.end());
        members.push_back(
            make.declare({make.symbol(SymbolKind::Local, kUnwanted, {BaseType::Color, -1})}));
        class_.members = ast_.arena.copy(members);
    }

    Ast& ast_;
    Reporter& reporter_;
    ShaderDefinition& shader_;
    ClassDefinition& class_;
    std::span<Function* const> functions_;  // of its source
    std::map<std::string_view, std::string_view> names_;  // of functions that are called
    std::set<std::string_view> said_;
    std::set<std::string_view> handles_, lists_;  // variables of type shader, and shader[]
};

}  // namespace

namespace {

// Those that no class has adopted are not looked at.
void drop_integrators(std::vector<Function*>& functions) {
    std::erase_if(functions, [](const Function* f) {
        return f->name.find(' ') != f->name.npos || f->name.starts_with("integrate_direct") ||
               f->name.starts_with("integrate_indirect");
    });
}

}  // namespace

void bind_integrators(Ast& ast, Reporter& reporter, std::span<Unit> units) {
    for (ShaderDefinition* shader : ast.shaders)
        if (shader->shader_class) ClassIntegrators(ast, reporter, *shader, ast.functions).run();
    for (size_t k = 1; k < units.size(); ++k)
        if (units[k].shader->shader_class)
            ClassIntegrators(ast, reporter, *units[k].shader, units[k].functions).run();
    drop_integrators(ast.functions);
    for (Unit& unit : units) drop_integrators(unit.functions);
}

}  // namespace kinora::rsl
