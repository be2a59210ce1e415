// jit/x64/arrays_p.h: a function's arrays: [element][lanes] in its frame.
#pragma once

#include "jit/x64/blends_p.h"
#include "jit/x64/gathers_p.h"

namespace kinora::jit::x64 {

class Arrays {
  public:
    Arrays(x86::Assembler& a, const Isa& isa, Pool& pool, const CodeCursor& cursor,
           Operands& operands, Masks& masks, Blends& blends, Rows& rows, Indices& indices,
           Gathers& gathers)
        : a_(a),
          isa_(isa),
          pool_(pool),
          cursor_(cursor),
          operands_(operands),
          masks_(masks),
          blends_(blends),
          rows_(rows),
          indices_(indices),
          gathers_(gathers) {}

    void zero();  // all of them, at entry
    void op_ArrayLoad();
    void op_ArrayStore();

  private:
    // Of the array that the instruction in work reads or writes.
    int32_t length() const;
    int32_t offset() const;
    x86::Mem element(Value index);
    void element_words(Value index);
    void store_under(const x86::Mem& to, Value value, Value mask);
    void scatter(Value value, Value mask);
    void scatter_by_lane(Value value, Value mask);

    x86::Assembler& a_;
    const Isa& isa_;
    Pool& pool_;
    const CodeCursor& cursor_;
    Operands& operands_;
    Masks& masks_;
    Blends& blends_;
    Rows& rows_;
    Indices& indices_;
    Gathers& gathers_;
};

}  // namespace kinora::jit::x64
