// rsl/syntax/parse_definition.cpp: shaders, functions, parameters and declarations.
#include <algorithm>

#include "rsl/syntax/parser.h"

namespace kinora::rsl {

namespace {

bool is_shader_word(Word word) {
    return word >= Word::Surface && word <= Word::Deformation;
}

}  // namespace

// ---- definitions --------------------------------------------------------------------------------

void Parser::definition() {
    unclosed_ = false;
    if (accept(Punct::Semicolon) || newer_definition() || shader_definition()) return;
    if (!file_variable()) function_definition();
}

bool Parser::newer_definition() {
    if (token().text == "plugin" && token(1).kind == TokenKind::String && is(Punct::Semicolon, 2)) {
        reporter_.report(Code::RSL_PLUGIN, token());
        for (int k = 0; k < 3; ++k) advance();
        return true;
    }
    if (token(1).kind != TokenKind::Identifier) return false;
    if (token().text == "class") return newer_language(token(), "'class' (shader objects)");
    if (token().text == "struct") return newer_language(token(), "'struct'");
    if (token().text == "shader" && is(Punct::LeftParen, 2)) {
        error(Code::RSL_NOT_RSL, token(), "'shader' (Open Shading Language)");
        return true;
    }
    if (token().text == "public") return newer_language(token(), "'public' (shader objects)");
    return false;
}

// "float x = 1;" outside shaders and functions.
bool Parser::file_variable() {
    int type = is(Word::Uniform) || is(Word::Varying) || is(Word::Extern);
    bool ends = is(Punct::Assign, type + 2) || is(Punct::Semicolon, type + 2) ||
                is(Punct::Comma, type + 2) || is(Punct::LeftBracket, type + 2);
    if (!is_type(type) || token(type + 1).kind != TokenKind::Identifier || !ends) return false;
    reporter_.report(Code::RSL_FILE_VARIABLE, token(type + 1), token(type + 1).text);
    uint32_t begin = next_;
    while (!at_end() && !is(Punct::Semicolon) && !is_shader_word(token().word)) advance();
    recovery_.lose(ast_.tokens.tokens, begin, next_, true, true);
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
    shader->span = SourceSpan{token().where, next_};
    if (token().kind == TokenKind::Identifier && (is(Punct::LeftParen, 1) || is_reserved())) {
        shader->name = token().text;  // any word will do
        advance();
    } else {
        shader->name = expect_name("a shader name");
    }
    shader->parameters = parameters(SymbolKind::Parameter);
    if (panic_) return true;
    if (is(Punct::Semicolon) && is(Punct::LeftBrace, 1)) {
        reporter_.report(Code::RSL_SYNTAX, token(), "'{'", "';'").help = "leave the ';' out";
        advance();
    }
    shader->body = shader_body(*shader);
    shader->span.token = at;
    ast_.shaders.push_back(shader);
    return true;
}

// A "return;" of the shader itself ends it. That is no RSL, but its meaning is clear: the body
// becomes a function, as if the source had "void __body() { ... } __body();". Lights are left out,
// since their illuminate statements stand in the body.
BlockStmt* Parser::shader_body(ShaderDefinition& shader) {
    shader_return_ = nullptr;
    shader_locals_.clear();
    shader_functions_.clear();
    BlockStmt* body = block();
    bool ends = shader_return_ && shader.kind != ShaderKind::Light && !reporter_.errors();
    return ends ? body_as_function(body) : body;
}

BlockStmt* Parser::body_as_function(BlockStmt* body) {
    reporter_.report(Code::RSL_SHADER_RETURN, ast_.tokens.tokens[shader_return_->span.token]);
    auto* f = ast_.arena.make<Function>();
    f->name = "__body";
    f->result = {BaseType::Void, -1};
    f->span = body->span;
    f->id = ast_.function_count++;
    f->body = body;
    for (Symbol* local : shader_locals_) local->function = f;
    for (Function* nested : shader_functions_) nested->parent = f;
    auto* definition = make<FunctionStmt>(body->span);
    definition->function = f;
    auto* call = make<CallExpr>(body->span);
    call->name = f->name;
    call->site = ast_.site_count++;
    auto* statement = make<ExpressionStmt>(body->span);
    statement->expression = call;
    auto* whole = make<BlockStmt>(body->span);
    whole->body = ast_.arena.copy(std::vector<Stmt*>{definition, statement});
    return whole;
}

// "sruface x()": perhaps a misspelt kind of shader.
void Parser::unknown_definition() {
    const Token& at = token();
    if (is_type() && is(Punct::LeftBracket, 1)) {
        Finding* finding = error(Code::RSL_NOT_RSL, at, "a function that returns an array");
        if (finding) finding->help = "hand the array out through an output parameter";
        return;
    }
    bool two_names = at.kind == TokenKind::Identifier && token(1).kind == TokenKind::Identifier;
    std::vector<std::string_view> kinds;
    for (int k = 0; k <= int(ShaderKind::Transformation); ++k)
        kinds.push_back(shader_kind_name(ShaderKind(k)));
    std::string_view near = two_names ? nearest_name(at.text, kinds) : std::string_view();
    bool behind = next_ > 0 && ast_.tokens.tokens[next_ - 1].punct == Punct::RightBrace;
    if (near.empty() && !(behind && at.kind == TokenKind::Identifier))
        return syntax_error("a shader or function definition");
    Finding* finding = error(Code::RSL_SYNTAX, at, "a shader or function definition",
                             fmt::format("'{}'", at.text));
    if (!finding) return;
    finding->help = near.empty() ? "a '}' before it may be one too many"
                                 : fmt::format("did you mean '{}'?", near);
}

// "[uniform] [type] name (": the detail of a result is inferred.
void Parser::function_definition() {
    while (true) {
        if (is(Word::Uniform) || is(Word::Varying) || is(Word::Extern))
            advance();
        else if (!idle_word())
            break;
    }
    int name = (is_type() && !is(Punct::LeftParen, 1)) || at_foreign_type();
    bool named = token(name).kind == TokenKind::Identifier && is(Punct::LeftParen, name + 1);
    if (!named) {
        unknown_definition();
        return;
    }
    uint32_t behind = after_parens(next_ + uint32_t(name) + 1);
    if (ast_.tokens.tokens[behind].punct == Punct::Semicolon) {  // a prototype: functions need none
        next_ = behind + 1;
        return;
    }
    if (Function* f = function()) ast_.functions.push_back(f);
}

// A missing type means float, as the specification has it, or void where nothing is returned.
Function* Parser::function() {
    auto* f = ast_.arena.make<Function>();
    f->result = {BaseType::Float, -1};
    bool foreign = at_foreign_type();
    f->typed = foreign || (is_type() && !is(Punct::LeftParen, 1));
    if (foreign) {
        foreign_type(f->result.base);
    } else if (f->typed) {
        f->result.base = type_from_name(token().text);
        advance();
    }
    f->span = SourceSpan{token().where, next_};
    f->name = expect_name("a function name");
    f->parent = function_;
    if (!function_) shader_functions_.push_back(f);
    f->id = ast_.function_count++;
    function_ = f;
    f->parameters = parameters(SymbolKind::FunctionParameter);
    if (!panic_) f->body = block();
    function_ = f->parent;
    if (!f->typed && !f->returns) f->result.base = BaseType::Void;
    return f->body ? f : nullptr;
}

// "(float a = 1, b; color c)": groups begin with a type; ',' and ';' both separate.
std::span<Symbol*> Parser::parameters(SymbolKind kind) {
    std::vector<Symbol*> symbols;
    if (is(Punct::LeftBrace) && kind == SymbolKind::Parameter) {
        reporter_.report(Code::RSL_MISSING_PARENTHESES, token());
        return {};
    }
    if (!expect(Punct::LeftParen, "'('")) return {};
    if (is(Word::Void) && is(Punct::RightParen, 1)) advance();  // as in C
    Declaration head{{BaseType::Float, -1}, Detail::Unspecified, false};
    bool have_type = false;
    uint32_t begin = next_;  // of the parameter being read
    while (!panic_ && !is(Punct::RightParen) && !is(Punct::LeftBrace)) {
        if (is(Punct::Comma) || is(Punct::Semicolon)) {
            have_type = have_type && !is(Punct::Semicolon);
            advance();
            begin = next_;
            continue;
        }
        if (((is_type() || is_detail()) && !(have_type && word_as_name())) || at_foreign_type() ||
            shader_handle()) {
            if (!declaration_head(head)) {
                if (stopped_ || !resume_parameters(begin)) break;
                continue;
            }
            have_type = true;
        } else if (!have_type && token().kind == TokenKind::Identifier) {
            reporter_.report(Code::RSL_MISSING_TYPE, token(), token().text,
                             type_name(head.type.base));
            have_type = true;
        }
        Symbol* symbol = declarator(head, kind);
        if (symbol) symbols.push_back(symbol);
        if (panic_ && !resume_parameters(begin)) break;
        bool separated = is(Punct::Comma) || is(Punct::Semicolon);
        if (separated || is(Punct::RightParen) || is(Punct::LeftBrace)) continue;
        if (is_type() || is_detail())
            missing_behind("';'");
        else
            syntax_error("',' or ')'");
        if (panic_ && !resume_parameters(begin)) break;
        begin = next_;
    }
    if (!panic_) end_of_parameters();
    return ast_.arena.copy(symbols);
}

void Parser::end_of_parameters() {
    if (is(Punct::LeftBrace))
        missing_behind("')'");
    else
        expect(Punct::RightParen, "')'");
}

// Whether the token behind a ',' goes on with parameters, not with the arguments of a broken value.
bool Parser::is_parameter(uint32_t index) const {
    int ahead = int(index) - int(next_);
    return is_type(ahead) || is_detail(ahead) ||
           (token(ahead).kind == TokenKind::Identifier && is(Punct::Assign, ahead + 1));
}

// After an error among parameters: to the next ';' or ',' between them, or to the ')' before the
// body. False where the body comes first.
bool Parser::resume_parameters(uint32_t begin) {
    if (after_reported()) return false;
    const auto& tokens = ast_.tokens.tokens;
    bool in_list = false;
    for (uint32_t i = next_; i + 1 < tokens.size(); ++i) {
        Punct punct = tokens[i].punct, behind = tokens[i + 1].punct;
        bool list = punct == Punct::LeftBrace && i > 0 && tokens[i - 1].punct == Punct::Assign;
        if (punct == Punct::LeftBrace && !list) return false;
        bool ends = behind == Punct::Comma || behind == Punct::Semicolon;
        if (punct == Punct::RightBrace && !in_list && !ends) return false;
        in_list = list || (in_list && punct != Punct::RightBrace);
        bool last = punct == Punct::RightParen && behind == Punct::LeftBrace;
        bool between = punct == Punct::Semicolon || (punct == Punct::Comma && is_parameter(i + 1));
        if (!last && !between) continue;
        next_ = i;
        panic_ = false;
        lose(begin, true);
        return true;
    }
    return false;
}

// ---- declarations -------------------------------------------------------------------------------

// "output uniform float" in any order, the type last.
bool Parser::declaration_head(Declaration& head) {
    head = Declaration{};
    while (true) {
        if (is(Word::Output)) head.output = true;
        if (is(Word::Uniform)) head.detail = Detail::Uniform;
        if (is(Word::Varying)) head.detail = Detail::Varying;
        if (is_detail())
            advance();
        else if (!foreign_type(head.type.base))
            break;
        else if (head.type.base != BaseType::Invalid)
            return true;
    }
    if (!is_type()) {
        if (!shader_handle()) syntax_error("a type");
        return false;
    }
    head.type.base = type_from_name(token().text);
    advance();
    if (token().kind == TokenKind::String && token(1).kind == TokenKind::Identifier) {
        reporter_.report(Code::RSL_NOT_RSL, token(), "a space in a declaration").help =
            "write it before the value, as in point p = point \"world\" (0, 0, 1)";
        advance();
    }
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
    if (!function_ && kind == SymbolKind::Local) shader_locals_.push_back(symbol);
    symbol->id = ast_.symbol_count++;
    symbol->span = SourceSpan{token().where, next_};
    symbol->name = expect_name("a variable name");
    if (panic_) return nullptr;
    if (head.type.base == BaseType::Void)
        reporter_.report(Code::RSL_VOID_VARIABLE, ast_.tokens.tokens[symbol->span.token],
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
    if (is(Punct::LeftBracket)) {
        Finding* finding = error(Code::RSL_NOT_RSL, token(), "an array of arrays");
        if (finding) finding->help = "use one index, as in a[i * n + j]";
        return;
    }
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
    node->span = span_from(at);
    if (symbol.type.array_length == 0) symbol.type.array_length = int(node->items.size());
    return node;
}

// A type before a name, or a detail. "float noise(P)" and "color (1,2,3)" are expressions.
bool Parser::at_declaration() const {
    if (is(Word::Uniform) || is(Word::Varying)) return !word_as_name();
    if (is(Word::Output)) return is_type(1) || is_detail(1);
    bool space =
        is_type() && token(1).kind == TokenKind::String && token(2).kind == TokenKind::Identifier;
    if (space) {  // written before the name instead of the value
        Punct behind = token(3).punct;
        return behind == Punct::Assign || behind == Punct::Semicolon ||
               behind == Punct::LeftBracket;
    }
    if (!is_type() || token(1).kind != TokenKind::Identifier || is(Punct::LeftParen, 2))
        return at_foreign_type() && !is(Punct::LeftParen, 2);
    return !is_reserved(1);
}

// "[type] name (...) {" inside a block.
bool Parser::at_function(uint32_t ahead) const {
    int at = int(ahead);
    bool typed = (is_type(at) && !is(Punct::LeftParen, at + 1)) || at_foreign_type(at);
    uint32_t name = next_ + ahead + typed;
    const auto& tokens = ast_.tokens.tokens;
    if (name + 1 >= tokens.size() || tokens[name].kind != TokenKind::Identifier) return false;
    if (tokens[name + 1].punct != Punct::LeftParen) return false;
    // Parameters may hold semicolons but no braces, unless as array defaults, which functions lack.
    return tokens[after_parens(name + 1)].punct == Punct::LeftBrace;
}

}  // namespace kinora::rsl
