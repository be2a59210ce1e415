// rsl/check/statement.cpp: statements.
#include "rsl/check/check.h"
#include "rsl/model/pairs.h"
#include "rsl/syntax/ast_visit.h"

namespace kinora::rsl {

void Checker::statement(Stmt& stmt) {
    visit_stmt(stmt, [&](auto& node) { check(node); });
}

// Nested functions may be called before the place they are defined at.
void Checker::check(BlockStmt& s) {
    ScopeGuard scope(*this);
    for (Stmt* item : s.body)
        if (auto* nested = as_if<FunctionStmt>(item)) declare_function(*nested->function);
    for (Stmt* item : s.body) statement(*item);
}

void Checker::check(DeclareStmt& s) {
    for (Symbol* symbol : s.symbols) {
        check_initial(*symbol);
        declare(*symbol);
    }
}

// The name then means the variable outside, of which this is only a reminder.
void Checker::check(ExternStmt& s) {
    for (Symbol*& symbol : s.symbols) {
        Symbol* outer = find_variable(symbol->name, true);
        if (!outer) {
            if (!recovery_.hides(symbol->name, symbol->span.token))
                report(Code::RSL_EXTERN_UNKNOWN, symbol->span, symbol->name);
            outer = symbol;
        } else if (outer->type.base != symbol->type.base &&
                   !(is_triple(outer->type) && is_triple(symbol->type))) {
            report(Code::RSL_TYPE_MISMATCH, symbol->span, fmt::format("extern '{}'", symbol->name),
                   type_name(outer->type), type_name(symbol->type));
        }
        symbol = outer;
        scopes_.back().variables.push_back(outer);
    }
}

void Checker::check(FunctionStmt& s) {
    check_function(*s.function);
}

void Checker::check(ExpressionStmt& s) {
    Expr* written = s.expression;
    expression(s.expression, BaseType::Invalid);
    ExprKind kind = written->kind;
    if (kind != ExprKind::Assign && kind != ExprKind::Call && kind != ExprKind::Cast &&
        s.expression->type.base != BaseType::Invalid && !recovery_.touches(s.span.token))
        report(Code::RSL_NO_EFFECT, s.span);
}

void Checker::check(IfStmt& s) {
    condition(s.condition);
    statement(*s.yes);
    if (s.no) statement(*s.no);
}

void Checker::loop_body(Stmt& loop, Stmt& body) {
    loops_.push_back(&loop);
    statement(body);
    loops_.pop_back();
}

void Checker::check(WhileStmt& s) {
    condition(s.condition);
    loop_body(s, *s.body);
}

void Checker::check(ForStmt& s) {
    ScopeGuard scope(*this);
    for (Stmt* item : s.init) statement(*item);
    if (s.condition) condition(s.condition);
    for (Expr*& step : s.step) expression(step, BaseType::Invalid);
    loop_body(s, *s.body);
}

// ---- jumps --------------------------------------------------------------------------------------

Stmt* Checker::jump_target(const Stmt& jump, const char* word, int levels) {
    if (loops_.empty()) {
        report(Code::RSL_BREAK_OUTSIDE_LOOP, jump.span, word);
        return nullptr;
    }
    if (size_t(levels) > loops_.size()) {
        report(Code::RSL_BREAK_LEVELS, jump.span, word, levels, loops_.size());
        return nullptr;
    }
    return loops_[loops_.size() - size_t(levels)];
}

void Checker::check(BreakStmt& s) {
    s.loop = jump_target(s, "break", s.levels);
}

void Checker::check(ContinueStmt& s) {
    s.loop = jump_target(s, "continue", s.levels);
}

void Checker::check(ReturnStmt& s) {
    if (!function_) {
        if (s.value) value(s.value, BaseType::Invalid);
        report(Code::RSL_RETURN_OUTSIDE_FUNCTION, s.span);
        return;
    }
    returned_ = true;
    bool returns = function_->result.base != BaseType::Void;
    if (returns && s.value)
        convert_to(s.value, function_->result, "the result");
    else if (returns)
        report(Code::RSL_RETURN_NOTHING, s.span, type_name(function_->result));
    else if (s.value)
        report(Code::RSL_RETURN_VALUE, s.span, function_->name);
}

// ---- light statements ---------------------------------------------------------------------------

void Checker::cone(Expr*& axis, Expr*& angle, const char* statement_name) {
    if (axis) convert_to(axis, {BaseType::Vector, -1}, fmt::format("axis of {}", statement_name));
    if (angle) convert_to(angle, {BaseType::Float, -1}, fmt::format("angle of {}", statement_name));
}

// illuminance([category,] position [, axis, angle] [, "name", value ...])
void Checker::check(IlluminanceStmt& s) {
    constexpr BaseType kWanted[] = {BaseType::Point, BaseType::Vector, BaseType::Float};
    size_t first = 0;
    for (size_t k = 0; k < s.args.size(); ++k) {
        value(s.args[k], k - first < 3 ? kWanted[k - first] : BaseType::Invalid);
        if (k == 0 && s.args[0]->type.base == BaseType::String) first = 1;
    }
    if (!sort_illuminance(s, first)) {
        report(Code::RSL_ARGUMENT_FORM, s.span, "illuminance",
               "([category,] position [, axis, angle] [, \"name\", value ...])");
        Within<const char*> within(light_statement_, "illuminance");
        return loop_body(s, *s.body);
    }
    bring_to(s.position, {BaseType::Point, -1}, "position of illuminance");
    if (s.axis) bring_to(s.axis, {BaseType::Vector, -1}, "axis of illuminance");
    if (s.angle) bring_to(s.angle, {BaseType::Float, -1}, "angle of illuminance");
    output_pairs(s.pairs, "illuminance", is_light_output);
    Within<const char*> within(light_statement_, "illuminance");
    loop_body(s, *s.body);
}

constexpr double kHalfPi = 1.57079632679489661923;

// The angle of a cone that is written without one.
Expr* Checker::assumed_angle(const Stmt& s, const char* statement_name, double angle,
                             const char* text) {
    report(Code::RSL_CONE_FORM, s.span, statement_name, text);
    auto* node = ast_.make<NumberExpr>(s.span);
    node->value = angle;
    node->type = {BaseType::Float, -1};
    return node;
}

// Says which argument is what; false when they fit no form.
bool Checker::sort_illuminance(IlluminanceStmt& s, size_t next) {
    auto is_string = [&](size_t k) { return s.args[k]->type.base == BaseType::String; };
    size_t count = s.args.size();
    if (next == 1) s.category = s.args[0];
    if (next >= count || is_string(next)) return false;
    s.position = s.args[next++];
    if (next < count && !is_string(next)) {
        s.axis = s.args[next++];
        if (next < count && !is_string(next)) s.angle = s.args[next++];
    }
    for (size_t k = next; k < count; k += 2)
        if (!is_string(k)) return false;
    if ((count - next) % 2 != 0) return false;
    if (s.axis && !s.angle) s.angle = assumed_angle(s, "illuminance", kHalfPi, "PI/2");
    drop_unfit(s.args, next, "illuminance");
    s.pairs = s.args.subspan(next);
    return true;
}

void Checker::check(IlluminateStmt& s) {
    convert_to(s.position, {BaseType::Point, -1}, "position of illuminate");
    cone(s.axis, s.angle, "illuminate");
    if (light_statement_)
        report(Code::RSL_NESTED_ILLUMINATE, s.span, "illuminate", light_statement_);
    Within<const char*> within(light_statement_, "illuminate");
    Within<std::vector<Stmt*>> no_loops(loops_, {});
    statement(*s.body);
}

void Checker::check(SolarStmt& s) {
    if (s.axis && !s.angle) s.angle = assumed_angle(s, "solar", 0, "0");
    cone(s.axis, s.angle, "solar");
    if (light_statement_) report(Code::RSL_NESTED_ILLUMINATE, s.span, "solar", light_statement_);
    Within<const char*> within(light_statement_, "solar");
    Within<std::vector<Stmt*>> no_loops(loops_, {});
    statement(*s.body);
}

// gather(category, position, direction, angle, samples [, "name", value ...])
void Checker::check(GatherStmt& s) {
    constexpr BaseType kWanted[] = {BaseType::String, BaseType::Point, BaseType::Vector,
                                    BaseType::Float, BaseType::Float};
    for (size_t k = 0; k < s.args.size(); ++k)
        value(s.args[k], k < 5 ? kWanted[k] : BaseType::Invalid);
    bool named = s.args.size() >= 5 && s.args.size() % 2 == 1;
    for (size_t k = 5; named && k < s.args.size(); k += 2)
        named = s.args[k]->type == Type{BaseType::String, -1};
    if (!named) {
        report(Code::RSL_ARGUMENT_FORM, s.span, "gather",
               "(category, position, direction, angle, samples [, \"name\", value ...])");
        loop_body(s, *s.body);
        if (s.missed) loop_body(s, *s.missed);
        return;
    }
    Expr** wanted[] = {&s.category, &s.position, &s.direction, &s.angle, &s.samples};
    for (size_t k = 0; k < 5; ++k) {
        bring_to(s.args[k], {kWanted[k], -1}, fmt::format("argument {} of gather", k + 1));
        *wanted[k] = s.args[k];
    }
    drop_unfit(s.args, 5, "gather");
    s.pairs = s.args.subspan(5);
    output_pairs(s.pairs, "gather", is_gather_output);
    loop_body(s, *s.body);
    if (s.missed) loop_body(s, *s.missed);
}

// Optional parameters from args[first] on whose values have the wrong type are reported and left
// out, so that no later stage meets a text where it takes a number.
void Checker::drop_unfit(std::span<Expr*>& args, size_t first, std::string_view callee) {
    size_t kept = first;
    for (size_t k = first; k + 1 < args.size(); k += 2) {
        Expr*& given = args[k + 1];
        if (given->type.base == BaseType::Bool) convert(given, BaseType::Float);
        std::string_view name = pair_name(args, k + 1);
        BaseType wanted = option_type(name);
        bool known = wanted != BaseType::Invalid && given->type.base != BaseType::Invalid;
        if (known && given->type != Type{wanted, -1}) {
            report(Code::RSL_PAIR_TYPE, given->span, name, callee, type_name({wanted, -1}),
                   type_name(given->type));
            continue;
        }
        args[kept++] = args[k];
        args[kept++] = given;
    }
    args = args.first(kept);
}

// Results among "name", value pairs must be variables.
void Checker::output_pairs(std::span<Expr*> pairs, const char* statement_name,
                           bool (*is_output)(std::string_view name)) {
    for (size_t k = 1; k < pairs.size(); k += 2) {
        if (!is_output(pair_name(pairs, k)) || pairs[k]->type.base == BaseType::Invalid) continue;
        if (Symbol* symbol = lvalue_symbol(*pairs[k]); symbol && !pairs[k]->type.is_array())
            mark_assigned(*symbol, pairs[k]->span);
        else
            report(Code::RSL_OUTPUT_ARGUMENT, pairs[k]->span, k + 1, statement_name);
    }
}

}  // namespace kinora::rsl
