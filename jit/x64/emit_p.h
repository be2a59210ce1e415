// jit/x64/emit_p.h: writes one function as machine code.
//
// Registers while code runs:
//   rbx KernelArgs   r12 in[]   r14 frame block   rbp byte offset of the lane group in a column
//   r13 globals of the kernel in scratch   r15 this function's frame in scratch
//   rax rcx rdx rsi rdi scratch   r8 r9 loop counters (if no calls)
//   r10 r11 columns and uniforms of the record read last
//   the last two vector registers, k0 and k7: scratch within one IR instruction
#pragma once

#include <asmjit/x86.h>

#include <string>
#include <vector>

#include "jit/codegen/unwind.h"
#include "jit/ir/planted_fault.h"
#include "jit/x64/isa_p.h"
#include "jit/x64/pool_p.h"

namespace kinora::jit::x64 {

namespace x86 = asmjit::x86;
using Id = x86::Inst::Id;
using asmjit::InstId;
using asmjit::Label;
using asmjit::Operand;

// The kernel's globals, at the start of scratch (r13).
inline constexpr int kValidBits = 0;     // uint32: lanes of this group that hold points
inline constexpr int kValidVector = 32;  // AVX2: the same as a vector mask
inline constexpr int kServiceCall = 64;  // a ServiceCall
inline constexpr int kFrameRows = 128;   // AVX2: frame slots in use, broadcast

// What the functions of a module share.
struct ModuleState {
    const Module& module;
    const Isa& isa;
    x86::Assembler& a;
    Pool& pool;
    std::vector<Label> entries;      // of functions
    std::vector<int32_t> frame_row;  // AVX2: frame slot -> row at kFrameRows, -1 if unused
    int32_t globals_bytes = kFrameRows;
    bool uses_valid = false;  // something asks which lanes hold points
    std::vector<CodePlace> places = {};
    UnwindWriter unwind{kUnwindX64};
};

class Emit : public FunctionCode {
  public:
    Emit(ModuleState& state, size_t function_index);

    void emit_function(bool listing);

  private:
    struct OpenLoop {
        Value begin;
        Label header, exit;
        x86::Gp counter;  // invalid: in memory
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
    void move_stack(int bytes);
    void emit_body(bool listing);
    void find_valid_lanes();
    void broadcast_frame();

    // operands.cpp: places of values
    bool is_mask(Value v) const {
        return isa_.wide && inst(v).type == Type::M;
    }
    x86::Vec vec(int index) const;
    x86::Xmm xmm(const x86::Vec& v) const {
        return x86::xmm(v.id());
    }
    x86::Vec scratch(int k) const {
        return vec(isa_.vector_registers + k);
    }
    x86::Gp next_gp();
    x86::Mem home(Value v);  // memory, with its broadcast where it has one
    x86::Mem slot(Value v) const;
    x86::Mem row(int32_t offset) const {
        return x86::ptr(x86::r15, offset);
    }
    x86::Mem constant(uint32_t bits) const;
    Operand operand(Value v);                  // register or memory
    x86::Vec reg(Value v, int scratch_index);  // register, loaded into that scratch if need be
    void load(const x86::Vec& to, Value v);
    void load_constant(Value v);  // into the register it was given
    void load_memory(const x86::Vec& to, const x86::Mem& from);
    x86::Vec target() {
        return target_of(at_);
    }  // where the instruction's value goes
    x86::Vec target_of(Value v) const;
    void finish(const x86::Vec& value) {
        store_slot(at_, value);
    }
    void store_slot(Value v, const x86::Vec& value);
    x86::KReg mask_reg(Value v, int scratch_index);
    x86::KReg mask_target() const;
    void finish_mask(const x86::KReg& value) {
        store_mask_slot(at_, value);
    }
    void store_mask_slot(Value v, const x86::KReg& value);
    void load_mask(const x86::KReg& to, Value v);
    void copy(Value to, Value from);  // any class; `to` is being defined

    // arith.cpp
    void binary(InstId id, bool commutative);
    void binary_into(const x86::Vec& to, InstId id, const Inst& op, bool commutative,
                     const x86::KReg* under);
    bool lies_in(const x86::Vec& r, Value v) const;
    void fma_into(const x86::Vec& to, const Inst& fma, const x86::KReg* under);
    void unary(InstId id);
    void unary_imm(InstId id, int imm);
    void with_constant(InstId id, uint32_t bits);
    void shift(InstId id);

    // masks.cpp
    struct Compare {
        InstId id;
        int imm;
    };
    Compare predicate(Op op, bool negate, bool swapped) const;
    void compare();
    void compare_into(const Operand& to, const Inst& compare, bool negate, const x86::KReg* under);
    void mask_binary(InstId wide_id, InstId id);
    void blend(const x86::Vec& to, const x86::Vec& otherwise, Value then, Value mask);
    void select_computed();
    void negate_into(const x86::Vec& to, Value v, const x86::KReg* under);
    void arm_into(const x86::Vec& to, const Inst& arm, const x86::KReg* under);
    void blend_mask(const x86::KReg& to, Value otherwise, Value then, Value mask);
    void merge_into(Value variable, Value then, Value mask);
    void set_if_any(Value mask);  // flags: not zero if any lane is set
    void mask_bits(const x86::Gp& to, Value mask);

    // control.cpp
    void fill_slot(Value v);
    void begin_body(Value loop);
    void test_kind(Value condition);
    void leave(const OpenLoop& loop);
    void index_in(const x86::Gp& to, const OpenLoop& loop, int32_t ahead);
    x86::Mem counter() const;
    void update_variables(Value loop);
    void update_mask(Value loop, Value next_mask);
    void save(int k, Value variable);

    // memory.cpp: in memory shared with C++ a mask lane is all ones or zero
    void zero_arrays();
    void finish_typed(const x86::Vec& lanes);
    void load_result(const x86::Mem& from);
    void store_typed(const x86::Mem& to, Value v);
    void index_to(const x86::Gp& to, Value index, int32_t length);
    void clamp_lanes(const x86::Vec& to, Value index, int32_t length);
    template <class ReadLane>
    void gather_by_lane(int32_t length, ReadLane&& read_lane);
    void gather_words(const x86::Gp& base, int32_t offset);
    x86::Mem array_element(Value index);
    void element_words(Value index);
    void store_under(const x86::Mem& to, Value value, Value mask);
    void scatter_by_lane(Value value, Value mask);

    // records.cpp
    void lane_to(const x86::Gp& to, Value index);
    const OpenLoop* counted_by(Value index) const;
    x86::Mem find_set(Value set);
    void find_record(Value set, Value index, bool in_range);
    void read_record(bool uniform);

    // calls.cpp
    void pass_arguments(int32_t to, bool to_service);

    ModuleState& state_;
    const Isa& isa_;
    x86::Assembler& a_;
    std::vector<OpenLoop> loops_;
    struct OpenIf {
        Label end;
        Value record_set, record;  // what r10 and r11 belonged to when it was entered
    };
    std::vector<OpenIf> ifs_;
    unsigned gp_turn_ = 0;
    Value record_set_ = kNone, record_ = kNone;  // r10, r11 belong to this record
};

}  // namespace kinora::jit::x64
