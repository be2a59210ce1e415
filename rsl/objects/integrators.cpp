// rsl/objects/integrators.cpp: directlighting() and indirectspecular() of a class.
#include "rsl/objects/integrators.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <ranges>
#include <set>

#include "rsl/model/heuristics.h"
#include "rsl/objects/build_tree.h"
#include "rsl/objects/light_samples.h"
#include "rsl/syntax/ast_parts.h"
#include "rsl/syntax/copy_tree.h"

namespace kinora::rsl {

namespace {

// What a source calls, and the functions of integrators.h that it becomes a call of.
struct Integrator {
    std::string_view name;
    std::string_view function;  // with "_of" of another shader, "_among" of listed lights, and
                                // "_keeping" where "materialsamples" are kept, or "_lights" where
                                // the class has none
    std::string_view method;    // of the class, which the functions call
    size_t pairs;               // where the pairs begin
};
constexpr Integrator kIntegrators[] = {
    {"directlighting", "integrate_direct", "evaluateSamples", 2},
    {"indirectspecular", "integrate_indirect", "generateSamples", 1},
};

// Results of directlighting() in the order of the functions' parameters.
constexpr std::string_view kResults[] = {"diffuseresult", "specularresult", "irradianceresult",
                                         "unshadoweddiffuseresult", "unshadowedspecularresult"};
constexpr size_t kUnshadowed = 3;  // from there on
// Results of "lightgroups", one a group.
constexpr std::string_view kGroupResults[] = {"groupeddiffuseresults", "groupedspecularresults",
                                              "groupedunshadoweddiffuseresults",
                                              "groupedunshadowedspecularresults"};

// What decides how directlighting() weighs, in the order of the functions' parameters.
constexpr std::string_view kWeighing[] = {"mis", "diffusemis", "heuristic"};
constexpr std::string_view kDomains[] = {"hemisphere", "sphere"};

// Names that no source can have.
constexpr std::string_view kUnwanted = "unwanted result", kUnwantedGroups = "unwanted results",
                           kNoGroups = "no groups";

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
    std::array<Expr*, std::size(kGroupResults)> of_groups{};
    Expr* groups = nullptr;
    std::array<Expr*, std::size(kWeighing)> weighing{};
    Expr* domain = nullptr;
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
        list_handles();
        has_specular_light_ = std::ranges::any_of(class_.methods, [&](Function* method) {
            return method->name != "diffuselighting" &&
                   std::ranges::any_of(calls_of(*method), [](const CallExpr* call) {
                       return call->name == kIntegrators[0].name && !call->method;
                   });
        });
        for (Function* method : class_.methods)
            for (CallExpr* call : calls_of(*method))
                for (const Integrator& row : kIntegrators)
                    if (row.name == call->name && !call->method && !bind(row, *call, method->name))
                        call->args = {};  // reported
        if (!names_.empty()) adopt();
    }

  private:
    template <class... Args>
    Finding& report(const FindingInfo& info, const SourceSpan& span, const Args&... args) {
        const Token& token = ast_.tokens.tokens[span.token];
        return reporter_.report(info, span.where, token.macro, token.spelling, args...);
    }

    static std::vector<CallExpr*> calls_of(const Function& method) {
        std::vector<CallExpr*> calls;
        auto collect = [&](Expr& e) {
            if (auto* call = as_if<CallExpr>(&e)) calls.push_back(call);
        };
        each_expr(static_cast<Stmt*>(method.body), collect);
        return calls;
    }
    bool has(std::string_view method) const { return has_sample_method(class_, method); }

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

    bool is_open(const Expr& e) const {
        const auto* variable = as_if<VariableExpr>(&e);
        return variable && open_.contains(variable->name);
    }

