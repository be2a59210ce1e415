// jit/a64/control_flow_p.h: If and Loop. A region is entered when any lane runs it; what lanes see
// differently is blended under the mask, unless all lanes agree.
#pragma once

#include <vector>

#include "jit/a64/assignments_p.h"
#include "jit/a64/faults_p.h"
#include "jit/a64/open_loops_p.h"
#include "jit/codegen/held_record_p.h"
#include "jit/codegen/joins_p.h"

namespace kinora::jit::a64 {

class ControlFlow {
  public:
    ControlFlow(arm::Assembler& a, const CodeCursor& cursor, Operands& operands, Masks& masks,
                Assignments& assignments, Branches& branches, OpenLoops& loops, HeldRecord& held,
                Faults& faults)
        : a_(a),
          cursor_(cursor),
          operands_(operands),
          masks_(masks),
          assignments_(assignments),
          joins_(cursor, assignments),
          branches_(branches),
          loops_(loops),
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

    void begin_body(Value loop);

    arm::Assembler& a_;
    const CodeCursor& cursor_;
    Operands& operands_;
    Masks& masks_;
    Assignments& assignments_;
    Joins<Assignments> joins_;
    Branches& branches_;
    OpenLoops& loops_;
    HeldRecord& held_;
    Faults& faults_;
    std::vector<OpenIf> ifs_;
};

}  // namespace kinora::jit::a64
