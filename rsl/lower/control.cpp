// rsl/lower/control.cpp: branches, loops and jumps become Ifs, Loops and running masks.
#include <algorithm>

#include "rsl/lower/lower_p.h"

namespace kinora::rsl {

void Lowering::statement(const Stmt& stmt) {
    switch (stmt.kind) {
        case StmtKind::Block:
            return block(as<BlockStmt>(stmt).body);
        case StmtKind::Declare:
            for (const Symbol* symbol : as<DeclareStmt>(stmt).symbols) declare(*symbol);
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
            return jump(as<BreakStmt>(stmt).loop, true);
        case StmtKind::Continue:
            return jump(as<ContinueStmt>(stmt).loop, false);
        case StmtKind::Return:
            return return_from(as<ReturnStmt>(stmt));
        case StmtKind::Illuminance:
            return illuminance(as<IlluminanceStmt>(stmt));
        case StmtKind::Illuminate: {
            auto& node = as<IlluminateStmt>(stmt);
            return illuminate(stmt, node.position, node.axis, node.angle, *node.body);
        }
        case StmtKind::Solar: {
            auto& node = as<SolarStmt>(stmt);
            return illuminate(stmt, nullptr, node.axis, node.angle, *node.body);
        }
        case StmtKind::Gather:
            return gather(as<GatherStmt>(stmt));
    }
}

// A variable by itself does nothing, and an array would not even be a value.
void Lowering::evaluate(const Expr& e) {
    if (e.kind != ExprKind::Variable) expr(e);
}

// After a statement that took lanes out, the rest runs in an If for those that are left.
void Lowering::block(std::span<Stmt* const> body) {
    Value entered = running;
    bool left = true;
    for (size_t k = 0; k < body.size(); ++k) {
        if (running != entered) {
            auto rest = body.subspan(k);
            guarded(running, [&] { run_statements(rest); });
            break;
        }
        if (b.constant_m(running, &left) && !left) break;
        statement(*body[k]);
    }
    end_scope(body);
}

// The rest of a block whose lanes are fewer: declarations stay in the block's scope.
void Lowering::run_statements(std::span<Stmt* const> body) {
    Value entered = running;
    for (size_t k = 0; k < body.size(); ++k) {
        if (running != entered) return guarded(running, [&] { run_statements(body.subspan(k)); });
        statement(*body[k]);
    }
}

void Lowering::branch(const IfStmt& stmt) {
    Value condition = value(*stmt.condition);
    bool known;
    if (b.constant_m(condition, &known)) {
        if (known)
            statement(*stmt.yes);
        else if (stmt.no)
            statement(*stmt.no);
        return;
    }
    Value before = running;
    Value yes = b.logical_and(before, condition);
    Value no = b.and_not(before, condition);
    guarded(yes, [&] { statement(*stmt.yes); });
    if (!stmt.no) return;
    // What is left of the first side and what the second one leaves, together.
    Value after_yes = running;
    running = before;
    guarded(no, [&] { statement(*stmt.no); });
    if (after_yes != before)
        running = running == before ? after_yes : b.logical_and(running, after_yes);
}

// ---- loops --------------------------------------------------------------------------------------

std::vector<int> Lowering::carried_slots(const Changes& changes) {
    std::vector<int> slots;
    auto add = [&](int slot) {
        if (slot < 0 || !slots_[size_t(slot)].live) return;
        if (std::find(slots.begin(), slots.end(), slot) == slots.end()) slots.push_back(slot);
    };
    for (const Symbol* symbol : changes.symbols) {
        if (!symbol->type.is_array()) {
            add(slot_of(*symbol));
        } else if (int k = array_of_[symbol->id]; k >= 0 && arrays_[size_t(k)].first_slot >= 0) {
            for (int e = 0; e < arrays_[size_t(k)].length; ++e)
                add(arrays_[size_t(k)].first_slot + e);
        }
    }
    auto among = [](const std::vector<const Stmt*>& list, const Stmt* stmt) {
        return std::find(list.begin(), list.end(), stmt) != list.end();
    };
    for (const Loop& loop : loops_) {
        if (among(changes.breaks, loop.stmt)) add(loop.broken);
        if (among(changes.continues, loop.stmt)) add(loop.continued);
    }
    if (changes.calls) add(calls_left_);
    if (changes.returns && !frames_.empty()) {
        add(frames_.back().returned);
        add(frames_.back().result);
    }
    for (const LightSource& light : light_sources_)
        if (among(changes.light_sources, light.stmt))
            for (int slot : {light.L, light.Cl, light.Ol, light.lit}) add(slot);
    return slots;
}

Lowering::Carried Lowering::open_carried(std::vector<int> slots) {
    Carried carried{std::move(slots), {}};
    for (int slot : carried.slots) {
        Lowered value = slots_[size_t(slot)].value;
        for (size_t c = 0; c < size_t(value.size()); ++c) {
            value.c[c] = b.loop_var(value.c[c]);
            carried.vars.push_back(value.c[c]);
        }
        write_slot(slot, value);
    }
    return carried;
}

void Lowering::close_carried(const Carried& carried, std::vector<Value>& next) {
    for (int slot : carried.slots) {
        const Lowered& value = slots_[size_t(slot)].value;
        next.insert(next.end(), value.c.begin(), value.c.begin() + value.size());
    }
}

void Lowering::carried_out(const Carried& carried) {
    size_t k = 0;
    for (int slot : carried.slots) {
        Lowered value = slots_[size_t(slot)].value;
        for (size_t c = 0; c < size_t(value.size()); ++c)
            value.c[c] = b.loop_out(carried.vars[k++]);
        write_slot(slot, value);
    }
}

Lowering::Loop Lowering::begin_jumps(const Stmt& stmt, const Changes& changes) {
    auto among = [&](const std::vector<const Stmt*>& list) {
        return std::find(list.begin(), list.end(), &stmt) != list.end();
    };
    Lowered none = lowered(BaseType::Bool, b.m(false));
    Loop loop{&stmt, -1, -1};
    if (among(changes.breaks)) loop.broken = new_slot(none);
    if (among(changes.continues)) loop.continued = new_slot(none);
    return loop;
}

bool Lowering::leaves_loop(const Changes& changes) {
    if (changes.returns) return true;
    for (const Loop& loop : loops_) {
        for (const Stmt* stmt : changes.breaks)
            if (stmt == loop.stmt) return true;
        for (const Stmt* stmt : changes.continues)
            if (stmt == loop.stmt && loop.stmt != loops_.back().stmt) return true;
    }
    return false;
}

Value Lowering::after_loop(const Changes& changes, Value entered) {
    auto without = [&](Value mask, int slot) {
        return slot < 0 ? mask : b.and_not(mask, slots_[size_t(slot)].value.c[0]);
    };
    for (const Loop& loop : loops_) {
        for (const Stmt* stmt : changes.breaks)
            if (stmt == loop.stmt) entered = without(entered, loop.broken);
        for (const Stmt* stmt : changes.continues)
            if (stmt == loop.stmt) entered = without(entered, loop.continued);
    }
    if (changes.returns && !frames_.empty()) entered = without(entered, frames_.back().returned);
    return entered;
}

int Lowering::loop_site(const Stmt& stmt) {
    return b.fault_site(stmt.span.where, "loop stopped: too many iterations");
}

void Lowering::loop(const Stmt& stmt) {
    ChangeFinder finder(ast());
    if (auto* node = as_if<WhileStmt>(&stmt)) {
        finder.add(&stmt);
        return run_loop(
            stmt, finder.changes, [&] { return b.logical_and(running, value(*node->condition)); },
            [&] { statement(*node->body); }, [] {});
    }
    auto& node = as<ForStmt>(stmt);
    for (const Stmt* init : node.init) statement(*init);
    finder.add(node.condition);
    finder.add(node.body);
    for (const Expr* step : node.step) finder.add(step);
    run_loop(
        stmt, finder.changes,
        [&] { return node.condition ? b.logical_and(running, value(*node.condition)) : running; },
        [&] { statement(*node.body); },
        [&] {
            for (const Expr* step : node.step) expr(*step);
        });
    end_scope(node.init);
}

// The condition is written twice, before the Loop and at its end, so that an iteration is one
// straight run: for lanes that are in, body, step, condition.
template <class Condition, class Body, class Step>
void Lowering::run_loop(const Stmt& stmt, const Changes& changes, Condition&& condition,
                        Body&& body, Step&& step) {
    Value outer = running;
    Value enter = condition();
    bool known;
    if (b.constant_m(enter, &known) && !known) return;
    Value outer_region = region_;
    bool was_in_loop = std::exchange(in_loop_, true);
    Loop jumps = begin_jumps(stmt, changes);
    Value inside = b.begin_loop(enter, loop_site(stmt));
    if (changes.random) loop_counters.push_back(b.loop_var(b.i(0)));
    Carried carried = open_carried(carried_slots(changes));
    loops_.push_back(jumps);
    running = region_ = inside;
    body();

    Value rest = running;
    if (!leaves_loop(changes))
        rest = inside;
    else if (jumps.continued >= 0)
        rest = b.logical_or(rest, read_slot(jumps.continued).c[0]);
    loops_.pop_back();
    Value again;
    running = inside;
    if (rest == inside) {
        step();
        again = condition();
    } else {
        int slot = new_slot(lowered(BaseType::Bool, b.m(false)));
        guarded(rest, [&] {
            step();
            write_slot(slot, lowered(BaseType::Bool, condition()));
        });
        free_slot(slot);
        again = read_slot(slot).c[0];
    }
    std::vector<Value> next;
    if (changes.random) next.push_back(b.iadd(loop_counters.back(), b.i(1)));
    close_carried(carried, next);
    b.end_loop(again, next);
    carried_out(carried);
    if (changes.random) loop_counters.pop_back();
    for (int slot : {jumps.broken, jumps.continued})
        if (slot >= 0) free_slot(slot);
    in_loop_ = was_in_loop;
    region_ = outer_region;
    running = after_loop(changes, outer);
}

// ---- jumps --------------------------------------------------------------------------------------

void Lowering::jump(const Stmt* loop_stmt, bool leaves) {
    for (const Loop& loop : loops_) {
        if (loop.stmt != loop_stmt) continue;
        int slot = leaves ? loop.broken : loop.continued;
        Value gone = b.logical_or(read_slot(slot).c[0], running);
        write_slot(slot, lowered(BaseType::Bool, gone));
    }
    running = b.m(false);
}

void Lowering::return_from(const ReturnStmt& stmt) {
    FunctionFrame frame = frames_.back();
    if (stmt.value) {
        Lowered result = expr(*stmt.value);
        if (frame.result >= 0) {
            result.type = frame.function->result.base;
            write_slot(frame.result, result);
        }
    }
    Value gone = b.logical_or(read_slot(frame.returned).c[0], running);
    write_slot(frame.returned, lowered(BaseType::Bool, gone));
    running = b.m(false);
}

}  // namespace kinora::rsl
