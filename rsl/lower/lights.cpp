// rsl/lower/lights.cpp: light records read by surfaces, and written by light shaders.
#include "rsl/lower/lights.h"

#include <algorithm>
#include <cmath>

#include "jit/math/math.h"
#include "rsl/lower/services.h"
#include "rsl/lower/values.h"
#include "rsl/model/builtin.h"
#include "rsl/model/kernel_keys.h"
#include "rsl/model/pairs.h"

namespace kinora::rsl {

// Within `angle` of the axis: cos(angle) |L| |axis| <= L . axis.
struct LightCone {
    bool all = true;
    V3 axis{};
    Value cosine = jit::kNone;  // times the length of the axis
    bool half = false;          // known to be 90 degrees at most
};

namespace {

constexpr float kRightAngle = 1.57081f;  // PI / 2 in as many digits as people write

LightCone cone_of(Emitter& e, TreeWalk& tree, const Expr* axis, const Expr* angle) {
    if (!axis) return {};
    V3 a = tree.expr(*axis).v3();
    Value half = tree.value(*angle);
    float known;
    bool constant = e.b.constant_f(half, &known);
    if (constant && known >= 3.14159f) return {};
    Value cosine = jit::math::cos(e.b, half, e.tier);
    if (!constant)  // nothing lies outside a cone of half a turn or more
        cosine = e.b.select(e.b.le(e.f(3.14159f), half), e.f(-2), cosine);
    return {false, a, e.b.mul(cosine, e.length(a)), constant && std::abs(known) <= kRightAngle};
}

Value inside(Emitter& e, const LightCone& cone, const V3& L) {
    if (cone.all) return e.b.m(true);
    return e.b.le(e.mul(cone.cosine, e.length(L)), e.dot(L, cone.axis));
}

}  // namespace

void Illuminance::lower(const IlluminanceStmt& stmt) {
    Lowered position = tree_.expr(*stmt.position);
    Value set = set_of(stmt, position);
    LightCone around = cone_of(e_, tree_, stmt.axis, stmt.angle);
    records_.look_about(set, around.half ? &around.axis : nullptr);
    if (!stmt.category) records_.look_at_all(false);
    loops_.replay(stmt, set,
                  [&](Value record) { light_body(stmt, set, record, around, position); });
}

// "recordset", number: the set that samplinglights() gave; else the lights at the position.
Value Illuminance::set_of(const IlluminanceStmt& stmt, const Lowered& position) {
    for (size_t k = 1; k < stmt.pairs.size(); k += 2)
        if (pair_name(stmt.pairs, k) == kRecordSetPair) return b_.ftoi(tree_.value(*stmt.pairs[k]));
    return records_.set_at(position.v3());
}

// "light:x", variable: as lightsource("x", variable). "lightcache" needs nothing: records of a
// point are shared by all loops.
void Illuminance::light_pairs(const IlluminanceStmt& stmt) {
    for (size_t k = 1; k < stmt.pairs.size(); k += 2) {
        std::string_view name = pair_name(stmt.pairs, k);
        if (name.starts_with("send:"))
            context_.report(Code::RSL_LIGHT_PAIR, stmt.pairs[k]->span.where, name);
        if (!is_light_output(name)) continue;
        LValue to = variables_.target(*stmt.pairs[k]);
        Lowered before = variables_.load(to);
        Value known;
        variables_.store(to, records_.message(std::string(name.substr(6)), stmt.pairs[k]->type,
                                              {&before, 1}, &known)[0]);
    }
}

// One turn: the body for the lanes that this record reaches.
void Illuminance::light_body(const IlluminanceStmt& stmt, Value set, Value record,
                             const LightCone& around, const Lowered& position) {
    Value kind = record_uniform(b_, set, record, kLightKind, jit::Type::I);
    Value wanted = b_.logical_not(b_.op(jit::Op::IEq, kind, b_.i(kLightAmbient)));
    if (stmt.category)
        wanted = b_.logical_and(wanted,
                                records_.category_matches(set, record, tree_.value(*stmt.category),
                                                          stmt.category->span.where));
    regions_.guarded(b_.logical_and(e_.running, wanted), [&] {
        V3 L = record_triple(b_, set, record, kLightL);
        Value dark =
            b_.op(jit::Op::IEq, record_field(b_, set, record, kLightLit, jit::Type::I), b_.i(0));
        Value lit = b_.and_not(inside(e_, around, L), dark);
        regions_.guarded(b_.logical_and(e_.running, lit), [&] {
            // Through write(): a body that assigns them (to no effect outside) is merged with
            // what they were before.
            constexpr Global kSet[] = {Global::L, Global::Cl, Global::Ol, Global::Ps};
            Slots::Slot saved[4];
            for (size_t k = 0; k < 4; ++k) saved[k] = slots_.peek(int(kSet[k]));
            V3 Cl = record_triple(b_, set, record, kLightCl),
               Ol = record_triple(b_, set, record, kLightOl);
            slots_.write(int(Global::L), lowered(BaseType::Vector, L));
            slots_.write(int(Global::Cl), lowered(BaseType::Color, Cl));
            slots_.write(int(Global::Ol), lowered(BaseType::Color, Ol));
            slots_.write(int(Global::Ps), position);
            LightRecords::State outer = records_.set_current({set, record});
            light_pairs(stmt);
            tree_.statement(*stmt.body);
            records_.set_current(outer);
            for (size_t k = 0; k < 4; ++k) slots_.restore(int(kSet[k]), saved[k]);
        });
    });
}

// ---- records as light shaders write them --------------------------------------------------------

void LightShader::begin(const Changes& changes) {
    for (Global id : {Global::L, Global::Cl, Global::Ol})
        slots_.write(int(id), zero(e_, global_info(id).type.base));
    for (const Stmt* stmt : changes.light_sources) {
        Lowered dark = zero(e_, BaseType::Color);
        Source& light = sources_.emplace_back();
        light.stmt = stmt;
        light.L = slots_.add(zero(e_, BaseType::Vector));
        light.Cl = slots_.add(dark), light.Ol = slots_.add(dark);
        light.lit = slots_.add(zero(e_, BaseType::Bool));
        light.spread = slots_.add(zero(e_, BaseType::Float));
        loops_.add_written(stmt, {light.L, light.Cl, light.Ol, light.lit, light.spread});
    }
    bool shadows = !(changes.effects & (kShadows | kTraces));
    for (const Source& light : sources_)
        context_.out.light_statements.push_back(
            {light.stmt->kind == StmtKind::Solar ? kLightSolar : kLightIlluminate, shadows});
    const bool sampled = changes.effects & kSendsSamples;
    if (sampled) context_.out.light_statements.push_back({kLightIlluminate, shadows, true});
    if (sources_.empty() && !sampled)
        context_.out.light_statements.push_back({kLightAmbient, false});
}

// L of a statement whose light comes from a cone: a direction in it that the renderer gives, or the
// axis where that is 0. Blocks that do not read L leave no such input.
V3 LightShader::sent_along(const Stmt& stmt, const V3& axis) {
    const auto is_own = [&](const Source& light) { return light.stmt == &stmt; };
    const size_t k = size_t(std::ranges::find_if(sources_, is_own) - sources_.begin());
    V3 given;
    for (int c = 0; c < 3; ++c)
        given[size_t(c)] =
            scalar_input(b_, light_key(k, kLightL, c), jit::Type::F, jit::Rate::Point);
    return e_.select(b_.lt(e_.f(0), e_.dot(given, given)), given, axis);
}

// L points from the light. Lanes outside the cone keep a dark record.
void LightShader::illuminate(const Stmt& stmt, const Expr* position, const Expr* axis,
                             const Expr* angle, const Stmt& body) {
    V3 L;
    if (position)
        L = e_.sub(globals_.read(Global::Ps).v3(), tree_.expr(*position).v3());
    else if (axis)
        L = e_.normalize(tree_.expr(*axis).v3());
    else
        L = e_.neg(e_.normalize(globals_.read(Global::Ns).v3()));
    Lowered spread;
    if (!position && axis) spread = tree_.expr(*angle);
    const bool spreads = !position && axis && !e_.is_zero(spread.c[0]);
    Value lit = b_.m(true);
    if (position) lit = inside(e_, cone_of(e_, tree_, axis, angle), L);
    regions_.guarded(b_.logical_and(e_.running, lit), [&] {
        const V3 sent = spreads ? sent_along(stmt, L) : L;
        slots_.write(int(Global::L), lowered(BaseType::Vector, sent));
        bool outer_solar = std::exchange(in_solar_, position == nullptr);
        tree_.statement(body);
        in_solar_ = outer_solar;
        // The axis, unless the block sets L.
        Lowered shines = globals_.read(Global::L);
        if (shines.c == lowered(BaseType::Vector, sent).c) shines = lowered(BaseType::Vector, L);
        for (const Source& light : sources_) {
            if (light.stmt != &stmt) continue;
            slots_.write(light.L, shines);
            slots_.write(light.Cl, globals_.read(Global::Cl));
            slots_.write(light.Ol, globals_.read(Global::Ol));
            slots_.write(light.lit, lowered(BaseType::Bool, e_.running));
            if (spreads) slots_.write(light.spread, spread);
        }
    });
    for (Source& light : sources_)
        if (light.stmt == &stmt)
            light.left_Cl = globals_.read(Global::Cl), light.left_Ol = globals_.read(Global::Ol);
}

// What is the same for all lights' sake (no L, no Ol, lit everywhere) is no output: a renderer
// fills records for every grid, and memory is most of what that costs.
void LightShader::outputs() {
    auto output = [&](const KernelKey& key, jit::Type type, Value value) {
        b_.output({text(key), type, packed(key)}, value);
    };
    auto triple = [&](size_t k, LightColumn column, const Lowered& value) {
        if (e_.is_zero(value.c[0]) && e_.is_zero(value.c[1]) && e_.is_zero(value.c[2])) return;
        for (int c = 0; c < 3; ++c)
            output(light_key(k, column, c), jit::Type::F, value.c[size_t(c)]);
    };
    auto record = [&](size_t k, const Lowered& L, const Lowered& Cl, const Lowered& Ol, Value lit) {
        triple(k, kLightL, lowered(BaseType::Vector, e_.neg(L.v3())));
        triple(k, kLightCl, Cl);
        triple(k, kLightOl, Ol);
        bool everywhere = false;
        if (b_.constant_m(lit, &everywhere) && everywhere) return;
        output(light_key(k, kLightLit), jit::Type::I, b_.select(lit, b_.i(1), b_.i(0)));
    };
    // What a light assigns behind its only statement counts too, where that lights.
    auto at_end = [&](const Source& light, Global id, int slot, const Lowered& left) {
        Lowered last = globals_.read(id);
        if (sources_.size() > 1 || last.c == left.c) return slots_.read(slot);
        return lowered(last.type, e_.select(slots_.read(light.lit).c[0], last.v3(), e_.f3(0)));
    };
    for (size_t k = 0; k < sources_.size(); ++k) {
        const Source& light = sources_[k];
        record(k, slots_.read(light.L), at_end(light, Global::Cl, light.Cl, light.left_Cl),
               at_end(light, Global::Ol, light.Ol, light.left_Ol), slots_.read(light.lit).c[0]);
        const Value spread = slots_.read(light.spread).c[0];
        if (!e_.is_zero(spread)) output(light_key(k, kLightSpread), jit::Type::F, spread);
    }
    if (sources_.empty() && !context_.out.light_statements.back().sampled)
        record(0, zero(e_, BaseType::Vector), globals_.read(Global::Cl), globals_.read(Global::Ol),
               b_.m(true));
}

}  // namespace kinora::rsl
