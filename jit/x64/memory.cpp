// jit/x64/memory.cpp: gathers, arrays of a function, and typed rows in memory.
#include <algorithm>

#include "jit/x64/emit_p.h"

namespace kinora::jit::x64 {

// The instruction's value from lanes in a vector register; a mask from its lanes' signs.
void Emit::finish_typed(const x86::Vec& lanes) {
    if (is_mask(at_)) {
        a_.vpmovd2m(mask_target(), lanes);
        return finish_mask(mask_target());
    }
    x86::Vec to = target();
    if (to.id() != lanes.id()) a_.emit(Id::kIdVmovaps, to, lanes);
    finish(to);
}

void Emit::load_result(const x86::Mem& from) {
    x86::Vec to = is_mask(at_) ? scratch(0) : target();
    a_.emit(Id::kIdVmovups, to, from);
    finish_typed(to);
}

void Emit::store_typed(const x86::Mem& to, Value v) {
    if (!is_mask(v)) {
        a_.emit(Id::kIdVmovaps, to, reg(v, 0));
        return;
    }
    a_.vpmovm2d(scratch(0), mask_reg(v, 7));
    a_.emit(Id::kIdVmovaps, to, scratch(0));
}

// An index that agrees in all lanes, clamped to 0..length-1.
void Emit::index_to(const x86::Gp& to, Value index, int32_t length) {
    lane_to(to, index);
    x86::Gp limit = x86::esi;
    a_.xor_(limit, limit);
    a_.test(to, to);
    a_.cmovs(to, limit);
    a_.mov(limit, length - 1);
    a_.cmp(to, limit);
    a_.cmovg(to, limit);
}

void Emit::clamp_lanes(const x86::Vec& to, Value index, int32_t length) {
    x86::Vec from = reg(index, 1);
    if (planted(PlantedFault::ClampOffByOne) && now().op == Op::ArrayLoad) ++length;
    a_.emit(Id::kIdVpmaxsd, to, from, constant(0));
    a_.emit(Id::kIdVpminsd, to, to, constant(static_cast<uint32_t>(length - 1)));
}

// Clamped indices of the lanes go through memory, one at a time: AVX2 has no scatter, and its
// gather is no faster. read_lane leaves a lane's word in ecx, given its index in rax.
template <class ReadLane>
void Emit::gather_by_lane(int32_t length, ReadLane&& read_lane) {
    clamp_lanes(scratch(0), now().a, length);
    a_.emit(Id::kIdVmovaps, row(layout_.lanes_a), scratch(0));
    for (int lane = 0; lane < isa_.lanes; ++lane) {
        a_.mov(x86::eax, row(layout_.lanes_a + 4 * lane));
        read_lane(lane);
        a_.mov(row(layout_.lanes_b + 4 * lane), x86::ecx);
    }
    load_result(row(layout_.lanes_b));
}

void Emit::op_FrameGather() {
    int32_t offset = 4 * now().imm;
    if (plan_.agree[now().a]) {
        index_to(x86::eax, now().a, now().imm2);
        x86::Vec to = is_mask(at_) ? scratch(0) : target();
        a_.emit(Id::kIdVbroadcastss, to, x86::ptr(x86::r14, x86::rax, 2, offset));
        finish_typed(to);
    } else if (isa_.wide) {
        gather_words(x86::r14, offset);
    } else {
        gather_by_lane(now().imm2,
                       [&](int) { a_.mov(x86::ecx, x86::ptr(x86::r14, x86::rax, 2, offset)); });
    }
}

// A permutation of constants that stand behind the code.
void Emit::op_Lookup() {
    auto words = std::span(module_.table)
                     .subspan(static_cast<size_t>(now().imm), static_cast<size_t>(now().imm2) + 1);
    x86::Mem first = state_.pool.row(words);
    x86::Vec index = reg(now().a, 1), to = target();
    if (isa_.wide || words.size() == 8) {
        a_.emit(Id::kIdVpermps, to, index, first);
        return finish(to);
    }
    // AVX2 sees 8 words at once: bit 3 of the index, as a sign, chooses between two such rows.
    x86::Vec lower = scratch(0), sign = scratch(1);
    a_.emit(Id::kIdVpermps, lower, index, first.cloneAdjusted(32));
    a_.emit(Id::kIdVmovaps, row(layout_.lanes_a), lower);
    a_.emit(Id::kIdVpermps, lower, index, first);
    a_.emit(Id::kIdVpslld, sign, index, asmjit::Imm(28));
    a_.emit(Id::kIdVblendvps, to, lower, row(layout_.lanes_a), sign);
    finish(to);
}

// AVX-512: clamped indices in scratch 1, the gather's own mask in k7.
void Emit::gather_words(const x86::Gp& base, int32_t offset) {
    if (now().op == Op::FrameGather) clamp_lanes(scratch(1), now().a, now().imm2);
    x86::Vec to = is_mask(at_) ? scratch(0) : target();
    a_.vxorps(xmm(to), xmm(to), xmm(to));
    a_.kxnorw(x86::k7, x86::k7, x86::k7);
    a_.k(x86::k7);
    a_.emit(Id::kIdVgatherdps, to, x86::ptr(base, scratch(1), 2, offset));
    finish_typed(to);
}

void Emit::op_InputGather() {
    int32_t offset = 8 * now().imm;
    if (plan_.agree[now().a]) {
        index_to(x86::eax, now().a, now().imm2);
        a_.mov(x86::rax, x86::ptr(x86::r12, x86::rax, 3, offset));
        return load_result(x86::ptr(x86::rax, x86::rbp));
    }
    gather_by_lane(now().imm2, [&](int lane) {
        a_.mov(x86::rax, x86::ptr(x86::r12, x86::rax, 3, offset));
        a_.mov(x86::ecx, x86::ptr(x86::rax, x86::rbp, 0, 4 * lane));
    });
}

// --- arrays: [element][lanes] in the function's frame ---

void Emit::zero_arrays() {
    if (f_.arrays.empty()) return;
    // They lie behind each other, so one fill does.
    int32_t bytes = layout_.bytes - layout_.arrays[0];
    x86::Vec zero = scratch(0);
    Label again = a_.newLabel();
    a_.vxorps(xmm(zero), xmm(zero), xmm(zero));
    a_.lea(x86::rax, row(layout_.arrays[0]));
    a_.mov(x86::ecx, bytes / kRow);
    a_.bind(again);
    a_.emit(Id::kIdVmovaps, x86::ptr(x86::rax), zero);
    if (!isa_.wide) a_.emit(Id::kIdVmovaps, x86::ptr(x86::rax, 32), zero);
    a_.add(x86::rax, kRow);
    a_.dec(x86::ecx);
    a_.jnz(again);
}

// The row of an element whose index agrees in all lanes.
x86::Mem Emit::array_element(Value index) {
    int32_t row_bytes = 4 * isa_.lanes;
    if (inst(index).op == Op::ConstI) {
        int32_t element = std::clamp(inst(index).imm, 0, array_length() - 1);
        return row(array_offset() + row_bytes * element);
    }
    index_to(x86::eax, index, array_length());
    a_.shl(x86::rax, isa_.wide ? 6 : 5);
    return x86::ptr(x86::r15, x86::rax, 0, array_offset());
}

// AVX-512: word offsets of the lanes' elements, in scratch 1.
void Emit::element_words(Value index) {
    clamp_lanes(scratch(1), index, array_length());
    a_.vpslld(scratch(1), scratch(1), 4);
    a_.vpaddd(scratch(1), scratch(1), state_.pool.iota());
}

void Emit::op_ArrayLoad() {
    if (plan_.agree[now().a]) return load_result(array_element(now().a));
    if (isa_.wide) {
        element_words(now().a);
        return gather_words(x86::r15, array_offset());
    }
    gather_by_lane(array_length(), [&](int lane) {
        a_.shl(x86::rax, 5);
        a_.mov(x86::ecx, x86::ptr(x86::r15, x86::rax, 0, array_offset() + 4 * lane));
    });
}

void Emit::op_ArrayStore() {
    Value value = now().b, mask = now().c;
    bool all = inst(mask).op == Op::ConstM && inst(mask).imm != 0;
    if (plan_.agree[now().a]) {
        x86::Mem to = array_element(now().a);
        gp_turn_ = 1;  // rax may be part of the address
        if (all) return store_typed(to, value);
        store_under(to, value, mask);
    } else if (isa_.wide) {
        element_words(now().a);
        x86::Vec from = scratch(0);
        if (is_mask(value))
            a_.vpmovm2d(from, mask_reg(value, 7));
        else
            from = reg(value, 0);
        load_mask(x86::k7, mask);  // the scatter clears it
        a_.k(x86::k7);
        a_.emit(Id::kIdVscatterdps, x86::ptr(x86::r15, scratch(1), 2, array_offset()), from);
    } else {
        scatter_by_lane(value, mask);
    }
}

void Emit::store_under(const x86::Mem& to, Value value, Value mask) {
    if (isa_.wide) {
        x86::Vec from = scratch(0);
        if (is_mask(value))
            a_.vpmovm2d(from, mask_reg(value, 7));
        else
            from = reg(value, 0);
        a_.k(mask_reg(mask, 7));
        a_.emit(Id::kIdVmovaps, to, from);
    } else {
        a_.vmovaps(scratch(0).as<x86::Ymm>(), to);
        blend(scratch(0), scratch(0), value, mask);
        a_.emit(Id::kIdVmovaps, to, scratch(0));
    }
}

void Emit::scatter_by_lane(Value value, Value mask) {
    clamp_lanes(scratch(0), now().a, array_length());
    a_.emit(Id::kIdVmovaps, row(layout_.lanes_a), scratch(0));
    a_.emit(Id::kIdVmovaps, row(layout_.lanes_b), reg(value, 0));
    mask_bits(x86::edx, mask);
    for (int lane = 0; lane < isa_.lanes; ++lane) {
        Label skip = a_.newLabel();
        a_.test(x86::edx, 1 << lane);
        a_.jz(skip);
        a_.mov(x86::eax, row(layout_.lanes_a + 4 * lane));
        a_.mov(x86::ecx, row(layout_.lanes_b + 4 * lane));
        a_.shl(x86::rax, 5);
        a_.mov(x86::ptr(x86::r15, x86::rax, 0, array_offset() + 4 * lane), x86::ecx);
        a_.bind(skip);
    }
}

}  // namespace kinora::jit::x64
