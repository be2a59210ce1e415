// rsl/builtins/color.cpp: colors and components.
#include <algorithm>

#include "rsl/builtins/table.h"
#include "rsl/lower/builtin_call.h"
#include "rsl/reference/reference_p.h"

namespace kinora::rsl {

namespace lower_color {

// The element of `count` that a float index names; truncated and clamped.
Value pick(LowerCall& c, std::span<const Value> items, Value x) {
    Value index = c.e.index(x, int(items.size()));
    int32_t known;
    if (c.b.constant_i(index, &known)) return items[size_t(known)];
    Value result = items[0];
    for (size_t k = 1; k < items.size(); ++k)
        result = c.b.select(c.b.op(jit::Op::IEq, index, c.b.i(int(k))), items[k], result);
    return result;
}

void put(LowerCall& c, std::span<Value> items, Value x, Value value) {
    Value index = c.e.index(x, int(items.size()));
    for (size_t k = 0; k < items.size(); ++k)
        items[k] = c.b.select(c.b.op(jit::Op::IEq, index, c.b.i(int(k))), value, items[k]);
}

// comp(c, i), comp(m, row, column)
void comp(LowerCall& c) {
    auto& v = c.args[0].c;
    if (c.args[0].type != BaseType::Matrix) return c.set(pick(c, std::span(v.data(), 3), c.f(1)));
    std::array<Value, 4> rows;
    for (size_t r = 0; r < 4; ++r) rows[r] = pick(c, std::span(v.data() + 4 * r, 4), c.f(2));
    c.set(pick(c, rows, c.f(1)));
}

// setcomp(c, i, x), setcomp(m, row, column, x)
void setcomp(LowerCall& c) {
    Lowered v = c.args[0];
    if (v.type != BaseType::Matrix) {
        put(c, std::span(v.c.data(), 3), c.f(1), c.f(2));
        return c.set_output(0, v);
    }
    Value row = c.e.index(c.f(1), 4);
    for (size_t r = 0; r < 4; ++r) {
        std::array<Value, 4> items = {v.c[4 * r], v.c[4 * r + 1], v.c[4 * r + 2], v.c[4 * r + 3]};
        put(c, items, c.f(2), c.f(3));
        Value here = c.b.op(jit::Op::IEq, row, c.b.i(int(r)));
        for (size_t k = 0; k < 4; ++k) v.c[4 * r + k] = c.b.select(here, items[k], v.c[4 * r + k]);
    }
    c.set_output(0, v);
}

// ctransform("to", c), ctransform("from", "to", c); rgb is the space of colors.
void ctransform(LowerCall& c) {
    bool both = c.args.size() == 3;
    const std::string* first = c.text(0);
    const std::string* second = both ? c.text(1) : first;
    if (!first || !second) return;
    const Lowered& color = c.args.back();
    c.result = both ? color_space(c.e, c.context, color, *first, *second, c.where())
                    : color_space(c.e, c.context, color, "rgb", *first, c.where());
}

}  // namespace lower_color

namespace ref {
namespace {

template <class Real>
size_t element(RefCall<Real>& c, size_t i, int length) {
    Real x = c.f(i).x;
    return size_t(c.eval.decide(int(x > 0 ? std::min(x, Real(length - 1)) : Real(0))));
}

// The component that arguments first, first + 1 name.
template <class Real>
size_t component(RefCall<Real>& c) {
    if (c.args[0].type != BaseType::Matrix) return element(c, 1, 3);
    return element(c, 1, 4) * 4 + element(c, 2, 4);
}

template <class Real>
void comp(RefCall<Real>& c) {
    c.set(c.args[0].c[component(c)]);
}

template <class Real>
void setcomp(RefCall<Real>& c) {
    c.args[0].c[component(c)] = c.args.back().c[0];
}

template <class Real>
void ctransform(RefCall<Real>& c) {
    bool both = c.args.size() == 3;
    c.set(c.eval.color_space(c.v(both ? 2 : 1), both ? c.text(0) : "rgb", c.text(both ? 1 : 0)));
}

}  // namespace
}  // namespace ref

namespace {

namespace lower = lower_color;

const Builtin kRows[] = {
    {"comp", "f=cf f=pf f=vf f=nf f=mff", lower::comp, KINORA_RSL_REF(ref::comp), kPure, 0,
     "A component: comp(c, i), comp(m, row, column)."},
    {"setcomp", "x=Cff x=Pff x=Vff x=Nff x=Mfff", lower::setcomp, KINORA_RSL_REF(ref::setcomp),
     kPure, 0, "Sets a component: setcomp(c, i, x), setcomp(m, row, column, x)."},
    {"ctransform", "c=sc c=ssc", lower::ctransform, KINORA_RSL_REF(ref::ctransform), kPure, 8,
     "A color from one space to another: rgb hsv hsl xyz xyY YIQ."},
};

}  // namespace

std::span<const Builtin> builtins_color() {
    return kRows;
}

}  // namespace kinora::rsl
