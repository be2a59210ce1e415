// rsl/check/check.cpp: the order in which a source is checked.
#include "rsl/check/check.h"

#include <algorithm>

namespace kinora::rsl {

Checker::Checker(Ast& ast, Reporter& reporter, const CompileOptions& options,
                 const ParseRecovery& recovery)
    : ast_(ast),
      reporter_(ast, reporter),
      scopes_(ast),
      unknown_(ast, reporter_, recovery, scopes_),
      assignments_(reporter_),
      outputs_(ast, reporter_, assignments_),
      expressions_(ast, reporter_, options, recovery, scopes_, unknown_, assignments_, outputs_,
                   graph_),
      statements_(ast, reporter_, recovery, scopes_, unknown_, assignments_, expressions_) {}

void Checker::run() {
    Scopes::Guard file_scope(scopes_);
    outputs_.begin();
    for (Function* f : ast_.functions) statements_.declare(*f);
    for (Function* f : ast_.functions) statements_.function(*f);
    for (size_t i = 0; i < ast_.shaders.size(); ++i) {
        for (size_t k = 0; k < i; ++k)
            if (ast_.shaders[k]->name == ast_.shaders[i]->name)
                reporter_.report(Code::RSL_SHADER_REDEFINED, ast_.shaders[i]->span,
                                 ast_.shaders[i]->name);
        check_shader(*ast_.shaders[i]);
    }
    for (ShaderDefinition* shader : ast_.shaders) outputs_.end(*shader);
    graph_.mark_recursion(ast_.function_count);
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
                reporter_.report(Code::RSL_HIDES_OUTPUT, symbol.span, symbol.name);
        }
    }
}

void Checker::check_shader(ShaderDefinition& shader) {
    unknown_.begin_shader();
    Scopes::Guard scope(scopes_);
    statements_.parameters(shader.parameters);
    statements_.statement(*shader.body);
    warn_of_hidden_outputs(shader);
}

}  // namespace kinora::rsl
