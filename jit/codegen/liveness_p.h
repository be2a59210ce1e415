// jit/codegen/liveness_p.h: which instructions of a function are needed, by a walk from those that
// are.
#pragma once

#include <vector>

#include "jit/ir/ir.h"

namespace kinora::jit {

// Marks instructions from roots backwards. A value inside a region needs the region's first
// instruction; a loop needs its masks, but its variables only if they are used; an array's stores
// are needed once it is loaded. Values in `cuts` are marked, but what they need is not.
class Liveness {
  public:
    enum class Around { Regions, LoopsOnly };
    // `effects`: has_effects(module). With LoopsOnly a value does not need the Ifs around it (for a
    // copy that drops them).
    Liveness(const Module& module, const Function& function, const std::vector<bool>& effects,
             Around around = Around::Regions);

    void cut(Value v) { cuts_[v] = true; }
    void mark_effects();  // Return's arguments and everything that acts
    void mark(Value v);   // and all it needs
    bool is_live(Value v) const { return live_[v]; }
    const std::vector<Value>& match() const { return match_; }

  private:
    void push(Value v);
    void visit(Value v);
    void visit_control(Value v, const Inst& inst);
    bool acts(const Inst& inst) const;

    const Module& m_;
    const Function& f_;
    const std::vector<bool>& effects_;
    std::vector<Value> match_;
    std::vector<Value> parent_;               // first instruction of the region around, or kNone
    std::vector<std::vector<Value>> stores_;  // of each array
    std::vector<bool> live_, cuts_;
    std::vector<Value> work_;
};

// Copies what is live to a new stream, leaving dead loop variables out of their EndLoop.
void keep_live(Function& function, const Liveness& live);

}  // namespace kinora::jit
