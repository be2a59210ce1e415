// rsl/lower/lights.cpp: light records read by surfaces, and written by light shaders.
#include <algorithm>

#include "rsl/lower/lower_p.h"
#include "rsl/model/pairs.h"

namespace kinora::rsl {

// ---- records as surfaces read them --------------------------------------------------------------

// Set 0 holds the lights at the grid's own P; any other position asks the service once.
Value Lowering::record_set(const V3& position) {
    if (is_input(position, "P")) {
        out.uses_lights = true;
        return b.i(0);
    }
    return service(Service::lights, position)[0];
}

Value Lowering::record_field(Value set, Value record, int column, jit::Type type) {
    return b.op(jit::Op::RecordField, set, record, jit::kNone, column, int(type));
}
V3 Lowering::record_triple(Value set, Value record, int column) {
    return {record_field(set, record, column), record_field(set, record, column + 1),
            record_field(set, record, column + 2)};
}
Value Lowering::record_uniform(Value set, Value record, int field, jit::Type type) {
    return b.op(jit::Op::RecordUniform, set, record, jit::kNone, field, int(type));
}

// The column of a light's parameter, and its number among the messages. The type that the first
// reader wants is kept.
int Lowering::message_column(std::string_view name, Type type, int* index) {
    int column = kLightMessages;
    int components = component_count(type.base) * std::max(type.array_length, 1);
    bool text = type.base == BaseType::String;
    for (size_t k = 0; k < out.light_messages.size(); ++k) {
        *index = int(k);
        Type known = out.light_message_types[k];
        if (out.light_messages[k] == name && out.light_message_components[k] == components &&
            known.array_length == type.array_length && (known.base == BaseType::String) == text)
            return column;
        column += out.light_message_components[k];
    }
    *index = int(out.light_messages.size());
    out.light_messages.emplace_back(name);
    out.light_message_components.push_back(components);
    out.light_message_types.push_back(type);
    return column;
}

// __nondiffuse and __nonspecular are uniforms of every record.
std::vector<Lowered> Lowering::light_message(const std::string& name, Type type,
                                             std::span<const Lowered> before, Value* known) {
    Value set = current_set, record = current_record;
    if (type == Type{BaseType::Float, -1} && (name == "__nondiffuse" || name == "__nonspecular")) {
        int field = name == "__nondiffuse" ? kLightNondiffuse : kLightNonspecular;
        *known = b.m(true);
        return {lowered(BaseType::Float, record_uniform(set, record, field, jit::Type::F))};
    }
    int message;
    int column = message_column(name, type, &message);
    Value has = record_uniform(set, record, kLightUniforms + message, jit::Type::I);
    *known = b.logical_not(b.op(jit::Op::IEq, has, b.i(0)));
    jit::Type read_as = type.base == BaseType::String ? jit::Type::I : jit::Type::F;
    std::vector<Lowered> values(before.begin(), before.end());
    for (Lowered& value : values)
        for (size_t c = 0; c < size_t(value.size()); ++c)
            value.c[c] = b.select(*known, record_field(set, record, column++, read_as), value.c[c]);
    return values;
}

// "name" asks for lights of the category, "-name" for all others, "" for all. What an expression
// ("a|b", "a&-b") means is the renderer's to say once (kLightCategories).
Value Lowering::category_matches(Value set, Value record, const Expr& category) {
    const std::string* text = constant_text(value(category));
    if (!text) {
        error(Code::RSL_STRING_NOT_CONSTANT, category.span.where, "illuminance");
        return b.m(true);
    }
    if (text->empty()) return b.m(true);
    bool without = text->front() == '-' && text->find_first_of("|&") == std::string::npos;
    std::string name = text->substr(without ? 1 : 0);
    auto found = std::find(out.categories.begin(), out.categories.end(), name);
    if (found == out.categories.end() && out.categories.size() == 32)
        error(Code::RSL_TOO_MANY_CATEGORIES, category.span.where, 32);
    int bit = int(found - out.categories.begin());
    if (found == out.categories.end()) out.categories.push_back(name);
    Value bits = record_uniform(set, record, kLightCategories, jit::Type::I);
    Value absent = b.op(jit::Op::IEq, b.iand(bits, b.i(int32_t(1u << (bit & 31)))), b.i(0));
    return without ? absent : b.logical_not(absent);
}

// Within `angle` of the axis: cos(angle) |L| |axis| <= L . axis.
struct Lowering::Cone {
    bool all = true;
    V3 axis{};
    Value cosine = jit::kNone;  // times the length of the axis
};

Lowering::Cone Lowering::cone(const Expr* axis, const Expr* angle) {
    if (!axis) return {};
    V3 a = expr(*axis).v3();
    Value half = value(*angle);
    float known;
    bool constant = b.constant_f(half, &known);
    if (constant && known >= 3.14159f) return {};
    Value cosine = jit::math::cos(b, half, tier);
    if (!constant)  // nothing lies outside a cone of half a turn or more
        cosine = b.select(b.le(f(3.14159f), half), f(-2), cosine);
    return {false, a, b.mul(cosine, length(a))};
}

Value Lowering::inside(const Cone& cone, const V3& L) {
    if (cone.all) return b.m(true);
    return b.le(mul(cone.cosine, length(L)), dot(L, cone.axis));
}

void Lowering::illuminance(const IlluminanceStmt& stmt) {
    Lowered position = expr(*stmt.position);
    Value set = record_set(position.v3());
    Cone around = cone(stmt.axis, stmt.angle);
    replay(stmt, set, [&](Value record) { light_body(stmt, set, record, around, position); });
}

// The loop's counter and mask agree in all lanes, as reading records demands; lanes that do not
// take part, or have left by break, are kept out by `alive`.
void Lowering::replay(const Stmt& stmt, Value set, const std::function<void(Value record)>& turn) {
    ChangeFinder finder(ast());
    finder.add(&stmt);
    const Changes& changes = finder.changes;
    Value outer = running, outer_region = region_;
    bool was_in_loop = std::exchange(in_loop_, true);
    Loop jumps = begin_jumps(stmt, changes);
    int alive = new_slot(lowered(BaseType::Bool, running));

    Value count = b.op(jit::Op::RecordCount, set);
    region_ = b.begin_loop(b.op(jit::Op::ILt, b.i(0), count), loop_site(stmt));
    Value record = b.loop_var(b.i(0));
    std::vector<int> slots = carried_slots(changes);
    loops_.push_back(jumps);
    bool leaves = leaves_loop(changes);
    if (leaves) slots.push_back(alive);
    Carried carried = open_carried(std::move(slots));
    loop_counters.push_back(record);
    running = read_slot(alive).c[0];
    turn(record);
    if (leaves) {
        Value rest = running;
        if (jumps.continued >= 0) rest = b.logical_or(rest, read_slot(jumps.continued).c[0]);
        write_slot(alive, lowered(BaseType::Bool, rest));
    }
    loop_counters.pop_back();
    loops_.pop_back();
    std::vector<Value> next = {b.iadd(record, b.i(1))};
    close_carried(carried, next);
    b.end_loop(b.op(jit::Op::ILt, next[0], count), next);
    carried_out(carried);
    for (int slot : {jumps.broken, jumps.continued, alive})
        if (slot >= 0) free_slot(slot);
    in_loop_ = was_in_loop;
    region_ = outer_region;
    running = after_loop(changes, outer);
}

// "light:x", variable: as lightsource("x", variable). "lightcache" needs nothing: records of a
// point are shared by all loops.
void Lowering::light_pairs(const IlluminanceStmt& stmt) {
    for (size_t k = 1; k < stmt.pairs.size(); k += 2) {
        std::string_view name = pair_name(stmt.pairs, k);
        if (name.starts_with("send:"))
            report(Code::RSL_LIGHT_PAIR, stmt.pairs[k]->span.where, name);
        if (!is_light_output(name)) continue;
        Target to = target(*stmt.pairs[k]);
        Lowered before = load(to);
        Value known;
        store(to, light_message(std::string(name.substr(6)), stmt.pairs[k]->type, {&before, 1},
                                &known)[0]);
    }
}

// One turn: the body for the lanes that this record reaches.
void Lowering::light_body(const IlluminanceStmt& stmt, Value set, Value record, const Cone& around,
                          const Lowered& position) {
    Value kind = record_uniform(set, record, kLightKind, jit::Type::I);
    Value wanted = b.logical_not(b.op(jit::Op::IEq, kind, b.i(kLightAmbient)));
    if (stmt.category)
        wanted = b.logical_and(wanted, category_matches(set, record, *stmt.category));
    guarded(b.logical_and(running, wanted), [&] {
        V3 L = record_triple(set, record, kLightL);
        Value dark = b.op(jit::Op::IEq, record_field(set, record, kLightLit, jit::Type::I), b.i(0));
        Value lit = b.and_not(inside(around, L), dark);
        guarded(b.logical_and(running, lit), [&] {
            // Through write_slot: a body that assigns them (to no effect outside) is merged with
            // what they were before.
            constexpr Global kSet[] = {Global::L, Global::Cl, Global::Ol, Global::Ps};
            Slot saved[4];
            for (size_t k = 0; k < 4; ++k) saved[k] = slots_[size_t(kSet[k])];
            V3 Cl = record_triple(set, record, kLightCl), Ol = record_triple(set, record, kLightOl);
            write_slot(int(Global::L), lowered(BaseType::Vector, L));
            write_slot(int(Global::Cl), lowered(BaseType::Color, Cl));
            write_slot(int(Global::Ol), lowered(BaseType::Color, Ol));
            write_slot(int(Global::Ps), position);
            Value outer_set = std::exchange(current_set, set);
            Value outer_record = std::exchange(current_record, record);
            light_pairs(stmt);
            statement(*stmt.body);
            current_set = outer_set;
            current_record = outer_record;
            for (size_t k = 0; k < 4; ++k) slots_[size_t(kSet[k])] = saved[k];
        });
    });
}

// ---- records as light shaders write them --------------------------------------------------------

void Lowering::begin_light(const Changes& changes) {
    for (Global id : {Global::L, Global::Cl, Global::Ol})
        write_slot(int(id), zero(global_info(id).type.base));
    for (const Stmt* stmt : changes.light_sources) {
        Lowered dark = zero(BaseType::Color);
        LightSource& light = light_sources_.emplace_back();
        light.stmt = stmt;
        light.L = new_slot(zero(BaseType::Vector));
        light.Cl = new_slot(dark), light.Ol = new_slot(dark);
        light.lit = new_slot(zero(BaseType::Bool));
    }
    bool shadows = !(changes.effects & (kShadows | kTraces));
    for (const LightSource& light : light_sources_)
        out.light_statements.push_back(
            {light.stmt->kind == StmtKind::Solar ? kLightSolar : kLightIlluminate, shadows});
    if (light_sources_.empty()) out.light_statements.push_back({kLightAmbient, false});
}

// L points from the light. Lanes outside the cone keep a dark record.
void Lowering::illuminate(const Stmt& stmt, const Expr* position, const Expr* axis,
                          const Expr* angle, const Stmt& body) {
    V3 L;
    if (position)
        L = sub(read_global(Global::Ps).v3(), expr(*position).v3());
    else if (axis)
        L = normalize(expr(*axis).v3());
    else
        L = neg(normalize(read_global(Global::Ns).v3()));
    Value lit = b.m(true);
    if (position) lit = inside(cone(axis, angle), L);
    guarded(b.logical_and(running, lit), [&] {
        write_slot(int(Global::L), lowered(BaseType::Vector, L));
        bool outer_solar = std::exchange(in_solar, position == nullptr);
        statement(body);
        in_solar = outer_solar;
        for (const LightSource& light : light_sources_) {
            if (light.stmt != &stmt) continue;
            write_slot(light.L, read_global(Global::L));
            write_slot(light.Cl, read_global(Global::Cl));
            write_slot(light.Ol, read_global(Global::Ol));
            write_slot(light.lit, lowered(BaseType::Bool, running));
        }
    });
    for (LightSource& light : light_sources_)
        if (light.stmt == &stmt)
            light.left_Cl = read_global(Global::Cl), light.left_Ol = read_global(Global::Ol);
}

// What is the same for all lights' sake (no L, no Ol, lit everywhere) is no output: a renderer
// fills records for every grid, and memory is most of what that costs.
void Lowering::light_outputs() {
    auto triple = [&](const std::string& name, const Lowered& value) {
        if (is_zero(value.c[0]) && is_zero(value.c[1]) && is_zero(value.c[2])) return;
        for (int c = 0; c < 3; ++c)
            b.output({name + component_suffix(value.type, c), jit::Type::F}, value.c[size_t(c)]);
    };
    auto record = [&](size_t k, const Lowered& L, const Lowered& Cl, const Lowered& Ol, Value lit) {
        std::string prefix = "light:" + std::to_string(k) + ":";
        triple(prefix + "L", lowered(BaseType::Vector, neg(L.v3())));
        triple(prefix + "Cl", Cl);
        triple(prefix + "Ol", Ol);
        bool everywhere = false;
        if (b.constant_m(lit, &everywhere) && everywhere) return;
        b.output({prefix + "lit", jit::Type::I}, b.select(lit, b.i(1), b.i(0)));
    };
    // What a light assigns behind its only statement counts too, where that lights.
    auto at_end = [&](const LightSource& light, Global id, int slot, const Lowered& left) {
        Lowered last = read_global(id);
        if (light_sources_.size() > 1 || last.c == left.c) return read_slot(slot);
        return lowered(last.type, select(read_slot(light.lit).c[0], last.v3(), f3(0)));
    };
    for (size_t k = 0; k < light_sources_.size(); ++k) {
        const LightSource& light = light_sources_[k];
        record(k, read_slot(light.L), at_end(light, Global::Cl, light.Cl, light.left_Cl),
               at_end(light, Global::Ol, light.Ol, light.left_Ol), read_slot(light.lit).c[0]);
    }
    if (light_sources_.empty())
        record(0, zero(BaseType::Vector), read_global(Global::Cl), read_global(Global::Ol),
               b.m(true));
}

}  // namespace kinora::rsl
