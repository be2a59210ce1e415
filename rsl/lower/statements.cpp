// rsl/lower/statements.cpp: branches, loops and jumps become Ifs, Loops and running masks.
#include "rsl/lower/statements.h"

#include "rsl/model/changes.h"

namespace kinora::rsl {

void Statements::statement(const Stmt& stmt) {
    switch (stmt.kind) {
        case StmtKind::Block:
            return block(as<BlockStmt>(stmt).body);
        case StmtKind::Declare:
            for (const Symbol* symbol : as<DeclareStmt>(stmt).symbols) variables_.declare(*symbol);
            return;
        case StmtKind::Extern:
        case StmtKind::DefineFunction:
            return;
        case StmtKind::Expression:
            return evaluate(*as<ExpressionStmt>(stmt).expression);
        case StmtKind::If:
            return branch(as<IfStmt>(stmt));
        case StmtKind::While:
        case StmtKind::For:
            return loop(stmt);
        case StmtKind::Break:
            return loops_.jump(as<BreakStmt>(stmt).loop, true);
        case StmtKind::Continue:
            return loops_.jump(as<ContinueStmt>(stmt).loop, false);
        case StmtKind::Return:
            return return_from(as<ReturnStmt>(stmt));
        case StmtKind::Illuminance:
            return illuminance_.lower(as<IlluminanceStmt>(stmt));
        case StmtKind::Illuminate: {
            auto& node = as<IlluminateStmt>(stmt);
            return light_shader_.illuminate(stmt, node.position, node.axis, node.angle, *node.body);
        }
        case StmtKind::Solar: {
            auto& node = as<SolarStmt>(stmt);
            return light_shader_.illuminate(stmt, nullptr, node.axis, node.angle, *node.body);
        }
        case StmtKind::Gather:
            return gather_.lower(as<GatherStmt>(stmt));
    }
}

// A variable by itself does nothing, and an array would not even be a value.
void Statements::evaluate(const Expr& e) {
    if (e.kind != ExprKind::Variable) tree_.expr(e);
}

// After a statement that took lanes out, the rest runs in an If for those that are left.
void Statements::block(std::span<Stmt* const> body) {
    Value entered = e_.running;
    bool left = true;
    for (size_t k = 0; k < body.size(); ++k) {
        if (e_.running != entered) {
            auto rest = body.subspan(k);
            regions_.guarded(e_.running, [&] { run_statements(rest); });
            break;
        }
        if (b_.constant_m(e_.running, &left) && !left) break;
        statement(*body[k]);
    }
    variables_.end_scope(body);
}

// The rest of a block whose lanes are fewer: declarations stay in the block's scope.
void Statements::run_statements(std::span<Stmt* const> body) {
    Value entered = e_.running;
    for (size_t k = 0; k < body.size(); ++k) {
        if (e_.running != entered)
            return regions_.guarded(e_.running, [&] { run_statements(body.subspan(k)); });
        statement(*body[k]);
    }
}

void Statements::branch(const IfStmt& stmt) {
    // Behind opacity, where opacity alone is wanted: what is under the threshold is a hole there
    // too.
    bool skips = stmt.behind_opacity && !context_.options.want_Ci;
    // Without a threshold Oi is 0 there already.
    const Stmt* otherwise = stmt.no;
    if (stmt.behind_opacity && context_.options.opacity_threshold <= 0) otherwise = nullptr;
    if (skips && !otherwise) return;
    Value condition = tree_.value(*stmt.condition);
    bool known;
    if (b_.constant_m(condition, &known)) {
        if (known && !skips)
            statement(*stmt.yes);
        else if (!known && otherwise)
            statement(*otherwise);
        return;
    }
    Value before = e_.running;
    Value yes = b_.logical_and(before, condition);
    Value no = b_.and_not(before, condition);
    if (!skips) regions_.guarded(yes, [&] { statement(*stmt.yes); });
    if (!otherwise) return;
    // What is left of the first side and what the second one leaves, together.
    Value after_yes = e_.running;
    e_.running = before;
    regions_.guarded(no, [&] { statement(*otherwise); });
    if (after_yes != before)
        e_.running = e_.running == before ? after_yes : b_.logical_and(e_.running, after_yes);
}

namespace {

const Symbol* variable_of(const Expr* e) {
    const auto* variable = as_if<VariableExpr>(e);
    return variable ? variable->symbol : nullptr;
}

bool is_one(const Expr* e) {
    const auto* number = as_if<NumberExpr>(e);
    return number && number->value == 1;
}

// i += 1, i = i + 1
bool counts_up(const Expr& step, const Symbol* counter) {
    const auto* assign = as_if<AssignExpr>(&step);
    if (!assign || variable_of(assign->target) != counter) return false;
    if (assign->op == Op::Add) return is_one(assign->value);
    const auto* sum = as_if<BinaryExpr>(assign->value);
    return assign->op == Op::None && sum && sum->op == Op::Add && is_one(sum->right) &&
           variable_of(sum->left) == counter;
}

// What may be computed once more: numbers, variables and their sums.
bool is_plain(const Expr& e) {
    if (e.kind == ExprKind::Number || e.kind == ExprKind::Variable) return true;
    const auto* call = as_if<CallExpr>(&e);
    if (call && call->name == "arraylength") return true;
    const auto* both = as_if<BinaryExpr>(&e);
    return both && is_plain(*both->left) && is_plain(*both->right);
}

}  // namespace

Value Statements::turns_of(const ForStmt& stmt) {
    const auto* condition = as_if<BinaryExpr>(stmt.condition);
    const Symbol* counter = condition ? variable_of(condition->left) : nullptr;
    const bool less = condition && condition->op == Op::Less;
    const bool up_to = condition && condition->op == Op::LessEqual;
    if (!counter || !(less || up_to) || stmt.step.size() != 1 ||
        !counts_up(*stmt.step[0], counter) || !is_plain(*condition->right))
        return jit::kNone;
    Value turns = b_.sub(tree_.value(*condition->right), tree_.value(*condition->left));
    if (up_to) turns = b_.add(turns, b_.f(1));
    turns = b_.ftoi(b_.op(up_to ? jit::Op::Floor : jit::Op::Ceil, turns));
    return b_.select(b_.op(jit::Op::ILt, turns, b_.i(1)), b_.i(1), turns);
}

void Statements::loop(const Stmt& stmt) {
    ChangeFinder finder(context_.ast());
    if (auto* node = as_if<WhileStmt>(&stmt)) {
        finder.add(&stmt);
        return loops_.run(
            stmt, finder.changes,
            [&] { return b_.logical_and(e_.running, tree_.value(*node->condition)); },
            [&] { statement(*node->body); }, [] {});
    }
    auto& node = as<ForStmt>(stmt);
    for (const Stmt* init : node.init) statement(*init);
    finder.add(node.condition);
    finder.add(node.body);
    for (const Expr* step : node.step) finder.add(step);
    if (finder.changes.random && loops_.stratifies()) loops_.expect_turns(turns_of(node));
    loops_.run(
        stmt, finder.changes,
        [&] {
            return node.condition ? b_.logical_and(e_.running, tree_.value(*node.condition))
                                  : e_.running;
        },
        [&] { statement(*node.body); },
        [&] {
            for (const Expr* step : node.step) tree_.expr(*step);
        });
    variables_.end_scope(node.init);
}

void Statements::return_from(const ReturnStmt& stmt) {
    if (!stmt.value) return loops_.return_from(nullptr);
    Lowered result = tree_.expr(*stmt.value);
    loops_.return_from(&result);
}

}  // namespace kinora::rsl
