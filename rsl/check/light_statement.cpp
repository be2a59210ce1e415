// rsl/check/light_statement.cpp: the statements about lights and rays.
#include "rsl/check/optional_parameters.h"
#include "rsl/check/statement.h"
#include "rsl/model/pairs.h"

namespace kinora::rsl {

void StatementChecker::cone(Expr*& axis, Expr*& angle, const char* statement_name) {
    if (axis)
        expressions_.convert_to(axis, {BaseType::Vector, -1},
                                fmt::format("axis of {}", statement_name));
    if (angle)
        expressions_.convert_to(angle, {BaseType::Float, -1},
                                fmt::format("angle of {}", statement_name));
}

// illuminance([category,] position [, axis, angle] [, "name", value ...])
void StatementChecker::check(IlluminanceStmt& s) {
    constexpr BaseType kWanted[] = {BaseType::Point, BaseType::Vector, BaseType::Float};
    size_t first = 0;
    for (size_t k = 0; k < s.args.size(); ++k) {
        expressions_.value(s.args[k], k - first < 3 ? kWanted[k - first] : BaseType::Invalid);
        if (k == 0 && s.args[0]->type.base == BaseType::String) first = 1;
    }
    if (!sort_illuminance(s, first)) {
        reporter_.report(Code::RSL_ARGUMENT_FORM, s.span, "illuminance",
                         "([category,] position [, axis, angle] [, \"name\", value ...])");
        Within<const char*> within(around_.light_statement, "illuminance");
        return loop_body(s, *s.body);
    }
    expressions_.bring_to(s.position, {BaseType::Point, -1}, "position of illuminance");
    if (s.axis) expressions_.bring_to(s.axis, {BaseType::Vector, -1}, "axis of illuminance");
    if (s.angle) expressions_.bring_to(s.angle, {BaseType::Float, -1}, "angle of illuminance");
    output_pairs(s.pairs, "illuminance", is_light_output);
    Within<const char*> within(around_.light_statement, "illuminance");
    loop_body(s, *s.body);
}

constexpr double kHalfPi = 1.57079632679489661923;

// The angle of a cone that is written without one.
Expr* StatementChecker::assumed_angle(const Stmt& s, const char* statement_name, double angle,
                                      const char* text) {
    reporter_.report(Code::RSL_CONE_FORM, s.span, statement_name, text);
    auto* node = ast_.make<NumberExpr>(s.span);
    node->value = angle;
    node->type = {BaseType::Float, -1};
    return node;
}

// Says which argument is what; false when they fit no form.
bool StatementChecker::sort_illuminance(IlluminanceStmt& s, size_t next) {
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
    drop_unfit_pairs(ast_, reporter_, s.args, next, "illuminance");
    s.pairs = s.args.subspan(next);
    return true;
}

// The body of a statement that emits light, in which no other may stand.
void StatementChecker::emit_body(Stmt& s, Stmt& body, const char* statement_name) {
    if (around_.light_statement)
        reporter_.report(Code::RSL_NESTED_ILLUMINATE, s.span, statement_name,
                         around_.light_statement);
    Within<const char*> within(around_.light_statement, statement_name);
    Within<std::vector<Stmt*>> no_loops(around_.loops, {});
    statement(body);
}

void StatementChecker::check(IlluminateStmt& s) {
    expressions_.convert_to(s.position, {BaseType::Point, -1}, "position of illuminate");
    cone(s.axis, s.angle, "illuminate");
    emit_body(s, *s.body, "illuminate");
}

void StatementChecker::check(SolarStmt& s) {
    if (s.axis && !s.angle) s.angle = assumed_angle(s, "solar", 0, "0");
    cone(s.axis, s.angle, "solar");
    emit_body(s, *s.body, "solar");
}

// gather(category, position, direction, angle, samples [, "name", value ...])
void StatementChecker::check(GatherStmt& s) {
    if (sort_gather(s))
        output_pairs(s.pairs, "gather", is_gather_output);
    else
        reporter_.report(Code::RSL_ARGUMENT_FORM, s.span, "gather",
                         "(category, position, direction, angle, samples [, \"name\", value ...])");
    loop_body(s, *s.body);
    if (s.missed) loop_body(s, *s.missed);
}

// Checks the arguments and says which is what; false when they do not fit the form.
bool StatementChecker::sort_gather(GatherStmt& s) {
    constexpr BaseType kWanted[] = {BaseType::String, BaseType::Point, BaseType::Vector,
                                    BaseType::Float, BaseType::Float};
    for (size_t k = 0; k < s.args.size(); ++k)
        expressions_.value(s.args[k], k < 5 ? kWanted[k] : BaseType::Invalid);
    bool named = s.args.size() >= 5 && s.args.size() % 2 == 1;
    for (size_t k = 5; named && k < s.args.size(); k += 2)
        named = s.args[k]->type == Type{BaseType::String, -1};
    if (!named) return false;
    Expr** wanted[] = {&s.category, &s.position, &s.direction, &s.angle, &s.samples};
    for (size_t k = 0; k < 5; ++k) {
        expressions_.bring_to(s.args[k], {kWanted[k], -1},
                              fmt::format("argument {} of gather", k + 1));
        *wanted[k] = s.args[k];
    }
    drop_unfit_pairs(ast_, reporter_, s.args, 5, "gather");
    s.pairs = s.args.subspan(5);
    return true;
}

// Results among "name", value pairs must be variables.
void StatementChecker::output_pairs(std::span<Expr*> pairs, const char* statement_name,
                                    bool (*is_output)(std::string_view name)) {
    for (size_t k = 1; k < pairs.size(); k += 2)
        if (is_output(pair_name(pairs, k)))
            assignments_.assign_result(*pairs[k], k, statement_name);
}

}  // namespace kinora::rsl
