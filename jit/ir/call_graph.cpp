// jit/ir/call_graph.cpp: circles of calls and the depth of the stack they need.
#include <algorithm>

#include "jit/ir/analysis.h"

namespace kinora::jit {

namespace {

// Tarjan's strongly connected components over calls: a circle of functions is one component, and
// components are closed after those they call.
class Components {
  public:
    explicit Components(const Module& module)
        : of(module.functions.size(), -1),
          cyclic(module.functions.size(), false),
          callees_(module.functions.size()),
          order_(module.functions.size(), 0),
          low_(module.functions.size(), 0) {
        for (size_t k = 0; k < callees_.size(); ++k)
            for (const Inst& inst : module.functions[k].insts)
                if (inst.op == Op::Call) callees_[k].push_back(static_cast<size_t>(inst.imm));
        for (size_t k = 0; k < callees_.size(); ++k)
            if (order_[k] == 0) visit(k);
    }

    std::vector<int> of;       // component by function
    std::vector<bool> cyclic;  // by function
    std::vector<std::vector<size_t>> members;
    const std::vector<size_t>& callees(size_t k) const { return callees_[k]; }

  private:
    // Call graphs of shaders are shallow: what can nest is bounded by the parser.
    void visit(size_t k) {
        order_[k] = low_[k] = ++count_;
        open_.push_back(k);
        for (size_t callee : callees_[k]) {
            if (callee == k) cyclic[k] = true;
            if (order_[callee] == 0) {
                visit(callee);
                low_[k] = std::min(low_[k], low_[callee]);
            } else if (of[callee] < 0) {
                low_[k] = std::min(low_[k], order_[callee]);
            }
        }
        if (low_[k] == order_[k]) close(k);
    }

    void close(size_t first) {
        members.emplace_back();
        for (size_t k = first + 1; k != first;) {
            k = open_.back();
            open_.pop_back();
            of[k] = static_cast<int>(members.size()) - 1;
            members.back().push_back(k);
        }
        if (members.back().size() == 1) return;
        for (size_t k : members.back()) cyclic[k] = true;
    }

    std::vector<std::vector<size_t>> callees_;
    std::vector<int> order_, low_;
    std::vector<size_t> open_;
    int count_ = 0;
};

}  // namespace

std::vector<bool> cyclic_functions(const Module& module) {
    return std::move(Components(module).cyclic);
}

size_t deepest_stack(const Module& module, std::span<const size_t> frames) {
    Components components(module);
    std::vector<size_t> need;
    for (const std::vector<size_t>& members : components.members) {
        size_t widest = 0, below = 0;
        for (size_t k : members) {
            widest = std::max(widest, frames[k]);
            for (size_t callee : components.callees(k)) {
                auto other = static_cast<size_t>(components.of[callee]);
                if (other < need.size()) below = std::max(below, need[other]);
            }
        }
        bool circle = components.cyclic[members[0]];
        size_t activations = circle ? static_cast<size_t>(module.call_depth) : 1;
        need.push_back(widest * activations + below);
    }
    return need[static_cast<size_t>(components.of[0])];
}

}  // namespace kinora::jit
