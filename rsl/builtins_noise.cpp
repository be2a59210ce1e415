// rsl/builtins_noise.cpp: rows of the built-in table: noise and random numbers.
#include "rsl/builtin.h"

namespace kinora::rsl {

namespace {

const Builtin kRows[] = {
    {"random",
     "f= c= p= v= n=",
     nullptr,
     {},
     kVaryingResult,
     0,
     "A random number in 0..1 for each point and call."},
    {"noise",
     "f=f f=ff f=p f=pf c=f c=ff c=p c=pf p=f p=ff p=p p=pf v=f v=ff v=p "
     "v=pf n=f n=ff n=p n=pf",
     nullptr,
     {},
     kPure,
     4,
     "Smooth noise of 1 to 4 dimensions in 0..1, about 0.5; the type wanted chooses the result."},
    {"pnoise",
     "f=ff f=ffff f=pp f=pfpf c=ff c=ffff c=pp c=pfpf p=ff p=ffff p=pp "
     "p=pfpf v=ff v=ffff v=pp v=pfpf n=ff n=ffff n=pp n=pfpf",
     nullptr,
     {},
     kPure,
     4,
     "Periodic noise: each coordinate followed by its period."},
    {"cellnoise",
     "f=f f=ff f=p f=pf c=f c=ff c=p c=pf p=f p=ff p=p p=pf v=f v=ff v=p "
     "v=pf n=f n=ff n=p n=pf",
     nullptr,
     {},
     kPure,
     0,
     "A random number in 0..1, constant in each unit cell."},
};

}  // namespace

std::span<const Builtin> builtins_noise() {
    return kRows;
}

}  // namespace kinora::rsl
