// jit/x64/indices_p.h: indices into arrays, inputs and records.
#pragma once

#include "jit/x64/masks_p.h"
#include "jit/x64/open_loops_p.h"

namespace kinora::jit::x64 {

class Indices {
  public:
    Indices(x86::Assembler& a, const CodeCursor& cursor, Operands& operands, Masks& masks,
            OpenLoops& loops)
        : a_(a), cursor_(cursor), operands_(operands), masks_(masks), loops_(loops) {}

    // One lane's int. If lanes need not agree the value is that of a lane that runs the loop we are
    // in: those that have left it keep older indices.
    void lane_to(const x86::Gp& to, Value index);
    // An index that agrees in all lanes, clamped to 0..length-1. Changes esi.
    void clamped_lane_to(const x86::Gp& to, Value index, int32_t length);
    void clamp(const x86::Vec& to, Value index, int32_t length);

  private:
    x86::Assembler& a_;
    const CodeCursor& cursor_;
    Operands& operands_;
    Masks& masks_;
    OpenLoops& loops_;
};

}  // namespace kinora::jit::x64
