// rsl/builtins_color.cpp: rows of the built-in table: colors and components.
#include "rsl/builtin.h"

namespace kinora::rsl {

namespace {

const Builtin kRows[] = {
    {"comp",
     "f=cf f=pf f=vf f=nf f=mff",
     nullptr,
     {},
     kPure,
     0,
     "A component: comp(c, i), comp(m, row, column)."},
    {"setcomp",
     "x=Cff x=Pff x=Vff x=Nff x=Mfff",
     nullptr,
     {},
     kPure,
     0,
     "Sets a component: setcomp(c, i, x), setcomp(m, row, column, x)."},
    {"ctransform",
     "c=sc c=ssc",
     nullptr,
     {},
     kPure,
     8,
     "A color from one space to another: rgb hsv hsl xyz xyY YIQ."},
};

}  // namespace

std::span<const Builtin> builtins_color() {
    return kRows;
}

}  // namespace kinora::rsl
