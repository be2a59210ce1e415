// jit/a64/calls_p.h: calls of services (C++) and of the module's own functions, and their results.
#pragma once

#include <span>

#include "jit/a64/branches_p.h"
#include "jit/a64/masks_p.h"
#include "jit/codegen/held_record_p.h"

namespace kinora::jit::a64 {

// No vector register lives through a call (values in need lie in memory); x19..x25 are kept.
class Calls {
  public:
    // `entries`: of the module's functions.
    Calls(arm::Assembler& a, std::span<const Label> entries, const CodeCursor& cursor,
          Operands& operands, Masks& masks, Branches& branches, HeldRecord& held)
        : a_(a),
          entries_(entries),
          cursor_(cursor),
          operands_(operands),
          masks_(masks),
          branches_(branches),
          held_(held) {}

    void op_Service();
    void op_Call();
    void op_Result();
    void op_Return();

  private:
    void pass_arguments(int32_t to);
    void fill_service_call();

    arm::Assembler& a_;
    std::span<const Label> entries_;
    const CodeCursor& cursor_;
    Operands& operands_;
    Masks& masks_;
    Branches& branches_;
    HeldRecord& held_;
};

}  // namespace kinora::jit::a64
