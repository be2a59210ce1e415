// jit/x64/records_p.h: records of a grid (light answers): sets[a].records[b].
#pragma once

#include "jit/codegen/held_record_p.h"
#include "jit/x64/indices_p.h"
#include "jit/x64/rows_p.h"

namespace kinora::jit::x64 {

class Records {
  public:
    // `held` is the record that r10 and r11 belong to.
    Records(x86::Assembler& a, const CodeCursor& cursor, Operands& operands, Rows& rows,
            Indices& indices, HeldRecord& held)
        : a_(a),
          cursor_(cursor),
          operands_(operands),
          rows_(rows),
          indices_(indices),
          held_(held) {}

    void op_RecordCount();
    void op_RecordField();
    void op_RecordUniform();

    // r10, r11 = the columns and uniforms of the record, both null if the set is empty and that is
    // not ruled out.
    void find(Value set, Value index, bool in_range);

  private:
    x86::Mem find_set(Value set);
    void find_clamped(const x86::Mem& set);
    void read(bool uniform);

    x86::Assembler& a_;
    const CodeCursor& cursor_;
    Operands& operands_;
    Rows& rows_;
    Indices& indices_;
    HeldRecord& held_;
};

}  // namespace kinora::jit::x64
