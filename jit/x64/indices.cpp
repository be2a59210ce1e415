// jit/x64/indices.cpp: indices into arrays, inputs and records.
#include "jit/x64/indices_p.h"

#include "jit/ir/planted_fault.h"

namespace kinora::jit::x64 {

void Indices::lane_to(const x86::Gp& to, Value index) {
    index = cursor_.root(index);
    const FunctionCode& code = cursor_.code();
    Value loop = code.structure.loop_of[cursor_.at()];
    if (code.inst(index).op == Op::ConstI) {
        a_.mov(to, code.inst(index).imm);
    } else if (!code.plan.agree[index] && loop != kNone && cursor_.plan(loop).masked) {
        int32_t lanes = code.layout.lanes_a;
        a_.emit(Id::kIdVmovaps, operands_.row(lanes), operands_.reg(index, 0));
        masks_.lane_bits(to, loop);
        a_.tzcnt(to, to);
        a_.mov(to, x86::ptr(x86::r15, to.r64(), 2, lanes));
    } else if (const OpenLoop* counting = loops_.counted_by(index)) {
        loops_.counted_index(to, *counting, 0);
    } else if (cursor_.in_register(index)) {
        a_.vmovd(to, Operands::xmm(operands_.vec(code.interval(index).reg)));
    } else {
        x86::Mem word = operands_.memory(index);
        word.resetBroadcast();
        word.setSize(4);
        a_.mov(to, word);
    }
}

void Indices::clamped_lane_to(const x86::Gp& to, Value index, int32_t length) {
    lane_to(to, index);
    x86::Gp limit = x86::esi;
    a_.xor_(limit, limit);
    a_.test(to, to);
    a_.cmovs(to, limit);
    a_.mov(limit, length - 1);
    a_.cmp(to, limit);
    a_.cmovg(to, limit);
}

void Indices::clamp(const x86::Vec& to, Value index, int32_t length) {
    x86::Vec from = operands_.reg(index, 1);
    if (planted(PlantedFault::ClampOffByOne) && cursor_->op == Op::ArrayLoad) ++length;
    a_.emit(Id::kIdVpmaxsd, to, from, operands_.constant(0));
    a_.emit(Id::kIdVpminsd, to, to, operands_.constant(static_cast<uint32_t>(length - 1)));
}

}  // namespace kinora::jit::x64
