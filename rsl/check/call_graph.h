// rsl/check/call_graph.h: which functions call which, and who calls itself.
#pragma once

#include <vector>

#include "rsl/syntax/ast.h"

namespace kinora::rsl {

class CallGraph {
  public:
    // A call in a function (null: in a shader) of a function of the source.
    void add(const Function* caller, Function* callee) { calls_.push_back({caller, callee}); }
    // Sets Function::recursive. Functions have the ids 0 .. function_count-1.
    void mark_recursion(uint32_t function_count) const;

  private:
    struct Call {
        const Function* caller;
        Function* callee;
    };
    std::vector<Call> calls_;
};

}  // namespace kinora::rsl
