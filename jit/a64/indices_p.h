// jit/a64/indices_p.h: indices into arrays, inputs and records.
#pragma once

#include "jit/a64/masks_p.h"

namespace kinora::jit::a64 {

class Indices {
  public:
    Indices(arm::Assembler& a, const CodeCursor& cursor, Operands& operands, Masks& masks)
        : a_(a), cursor_(cursor), operands_(operands), masks_(masks) {}

    // One lane's int. If lanes need not agree the value is that of a lane that runs the loop we are
    // in: those that have left it keep older indices.
    void lane_to(const Gp& to, Value index);
    // An index that agrees in all lanes, clamped to 0..length-1. Changes w1.
    void clamped_lane_to(const Gp& to, Value index, int32_t length);
    void clamp(const Vec& to, Value index, int32_t length);

  private:
    arm::Assembler& a_;
    const CodeCursor& cursor_;
    Operands& operands_;
    Masks& masks_;
};

}  // namespace kinora::jit::a64
