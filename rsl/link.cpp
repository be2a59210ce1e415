// rsl/link.cpp: a shader and its co-shaders as one, its parts, and the text of each.
#include "rsl/link.h"

#include <algorithm>

#include "rsl/compile_p.h"
#include "rsl/objects/handle_sets.h"
#include "rsl/objects/open_arrays.h"
#include "rsl/syntax/parser.h"
#include "rsl/text/preprocess.h"
#include "rsl/text/reporter.h"

namespace kinora::rsl {

namespace {

// Calls f(token, next) for the tokens of the text that the shader stands in.
template <class F>
bool any_token(const Shader& shader, F&& f) {
    const auto& tokens = shader.ast->tokens.tokens;
    for (size_t k = 0; k + 1 < tokens.size() && tokens[k].kind != TokenKind::End; ++k)
        if (f(k)) return true;
    return false;
}

bool is_text_parameter(const Shader& shader, std::string_view name) {
    return std::ranges::any_of(shader.parameters, [&](const ShaderParameter& p) {
        return p.name == name && p.type == Type{BaseType::String, -1};
    });
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

namespace {

std::unique_ptr<Shader> link_as(ClassForm form, const std::vector<LinkedSource>& sources,
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
        units.push_back({one.handle, shader, ast->functions, first, one.texts, one.counts, {}, {}});
        std::vector<std::string> handles;
        for (const Symbol* parameter : shader->parameters)
            if (parameter->handle && one.texts.contains(parameter->name))
                handles.emplace_back(parameter->name);
        parts.push_back({one.handle, std::string(shader->name), one.texts, std::move(handles),
                         kept_text(parts, one.source.text), one.source.map, first, one.counts});
    }
    if (units.size() > kMostUnits) {
        reporter.report(Code::RSL_TOO_MANY_CO_SHADERS, ast->tokens.tokens[0], units.size() - 1,
                        kMostUnits - 1);
        return nullptr;
    }
    ast->shaders = {units[0].shader};
    ast->functions = units[0].functions;
    auto linked = finish_compiling(ast, reporter, options, ParseRecovery(), std::move(units), form);
    if (linked.empty()) return nullptr;
    linked[0]->parts = std::move(parts);
    return std::move(linked[0]);
}

}  // namespace

std::unique_ptr<Shader> compile_linked(const std::vector<LinkedSource>& sources,
                                       const CompileOptions& options, Diagnostics& diagnostics) {
    auto linked = link_as(ClassForm::Whole, sources, options, diagnostics);
    if (!linked || !linked->definition->displaces) return linked;
    Diagnostics unheard;  // all has been said
    unheard.files = diagnostics.files;
    linked->displacement = link_as(ClassForm::OnlyDisplacement, sources, options, unheard);
    return linked;
}

bool other_lengths(const Shader& shader, const LinkCounts& counts) {
    return std::ranges::any_of(shader.definition->open_arrays, [&](const Symbol* parameter) {
        auto bound = counts.find(parameter->name);
        if (bound == counts.end()) return false;
        std::optional<int> length = open_length(*parameter, bound->second);
        return length && *length != parameter->type.array_length;
    });
}

bool knows_co_shaders(const Shader& shader) {
    const auto& tokens = shader.ast->tokens.tokens;
    return any_token(shader, [&](size_t k) {
        return tokens[k].text == "getshader" || tokens[k].text == "getshaders" ||
               tokens[k].text == "shader";
    });
}

bool may_mean(const Shader& shader, std::string_view handle) {
    const auto& tokens = shader.ast->tokens.tokens;
    return any_token(shader, [&](size_t k) {
        if (tokens[k].text == "getshaders") return true;
        if (tokens[k].kind == TokenKind::String) {
            std::string_view text = tokens[k].text;
            return text.size() == handle.size() + 2 && text.substr(1, handle.size()) == handle;
        }
        if (tokens[k].text != "getshader" || k + 3 >= tokens.size()) return false;
        bool one_word = tokens[k + 3].punct == Punct::RightParen;
        const Token& word = tokens[k + 2];
        return !one_word ||
               (word.kind != TokenKind::String && !is_text_parameter(shader, word.text));
    });
}

std::vector<LinkedSource> sources_of(const std::vector<LinkedPart>& parts) {
    std::vector<LinkedSource> sources;
    for (const LinkedPart& part : parts)
        sources.push_back(
            {part.handle, {*part.text, part.map}, part.shader, part.texts, part.counts});
    return sources;
}

std::unique_ptr<Shader> link_again(const Shader& linked, const ShaderSource& edited,
                                   const CompileOptions& options, Diagnostics& diagnostics) {
    Diagnostics unheard;
    unheard.files = diagnostics.files;
    std::shared_ptr<Ast> tree = parse(edited, options, unheard);
    auto stands_in_it = [&](const LinkedPart& part) {
        return !tree || std::ranges::any_of(tree->shaders, [&](const ShaderDefinition* s) {
            return s->name == part.shader;
        });
    };
    std::vector<LinkedSource> sources = sources_of(linked.parts);
    for (size_t k = 0; k < sources.size(); ++k)
        if (linked.parts[k].text == linked.parts[0].text && stands_in_it(linked.parts[k]))
            sources[k].source = edited;
    sources[0].source = edited;
    return compile_linked(sources, options, diagnostics);
}

std::vector<size_t> parts_to_keep(const Shader& linked) {
    std::vector<size_t> kept;
    for (size_t k = 0; k < linked.parts.size(); ++k) {
        const LinkedPart& part = linked.parts[k];
        bool used = std::ranges::find(linked.definition->co_shaders, part.handle) !=
                    linked.definition->co_shaders.end();
        if (used || part.text == linked.parts[0].text) kept.push_back(k);
    }
    return kept;
}

const Symbol* find_handle_parameter(const Shader& shader, std::string_view name) {
    for (const Symbol* symbol : shader.definition->handles)
        if (symbol->name == name) return symbol;
    return nullptr;
}

std::vector<std::string> handles_in(const std::vector<std::string>& texts) {
    constexpr std::string_view kSpace = " \t\r\n";
    std::vector<std::string> handles;
    for (std::string_view rest : texts)
        while (!rest.empty()) {
            std::string_view word = rest.substr(0, rest.find(','));
            rest.remove_prefix(std::min(word.size() + 1, rest.size()));
            size_t begin = word.find_first_not_of(kSpace);
            if (begin == word.npos) continue;
            word = word.substr(begin, word.find_last_not_of(kSpace) + 1 - begin);
            if (word != "null") handles.emplace_back(word);
        }
    return handles;
}

std::string portable_text(const Shader& shader, size_t part) {
    bool has_objects = !shader.parts.empty() || knows_co_shaders(shader) ||
                       !shader.ast->structs.empty() ||
                       std::ranges::any_of(shader.ast->shaders, [](const ShaderDefinition* s) {
                           return s->shader_class || s->co_shader;
                       });
    if (!has_objects) return print_ast(*shader.ast);
    return print_preprocessed(shader.ast->tokens,
                              shader.parts.empty() ? 0 : shader.parts[part].first_token);
}

}  // namespace kinora::rsl
