// rsl/text/macro_expander.cpp: macro uses, their arguments and replacements.
#include "rsl/text/macro_expander.h"

#include <algorithm>
#include <string>
#include <utility>

#include "rsl/text/lexer.h"
#include "rsl/text/substitution.h"

namespace kinora::rsl {

Token MacroExpander::next() {
    while (true) {
        Token token = input_.next();
        if (budget_.exhausted() || token.kind != TokenKind::Identifier || files_.skipping())
            return token;
        if (in_condition_ && token.text == "defined") return defined_operator(token);
        if (!try_expand(token)) return token;
    }
}

// True when the token was the start of a macro use, whose replacement now comes next. False leaves
// the token to be used, changed when it was a special macro.
bool MacroExpander::try_expand(Token& token) {
    Macro* found = macros_.find(token.text);
    if (!found || token.painted) return false;
    Macro& macro = *found;
    if (macro.expanding) {
        token.painted = true;
        return false;
    }
    if (macro.special) {
        expand_special(token, macro);
        return false;
    }
    Arguments arguments;
    if (macro.function_like) {
        Token open = input_.peek();
        // A '#' line may stand between the name and '(': that is no call.
        if (open.punct != Punct::LeftParen) return false;
        if (macro.standard && names_definition()) {
            macro.undefined = true;
            return false;
        }
        if (nesting_ > kMostMacroNesting) {
            budget_.give_up(token);
            return true;
        }
        if (!read_arguments(token, macro, arguments)) {
            token.kind = TokenKind::Number;  // so that the parser has nothing more to say
            token.text = "0";
            token.lost = true;
            return false;
        }
    }
    out_.macros.push_back({macro.name, macro.definition, token.macro});
    Substitution substitution(macro, arguments, token, uint32_t(out_.macros.size() - 1), texts_,
                              budget_, reporter_);
    TokenList replacement =
        substitution.run([this](const TokenList& argument) { return expand(argument); });
    if (!budget_.spend_tokens(replacement.size() + 1, token)) return true;
    if (!replacement.empty()) {
        replacement.front().space_before = token.space_before;
        replacement.front().line_start = token.line_start;
    }
    input_.push(std::move(replacement), &macro);
    return true;
}

// "NAME(...) {": the source has a function of its own where our header has a macro. Nothing but a
// definition has a brace there: no macro of ours begins a statement.
bool MacroExpander::names_definition() const {
    if (!input_.at_file()) return false;
    Lexer ahead = files_.ahead();
    int depth = 0;
    for (size_t n = 0; n < kMostParameterTokens; ++n) {
        Token token = ahead.next();
        if (token.kind == TokenKind::End) return false;
        depth += token.punct == Punct::LeftParen;
        depth -= token.punct == Punct::RightParen;
        if (depth == 0) return ahead.next().punct == Punct::LeftBrace;
    }
    return false;
}

void MacroExpander::expand_special(Token& token, const Macro& macro) {
    const SourceFiles& files = source_files_;
    bool known = token.where.file != kNoFile;
    if (macro.name == "__LINE__") {
        int line = known ? files.line_column(token.where.file, token.where.begin).line : 0;
        token.text = texts_.keep(std::to_string(line));
        token.kind = TokenKind::Number;
    } else {
        token.text =
            texts_.keep('"' + (known ? files.name(token.where.file) : std::string()) + '"');
        token.kind = TokenKind::String;
    }
}

// Reads "( a , b )". False when it does not end or does not fit: reported, and the use is dropped.
bool MacroExpander::read_arguments(const Token& name, const Macro& macro, Arguments& arguments) {
    input_.next();  // '('
    arguments.emplace_back();
    for (int depth = 0;;) {
        Token token = input_.next();
        bool hash_line = token.punct == Punct::Hash && token.line_start && token.macro == 0;
        if (token.kind == TokenKind::End || budget_.exhausted()) {
            reporter_.report(Code::RSL_MACRO_UNCLOSED, name, name.text);
            out_.truncated = true;  // the rest of the file was taken for arguments
            return false;
        }
        if (hash_line && !input_.isolated()) {
            obey_directive_();  // between arguments: obeyed, as other compilers do
            continue;
        }
        if (files_.skipping()) continue;
        if (depth == 0 && token.punct == Punct::RightParen) break;
        depth += token.punct == Punct::LeftParen;
        depth -= token.punct == Punct::RightParen;
        bool rest = macro.variadic && arguments.size() == macro.parameters.size();
        if (depth == 0 && token.punct == Punct::Comma && !rest)
            arguments.emplace_back();
        else
            arguments.back().push_back(token);
        if (!budget_.spend_tokens(1, name)) return false;
    }
    return fit_arguments(name, macro, arguments);
}

bool MacroExpander::fit_arguments(const Token& name, const Macro& macro, Arguments& arguments) {
    size_t wanted = macro.parameters.size();
    if (wanted == 0 && arguments.size() == 1 && arguments[0].empty()) arguments.clear();
    if (macro.variadic && arguments.size() + 1 == wanted) arguments.emplace_back();
    if (arguments.size() == wanted) return true;
    Finding& finding =
        reporter_.report(Code::RSL_MACRO_ARGUMENTS, name, name.text, wanted, arguments.size());
    finding.notes.push_back({macro.definition, "defined here"});
    return false;
}

TokenList MacroExpander::expand(const TokenList& tokens) {
    TokenInput::Isolation isolation(input_, tokens);
    ++nesting_;
    TokenList expanded;
    for (Token t = next(); t.kind != TokenKind::End && !budget_.exhausted(); t = next())
        expanded.push_back(t);
    --nesting_;
    return expanded;
}

TokenList MacroExpander::expand_condition(const TokenList& tokens) {
    in_condition_ = true;
    TokenList expanded = expand(tokens);
    in_condition_ = false;
    return expanded;
}

// "defined NAME" or "defined(NAME)", of the line or of a macro that it names, as other
// preprocessors take it (C11 6.10.1 leaves the latter open).
Token MacroExpander::defined_operator(Token token) {
    bool open = input_.peek().punct == Punct::LeftParen;
    if (open) input_.next();
    Token name = input_.peek();
    bool named = name.kind == TokenKind::Identifier;
    if (named)
        input_.next();
    else
        reporter_.report(Code::RSL_BAD_DIRECTIVE, token, "if defined", "a macro name");
    token.lost = !named;
    if (open && input_.peek().punct == Punct::RightParen) input_.next();
    token.kind = TokenKind::Number;
    token.text = named && macros_.is_defined(name.text) ? "1" : "0";
    return token;
}

}  // namespace kinora::rsl
