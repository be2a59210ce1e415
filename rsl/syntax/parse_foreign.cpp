// rsl/syntax/parse_foreign.cpp: what belongs to other languages or is misspelt: reported by what is
// meant, and parsed as that where it can be, so that nothing else is said of it.
#include <algorithm>

#include "rsl/syntax/parser.h"
#include "rsl/text/lexer.h"

namespace kinora::rsl {

// RSL 2.0 is another language: it is named once, and nothing more is said of the source.
bool Parser::newer_language(const Token& at, const char* feature) {
    if (stopped_) return true;
    error(Code::RSL_2, at, feature);
    panic_ = stopped_ = true;
    next_ = uint32_t(ast_.tokens.tokens.size() - 1);
    reporter_.stop();
    return true;
}

// ---- types
// ---------------------------------------------------------------------------------------

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

// "int i", "pont p": two names where a declaration could stand, or "const float a".
bool Parser::at_foreign_type(int ahead) const {
    const Token& at = token(ahead);
    if (at.kind != TokenKind::Identifier || at.word != Word::None) return false;
    bool known = *foreign_type_help(at.text) != '\0';
    bool qualifier = known && (is_type(ahead + 1) || is_detail(ahead + 1));
    if (token(ahead + 1).kind != TokenKind::Identifier || (!qualifier && is_reserved(ahead + 1)))
        return false;
    return known || !nearest_type(at.text).empty();
}

// Reports it and takes it as the type that is meant; Invalid for a qualifier alone.
bool Parser::foreign_type(BaseType& base) {
    if (!at_foreign_type()) return false;
    const Token& at = token();
    const char* help = foreign_type_help(at.text);
    std::string_view near = nearest_type(at.text);
    reporter_.report(Code::RSL_UNKNOWN_TYPE, at, at.text).help =
        *help ? help : fmt::format("did you mean '{}'?", near);
    base = *help ? foreign_type_base(at.text) : type_from_name(near);
    advance();
    while (*foreign_type_help(token().text) && token(1).kind == TokenKind::Identifier) {
        base = foreign_type_base(token().text);  // "unsigned int"
        advance();
    }
    return true;
}

// "shader lights[]".
bool Parser::shader_handle() {
    bool two = token(1).kind == TokenKind::Identifier && !is_reserved(1);
    return two && token().text == "shader" &&
           newer_language(token(), "'shader' (handles of co-shaders)");
}

// "(int) x", as in C: reported, and the value taken as it is.
bool Parser::foreign_cast() {
    const Token& type = token(1);
    bool operand = token(3).kind != TokenKind::Punctuator || is(Punct::LeftParen, 3);
    if (!operand || foreign_type_base(type.text) == BaseType::Invalid) return false;
    bool whole = type.text == "int" || type.text == "long" || type.text == "unsigned";
    reporter_.report(Code::RSL_UNKNOWN_TYPE, type, type.text).help =
        whole ? "use floor(x)" : foreign_type_help(type.text);
    next_ += 3;
    return true;
}

// ---- statements
// ----------------------------------------------------------------------------------

// Words of C before a function that say nothing here.
bool Parser::idle_word() {
    const Token& at = token();
    bool idle = at.text == "inline" || at.text == "static" || at.text == "export";
    if (!idle || token(1).kind != TokenKind::Identifier) return false;
    reporter_.report(Code::RSL_WORD_LEFT_OUT, at, at.text);
    advance();
    return true;
}

// Statements of C that RSL does not have.
bool Parser::foreign_statement() {
    const Token& at = token();
    bool is_do = at.text == "do" && is(Punct::LeftBrace, 1);
    bool is_switch = at.text == "switch" && is(Punct::LeftParen, 1) &&
                     ast_.tokens.tokens[after_parens(next_ + 1)].punct == Punct::LeftBrace;
    bool is_goto = at.text == "goto" && token(1).kind == TokenKind::Identifier;
    if (!is_do && !is_switch && !is_goto) return false;
    Finding* finding = error(Code::RSL_NOT_RSL, at, fmt::format("'{}'", at.text));
    if (finding && !is_goto)
        finding->help = is_do ? "write 'while (...) { ... }'" : "write 'if ... else if ...'";
    return true;
}

// The control word that a name of no meaning is probably meant to be; "" if none.
std::string_view Parser::resembled_word() const {
    constexpr Word kWords[] = {Word::If,    Word::Else,   Word::While,       Word::For,
                               Word::Break, Word::Return, Word::Illuminance, Word::Illuminate,
                               Word::Solar, Word::Gather};
    if (token().kind != TokenKind::Identifier || token().word != Word::None) return {};
    std::vector<std::string_view> words;
    for (Word word : kWords) words.push_back(word_text(word));
    return nearest_name(token().text, words);
}

// "whlie (...) {": a name, parentheses and a statement, which are no function of untyped
// parameters. Reported, and the name taken for the word.
bool Parser::misspelt_statement() {
    if (!is(Punct::LeftParen, 1) || is_type(2) || is_detail(2) || is(Punct::RightParen, 2))
        return false;
    const Token& behind = ast_.tokens.tokens[after_parens(next_ + 1)];
    if (behind.punct != Punct::LeftBrace && behind.kind != TokenKind::Identifier) return false;
    std::string_view word = resembled_word();
    if (word.empty() || find_word(word) == Word::Else) return false;
    Token& at = ast_.tokens.tokens[next_];
    reporter_.report(Code::RSL_SYNTAX, at, "a statement", fmt::format("'{}'", at.text)).help =
        fmt::format("did you mean '{}'?", word);
    at.word = find_word(word);
    return true;
}

// "float a = 0,5": the number that is meant; "" elsewhere.
std::string Parser::decimal_comma() const {
    if (token().kind != TokenKind::Number || token().space_before || next_ < 2) return "";
    const Token& comma = ast_.tokens.tokens[next_ - 1];
    const Token& whole = ast_.tokens.tokens[next_ - 2];
    bool whole_numbers =
        whole.text.find('.') == whole.text.npos && token().text.find('.') == token().text.npos;
    if (comma.punct != Punct::Comma || whole.kind != TokenKind::Number || !whole_numbers) return "";
    return fmt::format("{}.{}", whole.text, token().text);
}

// "a and b", "a or b" of other languages.
Punct Parser::word_operator() const {
    bool operand = token(1).kind == TokenKind::Identifier || token(1).kind == TokenKind::Number ||
                   token(1).kind == TokenKind::String || is(Punct::LeftParen, 1) ||
                   is(Punct::Not, 1) || is(Punct::Subtract, 1);
    if (token().kind != TokenKind::Identifier || !operand) return Punct::None;
    return token().text == "and" ? Punct::And : token().text == "or" ? Punct::Or : Punct::None;
}

// "not a", where no function or variable of the name can be meant.
bool Parser::word_not() {
    bool operand = token(1).kind == TokenKind::Identifier || token(1).kind == TokenKind::Number;
    bool word = token(1).text == "and" || token(1).text == "or";
    if (token().kind != TokenKind::Identifier || token().text != "not" || !operand || word)
        return false;
    reporter_.report(Code::RSL_NOT_RSL, token(), "'not'").help = "write '!'";
    return true;
}

// A letter that no keyword has, where the grammar is broken: most likely a slip of the hand.
bool Parser::foreign_character() {
    for (uint32_t k : {next_, next_ > 0 ? next_ - 1 : 0}) {
        const Token& at = ast_.tokens.tokens[k];
        bool foreign =
            at.kind == TokenKind::Identifier &&
            std::any_of(at.text.begin(), at.text.end(), [](char c) { return (c & 0x80) != 0; });
        if (!foreign) continue;
        error(Code::RSL_BAD_CHARACTER, at, fmt::format("'{}'", at.text));
        return true;
    }
    return false;
}

// "elseif" and its kin of other languages, behind the statement of an if.
bool Parser::else_if_word() const {
    std::string_view word = token().text;
    return (word == "elseif" || word == "elsif" || word == "elif") && is(Punct::LeftParen, 1);
}

// An else that no if stands before: reported, and its statement read.
Stmt* Parser::lonely_else() {
    if (!skipped_)
        reporter_.report(Code::RSL_SYNTAX, token(), "a statement", "'else'").help =
            "an else stands behind the one statement of its if; a ';' or a missing brace parts "
            "them";
    advance();
    return statement();
}

}  // namespace kinora::rsl
