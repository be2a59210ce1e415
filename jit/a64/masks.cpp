// jit/a64/masks.cpp: comparisons, mask logic, and what general registers learn of a mask.
#include "jit/a64/masks_p.h"

#include <utility>

#include "jit/ir/planted_fault.h"

namespace kinora::jit::a64 {

// There is only "greater" and "equal"; they are false on NaN.
void Masks::op_Lt() {
    operands_.binary([&](Vec to, Vec a, Vec b) { a_.fcmgt(to.s4(), b.s4(), a.s4()); });
}
void Masks::op_Le() {
    operands_.binary([&](Vec to, Vec a, Vec b) { a_.fcmge(to.s4(), b.s4(), a.s4()); });
}
void Masks::op_Eq() {
    operands_.binary([&](Vec to, Vec a, Vec b) { a_.fcmeq(to.s4(), a.s4(), b.s4()); });
}
void Masks::op_ILt() {
    operands_.binary([&](Vec to, Vec a, Vec b) { a_.cmgt(to.s4(), b.s4(), a.s4()); });
}
void Masks::op_IEq() {
    operands_.binary([&](Vec to, Vec a, Vec b) { a_.cmeq(to.s4(), a.s4(), b.s4()); });
}
void Masks::op_MAnd() {
    operands_.binary([&](Vec to, Vec a, Vec b) { a_.and_(to.b16(), a.b16(), b.b16()); });
}
void Masks::op_MOr() {
    operands_.binary([&](Vec to, Vec a, Vec b) { a_.orr(to.b16(), a.b16(), b.b16()); });
}
void Masks::op_MXor() {
    operands_.binary([&](Vec to, Vec a, Vec b) { a_.eor(to.b16(), a.b16(), b.b16()); });
}
void Masks::op_MAndNot() {
    operands_.binary([&](Vec to, Vec a, Vec b) {
        if (planted(PlantedFault::AndNotMirrored)) std::swap(a, b);
        a_.bic(to.b16(), a.b16(), b.b16());
    });
}

void Masks::op_MNot() {
    operands_.unary([&](Vec to, Vec a) { a_.not_(to.b16(), a.b16()); });
}

// Half of each lane's bits.
void Masks::find_any(const Vec& mask) {
    Vec halves = Operands::scratch(2);
    a_.xtn(halves.h4(), mask.s4());
    if (planted(PlantedFault::LanesOverlooked))
        a_.fmov(kAny.w(), halves.s());
    else
        a_.fmov(kAny, halves.d());
}

void Masks::lane_bits(const Gp& to, Value mask) {
    Vec m = operands_.reg(mask, 1);
    Vec bits = Operands::scratch(2);
    a_.ldr(bits, arm::ptr(kPool, Pool::kLaneBits));
    a_.and_(bits.b16(), bits.b16(), m.b16());
    a_.addv(bits.s(), bits.s4());
    a_.fmov(to.w(), bits.s());
}

}  // namespace kinora::jit::a64
