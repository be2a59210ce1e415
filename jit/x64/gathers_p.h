// jit/x64/gathers_p.h: reads by an index that differs between lanes.
#pragma once

#include "jit/x64/indices_p.h"
#include "jit/x64/rows_p.h"

namespace kinora::jit::x64 {

class Gathers {
  public:
    Gathers(x86::Assembler& a, const Isa& isa, Pool& pool, const CodeCursor& cursor,
            Operands& operands, Rows& rows, Indices& indices)
        : a_(a),
          isa_(isa),
          pool_(pool),
          cursor_(cursor),
          operands_(operands),
          rows_(rows),
          indices_(indices) {}

    void op_FrameGather();
    void op_InputGather();
    void op_Lookup();

    // The instruction's value, lane by lane: AVX2 has no scatter, and its gather is no faster.
    // Clamped indices go through memory. read_lane leaves a lane's word in ecx, given its index in
    // rax.
    template <class ReadLane>
    void by_lane(int32_t length, ReadLane&& read_lane) {
        begin_lanes(length);
        for (int lane = 0; lane < isa_.lanes; ++lane) {
            begin_lane(lane);
            read_lane(lane);
            end_lane(lane);
        }
        end_lanes();
    }
    // AVX-512: the instruction's value from word offsets in scratch 1. Changes k7.
    void words(const x86::Gp& base, int32_t offset);

  private:
    void begin_lanes(int32_t length);
    void begin_lane(int lane);
    void end_lane(int lane);
    void end_lanes();

    x86::Assembler& a_;
    const Isa& isa_;
    Pool& pool_;
    const CodeCursor& cursor_;
    Operands& operands_;
    Rows& rows_;
    Indices& indices_;
};

}  // namespace kinora::jit::x64
