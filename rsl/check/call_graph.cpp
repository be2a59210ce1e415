// rsl/check/call_graph.cpp: recursion.
#include "rsl/check/call_graph.h"

#include <utility>

namespace kinora::rsl {

// Depth-first along the calls; an edge back to a function on the path closes a circle. Each circle
// has such an edge, so each has a marked function.
void CallGraph::mark_recursion(uint32_t function_count) const {
    std::vector<std::vector<Function*>> callees(function_count);
    for (const Call& call : calls_)
        if (call.caller) callees[call.caller->id].push_back(call.callee);
    enum State : uint8_t { kNew, kOpen, kDone };
    std::vector<State> state(function_count, kNew);
    std::vector<std::pair<Function*, size_t>> path;  // function, next call to look at
    for (const Call& start : calls_) {
        if (state[start.callee->id] != kNew) continue;
        path.push_back({start.callee, 0});
        state[start.callee->id] = kOpen;
        while (!path.empty()) {
            auto& [function, next] = path.back();
            if (next == callees[function->id].size()) {
                state[function->id] = kDone;
                path.pop_back();
                continue;
            }
            Function* callee = callees[function->id][next++];
            if (state[callee->id] == kOpen)
                for (size_t k = path.size(); k-- > 0;) {
                    path[k].first->recursive = true;
                    if (path[k].first == callee) break;
                }
            if (state[callee->id] != kNew) continue;
            state[callee->id] = kOpen;
            path.push_back({callee, 0});
        }
    }
}

}  // namespace kinora::rsl
