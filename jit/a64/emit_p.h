// jit/a64/emit_p.h: writes one function as machine code.
//
// Registers while code runs (AAPCS64):
//   x19 KernelArgs   x20 in[]   x21 frame block   x24 byte offset of the lane group in a column
//   x22 globals of the kernel in scratch   x23 this function's frame in scratch   x25 the pool
//   x15 the record read last   x14 "any lane" of the condition in work   w10..w13 loop counters (if
//   no calls)   x16 scratch   x17 scratch of addresses   x0..x3 scratch
//   v29..v31 scratch within one IR instruction; masks are lanes of all ones or zero
#pragma once

#include <string>
#include <vector>

#include "jit/a64/asmjit_p.h"
#include "jit/a64/pool_p.h"
#include "jit/codegen/function_code_p.h"
#include "jit/codegen/unwind.h"
#include "jit/ir/planted_fault.h"

namespace kinora::jit::a64 {

namespace arm = asmjit::a64;
using asmjit::Label;
using Gp = arm::Gp;
using Vec = arm::Vec;

inline constexpr int kLanes = 4;
inline constexpr int kVector = 4 * kLanes;      // bytes of the lanes of a group
inline constexpr int kVectorRegisters = 29;     // three more are scratch
inline constexpr int kFirstSavedRegister = 21;  // of those: v8..v15 are given out last

inline constexpr Gp kArgs = arm::x19, kIn = arm::x20, kFrameBlock = arm::x21, kGlobals = arm::x22,
                    kStack = arm::x23, kGroup = arm::x24, kPool = arm::x25, kRecord = arm::x15,
                    kAny = arm::x14;

// The kernel's globals, at the start of scratch.
inline constexpr int kValidBits = 0;     // uint32: lanes of this group that hold points
inline constexpr int kValidVector = 16;  // the same as a vector mask
inline constexpr int kServiceCall = 64;  // a ServiceCall
inline constexpr int kGlobalsBytes = 128;

// What the functions of a module share.
struct ModuleState {
    const Module& module;
    arm::Assembler& a;
    Pool pool;
    std::vector<Label> entries;    // of functions
    bool uses_valid = false;       // something asks which lanes hold points
    bool saves_registers = false;  // something uses v8..v15
    std::vector<CodePlace> places = {};
    UnwindWriter unwind{kUnwindA64};
};

class Emit : public FunctionCode {
  public:
    Emit(ModuleState& state, size_t function_index);

    void emit_function(bool listing);
    bool uses_saved_registers() const;

  private:
    struct OpenLoop {
        Value begin;
        Label header, exit;
        Gp counter;  // invalid: in memory
    };

    // One per row of ops.def: an op without a member does not compile.
#define OP(name, operands, result, flags, meaning) void op_##name();
#include "jit/ir/ops.def"
#undef OP
    using Member = void (Emit::*)();
    static const Member kMembers[static_cast<size_t>(Op::Count)];

    // emit.cpp
    void emit_kernel(bool listing);
    void emit_local(bool listing);
    void note_saved(int32_t bytes);
    void emit_body(bool listing);
    void find_valid_lanes();

    // operands.cpp: places of values
    bool lies_in(const Vec& r, Value v) const;
    Vec vec(int index) const;
    Vec scratch(int k) const {
        return arm::v(static_cast<uint32_t>(kVectorRegisters + k));
    }
    arm::Mem at(const Gp& base, int64_t offset, int bytes);  // may change x17
    void add_offset(const Gp& to, const Gp& base, int64_t offset);
    arm::Mem row(int32_t offset) {
        return at(kStack, offset, kVector);
    }
    int32_t slot(Value v) const;  // offset in the frame
    void zero(const Vec& to);
    void move(const Vec& to, const Vec& from);
    void constant(const Vec& to, uint32_t bits);
    void broadcast(const Vec& to, const arm::Mem& word);
    Vec reg(Value v, int scratch_index);  // register, loaded into that scratch if need be
    void load(const Vec& to, Value v);
    void load_home(const Vec& to, Value v);
    Vec target() const;  // where the instruction's value goes
    void finish(const Vec& value) {
        store_slot(at_, value);
    }
    void store_slot(Value v, const Vec& value);
    void copy(Value to, Value from);  // `to` is being defined

    // `write` emits the instruction, given the target's and the operands' registers.
    template <class Write>
    void unary(Write&& write) {
        Vec to = target();
        write(to, reg(now().a, 1));
        finish(to);
    }
    template <class Write>
    void binary(Write&& write) {
        Vec to = target();
        Vec left = reg(now().a, 1);
        write(to, left, reg(now().b, 2));
        finish(to);
    }

    // arith.cpp
    void min_max(bool max);

    // masks.cpp
    void blend(const Vec& to, const Vec& otherwise, Value then, Value mask);
    void merge_into(Value variable, Value then, Value mask);
    void find_any(const Vec& mask);  // kAny: not zero if any lane is set
    void mask_bits(const Gp& to, Value mask);

    // control.cpp
    void branch_if_zero(const Gp& condition, const Label& to);
    void branch_if_not_zero(const Gp& condition, const Label& to);
    void fill_slot(Value v);
    void begin_body(Value loop);
    void count_down(const OpenLoop& loop);
    void report_fault(int32_t site);
    int32_t counter() const;
    void update_variables(Value loop);
    void update_mask(Value loop, Value next_mask);
    void save(int k, Value variable);

    // memory.cpp
    void zero_arrays();
    void index_to(const Gp& to, Value index, int32_t length);
    void clamp_lanes(const Vec& to, Value index, int32_t length);
    template <class LaneAddress>
    void gather_by_lane(int32_t length, LaneAddress&& lane_address);
    void scatter_by_lane(Value value, Value mask);
    void find_element(Value index);

    // records.cpp
    void lane_to(const Gp& to, Value index);
    void find_set();
    void find_record();
    void read_record(bool uniform);

    // calls.cpp
    void pass_arguments(int32_t to);

    ModuleState& state_;
    arm::Assembler& a_;
    bool far_branches_ = false;  // a conditional branch reaches 1 MiB only
    std::vector<OpenLoop> loops_;
    struct OpenIf {
        Label end;
        Value record_set, record;  // what kRecord pointed at when it was entered
    };
    std::vector<OpenIf> ifs_;
    Value record_set_ = kNone, record_ = kNone;  // kRecord points at this record
};

}  // namespace kinora::jit::a64
