// rsl/link.cpp: what is known of a linked shader: its parts, and the text of each.
#include "rsl/link.h"

#include <algorithm>

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

}  // namespace

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
        sources.push_back({part.handle, {*part.text, part.map}, part.shader, part.texts});
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
