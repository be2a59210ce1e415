// rsl/text/preprocess_macros.cpp: macro expansion. Replacements are pushed before the rest of the
// input and read again; a macro is off while its own replacement is read, so expansion always ends.
#include <algorithm>
#include <string>
#include <utility>

#include "rsl/text/preprocess.h"

namespace kinora::rsl {

bool Preprocessor::spend(size_t tokens, const Token& at) {
    spent_ += tokens;
    if (spent_ <= kMostTokens) return true;
    give_up(at);
    return false;
}

void Preprocessor::give_up(const Token& at) {
    if (!exhausted_) reporter_.report(Code::RSL_MACRO_TOO_LARGE, at);
    exhausted_ = out_.truncated = true;
}

void Preprocessor::push(TokenList tokens, Macro* macro) {
    if (macro) macro->expanding = true;
    pending_.push_back({std::move(tokens), 0, macro});
}

Token Preprocessor::next_unexpanded() {
    while (pending_.size() > floor_) {
        Pending& top = pending_.back();
        if (top.next < top.tokens.size()) return top.tokens[top.next++];
        if (top.macro) top.macro->expanding = false;
        pending_.pop_back();
    }
    return isolated_ ? Token{} : raw_next();
}

// What next_unexpanded() would give, without reading past the end of a macro for good.
Token Preprocessor::peek_unexpanded() {
    for (size_t i = pending_.size(); i > floor_; --i) {
        const Pending& p = pending_[i - 1];
        if (p.next < p.tokens.size()) return p.tokens[p.next];
    }
    return isolated_ ? Token{} : peek_raw();
}

Token Preprocessor::next_expanded() {
    while (true) {
        Token token = next_unexpanded();
        if (exhausted_ || token.kind != TokenKind::Identifier || skipping()) return token;
        if (in_condition_ && token.text == "defined") return defined_operator(token);
        if (!try_expand(token)) return token;
    }
}

// True when the token was the start of a macro use, whose replacement now comes next. False leaves
// the token to be used, changed when it was a special macro.
bool Preprocessor::try_expand(Token& token) {
    auto found = macros_.find(token.text);
    if (found == macros_.end() || found->second.undefined || token.painted) return false;
    Macro& macro = found->second;
    if (macro.expanding) {
        token.painted = true;
        return false;
    }
    if (macro.special) return expand_special(token, macro);
    std::vector<TokenList> arguments;
    if (macro.function_like) {
        Token open = peek_unexpanded();
        // A '#' line may stand between the name and '(': that is no call.
        if (open.punct != Punct::LeftParen) return false;
        if (macro.standard && names_definition()) {
            macro.undefined = true;
            return false;
        }
        if (nesting_ > kMostMacroNesting) {
            give_up(token);
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
    TokenList replacement = substitute(macro, arguments, uint32_t(out_.macros.size() - 1), token);
    if (!spend(replacement.size() + 1, token)) return true;
    if (!replacement.empty()) {
        replacement.front().space_before = token.space_before;
        replacement.front().line_start = token.line_start;
    }
    push(std::move(replacement), &macro);
    return true;
}

// "NAME(...) {": the source has a function of its own where our header has a macro. Nothing but a
// definition has a brace there: no macro of ours begins a statement.
bool Preprocessor::names_definition() const {
    if (isolated_ || pending_.size() > floor_) return false;
    Lexer ahead = files_.back().lexer;
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

bool Preprocessor::expand_special(Token& token, const Macro& macro) {
    const SourceFiles& files = diagnostics_.files;
    bool known = token.where.file != kNoFile;
    if (macro.name == "__LINE__") {
        int line = known ? files.line_column(token.where.file, token.where.begin).line : 0;
        token.text = keep(std::to_string(line));
        token.kind = TokenKind::Number;
    } else {
        token.text = keep('"' + (known ? files.name(token.where.file) : std::string()) + '"');
        token.kind = TokenKind::String;
    }
    return false;
}

// Reads "( a , b )". False when it does not end or does not fit: reported, and the use is dropped.
bool Preprocessor::read_arguments(const Token& name, const Macro& macro,
                                  std::vector<TokenList>& arguments) {
    next_unexpanded();  // '('
    arguments.emplace_back();
    for (int depth = 0;;) {
        Token token = next_unexpanded();
        bool hash_line = token.punct == Punct::Hash && token.line_start && token.macro == 0;
        if (token.kind == TokenKind::End || exhausted_) {
            reporter_.report(Code::RSL_MACRO_UNCLOSED, name, name.text);
            out_.truncated = true;  // the rest of the file was taken for arguments
            return false;
        }
        if (hash_line && !isolated_) {
            directive();  // between arguments: obeyed, as other compilers do
            continue;
        }
        if (skipping()) continue;
        if (depth == 0 && token.punct == Punct::RightParen) break;
        depth += token.punct == Punct::LeftParen;
        depth -= token.punct == Punct::RightParen;
        bool rest = macro.variadic && arguments.size() == macro.parameters.size();
        if (depth == 0 && token.punct == Punct::Comma && !rest)
            arguments.emplace_back();
        else
            arguments.back().push_back(token);
        if (!spend(1, name)) return false;
    }
    return fit_arguments(name, macro, arguments);
}

bool Preprocessor::fit_arguments(const Token& name, const Macro& macro,
                                 std::vector<TokenList>& arguments) {
    size_t wanted = macro.parameters.size();
    if (wanted == 0 && arguments.size() == 1 && arguments[0].empty()) arguments.clear();
    if (macro.variadic && arguments.size() + 1 == wanted) arguments.emplace_back();
    if (arguments.size() == wanted) return true;
    Finding& finding =
        reporter_.report(Code::RSL_MACRO_ARGUMENTS, name, name.text, wanted, arguments.size());
    finding.notes.push_back({macro.definition, "defined here"});
    return false;
}

Preprocessor::TokenList Preprocessor::expand_list(const TokenList& tokens) {
    size_t floor = std::exchange(floor_, pending_.size());
    bool isolated = std::exchange(isolated_, true);
    ++nesting_;
    push(tokens, nullptr);
    TokenList expanded;
    for (Token t = next_expanded(); t.kind != TokenKind::End && !exhausted_; t = next_expanded())
        expanded.push_back(t);
    while (pending_.size() > floor_) {
        if (pending_.back().macro) pending_.back().macro->expanding = false;
        pending_.pop_back();
    }
    --nesting_;
    isolated_ = isolated;
    floor_ = floor;
    return expanded;
}

Token Preprocessor::stringise(const TokenList& tokens, const Token& at) {
    std::string text = "\"";
    for (size_t i = 0; i < tokens.size(); ++i) {
        if (i > 0 && (tokens[i].space_before || tokens[i].line_start)) text += ' ';
        bool quoted = tokens[i].kind == TokenKind::String || is_character_constant(tokens[i]);
        for (char c : tokens[i].text) {
            if (quoted && (c == '"' || c == '\\')) text += '\\';
            text += c;
        }
    }
    Token token = at;
    token.kind = TokenKind::String;
    token.punct = Punct::None;
    token.text = keep(text + '"');
    return token;
}

// Nothing when the two do not make one token.
std::optional<Token> Preprocessor::paste(const Token& left, const Token& right, const Token& at) {
    if (left.text.empty() || right.text.empty()) return left.text.empty() ? right : left;
    std::string_view text = keep(std::string(left.text) + std::string(right.text));
    SourceMap nowhere;
    Lexer lexer(text, nowhere);
    Token token = lexer.next();
    if (token.text.size() != text.size()) return std::nullopt;
    token.where = at.where;
    token.spelling = left.spelling;
    token.macro = at.macro;
    token.space_before = left.space_before;
    token.line_start = false;
    return token;
}

namespace {

// Which parameter of the macro the token names, or -1.
int parameter_index(const Macro& macro, const Token& token) {
    if (token.kind != TokenKind::Identifier) return -1;
    auto found = std::find(macro.parameters.begin(), macro.parameters.end(), token.text);
    return found == macro.parameters.end() ? -1 : int(found - macro.parameters.begin());
}

// A token of an argument as it stands in the replacement, where `parameter` names the argument.
Token in_place(Token token, bool first, const Token& parameter, uint32_t use) {
    if (token.macro == 0) token.macro = use;
    if (first) token.space_before = parameter.space_before;
    token.line_start = false;
    return token;
}

}  // namespace

// The replacement with parameters replaced, # and ## done. Tokens of the replacement stand where
// the macro is used; tokens of arguments stay where they are.
Preprocessor::TokenList Preprocessor::substitute(const Macro& macro,
                                                 const std::vector<TokenList>& arguments,
                                                 uint32_t use, const Token& name) {
    TokenList out;
    std::vector<TokenList> expanded(arguments.size());
    std::vector<bool> have(arguments.size(), false);
    Token at = name;
    at.macro = use;
    bool pasting = false;
    auto add = [&](Token token) {
        if (std::exchange(pasting, false) && !out.empty()) {
            at.spelling = token.spelling;
            if (std::optional<Token> one = paste(out.back(), token, at)) {
                out.back() = *one;
                return;
            }
            reporter_.report(Code::RSL_BAD_PASTE, at, out.back().text, token.text);
        }
        out.push_back(token);
    };
    const TokenList& body = macro.replacement;
    for (size_t i = 0; i < body.size() && !exhausted_; ++i) {
        Token token = body[i];
        token.where = name.where;
        token.macro = use;
        at.spelling = token.spelling;
        if (token.punct == Punct::Paste && i > 0 && i + 1 < body.size()) {
            pasting = true;
            continue;
        }
        int next = i + 1 < body.size() ? parameter_index(macro, body[i + 1]) : -1;
        if (token.punct == Punct::Hash && macro.function_like && next >= 0) {
            add(stringise(arguments[size_t(next)], at));
            ++i;
            continue;
        }
        int index = parameter_index(macro, token);
        if (index < 0) {
            add(token);
            continue;
        }
        size_t k = size_t(index);
        bool raw = pasting || (i + 1 < body.size() && body[i + 1].punct == Punct::Paste);
        if (!raw && !have[k]) {
            expanded[k] = expand_list(arguments[k]);
            have[k] = true;
        }
        const TokenList& list = raw ? arguments[k] : expanded[k];
        // ", ## __VA_ARGS__" of GNU C: without arguments there is no comma either.
        bool rest = pasting && macro.variadic && k + 1 == macro.parameters.size() && !out.empty() &&
                    out.back().punct == Punct::Comma;
        if (rest) pasting = false;
        if (rest && list.empty()) {
            out.pop_back();
            continue;
        }
        if (!spend(list.size(), name)) break;
        for (size_t t = 0; t < list.size(); ++t) add(in_place(list[t], t == 0, token, use));
        if (list.empty() && raw) add(Token{});  // holds the place of an empty argument
    }
    std::erase_if(out, [](const Token& t) { return t.text.empty(); });
    return out;
}

}  // namespace kinora::rsl
