// rsl/builtins/noise.cpp: rows of the built-in table: noise and random numbers.
#include "rsl/builtins/table.h"
#include "rsl/lower/lower_p.h"
#include "rsl/reference/builtins.h"

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
    set(c, jit::math::noise(c.b, c.low.running, coordinates(c, 0, c.args.size()), components(c)));
}
void pnoise(LowerCall& c) {
    size_t half = c.args.size() / 2;
    set(c, jit::math::noise(c.b, c.low.running, coordinates(c, 0, half), components(c),
                            coordinates(c, half, 2 * half)));
}
void cellnoise(LowerCall& c) {
    set(c, jit::math::cellnoise(c.b, coordinates(c, 0, c.args.size()), components(c)));
}
void random(LowerCall& c) {
    for (int k = 0; k < components(c); ++k) c.result.c[size_t(k)] = c.low.random01(c.call, k);
}

}  // namespace lower_noise

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
