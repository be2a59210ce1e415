// rsl/builtins/foreign.cpp: functions of PRMan that public shaders call and that are not computed:
// a warning says so, and the shader has its other parts.
#include "rsl/builtins/table.h"
#include "rsl/lower/builtin_call.h"
#include "rsl/reference/reference_p.h"

namespace kinora::rsl {

namespace lower_foreign {

// What happens in place of the function.
struct Instead {
    std::string_view name;
    const char* text;
};
constexpr Instead kInstead[] = {
    {"emit", "the surface lights nothing but by rays that meet it"},
    {"ptexture", "the value is 0"},
    {"textureatlas", "the value is 0"},
    {"rbug", "nothing is kept"},
};

void not_computed(LowerCall& c) {
    for (const Instead& row : kInstead)
        if (row.name == c.call.name)
            c.context.report_first(Code::RSL_NOT_COMPUTED, c.where(), row.name, row.text);
}

}  // namespace lower_foreign

namespace ref {
namespace {

template <class Real>
void not_computed(RefCall<Real>&) {}

}  // namespace
}  // namespace ref

namespace {

namespace lower = lower_foreign;

// Not pure: a call of constants is lowered too, which tells the user.
constexpr uint32_t kUncomputed = kConstantResult;

const Builtin kRows[] = {
    {"emit", "x=c~", lower::not_computed, KINORA_RSL_REF(ref::not_computed), kUncomputed, 0,
     "PRMan's way to make a surface a light. Not computed: a light's shader does it.", kSurface},
    {"ptexture", "f=sff c=sff f=sffffffff c=sffffffff", lower::not_computed,
     KINORA_RSL_REF(ref::not_computed), kUncomputed, 0,
     "PRMan's texture of Ptex files: file, channel, face, with or without a filterregion. Not "
     "computed: 0.",
     kAnyShader},
    {"textureatlas", "f=sff c=sff", lower::not_computed, KINORA_RSL_REF(ref::not_computed),
     kUncomputed, 0, "PRMan's texture of several files. Not computed: 0."},
    {"rbug", "x=f x=c x=p x=v x=n x=m x=s", lower::not_computed, KINORA_RSL_REF(ref::not_computed),
     kUncomputed, 0, "A debugger's look at a value. Not computed."},
};

}  // namespace

std::span<const Builtin> builtins_foreign() {
    return kRows;
}

}  // namespace kinora::rsl
