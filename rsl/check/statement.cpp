// rsl/check/statement.cpp: functions, declarations, control flow.
#include "rsl/check/statement.h"

#include "rsl/check/overloads.h"
#include "rsl/check/shader_space.h"
#include "rsl/syntax/ast_visit.h"

namespace kinora::rsl {

void StatementChecker::statement(Stmt& stmt) {
    visit_stmt(stmt, [&](auto& node) { check(node); });
}

void StatementChecker::function(Function& f) {
    Within<Around> around(around_, {});
    Scopes::Guard scope(scopes_, &f);
    parameters(f.parameters);
    statement(*f.body);
    bool returns = around_.returned || unknown_.misspells_return(f);
    if (f.result.base != BaseType::Void && !returns && !f.damaged)
        reporter_.report(Code::RSL_MISSING_RETURN, f.span, f.name);
}

// A default may use the parameters before it and the globals.
void StatementChecker::parameters(std::span<Symbol*> parameters) {
    for (Symbol* p : parameters) {
        put_default_in_shader_space(ast_, *p);
        check_initial(*p);
        declare(*p);
    }
}

void StatementChecker::declare(Symbol& symbol) {
    const Symbol* other = scopes_.declare(symbol);
    if (!other) return;
    bool parameter = symbol.kind != SymbolKind::Local;
    reporter_
        .report(parameter ? Code::RSL_REDEFINED : Code::RSL_REDECLARED, symbol.span, symbol.name)
        .notes.push_back({other->span.where, "first declared here"});
}

void StatementChecker::declare(Function& f) {
    if (const Function* other = scopes_.declare(f))
        reporter_.report(Code::RSL_FUNCTION_REDEFINED, f.span, f.name)
            .notes.push_back({other->span.where, "first defined here"});
}

void StatementChecker::check_initial(Symbol& symbol) {
    if (symbol.length) expressions_.convert_to(symbol.length, {BaseType::Float, -1}, "a length");
    if (symbol.initial)
        expressions_.convert_to(symbol.initial, symbol.type, fmt::format("'{}'", symbol.name));
}

// ---- statements
// ----------------------------------------------------------------------------------

// Nested functions may be called before they are defined.
void StatementChecker::check(BlockStmt& s) {
    Scopes::Guard scope(scopes_);
    for (Stmt* item : s.body)
        if (auto* nested = as_if<FunctionStmt>(item)) declare(*nested->function);
    for (Stmt* item : s.body) statement(*item);
}

void StatementChecker::check(DeclareStmt& s) {
    for (Symbol* symbol : s.symbols) {
        check_initial(*symbol);
        declare(*symbol);
    }
}

// The name then means the variable outside, of which this is only a reminder.
void StatementChecker::check(ExternStmt& s) {
    for (Symbol*& symbol : s.symbols) {
        Symbol* outer = scopes_.find_variable_outside(symbol->name);
        if (!outer) {
            if (!recovery_.hides(symbol->name, symbol->span.token))
                reporter_.report(Code::RSL_EXTERN_UNKNOWN, symbol->span, symbol->name);
            outer = symbol;
        } else if (outer->type.base != symbol->type.base &&
                   !(is_triple(outer->type) && is_triple(symbol->type))) {
            reporter_.report(Code::RSL_TYPE_MISMATCH, symbol->span,
                             fmt::format("extern '{}'", symbol->name), type_name(outer->type),
                             type_name(symbol->type));
        }
        symbol = outer;
        scopes_.refer_to(*outer);
    }
}

void StatementChecker::check(FunctionStmt& s) {
    function(*s.function);
}

void StatementChecker::check(ExpressionStmt& s) {
    Expr* written = s.expression;
    expressions_.expression(s.expression, BaseType::Invalid);
    ExprKind kind = written->kind;
    if (kind != ExprKind::Assign && kind != ExprKind::Call && kind != ExprKind::Cast &&
        s.expression->type.base != BaseType::Invalid && !recovery_.touches(s.span.token))
        reporter_.report(Code::RSL_NO_EFFECT, s.span);
}

// What a single declaration declares is seen no further than in braces.
void StatementChecker::body(Stmt& s) {
    Scopes::Guard scope(scopes_);
    statement(s);
}

void StatementChecker::check(IfStmt& s) {
    expressions_.condition(s.condition);
    body(*s.yes);
    if (s.no) body(*s.no);
}

void StatementChecker::loop_body(Stmt& loop, Stmt& turn) {
    around_.loops.push_back(&loop);
    body(turn);
    around_.loops.pop_back();
}

void StatementChecker::check(WhileStmt& s) {
    expressions_.condition(s.condition);
    loop_body(s, *s.body);
}

void StatementChecker::check(ForStmt& s) {
    Scopes::Guard scope(scopes_);
    for (Stmt* item : s.init) statement(*item);
    if (s.condition) expressions_.condition(s.condition);
    for (Expr*& step : s.step) expressions_.expression(step, BaseType::Invalid);
    loop_body(s, *s.body);
}

// ---- jumps --------------------------------------------------------------------------------------

Stmt* StatementChecker::jump_target(const Stmt& jump, const char* word, int levels) {
    if (around_.loops.empty()) {
        reporter_.report(Code::RSL_BREAK_OUTSIDE_LOOP, jump.span, word);
        return nullptr;
    }
    if (size_t(levels) > around_.loops.size()) {
        reporter_.report(Code::RSL_BREAK_LEVELS, jump.span, word, levels, around_.loops.size());
        return nullptr;
    }
    return around_.loops[around_.loops.size() - size_t(levels)];
}

void StatementChecker::check(BreakStmt& s) {
    s.loop = jump_target(s, "break", s.levels);
}

void StatementChecker::check(ContinueStmt& s) {
    s.loop = jump_target(s, "continue", s.levels);
}

void StatementChecker::check(ReturnStmt& s) {
    const Function* f = scopes_.function();
    if (!f) {
        if (s.value) expressions_.value(s.value, BaseType::Invalid);
        reporter_.report(Code::RSL_RETURN_OUTSIDE_FUNCTION, s.span);
        return;
    }
    around_.returned = true;
    bool returns = f->result.base != BaseType::Void;
    if (returns && s.value)
        expressions_.convert_to(s.value, f->result, "the result");
    else if (returns)
        reporter_.report(Code::RSL_RETURN_NOTHING, s.span, type_name(f->result));
    else if (s.value)
        reporter_.report(Code::RSL_RETURN_VALUE, s.span, written_name(f->name));
}

}  // namespace kinora::rsl
