// jit/x64/calls_p.h: calls of services (C++) and of the module's own functions, and their results.
#pragma once

#include <span>

#include "jit/codegen/held_record_p.h"
#include "jit/x64/masks_p.h"
#include "jit/x64/rows_p.h"

namespace kinora::jit::x64 {

// No vector register lives through a call (values in need lie in memory); rbx rbp r12..r15 are
// kept.
class Calls {
  public:
    // `entries`: of the module's functions.
    Calls(x86::Assembler& a, const Isa& isa, std::span<const Label> entries,
          const CodeCursor& cursor, Operands& operands, Masks& masks, Rows& rows, HeldRecord& held)
        : a_(a),
          isa_(isa),
          entries_(entries),
          cursor_(cursor),
          operands_(operands),
          masks_(masks),
          rows_(rows),
          held_(held) {}

    void op_Service();
    void op_Call();
    void op_Result();
    void op_Return();

  private:
    void pass_arguments(int32_t to, bool to_service);
    void clear_handle();
    void fill_service_call();
    void return_outputs();
    void return_results();

    x86::Assembler& a_;
    const Isa& isa_;
    std::span<const Label> entries_;
    const CodeCursor& cursor_;
    Operands& operands_;
    Masks& masks_;
    Rows& rows_;
    HeldRecord& held_;
};

}  // namespace kinora::jit::x64
