// jit/codegen/regalloc.h: linear-scan register allocation over the structured IR, for any target.
//
// One backward pass finds how long each value lives (a value live into a loop lives to its end),
// one forward scan assigns registers. When none is free the value whose life ends last goes to
// memory: it is stored once, at its definition, and read from memory from then on. There is no
// other splitting, so where a value lies depends on the position only: its register up to reg_last,
// its home in memory after that.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "jit/ir/ir.h"

namespace kinora::jit {

enum class RegClass : uint8_t { None, Vector, Mask };
inline constexpr int kRegClasses = 2;  // Vector, Mask

// What a target says about each instruction's value before allocation.
struct ValuePlan {
    RegClass cls = RegClass::None;  // None: needs no register
    Value alias = kNone;            // lies where this LoopVar lies: it is the next value of it
    bool fused = false;             // computed inside its only user, which then uses its operands
    bool gone = false;     // fused, and its user does not ask for it: a loop's known condition
    bool home = false;     // lies in memory anyway (an input): needs no store, may be loaded late
    bool hoist = false;    // a constant operand in memory: a register if one is free over a region
    bool masked = false;   // of If and Loop: values are blended under the mask at the end
    bool clobber = false;  // of Call and Service: no register survives
};

// Where instructions stand: filled once per function.
struct Structure {
    explicit Structure(const Function& function);

    std::vector<Value> end_of;     // If, Loop -> its EndIf, EndLoop
    std::vector<Value> header_of;  // Loop -> its last LoopVar (or itself); the body comes after
    std::vector<Value> top;        // the outermost If or Loop around an instruction, else itself
    std::vector<uint8_t> depth;    // of loops, capped
    std::vector<Value> loop_of;    // innermost Loop whose body holds the instruction, or kNone
    bool in_loop(Value loop, Value at) const { return at > header_of[loop] && at <= end_of[loop]; }
};

// Where a value is live and what it was given: a register at positions in (reg_after, reg_last],
// else memory.
struct LiveInterval {
    int8_t reg = -1;
    int32_t slot = -1;       // spill slot of its class, -1 if it needs none
    uint32_t begin = 0;      // position of the definition (an If for its Merges)
    uint32_t end = 0;        // last position that reads it
    int64_t reg_after = -1;  // hoisted constants only: the region starts here
    uint32_t reg_last = 0;
    bool in_reg(uint32_t at) const { return reg >= 0 && at > reg_after && at <= reg_last; }
};

struct Allocation {
    std::vector<LiveInterval> intervals;  // by value
    std::vector<Value> load_at;           // first value to load before instruction i, ...
    std::vector<Value> load_next;         // ... and the next one: inputs loaded late
    std::vector<Value> function_hoists;   // constants to load before the lane loop
    std::vector<std::pair<Value, Value>> loop_hoists;  // (Loop, constant), sorted by Loop
    int slots[kRegClasses] = {};                       // spill slots used, by class
};

struct AllocationLimits {
    int registers[kRegClasses] = {};  // registers 0..n-1 of each class may be given out
    int first[kRegClasses] = {};      // ... starting at this one (x86's k0 is no predicate)
    bool hoist_function = false;      // constants may be loaded once before the function
};

// `function` is verified, `plan` has one entry per instruction.
Allocation allocate_registers(const Function& function, const Structure& structure,
                              std::span<const ValuePlan> plan, const AllocationLimits& limits);

// Proves that each use reads the register or slot that its value was last written to, along every
// edge of Ifs and Loops. Returns the first fault as text, "" if there is none.
std::string check_allocation(const Function& function, const Structure& structure,
                             std::span<const ValuePlan> plan, const Allocation& allocation);

// Calls use(v) for every value that instruction `at` reads, LoopOuts resolved to their LoopVars and
// fused operands to theirs. Merges read at their If (b) and EndIf (a).
template <class Use>
void for_each_use(const Function& f, const Structure& s, std::span<const ValuePlan> plan, Value at,
                  Use&& use) {
    auto operand = [&](auto&& self, Value v) -> void {
        if (f.insts[v].op == Op::LoopOut) v = f.insts[v].a;
        if (!plan[v].fused) return use(v);
        if (plan[v].gone) return;
        const Inst& inst = f.insts[v];
        const Value operands[] = {inst.a, inst.b, inst.c};
        for (int k = 0; k < op_info(inst.op).operand_count; ++k) self(self, operands[k]);
    };
    const Inst& inst = f.insts[at];
    if (plan[at].fused) return;
    switch (inst.op) {
        case Op::Merge:
        case Op::LoopOut:
        case Op::Result:
            return;
        case Op::If:
            operand(operand, inst.a);
            for (Value m = s.end_of[at] + 1; f.insts[m].op == Op::Merge; ++m)
                operand(operand, f.insts[m].b);
            return;
        case Op::EndIf: {
            auto begin = static_cast<Value>(inst.imm);
            bool merges = f.insts[at + 1].op == Op::Merge;
            if (merges && plan[begin].masked) operand(operand, f.insts[begin].a);
            for (Value m = at + 1; f.insts[m].op == Op::Merge; ++m) operand(operand, f.insts[m].a);
            return;
        }
        case Op::EndLoop: {
            auto begin = static_cast<Value>(inst.imm);
            operand(operand, inst.a);
            if (plan[begin].masked) use(begin);
            for (Value v : f.args_of(inst)) operand(operand, v);
            for (uint32_t k = 0; k < inst.arg_count; ++k) use(begin + 1 + k);
            return;
        }
        default:
            break;
    }
    const Value operands[] = {inst.a, inst.b, inst.c};
    for (int k = 0; k < op_info(inst.op).operand_count; ++k) operand(operand, operands[k]);
    for (Value v : f.args_of(inst)) operand(operand, v);
}

}  // namespace kinora::jit
