// rsl/builtins/rays.cpp: rows of the built-in table: ray tracing.
#include "rsl/builtins/table.h"
#include "rsl/lower/lower_p.h"
#include "rsl/reference/builtins.h"

namespace kinora::rsl {

namespace lower_rays {

constexpr float kFar = 1e30f;

// In an opacity kernel nothing is traced (docs/decisions.md#opacity).
bool traces(LowerCall& c) {
    return c.low.options.want_Ci;
}

// The samples of one call, as the services take them.
Value samples(LowerCall& c, float otherwise) {
    return c.pair("samples", otherwise);
}

void trace(LowerCall& c) {
    c.report_unknown_pairs();
    if (!traces(c)) return;
    V3 P = c.v3(0), R = c.v3(1);
    auto seed = c.low.sample_seed(c.call.site);
    std::vector<Value> hit = c.low.service(
        Service::trace, std::array{seed[0], seed[1], P[0], P[1], P[2], R[0], R[1], R[2],
                                   c.pair("maxdist", kFar), c.pair("bias", -1), samples(c, 1),
                                   c.pair("samplecone", 0), c.text_pair("label")});
    if (c.result_type() == BaseType::Float)
        c.set(hit[3]);
    else
        c.set(V3{hit[0], hit[1], hit[2]});
}

V3 let_through(LowerCall& c) {
    c.report_unknown_pairs();
    if (!traces(c)) return c.low.f3(1);
    V3 from = c.v3(0), to = c.v3(1);
    auto seed = c.low.sample_seed(c.call.site);
    std::vector<Value> share =
        c.low.service(Service::transmission,
                      std::array{seed[0], seed[1], from[0], from[1], from[2], to[0], to[1], to[2],
                                 samples(c, 1), c.pair("samplecone", 0), c.pair("bias", -1)});
    return {share[0], share[1], share[2]};
}
void transmission(LowerCall& c) {
    c.set(let_through(c));
}
void visibility(LowerCall& c) {
    V3 t = let_through(c);
    c.set(c.low.flag(c.b.lt(c.b.f(0), c.b.max(c.b.max(t[0], t[1]), t[2]))));
}

// Half the hemisphere's angle unless "coneangle" narrows it; radians, from the axis.
Value cone(LowerCall& c) {
    return c.pair("coneangle", 1.5707963268f);
}

// The variable of an output pair, from three numbers.
void set_pair(LowerCall& c, std::string_view name, const Value* triple) {
    if (Target* variable = c.output_pair(name))
        c.low.store(*variable, lowered(variable->type, V3{triple[0], triple[1], triple[2]}));
}

// A form that begins with maps asks for what the rays know better: the maps are not read.
void occlusion(LowerCall& c) {
    c.report_unknown_pairs();
    if (!traces(c)) return;
    int first = c.args.size() == 4 ? 1 : 0;
    V3 P = c.v3(first), N = c.v3(first + 1);
    auto seed = c.low.sample_seed(c.call.site);
    std::vector<Value> answer = c.low.service(
        Service::occlusion,
        std::array{seed[0], seed[1], P[0], P[1], P[2], N[0], N[1], N[2], c.f(first + 2), cone(c),
                   c.pair("maxdist", kFar), c.pair("bias", -1), c.pair("falloff", 0),
                   c.pair("falloffmode", 0), c.text_pair("environmentmap")});
    c.set(answer[0]);
    set_pair(c, "environmentdir", &answer[1]);
    set_pair(c, "environmentcolor", &answer[4]);
}

// indirectdiffuse(P, N, samples), or (map, N, samples): the map's light alone, at P.
void indirectdiffuse(LowerCall& c) {
    c.report_unknown_pairs();
    if (!traces(c)) return;
    bool of_map = c.args[0].type == BaseType::String;
    V3 P = of_map ? c.low.read_global(Global::P).v3() : c.v3(0), N = c.v3(1);
    auto seed = c.low.sample_seed(c.call.site);
    // Nothing is as near as 0: every ray then asks the map.
    Value far = of_map ? c.b.f(0) : c.pair("maxdist", kFar);
    Value map = of_map ? c.args[0].c[0] : c.text_pair("environmentmap");
    std::vector<Value> light = c.low.service(
        Service::indirectdiffuse, std::array{seed[0], seed[1], P[0], P[1], P[2], N[0], N[1], N[2],
                                             c.f(2), cone(c), far, c.pair("bias", -1), map});
    c.set(V3{light[0], light[1], light[2]});
    set_pair(c, "environmentcolor", &light[3]);
}

// areashadow(map, P, three corners of the light): the share that the source's parallelogram is
// hidden, by rays.
void areashadow(LowerCall& c) {
    c.report_unknown_pairs();
    if (!traces(c)) return;
    auto& e = c.low;
    V3 P = c.v3(1), corner = c.v3(2);
    V3 across = e.sub(c.v3(3), corner), up = e.sub(c.v3(4), corner);
    constexpr int kSide = 4;  // jittered cells of the source
    Value sum[3] = {e.f(0), e.f(0), e.f(0)};
    for (int k = 0; k < kSide * kSide; ++k) {
        auto offset = [&](int cell, int component) {
            Value jitter = e.random01(c.call, 2 * k + component);
            return e.mul(c.b.add(e.f(float(cell)), jitter), e.f(1.0f / kSide));
        };
        V3 Q = e.fma(across, offset(k % kSide, 0), e.fma(up, offset(k / kSide, 1), corner));
        auto seed = e.sample_seed(c.call.site + uint32_t(k) * 7919u);
        std::vector<Value> through = e.service(
            Service::transmission, std::array{seed[0], seed[1], P[0], P[1], P[2], Q[0], Q[1], Q[2],
                                              e.f(1), e.f(0), c.pair("bias", -1)});
        for (size_t i = 0; i < 3; ++i) sum[i] = c.b.add(sum[i], through[i]);
    }
    V3 hidden;
    for (size_t i = 0; i < 3; ++i) hidden[i] = e.fma(sum[i], e.f(-1.0f / (kSide * kSide)), e.f(1));
    if (c.result_type() == BaseType::Float)
        c.set(hidden[0]);
    else
        c.set(hidden);
}

}  // namespace lower_rays

namespace {

namespace lower = lower_rays;

constexpr uint32_t kRays = kService | kTraces | kVaryingResult;

const Builtin kRows[] = {
    {"trace", "c=pv~ f=pv~", lower::trace, KINORA_RSL_REF(ref::trace), kRays, 0,
     "Color seen from a point in a direction, or the distance of what is hit; \"samples\", "
     "\"samplecone\", \"maxdist\", \"bias\", \"label\".",
     kSurface | kVolume},
    {"transmission", "c=pp~", lower::transmission, KINORA_RSL_REF(ref::transmission),
     kRays | kShadows, 0,
     "Light let through between two points; \"samples\", \"samplecone\", \"bias\".",
     kSurface | kLight | kVolume},
    {"visibility", "f=pp~", lower::visibility, KINORA_RSL_REF(ref::visibility), kRays | kShadows, 0,
     "1 if two points see each other, else 0.", kSurface | kLight | kVolume},
    {"occlusion", "f=pnf~ f=spnf~", lower::occlusion, KINORA_RSL_REF(ref::occlusion), kRays, 0,
     "Share of the hemisphere over N that is blocked, by cosine; \"maxdist\", \"coneangle\", "
     "\"bias\", \"falloff\", \"falloffmode\", \"environmentdir\".",
     kSurface | kLight},
    {"indirectdiffuse", "c=pnf~", lower::indirectdiffuse, KINORA_RSL_REF(ref::indirectdiffuse),
     kRays, 0,
     "Mean light from other surfaces over the hemisphere of N, by cosine; \"maxdist\", "
     "\"coneangle\", \"bias\", \"environmentmap\".",
     kSurface | kLight},
    {"indirectdiffuse", "c=snf~", lower::indirectdiffuse, KINORA_RSL_REF(ref::indirectdiffuse),
     kRays, 0, "Mean light of an environment map over the hemisphere of N, by cosine.",
     kSurface | kLight, "P"},
    {"areashadow", "f=spppp~ c=spppp~", lower::areashadow, KINORA_RSL_REF(ref::areashadow),
     kRays | kShadows, 0,
     "Share of a parallelogram of light (a corner and its two neighbours) hidden from P, by rays.",
     kSurface | kLight},
};

}  // namespace

std::span<const Builtin> builtins_rays() {
    return kRows;
}

}  // namespace kinora::rsl
