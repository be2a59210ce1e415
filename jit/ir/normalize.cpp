// jit/ir/normalize.cpp: Params, constants and inputs first; Merges and loop values where they
// belong.
#include "jit/ir/normalize.h"

#include <algorithm>
#include <unordered_map>

#include "runtime/base/check.h"

namespace kinora::jit {

namespace {

bool is_leaf(Op op) {
    return op == Op::ConstF || op == Op::ConstI || op == Op::ConstM || op == Op::Input ||
           op == Op::FrameLoad;
}

class Normalizer {
  public:
    explicit Normalizer(Function& function)
        : function_(function),
          old_(std::move(function.insts)),
          renamed_(old_.size(), kNone),
          first_(old_.size(), kNone),
          last_(old_.size(), kNone),
          next_(old_.size(), kNone) {
        function_.insts.clear();
        function_.insts.reserve(old_.size());
    }

    void run() {
        for (Value v = 0; v < old_.size(); ++v)
            if (old_[v].op == Op::Param) emit(v);
        for (Value v = 0; v < old_.size(); ++v)
            if (is_leaf(old_[v].op)) emit_leaf(v);
        anchor_all();
        for (Value v = 0; v < old_.size(); ++v) {
            const Inst& inst = old_[v];
            if (inst.op == Op::Param || is_leaf(inst.op) || is_anchored(inst.op)) continue;
            emit(v);
            for (Value k = first_[v]; k != kNone; k = next_[k]) emit(k);
        }
        // EndLoop's operands are known now, and with them all arguments.
        for (Value& arg : function_.args) arg = renamed(arg);
    }

  private:
    static bool is_anchored(Op op) {
        return op == Op::Merge || op == Op::LoopVar || op == Op::LoopOut;
    }

    // Each anchored instruction joins the list of the one it must follow.
    void anchor_all() {
        std::vector<Value> end_of(old_.size(), kNone);
        for (Value v = 0; v < old_.size(); ++v)
            if (old_[v].op == Op::EndIf || old_[v].op == Op::EndLoop)
                end_of[static_cast<Value>(old_[v].imm)] = v;
        for (Value v = 0; v < old_.size(); ++v) {
            const Inst& inst = old_[v];
            auto block = static_cast<Value>(inst.imm);
            if (inst.op == Op::Merge) anchor(end_of[block], v);
            if (inst.op == Op::LoopVar) anchor(block, v);
            if (inst.op == Op::LoopOut) anchor(end_of[static_cast<Value>(old_[inst.a].imm)], v);
        }
    }

    void anchor(Value at, Value v) {
        CHECK_NE(at, kNone);
        (first_[at] == kNone ? first_[at] : next_[last_[at]]) = v;
        last_[at] = v;
    }

    Value renamed(Value v) const {
        // A Merge or LoopVar whose outer operand is defined behind it ends here.
        CHECK_LT(v, renamed_.size());
        CHECK_NE(renamed_[v], kNone);
        return renamed_[v];
    }

    void emit(Value v) {
        Inst inst = old_[v];
        if (inst.a != kNone) inst.a = renamed(inst.a);
        if (inst.b != kNone) inst.b = renamed(inst.b);
        if (inst.c != kNone) inst.c = renamed(inst.c);
        bool names_block = inst.op == Op::EndIf || inst.op == Op::EndLoop || inst.op == Op::Merge ||
                           inst.op == Op::LoopVar;
        if (names_block) inst.imm = static_cast<int32_t>(renamed(static_cast<Value>(inst.imm)));
        renamed_[v] = static_cast<Value>(function_.insts.size());
        function_.insts.push_back(inst);
    }

    void emit_leaf(Value v) {
        const Inst& inst = old_[v];
        uint64_t key = static_cast<uint64_t>(inst.op) << 40 |
                       static_cast<uint64_t>(inst.type) << 32 | static_cast<uint32_t>(inst.imm);
        auto [at, is_new] = leaves_.try_emplace(key, kNone);
        if (is_new) {
            emit(v);
            at->second = renamed_[v];
        }
        renamed_[v] = at->second;
    }

    Function& function_;
    std::vector<Inst> old_;
    std::vector<Value> renamed_;
    std::vector<Value> first_, last_, next_;  // lists of anchored instructions
    std::unordered_map<uint64_t, Value> leaves_;
};

}  // namespace

void normalize(Function& function) {
    Normalizer(function).run();
}

}  // namespace kinora::jit
