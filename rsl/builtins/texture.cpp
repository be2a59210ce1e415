// rsl/builtins/texture.cpp: rows of the built-in table: textures and maps.
#include "rsl/builtins/table.h"
#include "rsl/lower/lower_p.h"
#include "rsl/reference/builtins.h"

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

void set_texels(LowerCall& c, const std::vector<Value>& rgba) {
    if (c.result_type() == BaseType::Float)
        c.set(rgba[0]);
    else
        c.set(V3{rgba[0], rgba[1], rgba[2]});
}

// The texels here, with the differences to the lookups beside as their derivatives: what a grid of
// small faces sees. Answers of services have no slope, so slope * u has this one along u. Where
// nothing takes the derivative the lookups beside are dropped: they are pure.
void set_with_differences(LowerCall& c, std::vector<Value> here, const std::vector<Value>& along_u,
                          const std::vector<Value>& along_v) {
    auto& b = c.b;
    auto term = [&](Value beside, Value texel, Global parameter, Global width) {
        Value x = c.low.global_input(parameter).c[0], w = c.low.global_input(width).c[0];
        Value slope = b.op(jit::Op::Div, b.sub(beside, texel), b.op(jit::Op::Max, w, b.f(1e-12f)));
        return b.mul(slope, x);
    };
    for (size_t k = 0; k < here.size(); ++k)
        here[k] = b.op(jit::Op::WithSlope, here[k],
                       b.add(term(along_u[k], here[k], Global::u, Global::du),
                             term(along_v[k], here[k], Global::v, Global::dv)));
    set_texels(c, here);
}

