// rsl/shader.cpp: the stages of the front end in order.
#include "rsl/shader.h"

#include <fstream>
#include <iterator>

#include "rsl/check.h"
#include "rsl/parser.h"
#include "rsl/preprocess.h"
#include "rsl/reporter.h"
#include "rsl/usage.h"
#include "runtime/base/text_encoding.h"

namespace kinora::rsl {

namespace {

std::vector<ShaderParameter> shader_parameters(const ShaderDefinition& definition) {
    std::vector<ShaderParameter> parameters;
    for (Symbol* s : definition.parameters) {
        ShaderParameter p{s->name, s->type, s->detail, s->output, s, s->initial, {}};
        if (p.detail == Detail::Unspecified) p.detail = Detail::Uniform;
        p.constant = s->initial ? fold_constant(*s->initial) : zero_constant(s->type);
        parameters.push_back(std::move(p));
    }
    return parameters;
}

std::vector<std::unique_ptr<Shader>> make_shaders(const std::shared_ptr<Ast>& ast,
                                                  Reporter& reporter) {
    std::vector<std::unique_ptr<Shader>> shaders;
    std::unordered_set<const void*> reported;
    for (const ShaderDefinition* definition : ast->shaders) {
        auto shader = std::make_unique<Shader>();
        shader->name = definition->name;
        shader->kind = definition->kind;
        shader->ast = ast;
        shader->definition = definition;
        find_usage(*shader, *ast, reporter, reported);
        shader->parameters = shader_parameters(*definition);
        shaders.push_back(std::move(shader));
    }
    return shaders;
}

// What the later stages have to say of a source that has errors.
void find_further_errors(Ast& ast, Reporter& reporter) {
    std::unordered_set<const void*> reported;
    for (const ShaderDefinition* definition : ast.shaders) {
        Shader shader;
        shader.kind = definition->kind;
        shader.definition = definition;
        find_usage(shader, ast, reporter, reported);
    }
    infer_rates(ast, reporter);
}

}  // namespace

TokenStream preprocess(const ShaderSource& source, const CompileOptions& options,
                       Diagnostics& diagnostics) {
    TokenStream out;
    Reporter reporter(diagnostics, out, options.max_errors);
    Preprocessor(options, diagnostics, out, reporter).run(source);
    return out;
}

std::shared_ptr<Ast> parse(const ShaderSource& source, const CompileOptions& options,
                           Diagnostics& diagnostics) {
    auto ast = std::make_shared<Ast>();
    Reporter reporter(diagnostics, ast->tokens, options.max_errors);
    Preprocessor(options, diagnostics, ast->tokens, reporter).run(source);
    Parser(*ast, reporter).run();
    return reporter.errors() == 0 ? ast : nullptr;
}

std::vector<std::unique_ptr<Shader>> compile(const ShaderSource& source,
                                             const CompileOptions& options,
                                             Diagnostics& diagnostics) {
    auto ast = std::make_shared<Ast>();
    Reporter reporter(diagnostics, ast->tokens, options.max_errors);
    Preprocessor(options, diagnostics, ast->tokens, reporter).run(source);
    if (ast->tokens.truncated) return {};
    bool lacks_text = reporter.errors() > 0;
    Parser parser(*ast, reporter);
    parser.run();
    bool parsed = reporter.errors() == 0;
    Checker(*ast, reporter, options, lacks_text || parser.broken()).run();
    if (ast->shaders.empty() && reporter.errors() == 0) {
        Finding& finding = reporter.report(Code::RSL_NO_SHADER, ast->tokens.tokens[0]);
        if (!ast->functions.empty()) finding.help = "write its kind, as 'surface', before its name";
    }
    if (reporter.errors() > 0) {
        if (parsed) find_further_errors(*ast, reporter);
        return {};
    }
    auto shaders = make_shaders(ast, reporter);
    infer_rates(*ast, reporter);
    if (reporter.errors() > 0) return {};
    return shaders;
}

std::vector<std::unique_ptr<Shader>> compile_file(const std::string& path,
                                                  const CompileOptions& options,
                                                  Diagnostics& diagnostics) {
    std::ifstream in(path, std::ios::binary);
    std::string text(std::istreambuf_iterator<char>(in), {});
    if (!in) {
        diagnostics.report(Code::RSL_FILE_NOT_READ, Location{}, path);
        return {};
    }
    text = utf8_text(std::move(text));
    ShaderSource source{text, {}};
    source.map.file = diagnostics.files.add(path, text);
    return compile(source, options, diagnostics);
}

}  // namespace kinora::rsl
