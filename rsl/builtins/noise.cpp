// rsl/builtins/noise.cpp: noise and random numbers.
#include <utility>

#include "rsl/builtins/table.h"
#include "rsl/lower/builtin_call.h"
#include "rsl/reference/reference_p.h"
#include "rsl/reference/service_calls_p.h"

namespace kinora::rsl {

namespace lower_noise {

// The coordinates that arguments first .. end-1 hold: (x), (x, y), (p), (p, t).
std::vector<Value> coordinates(LowerCall& c, size_t first, size_t end) {
    std::vector<Value> p;
    for (size_t k = first; k < end; ++k)
        p.insert(p.end(), c.args[k].c.begin(), c.args[k].c.begin() + c.args[k].size());
    return p;
}

void set(LowerCall& c, const std::vector<Value>& values) {
    for (size_t k = 0; k < values.size(); ++k) c.result.c[k] = values[k];
}

int components(const LowerCall& c) {
    return component_count(c.result_type());
}

void noise(LowerCall& c) {
    set(c, jit::math::noise(c.b, c.e.running, coordinates(c, 0, c.args.size()), components(c)));
}
void pnoise(LowerCall& c) {
    size_t half = c.args.size() / 2;
    set(c, jit::math::noise(c.b, c.e.running, coordinates(c, 0, half), components(c),
                            coordinates(c, half, 2 * half)));
}
void cellnoise(LowerCall& c) {
    set(c, jit::math::cellnoise(c.b, coordinates(c, 0, c.args.size()), components(c)));
}
// Sample methods draw from the sequence that all samples of a pixel share.
void random(LowerCall& c) {
    if (c.seeds.stratifies() && components(c) == 1) {
        c.context.out.uses_rng = c.context.out.draws_random = true;
        const SampleSeeds::Draw draw = c.seeds.draw(c.call.site);
        return c.set(c.services.call(Service::stratified,
                                     std::array{rng_input(c.b), draw.sequence, draw.index,
                                                draw.count})[draw.second ? 1 : 0]);
    }
    for (int k = 0; k < components(c); ++k) c.result.c[size_t(k)] = c.seeds.random01(c.call, k);
}

}  // namespace lower_noise

namespace ref {
namespace {

// Arguments as coordinates one after the other: points have three.
template <class Real>
std::vector<Dual<Real>> coordinates(const RefCall<Real>& c, size_t first, size_t end) {
    std::vector<Dual<Real>> list;
    for (size_t i = first; i < end; ++i)
        list.insert(list.end(), c.args[i].c.begin(), c.args[i].c.begin() + long(c.args[i].size()));
    return list;
}

// Slopes by central differences in double: their error is far below what float noise has.
template <class Real>
void smooth_noise(RefCall<Real>& c, const std::vector<Dual<Real>>& p,
                  const std::vector<Dual<Real>>& period) {
    constexpr double h = 1e-4;
    int n = int(p.size()), components = int(c.result.size());
    double wide[4], period_wide[4];
    Real x[4], period_x[4], out[3];
    for (size_t d = 0; d < p.size(); ++d) {
        wide[d] = double(x[d] = p[d].x);
        if (!period.empty()) period_wide[d] = double(period_x[d] = period[d].x);
    }
    bool periodic = !period.empty();
    jit::math::noise_reference(x, n, components, periodic ? period_x : nullptr, out);
    for (int k = 0; k < components; ++k) c.result.c[size_t(k)] = out[k];
    for (size_t d = 0; d < p.size(); ++d) {
        if (p[d].u == 0 && p[d].v == 0) continue;
        double before[3], after[3], at = wide[d];
        wide[d] = at - h;
        jit::math::noise_reference(wide, n, components, periodic ? period_wide : nullptr, before);
        wide[d] = at + h;
        jit::math::noise_reference(wide, n, components, periodic ? period_wide : nullptr, after);
        wide[d] = at;
        for (size_t k = 0; k < size_t(components); ++k) {
            Real slope = Real((after[k] - before[k]) / (2 * h));
            c.result.c[k].u += slope * p[d].u;
            c.result.c[k].v += slope * p[d].v;
        }
    }
}

template <class Real>
void noise(RefCall<Real>& c) {
    smooth_noise(c, coordinates(c, 0, c.args.size()), {});
}
// All coordinates, then their periods.
template <class Real>
void pnoise(RefCall<Real>& c) {
    size_t half = c.args.size() / 2;
    smooth_noise(c, coordinates(c, 0, half), coordinates(c, half, 2 * half));
}
template <class Real>
void cellnoise(RefCall<Real>& c) {
    std::vector<Dual<Real>> p = coordinates(c, 0, c.args.size());
    Real x[4], out[3];
    for (size_t d = 0; d < p.size(); ++d) {
        x[d] = p[d].x;
        c.eval.decide(std::isfinite(x[d]) ? std::floor(std::clamp(x[d], Real(-1e9), Real(1e9)))
                                          : Real(0));
    }
    jit::math::cellnoise_reference(x, int(p.size()), int(c.result.size()), out);
    for (size_t k = 0; k < c.result.size(); ++k) c.result.c[k] = out[k];
}

// Two calls in a row are the numbers of one sample.
template <class Real>
void draw(RefCall<Real>& c) {
    auto& drawn = c.eval.drawn;
    const bool second = std::exchange(drawn.open, false) && drawn.path == c.eval.inlined.path &&
                        drawn.turns == c.eval.loop_counters;
    if (second) return c.set(Dual<Real>(Real(drawn.number)));
    const std::vector<double> both = c.eval.service(Service::stratified, {0, 0, 0, 0});
    drawn = {true, c.eval.inlined.path, c.eval.loop_counters, at(both, 1)};
    set_from(c, both);
}

// The keys: the point, the call's site in the text, the functions it is inlined in, the turns of
// the loops around it (docs/decisions.md#random-numbers-without-state).
template <class Real>
void random(RefCall<Real>& c) {
    if (c.eval.inlined.stratifies && c.result.size() == 1) return draw(c);
    for (size_t k = 0; k < c.result.size(); ++k) {
        uint32_t site = (c.eval.inlined.path * 2654435761u) ^ (c.call.site * 40503u + uint32_t(k));
        std::vector<int32_t> keys = {
            int32_t(int64_t(c.eval.in.values.count("rng") ? c.eval.in.values.at("rng") : 0)),
            int32_t(site)};
        keys.insert(keys.end(), c.eval.loop_counters.begin(), c.eval.loop_counters.end());
        c.result.c[k] = Real(jit::math::hash01_reference(keys));
    }
}

}  // namespace
}  // namespace ref

namespace {

namespace lower = lower_noise;

const Builtin kRows[] = {
    {"random", "f= c= p= v= n=", lower::random, KINORA_RSL_REF(ref::random), kVaryingResult, 0,
     "A random number in 0..1 for each point and call."},
    {"noise",
     "f=f f=ff f=p f=pf c=f c=ff c=p c=pf p=f p=ff p=p p=pf v=f v=ff v=p "
     "v=pf n=f n=ff n=p n=pf",
     lower::noise, KINORA_RSL_REF(ref::noise), kPure, 16,
     "Smooth noise of 1 to 4 dimensions in 0..1, about 0.5; the type wanted chooses the result."},
    {"pnoise",
     "f=ff f=ffff f=pp f=pfpf c=ff c=ffff c=pp c=pfpf p=ff p=ffff p=pp "
     "p=pfpf v=ff v=ffff v=pp v=pfpf n=ff n=ffff n=pp n=pfpf",
     lower::pnoise, KINORA_RSL_REF(ref::pnoise), kPure, 16,
     "Periodic noise: the coordinates, then their periods."},
    {"cellnoise",
     "f=f f=ff f=p f=pf c=f c=ff c=p c=pf p=f p=ff p=p p=pf v=f v=ff v=p "
     "v=pf n=f n=ff n=p n=pf",
     lower::cellnoise, KINORA_RSL_REF(ref::cellnoise), kPure, 0,
     "A random number in 0..1, constant in each unit cell."},
};

}  // namespace

std::span<const Builtin> builtins_noise() {
    return kRows;
}

}  // namespace kinora::rsl
