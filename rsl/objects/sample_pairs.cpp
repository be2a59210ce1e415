// rsl/objects/sample_pairs.cpp: optional parameters of generateSamplesEnv(), evaluateSamplesEnv().
#include "rsl/objects/sample_pairs.h"

#include <array>

#include "rsl/objects/build_tree.h"
#include "rsl/syntax/ast_parts.h"

namespace kinora::rsl {

namespace {

struct SampleCall {
    std::string_view name;
    size_t pairs;  // where they begin
};
constexpr SampleCall kCalls[] = {{"generateSamplesEnv", 5}, {"evaluateSamplesEnv", 4}};

// In the order of the functions' last parameters; the others change nothing.
constexpr std::array<std::string_view, 2> kArguments = {"environmentspace", "scale"};
constexpr std::string_view kIdle[] = {"distribution", "radius"};

class SamplePairs {
  public:
    SamplePairs(Ast& ast, Reporter& reporter) : ast_(ast), reporter_(reporter) {}

    void look(Stmt* stmt) {
        if (!stmt) return;
        if (auto* nested = as_if<FunctionStmt>(stmt)) return look(nested->function->body);
        for_each_part(
            *stmt, [&](Expr* e) { look(e); }, [&](Stmt* part) { look(part); });
    }

  private:
    void look(Expr* e) {
        for_each_operand(*e, [&](Expr* part) { look(part); });
        auto* call = as_if<CallExpr>(e);
        for (const SampleCall& row : kCalls)
            if (call && call->name == row.name && call->args.size() > row.pairs &&
                call->args[row.pairs]->kind == ExprKind::String)
                bind(row, *call);
    }

    template <class... Args>
    void report(const FindingInfo& info, const SourceSpan& span, const Args&... args) {
        const Token& token = ast_.tokens.tokens[span.token];
        reporter_.report(info, span.where, token.macro, token.spelling, args...);
    }

    void bind(const SampleCall& row, CallExpr& call) {
        TreeBuilder make(ast_, call.span);
        std::array<Expr*, 2> given = {make.text("world"), make.number(1)};
        for (size_t k = row.pairs; k < call.args.size(); k += 2) {
            const auto* name = as_if<StringExpr>(call.args[k]);
            if (!name || k + 1 == call.args.size()) {
                report(Code::RSL_PAIR_NAME, call.args[k]->span, row.name);
                break;
            }
            bool known = false;
            for (size_t a = 0; a < kArguments.size(); ++a)
                if (name->value == kArguments[a]) given[a] = call.args[k + 1], known = true;
            if (known) continue;
            bool idle = name->value == kIdle[0] || name->value == kIdle[1];
            report(idle ? Code::RSL_PAIR_IDLE : Code::RSL_PAIR_UNKNOWN, name->span, name->value,
                   row.name);
        }
        std::vector<Expr*> args(call.args.begin(), call.args.begin() + long(row.pairs));
        args.insert(args.end(), given.begin(), given.end());
        call.args = ast_.arena.copy(args);
    }

    Ast& ast_;
    Reporter& reporter_;
};

}  // namespace

void bind_sample_pairs(Ast& ast, Reporter& reporter, std::span<const Unit> units) {
    SamplePairs pairs(ast, reporter);
    auto functions = [&](std::span<Function* const> all) {
        for (Function* function : all) pairs.look(function->body);
    };
    auto shader = [&](const ShaderDefinition& definition) {
        if (definition.body) pairs.look(definition.body);
        if (definition.shader_class) functions(definition.shader_class->methods);
    };
    functions(ast.functions);
    for (const ShaderDefinition* definition : ast.shaders) shader(*definition);
    for (const StructDefinition* structure : ast.structs) functions(structure->methods);
    for (size_t k = 1; k < units.size(); ++k) {
        functions(units[k].functions);
        shader(*units[k].shader);
    }
}

}  // namespace kinora::rsl
