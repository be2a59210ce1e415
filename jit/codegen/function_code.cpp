// jit/codegen/function_code.cpp: a function's plan, registers and frame.
#include "jit/codegen/function_code_p.h"

#include <algorithm>

namespace kinora::jit {

namespace {

Allocation allocate(const Function& f, const Structure& structure, const FunctionPlan& plan,
                    AllocationLimits limits, bool is_kernel) {
    limits.hoist_function = is_kernel && !plan.calls;
    return allocate_registers(f, structure, plan.values, limits);
}

// The rows of arguments and results, and the counters, of the call or loop that needs most.
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

}  // namespace

FunctionCode::FunctionCode(const Module& module_in, size_t function_index, const CodeRules& rules)
    : module(module_in),
      function(module.functions[function_index]),
      index(function_index),
      is_kernel(function_index == 0),
      structure(function),
      plan(plan_function(module, function, structure, rules.plan)),
      allocation(allocate(function, structure, plan, rules.limits, is_kernel)) {
    lay_out(rules.lanes);
}

bool FunctionCode::uses_valid_lanes() const {
    for (Value v = 0; v < function.insts.size(); ++v) {
        Op op = inst(v).op;
        if (op == Op::Service || op == Op::Fault) return true;
        if (op == Op::Loop && plan.values[v].masked) return true;
    }
    return false;
}

bool FunctionCode::is_zero(Value v) const {
    Op op = inst(v).op;
    return (op == Op::ConstF || op == Op::ConstI || op == Op::ConstM) && inst(v).imm == 0;
}

// What else lies in the first and last row may be cleared, too. A frame beyond reach is never run.
void FrameLayout::clear(int32_t at, size_t size) {
    if (size == 0) return;
    const size_t rows = (static_cast<size_t>(at) + size + kRow - 1) / kRow;
    const int32_t begin = at / kRow * kRow;
    const auto end = static_cast<int32_t>(std::min<size_t>(rows * kRow, kMostFrameBytes));
    if (!cleared.empty() && begin <= cleared.back().end)
        cleared.back().end = std::max(cleared.back().end, end);
    else
        cleared.push_back({begin, end});
}

void FunctionCode::lay_out(int lanes) {
    auto round_up = [](size_t bytes) { return (bytes + kRow - 1) / kRow * kRow; };
    auto offset = [&] { return static_cast<int32_t>(std::min(frame_bytes, kMostFrameBytes)); };
    auto take = [&](size_t bytes) {
        int32_t at = offset();
        frame_bytes += round_up(bytes);
        return at;
    };
    auto lane_bytes = static_cast<size_t>(4 * lanes);
    // The caller fills in parameters at the frame's start and finds the results behind them.
    layout.params = take(is_kernel ? 0 : function.params.size() * kRow);
    layout.results = take(is_kernel ? 0 : function.results.size() * kRow);
    layout.vectors = take(static_cast<size_t>(allocation.slots[0]) * lane_bytes);
    layout.masks = take(static_cast<size_t>(allocation.slots[1]) * 8);
    layout.swap = take(2 * kRow);
    layout.lanes_a = take(kRow);
    layout.lanes_b = take(kRow);
    Most most = most_of(module, function);
    bool sliced =
        std::any_of(plan.slices.begin(), plan.slices.end(), [](int32_t s) { return s > 0; });
    layout.counters = take((sliced ? 8 : 4) * most.loops);
    layout.slices_left = layout.counters + static_cast<int32_t>(4 * most.loops);
    layout.service_args = take(most.args * kRow);
    layout.service_results = take(most.results * kRow);
    for (const ArrayInfo& array : function.arrays) {
        layout.arrays.push_back(offset());
        layout.clear(offset(), static_cast<size_t>(array.cleared) * lane_bytes);
        frame_bytes += static_cast<size_t>(array.length) * lane_bytes;
    }
    frame_bytes = round_up(frame_bytes);
    layout.bytes = offset();
}

}  // namespace kinora::jit
