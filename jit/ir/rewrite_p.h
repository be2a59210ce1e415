// jit/ir/rewrite_p.h: the frame of every pass: a function is read in order and written anew.
#pragma once

#include <utility>
#include <vector>

#include "jit/ir/ir.h"
#include "runtime/base/check.h"

namespace kinora::jit {

// Does the immediate of the op name a region's first instruction?
inline bool names_region(Op op) {
    return op == Op::EndIf || op == Op::EndLoop || op == Op::Merge || op == Op::LoopVar;
}

// All references in a function point backwards, so one forward walk renames everything. A pass
// moves over `old` and, for each instruction, copies it, appends others, or maps it to an earlier
// value by setting renamed[v].
class Rewrite {
  public:
    explicit Rewrite(Function& f) : function(f), old(std::move(f.insts)), old_args(f.args) {
        f.args.clear();
        f.insts.clear();
        f.insts.reserve(old.size() + old.size() / 4);
        renamed.assign(old.size(), kNone);
    }

    Function& function;
    std::vector<Inst> old;
    std::vector<Value> old_args;
    std::vector<Value> renamed;

    std::span<const Value> old_args_of(const Inst& inst) const {
        return {old_args.data() + inst.args, inst.arg_count};
    }

    // The old instruction with its operands renamed; arguments are not copied yet.
    Inst translate(Value v) const {
        Inst inst = old[v];
        if (inst.a != kNone) inst.a = renamed[inst.a];
        if (inst.b != kNone) inst.b = renamed[inst.b];
        if (inst.c != kNone) inst.c = renamed[inst.c];
        if (names_region(inst.op))
            inst.imm = static_cast<int32_t>(renamed[static_cast<Value>(inst.imm)]);
        return inst;
    }

    Value append(const Inst& inst) {
        function.insts.push_back(inst);
        return static_cast<Value>(function.insts.size() - 1);
    }

    // Copies the instruction, arguments and all. One without any points at the list's begin: where
    // it pointed before, the list may end earlier now.
    Value copy(Value v) {
        Inst inst = translate(v);
        inst.args = 0;
        if (inst.arg_count > 0) set_renamed_args(inst, old_args_of(old[v]));
        return renamed[v] = append(inst);
    }

    // Gives `inst` the renamed arguments.
    void set_renamed_args(Inst& inst, std::span<const Value> args) {
        inst.args = static_cast<uint32_t>(function.args.size());
        inst.arg_count = static_cast<uint16_t>(args.size());
        for (Value arg : args) function.args.push_back(renamed[arg]);
    }
};

}  // namespace kinora::jit
