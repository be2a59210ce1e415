// jit/a64/control_flow.cpp: If and Loop.
#include "jit/a64/control_flow_p.h"

namespace kinora::jit::a64 {

void ControlFlow::op_If() {
    joins_.begin_merges();
    ifs_.push_back({a_.newLabel(), held_.key()});
    if (!cursor_.code().plan.branch[cursor_.at()]) return;
    masks_.find_any(operands_.reg(cursor_->a, 1));
    branches_.if_zero(kAny, ifs_.back().end);
}

void ControlFlow::op_EndIf() {
    joins_.end_merges();
    const OpenIf& open = ifs_.back();
    a_.bind(open.end);
    if (!held_.is(open.record) && !planted(PlantedFault::RecordKeptAtJoin)) held_.drop();
    ifs_.pop_back();
    joins_.fill_merges();
}

// Leaves kAny for begin_body; copying the first values of variables in between keeps it.
void ControlFlow::op_Loop() {
    Value loop = cursor_.at();
    loops_.open(loop);
    assignments_.enter_loop(loop);
    if (cursor_.code().structure.header_of[loop] == loop) begin_body(loop);
}

void ControlFlow::op_LoopVar() {
    Value variable = cursor_.at();
    auto loop = static_cast<Value>(cursor_->imm);
    assignments_.copy(variable, cursor_->a);
    if (cursor_.code().structure.header_of[loop] == variable) begin_body(loop);
}

void ControlFlow::begin_body(Value loop) {
    held_.drop();
    branches_.if_zero(kAny, loops_.innermost().exit);
    for (auto [owner, constant] : cursor_.code().allocation.loop_hoists)
        if (owner == loop) operands_.load_register(constant);
    loops_.set_counter();
    a_.bind(loops_.innermost().header);
}

void ControlFlow::op_EndLoop() {
    auto begin = static_cast<Value>(cursor_->imm);
    Label exit = loops_.innermost().exit;
    joins_.update_variables(
        begin, [&] { assignments_.update_loop_mask(begin, cursor_.root(cursor_->a)); });
    branches_.if_zero(kAny, exit);
    loops_.count_down();
    loops_.begin_next_slice();
    faults_.report(cursor_.inst(begin).imm);
    a_.bind(exit);
    held_.drop();
    joins_.fill_variables(begin);
    loops_.close();
}

}  // namespace kinora::jit::a64