    // Names of variables of type shader, and of resizable arrays, wherever they are declared.
    void list_handles() {
        auto add = [&](const Symbol* symbol) {
            if (symbol->handle) (symbol->type.is_array() ? lists_ : handles_).insert(symbol->name);
            if (symbol->type.array_length == 0 || symbol->length) open_.insert(symbol->name);
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
        const bool keeps = given.samples && (!own || has("generateSamples"));
        if (direct) {
            Expr* category = category_of(*call.args[1]);
            if (!category && !is_list(*call.args[1]))
                return report(Code::RSL_HANDLE_WANTED, call.args[1]->span).help =
                           "the lights are a list: shader lights[] = getlights();",
                                                       false;
            if (!category) args.push_back(call.args[1]), function += "_among";
            args.push_back(hints_of(row, given, make));
            args.push_back(category ? category : make.text(""));
            args.push_back(make.number(method != "specularlighting"));
            args.push_back(make.number(method != "diffuselighting"));
            for (Expr* result : given.results)
                args.push_back(result ? result : make.variable(kUnwanted));
            add_groups(given, make, args);
            args.push_back(given.weighing[0] ? given.weighing[0] : make.number(1));
            args.push_back(given.weighing[1] ? given.weighing[1] : make.number(0));
            args.push_back(make.call(
                "misheuristic",
                {given.weighing[2] ? given.weighing[2] : make.text(kHeuristics[0].name)}));
        } else {
            args.push_back(make.call(row.name, given.hints));
            args.push_back(given.maxdist ? given.maxdist : make.number(1e30));
            args.push_back(make.number(has_specular_light_));
        }
        if (keeps) args.push_back(given.samples);
        const bool none = direct && own && !has("generateSamples");
        call.args = ast_.arena.copy(args);
        call.name = bound_name(function + (keeps ? "_keeping" : none ? "_lights" : ""), row);
        return true;
    }

    // The call that reports them, tells the renderer the lights' domain and empties the results of
    // light groups.
    Expr* hints_of(const Integrator& row, const IntegratorArguments& given, TreeBuilder& make) {
        Expr* hints = make.call("directlighting", given.hints);
        auto also = [&](Expr* zero) { hints = make.binary(Op::Add, hints, zero); };
        if (given.domain) also(make.call("samplingdomain", {given.domain}));
        for (Expr* result : given.of_groups)
            if (given.groups && result)
                also(make.call(
                    bound_name(is_open(*result) ? "integrate_resize" : "integrate_clear", row),
                    {copy_tree(ast_, *result), copy_tree(ast_, *given.groups)}));
        return hints;
    }

    // False where a literal is none of the words, which `word` makes of the rows; what else it may
    // be is known when the shader runs.
    template <class Rows, class Word = std::identity>
    bool is_among(const Integrator& row, std::string_view pair, const Expr& value, const Rows& rows,
                  Word word = {}) {
        const auto* text = as_if<StringExpr>(&value);
        auto words = rows | std::views::transform(word);
        if (!text || std::ranges::any_of(words, [&](auto w) { return w == text->value; }))
            return true;
        report(Code::RSL_PAIR_VALUE, value.span, pair, row.name, text->value,
               fmt::format("{}", fmt::join(words, " or ")));
        return false;
    }
    bool is_strategy(const Integrator& row, std::string_view pair, const Expr& value) {
        const auto* number = as_if<NumberExpr>(&value);
        const bool fits = !number || number->value == 0 || number->value == 1 ||
                          (number->value == 2 && pair == "mis");
        if (!fits)
            report(Code::RSL_PAIR_VALUE, value.span, pair, row.name, number->value,
                   pair == "mis" ? "0 (lights), 1 (both) or 2 (material)" : "0 or 1");
        return fits;
    }

    // Whether it is one of those that decide how samples are weighed; `*fits`: false after a
    // finding.
    bool weighing(const Integrator& row, std::string_view name, Expr* value,
                  IntegratorArguments* given, bool* fits) {
        const size_t at = size_t(std::ranges::find(kWeighing, name) - std::begin(kWeighing));
        if (name == "integrationdomain") {
            *fits = is_among(row, name, *value, kDomains);
            if (row.pairs == 2) given->domain = value;
            return row.pairs == 2;
        }
        const bool text = value->kind == ExprKind::String, number = value->kind == ExprKind::Number;
        if (row.pairs != 2 || at == std::size(kWeighing)) return false;
        if (name == "heuristic" ? number : text) return false;  // the hints' finding
        *fits = name == "heuristic" ? is_among(row, name, *value, kHeuristics, &Heuristic::name)
                                    : is_strategy(row, name, *value);
        given->weighing[at] = value;
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
            else if (bool fits = true; weighing(row, name->value, value, given, &fits) || !fits) {
                if (!fits) return false;
            } else if (row.pairs == 1 || !result(name->value, *value, given))
                given->hints.insert(given->hints.end(), {call.args[k], value});
        }
        return true;
    }

