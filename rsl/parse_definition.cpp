// rsl/parse_definition.cpp: shaders, functions, parameters and declarations.
#include <algorithm>

#include "rsl/parser.h"

namespace kinora::rsl {

namespace {

bool is_type_word(Word word) {
    return word >= Word::Float && word <= Word::Void;
}
bool is_detail_word(Word word) {
    return word == Word::Uniform || word == Word::Varying || word == Word::Output;
}
bool is_shader_word(Word word) {
    return word >= Word::Surface && word <= Word::Deformation;
}

}  // namespace

// ---- definitions --------------------------------------------------------------------------------

void Parser::definition() {
    if (accept(Punct::Semicolon) || foreign_definition() || shader_definition()) return;
    function_definition();
}

// class and struct of RSL 2.0: reported and skipped as a whole.
bool Parser::foreign_definition() {
    bool foreign = token().text == "class" || token().text == "struct";
    if (!foreign || token(1).kind != TokenKind::Identifier) return false;
    error(Code::RSL_NOT_RSL, token(), fmt::format("'{}' (RSL 2.0)", token().text));
    return true;
}

// "surface name(...) {...}".
bool Parser::shader_definition() {
    if (!is_shader_word(token().word)) return false;
    uint32_t at = next_;
    // "deformation" is another name of transformation.
    auto kind =
        ShaderKind(std::min(int(token().word), int(Word::Transformation)) - int(Word::Surface));
    advance();
    auto* shader = ast_.arena.make<ShaderDefinition>();
    shader->kind = kind;
    shader->place = Place{token().where, next_};
    shader->name = expect_name("a shader name");
    shader->parameters = parameters(SymbolKind::Parameter);
    if (panic_) return true;
    shader->body = block();
    shader->place.token = at;
    ast_.shaders.push_back(shader);
    return true;
}

// "sruface x()": perhaps a misspelt kind of shader.
void Parser::unknown_definition() {
    const Token& at = token();
    bool two_names = at.kind == TokenKind::Identifier && token(1).kind == TokenKind::Identifier;
    std::vector<std::string_view> kinds;
    for (int k = 0; k <= int(ShaderKind::Transformation); ++k)
        kinds.push_back(shader_kind_name(ShaderKind(k)));
    std::string_view near = two_names ? nearest_name(at.text, kinds) : std::string_view();
    if (near.empty()) return syntax_error("a shader or function definition");
    Finding* finding = error(Code::RSL_SYNTAX, at, "a shader or function definition",
                             fmt::format("'{}'", at.text));
    if (finding) finding->help = fmt::format("did you mean '{}'?", near);
}

void Parser::function_definition() {
    bool typed = is_type_word(token().word);
    bool named = token(typed).kind == TokenKind::Identifier && is(Punct::LeftParen, typed ? 2 : 1);
    if (!named) {
        unknown_definition();
        return;
    }
    if (Function* f = function(typed)) ast_.functions.push_back(f);
}

// A missing type means float, as the specification has it.
Function* Parser::function(bool) {
    auto* f = ast_.arena.make<Function>();
    f->result = {BaseType::Float, -1};
    if (is_type_word(token().word)) {
        f->result.base = type_from_name(token().text);
        advance();
    }
    f->place = Place{token().where, next_};
    f->name = expect_name("a function name");
    f->parent = function_;
    f->id = ast_.function_count++;
    function_ = f;
    f->parameters = parameters(SymbolKind::FunctionParameter);
    if (!panic_) f->body = block();
    function_ = f->parent;
    return f->body ? f : nullptr;
}

// "(float a = 1, b; color c)": groups begin with a type; ',' and ';' both separate.
std::span<Symbol*> Parser::parameters(SymbolKind kind) {
    std::vector<Symbol*> symbols;
    if (!expect(Punct::LeftParen, "'('")) return {};
    Declaration head{{BaseType::Float, -1}, Detail::Unspecified, false};
    bool have_type = false;
    while (!panic_ && !is(Punct::RightParen)) {
        if (is_type_word(token().word) || is_detail_word(token().word)) {
            if (!declaration_head(head)) break;
            have_type = true;
        } else if (!have_type && token().kind == TokenKind::Identifier) {
            reporter_.report(Code::RSL_MISSING_TYPE, token(), token().text);
            have_type = true;
        }
        Symbol* symbol = declarator(head, kind);
        if (panic_) break;
        symbols.push_back(symbol);
        bool separated = false;
        while (is(Punct::Comma) || is(Punct::Semicolon)) {
            have_type = have_type && !is(Punct::Semicolon);
            advance();
            separated = true;
        }
        if (!separated && !is(Punct::RightParen)) syntax_error("',' or ')'");
    }
    if (!panic_) expect(Punct::RightParen, "')'");
    return ast_.arena.copy(symbols);
}

// ---- declarations -------------------------------------------------------------------------------

// "output uniform float" in any order, the type last.
bool Parser::declaration_head(Declaration& head) {
    head = Declaration{};
    while (is_detail_word(token().word)) {
        if (is(Word::Output)) head.output = true;
        if (is(Word::Uniform)) head.detail = Detail::Uniform;
        if (is(Word::Varying)) head.detail = Detail::Varying;
        advance();
    }
    if (!is_type_word(token().word)) {
        syntax_error("a type");
        return false;
    }
    head.type.base = type_from_name(token().text);
    advance();
    return true;
}

// "name", "name[3]", "name = value".
Symbol* Parser::declarator(const Declaration& head, SymbolKind kind) {
    auto* symbol = ast_.arena.make<Symbol>();
    symbol->kind = kind;
    symbol->type = head.type;
    symbol->detail = head.detail;
    symbol->output = head.output;
    symbol->function = function_;
    symbol->id = ast_.symbol_count++;
    symbol->place = Place{token().where, next_};
    symbol->name = expect_name("a variable name");
    if (panic_) return nullptr;
    if (head.type.base == BaseType::Void)
        reporter_.report(Code::RSL_VOID_VARIABLE, ast_.tokens.tokens[symbol->place.token],
                         symbol->name);
    array_suffix(*symbol);
    if (!panic_ && accept(Punct::Assign)) symbol->initial = initialiser(*symbol);
    return panic_ ? nullptr : symbol;
}

void Parser::array_suffix(Symbol& symbol) {
    if (!accept(Punct::LeftBracket)) return;
    symbol.type.array_length = 0;
    if (accept(Punct::RightBracket)) return;
    const Token& at = token();
    Expr* length = expression();
    if (panic_ || !expect(Punct::RightBracket, "']'")) return;
    long value = constant_length(*length);
    if (value < 1) reporter_.report(Code::RSL_BAD_ARRAY_LENGTH, at);
    symbol.type.array_length = int(std::max(value, 1l));
}

// A value, or "{a, b}" for an array, which gives an unsized array its length.
Expr* Parser::initialiser(Symbol& symbol) {
    if (!is(Punct::LeftBrace)) return expression();
    uint32_t at = next_;
    advance();
    auto* node = make<ArrayLiteralExpr>({});
    if (!accept(Punct::RightBrace)) {
        std::vector<Expr*> items;
        while (!panic_ && !is(Punct::RightBrace)) {
            items.push_back(expression());
            if (!accept(Punct::Comma)) break;
        }
        if (!panic_) expect(Punct::RightBrace, "'}'");
        node->items = ast_.arena.copy(items);
    }
    node->place = place_from(at);
    if (symbol.type.array_length == 0) symbol.type.array_length = int(node->items.size());
    return node;
}

// A type before a name, or a detail. "float noise(P)" and "color (1,2,3)" are expressions.
bool Parser::at_declaration() const {
    if (is(Word::Uniform) || is(Word::Varying)) return true;
    if (is(Word::Output)) return is_type_word(token(1).word) || is_detail_word(token(1).word);
    if (!is_type_word(token().word)) return false;
    return token(1).kind == TokenKind::Identifier && !is(Punct::LeftParen, 2) &&
           !is_type_word(token(1).word);
}

// "[type] name (...) {" inside a block.
bool Parser::at_function() const {
    uint32_t name = next_ + is_type_word(token().word);
    const auto& tokens = ast_.tokens.tokens;
    if (name + 1 >= tokens.size() || tokens[name].kind != TokenKind::Identifier) return false;
    if (tokens[name + 1].punct != Punct::LeftParen) return false;
    // Parameters may hold semicolons but no braces, unless as array defaults, which functions lack.
    return tokens[after_parens(name + 1)].punct == Punct::LeftBrace;
}

}  // namespace kinora::rsl
