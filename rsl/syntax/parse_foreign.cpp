// rsl/syntax/parse_foreign.cpp: words of other languages, and slips of the hand.
#include "rsl/syntax/parse_foreign.h"

#include "rsl/text/did_you_mean.h"
#include "rsl/text/lexer.h"

namespace kinora::rsl {

namespace {

// Types of other languages and what they are taken as after the error; qualifiers as Invalid.
constexpr struct {
    std::string_view word;
    BaseType base;
    const char* help;
} kForeignTypes[] = {
    {"int", BaseType::Float, "write 'float'"},
    {"double", BaseType::Float, "write 'float'"},
    {"bool", BaseType::Float, "write 'float'"},
    {"boolean", BaseType::Float, "write 'float'"},
    {"half", BaseType::Float, "write 'float'"},
    {"long", BaseType::Float, "write 'float'"},
    {"unsigned", BaseType::Float, "write 'float'"},
    {"scalar", BaseType::Float, "write 'float'"},
    {"float2", BaseType::Point, "write 'point'"},
    {"vec2", BaseType::Point, "write 'point'"},
    {"float3", BaseType::Vector, "write 'vector'"},
    {"vec3", BaseType::Vector, "write 'vector'"},
    {"float4", BaseType::Color, "write 'color'"},
    {"vec4", BaseType::Color, "write 'color'"},
    {"colour", BaseType::Color, "write 'color'"},
    {"mat4", BaseType::Matrix, "write 'matrix'"},
    {"char", BaseType::String, "write 'string'"},
    {"sampler2D", BaseType::String, "write 'string'"},
    {"const", BaseType::Invalid, "write 'uniform'"},
    {"static", BaseType::Invalid, "leave it out"},
    {"inline", BaseType::Invalid, "leave it out"},
};

std::string_view nearest_type(std::string_view word) {
    std::vector<std::string_view> types;
    for (int k = 0; k < int(BaseType::Void); ++k) types.push_back(type_name(BaseType(k)));
    return nearest_name(word, types);
}

// What to write instead of a type of another language; "" for other words.
const char* foreign_type_help(std::string_view word) {
    for (const auto& row : kForeignTypes)
        if (row.word == word) return row.help;
    return "";
}

BaseType foreign_type_base(std::string_view word) {
    for (const auto& row : kForeignTypes)
        if (row.word == word) return row.base;
    return BaseType::Invalid;
}

}  // namespace

bool ForeignSyntax::at_type(int ahead) const {
    const Token& at = cursor_.token(ahead);
    if (at.kind != TokenKind::Identifier || at.word != Word::None) return false;
    bool known = *foreign_type_help(at.text) != '\0';
    bool qualifier = known && (cursor_.is_type(ahead + 1) || cursor_.is_detail(ahead + 1));
    if (cursor_.token(ahead + 1).kind != TokenKind::Identifier ||
        (!qualifier && cursor_.is_reserved(ahead + 1)))
        return false;
    return known || !nearest_type(at.text).empty();
}

bool ForeignSyntax::accept_type(BaseType& base) {
    if (!at_type()) return false;
    const Token& at = cursor_.token();
    const char* help = foreign_type_help(at.text);
    std::string_view near = nearest_type(at.text);
    errors_.report(Code::RSL_UNKNOWN_TYPE, at, at.text).help =
        *help ? help : fmt::format("did you mean '{}'?", near);
    base = *help ? foreign_type_base(at.text) : type_from_name(near);
    cursor_.advance();
    while (*foreign_type_help(cursor_.token().text) &&
           cursor_.token(1).kind == TokenKind::Identifier) {
        base = foreign_type_base(cursor_.token().text);  // "unsigned int"
        cursor_.advance();
    }
    return true;
}

bool ForeignSyntax::accept_cast() {
    const Token& type = cursor_.token(1);
    bool operand =
        cursor_.token(3).kind != TokenKind::Punctuator || cursor_.is(Punct::LeftParen, 3);
    if (!operand || foreign_type_base(type.text) == BaseType::Invalid) return false;
    bool whole = type.text == "int" || type.text == "long" || type.text == "unsigned";
    errors_.report(Code::RSL_UNKNOWN_TYPE, type, type.text).help =
        whole ? "use floor(x)" : foreign_type_help(type.text);
    cursor_.move_to(cursor_.position() + 3);
    return true;
}

bool ForeignSyntax::accept_idle_word() {
    const Token& at = cursor_.token();
    bool idle = at.text == "inline" || at.text == "static" || at.text == "export";
    if (!idle || cursor_.token(1).kind != TokenKind::Identifier) return false;
    errors_.report(Code::RSL_WORD_LEFT_OUT, at, at.text);
    cursor_.advance();
    return true;
}

bool ForeignSyntax::missing_statement() {
    const Token& at = cursor_.token();
    bool is_do = at.text == "do" && cursor_.is(Punct::LeftBrace, 1);
    bool is_switch =
        at.text == "switch" && cursor_.is(Punct::LeftParen, 1) &&
        cursor_.at(cursor_.after_parens(cursor_.position() + 1)).punct == Punct::LeftBrace;
    bool is_goto = at.text == "goto" && cursor_.token(1).kind == TokenKind::Identifier;
    if (!is_do && !is_switch && !is_goto) return false;
    Finding* finding = errors_.error(Code::RSL_NOT_RSL, at, fmt::format("'{}'", at.text));
    if (finding && !is_goto)
        finding->help = is_do ? "write 'while (...) { ... }'" : "write 'if ... else if ...'";
    return true;
}

std::string_view ForeignSyntax::resembled_word() const {
    constexpr Word kWords[] = {Word::If,    Word::Else,   Word::While,       Word::For,
                               Word::Break, Word::Return, Word::Illuminance, Word::Illuminate,
                               Word::Solar, Word::Gather};
    if (cursor_.token().kind != TokenKind::Identifier || cursor_.token().word != Word::None)
        return {};
    std::vector<std::string_view> words;
    for (Word word : kWords) words.push_back(word_text(word));
    return nearest_name(cursor_.token().text, words);
}

bool ForeignSyntax::misspelt_statement() {
    if (!cursor_.is(Punct::LeftParen, 1) || cursor_.is_type(2) || cursor_.is_detail(2) ||
        cursor_.is(Punct::RightParen, 2))
        return false;
    const Token& behind = cursor_.at(cursor_.after_parens(cursor_.position() + 1));
    if (behind.punct != Punct::LeftBrace && behind.kind != TokenKind::Identifier) return false;
    std::string_view word = resembled_word();
    if (word.empty() || find_word(word) == Word::Else) return false;
    const Token& at = cursor_.token();
    errors_.report(Code::RSL_SYNTAX, at, "a statement", fmt::format("'{}'", at.text)).help =
        fmt::format("did you mean '{}'?", word);
    cursor_.take_as(find_word(word));
    return true;
}

Punct ForeignSyntax::word_operator() const {
    bool operand = cursor_.token(1).kind == TokenKind::Identifier ||
                   cursor_.token(1).kind == TokenKind::Number ||
                   cursor_.token(1).kind == TokenKind::String || cursor_.is(Punct::LeftParen, 1) ||
                   cursor_.is(Punct::Not, 1) || cursor_.is(Punct::Subtract, 1);
    if (cursor_.token().kind != TokenKind::Identifier || !operand) return Punct::None;
    return cursor_.token().text == "and"  ? Punct::And
           : cursor_.token().text == "or" ? Punct::Or
                                          : Punct::None;
}

bool ForeignSyntax::at_not() {
    bool operand = cursor_.token(1).kind == TokenKind::Identifier ||
                   cursor_.token(1).kind == TokenKind::Number;
    bool word = cursor_.token(1).text == "and" || cursor_.token(1).text == "or";
    if (cursor_.token().kind != TokenKind::Identifier || cursor_.token().text != "not" ||
        !operand || word)
        return false;
    errors_.report(Code::RSL_NOT_RSL, cursor_.token(), "'not'").help = "write '!'";
    return true;
}

void ForeignSyntax::accept_then() {
    bool then = cursor_.token().text == "then" &&
                (cursor_.token(1).kind == TokenKind::Identifier || cursor_.is(Punct::LeftBrace, 1));
    if (!then) return;
    errors_.report(Code::RSL_NOT_RSL, cursor_.token(), "'then'").help = "leave it out";
    cursor_.advance();
}

bool ForeignSyntax::at_else_if() {
    const Token& at = cursor_.token();
    bool word = at.text == "elseif" || at.text == "elsif" || at.text == "elif";
    if (!word || !cursor_.is(Punct::LeftParen, 1)) return false;
    errors_.report(Code::RSL_NOT_RSL, at, fmt::format("'{}'", at.text)).help = "write 'else if'";
    return true;
}

}  // namespace kinora::rsl
