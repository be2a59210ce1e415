// jit/a64/blends.cpp: one of two values in each lane, by a mask.
#include "jit/a64/blends_p.h"

#include "jit/ir/planted_fault.h"

namespace kinora::jit::a64 {

void Blends::blend(const Vec& to, const Vec& otherwise, Value then, Value mask) {
    Vec m = operands_.reg(mask, 1), t = operands_.reg(then, 2);
    if (to.id() == m.id() && to.id() != otherwise.id() && to.id() != t.id()) {
        a_.bsl(to.b16(), t.b16(), otherwise.b16());
    } else if (to.id() == t.id() && !planted(PlantedFault::BlendMixed)) {
        a_.bif(to.b16(), otherwise.b16(), m.b16());
    } else {
        operands_.move(to, otherwise);
        a_.bit(to.b16(), t.b16(), m.b16());
    }
}

void Blends::op_Select() {
    Value mask = cursor_->a, then = cursor_->b, otherwise = cursor_->c;
    Vec to = operands_.target();
    if (cursor_.code().is_zero(otherwise)) {
        Vec m = operands_.reg(mask, 1);
        a_.and_(to.b16(), m.b16(), operands_.reg(then, 2).b16());
    } else if (cursor_.code().is_zero(then)) {
        Vec m = operands_.reg(mask, 1);
        Vec kept = operands_.reg(otherwise, 2);
        planted(PlantedFault::ZeroArmMixed) ? a_.and_(to.b16(), kept.b16(), m.b16())
                                            : a_.bic(to.b16(), kept.b16(), m.b16());
    } else {
        blend(to, operands_.reg(otherwise, 0), then, mask);
    }
    operands_.finish(to);
}

}  // namespace kinora::jit::a64
