// jit/a64/records_p.h: records of a grid (light answers): sets[a].records[b].
#pragma once

#include "jit/a64/indices_p.h"
#include "jit/codegen/held_record_p.h"

namespace kinora::jit::a64 {

class Records {
  public:
    // `held` is the record that kRecord points at.
    Records(arm::Assembler& a, const CodeCursor& cursor, Operands& operands, Indices& indices,
            HeldRecord& held)
        : a_(a), cursor_(cursor), operands_(operands), indices_(indices), held_(held) {}

    void op_RecordCount();
    void op_RecordField();
    void op_RecordUniform();

  private:
    void find_set();
    void find();
    void read(bool uniform);

    arm::Assembler& a_;
    const CodeCursor& cursor_;
    Operands& operands_;
    Indices& indices_;
    HeldRecord& held_;
};

}  // namespace kinora::jit::a64
