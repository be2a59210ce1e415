// rsl/syntax/parse_statement.cpp: statements.
#include <utility>

#include "rsl/syntax/parser.h"
#include "rsl/text/lexer.h"

namespace kinora::rsl {

BlockStmt* Parser::block() {
    uint32_t at = next_;
    auto* node = make<BlockStmt>(SourceSpan{token().where, at});
    // A body whose '{' is left out goes on with a declaration or statement.
    bool whole = token().kind == TokenKind::Identifier && next_ > 0 && !begins_definition();
    if (!is(Punct::LeftBrace) && whole) {
        missing_behind("'{'");
        mark_broken();
        unclosed_ = true;  // which '}' ends what nobody knows
    } else if (!expect(Punct::LeftBrace, "'{'")) {
        return node;
    }
    std::vector<Stmt*> body;
    while (!is(Punct::RightBrace) && !at_end() && !begins_shader() && !reporter_.full()) {
        uint32_t before = next_;
        Stmt* stmt = statement();
        skipped_ = panic_;
        leave_statement(before);
        if (stmt) body.push_back(stmt);
        if (next_ == before && !is(Punct::RightBrace)) advance();
    }
    if (!accept(Punct::RightBrace) && !std::exchange(unclosed_, true)) {
        Finding& finding = reporter_.report(Code::RSL_UNCLOSED, ast_.tokens.tokens[at], '{');
        if (!at_end()) finding.help = fmt::format("before {} '{}'", token().text, token(1).text);
        mark_broken();
    }
    node->body = ast_.arena.copy(body);
    node->span = span_from(at);
    return node;
}

Stmt* Parser::statement() {
    ++depth_;
    Stmt* stmt = nullptr;
    if (depth_ > kMostNesting)
        error(Code::RSL_TOO_DEEP, token());
    else
        stmt = statement_unguarded();
    --depth_;
    return stmt;
}

// Null for an empty or broken statement.
Stmt* Parser::statement_unguarded() {
    if (accept(Punct::Semicolon)) return nullptr;
    if (is(Punct::LeftBrace)) return block();
    bool call = is(Punct::LeftParen, 1);
    switch (token().word) {
        case Word::If:
            return if_statement();
        case Word::Else:
            return lonely_else();
        case Word::While:
            return while_statement();
        case Word::For:
            return for_statement();
        case Word::Break:
        case Word::Continue:
            return jump_statement(token().word);
        case Word::Return:
            return return_statement();
        case Word::Extern:
            return extern_statement();
        case Word::Illuminance:
            return call ? illuminance_statement() : expression_statement();
        case Word::Illuminate:
            return call ? illuminate_statement() : expression_statement();
        case Word::Solar:
            return call ? solar_statement() : expression_statement();
        case Word::Gather:
            return call ? gather_statement() : expression_statement();
        default:
            break;
    }
    if (foreign_statement()) return nullptr;
    if (misspelt_statement()) return statement_unguarded();
    if (is_detail() && at_function(1)) advance();  // the detail of a result is inferred
    if (at_function()) {
        auto* node = make<FunctionStmt>(SourceSpan{token().where, next_});
        node->function = function();
        return node->function ? node : nullptr;
    }
    if (at_declaration()) return declaration_statement();
    return shader_handle() ? nullptr : expression_statement();
}

// The statement that another one governs; empty where it is broken.
Stmt* Parser::body_statement() {
    uint32_t begin = next_;
    Stmt* stmt = statement();
    leave_statement(begin);
    return stmt ? stmt : empty_statement();
}

// After an error between the parentheses of a statement: on behind them, if they are closed.
void Parser::leave_header(uint32_t open) {
    const auto& tokens = ast_.tokens.tokens;
    if (!panic_ || stopped_ || after_reported() || tokens[open].punct != Punct::LeftParen) return;
    uint32_t behind = after_parens(open);
    bool closed = behind + 1 < tokens.size() && behind >= next_;
    if (!closed && !is(Punct::LeftBrace)) return;
    if (closed) next_ = behind;
    panic_ = false;
    lose(open);
}

Stmt* Parser::empty_statement() {
    return make<BlockStmt>(SourceSpan{token().where, next_});
}

Stmt* Parser::declaration_statement() {
    uint32_t at = next_;
    Declaration head;
    if (!declaration_head(head)) return nullptr;
    auto* node = make<DeclareStmt>({});
    node->symbols = declared_symbols(head, SymbolKind::Local);
    node->span = span_from(at);
    expect_semicolon();
    return node;
}

Stmt* Parser::extern_statement() {
    uint32_t at = next_;
    advance();
    Declaration head;
    if (!declaration_head(head)) return nullptr;
    auto* node = make<ExternStmt>({});
    node->symbols = declared_symbols(head, SymbolKind::Local);
    node->span = span_from(at);
    expect_semicolon();
    return node;
}

std::span<Symbol*> Parser::declared_symbols(const Declaration& head, SymbolKind kind) {
    std::vector<Symbol*> symbols;
    do {
        Symbol* symbol = declarator(head, kind);
        if (symbol) symbols.push_back(symbol);
    } while (!panic_ && accept(Punct::Comma));
    return ast_.arena.copy(symbols);
}

Stmt* Parser::expression_statement() {
    uint32_t at = next_;
    bool two_names = token(1).kind == TokenKind::Identifier;  // "retrun x;"
    meant_ = two_names ? resembled_word() : "";
    std::vector<Stmt*> parts;
    do {
        auto* node = make<ExpressionStmt>({});
        uint32_t begin = next_;
        node->expression = effect();
        if (panic_) break;
        node->span = span_from(begin);
        bool lost = next_ == begin + 1 && ast_.tokens.tokens[begin].lost;
        if (lost)
            recovery_.lose_any_name();
        else
            parts.push_back(node);
    } while (accept(Punct::Comma));
    expect_semicolon();
    meant_.clear();
    if (parts.empty()) return nullptr;
    if (panic_ || parts.size() == 1) return panic_ ? nullptr : parts[0];
    auto* all = make<BlockStmt>(span_from(at));  // "a = 1, b = 2;" as in C
    all->body = ast_.arena.copy(parts);
    return all;
}

// An expression whose value nobody takes: there "i++" and "--i" of C can only mean one thing.
Expr* Parser::effect() {
    uint32_t at = next_;
    if (is(Punct::Increment) || is(Punct::Decrement)) {
        advance();
        return step(unary(), at);
    }
    Expr* value = expression();
    bool variable = value->kind == ExprKind::Variable || value->kind == ExprKind::Index;
    if (panic_ || !variable || !(is(Punct::Increment) || is(Punct::Decrement))) return value;
    at = next_;
    advance();
    return step(value, at);
}

// target += 1 for the "++" that is token `at`.
Expr* Parser::step(Expr* target, uint32_t at) {
    const Token& sign = ast_.tokens.tokens[at];
    bool up = sign.punct == Punct::Increment;
    const char* meant = up ? "+= 1" : "-= 1";
    if (!panic_)
        reporter_.report(Code::RSL_INCREMENT, sign, sign.text, meant).help =
            fmt::format("write 'i {}'", meant);
    auto* one = make<NumberExpr>(SourceSpan{sign.where, at});
    one->value = 1;
    auto* node = make<AssignExpr>(span_from(target->span, at));
    node->op = up ? Op::Add : Op::Subtract;
    node->target = target;
    node->value = one;
    return node;
}

// "( expression )" of if and while. A bare '=' in it is probably a mistake.
Expr* Parser::condition() {
    uint32_t open = next_;
    expect(Punct::LeftParen, "'('");
    bool wrapped = is(Punct::LeftParen);
    Expr* value = expression();
    if (!panic_) expect(Punct::RightParen, "')'");
    const auto* assign = as_if<AssignExpr>(value);
    if (!panic_ && assign && assign->op == Op::None && !wrapped)
        reporter_.report(Code::RSL_ASSIGN_IN_CONDITION, ast_.tokens.tokens[assign->span.token]);
    leave_header(open);
    return value;
}

Stmt* Parser::if_statement() {
    auto* node = make<IfStmt>(SourceSpan{token().where, next_});
    advance();
    node->condition = condition();
    if (panic_) return nullptr;
    bool then = token().text == "then" &&
                (token(1).kind == TokenKind::Identifier || is(Punct::LeftBrace, 1));
    if (then) {
        reporter_.report(Code::RSL_NOT_RSL, token(), "'then'").help = "leave it out";
        advance();
    }
    node->yes = body_statement();
    if (!panic_ && else_if_word()) {
        reporter_.report(Code::RSL_NOT_RSL, token(), fmt::format("'{}'", token().text)).help =
            "write 'else if'";
        node->no = if_statement();
    } else if (!panic_ && accept(Word::Else)) {
        node->no = body_statement();
    }
    return node;
}

Stmt* Parser::while_statement() {
    auto* node = make<WhileStmt>(SourceSpan{token().where, next_});
    advance();
    node->condition = condition();
    if (panic_) return nullptr;
    node->body = body_statement();
    return node;
}

Stmt* Parser::for_statement() {
    auto* node = make<ForStmt>(SourceSpan{token().where, next_});
    advance();
    uint32_t open = next_;
    expect(Punct::LeftParen, "'('");
    std::vector<Stmt*> init;
    if (!panic_ && at_declaration()) {
        if (Stmt* declared = declaration_statement()) init.push_back(declared);
    } else if (!panic_ && !accept(Punct::Semicolon)) {
        for (Expr* item : expression_list(Punct::Semicolon, "';'")) {
            auto* stmt = make<ExpressionStmt>(item->span);
            stmt->expression = item;
            init.push_back(stmt);
        }
    }
    node->init = ast_.arena.copy(init);
    if (!panic_ && !is(Punct::Semicolon)) node->condition = expression();
    if (!panic_) expect(Punct::Semicolon, "';'");
    if (!panic_ && !accept(Punct::RightParen)) {
        std::vector<Expr*> steps;
        do steps.push_back(effect());
        while (!panic_ && accept(Punct::Comma));
        if (!panic_) expect(Punct::RightParen, "')'");
        node->step = ast_.arena.copy(steps);
    }
    leave_header(open);
    if (panic_) return nullptr;
    node->body = body_statement();
    return node;
}

// break; break 2; continue; continue 2;
Stmt* Parser::jump_statement(Word word) {
    uint32_t at = next_;
    advance();
    int levels = 1;
    if (token().kind == TokenKind::Number) {
        const Token& count = token();
        levels = int(constant_length(*number()));
        if (levels < 1) {
            error(Code::RSL_ARGUMENT_FORM, count, word == Word::Break ? "'break'" : "'continue'",
                  "a whole number of loops");
            return nullptr;
        }
    }
    SourceSpan span = span_from(at);
    expect_semicolon();
    if (word == Word::Break) {
        auto* node = make<BreakStmt>(span);
        node->levels = levels;
        return node;
    }
    auto* node = make<ContinueStmt>(span);
    node->levels = levels;
    return node;
}

Stmt* Parser::return_statement() {
    uint32_t at = next_;
    auto* node = make<ReturnStmt>({});
    advance();
    if (!is(Punct::Semicolon) && !is(Punct::RightBrace)) node->value = expression();
    if (panic_) return nullptr;
    if (function_ && node->value) function_->returns = true;
    if (!function_ && !node->value && !shader_return_) shader_return_ = node;
    node->span = span_from(at);
    expect_semicolon();
    return node;
}

// "keyword ( arguments )" of the statements about lights and rays; false after an error.
bool Parser::head(Stmt& node, std::span<Expr*>& args) {
    uint32_t at = next_;
    advance();
    args = arguments();
    node.span = span_from(at);
    return !panic_;
}

Stmt* Parser::illuminance_statement() {
    auto* node = make<IlluminanceStmt>({});
    if (!head(*node, node->args)) return nullptr;
    node->body = body_statement();
    return node;
}

Stmt* Parser::illuminate_statement() {
    auto* node = make<IlluminateStmt>({});
    std::span<Expr*> args;
    if (!head(*node, args)) return nullptr;
    if (args.size() != 1 && args.size() != 3) {
        reporter_.report(Code::RSL_ARGUMENT_FORM, node->span.where, 0, {}, "illuminate",
                         "(position) or (position, axis, angle)");
        return nullptr;
    }
    node->position = args[0];
    if (args.size() == 3) {
        node->axis = args[1];
        node->angle = args[2];
    }
    node->body = body_statement();
    return node;
}

Stmt* Parser::solar_statement() {
    auto* node = make<SolarStmt>({});
    std::span<Expr*> args;
    if (!head(*node, args)) return nullptr;
    if (args.size() > 2) {
        reporter_.report(Code::RSL_ARGUMENT_FORM, node->span.where, 0, {}, "solar",
                         "() or (axis, angle)");
        return nullptr;
    }
    if (!args.empty()) node->axis = args[0];
    if (args.size() == 2) node->angle = args[1];
    node->body = body_statement();
    return node;
}

Stmt* Parser::gather_statement() {
    auto* node = make<GatherStmt>({});
    if (!head(*node, node->args)) return nullptr;
    node->body = body_statement();
    if (!panic_ && accept(Word::Else)) node->missed = body_statement();
    return node;
}

}  // namespace kinora::rsl
