// jit/codegen/function_code.cpp: a function's registers and frame; the order of a loop's updates.
#include "jit/codegen/function_code_p.h"

#include <algorithm>

#include "jit/ir/planted_fault.h"

namespace kinora::jit {

namespace {

Allocation allocate(const Function& f, const Structure& structure, const FunctionPlan& plan,
                    AllocationLimits limits, bool is_kernel) {
    limits.hoist_function = is_kernel && !plan.calls;
    return allocate_registers(f, structure, plan.values, limits);
}

// The rows of arguments and results, and the counters, of the most demanding place.
struct Most {
    size_t args = 0, results = 0, loops = 0;
};

Most most_of(const Module& module, const Function& f) {
    Most most;
    size_t depth = 0;
    for (const Inst& i : f.insts) {
        if (i.op == Op::Loop) most.loops = std::max(most.loops, ++depth);
        if (i.op == Op::EndLoop) --depth;
        if (i.op != Op::Service) continue;
        const auto& results = module.services[static_cast<size_t>(i.imm)].results;
        most.args = std::max<size_t>(most.args, i.arg_count);
        most.results = std::max(most.results, results.size());
    }
    return most;
}

bool is_read(const std::vector<LoopUpdate>& updates, Value variable, size_t except) {
    for (size_t k = 0; k < updates.size(); ++k)
        if (k != except && updates[k].next == variable) return true;
    return false;
}

}  // namespace

FunctionCode::FunctionCode(const Module& module, size_t function_index, const CodeRules& rules)
    : module_(module),
      f_(module.functions[function_index]),
      is_kernel_(function_index == 0),
      index_(function_index),
      structure_(f_),
      plan_(plan_function(module_, f_, structure_, rules.plan)),
      allocation_(allocate(f_, structure_, plan_, rules.limits, is_kernel_)) {
    lay_out(rules.lanes);
}

bool FunctionCode::uses_valid_lanes() const {
    for (Value v = 0; v < f_.insts.size(); ++v) {
        Op op = inst(v).op;
        if (op == Op::Service || op == Op::Fault) return true;
        if (op == Op::Loop && plan_.values[v].masked) return true;
    }
    return false;
}

bool FunctionCode::is_zero(Value v) const {
    Op op = inst(v).op;
    return (op == Op::ConstF || op == Op::ConstI || op == Op::ConstM) && inst(v).imm == 0;
}

void FunctionCode::lay_out(int lanes) {
    auto round_up = [](size_t bytes) { return (bytes + kRow - 1) / kRow * kRow; };
    auto offset = [&] { return static_cast<int32_t>(std::min(frame_bytes_, kMostFrameBytes)); };
    auto take = [&](size_t bytes) {
        int32_t at = offset();
        frame_bytes_ += round_up(bytes);
        return at;
    };
    auto lane_bytes = static_cast<size_t>(4 * lanes);
    // The caller fills in parameters at the frame's start and finds the results behind them.
    layout_.params = take(is_kernel_ ? 0 : f_.params.size() * kRow);
    layout_.results = take(is_kernel_ ? 0 : f_.results.size() * kRow);
    layout_.vectors = take(static_cast<size_t>(allocation_.slots[0]) * lane_bytes);
    layout_.masks = take(static_cast<size_t>(allocation_.slots[1]) * 8);
    layout_.swap = take(2 * kRow);
    layout_.lanes_a = take(kRow);
    layout_.lanes_b = take(kRow);
    Most most = most_of(module_, f_);
    layout_.counters = take(4 * most.loops);
    layout_.service_args = take(most.args * kRow);
    layout_.service_results = take(most.results * kRow);
    for (const ArrayInfo& array : f_.arrays) {  // one behind the other: one fill zeroes them
        layout_.arrays.push_back(offset());
        frame_bytes_ += static_cast<size_t>(array.length) * lane_bytes;
    }
    frame_bytes_ = round_up(frame_bytes_);
    layout_.bytes = offset();
}

std::vector<LoopUpdate> FunctionCode::loop_updates(Value loop) const {
    std::span<const Value> next = f_.args_of(now());
    Value next_mask = root(now().a);
    std::vector<LoopUpdate> waiting, steps;
    Value saved[2] = {kNone, kNone};
    auto save = [&](int row, Value variable) {
        steps.push_back({variable, kNone, row});
        saved[row] = variable;
    };
    for (size_t k = 0; k < next.size(); ++k) {
        Value variable = loop + 1 + static_cast<Value>(k);
        if (variable == plan_.counted[loop]) continue;
        if (root(next[k]) == variable || plan_.values[next[k]].alias == variable) continue;
        waiting.push_back({variable, root(next[k])});
        // The next mask is read last, after the variable it may be.
        if (variable == next_mask) save(1, variable);
    }
    auto must_wait = [&](size_t k) {
        Value variable = waiting[k].variable;
        if (saved[0] == variable || saved[1] == variable) return false;
        return !planted(PlantedFault::LoopVariablesInTurn) && is_read(waiting, variable, k);
    };
    while (!waiting.empty()) {
        size_t k = 0;
        while (k < waiting.size() && must_wait(k)) ++k;
        if (k == waiting.size()) save(0, waiting[k = 0].variable);
        steps.push_back(waiting[k]);
        waiting.erase(waiting.begin() + static_cast<std::ptrdiff_t>(k));
    }
    return steps;
}

}  // namespace kinora::jit
