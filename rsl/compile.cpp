// rsl/compile.cpp: the stages of the front end in order.
#include "rsl/compile.h"

#include <algorithm>

#include "rsl/check/check.h"
#include "rsl/check/usage.h"
#include "rsl/compile_p.h"
#include "rsl/objects/integrators.h"
#include "rsl/objects/light_samples.h"
#include "rsl/objects/objects.h"
#include "rsl/objects/sample_pairs.h"
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

std::vector<NamedOutput> named_outputs(const ShaderDefinition& definition) {
    std::vector<NamedOutput> outputs;
    for (const NamedWrite& write : definition.named_writes)
        if (write.call->function)
            outputs.push_back(
                {write.call->function->parameters[1]->type.base, std::string(write.pattern)});
    return outputs;
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
        if (reporter.errors() == 0) shader->named_outputs = named_outputs(*definition);
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

bool can_displace(const ShaderDefinition& shader) {
    return shader.shader_class &&
           std::any_of(shader.shader_class->methods.begin(), shader.shader_class->methods.end(),
                       [](const Function* method) { return method->name == "displacement"; });
}

std::vector<std::unique_ptr<Shader>> compile_as(ClassForm form, const ShaderSource& source,
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
    return finish_compiling(ast, reporter, options, parser.recovery(), {}, form);
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

std::vector<std::unique_ptr<Shader>> finish_compiling(const std::shared_ptr<Ast>& ast,
                                                      Reporter& reporter,
                                                      const CompileOptions& options,
                                                      const ParseRecovery& recovery,
                                                      std::vector<Unit> units, ClassForm form) {
    if (form == ClassForm::OnlyDisplacement)
        for (ShaderDefinition* shader : ast->shaders)
            shader->only_displaces = can_displace(*shader);
    bind_integrators(*ast, reporter, units);
    bind_light_samples(*ast, units);
    bind_sample_pairs(*ast, reporter, units);
    if (!expand_objects(*ast, reporter, std::move(units), options.counts)) return {};
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

std::vector<std::unique_ptr<Shader>> compile(const ShaderSource& source,
                                             const CompileOptions& options,
                                             Diagnostics& diagnostics) {
    auto shaders = compile_as(ClassForm::Whole, source, options, diagnostics);
    if (std::none_of(shaders.begin(), shaders.end(),
                     [](const auto& shader) { return shader->definition->displaces; }))
        return shaders;
    Diagnostics unheard;  // all has been said
    unheard.files = diagnostics.files;
    auto displacements = compile_as(ClassForm::OnlyDisplacement, source, options, unheard);
    for (auto& shader : shaders)
        for (auto& displacement : displacements)
            if (displacement && shader->definition->displaces && shader->name == displacement->name)
                shader->displacement = std::move(displacement);
    return shaders;
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
