// rsl/text/substitution.cpp: parameters, # and ## of macros.
#include "rsl/text/substitution.h"

#include <algorithm>
#include <string>
#include <utility>

#include "rsl/text/lexer.h"

namespace kinora::rsl {

namespace {

// Which parameter of the macro the token names, or -1.
int parameter_index(const Macro& macro, const Token& token) {
    if (token.kind != TokenKind::Identifier) return -1;
    auto found = std::find(macro.parameters.begin(), macro.parameters.end(), token.text);
    return found == macro.parameters.end() ? -1 : int(found - macro.parameters.begin());
}

}  // namespace

Substitution::Substitution(const Macro& macro, const std::vector<TokenList>& arguments,
                           const Token& name, uint32_t use, TextStore& texts, Budget& budget,
                           Reporter& reporter)
    : macro_(macro),
      arguments_(arguments),
      name_(name),
      texts_(texts),
      budget_(budget),
      reporter_(reporter),
      expanded_(arguments.size()),
      at_(name) {
    at_.macro = use;
}

TokenList Substitution::run(const std::function<TokenList(const TokenList&)>& expand) {
    const TokenList& body = macro_.replacement;
    for (size_t i = 0; i < body.size() && !budget_.exhausted(); ++i) {
        Token token = body[i];
        token.where = at_.where;
        token.macro = at_.macro;
        at_.spelling = token.spelling;
        bool last = i + 1 == body.size();
        if (token.punct == Punct::Paste && i > 0 && !last) {
            pasting_ = true;
            continue;
        }
        int next = last ? -1 : parameter_index(macro_, body[i + 1]);
        if (token.punct == Punct::Hash && macro_.function_like && next >= 0) {
            add(stringise(arguments_[size_t(next)]));
            ++i;
            continue;
        }
        int index = parameter_index(macro_, token);
        if (index < 0) {
            add(token);
            continue;
        }
        size_t k = size_t(index);
        bool raw = pasting_ || (!last && body[i + 1].punct == Punct::Paste);
        if (!raw && !expanded_[k]) expanded_[k] = expand(arguments_[k]);
        if (!add_argument(token, k, raw ? arguments_[k] : *expanded_[k], raw)) break;
    }
    std::erase_if(out_, [](const Token& t) { return t.text.empty(); });
    return std::move(out_);
}

void Substitution::add(Token token) {
    if (std::exchange(pasting_, false) && !out_.empty()) {
        at_.spelling = token.spelling;
        if (std::optional<Token> one = paste(out_.back(), token)) {
            out_.back() = *one;
            return;
        }
        reporter_.report(Code::RSL_BAD_PASTE, at_, out_.back().text, token.text);
    }
    out_.push_back(token);
}

// The argument `index`, where `parameter` names it; `raw` beside a ##. False when it is too much.
bool Substitution::add_argument(const Token& parameter, size_t index, const TokenList& list,
                                bool raw) {
    // ", ## __VA_ARGS__" of GNU C: without arguments there is no comma either.
    bool rest = pasting_ && macro_.variadic && index + 1 == macro_.parameters.size() &&
                !out_.empty() && out_.back().punct == Punct::Comma;
    if (rest) pasting_ = false;
    if (rest && list.empty()) {
        out_.pop_back();
        return true;
    }
    if (!budget_.spend_tokens(list.size(), name_)) return false;
    for (size_t t = 0; t < list.size(); ++t) {
        Token token = list[t];
        if (token.macro == 0) token.macro = parameter.macro;
        if (t == 0) token.space_before = parameter.space_before;
        token.line_start = false;
        add(token);
    }
    if (list.empty() && raw) add(Token{});  // stands for an empty argument
    return true;
}

Token Substitution::stringise(const TokenList& tokens) const {
    std::string text = "\"";
    for (size_t i = 0; i < tokens.size(); ++i) {
        if (i > 0 && (tokens[i].space_before || tokens[i].line_start)) text += ' ';
        bool quoted = tokens[i].kind == TokenKind::String || is_character_constant(tokens[i]);
        for (char c : tokens[i].text) {
            if (quoted && (c == '"' || c == '\\')) text += '\\';
            text += c;
        }
    }
    Token token = at_;
    token.kind = TokenKind::String;
    token.punct = Punct::None;
    token.text = texts_.keep(text + '"');
    return token;
}

// Nothing when the two do not make one token.
std::optional<Token> Substitution::paste(const Token& left, const Token& right) const {
    if (left.text.empty() || right.text.empty()) return left.text.empty() ? right : left;
    std::string_view text = texts_.keep(std::string(left.text) + std::string(right.text));
    SourceMap nowhere;
    Lexer lexer(text, nowhere);
    Token token = lexer.next();
    if (token.text.size() != text.size()) return std::nullopt;
    token.where = at_.where;
    token.spelling = left.spelling;
    token.macro = at_.macro;
    token.space_before = left.space_before;
    token.line_start = false;
    return token;
}

}  // namespace kinora::rsl
