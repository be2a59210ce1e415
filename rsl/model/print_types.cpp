// rsl/model/print_types.cpp: tokens and checked trees for --dump.
#include "rsl/model/builtin.h"
#include "rsl/model/shader.h"
#include "rsl/syntax/print.h"
#include "rsl/text/lexer.h"

namespace kinora::rsl {

std::string print_tokens(const TokenStream& tokens, const SourceFiles& files) {
    constexpr const char* kKinds[] = {"end", "name", "number", "string", "punctuator", "other"};
    std::string text;
    for (const Token& t : tokens.tokens) {
        if (t.where.file != kNoFile) {
            LineColumn at = files.line_column(t.where.file, t.where.begin);
            text += fmt::format("{}:{}:{}: ", files.name(t.where.file), at.line, at.column);
        }
        text += fmt::format("{} {}", kKinds[int(t.kind)], t.text);
        if (t.macro) text += fmt::format("  (macro {})", tokens.macros[t.macro].name);
        text += '\n';
    }
    return text;
}

std::string print_preprocessed(const TokenStream& tokens, uint32_t first) {
    std::string text;
    for (const PragmaToken& pragma : tokens.pragmas)
        if (first == 0) text += fmt::format("#pragma {}\n", pragma.text);
    for (const Token& t : std::span(tokens.tokens).subspan(first)) {
        if (t.kind == TokenKind::End) break;
        if (t.line_start && !text.empty())
            text += '\n';
        else if (!text.empty() && (t.space_before || t.macro))
            text += ' ';
        text += t.text;
    }
    return text + '\n';
}

std::string print_ast(const Ast& ast) {
    return print_tree(ast);
}

namespace {

// Types of leaves are clear from the declarations; the rest is written as text{type rate}.
std::string note_type(const Expr& e, std::string text) {
    if (e.kind == ExprKind::Number || e.kind == ExprKind::String) return text;
    std::string overload;
    if (const auto* call = as_if<CallExpr>(&e); call && call->builtin)
        overload = fmt::format(" {}#{}", call->builtin->name, call->signature->overload);
    return fmt::format("{}{{{} {}{}}}", text, type_name(e.type), rate_name(e.rate), overload);
}

std::string note_symbol(const Symbol& s) {
    return fmt::format("{{{}{}}}", s.varying ? "varying" : "uniform",
                       s.assigned ? " assigned" : "");
}

}  // namespace

std::string print_types(const Ast& ast) {
    return print_tree(ast, note_type, note_symbol);
}

}  // namespace kinora::rsl
