// rsl/syntax/parse_object.cpp: classes and structs of RSL 2.0.
#include "rsl/syntax/parse_object.h"

#include <algorithm>

namespace kinora::rsl {

bool ObjectParser::at_class() const {
    return cursor_.token().text == "class" && cursor_.token(1).kind == TokenKind::Identifier &&
           (cursor_.is(Punct::LeftParen, 2) || cursor_.is(Punct::LeftBrace, 2));
}

bool ObjectParser::at_struct() const {
    return cursor_.token().text == "struct" && cursor_.token(1).kind == TokenKind::Identifier &&
           (cursor_.is(Punct::LeftBrace, 2) || cursor_.is(Punct::Colon, 2));
}

// "public" or "private" before a member or method. Whether it was public.
bool ObjectParser::accept_access() {
    bool accessible = false;
    for (std::string_view word = cursor_.token().text;
         (word == "public" || word == "private") && cursor_.token(1).kind == TokenKind::Identifier;
         word = cursor_.token().text) {
        accessible = word == "public";
        cursor_.advance();
    }
    return accessible;
}

void ObjectParser::item(std::vector<Stmt*>& members, std::vector<Function*>& methods) {
    bool accessible = accept_access();
    if (at_struct()) return struct_definition();
    if (cursor_.is_detail() && statements_.at_function(1)) cursor_.advance();
    if (statements_.at_function()) {
        if (Function* method = statements_.function()) methods.push_back(method);
    } else if (declarations_.at_declaration()) {
        Stmt* member = statements_.declaration_statement();
        if (!member) return;
        for (Symbol* symbol : as<DeclareStmt>(*member).symbols) symbol->accessible = accessible;
        members.push_back(member);
    } else {
        no_item();
    }
}

void ObjectParser::no_item() {
    const Token& first = cursor_.token();
    bool named = cursor_.token(1).kind == TokenKind::Identifier;
    if (cursor_.is_type() && named && cursor_.is(Punct::LeftParen, 2)) {
        cursor_.move_to(cursor_.after_parens(cursor_.position() + 2));
        return errors_.syntax_error("the method's body, '{ ... }',");
    }
    for (uint32_t k = cursor_.position(); named && k + 1 < cursor_.all().size(); ++k) {
        if (cursor_.at(k).text != "struct" || cursor_.at(k + 1).text != first.text) continue;
        errors_.report(Code::RSL_STRUCT_LATER, first, first.text)
            .notes.push_back({cursor_.at(k + 1).where, "defined here"});
        while (!cursor_.is(Punct::Semicolon) && !cursor_.at_end()) cursor_.advance();
        return errors_.mark_broken();
    }
    errors_.syntax_error("a member or method");
}

// "{ items }".
void ObjectParser::items(std::vector<Stmt*>& members, std::vector<Function*>& methods) {
    uint32_t open = cursor_.position();
    if (!errors_.expect(Punct::LeftBrace, "'{'")) return;
    while (!cursor_.is(Punct::RightBrace) && !cursor_.at_end() && !errors_.full()) {
        if (cursor_.accept(Punct::Semicolon)) continue;
        uint32_t before = cursor_.position();
        item(members, methods);
        errors_.leave_statement(before);
        if (cursor_.position() == before && !cursor_.is(Punct::RightBrace)) cursor_.advance();
    }
    if (cursor_.accept(Punct::RightBrace)) return;
    errors_.report(Code::RSL_UNCLOSED, cursor_.at(open), '{');
    errors_.mark_broken();
}

void ObjectParser::class_definition() {
    uint32_t at = cursor_.position();
    cursor_.advance();
    auto* shader = ast_.arena.make<ShaderDefinition>();
    shader->span = SourceSpan{cursor_.token().where, at};
    shader->name = errors_.expect_name("a class name");
    open_.begin_shader();
    if (cursor_.is(Punct::LeftParen))
        shader->parameters = declarations_.parameters(SymbolKind::Parameter);
    if (errors_.panic()) return;
    std::vector<Stmt*> members;
    std::vector<Function*> methods;
    items(members, methods);
    shader->shader_class = ast_.arena.make<ClassDefinition>();
    shader->shader_class->members = ast_.arena.copy(members);
    shader->shader_class->methods = ast_.arena.copy(methods);
    shader->body = ast_.make<BlockStmt>(shader->span);
    ast_.shaders.push_back(shader);
}

// Headers that are included twice define a struct again; the tokens from `begin` on are compared.
bool ObjectParser::same_struct_again(uint32_t begin) {
    auto end_of = [&](uint32_t at) {
        int depth = 0;
        for (const auto& tokens = cursor_.all(); at < tokens.size(); ++at) {
            depth += tokens[at].punct == Punct::LeftBrace;
            depth -= tokens[at].punct == Punct::RightBrace;
            if (tokens[at].punct == Punct::RightBrace && depth == 0) return at + 1;
        }
        return at;
    };
    const StructDefinition* other = declarations_.find_struct(cursor_.at(begin + 1).text);
    if (!other) return false;
    uint32_t end = end_of(begin), other_end = end_of(other->span.token);
    auto same = [](const Token& a, const Token& b) { return a.text == b.text; };
    if (!std::equal(cursor_.all().begin() + begin, cursor_.all().begin() + end,
                    cursor_.all().begin() + other->span.token, cursor_.all().begin() + other_end,
                    same))
        errors_.report(Code::RSL_REDEFINED, cursor_.at(begin + 1), other->name)
            .notes.push_back({other->span.where, "first defined here"});
    cursor_.move_to(end);
    return true;
}

// ": BASE": the items of the base are read again, as if they stood here. False after an error.
bool ObjectParser::inherit(std::vector<Stmt*>& members, std::vector<Function*>& methods) {
    const Token& name = cursor_.token();
    const StructDefinition* base = declarations_.find_struct(name.text);
    if (!base) {
        errors_.syntax_error("the name of a struct that is defined before");
        return false;
    }
    cursor_.advance();
    uint32_t here = cursor_.position();
    cursor_.move_to(base->span.token + 2);
    bool good = !cursor_.accept(Punct::Colon) || inherit(members, methods);
    if (good) items(members, methods);
    cursor_.move_to(here);
    for (Function* method : methods)
        if (method->base.empty()) method->base = base->name;
    return good;
}

// Inherited methods, from `first` on, for which one of the struct's own or of a nearer base stands
// are called as "BASE::method()" alone.
void ObjectParser::hide_overridden(std::span<Function*> methods, size_t first) {
    auto same_form = [](const Function& a, const Function& b) {
        return a.name == b.name &&
               std::equal(a.parameters.begin(), a.parameters.end(), b.parameters.begin(),
                          b.parameters.end(), [](const Symbol* x, const Symbol* y) {
                              return x->type == y->type && x->structure == y->structure;
                          });
    };
    for (size_t k = first; k < methods.size(); ++k) {
        auto stands_for_it = [&](const Function* f) { return same_form(*f, *methods[k]); };
        bool hidden =
            std::any_of(methods.begin(), methods.begin() + ptrdiff_t(first), stands_for_it) ||
            std::any_of(methods.begin() + ptrdiff_t(k) + 1, methods.end(), stands_for_it);
        if (hidden)
            methods[k]->name = ast_.arena.copy(std::string(methods[k]->base) +
                                               "::" + std::string(methods[k]->name));
    }
}

void ObjectParser::struct_definition() {
    uint32_t at = cursor_.position();
    if (same_struct_again(at)) return;
    cursor_.advance();
    auto* structure = ast_.arena.make<StructDefinition>();
    structure->span = SourceSpan{cursor_.token().where, at};
    structure->name = cursor_.token().text;
    cursor_.advance();
    std::vector<Stmt*> declarations;
    std::vector<Function*> inherited, methods;
    if (cursor_.accept(Punct::Colon) && !inherit(declarations, inherited)) return;
    ast_.structs.push_back(structure);
    items(declarations, methods);
    methods.insert(methods.end(), inherited.begin(), inherited.end());
    hide_overridden(methods, methods.size() - inherited.size());
    std::vector<Symbol*> members;
    for (Stmt* stmt : declarations)
        for (Symbol* symbol : as<DeclareStmt>(*stmt).symbols) members.push_back(symbol);
    structure->members = ast_.arena.copy(members);
    structure->methods = ast_.arena.copy(methods);
}

}  // namespace kinora::rsl
