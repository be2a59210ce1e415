// rsl/builtins/environment.cpp: environment maps and shadow maps.
#include <algorithm>
#include <cmath>

#include "rsl/builtins/maps_p.h"
#include "rsl/builtins/source_p.h"
#include "rsl/builtins/table.h"
#include "rsl/lower/builtin_call.h"
#include "rsl/model/pairs.h"
#include "rsl/reference/reference_p.h"

namespace kinora::rsl {

namespace lower_environment {

using namespace lower_maps;

// A point or direction and how it changes across the shading point; of four, their middle.
struct Footprint {
    V3 at, dx, dy;
};
Footprint footprint(LowerCall& c) {
    auto& e = c.e;
    if (c.args.size() == 5)
        return {e.scale(e.add(e.add(c.v3(1), c.v3(2)), e.add(c.v3(3), c.v3(4))), e.f(0.25f)),
                e.scale(e.add(e.sub(c.v3(2), c.v3(1)), e.sub(c.v3(4), c.v3(3))), e.f(0.5f)),
                e.scale(e.add(e.sub(c.v3(3), c.v3(1)), e.sub(c.v3(4), c.v3(2))), e.f(0.5f))};
    V3 at = c.v3(1);
    return {at, e.scale(e.du(at), c.globals.read(Global::du).c[0]),
            e.scale(e.dv(at), c.globals.read(Global::dv).c[0])};
}

// The customary names of a map that is no file but the scene itself, asked by rays.
bool is_scene(LowerCall& c) {
    const std::string* name = c.e.constant_text(c.f(0));
    return name && (*name == "raytrace" || *name == "reflection");
}

// What a ray from P sees in the direction; "blur" opens its cone.
void trace_environment(LowerCall& c) {
    if (!c.context.options.want_Ci) return;
    V3 P = c.globals.read(Global::P).v3(), R = footprint(c).at;
    auto seed = c.seeds.sample(c.call.site);
    set_texels(c, c.services.call(
                      Service::trace,
                      std::array{seed[0], seed[1], P[0], P[1], P[2], R[0], R[1], R[2],
                                 c.pair("maxdist", 1e30f), c.pair("bias", -1), c.pair("samples", 1),
                                 c.pair("blur", 0), c.b.i(0), c.b.f(-1), c.b.f(-1), c.b.i(0)}));
}

// The footprint's sides are those along u and v: maps of directions and depths have no s and t.
void environment(LowerCall& c) {
    c.report_unknown_pairs();
    auto& e = c.e;
    if (is_scene(c)) return trace_environment(c);
    Footprint f = footprint(c);
    V3 dx = e.scale(f.dx, width(c, "swidth")), dy = e.scale(f.dy, width(c, "twidth"));
    auto lookup = [&](const V3& R) {
        return c.services.call(
            Service::environment,
            std::array{c.f(0), channel(c), R[0], R[1], R[2], dx[0], dx[1], dx[2], dy[0], dy[1],
                       dy[2], c.pair("blur", 0), c.pair("fill", 0)});
    };
    set_with_differences(c, lookup(f.at), lookup(e.add(f.at, f.dx)), lookup(e.add(f.at, f.dy)));
}

// Where the light is that the point is asked about: the light shader's own, inside illuminate or
// solar, or that of the turn of illuminance. Outside of both there is none.
bool light_position(LowerCall& c, const V3& P, V3& position) {
    auto& e = c.e;
    auto& b = c.b;
    constexpr float kFarAway = 1e15f;  // lengths of a direction that comes from nowhere
    V3 L = c.globals.read(Global::L).v3();
    if (c.context.kind() == ShaderKind::Light) {
        V3 Ps = c.globals.read(Global::Ps).v3();
        position =
            c.light_shader.in_solar() ? e.fma(e.normalize(L), e.f(-kFarAway), Ps) : e.sub(Ps, L);
        return true;
    }
    if (!c.lights.any_current()) return false;
    Value kind = record_uniform(c.b, c.lights.current().set, c.lights.current().record, kLightKind,
                                jit::Type::I);
    Value solar = b.op(jit::Op::IEq, kind, b.i(kLightSolar));
    position = e.fma(L, b.select(solar, e.f(kFarAway), e.f(1)), P);
    return true;
}

// Of coloured shadows as one number, as occlusion() has it.
Value mean(LowerCall& c, const V3& x) {
    return c.b.mul(c.b.add(x[0], c.b.add(x[1], x[2])), c.e.f(1.0f / 3));
}

void trace_shadow(LowerCall& c) {
    auto& e = c.e;
    V3 P = footprint(c).at, to;
    if (!light_position(c, P, to)) return;
    auto seed = c.seeds.sample(c.call.site);
    std::vector<Value> through =
        c.services.call(Service::transmission,
                        std::array{seed[0], seed[1], P[0], P[1], P[2], to[0], to[1], to[2],
                                   c.pair("samples", 1), c.pair("blur", 0), c.pair("bias", -1)});
    for (Value& x : through) x = c.b.sub(e.f(1), x);
    if (c.result_type() == BaseType::Float)
        through[0] = mean(c, {through[0], through[1], through[2]});
    set_texels(c, through);
}

// A few rays for each sample that the shader wants, in a square.
int side_of_samples(LowerCall& c) {
    constexpr float kMost = 8;
    float samples;
    if (!c.b.constant_f(c.pair("samples", 16), &samples)) return 4;
    return int(std::clamp(std::ceil(std::sqrt(samples)), 1.0f, kMost));
}

// "source", p1, p2, p3, p4: the share of that quadrilateral that is hidden, by rays whatever the
// map, as of areashadow(). The corners come in rows, or around: whichever is less crooked.
void source_shadow(LowerCall& c, std::span<Expr* const> corners) {
    auto& e = c.e;
    V3 p[4];
    for (size_t k = 0; k < 4; ++k) p[k] = c.tree.expr(*corners[k]).v3();
    auto twist_of = [&](const V3& opposite, const V3& beside) {
        return e.sub(e.add(p[0], opposite), e.add(p[1], beside));
    };
    V3 in_rows = twist_of(p[3], p[2]), around = twist_of(p[2], p[3]);
    Value rows = c.b.le(e.dot(in_rows, in_rows), e.dot(around, around));
    V3 twist = e.select(rows, in_rows, around), up = e.sub(e.select(rows, p[2], p[3]), p[0]);
    V3 hidden = lower_source::hidden_share(
        c, footprint(c).at, {p[0], e.sub(p[1], p[0]), up, &twist}, side_of_samples(c));
    if (c.result_type() == BaseType::Float)
        c.set(mean(c, hidden));
    else
        c.set(hidden);
}

// 0 lit, 1 in shadow.
void shadow(LowerCall& c) {
    c.report_unknown_pairs();
    auto& e = c.e;
    if (!c.context.options.want_Ci && c.context.kind() != ShaderKind::Light) return;
    if (std::span<Expr* const> corners = source_corners(c.call); !corners.empty())
        return source_shadow(c, corners);
    if (is_scene(c)) return trace_shadow(c);
    Footprint f = footprint(c);
    V3 P = f.at;
    V3 dx = e.scale(f.dx, width(c, "swidth")), dy = e.scale(f.dy, width(c, "twidth"));
    set_texels(c, c.services.call(
                      Service::shadow,
                      std::array{c.f(0), P[0], P[1], P[2], dx[0], dx[1], dx[2], dy[0], dy[1], dy[2],
                                 c.pair("bias", -1), c.pair("blur", 0), c.pair("samples", 16)}));
}

}  // namespace lower_environment

namespace ref {
namespace {

// The point or direction of a map, or the middle of four.
template <class Real>
Vec<Real> middle(RefCall<Real>& c) {
    if (c.args.size() != 5) return c.v(1);
    return Dual<Real>(Real(0.25)) * ((c.v(1) + c.v(2)) + (c.v(3) + c.v(4)));
}

template <class Real>
bool is_scene(RefCall<Real>& c) {
    return c.text(0) == "raytrace" || c.text(0) == "reflection";
}

template <class Real>
void add_triple(std::vector<double>& args, const Vec<Real>& v) {
    for (auto& x : v) args.push_back(double(x.x));
}

template <class Real>
void environment(RefCall<Real>& c) {
    if (is_scene(c)) {  // the seed is not the reference's to know
        std::vector<double> args = {0, 0};
        add_triple(args, vec(c.eval.global(Global::P)));
        add_triple(args, middle(c));
        for (double x :
             {double(c.pair("maxdist", Real(1e30)).x), double(c.pair("bias", -1).x),
              double(c.pair("samples", 1).x), double(c.pair("blur", 0).x), 0.0, -1.0, -1.0, 0.0})
            args.push_back(x);
        return set_from(c, c.eval.service(Service::trace, args));
    }
    double channel = c.call.channel ? double(c.eval.expr(*c.call.channel).c[0].x) : 0;
    Real du = c.eval.global(Global::du).c[0].x, dv = c.eval.global(Global::dv).c[0].x;
    bool corners = c.args.size() == 5;
    auto component = [&](size_t k, Real x, Real y) {
        Dual<Real> at = middle(c)[k];
        if (!corners) return at.x + (at.u * du) * x + (at.v * dv) * y;
        Real p = c.v(1)[k].x, q = c.v(2)[k].x, r = c.v(3)[k].x, s = c.v(4)[k].x;
        return at.x + Real(0.5) * ((q - p) + (s - r)) * x + Real(0.5) * ((r - p) + (s - q)) * y;
    };
    from_map(c, [&](Real x, Real y) {
        return c.eval.service(Service::environment,
                              {double(c.f(0).x), channel, double(component(0, x, y)),
                               double(component(1, x, y)), double(component(2, x, y))});
    });
}

// By rays to the light of this turn of illuminance, or of this light shader.
template <class Real>
void trace_shadow(RefCall<Real>& c) {
    Vec<Real> p = middle(c), L = vec(c.eval.global(Global::L)), to;
    Dual<Real> far(Real(1e15));
    if (c.eval.layer->shader->kind == ShaderKind::Light) {
        Vec<Real> Ps = vec(c.eval.global(Global::Ps));
        to = c.eval.in_solar ? Ps - far * rsl::normalize(L) : Ps - L;
    } else {
        if (!c.eval.light) return;
        to = c.eval.light->kind == kLightSolar ? p + far * L : p + L;
    }
    std::vector<double> args = {0, 0};
    add_triple(args, p);
    add_triple(args, to);
    args.push_back(double(c.pair("samples", 1).x));
    args.push_back(double(c.pair("blur", 0).x));
    args.push_back(double(c.pair("bias", -1).x));
    std::vector<double> through = c.eval.service(Service::transmission, args);
    for (double& x : through) x = 1 - x;
    if (c.result.type == BaseType::Float && through.size() == 3)
        through = {(through[0] + through[1] + through[2]) / 3};
    set_from(c, through);
}

// By the middle of the source alone: what lies between is the renderer's random choice.
template <class Real>
void source_shadow(RefCall<Real>& c, std::span<Expr* const> corners) {
    Vec<Real> sum{};
    for (const Expr* corner : corners) sum = sum + vec(c.eval.expr(*corner));
    std::vector<double> args = {0, 0};
    add_triple(args, middle(c));
    add_triple(args, Dual<Real>(Real(0.25)) * sum);
    for (double x : {1.0, 0.0, double(c.pair("bias", -1).x)}) args.push_back(x);
    std::vector<double> through = c.eval.service(Service::transmission, args);
    through.resize(3, 1);
    for (double& x : through) x = 1 - x;
    if (c.result.type == BaseType::Float) through[0] = (through[0] + through[1] + through[2]) / 3;
    set_from(c, through);
}

template <class Real>
void shadow(RefCall<Real>& c) {
    if (std::span<Expr* const> corners = source_corners(c.call); !corners.empty())
        return source_shadow(c, corners);
    if (is_scene(c)) return trace_shadow(c);
    Vec<Real> p = middle(c);
    set_from(c, c.eval.service(Service::shadow,
                               {double(c.f(0).x), double(p[0].x), double(p[1].x), double(p[2].x)}));
}

}  // namespace
}  // namespace ref

namespace {

namespace lower = lower_environment;

const Builtin kRows[] = {
    {"environment", "f=sv~ c=sv~ f=svvvv~ c=svvvv~", lower::environment,
     KINORA_RSL_REF(ref::environment), kService | kNamesFile | kDerivative, 0,
     "Environment map (latitude-longitude or six faces) in a direction, or by a ray from P where "
     "the map is \"raytrace\"; \"blur\" \"width\" \"fill\"."},
    {"shadow", "f=sp~ c=sp~ f=spppp~ c=spppp~", lower::shadow, KINORA_RSL_REF(ref::shadow),
     kService | kNamesFile | kShadows | kVaryingResult, 0,
     "Share of shadow at a point, by a depth map, or by rays to the light where the map is "
     "\"raytrace\". \"source\", p1, p2, p3, p4 are the corners of a light that rays sample, "
     "whatever the map; \"bias\" \"blur\" \"samples\" \"width\".",
     kSurface | kLight},
};

}  // namespace

std::span<const Builtin> builtins_environment() {
    return kRows;
}

}  // namespace kinora::rsl
