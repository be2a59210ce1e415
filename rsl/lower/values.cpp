// rsl/lower/values.cpp: RSL values of any type: conversions and operators.
#include "rsl/lower/values.h"

#include <algorithm>

namespace kinora::rsl {

Lowered zero(Emitter& e, BaseType type) {
    Lowered result{type, {}};
    Value none = type == BaseType::String ? e.b.i(0)
                 : type == BaseType::Bool ? e.b.m(false)
                                          : e.b.f(0);
    for (int c = 0; c < result.size(); ++c) result.c[size_t(c)] = none;
    return result;
}

Lowered convert(Emitter& e, const Lowered& x, BaseType to) {
    if (x.type == to) return x;
    if (to == BaseType::Bool) return lowered(to, e.b.ne(x.c[0], e.b.f(0)));
    Value s = x.type == BaseType::Bool ? e.flag(x.c[0]) : x.c[0];
    if (to == BaseType::Matrix) {
        Lowered m = zero(e, BaseType::Matrix);
        for (size_t k = 0; k < 4; ++k) m.c[k * 5] = s;
        return m;
    }
    if (is_triple(to) && is_triple(x.type)) return lowered(to, x.v3());
    if (is_triple(to)) return lowered(to, V3{s, s, s});
    return lowered(to, s);
}

// ---- operators ----------------------------------------------------------------------------------

static Value compare(Emitter& e, Op op, const Lowered& x, const Lowered& y) {
    if (x.type == BaseType::String) {
        Value same = e.b.op(jit::Op::IEq, x.c[0], y.c[0]);
        return op == Op::NotEqual ? e.b.logical_not(same) : same;
    }
    if (x.type == BaseType::Bool) {
        Value differ = e.b.op(jit::Op::MXor, x.c[0], y.c[0]);
        return op == Op::NotEqual ? differ : e.b.logical_not(differ);
    }
    Value all = e.b.m(true);
    for (size_t c = 0; c < size_t(x.size()); ++c) {
        Value one = op == Op::Less           ? e.b.lt(x.c[c], y.c[c])
                    : op == Op::LessEqual    ? e.b.le(x.c[c], y.c[c])
                    : op == Op::Greater      ? e.b.gt(x.c[c], y.c[c])
                    : op == Op::GreaterEqual ? e.b.ge(x.c[c], y.c[c])
                                             : e.b.eq(x.c[c], y.c[c]);
        all = e.b.logical_and(all, one);
    }
    return op == Op::NotEqual ? e.b.logical_not(all) : all;
}

Lowered binary(Emitter& e, Op op, const Lowered& x, const Lowered& y) {
    if (op == Op::And) return lowered(BaseType::Bool, e.b.logical_and(x.c[0], y.c[0]));
    if (op == Op::Or) return lowered(BaseType::Bool, e.b.logical_or(x.c[0], y.c[0]));
    if (op >= Op::Less && op <= Op::NotEqual) return lowered(BaseType::Bool, compare(e, op, x, y));
    if (op == Op::Dot) return lowered(BaseType::Float, e.dot(x.v3(), y.v3()));
    if (op == Op::Cross) return lowered(BaseType::Vector, e.cross(x.v3(), y.v3()));
    if (x.type == BaseType::Matrix && op == Op::Multiply) return multiply(e, x, y);
    if (x.type == BaseType::Matrix && op == Op::Divide) return multiply(e, x, invert(e, y));
    Lowered r = x;
    for (size_t c = 0; c < size_t(x.size()); ++c)
        r.c[c] = op == Op::Add        ? e.b.add(x.c[c], y.c[c])
                 : op == Op::Subtract ? e.b.sub(x.c[c], y.c[c])
                 : op == Op::Multiply ? e.mul(x.c[c], y.c[c])
                                      : e.div(x.c[c], y.c[c]);
    return r;
}

Value pick(Emitter& e, const V3& v, Value component) {
    int32_t known;
    if (e.b.constant_i(component, &known)) return v[size_t(std::clamp(known, 0, 2))];
    Value last = e.b.select(e.b.op(jit::Op::IEq, component, e.b.i(1)), v[1], v[2]);
    return e.b.select(e.b.op(jit::Op::IEq, component, e.b.i(0)), v[0], last);
}

}  // namespace kinora::rsl
