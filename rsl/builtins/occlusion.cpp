// rsl/builtins/occlusion.cpp: light and shadow from all around a point, by rays.
#include "rsl/builtins/source_p.h"
#include "rsl/builtins/table.h"
#include "rsl/lower/builtin_call.h"
#include "rsl/reference/reference_p.h"
#include "rsl/reference/service_calls_p.h"

namespace kinora::rsl {

namespace lower_occlusion {

constexpr float kFar = 1e30f;

// In an opacity kernel nothing is traced (docs/decisions.md#opacity).
bool traces(LowerCall& c) {
    return c.context.options.want_Ci;
}

// Half the hemisphere's angle unless "coneangle" narrows it; radians, from the axis.
Value cone(LowerCall& c) {
    return c.pair("coneangle", 1.5707963268f);
}

// The variable of an output pair, from three numbers.
void set_pair(LowerCall& c, std::string_view name, const Value* triple) {
    if (LValue* variable = c.output_pair(name))
        c.variables.store(*variable, lowered(variable->type, V3{triple[0], triple[1], triple[2]}));
}

// A form that begins with maps asks for what the rays know better: the maps are not read.
void occlusion(LowerCall& c) {
    c.report_unknown_pairs();
    if (!traces(c)) return;
    int first = c.args.size() == 4 ? 1 : 0;
    V3 P = c.v3(first), N = c.v3(first + 1);
    auto seed = c.seeds.sample(c.call.site);
    std::vector<Value> answer = c.services.call(
        Service::occlusion,
        std::array{seed[0], seed[1], P[0], P[1], P[2], N[0], N[1], N[2], c.f(first + 2), cone(c),
                   c.pair("maxdist", kFar), c.pair("bias", -1), c.pair("falloff", 0),
                   c.pair("falloffmode", 0), c.text_pair("environmentmap")});
    c.set(answer[0]);
    set_pair(c, "environmentdir", &answer[1]);
    set_pair(c, "environmentcolor", &answer[4]);
}

// indirectdiffuse(P, N, samples), or (map, N) with or without samples: the map's light alone, at P.
constexpr float kMapSamples = 64;  // which cost no ray
void indirectdiffuse(LowerCall& c) {
    c.report_unknown_pairs();
    if (!traces(c)) return;
    bool of_map = c.args[0].type == BaseType::String;
    V3 P = of_map ? c.globals.read(Global::P).v3() : c.v3(0), N = c.v3(1);
    auto seed = c.seeds.sample(c.call.site);
    Value samples = c.args.size() > 2 ? c.f(2) : c.b.f(kMapSamples);
    // Nothing is as near as 0: every ray then asks the map.
    Value far = of_map ? c.b.f(0) : c.pair("maxdist", kFar);
    Value map = of_map ? c.args[0].c[0] : c.text_pair("environmentmap");
    std::vector<Value> light = c.services.call(
        Service::indirectdiffuse, std::array{seed[0], seed[1], P[0], P[1], P[2], N[0], N[1], N[2],
                                             samples, cone(c), far, c.pair("bias", -1), map});
    c.set(V3{light[0], light[1], light[2]});
    set_pair(c, "environmentcolor", &light[3]);
    if (LValue* blocked = c.output_pair("occlusion"))
        c.variables.store(*blocked, lowered(BaseType::Float, light[6]));
}

// areashadow(map, P, three corners of the light): the share that the source's parallelogram is
// hidden, by rays.
void areashadow(LowerCall& c) {
    c.report_unknown_pairs();
    if (!traces(c)) return;
    auto& e = c.e;
    V3 corner = c.v3(2);
    lower_source::Source source{corner, e.sub(c.v3(3), corner), e.sub(c.v3(4), corner)};
    constexpr int kSide = 4;
    V3 hidden = lower_source::hidden_share(c, c.v3(1), source, kSide);
    if (c.result_type() == BaseType::Float)
        c.set(hidden[0]);
    else
        c.set(hidden);
}

}  // namespace lower_occlusion

namespace ref {
namespace {

template <class Real>
void occlusion(RefCall<Real>& c) {
    std::vector<double> args = seeded(c, c.args.size() == 4 ? 1 : 0, 3);
    for (double x :
         {pair(c, "coneangle", 1.5707963268), pair(c, "maxdist", 1e30), pair(c, "bias", -1),
          pair(c, "falloff", 0), pair(c, "falloffmode", 0), pair(c, "environmentmap", 0)})
        args.push_back(x);
    std::vector<double> answer = c.eval.service(Service::occlusion, args);
    set_from(c, answer);
    for (auto& [name, value] : c.pairs)
        for (auto [output, first] : {std::pair("environmentdir", 1), {"environmentcolor", 4}})
            for (size_t k = 0; k < 3 && name == output; ++k)
                value.c[k] = Dual<Real>(Real(at(answer, size_t(first) + k)));
}

template <class Real>
void indirectdiffuse(RefCall<Real>& c) {
    bool of_map = c.args[0].type == BaseType::String;
    std::vector<double> args = {0, 0};
    add(args, of_map ? c.eval.global(Global::P) : c.args[0]);
    add(args, c.args[1]);
    args.push_back(c.args.size() > 2 ? double(c.f(2).x) : 64);
    for (double x :
         {pair(c, "coneangle", 1.5707963268), of_map ? 0 : pair(c, "maxdist", 1e30),
          pair(c, "bias", -1), of_map ? double(c.args[0].c[0].x) : pair(c, "environmentmap", 0)})
        args.push_back(x);
    std::vector<double> answer = c.eval.service(Service::indirectdiffuse, args);
    set_from(c, answer);
    for (auto& [name, value] : c.pairs)
        if (name == "occlusion")
            value.c[0] = Dual<Real>(Real(at(answer, 6)));
        else
            for (size_t k = 0; k < 3 && name == "environmentcolor"; ++k)
                value.c[k] = Dual<Real>(Real(at(answer, 3 + k)));
}

// By the middle of the light alone: what lies between is the renderer's random choice.
template <class Real>
void areashadow(RefCall<Real>& c) {
    std::vector<double> args = seeded(c, 1, 1);
    for (size_t k = 0; k < 3; ++k)
        args.push_back(0.5 * double(c.args[3].c[k].x + c.args[4].c[k].x));
    for (double x : {1.0, 0.0, pair(c, "bias", -1)}) args.push_back(x);
    std::vector<double> through = c.eval.service(Service::transmission, args);
    for (double& x : through) x = 1 - x;
    set_from(c, through);
}

}  // namespace
}  // namespace ref

namespace {

namespace lower = lower_occlusion;

constexpr uint32_t kRays = kService | kTraces | kVaryingResult;

const Builtin kRows[] = {
    {"occlusion", "f=pnf~ f=spnf~", lower::occlusion, KINORA_RSL_REF(ref::occlusion), kRays, 0,
     "Share of the hemisphere over N that is blocked, by cosine; \"maxdist\", \"coneangle\", "
     "\"bias\", \"falloff\", \"falloffmode\", \"environmentdir\".",
     kSurface | kLight},
    {"indirectdiffuse", "c=pnf~", lower::indirectdiffuse, KINORA_RSL_REF(ref::indirectdiffuse),
     kRays, 0,
     "Mean light from other surfaces over the hemisphere of N, by cosine; \"maxdist\", "
     "\"coneangle\", \"bias\", \"environmentmap\", \"occlusion\".",
     kSurface | kLight},
    {"indirectdiffuse", "c=snf~ c=sn~", lower::indirectdiffuse,
     KINORA_RSL_REF(ref::indirectdiffuse), kRays, 0,
     "Mean light of an environment map over the hemisphere of N, by cosine.", kSurface | kLight,
     "P"},
    {"areashadow", "f=spppp~ c=spppp~", lower::areashadow, KINORA_RSL_REF(ref::areashadow),
     kRays | kShadows, 0,
     "Share of a parallelogram of light (a corner and its two neighbours) hidden from P, by rays.",
     kSurface | kLight},
};

}  // namespace

std::span<const Builtin> builtins_occlusion() {
    return kRows;
}

}  // namespace kinora::rsl
