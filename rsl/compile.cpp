// rsl/compile.cpp: the stages of the front end in order.
#include "rsl/compile.h"

#include <algorithm>

#include "rsl/check/check.h"
#include "rsl/check/usage.h"
#include "rsl/link.h"
#include "rsl/objects/handle_sets.h"
#include "rsl/objects/integrators.h"
#include "rsl/objects/objects.h"
#include "rsl/syntax/parser.h"
#include "rsl/text/preprocess.h"
#include "rsl/text/reporter.h"
#include "runtime/base/regular_file.h"
#include "runtime/base/text_encoding.h"

namespace kinora::rsl {

namespace {

constexpr uint64_t kMostSourceBytes = 64 << 20;

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
                                                  Reporter& reporter,
                                                  const ParseRecovery& recovery) {
    std::vector<std::unique_ptr<Shader>> shaders;
    std::unordered_set<const void*> reported;
    for (const ShaderDefinition* definition : ast->shaders) {
        auto shader = std::make_unique<Shader>();
        shader->name = definition->name;
        shader->kind = definition->kind;
        shader->ast = ast;
        shader->definition = definition;
        find_usage(*shader, *ast, reporter, recovery, reported);
        if (reporter.errors() == 0) shader->parameters = shader_parameters(*definition);
        shaders.push_back(std::move(shader));
    }
    return shaders;
}

// Whether the preprocessor's errors, those from `first` on, say that whole lines are missing: what
// is wrong inside a string or a macro's arguments stays where it is.
bool lacks_text(const Diagnostics& diagnostics, size_t first) {
    const auto& findings = diagnostics.findings();
    return std::any_of(findings.begin() + ptrdiff_t(first), findings.end(), [](const Finding& f) {
        return f.severity == Severity::Error && f.info != &Code::RSL_UNTERMINATED_STRING &&
               f.info != &Code::RSL_MACRO_ARGUMENTS;
    });
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

namespace {

// What is left to do for a tree, whose parts have been read.
std::vector<std::unique_ptr<Shader>> finish(const std::shared_ptr<Ast>& ast, Reporter& reporter,
                                            const CompileOptions& options,
                                            const ParseRecovery& recovery,
                                            std::vector<Unit> units) {
    bind_integrators(*ast, reporter);
    if (!expand_objects(*ast, reporter, std::move(units))) return {};
    Checker(*ast, reporter, options, recovery).run();
    if (ast->shaders.empty() && reporter.errors() == 0) {
        Finding& finding = reporter.report(Code::RSL_NO_SHADER, ast->tokens.tokens[0]);
        if (!ast->functions.empty()) finding.help = "write its kind, as 'surface', before its name";
    }
    auto shaders = make_shaders(ast, reporter, recovery);
    infer_rates(*ast, reporter);
    if (reporter.errors() > 0) return {};
    return shaders;
}

// Of the shaders that stand in the tree from `first` on; null after a finding.
ShaderDefinition* choose(const Ast& ast, Reporter& reporter, size_t first,
                         const LinkedSource& wanted, uint32_t first_token) {
    for (size_t k = first; k < ast.shaders.size(); ++k)
        if (wanted.shader.empty() || ast.shaders[k]->name == wanted.shader) return ast.shaders[k];
    if (reporter.errors() == 0)
        reporter.report(Code::RSL_NO_SHADER, ast.tokens.tokens[first_token]);
    return nullptr;
}

std::shared_ptr<const std::string> kept_text(const std::vector<LinkedPart>& parts,
                                             std::string_view text) {
    for (const LinkedPart& part : parts)
        if (*part.text == text) return part.text;
    return std::make_shared<const std::string>(text);
}

}  // namespace

std::vector<std::unique_ptr<Shader>> compile(const ShaderSource& source,
                                             const CompileOptions& options,
                                             Diagnostics& diagnostics) {
    auto ast = std::make_shared<Ast>();
    Reporter reporter(diagnostics, ast->tokens, options.max_errors);
    size_t before = diagnostics.findings().size();
    Preprocessor(options, diagnostics, ast->tokens, reporter).run(source);
    if (ast->tokens.truncated) return {};
    Parser parser(*ast, reporter);
    if (lacks_text(diagnostics, before)) parser.recovery().lose_everything();
    parser.run();
    return finish(ast, reporter, options, parser.recovery(), {});
}

std::unique_ptr<Shader> compile_linked(const std::vector<LinkedSource>& sources,
                                       const CompileOptions& options, Diagnostics& diagnostics) {
    auto ast = std::make_shared<Ast>();
    Reporter reporter(diagnostics, ast->tokens, options.max_errors);
    std::vector<Unit> units;
    std::vector<LinkedPart> parts;
    for (const LinkedSource& one : sources) {
        auto first = uint32_t(ast->tokens.tokens.size());
        size_t shaders = ast->shaders.size();
        ast->functions.clear();
        Preprocessor(options, diagnostics, ast->tokens, reporter).run(one.source);
        if (ast->tokens.truncated) return nullptr;
        Parser(*ast, reporter, first).run();
        ShaderDefinition* shader = choose(*ast, reporter, shaders, one, first);
        if (!shader || reporter.errors() > 0) return nullptr;
        units.push_back({one.handle, shader, ast->functions, first, one.texts, {}, {}});
        std::vector<std::string> handles;
        for (const Symbol* parameter : shader->parameters)
            if (parameter->handle && one.texts.contains(parameter->name))
                handles.emplace_back(parameter->name);
        parts.push_back({one.handle, std::string(shader->name), one.texts, std::move(handles),
                         kept_text(parts, one.source.text), one.source.map, first});
    }
    if (units.size() > kMostUnits) {
        reporter.report(Code::RSL_TOO_MANY_CO_SHADERS, ast->tokens.tokens[0], units.size() - 1,
                        kMostUnits - 1);
        return nullptr;
    }
    ast->shaders = {units[0].shader};
    ast->functions = units[0].functions;
    auto linked = finish(ast, reporter, options, ParseRecovery(), std::move(units));
    if (linked.empty()) return nullptr;
    linked[0]->parts = std::move(parts);
    return std::move(linked[0]);
}

std::vector<std::unique_ptr<Shader>> compile_file(const std::string& path,
                                                  const CompileOptions& options,
                                                  Diagnostics& diagnostics) {
    std::optional<std::string> bytes = read_regular_file(path, kMostSourceBytes);
    if (!bytes) {
        diagnostics.report(Code::RSL_FILE_NOT_READ, Location{}, path);
        return {};
    }
    std::string text = utf8_text(std::move(*bytes));
    ShaderSource source{text, {}};
    source.map.file = diagnostics.files.add(path, text);
    return compile(source, options, diagnostics);
}

}  // namespace kinora::rsl
