// jit/x64/control_flow_p.h: If and Loop. A region is entered when any lane runs it; what lanes see
// differently is blended under the mask, unless all lanes agree.
#pragma once

#include <vector>

#include "jit/codegen/joins_p.h"
#include "jit/x64/assignments_p.h"
#include "jit/x64/faults_p.h"
#include "jit/x64/records_p.h"

namespace kinora::jit::x64 {

class ControlFlow {
  public:
    // `held` is the record that `records` keeps in registers.
    ControlFlow(x86::Assembler& a, const CodeCursor& cursor, Operands& operands, Masks& masks,
                Assignments& assignments, OpenLoops& loops, Records& records, HeldRecord& held,
                Faults& faults)
        : a_(a),
          cursor_(cursor),
          operands_(operands),
          masks_(masks),
          assignments_(assignments),
          joins_(cursor, assignments),
          loops_(loops),
          records_(records),
          held_(held),
          faults_(faults) {}

    void op_If();
    void op_EndIf();
    void op_Merge() {}  // written by If and EndIf
    void op_Loop();
    void op_LoopVar();
    void op_EndLoop();
    void op_LoopOut() {}  // lies where its LoopVar does

  private:
    struct OpenIf {
        Label end;
        HeldRecord::Key record;  // held when it was entered
    };

    void test_kind(Value condition);
    void begin_body(Value loop);
    void leave_unless_any(const OpenLoop& loop);
    void update_mask(Value loop);

    x86::Assembler& a_;
    const CodeCursor& cursor_;
    Operands& operands_;
    Masks& masks_;
    Assignments& assignments_;
    Joins<Assignments> joins_;
    OpenLoops& loops_;
    Records& records_;
    HeldRecord& held_;
    Faults& faults_;
    std::vector<OpenIf> ifs_;
};

}  // namespace kinora::jit::x64
