// rsl/reference/control.cpp: statements, at one point.
#include "rsl/model/pairs.h"
#include "rsl/reference/reference_p.h"

namespace kinora::rsl {

template <class Real>
RefFlow Reference<Real>::block(std::span<Stmt* const> body) {
    for (const Stmt* stmt : body) {
        RefFlow flow = statement(*stmt);
        if (flow.kind != RefFlow::Next) return flow;
    }
    return {};
}

template <class Real>
RefFlow Reference<Real>::statement(const Stmt& stmt) {
    if (++statements_ > in.statement_budget) {
        result.too_long = true;
        return {RefFlow::Return, nullptr};
    }
    switch (stmt.kind) {
        case StmtKind::Block:
            return block(as<BlockStmt>(stmt).body);
        case StmtKind::Declare:
            for (const Symbol* symbol : as<DeclareStmt>(stmt).symbols) declare(*symbol);
            tell(stmt.span.where);
            return {};
        case StmtKind::Expression:
            expr(*as<ExpressionStmt>(stmt).expression);
            tell(stmt.span.where);
            return {};
        case StmtKind::If: {
            auto& node = as<IfStmt>(stmt);
            if (decide(expr(*node.condition).truth())) return statement(*node.yes);
            return node.no ? statement(*node.no) : RefFlow{};
        }
        case StmtKind::While: {
            auto& node = as<WhileStmt>(stmt);
            return loop(stmt, node.condition, *node.body, {});
        }
        case StmtKind::For: {
            auto& node = as<ForStmt>(stmt);
            block(node.init);
            return loop(stmt, node.condition, *node.body, node.step);
        }
        case StmtKind::Break:
            return {RefFlow::Break, as<BreakStmt>(stmt).loop};
        case StmtKind::Continue:
            return {RefFlow::Continue, as<ContinueStmt>(stmt).loop};
        case StmtKind::Return:
            if (const Expr* value = as<ReturnStmt>(stmt).value) returned_ = expr(*value);
            return {RefFlow::Return, nullptr};
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
        case StmtKind::Extern:
        case StmtKind::DefineFunction:
            break;  // nothing to do
    }
    return {};
}

template <class Real>
bool Reference<Real>::ends_loop(RefFlow& flow, const Stmt& stmt, bool& leave) {
    leave = flow.kind == RefFlow::Break || flow.kind == RefFlow::Return ||
            (flow.kind == RefFlow::Continue && flow.loop != &stmt);
    bool mine = flow.kind != RefFlow::Return && flow.loop == &stmt;
    if (mine) flow = {};
    return leave;
}

template <class Real>
RefFlow Reference<Real>::loop(const Stmt& stmt, const Expr* condition, const Stmt& body,
                              std::span<Expr* const> step) {
    RefFlow flow;
    bool leave = false;
    auto again = [&] { return !condition || decide(expr(*condition).truth()); };
    if (!again()) return flow;  // before the first turn, so outside of all turns to random()
    loop_counters.push_back(0);
    for (int turn = 0; turn == 0 || again(); ++turn) {
        if (turn >= in.loop_budget) {
            ++result.faults;
            break;
        }
        loop_counters.back() = turn;
        flow = statement(body);
        if (ends_loop(flow, stmt, leave)) break;
        for (const Expr* e : step) {
            expr(*e);
            tell(e->span.where);
        }
    }
    loop_counters.pop_back();
    return flow;
}

// "name" asks for lights of the category, "-name" for all others, "" for all; "a,b" for those of
// any, "-a,b" for those of none; "a|b" and "a&-b" join names, & first.
static bool matches(const ReferenceLight& light, const std::string& category) {
    auto has = [&](std::string name) {
        bool without = !name.empty() && name[0] == '-';
        if (without) name.erase(0, 1);
        bool found = false;
        for (const std::string& own : light.categories) found = found || own == name;
        return found != without;
    };
    auto split = [](const std::string& text, char at) {
        std::vector<std::string> parts{""};
        for (char c : text)
            if (c == at)
                parts.emplace_back();
            else
                parts.back() += c;
        return parts;
    };
    if (category.empty()) return true;
    for (auto& [known, answer] : light.known_categories)
        if (known == category) return answer;
    if (category.find_first_of("|&") == std::string::npos) {
        bool without = category[0] == '-';
        bool any = false;
        for (const std::string& name : split(category.substr(without ? 1 : 0), ','))
            any = any || has(name);
        return any != without;
    }
    for (const std::string& either : split(category, '|')) {
        bool all = true;
        for (const std::string& name : split(either, '&')) all = all && has(name);
        if (all) return true;
    }
    return false;
}

namespace {

const Expr* record_set(const IlluminanceStmt& stmt) {
    for (size_t k = 1; k < stmt.pairs.size(); k += 2)
        if (pair_name(stmt.pairs, k) == kRecordSetPair) return stmt.pairs[k];
    return nullptr;
}

}  // namespace

template <class Real>
RefFlow Reference<Real>::illuminance(const IlluminanceStmt& stmt) {
    std::string category = stmt.category ? expr(*stmt.category).text() : "";
    Item position = expr(*stmt.position);
    Vec<Real> axis = stmt.axis ? vec(expr(*stmt.axis)) : Vec<Real>{};
    Number angle = stmt.angle ? expr(*stmt.angle).c[0] : Number();
    constexpr Global kSet[] = {Global::L, Global::Cl, Global::Ol, Global::Ps};
    RefFlow flow;
    bool leave = false;
    loop_counters.push_back(0);
    std::span<const ReferenceLight> lights = in.lights;
    if (const Expr* set = record_set(stmt)) {
        const double number = double(expr(*set).c[0].x);
        lights = in.lights_of ? (*in.lights_of)(number) : std::span<const ReferenceLight>();
    } else if (in.lights_at) {
        lights = (*in.lights_at)(
            {double(position.c[0].x), double(position.c[1].x), double(position.c[2].x)});
    }
    for (size_t k = 0; k < lights.size() && !leave; ++k) {
        const ReferenceLight& l = lights[k];
        loop_counters.back() = int32_t(k);
        auto triple = [](BaseType type, const std::array<double, 3>& c) {
            return Item(type, Number(Real(c[0])), Number(Real(c[1])), Number(Real(c[2])));
        };
        Item L = triple(BaseType::Vector, l.L);
        bool reached = l.kind != kLightAmbient && l.lit && matches(l, category) &&
                       in_cone(vec(L), stmt.axis ? &axis : nullptr, angle);
        if (!reached) continue;
        Item saved[4];
        bool was_set[4];  // Ps is P where nothing set it
        for (size_t i = 0; i < 4; ++i) {
            was_set[i] = globals_.contains(kSet[i]);
            saved[i] = global(kSet[i]);
            globals_.try_emplace(kSet[i]);
        }
        global(Global::L) = L;
        global(Global::Cl) = triple(BaseType::Color, l.Cl);
        global(Global::Ol) = triple(BaseType::Color, l.Ol);
        global(Global::Ps) = position;
        const ReferenceLight* outer = std::exchange(light, &l);
        light_number = int(k);
        for (size_t p = 1; p < stmt.pairs.size(); p += 2) {
            std::string_view name = pair_name(stmt.pairs, p);
            if (!is_light_output(name)) continue;
            Item value(stmt.pairs[p]->type.base);
            std::vector<double> found = messages(name.substr(6), value.size());
            for (size_t i = 0; i < found.size(); ++i) value.c[i] = Real(found[i]);
            if (!found.empty()) store(*stmt.pairs[p], value);
        }
        if constexpr (kObserved)
            if (in.observer) tell_light(stmt.span.where);
        flow = statement(*stmt.body);
        light = outer;
        for (size_t i = 0; i < 4; ++i) {
            if (was_set[i] || kSet[i] != Global::Ps)
                global(kSet[i]) = saved[i];
            else
                globals_.erase(kSet[i]);
        }
        ends_loop(flow, stmt, leave);
    }
    loop_counters.pop_back();
    return flow;
}

// Service "gather" answers the number of rays, then for each its state (GatherState) and the
// results' components in the order of the statement.
template <class Real>
RefFlow Reference<Real>::gather(const GatherStmt& stmt) {
    std::vector<double> args = {0, 0, double(gathers_++), 0};
    auto add = [&](const Expr& e) {
        Item x = expr(e);
        for (size_t k = 0; k < x.size(); ++k) args.push_back(double(x.c[k].x));
    };
    std::string category = expr(*stmt.category).text();
    bool of_map = category.starts_with("environment:");
    bool shoots = category != "samplepattern" && !of_map;
    add(*stmt.position), add(*stmt.direction), add(*stmt.angle), add(*stmt.samples);
    std::vector<double> rays = service(Service::gather, args);
    size_t next = 0;
    auto number = [&] { return next < rays.size() ? rays[next++] : 0; };
    int count = int(number());
    RefFlow flow;
    bool leave = false;
    loop_counters.push_back(0);
    for (int k = 0; k < count && !leave; ++k) {
        loop_counters.back() = k;
        int state = int(number());
        bool body = state == kGatherHit || of_map || (!shoots && !stmt.missed);
        for (size_t p = 1; p < stmt.pairs.size(); p += 2) {
            std::string_view name = pair_name(stmt.pairs, p);
            if (!is_gather_output(name)) continue;
            Item value(stmt.pairs[p]->type.base);
            for (size_t c = 0; c < value.size(); ++c) value.c[c] = Number(Real(number()));
            bool branch = body || stmt.missed;
            if (state != kGatherNone && branch &&
                (body || name.starts_with("ray:") || name.starts_with("environment:")))
                store(*stmt.pairs[p], value);
        }
        const Stmt* branch = body ? stmt.body : stmt.missed;
        if (state == kGatherNone || !branch) continue;
        flow = statement(*branch);
        ends_loop(flow, stmt, leave);
    }
    loop_counters.pop_back();
    return flow;
}

// In a light: what the statement sends to Ps. Without a position it is solar.
template <class Real>
RefFlow Reference<Real>::illuminate(const Stmt& stmt, const Expr* position, const Expr* axis,
                                    const Expr* angle, const Stmt& body) {
    Vec<Real> L;
    if (position)
        L = vec(global(Global::Ps)) - vec(expr(*position));
    else if (axis)
        L = normalize(vec(expr(*axis)));
    else
        L = Number(-1) * normalize(vec(global(Global::Ns)));
    Item spread(BaseType::Float);
    if (!position && axis) spread = expr(*angle);
    if (position && axis) {
        Vec<Real> a = vec(expr(*axis));
        if (!in_cone(L, &a, expr(*angle).c[0])) return {};
    }
    global(Global::L) = {BaseType::Vector, L[0], L[1], L[2]};
    bool outer_solar = std::exchange(in_solar, position == nullptr);
    RefFlow flow = statement(body);
    in_solar = outer_solar;
    for (Source& source : sources_)
        if (source.stmt == &stmt)
            source = {&stmt, global(Global::L), global(Global::Cl), global(Global::Ol), true,
                      spread};
    return flow;
}

#define KINORA_CONTROL_METHODS(Real)                                 \
    template RefFlow Reference<Real>::block(std::span<Stmt* const>); \
    template RefFlow Reference<Real>::statement(const Stmt&);
KINORA_CONTROL_METHODS(float)
KINORA_CONTROL_METHODS(double)

}  // namespace kinora::rsl
