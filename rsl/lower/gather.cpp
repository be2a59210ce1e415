// rsl/lower/gather.cpp: gather: all rays of the statement are shot by one service, then its body is
// replayed once for each (docs/decisions.md#lights-run-once).
#include "rsl/lower/gather.h"

#include <set>

#include "rsl/lower/builtin_call.h"
#include "rsl/lower/records.h"
#include "rsl/lower/values.h"
#include "rsl/model/pairs.h"

namespace kinora::rsl {

// The results a statement asks for: where they go, and their first columns.
struct Gather::Results {
    struct Item {
        std::string name;
        const Expr* variable;
        int column;
        bool of_ray;  // known for rays that meet nothing too
    };
    std::vector<Item> items;
};

namespace {

// Results that are no output parameters: name and type letter.
struct Known {
    std::string_view name;
    BaseType type;
};
constexpr Known kKnown[] = {
    {"surface:Ci", BaseType::Color},
    {"surface:Oi", BaseType::Color},
    {"surface:P", BaseType::Point},
    {"surface:N", BaseType::Normal},
    {"ray:origin", BaseType::Point},
    {"ray:direction", BaseType::Vector},
    {"ray:length", BaseType::Float},
    {"primitive:P", BaseType::Point},
    {"primitive:N", BaseType::Normal},
    {"primitive:Ng", BaseType::Normal},
    {"primitive:u", BaseType::Float},
    {"primitive:v", BaseType::Float},
    {"primitive:s", BaseType::Float},
    {"primitive:t", BaseType::Float},
    {"environment:color", BaseType::Color},
    {"environment:direction", BaseType::Vector},
    {"environment:solidangle", BaseType::Float},
};
const Known* find_known(std::string_view name) {
    for (const Known& row : kKnown)
        if (row.name == name) return &row;
    return nullptr;
}

bool fits(BaseType wanted, BaseType variable) {
    return wanted == variable || (is_triple(wanted) && is_triple(variable));
}

void find_gathers(const Stmt* stmt, std::set<std::string>& names) {
    if (!stmt) return;
    if (auto* gather = as_if<GatherStmt>(stmt))
        for (size_t k = 1; k < gather->pairs.size(); k += 2) {
            std::string_view name = pair_name(gather->pairs, k);
            if (name.starts_with("surface:") && (name == "surface:N" || !find_known(name)))
                names.insert(std::string(name.substr(8)));
        }
    for_each_part(
        *stmt, [](const Expr*) {}, [&](const Stmt* part) { find_gathers(part, names); });
}

}  // namespace

std::vector<std::string> gathered_parameters(const Shader& shader) {
    std::set<std::string> names;
    find_gathers(shader.definition->body, names);
    for (const Function* function : shader.functions) find_gathers(function->body, names);
    return {names.begin(), names.end()};
}

void Gather::lower(const GatherStmt& stmt) {
    if (!context_.options.want_Ci)
        return;  // opacity kernels trace nothing (docs/decisions.md#opacity)
    if (depth_ >= kGatherLevels)
        return context_.error(Code::RSL_GATHER_NESTED, stmt.span.where, kGatherLevels);
    V3 P = tree_.expr(*stmt.position).v3(), D = tree_.expr(*stmt.direction).v3();
    Value angle = tree_.value(*stmt.angle), samples = tree_.value(*stmt.samples);
    const std::string* category = e_.constant_text(tree_.value(*stmt.category));
    // "environment:sky.exr" goes through directions, with what the map shows there.
    constexpr std::string_view kOfMap = "environment:";
    bool of_map = category && category->starts_with(kOfMap);
    bool shoots = !of_map && (!category || *category != "samplepattern");
    Value map = b_.i(of_map ? intern(category->substr(kOfMap.size())) : 0);
    Value maxdist = b_.f(1e30f), bias = b_.f(-1), label = b_.i(0);
    int flags = shoots ? 0 : kGatherNoRays;
    if (shoots && !stmt.missed) flags |= kGatherHitsOnly;
    Results results;
    std::vector<LoweredShader::GatherResult> wanted;
    int column = kGatherResults;
    for (size_t k = 1; k < stmt.pairs.size(); k += 2) {
        std::string name(pair_name(stmt.pairs, k));
        const Expr& given = *stmt.pairs[k];
        if (takes_option("gather", name))
            report_idle_pair(e_, context_, "gather", name, tree_.expr(given), given.span.where);
        if (is_gather_output(name)) {
            const Known* known = find_known(name);
            bool parameter = !known && name.starts_with("surface:");
            if ((!known && !parameter) || (known && !fits(known->type, given.type.base))) {
                context_.report(Code::RSL_GATHER_OUTPUT, given.span.where, name,
                                type_name(given.type.base));
                continue;
            }
            int32_t variable = name.starts_with("surface:") ? name_id(name.substr(8)) : 0;
            wanted.push_back({name, given.type.base, variable});
            results.items.push_back(
                {name, &given, column, name.starts_with("ray:") || name.starts_with(kOfMap)});
            column += component_count(given.type.base);
        } else if (name == "maxdist") {
            maxdist = tree_.value(given);
        } else if (name == "bias") {
            bias = tree_.value(given);
        } else if (name == "label") {
            label = tree_.value(given);
        } else if (name == "distribution") {
            const std::string* text = e_.constant_text(tree_.value(given));
            if (text && *text == "cosine") flags |= kGatherCosine;
        } else if (!takes_option("gather", name)) {
            context_.report(Code::RSL_PAIR_UNKNOWN, given.span.where, name, "gather");
        }
    }
    auto seed = seeds_.sample(uint32_t(context_.out.gathers.size()) * 2654435761u + 77);
    Value set = services_.call(Service::gather,
                               std::array{seed[0], seed[1], b_.i(int(context_.out.gathers.size())),
                                          b_.i(depth_), P[0], P[1], P[2], D[0], D[1], D[2], angle,
                                          samples, maxdist, bias, label, b_.i(flags), map})[0];
    context_.out.gathers.push_back(std::move(wanted));

    ++depth_;
    loops_.replay(stmt, set, [&](Value record) {
        turn(stmt, set, record, results, of_map || (!shoots && !stmt.missed));
    });
    --depth_;
}

// Lanes whose ray hit something run the body, those whose ray met nothing the other branch.
void Gather::turn(const GatherStmt& stmt, Value set, Value record, Results& results,
                  bool only_body) {
    Value state = record_field(b_, set, record, kGatherState, jit::Type::I);
    Value entered = e_.running;
    auto lanes_in = [&](GatherState s) {
        return b_.logical_and(entered, b_.op(jit::Op::IEq, state, b_.i(s)));
    };
    // Without rays nothing is hit: the branch for misses runs, or the only one there is.
    regions_.guarded(lanes_in(only_body ? kGatherMiss : kGatherHit),
                     [&] { branch(stmt, set, record, results, true); });
    if (!stmt.missed || only_body) return;
    Value after_hits = e_.running;
    e_.running = entered;
    regions_.guarded(lanes_in(kGatherMiss), [&] { branch(stmt, set, record, results, false); });
    if (after_hits != entered)
        e_.running = e_.running == entered ? after_hits : b_.logical_and(e_.running, after_hits);
}

// One ray: its results into their variables, then the branch.
void Gather::branch(const GatherStmt& stmt, Value set, Value record, Results& results, bool hit) {
    for (const Results::Item& item : results.items) {
        if (!hit && !item.of_ray) continue;
        LValue to = variables_.target(*item.variable);
        Lowered x = zero(e_, item.variable->type.base);
        bool text = x.type == BaseType::String;
        for (int c = 0; c < x.size(); ++c)
            x.c[size_t(c)] =
                record_field(b_, set, record, item.column + c, text ? jit::Type::I : jit::Type::F);
        variables_.store(to, x);
    }
    tree_.statement(hit ? *stmt.body : *stmt.missed);
}

}  // namespace kinora::rsl
