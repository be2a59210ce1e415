// rsl/builtins/maps_p.h: what the built-ins over maps share: coordinates with their footprint, and
// texels with their derivatives.
#pragma once

#include "rsl/lower/builtin_call.h"
#include "rsl/reference/service_calls_p.h"

namespace kinora::rsl {

namespace lower_maps {

// Coordinates and how they change across the shading point along u (x) and v (y).
struct Lookup {
    Value s, t, dsdx, dtdx, dsdy, dtdy;
};

inline Lookup with_derivatives(LowerCall& c, Value s, Value t) {
    auto& b = c.b;
    Value du = c.globals.read(Global::du).c[0], dv = c.globals.read(Global::dv).c[0];
    auto along = [&](jit::Op op, Value x, Value width) { return b.mul(b.op(op, x), width); };
    return {s,
            t,
            along(jit::Op::Du, s, du),
            along(jit::Op::Du, t, du),
            along(jit::Op::Dv, s, dv),
            along(jit::Op::Dv, t, dv)};
}

inline Value channel(LowerCall& c) {
    return c.call.channel ? c.tree.value(*c.call.channel) : c.b.f(0);
}

inline void set_texels(LowerCall& c, const std::vector<Value>& rgba) {
    if (c.result_type() == BaseType::Float)
        c.set(rgba[0]);
    else
        c.set(V3{rgba[0], rgba[1], rgba[2]});
}

// The texels here, with the differences to the lookups beside as their derivatives: what a grid of
// small faces sees. Answers of services have no slope, so slope * u has this one along u. Where
// nothing takes the derivative the lookups beside are dropped: they are pure.
inline void set_with_differences(LowerCall& c, std::vector<Value> here,
                                 const std::vector<Value>& along_u,
                                 const std::vector<Value>& along_v) {
    auto& b = c.b;
    auto term = [&](Value beside, Value texel, Global parameter, Global width) {
        Value x = c.globals.input(parameter).c[0], w = c.globals.input(width).c[0];
        Value slope = b.op(jit::Op::Div, b.sub(beside, texel), b.op(jit::Op::Max, w, b.f(1e-12f)));
        return b.mul(slope, x);
    };
    for (size_t k = 0; k < here.size(); ++k)
        here[k] = b.op(jit::Op::WithSlope, here[k],
                       b.add(term(along_u[k], here[k], Global::u, Global::du),
                             term(along_v[k], here[k], Global::v, Global::dv)));
    set_texels(c, here);
}

inline std::vector<Value> look_up(LowerCall& c, const Lookup& at, Value blur, Value swidth,
                                  Value twidth) {
    return c.services.call(
        Service::texture,
        std::array{c.f(0), channel(c), at.s, at.t, at.dsdx, at.dtdx, at.dsdy, at.dtdy, blur, swidth,
                   twidth, c.text_pair("filter"), c.pair("fill", 0)});
}

// "swidth" and "twidth" count before "width".
inline Value width(LowerCall& c, std::string_view direction) {
    return c.pair(c.has_pair(direction) ? direction : "width", 1);
}

}  // namespace lower_maps

namespace ref {

// What a map shows, and as its derivatives the differences to what it shows one footprint further
// along u and along v: `ask` is given how many footprints.
template <class Real, class Ask>
void from_map(RefCall<Real>& c, Ask&& ask) {
    std::vector<double> here = ask(Real(0), Real(0)), u = ask(Real(1), Real(0)),
                        v = ask(Real(0), Real(1));
    set_from(c, here);
    Real du = std::max(c.eval.global(Global::du).c[0].x, Real(1e-12f));
    Real dv = std::max(c.eval.global(Global::dv).c[0].x, Real(1e-12f));
    for (size_t k = 0; k < c.result.size() && k < here.size(); ++k) {
        c.result.c[k].u = (Real(u[k]) - Real(here[k])) / du;
        c.result.c[k].v = (Real(v[k]) - Real(here[k])) / dv;
    }
}

}  // namespace ref

}  // namespace kinora::rsl
