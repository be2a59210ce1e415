// rsl/check/overloads.cpp: the costs of calls, and the cheapest callee.
#include "rsl/check/overloads.h"

#include <algorithm>

#include "rsl/builtins/table.h"
#include "rsl/check/convert.h"

namespace kinora::rsl {

namespace {

constexpr int kArgumentWeight = 64;  // an argument's conversion outweighs any of the result's
constexpr int kUnwantedResult = 50;  // a result that does not convert to what is wanted

int result_cost(Type result, BaseType wanted) {
    if (wanted == BaseType::Invalid) return 0;
    int cost = conversion_cost(result.base, wanted);
    return cost < 0 ? kUnwantedResult : cost;
}

// "name", value, "name", value from `first` on.
int pairs_cost(const CallExpr& e, size_t first) {
    if ((e.args.size() - first) % 2 != 0) return -1;
    for (size_t i = first; i < e.args.size(); i += 2)
        if (e.args[i]->type != Type{BaseType::String, -1}) return -1;
    return 0;
}

}  // namespace

int OverloadResolution::argument_cost(const Expr& argument, Type type, bool output) const {
    if (types_.is_open(argument)) {
        if (output || type.is_array()) return -1;
        if (type.base == BaseType::Invalid || types_.can_be(argument, type.base)) return 0;
        if (types_.can_be(argument, BaseType::Float))
            return conversion_cost(BaseType::Float, type.base);
        // A triple in any case: (x, y, z), or noise(P) beside a color.
        bool triple =
            types_.can_be(argument, BaseType::Point) || types_.can_be(argument, BaseType::Color);
        return conversion_cost(triple ? BaseType::Point : BaseType::Float, type.base);
    }
    if (argument.type.base == BaseType::Invalid) return 0;  // already reported
    if (type.is_array() || argument.type.is_array()) {
        bool lengths = type.array_length == argument.type.array_length || type.array_length == 0 ||
                       argument.type.array_length == 0;
        bool fits = type.is_array() && argument.type.is_array() && lengths &&
                    type.base == argument.type.base;
        return fits ? 0 : -1;
    }
    if (type.base == BaseType::Invalid) return argument.type.base == BaseType::Void ? -1 : 0;
    if (output) {
        bool triples = is_triple(type) && is_triple(argument.type);
        return argument.type.base == type.base ? 0 : triples ? 1 : -1;
    }
    return conversion_cost(argument.type.base, type.base);
}

std::string_view written_name(std::string_view name) {
    return name.substr(0, name.find(' '));
}

size_t written_parameters(const Function& f) {
    size_t count = 0;
    std::string_view before;
    for (const Symbol* p : f.parameters) {
        size_t arrow = p->name.find("->");
        std::string_view object = p->name.substr(0, arrow);
        bool member = arrow != std::string_view::npos;
        bool counts = !member || (object != before && object != "this" && object != "return");
        count += counts;
        before = member ? object : std::string_view();
    }
    return count;
}

bool takes_count(const Function& f, size_t arguments) {
    if (arguments > f.parameters.size()) return false;
    auto left_out = f.parameters.subspan(arguments);
    return std::all_of(left_out.begin(), left_out.end(),
                       [](const Symbol* p) { return p->initial; });
}

int OverloadResolution::function_cost(const CallExpr& e, const Function& f, BaseType wanted) const {
    if (!takes_count(f, e.args.size())) return -1;
    int total = result_cost(f.result, wanted);
    for (size_t i = 0; i < e.args.size(); ++i) {
        int cost = argument_cost(*e.args[i], f.parameters[i]->type, f.parameters[i]->output);
        if (cost < 0) return -1;
        total += cost * kArgumentWeight;
    }
    return total;
}

int OverloadResolution::builtin_cost(const CallExpr& e, const Signature& s, BaseType wanted) const {
    size_t fixed = s.arguments.size();
    if (e.args.size() < fixed || (e.args.size() > fixed && !s.repeats && !s.pairs)) return -1;
    int total = result_cost(s.result, wanted);
    for (size_t i = 0; i < e.args.size(); ++i) {
        if (i >= fixed && s.pairs) return pairs_cost(e, i) < 0 ? -1 : total;
        const Signature::Argument& a = i < fixed ? s.arguments[i] : s.repeated;
        int cost = argument_cost(*e.args[i], a.type, a.output);
        if (cost < 0) return -1;
        // abs(noise(P)) is a float, as in the specification, which has no other abs: a
        // componentwise form is for arguments that are triples.
        if (types_.is_open(*e.args[i]) && a.type.base != BaseType::Float &&
            types_.can_be(*e.args[i], BaseType::Float))
            ++cost;
        total += cost * kArgumentWeight;
    }
    return total;
}

// ---- choice -------------------------------------------------------------------------------------

Callee OverloadResolution::choose(const CallExpr& e, std::span<Function* const> functions,
                                  BaseType wanted) const {
    Callee best;
    int best_cost = -1;
    for (Function* f : functions) {
        int cost = function_cost(e, *f, wanted);
        if (cost < 0 || (best && cost >= best_cost)) continue;
        best.function = f;
        best_cost = cost;
    }
    if (best) return best;
    best.builtin = choose_builtin(e, wanted);
    bool counts = functions.size() == 1 && takes_count(*functions[0], e.args.size());
    if (!best && counts) best.function = functions[0];
    return best;
}

const Overload* OverloadResolution::choose_builtin(const CallExpr& e, BaseType wanted) const {
    const Overload* best = nullptr;
    int best_cost = -1;
    for (const Overload& o : find_builtin(e.name)) {
        int cost = builtin_cost(e, o.signature, wanted);
        if (cost < 0 || (best && cost >= best_cost)) continue;
        best = &o;
        best_cost = cost;
    }
    return best;
}

}  // namespace kinora::rsl
