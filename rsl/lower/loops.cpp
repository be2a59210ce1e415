// rsl/lower/loops.cpp: loops of the source and over records, jumps and returns.
#include "rsl/lower/loops.h"

#include <algorithm>
#include <array>
#include <unordered_set>

#include "rsl/lower/values.h"
#include "rsl/model/builtin.h"

namespace kinora::rsl {

std::vector<int> Loops::carried_slots(const Changes& changes) {
    std::vector<int> slots;
    std::unordered_set<int> known;
    auto add = [&](int slot) {
        if (slot >= 0 && slots_.live(slot) && known.insert(slot).second) slots.push_back(slot);
    };
    for (const Symbol* symbol : changes.symbols) {
        if (!symbol->type.is_array()) {
            add(variables_.slot_of(*symbol));
        } else if (int k = variables_.known_array(*symbol); k >= 0 && arrays_.resizable(k)) {
            add(arrays_.count_slot(k));
        } else if (k >= 0 && arrays_.first_slot(k) >= 0) {
            for (int e = 0; e < arrays_.length(k); ++e) add(arrays_.first_slot(k) + e);
        }
    }
    auto among = [](const std::vector<const Stmt*>& list, const Stmt* stmt) {
        return std::find(list.begin(), list.end(), stmt) != list.end();
    };
    for (const Loop& loop : state_.loops) {
        if (among(changes.breaks, loop.stmt)) add(loop.broken);
        if (among(changes.continues, loop.stmt)) add(loop.continued);
    }
    if (changes.calls) add(state_.written_by_calls);
    if (changes.returns && !state_.frames.empty()) {
        add(state_.frames.back().returned);
        add(state_.frames.back().result);
    }
    for (const Written& written : state_.written)
        if (among(changes.light_sources, written.stmt))
            for (int slot : written.slots) add(slot);
    return slots;
}

Loops::Carried Loops::open_carried(std::vector<int> slots) {
    Carried carried{std::move(slots), {}};
    for (int slot : carried.slots) {
        Lowered value = slots_.read(slot);
        for (size_t c = 0; c < size_t(value.size()); ++c) {
            value.c[c] = b_.loop_var(value.c[c]);
            carried.vars.push_back(value.c[c]);
        }
        slots_.write(slot, value);
    }
    return carried;
}

void Loops::close_carried(const Carried& carried, std::vector<Value>& next) {
    for (int slot : carried.slots) {
        const Lowered& value = slots_.read(slot);
        next.insert(next.end(), value.c.begin(), value.c.begin() + value.size());
    }
}

void Loops::carried_out(const Carried& carried) {
    size_t k = 0;
    for (int slot : carried.slots) {
        Lowered value = slots_.read(slot);
        for (size_t c = 0; c < size_t(value.size()); ++c)
            value.c[c] = b_.loop_out(carried.vars[k++]);
        slots_.write(slot, value);
    }
}

Loops::Loop Loops::begin_jumps(const Stmt& stmt, const Changes& changes) {
    auto among = [&](const std::vector<const Stmt*>& list) {
        return std::find(list.begin(), list.end(), &stmt) != list.end();
    };
    Lowered none = lowered(BaseType::Bool, b_.m(false));
    Loop loop{&stmt, -1, -1};
    if (among(changes.breaks)) loop.broken = slots_.add(none);
    if (among(changes.continues)) loop.continued = slots_.add(none);
    return loop;
}

bool Loops::leaves_loop(const Changes& changes) {
    if (changes.returns) return true;
    for (const Loop& loop : state_.loops) {
        for (const Stmt* stmt : changes.breaks)
            if (stmt == loop.stmt) return true;
        for (const Stmt* stmt : changes.continues)
            if (stmt == loop.stmt && loop.stmt != state_.loops.back().stmt) return true;
    }
    return false;
}

Value Loops::after_loop(const Changes& changes, Value entered) {
    auto without = [&](Value mask, int slot) {
        return slot < 0 ? mask : b_.and_not(mask, slots_.read(slot).c[0]);
    };
    for (const Loop& loop : state_.loops) {
        for (const Stmt* stmt : changes.breaks)
            if (stmt == loop.stmt) entered = without(entered, loop.broken);
        for (const Stmt* stmt : changes.continues)
            if (stmt == loop.stmt) entered = without(entered, loop.continued);
    }
    if (changes.returns && !state_.frames.empty())
        entered = without(entered, state_.frames.back().returned);
    return entered;
}

// Lanes whose points may shoot no more rays: a loop that does not end would turn a million times.
Value Loops::out_of_rays() {
    if (!context_.options.want_Ci) return b_.m(false);
    context_.out.uses_rng = true;
    Value ended = kernel_service(e_, Service::raylimit, std::array{rng_input(b_)})[0];
    return b_.op(jit::Op::ILt, b_.i(0), ended);
}

int Loops::loop_site(const Stmt& stmt) {
    return b_.fault_site(stmt.span.where, "loop stopped: too many iterations");
}

// The condition is written twice, before the Loop and at its end, so that an iteration is one
// straight run: for lanes that are in, body, step, condition.
void Loops::run(const Stmt& stmt, const Changes& changes, const std::function<Value()>& condition,
                const std::function<void()>& body, const std::function<void()>& step) {
    Value outer = e_.running;
    Value enter = condition();
    bool known;
    if (b_.constant_m(enter, &known) && !known) return;
    Regions::Outer around = regions_.enter_loop();
    Loop jumps = begin_jumps(stmt, changes);
    Value inside = b_.begin_loop(enter, loop_site(stmt));
    const Value turns = std::exchange(turns_, jit::kNone);
    if (changes.random) seeds_.push_counter(b_.loop_var(b_.i(0)), turns);
    Carried carried = open_carried(carried_slots(changes));
    state_.loops.push_back(jumps);
    e_.running = inside;
    regions_.set_region(inside);
    body();

    Value rest = e_.running;
    if (!leaves_loop(changes))
        rest = inside;
    else if (jumps.continued >= 0)
        rest = b_.logical_or(rest, slots_.read(jumps.continued).c[0]);
    state_.loops.pop_back();
    Value again;
    e_.running = inside;
    if (rest == inside) {
        step();
        again = condition();
    } else {
        int slot = slots_.add(lowered(BaseType::Bool, b_.m(false)));
        regions_.guarded(rest, [&] {
            step();
            slots_.write(slot, lowered(BaseType::Bool, condition()));
        });
        slots_.kill(slot);
        again = slots_.read(slot).c[0];
    }
    if (changes.effects & kTraces) again = b_.and_not(again, out_of_rays());
    std::vector<Value> next;
    if (changes.random) next.push_back(b_.iadd(seeds_.counter(), b_.i(1)));
    close_carried(carried, next);
    b_.end_loop(again, next);
    carried_out(carried);
    if (changes.random) seeds_.pop_counter();
    for (int slot : {jumps.broken, jumps.continued})
        if (slot >= 0) slots_.kill(slot);
    regions_.leave_loop(around);
    e_.running = after_loop(changes, outer);
}

// The loop's counter and mask agree in all lanes, as reading records demands; lanes that do not
// take part, or have left by break, are kept out by `alive`.
void Loops::replay(const Stmt& stmt, Value set, const std::function<void(Value record)>& turn) {
    ChangeFinder finder(context_.ast());
    finder.add(&stmt);
    const Changes& changes = finder.changes;
    Value outer = e_.running;
    Regions::Outer around = regions_.enter_loop();
    Loop jumps = begin_jumps(stmt, changes);
    int alive = slots_.add(lowered(BaseType::Bool, e_.running));

    Value count = b_.op(jit::Op::RecordCount, set);
    regions_.set_region(b_.begin_loop(b_.op(jit::Op::ILt, b_.i(0), count), loop_site(stmt)));
    Value record = b_.loop_var(b_.i(0));
    std::vector<int> slots = carried_slots(changes);
    state_.loops.push_back(jumps);
    bool leaves = leaves_loop(changes);
    if (leaves) slots.push_back(alive);
    Carried carried = open_carried(std::move(slots));
    seeds_.push_counter(record);
    e_.running = slots_.read(alive).c[0];
    turn(record);
    if (leaves) {
        Value rest = e_.running;
        if (jumps.continued >= 0) rest = b_.logical_or(rest, slots_.read(jumps.continued).c[0]);
        slots_.write(alive, lowered(BaseType::Bool, rest));
    }
    seeds_.pop_counter();
    state_.loops.pop_back();
    std::vector<Value> next = {b_.iadd(record, b_.i(1))};
    close_carried(carried, next);
    b_.end_loop(b_.op(jit::Op::ILt, next[0], count), next);
    carried_out(carried);
    for (int slot : {jumps.broken, jumps.continued, alive})
        if (slot >= 0) slots_.kill(slot);
    regions_.leave_loop(around);
    e_.running = after_loop(changes, outer);
}

// ---- jumps --------------------------------------------------------------------------------------

void Loops::jump(const Stmt* loop_stmt, bool leaves) {
    for (const Loop& loop : state_.loops) {
        if (loop.stmt != loop_stmt) continue;
        int slot = leaves ? loop.broken : loop.continued;
        Value gone = b_.logical_or(slots_.read(slot).c[0], e_.running);
        slots_.write(slot, lowered(BaseType::Bool, gone));
    }
    e_.running = b_.m(false);
}

void Loops::return_from(const Lowered* value) {
    const FunctionFrame frame = state_.frames.back();
    if (value && frame.result >= 0) {
        Lowered result = *value;
        result.type = frame.function->result.base;
        slots_.write(frame.result, result);
    }
    Value gone = b_.logical_or(slots_.read(frame.returned).c[0], e_.running);
    slots_.write(frame.returned, lowered(BaseType::Bool, gone));
    e_.running = b_.m(false);
}

Lowered Loops::run_function(const Function& f, const std::function<void()>& body) {
    Value entered = e_.running;
    FunctionFrame frame{&f, slots_.add(lowered(BaseType::Bool, b_.m(false))), -1};
    if (f.result.base != BaseType::Void) frame.result = slots_.add(zero(e_, f.result.base));
    state_.frames.push_back(frame);
    std::vector<Loop> outer_loops;
    outer_loops.swap(state_.loops);  // jumps do not leave a function
    body();
    outer_loops.swap(state_.loops);
    state_.frames.pop_back();
    e_.running = entered;
    slots_.kill(frame.returned);
    if (frame.result < 0) return zero(e_, BaseType::Float);
    slots_.kill(frame.result);
    return slots_.read(frame.result);
}

void Loops::add_written(const Stmt* stmt, std::vector<int> slots) {
    state_.written.push_back({stmt, std::move(slots)});
}

}  // namespace kinora::rsl
