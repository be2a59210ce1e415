// rsl/builtins/texture.cpp: filtered textures.
#include "rsl/builtins/maps_p.h"
#include "rsl/builtins/table.h"
#include "rsl/lower/builtin_call.h"
#include "rsl/reference/reference_p.h"

namespace kinora::rsl {

namespace lower_texture {

using namespace lower_maps;

// The middle of four corners, and the mean of its opposite edges.
Lookup of_corners(LowerCall& c) {
    auto& b = c.b;
    auto quarter = [&](int k) {
        Value sum = b.add(b.add(c.f(1 + k), c.f(3 + k)), b.add(c.f(5 + k), c.f(7 + k)));
        return b.mul(sum, b.f(0.25f));
    };
    // Corners 1 2 / 3 4: x runs from 1, 3 to 2, 4.
    auto edge = [&](int k, int a0, int a1, int b0, int b1) {
        Value sum = b.add(b.sub(c.f(a1 + k), c.f(a0 + k)), b.sub(c.f(b1 + k), c.f(b0 + k)));
        return b.mul(sum, b.f(0.5f));
    };
    return {quarter(0),          quarter(1),          edge(0, 1, 3, 5, 7),
            edge(1, 1, 3, 5, 7), edge(0, 1, 5, 3, 7), edge(1, 1, 5, 3, 7)};
}

// "sblur" and "tblur" widen the footprint by shares of the image after the widths have scaled it.
void blur_apart(LowerCall& c, Lookup& at, Value& swidth, Value& twidth) {
    auto& b = c.b;
    auto widen = [&](Value& x, Value& y, Value& width, std::string_view name) {
        x = b.add(b.abs(b.mul(x, width)), c.pair(name, 0));
        y = b.mul(y, width);
        width = b.f(1);
    };
    if (!c.has_pair("sblur") && !c.has_pair("tblur")) return;
    widen(at.dsdx, at.dsdy, swidth, "sblur");
    widen(at.dtdy, at.dtdx, twidth, "tblur");
}

void texture(LowerCall& c) {
    c.report_unknown_pairs();
    Lookup at;
    if (c.args.size() == 9)
        at = of_corners(c);
    else if (c.args.size() == 3)
        at = with_derivatives(c, c.f(1), c.f(2));
    else
        at = with_derivatives(c, c.globals.read(Global::s).c[0], c.globals.read(Global::t).c[0]);
    Lookup where = at;
    Value swidth = width(c, "swidth"), twidth = width(c, "twidth");
    blur_apart(c, at, swidth, twidth);
    auto lookup = [&](Value s, Value t) {
        Lookup moved = at;
        moved.s = s, moved.t = t;
        return look_up(c, moved, c.pair("blur", 0), swidth, twidth);
    };
    auto& b = c.b;
    set_with_differences(c, lookup(at.s, at.t),
                         lookup(b.add(at.s, where.dsdx), b.add(at.t, where.dtdx)),
                         lookup(b.add(at.s, where.dsdy), b.add(at.t, where.dtdy)));
}

}  // namespace lower_texture

namespace ref {
namespace {

// Maps are asked without filter widths, the reference knows none; four corners by their middle.
template <class Real>
void texture(RefCall<Real>& c) {
    bool own = c.args.size() < 3, corners = c.args.size() == 9;
    Real du = c.eval.global(Global::du).c[0].x, dv = c.eval.global(Global::dv).c[0].x;
    double channel = c.call.channel ? double(c.eval.expr(*c.call.channel).c[0].x) : 0;
    // Along x from corners 1, 3 to 2, 4; along y from 1, 2 to 3, 4.
    auto coordinate = [&](Global global, size_t k, Real x, Real y) {
        if (!corners) {
            Dual<Real> at = own ? c.eval.global(global).c[0] : c.f(k);
            return at.x + (at.u * du) * x + (at.v * dv) * y;
        }
        Real a = c.f(k).x, b = c.f(k + 2).x, d = c.f(k + 4).x, e = c.f(k + 6).x;
        return Real(0.25) * ((a + b) + (d + e)) + Real(0.5) * ((b - a) + (e - d)) * x +
               Real(0.5) * ((d - a) + (e - b)) * y;
    };
    from_map(c, [&](Real x, Real y) {
        return c.eval.service(Service::texture,
                              {double(c.f(0).x), channel, double(coordinate(Global::s, 1, x, y)),
                               double(coordinate(Global::t, 2, x, y))});
    });
}

}  // namespace
}  // namespace ref

namespace {

namespace lower = lower_texture;

const Builtin kRows[] = {
    // Two rows: only the forms without coordinates read s and t.
    {"texture", "f=s~ c=s~", lower::texture, KINORA_RSL_REF(ref::texture),
     kService | kNamesFile | kDerivative, 0,
     "Filtered texture at the surface's s, t; texture(name[channel]); \"blur\" \"sblur\" "
     "\"tblur\" \"width\" \"swidth\" \"twidth\" \"filter\" \"fill\".",
     kAnyShader, "s t"},
    {"texture", "f=sff~ c=sff~ f=sffffffff~ c=sffffffff~", lower::texture,
     KINORA_RSL_REF(ref::texture), kService | kNamesFile | kDerivative, 0,
     "Filtered texture at s, t or over a quadrilateral; texture(name[channel], s, t)."},
};

}  // namespace

std::span<const Builtin> builtins_texture() {
    return kRows;
}

}  // namespace kinora::rsl
