// rsl/syntax/parse_statement.cpp: blocks, functions, control flow, light statements.
#include "rsl/syntax/parse_statement.h"

#include <utility>

namespace kinora::rsl {

BlockStmt* StatementParser::block() {
    uint32_t at = cursor_.position();
    auto* node = make<BlockStmt>(SourceSpan{cursor_.token().where, at});
    // A body whose '{' is left out goes on with a declaration or statement.
    bool whole = cursor_.token().kind == TokenKind::Identifier && cursor_.position() > 0 &&
                 !cursor_.begins_definition();
    if (!cursor_.is(Punct::LeftBrace) && whole) {
        errors_.missing_behind("'{'");
        errors_.mark_broken();
        unclosed_ = true;  // which '}' ends what nobody knows
    } else if (!errors_.expect(Punct::LeftBrace, "'{'")) {
        return node;
    }
    std::vector<Stmt*> body;
    while (!cursor_.is(Punct::RightBrace) && !cursor_.at_end() && !cursor_.begins_shader() &&
           !errors_.full()) {
        uint32_t before = cursor_.position();
        Stmt* stmt = statement();
        skipped_ = errors_.panic();
        errors_.leave_statement(before);
        if (stmt) body.push_back(stmt);
        if (cursor_.position() == before && !cursor_.is(Punct::RightBrace)) cursor_.advance();
    }
    if (!cursor_.accept(Punct::RightBrace) && !std::exchange(unclosed_, true)) {
        Finding& finding = errors_.report(Code::RSL_UNCLOSED, cursor_.at(at), '{');
        if (!cursor_.at_end())
            finding.help =
                fmt::format("before {} '{}'", cursor_.token().text, cursor_.token(1).text);
        errors_.mark_broken();
    }
    node->body = ast_.arena.copy(body);
    node->span = cursor_.span_from(at);
    return node;
}

Stmt* StatementParser::statement() {
    Nesting::Level level(nesting_);
    if (!nesting_.too_deep()) return statement_unguarded();
    errors_.error(Code::RSL_TOO_DEEP, cursor_.token(), fmt::format("{} levels", kMostNesting));
    return nullptr;
}

// Null for an empty or broken statement.
Stmt* StatementParser::statement_unguarded() {
    if (cursor_.accept(Punct::Semicolon)) return nullptr;
    if (cursor_.is(Punct::LeftBrace)) return block();
    bool call = cursor_.is(Punct::LeftParen, 1);
    switch (cursor_.token().word) {
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
            return jump_statement(cursor_.token().word);
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
    if (cursor_.token().text == "struct" && cursor_.token(1).kind == TokenKind::Identifier &&
        (cursor_.is(Punct::LeftBrace, 2) || cursor_.is(Punct::Colon, 2))) {
        local_struct_();
        return empty_statement();
    }
    if (foreign_.missing_statement()) return nullptr;
    if (foreign_.misspelt_statement()) return statement_unguarded();
    if (cursor_.is_detail() && at_function(1))
        cursor_.advance();  // the detail of a result is inferred
    if (at_function()) return function_statement();
    if (declarations_.at_declaration()) return declaration_statement();
    return expression_statement();
}

// The statement that another one governs; empty where it is broken.
Stmt* StatementParser::body_statement() {
    uint32_t begin = cursor_.position();
    Stmt* stmt = statement();
    errors_.leave_statement(begin);
    return stmt ? stmt : empty_statement();
}

// After an error between the parentheses of a statement: on behind them, if they are closed.
void StatementParser::leave_header(uint32_t open) {
    const auto& tokens = cursor_.all();
    if (!errors_.panic() || errors_.stopped() || cursor_.after_reported() ||
        tokens[open].punct != Punct::LeftParen)
        return;
    uint32_t behind = cursor_.after_parens(open);
    bool closed = behind + 1 < tokens.size() && behind >= cursor_.position();
    if (!closed && !cursor_.is(Punct::LeftBrace)) return;
    errors_.resume_at(closed ? behind : cursor_.position(), open);
}

Stmt* StatementParser::empty_statement() {
    return make<BlockStmt>(SourceSpan{cursor_.token().where, cursor_.position()});
}

// ---- functions and declarations -----------------------------------------------------------------

Stmt* StatementParser::function_statement() {
    auto* node = make<FunctionStmt>(SourceSpan{cursor_.token().where, cursor_.position()});
    node->function = function();
    return node->function ? node : nullptr;
}

// A missing type means float, as the specification has it, or void where nothing is returned.
Function* StatementParser::function() {
    auto* f = ast_.arena.make<Function>();
    f->result = {BaseType::Float, -1};
    const StructDefinition* structure = declarations_.struct_type();
    bool foreign = !structure && foreign_.at_type();
    f->result_handle = cursor_.is_handle() && cursor_.is(Punct::LeftParen, 2);
    f->typed = foreign || structure || f->result_handle ||
               (cursor_.is_type() && !cursor_.is(Punct::LeftParen, 1));
    if (structure) {
        f->result = {BaseType::Void, -1};
        f->result_structure = structure;
        cursor_.advance();
    } else if (f->result_handle) {
        cursor_.advance();
    } else if (foreign) {
        foreign_.accept_type(f->result.base);
    } else if (f->typed) {
        f->result.base = type_from_name(cursor_.token().text);
        cursor_.advance();
    }
    f->span = SourceSpan{cursor_.token().where, cursor_.position()};
    f->name = errors_.expect_name("a function name");
    f->id = ast_.function_count++;
    definition_.begin_function(*f);
    uint32_t breaks = errors_.breaks();
    f->parameters = declarations_.parameters(SymbolKind::FunctionParameter);
    if (!errors_.panic()) f->body = block();
    f->damaged = errors_.breaks() != breaks;
    definition_.end_function(*f);
    if (!f->typed && !f->returns) f->result.base = BaseType::Void;
    return f->body ? f : nullptr;
}

bool StatementParser::at_function(uint32_t ahead) const {
    int at = int(ahead);
    bool typed = (cursor_.is_type(at) && !cursor_.is(Punct::LeftParen, at + 1)) ||
                 declarations_.struct_type(at) || foreign_.at_type(at) || cursor_.is_handle(at);
    uint32_t name = cursor_.position() + ahead + typed;
    const auto& tokens = cursor_.all();
    if (name + 1 >= tokens.size() || tokens[name].kind != TokenKind::Identifier) return false;
    if (tokens[name + 1].punct != Punct::LeftParen) return false;
    // Parameters may hold semicolons but no braces, unless as array defaults, which functions lack.
    return tokens[cursor_.after_parens(name + 1)].punct == Punct::LeftBrace;
}

Stmt* StatementParser::declaration_statement() {
    uint32_t at = cursor_.position();
    DeclarationHead head;
    if (!declarations_.read_head(head)) return nullptr;
    auto* node = make<DeclareStmt>({});
    node->symbols = declarations_.locals(head);
    node->span = cursor_.span_from(at);
    errors_.expect_semicolon();
    return node;
}

Stmt* StatementParser::extern_statement() {
    uint32_t at = cursor_.position();
    cursor_.advance();
    DeclarationHead head;
    if (!declarations_.read_head(head)) return nullptr;
    auto* node = make<ExternStmt>({});
    node->symbols = declarations_.locals(head);
    node->span = cursor_.span_from(at);
    errors_.expect_semicolon();
    return node;
}

Stmt* StatementParser::expression_statement() {
    uint32_t at = cursor_.position();
    bool two_names = cursor_.token(1).kind == TokenKind::Identifier;  // "retrun x;"
    errors_.set_meant(two_names ? std::string(foreign_.resembled_word()) : "");
    std::vector<Stmt*> parts;
    do {
        auto* node = make<ExpressionStmt>({});
        uint32_t begin = cursor_.position();
        node->expression = effect();
        if (errors_.panic()) break;
        node->span = cursor_.span_from(begin);
        bool lost = cursor_.position() == begin + 1 && cursor_.at(begin).lost;
        if (lost)
            errors_.recovery().lose_any_name();
        else
            parts.push_back(node);
    } while (cursor_.accept(Punct::Comma));
    errors_.expect_semicolon();
    errors_.set_meant("");
    if (parts.empty()) return nullptr;
    if (errors_.panic() || parts.size() == 1) return errors_.panic() ? nullptr : parts[0];
    auto* all = make<BlockStmt>(cursor_.span_from(at));  // "a = 1, b = 2;" as in C
    all->body = ast_.arena.copy(parts);
    return all;
}

// An expression whose value nobody takes: there "i++" and "--i" of C can only mean one thing.
Expr* StatementParser::effect() {
    uint32_t at = cursor_.position();
    if (cursor_.is(Punct::Increment) || cursor_.is(Punct::Decrement)) {
        cursor_.advance();
        return step(expressions_.unary(), at);
    }
    Expr* value = expressions_.expression();
    bool variable = value->kind == ExprKind::Variable || value->kind == ExprKind::Index;
    if (errors_.panic() || !variable ||
        !(cursor_.is(Punct::Increment) || cursor_.is(Punct::Decrement)))
        return value;
    at = cursor_.position();
    cursor_.advance();
    return step(value, at);
}

// target += 1 for the "++" that is token `at`.
Expr* StatementParser::step(Expr* target, uint32_t at) {
    const Token& sign = cursor_.at(at);
    bool up = sign.punct == Punct::Increment;
    const char* meant = up ? "+= 1" : "-= 1";
    if (!errors_.panic())
        errors_.report(Code::RSL_INCREMENT, sign, sign.text, meant).help =
            fmt::format("write 'i {}'", meant);
    auto* one = make<NumberExpr>(SourceSpan{sign.where, at});
    one->value = 1;
    auto* node = make<AssignExpr>(cursor_.span_from(target->span, at));
    node->op = up ? Op::Add : Op::Subtract;
    node->target = target;
    node->value = one;
    return node;
}

// "( expression )" of if and while. A bare '=' in it is probably a mistake.
// PRMan's 'if "any" (condition)': each point is a grid of its own, as for gridmin(), so that the
// word changes nothing.
void StatementParser::skip_grid_word() {
    std::string_view text = cursor_.token().text;
    if (cursor_.is(Punct::LeftParen, 1) && (text == "\"any\"" || text == "\"all\""))
        cursor_.advance();
}

Expr* StatementParser::condition() {
    skip_grid_word();
    uint32_t open = cursor_.position();
    errors_.expect(Punct::LeftParen, "'('");
    bool wrapped = cursor_.is(Punct::LeftParen);
    Expr* value = expressions_.expression();
    if (!errors_.panic()) errors_.expect(Punct::RightParen, "')'");
    const auto* assign = as_if<AssignExpr>(value);
    if (!errors_.panic() && assign && assign->op == Op::None && !wrapped)
        errors_.report(Code::RSL_ASSIGN_IN_CONDITION, cursor_.at(assign->span.token));
    leave_header(open);
    return value;
}

Stmt* StatementParser::if_statement() {
    auto* node = make<IfStmt>(SourceSpan{cursor_.token().where, cursor_.position()});
    cursor_.advance();
    node->condition = condition();
    if (errors_.panic()) return nullptr;
    foreign_.accept_then();
    node->yes = body_statement();
    if (!errors_.panic() && foreign_.at_else_if()) {
        node->no = if_statement();
    } else if (!errors_.panic() && cursor_.accept(Word::Else)) {
        node->no = body_statement();
    }
    return node;
}

// An else that no if stands before: reported, and its statement read.
Stmt* StatementParser::lonely_else() {
    if (!skipped_)
        errors_.report(Code::RSL_SYNTAX, cursor_.token(), "a statement", "'else'").help =
            "an else stands behind the one statement of its if; a ';' or a missing brace parts "
            "them";
    cursor_.advance();
    return statement();
}

Stmt* StatementParser::while_statement() {
    auto* node = make<WhileStmt>(SourceSpan{cursor_.token().where, cursor_.position()});
    cursor_.advance();
    node->condition = condition();
    if (errors_.panic()) return nullptr;
    node->body = body_statement();
    return node;
}

Stmt* StatementParser::for_statement() {
    auto* node = make<ForStmt>(SourceSpan{cursor_.token().where, cursor_.position()});
    cursor_.advance();
    skip_grid_word();
    uint32_t open = cursor_.position();
    errors_.expect(Punct::LeftParen, "'('");
    node->init = for_initial();
    if (!errors_.panic() && !cursor_.is(Punct::Semicolon))
        node->condition = expressions_.expression();
    if (!errors_.panic()) errors_.expect(Punct::Semicolon, "';'");
    node->step = for_step();
    leave_header(open);
    if (errors_.panic()) return nullptr;
    node->body = body_statement();
    return node;
}

// A declaration, or expressions with ','; and the ';'.
std::span<Stmt*> StatementParser::for_initial() {
    std::vector<Stmt*> statements;
    if (!errors_.panic() && declarations_.at_declaration()) {
        if (Stmt* declared = declaration_statement()) statements.push_back(declared);
    } else if (!errors_.panic() && !cursor_.accept(Punct::Semicolon)) {
        for (Expr* item : expressions_.expression_list(Punct::Semicolon, "';'")) {
            auto* stmt = make<ExpressionStmt>(item->span);
            stmt->expression = item;
            statements.push_back(stmt);
        }
    }
    return ast_.arena.copy(statements);
}

// What is done at the end of each turn; and the ')'.
std::span<Expr*> StatementParser::for_step() {
    if (errors_.panic() || cursor_.accept(Punct::RightParen)) return {};
    std::vector<Expr*> steps;
    do steps.push_back(effect());
    while (!errors_.panic() && cursor_.accept(Punct::Comma));
    if (!errors_.panic()) errors_.expect(Punct::RightParen, "')'");
    return ast_.arena.copy(steps);
}

// break; break 2; continue; continue 2;
Stmt* StatementParser::jump_statement(Word word) {
    uint32_t at = cursor_.position();
    cursor_.advance();
    int levels = 1;
    if (cursor_.token().kind == TokenKind::Number) {
        const Token& count = cursor_.token();
        levels = int(constant_length(*expressions_.number()));
        if (levels < 1) {
            errors_.error(Code::RSL_ARGUMENT_FORM, count,
                          word == Word::Break ? "'break'" : "'continue'",
                          "a whole number of loops");
            return nullptr;
        }
    }
    SourceSpan span = cursor_.span_from(at);
    errors_.expect_semicolon();
    if (word == Word::Break) {
        auto* node = make<BreakStmt>(span);
        node->levels = levels;
        return node;
    }
    auto* node = make<ContinueStmt>(span);
    node->levels = levels;
    return node;
}

Stmt* StatementParser::return_statement() {
    uint32_t at = cursor_.position();
    auto* node = make<ReturnStmt>({});
    cursor_.advance();
    if (!cursor_.is(Punct::Semicolon) && !cursor_.is(Punct::RightBrace))
        node->value = expressions_.expression();
    if (errors_.panic()) return nullptr;
    definition_.add_return(*node);
    node->span = cursor_.span_from(at);
    errors_.expect_semicolon();
    return node;
}

// "keyword ( arguments )" of the statements about lights and rays; false after an error.
bool StatementParser::head(Stmt& node, std::span<Expr*>& args) {
    uint32_t at = cursor_.position();
    cursor_.advance();
    args = expressions_.arguments();
    node.span = cursor_.span_from(at);
    return !errors_.panic();
}

Stmt* StatementParser::illuminance_statement() {
    auto* node = make<IlluminanceStmt>({});
    if (!head(*node, node->args)) return nullptr;
    node->body = body_statement();
    return node;
}

Stmt* StatementParser::illuminate_statement() {
    auto* node = make<IlluminateStmt>({});
    std::span<Expr*> args;
    if (!head(*node, args)) return nullptr;
    if (args.size() != 1 && args.size() != 3) {
        errors_.report(Code::RSL_ARGUMENT_FORM, node->span.where, 0, "illuminate",
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

Stmt* StatementParser::solar_statement() {
    auto* node = make<SolarStmt>({});
    std::span<Expr*> args;
    if (!head(*node, args)) return nullptr;
    if (args.size() > 2) {
        errors_.report(Code::RSL_ARGUMENT_FORM, node->span.where, 0, "solar",
                       "() or (axis, angle)");
        return nullptr;
    }
    if (!args.empty()) node->axis = args[0];
    if (args.size() == 2) node->angle = args[1];
    node->body = body_statement();
    return node;
}

Stmt* StatementParser::gather_statement() {
    auto* node = make<GatherStmt>({});
    if (!head(*node, node->args)) return nullptr;
    node->body = body_statement();
    if (!errors_.panic() && cursor_.accept(Word::Else)) node->missed = body_statement();
    return node;
}

}  // namespace kinora::rsl
