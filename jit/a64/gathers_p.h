// jit/a64/gathers_p.h: reads by an index that differs between lanes, lane by lane.
#pragma once

#include "jit/a64/indices_p.h"

namespace kinora::jit::a64 {

class Gathers {
  public:
    Gathers(arm::Assembler& a, Pool& pool, const CodeCursor& cursor, Operands& operands,
            Indices& indices)
        : a_(a), pool_(pool), cursor_(cursor), operands_(operands), indices_(indices) {}

    void op_FrameGather();
    void op_InputGather();
    void op_Lookup();

    // The instruction's value from one word a lane; lane_address leaves the word's address in x0,
    // given the lane's clamped index in x0.
    template <class LaneAddress>
    void by_lane(int32_t length, LaneAddress&& lane_address) {
        Vec indices = Operands::scratch(0), words = Operands::scratch(1);
        indices_.clamp(indices, cursor_->a, length);
        for (uint32_t lane = 0; lane < kLanes; ++lane) {
            a_.umov(arm::w0, indices.s(lane));
            lane_address(lane);
            a_.ld1(words.s(lane), arm::ptr(arm::x0));
        }
        finish(words);
    }

  private:
    void finish(const Vec& words);

    arm::Assembler& a_;
    Pool& pool_;
    const CodeCursor& cursor_;
    Operands& operands_;
    Indices& indices_;
};

}  // namespace kinora::jit::a64
