// rsl/syntax/parser.cpp: shaders and functions at file level.
#include "rsl/syntax/parser.h"

#include <algorithm>

#include "rsl/text/did_you_mean.h"

namespace kinora::rsl {

namespace {

bool is_shader_word(Word word) {
    return word >= Word::Surface && word <= Word::Deformation;
}

}  // namespace

Parser::Parser(Ast& ast, Reporter& reporter, uint32_t first)
    : ast_(ast),
      cursor_(ast.tokens.tokens, first),
      errors_(cursor_, reporter),
      foreign_(cursor_, errors_),
      expressions_(ast, cursor_, errors_, foreign_, nesting_),
      declarations_(ast, cursor_, errors_, foreign_, expressions_, open_),
      statements_(ast, cursor_, errors_, foreign_, nesting_, open_, expressions_, declarations_),
      objects_(ast, cursor_, errors_, open_, declarations_, statements_) {
    statements_.read_structs_by([this] { objects_.struct_definition(); });
}

namespace {

// Whether some array of the source changes its length.
bool resizes_arrays(const TokenCursor& cursor) {
    constexpr std::string_view kCalls[] = {"resize", "push", "pop", "reserve"};
    const auto& tokens = cursor.all();
    for (size_t i = 0; i + 1 < tokens.size(); ++i)
        if (tokens[i + 1].punct == Punct::LeftParen &&
            std::find(std::begin(kCalls), std::end(kCalls), tokens[i].text) != std::end(kCalls))
            return true;
    return false;
}

}  // namespace

void Parser::run() {
    ast_.resizes = resizes_arrays(cursor_);
    while (!cursor_.at_end() && !errors_.full()) {
        uint32_t begin = cursor_.position();
        errors_.begin_definition();
        statements_.begin_definition();
        definition();
        errors_.leave_definition(begin);
        if (cursor_.position() == begin) cursor_.advance();
    }
}

void Parser::definition() {
    if (cursor_.accept(Punct::Semicolon) || newer_definition() || shader_definition()) return;
    if (!file_variable()) function_definition();
}

bool Parser::newer_definition() {
    if (cursor_.token().text == "plugin" && cursor_.token(1).kind == TokenKind::String &&
        cursor_.is(Punct::Semicolon, 2)) {
        errors_.report(Code::RSL_PLUGIN, cursor_.token());
        for (int k = 0; k < 3; ++k) cursor_.advance();
        return true;
    }
    if (cursor_.token(1).kind != TokenKind::Identifier) return false;
    if (objects_.at_class() || objects_.at_struct()) {
        objects_.at_class() ? objects_.class_definition() : objects_.struct_definition();
        return true;
    }
    if (cursor_.token().text == "public")
        return errors_.newer_language(cursor_.token(), "'public' (shader objects)");
    return false;
}

// "float x = 1;" outside shaders and functions.
bool Parser::file_variable() {
    int type = cursor_.is(Word::Uniform) || cursor_.is(Word::Varying) || cursor_.is(Word::Extern);
    bool ends = cursor_.is(Punct::Assign, type + 2) || cursor_.is(Punct::Semicolon, type + 2) ||
                cursor_.is(Punct::Comma, type + 2) || cursor_.is(Punct::LeftBracket, type + 2);
    if (!cursor_.is_type(type) || cursor_.token(type + 1).kind != TokenKind::Identifier || !ends)
        return false;
    errors_.report(Code::RSL_FILE_VARIABLE, cursor_.token(type + 1), cursor_.token(type + 1).text);
    uint32_t begin = cursor_.position();
    while (!cursor_.at_end() && !cursor_.is(Punct::Semicolon) &&
           !is_shader_word(cursor_.token().word))
        cursor_.advance();
    errors_.lose(begin, true, true);
    return true;
}

// "shader name(...) {...}" that returns nothing; else it is a function that gives a handle.
bool Parser::at_co_shader() const {
    if (!cursor_.is_handle() || !cursor_.is(Punct::LeftParen, 2)) return false;
    const auto& tokens = cursor_.all();
    uint32_t i = cursor_.after_parens(cursor_.position() + 2);
    if (tokens[i].punct != Punct::LeftBrace) return false;
    for (int depth = 0; i + 1 < tokens.size(); ++i) {
        depth += (tokens[i].punct == Punct::LeftBrace) - (tokens[i].punct == Punct::RightBrace);
        if (depth == 0) return true;
        if (tokens[i].word == Word::Return && tokens[i + 1].punct != Punct::Semicolon) return false;
    }
    return true;
}

// "surface name(...) {...}".
bool Parser::shader_definition() {
    bool co_shader = at_co_shader();
    if (!is_shader_word(cursor_.token().word) && !co_shader) return false;
    uint32_t at = cursor_.position();
    // "deformation" is another name of transformation.
    Word word = std::min(cursor_.token().word, Word::Transformation);
    cursor_.advance();
    auto* shader = ast_.arena.make<ShaderDefinition>();
    if (!co_shader) shader->kind = ShaderKind(int(word) - int(Word::Surface));
    shader->co_shader = co_shader;
    shader->span = SourceSpan{cursor_.token().where, cursor_.position()};
    if (cursor_.token().kind == TokenKind::Identifier &&
        (cursor_.is(Punct::LeftParen, 1) || cursor_.is_reserved())) {
        shader->name = cursor_.token().text;  // any word will do
        cursor_.advance();
    } else {
        shader->name = errors_.expect_name("a shader name");
    }
    shader->parameters = declarations_.parameters(SymbolKind::Parameter);
    if (errors_.panic()) return true;
    if (cursor_.is(Punct::Semicolon) && cursor_.is(Punct::LeftBrace, 1)) {
        errors_.report(Code::RSL_SYNTAX, cursor_.token(), "'{'", "';'").help = "leave the ';' out";
        cursor_.advance();
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
    open_.begin_shader();
    BlockStmt* body = statements_.block();
    bool ends = open_.shader_return() && shader.kind != ShaderKind::Light && !errors_.count();
    return ends ? body_as_function(body) : body;
}

BlockStmt* Parser::body_as_function(BlockStmt* body) {
    errors_.report(Code::RSL_SHADER_RETURN, cursor_.at(open_.shader_return()->span.token));
    auto* f = ast_.arena.make<Function>();
    f->name = "__body";
    f->result = {BaseType::Void, -1};
    f->span = body->span;
    f->id = ast_.function_count++;
    f->body = body;
    open_.move_body_into(*f);
    auto* definition = ast_.make<FunctionStmt>(body->span);
    definition->function = f;
    auto* call = ast_.make<CallExpr>(body->span);
    call->name = f->name;
    call->site = ast_.site_count++;
    auto* statement = ast_.make<ExpressionStmt>(body->span);
    statement->expression = call;
    auto* whole = ast_.make<BlockStmt>(body->span);
    whole->body = ast_.arena.copy(std::vector<Stmt*>{definition, statement});
    return whole;
}

// "sruface x()": perhaps a misspelt kind of shader.
void Parser::unknown_definition() {
    const Token& at = cursor_.token();
    if (cursor_.is_type() && cursor_.is(Punct::LeftBracket, 1)) {
        Finding* finding = errors_.error(Code::RSL_NOT_RSL, at, "a function that returns an array");
        if (finding) finding->help = "hand the array out through an output parameter";
        return;
    }
    bool two_names =
        at.kind == TokenKind::Identifier && cursor_.token(1).kind == TokenKind::Identifier;
    std::vector<std::string_view> kinds;
    for (int k = 0; k <= int(ShaderKind::Transformation); ++k)
        kinds.push_back(shader_kind_name(ShaderKind(k)));
    std::string_view near = two_names ? nearest_name(at.text, kinds) : std::string_view();
    bool behind =
        cursor_.position() > 0 && cursor_.at(cursor_.position() - 1).punct == Punct::RightBrace;
    if (near.empty() && !(behind && at.kind == TokenKind::Identifier))
        return errors_.syntax_error("a shader or function definition");
    Finding* finding = errors_.error(Code::RSL_SYNTAX, at, "a shader or function definition",
                                     fmt::format("'{}'", at.text));
    if (!finding) return;
    finding->help = near.empty() ? "a '}' before it may be one too many"
                                 : fmt::format("did you mean '{}'?", near);
}

// "float fade(float x) {", where a macro of that name has put something else in the name's place.
bool Parser::name_is_macro() {
    const Token& name = cursor_.token(1);
    if (!cursor_.is_type() || cursor_.token().macro != 0 || name.macro == 0 ||
        name.kind == TokenKind::Identifier)
        return false;
    std::string_view macro = ast_.tokens.macros[name.macro].name;
    Finding* finding =
        errors_.error(Code::RSL_SYNTAX, name, "a function name", fmt::format("'{}'", name.text));
    if (finding)
        finding->help = fmt::format(
            "the function's name is a macro: '#undef {}' before it, or another name", macro);
    return true;
}

// "[uniform] [type] name (": the detail of a result is inferred.
void Parser::function_definition() {
    while (true) {
        if (cursor_.is(Word::Uniform) || cursor_.is(Word::Varying) || cursor_.is(Word::Extern))
            cursor_.advance();
        else if (!foreign_.accept_idle_word())
            break;
    }
    if (name_is_macro()) return;
    int name = (cursor_.is_type() && !cursor_.is(Punct::LeftParen, 1)) ||
               declarations_.struct_type() || foreign_.at_type() || cursor_.is_handle();
    bool named =
        cursor_.token(name).kind == TokenKind::Identifier && cursor_.is(Punct::LeftParen, name + 1);
    if (!named) {
        unknown_definition();
        return;
    }
    uint32_t behind = cursor_.after_parens(cursor_.position() + uint32_t(name) + 1);
    if (cursor_.at(behind).punct == Punct::Semicolon) {  // a prototype: functions need none
        cursor_.move_to(behind + 1);
        return;
    }
    if (Function* f = statements_.function()) ast_.functions.push_back(f);
}

}  // namespace kinora::rsl
