// rsl/syntax/parse_declaration.cpp: parameters, types and declarators.
#include "rsl/syntax/parse_declaration.h"

#include <algorithm>

#include "rsl/syntax/ast_parts.h"

namespace kinora::rsl {

std::span<Symbol*> DeclarationParser::parameters(SymbolKind kind) {
    std::vector<Symbol*> symbols;
    if (cursor_.is(Punct::LeftBrace) && kind == SymbolKind::Parameter) {
        errors_.report(Code::RSL_MISSING_PARENTHESES, cursor_.token());
        return {};
    }
    if (!errors_.expect(Punct::LeftParen, "'('")) return {};
    if (cursor_.is(Word::Void) && cursor_.is(Punct::RightParen, 1)) cursor_.advance();  // as in C
    DeclarationHead head{{BaseType::Float, -1}, nullptr, Detail::Unspecified, false};
    bool have_type = false;
    uint32_t begin = cursor_.position();  // of the parameter being read
    while (!errors_.panic() && !cursor_.is(Punct::RightParen) && !cursor_.is(Punct::LeftBrace)) {
        if (cursor_.is(Punct::Comma) || cursor_.is(Punct::Semicolon)) {
            have_type = have_type && !cursor_.is(Punct::Semicolon);
            cursor_.advance();
            begin = cursor_.position();
            continue;
        }
        if (((cursor_.is_type() || cursor_.is_detail()) &&
             !(have_type && cursor_.word_as_name())) ||
            struct_type() || foreign_.at_type() || cursor_.is_handle()) {
            if (!read_head(head)) {
                if (errors_.stopped() || !resume_parameters(begin)) break;
                continue;
            }
            have_type = true;
        } else if (!have_type && cursor_.token().kind == TokenKind::Identifier) {
            errors_.report(Code::RSL_MISSING_TYPE, cursor_.token(), cursor_.token().text,
                           type_name(head.type.base));
            have_type = true;
        }
        Symbol* symbol = declarator(head, kind);
        if (symbol) symbols.push_back(symbol);
        if (errors_.panic() && !resume_parameters(begin)) break;
        bool separated = cursor_.is(Punct::Comma) || cursor_.is(Punct::Semicolon);
        if (separated || cursor_.is(Punct::RightParen) || cursor_.is(Punct::LeftBrace)) continue;
        if (cursor_.is_type() || cursor_.is_detail())
            errors_.missing_behind("';'");
        else
            errors_.syntax_error("',' or ')'");
        if (errors_.panic() && !resume_parameters(begin)) break;
        begin = cursor_.position();
    }
    if (!errors_.panic()) end_of_parameters();
    return ast_.arena.copy(symbols);
}

void DeclarationParser::end_of_parameters() {
    if (cursor_.is(Punct::LeftBrace))
        errors_.missing_behind("')'");
    else
        errors_.expect(Punct::RightParen, "')'");
}

// Whether the token behind a ',' goes on with parameters, not with the arguments of a broken value.
bool DeclarationParser::is_parameter(uint32_t index) const {
    int ahead = int(index) - int(cursor_.position());
    return cursor_.is_type(ahead) || cursor_.is_detail(ahead) ||
           (cursor_.token(ahead).kind == TokenKind::Identifier &&
            cursor_.is(Punct::Assign, ahead + 1));
}

// After an error among parameters: to the next ';' or ',' between them, or to the ')' before the
// body. False where the body comes first.
bool DeclarationParser::resume_parameters(uint32_t begin) {
    if (cursor_.after_reported()) return false;
    const auto& tokens = cursor_.all();
    bool in_list = false;
    for (uint32_t i = cursor_.position(); i + 1 < tokens.size(); ++i) {
        Punct punct = tokens[i].punct, behind = tokens[i + 1].punct;
        bool list = punct == Punct::LeftBrace && i > 0 && tokens[i - 1].punct == Punct::Assign;
        if (punct == Punct::LeftBrace && !list) return false;
        bool ends = behind == Punct::Comma || behind == Punct::Semicolon;
        if (punct == Punct::RightBrace && !in_list && !ends) return false;
        in_list = list || (in_list && punct != Punct::RightBrace);
        bool last = punct == Punct::RightParen && behind == Punct::LeftBrace;
        bool between = punct == Punct::Semicolon || (punct == Punct::Comma && is_parameter(i + 1));
        if (!last && !between) continue;
        errors_.resume_at(i, begin, true);
        return true;
    }
    return false;
}

// ---- declarations -------------------------------------------------------------------------------

bool DeclarationParser::read_head(DeclarationHead& head) {
    head = DeclarationHead{};
    while (true) {
        if (cursor_.is(Word::Output)) head.output = true;
        head.constant = head.constant || cursor_.is_constant();
        if (cursor_.is(Word::Uniform) || cursor_.is_constant()) head.detail = Detail::Uniform;
        if (cursor_.is(Word::Varying)) head.detail = Detail::Varying;
        if (const StructDefinition* structure = struct_type()) {
            head.structure = structure;
            head.type.base = BaseType::Invalid;
            cursor_.advance();
            return true;
        }
        if (cursor_.is_handle()) {
            head.handle = true;
            head.type.base = BaseType::Float;
            cursor_.advance();
            return true;
        }
        if (cursor_.is_detail())
            cursor_.advance();
        else if (!foreign_.accept_type(head.type.base))
            break;
        else if (head.type.base != BaseType::Invalid)
            return true;
    }
    if (!cursor_.is_type()) {
        errors_.syntax_error("a type");
        return false;
    }
    head.type.base = type_from_name(cursor_.token().text);
    cursor_.advance();
    if (cursor_.token().kind == TokenKind::String &&
        cursor_.token(1).kind == TokenKind::Identifier) {
        errors_.report(Code::RSL_NOT_RSL, cursor_.token(), "a space in a declaration").help =
            "write it before the value, as in point p = point \"world\" (0, 0, 1)";
        cursor_.advance();
    }
    return true;
}

// "name", "name[3]", "name = value".
Symbol* DeclarationParser::declarator(const DeclarationHead& head, SymbolKind kind) {
    auto* symbol = ast_.arena.make<Symbol>();
    symbol->kind = kind;
    symbol->type = head.type;
    symbol->structure = head.structure;
    symbol->handle = head.handle;
    symbol->detail = head.detail;
    symbol->constant = head.constant;
    symbol->output = head.output;
    definition_.declare(*symbol);
    symbol->id = ast_.symbol_count++;
    symbol->span = SourceSpan{cursor_.token().where, cursor_.position()};
    symbol->name = errors_.expect_name("a variable name");
    if (errors_.panic()) return nullptr;
    if (head.type.base == BaseType::Void)
        errors_.report(Code::RSL_VOID_VARIABLE, cursor_.at(symbol->span.token), symbol->name);
    array_suffix(*symbol);
    if (!errors_.panic() && cursor_.accept(Punct::Assign)) symbol->initial = initialiser(*symbol);
    return errors_.panic() ? nullptr : symbol;
}

namespace {

// A length that is no arithmetic on numbers alone.
bool names_something(const Expr& e) {
    bool names =
        e.kind == ExprKind::Variable || e.kind == ExprKind::Call || e.kind == ExprKind::Index;
    if (e.kind == ExprKind::Binary || e.kind == ExprKind::Unary)
        for_each_operand(e, [&](const Expr* part) { names = names || names_something(*part); });
    return names;
}

}  // namespace

void DeclarationParser::array_suffix(Symbol& symbol) {
    if (!cursor_.accept(Punct::LeftBracket)) return;
    symbol.type.array_length = 0;
    bool local = symbol.kind == SymbolKind::Local;
    if (cursor_.accept(Punct::RightBracket)) {
        bool listed = cursor_.is(Punct::Assign) && cursor_.is(Punct::LeftBrace, 1) &&
                      !cursor_.is(Punct::RightBrace, 2);
        symbol.resizable = local && (ast_.resizes || !listed);
        symbol.open = symbol.kind == SymbolKind::Parameter;
        ast_.resizable_arrays = ast_.resizable_arrays || symbol.resizable;
        return;
    }
    const Token& at = cursor_.token();
    Expr* length = expressions_.expression();
    if (errors_.panic() || !errors_.expect(Punct::RightBracket, "']'")) return;
    if (cursor_.is(Punct::LeftBracket)) {
        Finding* finding = errors_.error(Code::RSL_NOT_RSL, cursor_.token(), "an array of arrays");
        if (finding) finding->help = "use one index, as in a[i * n + j]";
        return;
    }
    if (local && names_something(*length)) {
        symbol.resizable = ast_.resizable_arrays = true;
        symbol.length = length;
        return;
    }
    long value = constant_length(*length);
    if (value < 1) errors_.report(Code::RSL_BAD_ARRAY_LENGTH, at);
    symbol.type.array_length = int(std::max(value, 1l));
}

// A value, or "{a, b}" for an array, which gives an unsized array its length.
Expr* DeclarationParser::initialiser(Symbol& symbol) {
    bool open = symbol.type.array_length == 0 && !symbol.resizable;
    uint32_t at = cursor_.position();
    if (!cursor_.is(Punct::LeftBrace)) {
        Expr* value = expressions_.expression();
        const auto* number = as_if<NumberExpr>(value);
        if (!open || !number || number->value != 0) return value;
        return ast_.make<ArrayLiteralExpr>(cursor_.span_from(at));  // "T a[] = 0": no elements
    }
    cursor_.advance();
    auto* node = ast_.make<ArrayLiteralExpr>({});
    if (!cursor_.accept(Punct::RightBrace)) {
        std::vector<Expr*> items;
        while (!errors_.panic() && !cursor_.is(Punct::RightBrace)) {
            items.push_back(expressions_.expression());
            if (!cursor_.accept(Punct::Comma)) break;
        }
        if (!errors_.panic()) errors_.expect(Punct::RightBrace, "'}'");
        node->items = ast_.arena.copy(items);
    }
    node->span = cursor_.span_from(at);
    if (open) symbol.type.array_length = int(node->items.size());
    return node;
}

const StructDefinition* DeclarationParser::find_struct(std::string_view name) const {
    for (const StructDefinition* structure : ast_.structs)
        if (structure->name == name) return structure;
    return nullptr;
}

const StructDefinition* DeclarationParser::struct_type(int ahead) const {
    const Token& at = cursor_.token(ahead);
    bool names = at.kind == TokenKind::Identifier &&
                 cursor_.token(ahead + 1).kind == TokenKind::Identifier &&
                 !cursor_.is_reserved(ahead + 1);
    return names && !ast_.structs.empty() ? find_struct(at.text) : nullptr;
}

bool DeclarationParser::at_declaration() const {
    if (struct_type() || cursor_.is_handle()) return !cursor_.is(Punct::LeftParen, 2);
    if (cursor_.is(Word::Uniform) || cursor_.is(Word::Varying)) return !cursor_.word_as_name();
    if (cursor_.is_constant()) return true;
    if (cursor_.is(Word::Output))
        return cursor_.is_type(1) || cursor_.is_detail(1) || struct_type(1) || cursor_.is_handle(1);
    bool space = cursor_.is_type() && cursor_.token(1).kind == TokenKind::String &&
                 cursor_.token(2).kind == TokenKind::Identifier;
    if (space) {  // written before the name instead of the value
        Punct behind = cursor_.token(3).punct;
        return behind == Punct::Assign || behind == Punct::Semicolon ||
               behind == Punct::LeftBracket;
    }
    if (!cursor_.is_type() || cursor_.token(1).kind != TokenKind::Identifier ||
        cursor_.is(Punct::LeftParen, 2))
        return foreign_.at_type() && !cursor_.is(Punct::LeftParen, 2);
    return !cursor_.is_reserved(1);
}

std::span<Symbol*> DeclarationParser::locals(const DeclarationHead& head) {
    std::vector<Symbol*> symbols;
    do {
        Symbol* symbol = declarator(head, SymbolKind::Local);
        if (symbol) symbols.push_back(symbol);
    } while (!errors_.panic() && cursor_.accept(Punct::Comma));
    return ast_.arena.copy(symbols);
}

}  // namespace kinora::rsl
