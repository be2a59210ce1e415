// rsl/builtins/sampling.cpp: what integrators ask of lights with sample methods, and what those ask
// and answer. Our own headers call these (integrators.h, lightsamples.h); maps are for any light.
#include <fmt/format.h>

#include "rsl/builtins/table.h"
#include "rsl/lower/builtin_call.h"
#include "rsl/model/heuristics.h"
#include "rsl/reference/reference_p.h"
#include "rsl/reference/service_calls_p.h"

namespace kinora::rsl {

namespace lower_sampling {

// ---- surfaces

void lightdensity(LowerCall& c) {
    if (!c.lights.any_current()) return;
    auto [set, record] = c.lights.current();
    Value sampled = record_uniform(c.b, set, record, kLightSampled, jit::Type::I);
    Value density = record_field(c.b, set, record, kLightDensity);
    c.set(c.b.select(c.b.op(jit::Op::IEq, sampled, c.b.i(0)), c.b.f(-1), density));
}

void lightbare(LowerCall& c) {
    if (!c.lights.any_current()) return;
    c.context.out.reads_bare_light = true;
    auto [set, record] = c.lights.current();
    c.set(record_triple(c.b, set, record, kLightBare));
}

void samplinglights(LowerCall& c) {
    if (!c.context.options.want_Ci) return c.set(c.b.f(-1));
    V3 P = c.globals.read(Global::P).v3(), D = c.v3(0);
    c.context.out.lit_by_samples = true;
    c.set(c.b.itof(c.services.call(Service::samplinglights, std::array{P[0], P[1], P[2], D[0], D[1],
                                                                       D[2], c.f(1), c.f(2)})[0]));
}

// As trace(P, D, "maxdist", x), with what the surface has by directlighting().
void tracesample(LowerCall& c) {
    if (!c.context.options.want_Ci) return;
    auto& b = c.b;
    V3 P = c.globals.read(Global::P).v3(), D = c.v3(0);
    auto seed = c.seeds.sample(c.call.site);
    Value counted = b.select(b.eq(c.f(2), b.f(0)), b.i(0), b.i(1));
    auto seen = c.services.call(
        Service::trace, std::array{seed[0], seed[1], P[0], P[1], P[2], D[0], D[1], D[2], c.f(1),
                                   b.f(-1), c.f(3), b.f(0), b.i(0), c.f(4), b.f(-1), counted});
    c.set(V3{seen[0], seen[1], seen[2]});
}

void misheuristic(LowerCall& c) {
    auto& b = c.b;
    Value name = c.args[0].c[0], power = b.f(kHeuristics[0].power), known = b.m(false);
    for (const Heuristic& row : kHeuristics) {
        Value is = b.op(jit::Op::IEq, name, b.i(intern(row.name)));
        power = b.select(is, b.f(row.power), power);
        known = b.logical_or(known, is);
    }
    b.fault(b.fault_site(c.where(), "no heuristic has that name: veachpower2 is taken"),
            b.and_not(c.e.running, known));
    c.set(power);
}

void samplingdomain(LowerCall& c) {
    if (const std::string* name = c.text(0)) c.context.out.light_domain = *name;
    c.set(c.b.f(0));
}

// ---- lights

std::vector<Value> wish(LowerCall& c) {
    c.context.out.uses_rng = true;
    return c.services.call(Service::samplewish, std::array{rng_input(c.b)});
}
void samplewish(LowerCall& c) {
    c.set(c.b.itof(wish(c)[0]));
}
void samplewishdirection(LowerCall& c) {
    std::vector<Value> asked = wish(c);
    c.set(V3{asked[1], asked[2], asked[3]});
}
void samplewishdomain(LowerCall& c) {
    c.set(wish(c)[4]);
}

// ---- maps

void mapdirection(LowerCall& c) {
    std::vector<Value> found =
        c.services.call(Service::mapdirection, std::array{c.f(0), c.f(1), c.f(2)});
    c.set_output(3, lowered(BaseType::Float, found[3]));
    c.set(V3{found[0], found[1], found[2]});
}
std::vector<Value> along_map(LowerCall& c, Service service) {
    V3 D = c.v3(1);
    return c.services.call(service, std::array{c.f(0), D[0], D[1], D[2]});
}
void mapdensity(LowerCall& c) {
    c.set(along_map(c, Service::mapdensity)[0]);
}
void maplight(LowerCall& c) {
    std::vector<Value> light = along_map(c, Service::maplight);
    c.set(V3{light[0], light[1], light[2]});
}

void lightsample(LowerCall& c) {
    V3 D = c.v3(0), Cl = c.v3(2);
    c.services.call(Service::lightsample,
                    std::array{D[0], D[1], D[2], c.f(1), Cl[0], Cl[1], Cl[2], c.f(3), c.f(4)});
    c.set(c.b.f(0));
}

}  // namespace lower_sampling

namespace ref {
namespace {

template <class Real>
void lightdensity(RefCall<Real>& c) {
    if (const ReferenceLight* light = c.eval.light)
        c.set(Dual<Real>(Real(light->sampled ? light->density : -1)));
}
template <class Real>
void lightbare(RefCall<Real>& c) {
    if (const ReferenceLight* light = c.eval.light)
        for (size_t k = 0; k < 3; ++k) c.result.c[k] = Dual<Real>(Real(light->bare[k]));
}
template <class Real>
void samplinglights(RefCall<Real>& c) {
    std::vector<double> args;
    add(args, c.eval.kernel_value(Global::P));
    for (size_t k = 0; k < 3; ++k) add(args, c.args[k]);
    set_from(c, c.eval.service(Service::samplinglights, args));
}
template <class Real>
void tracesample(RefCall<Real>& c) {
    std::vector<double> args = {0, 0};
    add(args, c.eval.kernel_value(Global::P));
    add(args, c.args[0]);
    add(args, c.args[1]);
    args.push_back(-1);
    add(args, c.args[3]);
    for (double x : {0.0, 0.0}) args.push_back(x);
    add(args, c.args[4]);
    for (double x : {-1.0, double(c.args[2].c[0].x != 0)}) args.push_back(x);
    set_from(c, c.eval.service(Service::trace, args));
}
template <class Real>
void misheuristic(RefCall<Real>& c) {
    float power = 0;
    for (const Heuristic& row : kHeuristics)
        if (c.args[0].text() == row.name) power = row.power;
    c.eval.result.faults += power == 0;
    c.set(Dual<Real>(Real(power == 0 ? kHeuristics[0].power : power)));
}
template <class Real>
void samplingdomain(RefCall<Real>& c) {
    c.set(Dual<Real>(Real(0)));
}
template <class Real>
void samplewish(RefCall<Real>& c) {
    set_from(c, c.eval.service(Service::samplewish, {0}));
}
template <class Real>
void samplewishdirection(RefCall<Real>& c) {
    set_from(c, c.eval.service(Service::samplewish, {0}), 1);
}
template <class Real>
void samplewishdomain(RefCall<Real>& c) {
    set_from(c, c.eval.service(Service::samplewish, {0}), 4);
}
template <class Real>
void mapdirection(RefCall<Real>& c) {
    std::vector<double> args;
    for (size_t k = 0; k < 3; ++k) add(args, c.args[k]);
    const std::vector<double> found = c.eval.service(Service::mapdirection, args);
    c.args[3].c[0] = Dual<Real>(Real(at(found, 3)));
    set_from(c, found);
}
template <class Real>
std::vector<double> along_map(RefCall<Real>& c, Service service) {
    std::vector<double> args;
    for (size_t k = 0; k < 2; ++k) add(args, c.args[k]);
    return c.eval.service(service, args);
}
template <class Real>
void mapdensity(RefCall<Real>& c) {
    set_from(c, along_map(c, Service::mapdensity));
}
template <class Real>
void maplight(RefCall<Real>& c) {
    set_from(c, along_map(c, Service::maplight));
}
template <class Real>
void lightsample(RefCall<Real>& c) {
    std::vector<double> args;
    for (size_t k = 0; k < c.args.size(); ++k) add(args, c.args[k]);
    set_from(c, c.eval.service(Service::lightsample, args));
}

}  // namespace
}  // namespace ref

namespace {

namespace lower = lower_sampling;

const Builtin kRows[] = {
    {"lightdensity", "f=", lower::lightdensity, KINORA_RSL_REF(ref::lightdensity),
     kMessage | kVaryingResult | kForHeaders, 0,
     "In illuminance: how dense the light's samples are about L, by solid angle; -1 where the "
     "light has no sample methods.",
     kSurface},
    {"lightbare", "c=", lower::lightbare, KINORA_RSL_REF(ref::lightbare),
     kMessage | kVaryingResult | kForHeaders, 0,
     "In illuminance: Cl before the renderer's shadow rays.", kSurface},
    {"samplinglights", "f=vff", lower::samplinglights, KINORA_RSL_REF(ref::samplinglights),
     kService | kTraces | kVaryingResult | kForHeaders, 0,
     "What lights with sample methods send from a direction, for illuminance: samplinglights("
     "direction, density, power).",
     kSurface},
    {"tracesample", "c=vffff", lower::tracesample, KINORA_RSL_REF(ref::tracesample),
     kService | kTraces | kVaryingResult | kForHeaders, 0,
     "What a ray from P sees: tracesample(direction, maxdist, counted, samples); counted: "
     "directlighting() gives the specular light of the lights; samples: this one is one of so "
     "many.",
     kSurface | kVolume},
    {"misheuristic", "f=s", lower::misheuristic, KINORA_RSL_REF(ref::misheuristic), kForHeaders, 0,
     "The power of a heuristic."},
    {"samplingdomain", "f=s", lower::samplingdomain, KINORA_RSL_REF(ref::samplingdomain),
     kForHeaders, 0, "Says which directions a surface's lights are asked for.", kSurface},
    {"samplewish", "f=", lower::samplewish, KINORA_RSL_REF(ref::samplewish), kService | kForHeaders,
     0, "What a light with sample methods is asked: 0 samples, 1 a value."},
    {"samplewishdirection", "v=", lower::samplewishdirection,
     KINORA_RSL_REF(ref::samplewishdirection), kService | kVaryingResult | kForHeaders, 0,
     "The direction that it is asked for."},
    {"samplewishdomain", "s=", lower::samplewishdomain, KINORA_RSL_REF(ref::samplewishdomain),
     kService | kForHeaders, 0, "The integration domain: hemisphere or sphere."},
    {"mapdirection", "v=sffF", lower::mapdirection, KINORA_RSL_REF(ref::mapdirection),
     kService | kNamesFile, 0,
     "Two numbers in [0, 1) to a direction as dense as an environment map is bright, in the map's "
     "space: mapdirection(map, x, y, density). The density is by solid angle, 0 where the map is "
     "black. A map \"\" is white."},
    {"mapdensity", "f=sv", lower::mapdensity, KINORA_RSL_REF(ref::mapdensity),
     kService | kNamesFile, 0, "How dense mapdirection() is about a direction in the map's space."},
    {"maplight", "c=sv", lower::maplight, KINORA_RSL_REF(ref::maplight), kService | kNamesFile, 0,
     "Light of an environment map along a direction in the map's space, between its four nearest "
     "texels. A map \"\" is white; texels that are no numbers, or below 0, send nothing."},
    {"lightsample", "f=vfcff", lower::lightsample, KINORA_RSL_REF(ref::lightsample),
     kService | kPrints | kSendsSamples | kForHeaders, 0,
     "One sample of a light: lightsample(direction, distance, radiance, pdf, count)."},
};

}  // namespace

std::span<const Builtin> builtins_sampling() {
    return kRows;
}

}  // namespace kinora::rsl
