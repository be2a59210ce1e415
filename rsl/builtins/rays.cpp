// rsl/builtins/rays.cpp: rays to what is seen, and between two points.
#include "rsl/builtins/table.h"
#include "rsl/lower/builtin_call.h"
#include "rsl/reference/reference_p.h"
#include "rsl/reference/service_calls_p.h"

namespace kinora::rsl {

namespace lower_rays {

constexpr float kFar = 1e30f;

// In an opacity kernel nothing is traced (docs/decisions.md#opacity).
bool traces(LowerCall& c) {
    return c.context.options.want_Ci;
}

// The samples of one call, as the services take them.
Value samples(LowerCall& c, float otherwise) {
    return c.pair("samples", otherwise);
}

// What passes the surface, -1 where "opacity" does not tell.
Value through(LowerCall& c) {
    if (!c.has_pair("opacity")) return c.b.f(-1);
    Value least = c.b.f(0);
    for (auto& [key, value] : c.pairs) {
        if (key != "opacity" || value.type == BaseType::String) continue;
        least = value.c[0];
        for (size_t k = 1; k < size_t(value.size()); ++k) least = c.b.min(least, value.c[k]);
    }
    return c.b.max(c.b.f(0), c.b.sub(c.b.f(1), least));
}

void trace(LowerCall& c) {
    c.report_unknown_pairs();
    if (!traces(c)) return;
    V3 P = c.v3(0), R = c.v3(1);
    auto seed = c.seeds.sample(c.call.site);
    std::vector<Value> hit = c.services.call(
        Service::trace,
        std::array{seed[0], seed[1], P[0], P[1], P[2], R[0], R[1], R[2], c.pair("maxdist", kFar),
                   c.pair("bias", -1), samples(c, 1), c.pair("samplecone", 0), c.text_pair("label"),
                   c.largest_pair("weight", -1), through(c), c.b.i(0)});
    if (c.result_type() == BaseType::Float)
        c.set(hit[3]);
    else
        c.set(V3{hit[0], hit[1], hit[2]});
}

V3 let_through(LowerCall& c) {
    c.report_unknown_pairs();
    if (!traces(c)) return c.e.f3(1);
    V3 from = c.v3(0), to = c.v3(1);
    auto seed = c.seeds.sample(c.call.site);
    std::vector<Value> share =
        c.services.call(Service::transmission,
                        std::array{seed[0], seed[1], from[0], from[1], from[2], to[0], to[1], to[2],
                                   samples(c, 1), c.pair("samplecone", 0), c.pair("bias", -1)});
    return {share[0], share[1], share[2]};
}
void transmission(LowerCall& c) {
    c.set(let_through(c));
}
void visibility(LowerCall& c) {
    V3 t = let_through(c);
    c.set(c.e.flag(c.b.lt(c.b.f(0), c.b.max(c.b.max(t[0], t[1]), t[2]))));
}

}  // namespace lower_rays

namespace ref {
namespace {

template <class Real>
std::vector<double> ask_transmission(RefCall<Real>& c) {
    std::vector<double> args = seeded(c, 0, 2);
    for (double x : {pair(c, "samples", 1), pair(c, "samplecone", 0), pair(c, "bias", -1)})
        args.push_back(x);
    return c.eval.service(Service::transmission, args);
}

template <class Real>
void trace(RefCall<Real>& c) {
    std::vector<double> args = seeded(c, 0, 2);
    for (double x : {pair(c, "maxdist", 1e30), pair(c, "bias", -1), pair(c, "samples", 1),
                     pair(c, "samplecone", 0), pair(c, "label", 0), -1.0, -1.0, 0.0})
        args.push_back(x);
    set_from(c, c.eval.service(Service::trace, args), c.result.type == BaseType::Float ? 3 : 0);
}

template <class Real>
void transmission(RefCall<Real>& c) {
    set_from(c, ask_transmission(c));
}

template <class Real>
void visibility(RefCall<Real>& c) {
    double sum = 0;
    for (double x : ask_transmission(c)) sum += x;
    c.set(Dual<Real>(Real(sum > 0 ? 1 : 0)));
}

}  // namespace
}  // namespace ref

namespace {

namespace lower = lower_rays;

constexpr uint32_t kRays = kService | kTraces | kVaryingResult;

const Builtin kRows[] = {
    {"trace", "c=pv~ f=pv~", lower::trace, KINORA_RSL_REF(ref::trace), kRays, 0,
     "Color seen from a point in a direction, or the distance of what is hit; \"samples\", "
     "\"samplecone\", \"maxdist\", \"bias\", \"label\". \"weight\": what the result is multiplied "
     "by, "
     "and \"opacity\", the surface's own, let deep reflections follow one way of two.",
     kSurface | kVolume},
    {"transmission", "c=pp~", lower::transmission, KINORA_RSL_REF(ref::transmission),
     kRays | kShadows, 0,
     "Light let through between two points; \"samples\", \"samplecone\", \"bias\".",
     kSurface | kLight | kVolume},
    {"visibility", "f=pp~", lower::visibility, KINORA_RSL_REF(ref::visibility), kRays | kShadows, 0,
     "1 if two points see each other, else 0.", kSurface | kLight | kVolume},
};

}  // namespace

std::span<const Builtin> builtins_rays() {
    return kRows;
}

}  // namespace kinora::rsl
