// rsl/builtins_texture.cpp: rows of the built-in table: textures and maps.
#include <algorithm>

#include "rsl/builtin.h"
#include "rsl/lower_p.h"
#include "rsl/reference_builtins.h"

namespace kinora::rsl {

namespace lower_texture {

// Coordinates and how they change across the shading point along u (x) and v (y).
struct Lookup {
    Value s, t, dsdx, dtdx, dsdy, dtdy;
};

Lookup with_derivatives(LowerCall& c, Value s, Value t) {
    auto& b = c.b;
    Value du = c.low.read_global(Global::du).c[0], dv = c.low.read_global(Global::dv).c[0];
    auto along = [&](jit::Op op, Value x, Value width) { return b.mul(b.op(op, x), width); };
    return {s,
            t,
            along(jit::Op::Du, s, du),
            along(jit::Op::Du, t, du),
            along(jit::Op::Dv, s, dv),
            along(jit::Op::Dv, t, dv)};
}

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

Value channel(LowerCall& c) {
    return c.call.channel ? c.low.value(*c.call.channel) : c.b.f(0);
}

Value filter_name(LowerCall& c) {
    for (auto& [name, value] : c.pairs)
        if (name == "filter" && value.type == BaseType::String) return value.c[0];
    return c.b.i(0);
}

void set_texels(LowerCall& c, const std::vector<Value>& rgba) {
    if (c.result_type() == BaseType::Float)
        c.set(rgba[0]);
    else
        c.set(V3{rgba[0], rgba[1], rgba[2]});
}

// Whether the shader makes normals of what it reads: then a texture has a derivative, which costs
// two more lookups.
bool bends_normals(LowerCall& c) {
    if (c.low.kind() == ShaderKind::Displacement) return true;
    const std::vector<Token>& tokens = c.low.ast().tokens.tokens;
    return std::any_of(tokens.begin(), tokens.end(),
                       [](const Token& token) { return token.text == "calculatenormal"; });
}

// The value here, with the differences to the lookups beside it as its derivatives: what a grid of
// small faces sees. The bits of u have no derivative, so u - u of its bits is 0 but has that of u;
// the bits of du, in and out again, keep that from being folded.
Value with_differences(LowerCall& c, Value here, Value along_u, Value along_v) {
    auto& b = c.b;
    auto term = [&](Value beside, Global parameter, Global width) {
        Value x = c.low.global_input(parameter).c[0], w = c.low.global_input(width).c[0];
        Value slope = b.op(jit::Op::Div, b.sub(beside, here), b.op(jit::Op::Max, w, b.f(1e-12f)));
        Value mask = b.op(jit::Op::BitsFI, w);
        Value mixed = b.op(jit::Op::IXor, b.op(jit::Op::BitsFI, x), mask);
        Value still = b.op(jit::Op::BitsIF, b.op(jit::Op::IXor, mixed, mask));
        return b.mul(slope, b.sub(x, still));
    };
    return b.add(here, b.add(term(along_u, Global::u, Global::du),
                             term(along_v, Global::v, Global::dv)));
}

void texture(LowerCall& c) {
    Lookup at;
    if (c.args.size() == 9)
        at = of_corners(c);
    else if (c.args.size() == 3)
        at = with_derivatives(c, c.f(1), c.f(2));
    else
        at = with_derivatives(c, c.low.read_global(Global::s).c[0],
                              c.low.read_global(Global::t).c[0]);
    Value width = c.pair("width", 1);
    auto width_of = [&](std::string_view name) {
        for (auto& [key, value] : c.pairs)
            if (key == name) return value.c[0];
        return width;
    };
    auto lookup = [&](Value s, Value t) {
        return c.low.service("texture",
                             std::array{c.f(0), channel(c), s, t, at.dsdx, at.dtdx, at.dsdy,
                                        at.dtdy, c.pair("blur", 0), width_of("swidth"),
                                        width_of("twidth"), filter_name(c), c.pair("fill", 0)});
    };
    std::vector<Value> texels = lookup(at.s, at.t);
    if (bends_normals(c)) {
        auto& b = c.b;
        std::vector<Value> u = lookup(b.add(at.s, at.dsdx), b.add(at.t, at.dtdx));
        std::vector<Value> v = lookup(b.add(at.s, at.dsdy), b.add(at.t, at.dtdy));
        for (size_t k = 0; k < texels.size(); ++k)
            texels[k] = with_differences(c, texels[k], u[k], v[k]);
    }
    set_texels(c, texels);
}

void environment(LowerCall& c) {
    auto& e = c.low;
    V3 R, dx, dy;
    if (c.args.size() == 5) {
        R = e.scale(e.add(e.add(c.v3(1), c.v3(2)), e.add(c.v3(3), c.v3(4))), e.f(0.25f));
        dx = e.scale(e.add(e.sub(c.v3(2), c.v3(1)), e.sub(c.v3(4), c.v3(3))), e.f(0.5f));
        dy = e.scale(e.add(e.sub(c.v3(3), c.v3(1)), e.sub(c.v3(4), c.v3(2))), e.f(0.5f));
    } else {
        R = c.v3(1);
        dx = e.scale(e.du(R), e.read_global(Global::du).c[0]);
        dy = e.scale(e.dv(R), e.read_global(Global::dv).c[0]);
    }
    set_texels(c, e.service("environment",
                            std::array{c.f(0), channel(c), R[0], R[1], R[2], dx[0], dx[1], dx[2],
                                       dy[0], dy[1], dy[2], c.pair("blur", 0), c.pair("fill", 0)}));
}

// 0 lit, 1 in shadow; the four-corner form looks at the middle.
void shadow(LowerCall& c) {
    auto& e = c.low;
    if (!e.options.want_Ci && e.kind() != ShaderKind::Light) return;
    V3 P = c.v3(1);
    if (c.args.size() == 5)
        P = e.scale(e.add(e.add(c.v3(1), c.v3(2)), e.add(c.v3(3), c.v3(4))), e.f(0.25f));
    set_texels(c, e.service("shadow", std::array{c.f(0), P[0], P[1], P[2], c.pair("bias", 0),
                                                 c.pair("blur", 0), c.pair("samples", 16)}));
}

}  // namespace lower_texture

namespace {

namespace lower = lower_texture;

const Builtin kRows[] = {
    // Two rows: only the forms without coordinates read s and t.
    {"texture", "f=s~ c=s~", lower::texture, KINORA_RSL_REF(ref::texture), kService | kDerivative,
     0, "Filtered texture at the surface's s, t; texture(name[channel]).", kAnyShader, "s t"},
    {"texture", "f=sff~ c=sff~ f=sffffffff~ c=sffffffff~", lower::texture,
     KINORA_RSL_REF(ref::texture), kService | kDerivative, 0,
     "Filtered texture at s, t or over a quadrilateral; texture(name[channel], s, t)."},
    {"environment", "f=sv~ c=sv~ f=svvvv~ c=svvvv~", lower::environment,
     KINORA_RSL_REF(ref::environment), kService | kDerivative, 0,
     "Environment map in a direction."},
    {"shadow", "f=sp~ c=sp~ f=spppp~ c=spppp~", lower::shadow, KINORA_RSL_REF(ref::shadow),
     kService | kShadows | kVaryingResult, 0, "Share of shadow at a point, by map or ray.",
     kSurface | kLight},
    {"bump",
     "n=snvv~ n=snvvff~",
     nullptr,
     {},
     kService | kDerivative,
     0,
     "Normal bent by a bump map.",
     kSurface | kDisplacement,
     "s t"},
    {"textureinfo",
     "f=ssF f=ssC f=ssP f=ssV f=ssN f=ssM f=ssS f=ssF[] f=ssC[] f=ssP[] "
     "f=ssV[] f=ssN[] f=ssM[] f=ssS[]",
     nullptr,
     {},
     kService,
     0,
     "A fact about a texture: 1 if known."},
    {"texture3d",
     "f=spn~",
     nullptr,
     {},
     kService | kVaryingResult,
     0,
     "Values from a point cloud.",
     kSurface | kLight | kDisplacement},
    {"bake3d",
     "f=spn~ f=sspn~",
     nullptr,
     {},
     kService | kPrints | kVaryingResult,
     0,
     "Writes values to a point cloud.",
     kSurface | kLight | kDisplacement},
    {"bake",
     "x=sfff x=sffc x=sffp x=sffv x=sffn",
     nullptr,
     {},
     kService | kPrints,
     0,
     "Writes a value at s, t to a file.",
     kSurface | kDisplacement},
};

}  // namespace

std::span<const Builtin> builtins_texture() {
    return kRows;
}

}  // namespace kinora::rsl