    bool result(std::string_view name, Expr& value, IntegratorArguments* given) {
        if (name == "lightgroups") return given->groups = &value, true;
        for (size_t k = 0; k < std::size(kGroupResults); ++k)
            if (kGroupResults[k] == name) return given->of_groups[k] = &value, true;
        for (size_t k = 0; k < std::size(kResults); ++k) {
            if (kResults[k] != name) continue;
            if (value.kind != ExprKind::Variable && value.kind != ExprKind::Index) {
                report(Code::RSL_OUTPUT_ARGUMENT, value.span, fmt::format("\"{}\"", name),
                       "directlighting");
                return true;
            }
            given->results[k] = &value;
            return true;
        }
        return false;
    }

    // Flags and variables of results without shadows and of light groups.
    void add_groups(const IntegratorArguments& given, TreeBuilder& make, std::vector<Expr*>& args) {
        args.push_back(make.number(given.results[kUnshadowed] || given.results[kUnshadowed + 1]));
        args.push_back(given.groups ? given.groups : make.variable(kNoGroups));
        for (Expr* result : given.of_groups) {
            args.push_back(make.number(given.groups && result));
            args.push_back(given.groups && result ? result : make.variable(kUnwantedGroups));
        }
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

    // The name of a function of integrators.h in the class, which gets what it calls too. Findings
    // print it up to the space.
    std::string_view bound_name(const std::string& function, const Integrator& row) {
        std::string_view& name = names_[ast_.arena.copy(function)];
        if (!name.empty()) return name;
        name = ast_.arena.copy(fmt::format("{} {}", row.name, function));
        const std::string_view bound = name;
        auto called = [&](Expr& e) {
            const auto* call = as_if<CallExpr>(&e);
            if (call && call->name.starts_with("integrate_"))
                bound_name(std::string(call->name), row);
        };
        for (Function* f : functions_)
            if (f->name == function) each_expr(static_cast<Stmt*>(f->body), called);
        return bound;
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
            make.declare({make.symbol(SymbolKind::Local, kUnwanted, {BaseType::Color, -1}),
                          make.symbol(SymbolKind::Local, kUnwantedGroups, {BaseType::Color, 1}),
                          make.symbol(SymbolKind::Local, kNoGroups, {BaseType::String, 1})}));
        class_.members = ast_.arena.copy(members);
    }

    Ast& ast_;
    Reporter& reporter_;
    ShaderDefinition& shader_;
    ClassDefinition& class_;
    std::span<Function* const> functions_;                // of its source
    std::map<std::string_view, std::string_view> names_;  // of functions that are called
    std::set<std::string_view> handles_, lists_;          // variables of type shader, and shader[]
    std::set<std::string_view> open_;                     // resizable arrays
    bool has_specular_light_ = false;  // directlighting() gives it that of the lights
};

}  // namespace

namespace {

// Those that no class has adopted are not looked at.
void drop_integrators(std::vector<Function*>& functions) {
    std::erase_if(functions, [](const Function* f) {
        return f->name.find(' ') != f->name.npos || f->name.starts_with("integrate_");
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
