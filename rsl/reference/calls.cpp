// rsl/reference/calls.cpp: calls of the user's functions and of built-ins.
#include <algorithm>

#include "rsl/model/limits.h"
#include "rsl/model/pairs.h"
#include "rsl/reference/reference_p.h"

namespace kinora::rsl {

namespace {

// The function itself, or one that it is nested in?
bool encloses(const Function* outer, const Function* inner) {
    for (; inner; inner = inner->parent)
        if (inner == outer) return true;
    return false;
}

}  // namespace

// docs/numerics.md#recursion.
template <class Real>
bool Reference<Real>::may_call(const Function& f) {
    if (!f.recursive || call_depth_ == 0) return true;
    if (decide(call_depth_ < kMaxCallDepth && calls_left_ > 0)) return true;
    ++result.faults;
    return false;
}

// The body of a function that calls itself: its random numbers follow the path of calls and the
// turns of the loops on the way.
template <class Real>
void Reference<Real>::run_again(const Function& f) {
    calls_left_ = call_depth_ == 0 ? kMaxRecursiveCalls - 1 : calls_left_ - 1;
    for (int32_t turn : loop_counters) inlined.path = inlined.path * 31 + uint32_t(turn);
    std::vector<int32_t> counters = std::exchange(loop_counters, {});
    ++call_depth_;
    block(f.body->body);
    --call_depth_;
    loop_counters = std::move(counters);
}

// What an output parameter stands for while the body runs: a variable that is its argument. A
// function that calls itself copies in and out, as elements and components do.
template <class Real>
const Symbol* Reference<Real>::lent(const CallExpr& e, size_t k) const {
    const Symbol& parameter = *e.function->parameters[k];
    auto* variable = as_if<VariableExpr>(e.args[k]);
    if (!variable || !parameter.output || e.function->recursive) return nullptr;
    const Symbol& symbol = means(*variable->symbol);
    return symbol.type.base == parameter.type.base ? &symbol : nullptr;
}

template <class Real>
[[gnu::noinline]] void Reference<Real>::set_array(const Expr& variable, const Storage& items) {
    const Symbol& symbol = means(*as<VariableExpr>(variable).symbol);
    storage(symbol) = items;
    note(symbol);
}

// Arguments are copied in before the body runs and, if output, copied out after it.
template <class Real>
auto Reference<Real>::call_function(const CallExpr& e) -> Item {
    const Function& f = *e.function;
    std::vector<Storage> values;
    for (const Expr* argument : e.args)
        values.push_back(argument->type.is_array() ? storage(*as<VariableExpr>(*argument).symbol)
                                                   : Storage{expr(*argument)});
    if (!may_call(f)) return Item(f.result.base);
    std::unordered_map<const Symbol*, Storage> kept;
    if (f.recursive)
        for (auto& [symbol, items] : variables_)
            if (symbol->function && !encloses(symbol->function, f.parent)) kept[symbol] = items;
    auto stood_for = stands_for_, stand_for = stands_for_;
    for (size_t k = 0; k < e.args.size(); ++k) {
        stand_for.erase(f.parameters[k]);
        if (const Symbol* symbol = lent(e, k))
            stand_for[f.parameters[k]] = symbol;
        else
            variables_[f.parameters[k]] = values[k];
    }
    stands_for_ = std::move(stand_for);
    const uint32_t path = inlined.path;
    inlined.path = inlined.path * 31 + e.site + 1;
    const bool stratified =
        std::exchange(inlined.stratifies, inlined.stratifies || is_sample_method(f.name));
    Item outer = std::exchange(returned_, Item(f.result.base));
    const Function* caller = std::exchange(function_, &f);
    f.recursive ? run_again(f) : void(block(f.body->body));
    function_ = caller;
    inlined.path = path;
    inlined.stratifies = stratified;
    Item value = std::exchange(returned_, outer);
    std::vector<Storage> outputs;
    for (const Symbol* parameter : f.parameters) outputs.push_back(variables_[parameter]);
    for (auto& [symbol, items] : kept) variables_[symbol] = items;
    stands_for_ = std::move(stood_for);
    for (size_t k = 0; k < e.args.size(); ++k) {
        if (!f.parameters[k]->output || lent(e, k)) continue;
        Storage& after = outputs[k];
        if (e.args[k]->type.is_array())
            set_array(*e.args[k], after);
        else
            store(*e.args[k], after[0]);
    }
    return value;
}

// What a row computes from arguments of some size may be off by their rounding, even where it gives
// 0 or another whole number: fresnel() between equal media.
template <class Real>
void Reference<Real>::move_results(RefCall<Real>& call, size_t plain) {
    Real size = 0;
    for (const Item& x : call.args)
        for (size_t k = 0; is_numeric(x.type) && k < x.size(); ++k)
            size = std::max(size, std::fabs(x.c[k].x));
    size = std::min(size, Real(1));
    auto move = [&](Item& x) {
        for (size_t k = 0; is_numeric(x.type) && k < x.size(); ++k) x.c[k].x += size * next_move();
    };
    move(call.result);
    for (size_t k = 0; k < plain && k < call.call.signature->arguments.size(); ++k)
        if (call.call.signature->arguments[k].output) move(call.args[k]);
}

template <class Real>
auto Reference<Real>::call_builtin(const CallExpr& e) -> Item {
    RefCall<Real> call{*this, e, {}, {}, {}, Item(e.type.base)};
    size_t plain = e.signature->pairs ? std::min<size_t>(e.pairs, e.args.size()) : e.args.size();
    for (size_t k = 0; k < plain; ++k) {
        bool array = e.args[k]->type.is_array();
        call.arrays.push_back(array ? storage(*as<VariableExpr>(*e.args[k]).symbol) : Storage{});
        call.args.push_back(array ? Item(e.args[k]->type.base) : expr(*e.args[k]));
    }
    for (size_t k = plain; k + 1 < e.args.size(); k += 2)
        if (!e.args[k + 1]->type.is_array())
            call.pairs.push_back({expr(*e.args[k]).text(), expr(*e.args[k + 1])});
    void (*meaning)(RefCall<Real>&) = nullptr;
    if constexpr (std::is_same_v<Real, float>)
        meaning = e.builtin->ref.single;
    else
        meaning = e.builtin->ref.precise;
    if (meaning)
        meaning(call);
    else
        result.missing = e.builtin->name;
    if (in.jitter != 0 && e.builtin->tolerance_ulp > 0) move_results(call, plain);
    for (size_t k = 0; k < plain && k < e.signature->arguments.size(); ++k)
        if (e.signature->arguments[k].output && e.args[k]->type.is_array())
            set_array(*e.args[k], call.arrays[k]);
        else if (e.signature->arguments[k].output)
            store(*e.args[k], call.args[k]);
    for (size_t k = plain, p = 0; k + 1 < e.args.size(); k += 2) {
        if (e.args[k + 1]->type.is_array()) continue;
        if (is_output_pair(e, k + 1)) store(*e.args[k + 1], call.pairs[p].second);
        ++p;
    }
    return jittered(call.result);
}

#define KINORA_CALL_METHODS(Real)                                        \
    template auto Reference<Real>::call_function(const CallExpr&)->Item; \
    template auto Reference<Real>::call_builtin(const CallExpr&)->Item;
KINORA_CALL_METHODS(float)
KINORA_CALL_METHODS(double)

}  // namespace kinora::rsl