std::vector<Value> look_up(LowerCall& c, const Lookup& at, Value blur, Value swidth, Value twidth) {
    return c.low.service(
        Service::texture,
        std::array{c.f(0), channel(c), at.s, at.t, at.dsdx, at.dtdx, at.dsdy, at.dtdy, blur, swidth,
                   twidth, c.text_pair("filter"), c.pair("fill", 0)});
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

// "swidth" and "twidth" count before "width".
Value width(LowerCall& c, std::string_view direction) {
    return c.pair(c.has_pair(direction) ? direction : "width", 1);
}

void texture(LowerCall& c) {
    c.report_unknown_pairs();
    Lookup at;
    if (c.args.size() == 9)
        at = of_corners(c);
    else if (c.args.size() == 3)
        at = with_derivatives(c, c.f(1), c.f(2));
    else
        at = with_derivatives(c, c.low.read_global(Global::s).c[0],
                              c.low.read_global(Global::t).c[0]);
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

// A place or direction and how it changes across the shading point; of four, their middle.
struct Footprint {
    V3 at, dx, dy;
};
Footprint footprint(LowerCall& c) {
    auto& e = c.low;
    if (c.args.size() == 5)
        return {e.scale(e.add(e.add(c.v3(1), c.v3(2)), e.add(c.v3(3), c.v3(4))), e.f(0.25f)),
                e.scale(e.add(e.sub(c.v3(2), c.v3(1)), e.sub(c.v3(4), c.v3(3))), e.f(0.5f)),
                e.scale(e.add(e.sub(c.v3(3), c.v3(1)), e.sub(c.v3(4), c.v3(2))), e.f(0.5f))};
    V3 at = c.v3(1);
    return {at, e.scale(e.du(at), e.read_global(Global::du).c[0]),
            e.scale(e.dv(at), e.read_global(Global::dv).c[0])};
}

// The customary names of a map that is no file but the scene itself, asked by rays.
bool is_scene(LowerCall& c) {
    const std::string* name = c.low.constant_text(c.f(0));
    return name && (*name == "raytrace" || *name == "reflection");
}

// What a ray from P sees in the direction; "blur" opens its cone.
void trace_environment(LowerCall& c) {
    auto& e = c.low;
    if (!e.options.want_Ci) return;
    V3 P = e.read_global(Global::P).v3(), R = footprint(c).at;
    auto seed = e.sample_seed(c.call.site);
    set_texels(c, e.service(Service::trace,
                            std::array{seed[0], seed[1], P[0], P[1], P[2], R[0], R[1], R[2],
                                       c.pair("maxdist", 1e30f), c.pair("bias", -1),
                                       c.pair("samples", 1), c.pair("blur", 0), c.b.i(0)}));
}

// The footprint's sides are those along u and v: maps of directions and depths have no s and t.
void environment(LowerCall& c) {
    c.report_unknown_pairs();
    auto& e = c.low;
    if (is_scene(c)) return trace_environment(c);
    Footprint f = footprint(c);
    V3 dx = e.scale(f.dx, width(c, "swidth")), dy = e.scale(f.dy, width(c, "twidth"));
    auto lookup = [&](const V3& R) {
        return e.service(Service::environment,
                         std::array{c.f(0), channel(c), R[0], R[1], R[2], dx[0], dx[1], dx[2],
                                    dy[0], dy[1], dy[2], c.pair("blur", 0), c.pair("fill", 0)});
    };
    set_with_differences(c, lookup(f.at), lookup(e.add(f.at, f.dx)), lookup(e.add(f.at, f.dy)));
}

// Where the light is that the point is asked about: the light shader's own, inside illuminate or
// solar, or that of the turn of illuminance. Outside of both there is none.
bool light_position(LowerCall& c, const V3& P, V3& position) {
    auto& e = c.low;
    auto& b = c.b;
    constexpr float kFarAway = 1e15f;  // lengths of a direction that comes from nowhere
    V3 L = e.read_global(Global::L).v3();
    if (e.kind() == ShaderKind::Light) {
        V3 Ps = e.read_global(Global::Ps).v3();
        position = e.in_solar ? e.fma(e.normalize(L), e.f(-kFarAway), Ps) : e.sub(Ps, L);
        return true;
    }
    if (e.current_record == jit::kNone) return false;
    Value kind = e.record_uniform(e.current_set, e.current_record, kLightKind, jit::Type::I);
    Value solar = b.op(jit::Op::IEq, kind, b.i(kLightSolar));
    position = e.fma(L, b.select(solar, e.f(kFarAway), e.f(1)), P);
    return true;
}

void trace_shadow(LowerCall& c) {
    auto& e = c.low;
    V3 P = footprint(c).at, to;
    if (!light_position(c, P, to)) return;
    auto seed = e.sample_seed(c.call.site);
    std::vector<Value> through =
        e.service(Service::transmission,
                  std::array{seed[0], seed[1], P[0], P[1], P[2], to[0], to[1], to[2],
                             c.pair("samples", 1), c.pair("blur", 0), c.pair("bias", -1)});
    for (Value& x : through) x = c.b.sub(e.f(1), x);
    if (c.result_type() == BaseType::Float)  // of coloured shadows the mean, as of occlusion()
        through[0] = c.b.mul(c.b.add(through[0], c.b.add(through[1], through[2])), e.f(1.0f / 3));
    set_texels(c, through);
}

// 0 lit, 1 in shadow.
void shadow(LowerCall& c) {
    c.report_unknown_pairs();
    auto& e = c.low;
    if (!e.options.want_Ci && e.kind() != ShaderKind::Light) return;
    if (is_scene(c)) return trace_shadow(c);
    Footprint f = footprint(c);
    V3 P = f.at;
    V3 dx = e.scale(f.dx, width(c, "swidth")), dy = e.scale(f.dy, width(c, "twidth"));
    set_texels(
        c, e.service(Service::shadow,
                     std::array{c.f(0), P[0], P[1], P[2], dx[0], dx[1], dx[2], dy[0], dy[1], dy[2],
                                c.pair("bias", -1), c.pair("blur", 0), c.pair("samples", 16)}));
}

// J. F. Blinn, Simulation of Wrinkled Surfaces, 1978: the surface P + h n has the normal
// dPds ^ dPdt + h_s (n ^ dPdt) + h_t (dPds ^ n). Slopes are differences over the footprint. Here
// n |dPds ^ dPdt| is the first term: the N given is bent, not the face's.
void bump(LowerCall& c) {
    c.report_unknown_pairs();
    auto& e = c.low;
    auto& b = c.b;
    V3 N = c.v3(1), along_s = c.v3(2), along_t = c.v3(3);
    bool placed = c.args.size() == 6;
    Lookup at = with_derivatives(c, placed ? c.f(4) : e.read_global(Global::s).c[0],
                                 placed ? c.f(5) : e.read_global(Global::t).c[0]);
    Value least = e.f(1.0f / 1024);  // a texel of a large map
    Value ds = b.max(b.add(b.abs(at.dsdx), b.abs(at.dsdy)), least);
    Value dt = b.max(b.add(b.abs(at.dtdx), b.abs(at.dtdy)), least);
    auto height = [&](float s, float t) {
        Lookup beside = {b.fma(ds, e.f(s), at.s), b.fma(dt, e.f(t), at.t), ds, e.f(0), e.f(0), dt};
        return look_up(c, beside, c.pair("blur", 0), e.f(1), e.f(1))[0];
    };
    Value slope_s = e.div(b.sub(height(0.5f, 0), height(-0.5f, 0)), ds);
    Value slope_t = e.div(b.sub(height(0, 0.5f), height(0, -0.5f)), dt);
    V3 n = e.normalize(N), flat = e.cross(along_s, along_t);
    Value behind = b.lt(e.dot(flat, N), e.f(0));
    Value side = b.select(behind, e.f(-1), e.f(1));
    V3 terms = e.fma(e.cross(n, along_t), slope_s, e.scale(e.cross(along_s, n), slope_t));
    V3 bent = e.fma(terms, side, e.scale(n, e.length(flat)));
    V3 result = e.scale(e.normalize(bent), e.length(N));
    c.set(e.select(b.eq(e.dot(bent, bent), e.f(0)), N, result));
}

// bake(file, s, t, value): a point file of points (s, t, 0), with one channel. A negative scale
// says that they are no places in current space.
void bake(LowerCall& c) {
    auto& e = c.low;
    auto& b = c.b;
    if (!e.options.want_Ci) return;
    e.out.uses_rng = true;
    const Lowered& value = c.args[3];
    Lookup at = with_derivatives(c, c.f(1), c.f(2));
    Value across =
        b.max(b.add(b.abs(at.dsdx), b.abs(at.dsdy)), b.add(b.abs(at.dtdx), b.abs(at.dtdy)));
    Value radius = b.max(b.mul(across, e.f(0.5f)), e.f(1e-6f));
    std::vector<Value> args = {c.f(0), b.i(intern(std::string(type_name(value.type)) + " value")),
                               e.scalar_input("rng", jit::Type::I, jit::Rate::Point)};
    args.insert(args.end(), {at.s, at.t, e.f(0), e.f(0), e.f(0), e.f(0), radius, e.f(-1)});
    args.insert(args.end(), value.c.begin(), value.c.begin() + value.size());
    args.resize(11 + size_t(kPointFloats), e.f(0));
    e.service(Service::bake3d, args);
}

// textureinfo(name, field, variable): 1, and the variable set, if the fact is known and fits.
void textureinfo(LowerCall& c) {
    auto& e = c.low;
    auto& b = c.b;
    std::vector<Value> answer = e.service(Service::textureinfo, std::array{c.f(0), c.f(1)});
    const Expr& variable = *c.call.args[2];
    BaseType type = variable.type.base;
    size_t each = size_t(component_count(type));
    bool array = variable.type.is_array();
    std::vector<Lowered> values =
        array ? e.array_values(variable) : std::vector<Lowered>{c.args[2]};
    Value known = type == BaseType::String ? b.op(jit::Op::IEq, answer[0], b.i(-1))
                                           : b.op(jit::Op::ILt, b.i(int(each) - 1), answer[0]);
    for (size_t k = 0; k < values.size() && (k + 1) * each < answer.size(); ++k) {
        Value here = b.op(jit::Op::ILt, b.i(int((k + 1) * each) - 1), answer[0]);
        if (type == BaseType::String) here = k == 0 ? known : b.m(false);
        for (size_t i = 0; i < each; ++i) {
            Value x = answer[1 + k * each + i];
            if (type == BaseType::String) x = b.bits(x);
            values[k].c[i] = b.select(here, x, values[k].c[i]);
        }
    }
    if (array)
        e.set_array(variable, values);
    else
        c.set_output(2, values[0]);
    c.set(e.flag(known));
}

}  // namespace lower_texture

namespace {

namespace lower = lower_texture;

constexpr const char* kAnyVariable =
    "f=ssF f=ssC f=ssP f=ssV f=ssN f=ssM f=ssS f=ssF[] f=ssC[] f=ssP[] f=ssV[] f=ssN[] f=ssM[] "
    "f=ssS[]";

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
    {"environment", "f=sv~ c=sv~ f=svvvv~ c=svvvv~", lower::environment,
     KINORA_RSL_REF(ref::environment), kService | kNamesFile | kDerivative, 0,
     "Environment map (latitude-longitude or six faces) in a direction, or by a ray from P where "
     "the map is \"raytrace\"; \"blur\" \"width\" \"fill\"."},
    {"shadow", "f=sp~ c=sp~ f=spppp~ c=spppp~", lower::shadow, KINORA_RSL_REF(ref::shadow),
     kService | kNamesFile | kShadows | kVaryingResult, 0,
     "Share of shadow at a point, by a depth map, or by rays to the light where the map is "
     "\"raytrace\"; \"bias\" \"blur\" \"samples\" \"width\".",
     kSurface | kLight},
    {"bump", "n=snvv~ n=snvvff~", lower::bump, KINORA_RSL_REF(ref::bump),
     kService | kNamesFile | kDerivative, 0,
     "N bent by a map of heights: bump(name, N, dPds, dPdt [, s, t]).", kSurface | kDisplacement,
     "s t"},
    {"textureinfo", kAnyVariable, lower::textureinfo, KINORA_RSL_REF(ref::textureinfo),
     kService | kNamesFile, 0,
     "A fact about a texture, 1 if known: resolution channels type exists viewingmatrix "
     "projectionmatrix."},
    {"bake", "x=sfff x=sffc x=sffp x=sffv x=sffn", lower::bake, KINORA_RSL_REF(ref::bake),
     kService | kNamesFile | kPrints | kDerivative, 0,
     "Puts a value at s, t into a point file, as channel \"value\" of the world's (s, t, 0).",
     kSurface | kDisplacement},
};

}  // namespace

std::span<const Builtin> builtins_texture() {
    return kRows;
}

}  // namespace kinora::rsl
