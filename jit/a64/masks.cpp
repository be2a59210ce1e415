// jit/a64/masks.cpp: comparisons, mask logic, and blends under a mask. A mask's lanes are all
// ones or zero.
#include <utility>

#include "jit/a64/emit_p.h"

namespace kinora::jit::a64 {

// There is only "greater" and "equal"; they are false on NaN.
void Emit::op_Lt() {
    binary([&](Vec to, Vec a, Vec b) { a_.fcmgt(to.s4(), b.s4(), a.s4()); });
}
void Emit::op_Le() {
    binary([&](Vec to, Vec a, Vec b) { a_.fcmge(to.s4(), b.s4(), a.s4()); });
}
void Emit::op_Eq() {
    binary([&](Vec to, Vec a, Vec b) { a_.fcmeq(to.s4(), a.s4(), b.s4()); });
}
void Emit::op_ILt() {
    binary([&](Vec to, Vec a, Vec b) { a_.cmgt(to.s4(), b.s4(), a.s4()); });
}
void Emit::op_IEq() {
    binary([&](Vec to, Vec a, Vec b) { a_.cmeq(to.s4(), a.s4(), b.s4()); });
}

void Emit::op_MAnd() {
    op_IAnd();
}
void Emit::op_MOr() {
    op_IOr();
}
void Emit::op_MXor() {
    op_IXor();
}
void Emit::op_MAndNot() {
    binary([&](Vec to, Vec a, Vec b) {
        if (planted(PlantedFault::AndNotMirrored)) std::swap(a, b);
        a_.bic(to.b16(), a.b16(), b.b16());
    });
}
void Emit::op_MNot() {
    unary([&](Vec to, Vec a) { a_.not_(to.b16(), a.b16()); });
}

// to = mask ? then : otherwise
void Emit::blend(const Vec& to, const Vec& otherwise, Value then, Value mask) {
    Vec m = reg(mask, 1), t = reg(then, 2);
    if (to.id() == m.id() && to.id() != otherwise.id() && to.id() != t.id()) {
        a_.bsl(to.b16(), t.b16(), otherwise.b16());
    } else if (to.id() == t.id() && !planted(PlantedFault::BlendMixed)) {
        a_.bif(to.b16(), otherwise.b16(), m.b16());
    } else {
        move(to, otherwise);
        a_.bit(to.b16(), t.b16(), m.b16());
    }
}

void Emit::op_Select() {
    Value mask = now().a, then = now().b, otherwise = now().c;
    Vec to = target();
    if (is_zero(otherwise)) {
        Vec m = reg(mask, 1);
        a_.and_(to.b16(), m.b16(), reg(then, 2).b16());
    } else if (is_zero(then)) {
        Vec m = reg(mask, 1);
        Vec kept = reg(otherwise, 2);
        planted(PlantedFault::ZeroArmMixed) ? a_.and_(to.b16(), kept.b16(), m.b16())
                                            : a_.bic(to.b16(), kept.b16(), m.b16());
    } else {
        blend(to, reg(otherwise, 0), then, mask);
    }
    finish(to);
}

// Writes `then` into a Merge or LoopVar where the mask is set.
void Emit::merge_into(Value variable, Value then, Value mask) {
    if (place(variable).reg >= 0) {
        Vec to = vec(place(variable).reg);
        return blend(to, to, then, mask);
    }
    a_.ldr(scratch(0), row(slot(variable)));
    blend(scratch(0), scratch(0), then, mask);
    store_slot(variable, scratch(0));
}

// kAny: half of each lane's bits.
void Emit::find_any(const Vec& mask) {
    a_.xtn(scratch(2).h4(), mask.s4());
    if (planted(PlantedFault::LanesOverlooked))
        a_.fmov(kAny.w(), scratch(2).s());
    else
        a_.fmov(kAny, scratch(2).d());
}

// Bit k of `to` is lane k. Changes scratch 1 and 2.
void Emit::mask_bits(const Gp& to, Value mask) {
    Vec m = reg(mask, 1);
    a_.ldr(scratch(2), arm::ptr(kPool, Pool::kLaneBits));
    a_.and_(scratch(2).b16(), scratch(2).b16(), m.b16());
    a_.addv(scratch(2).s(), scratch(2).s4());
    a_.fmov(to.w(), scratch(2).s());
}

}  // namespace kinora::jit::a64
