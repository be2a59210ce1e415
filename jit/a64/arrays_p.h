// jit/a64/arrays_p.h: a function's arrays: [element][lanes] in its frame.
#pragma once

#include "jit/a64/blends_p.h"
#include "jit/a64/gathers_p.h"

namespace kinora::jit::a64 {

class Arrays {
  public:
    Arrays(arm::Assembler& a, const CodeCursor& cursor, Operands& operands, Blends& blends,
           Indices& indices, Gathers& gathers)
        : a_(a),
          cursor_(cursor),
          operands_(operands),
          blends_(blends),
          indices_(indices),
          gathers_(gathers) {}

    void zero();  // all of them, at entry
    void op_ArrayLoad();
    void op_ArrayStore();

  private:
    // Of the array that the instruction in work reads or writes.
    int32_t length() const;
    int32_t offset() const;
    void find_element(Value index);
    void scatter_by_lane(Value value, Value mask);

    arm::Assembler& a_;
    const CodeCursor& cursor_;
    Operands& operands_;
    Blends& blends_;
    Indices& indices_;
    Gathers& gathers_;
};

}  // namespace kinora::jit::a64
