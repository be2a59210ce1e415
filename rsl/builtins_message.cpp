// rsl/builtins_message.cpp: rows of the built-in table: messages between shaders and questions to
// the renderer.
#include "rsl/builtin.h"

namespace kinora::rsl {

namespace {

const Builtin kRows[] = {
    {"surface",
     "f=sF f=sC f=sP f=sV f=sN f=sM f=sS f=sF[] f=sC[] f=sP[] f=sV[] f=sN[] "
     "f=sM[] f=sS[]",
     nullptr,
     {},
     kMessage | kVaryingResult,
     0,
     "Value of a surface parameter: 1 if there is one."},
    {"displacement",
     "f=sF f=sC f=sP f=sV f=sN f=sM f=sS f=sF[] f=sC[] f=sP[] f=sV[] f=sN[] "
     "f=sM[] f=sS[]",
     nullptr,
     {},
     kMessage | kVaryingResult,
     0,
     "Value of a displacement parameter: 1 if there is one."},
    {"lightsource",
     "f=sF f=sC f=sP f=sV f=sN f=sM f=sS f=sF[] f=sC[] f=sP[] f=sV[] f=sN[] "
     "f=sM[] f=sS[]",
     nullptr,
     {},
     kMessage | kVaryingResult,
     0,
     "Value of a parameter of the light in an illuminance loop."},
    {"atmosphere",
     "f=sF f=sC f=sP f=sV f=sN f=sM f=sS f=sF[] f=sC[] f=sP[] f=sV[] f=sN[] "
     "f=sM[] f=sS[]",
     nullptr,
     {},
     kMessage | kVaryingResult,
     0,
     "Value of a volume parameter: 1 if there is one."},
    {"incident",
     "f=sF f=sC f=sP f=sV f=sN f=sM f=sS f=sF[] f=sC[] f=sP[] f=sV[] f=sN[] "
     "f=sM[] f=sS[]",
     nullptr,
     {},
     kMessage | kVaryingResult,
     0,
     "Value of a parameter of the volume in front."},
    {"opposite",
     "f=sF f=sC f=sP f=sV f=sN f=sM f=sS f=sF[] f=sC[] f=sP[] f=sV[] f=sN[] "
     "f=sM[] f=sS[]",
     nullptr,
     {},
     kMessage | kVaryingResult,
     0,
     "Value of a parameter of the volume behind."},
    {"attribute",
     "f=sF f=sC f=sP f=sV f=sN f=sM f=sS f=sF[] f=sC[] f=sP[] f=sV[] f=sN[] "
     "f=sM[] f=sS[]",
     nullptr,
     {},
     kMessage,
     0,
     "Value of an attribute of the geometry: 1 if known."},
    {"option",
     "f=sF f=sC f=sP f=sV f=sN f=sM f=sS f=sF[] f=sC[] f=sP[] f=sV[] f=sN[] "
     "f=sM[] f=sS[]",
     nullptr,
     {},
     kMessage,
     0,
     "Value of an option of the renderer: 1 if known."},
    {"rendererinfo",
     "f=sF f=sC f=sP f=sV f=sN f=sM f=sS f=sF[] f=sC[] f=sP[] f=sV[] f=sN[] "
     "f=sM[] f=sS[]",
     nullptr,
     {},
     kMessage,
     0,
     "A fact about the renderer: 1 if known."},
    {"rayinfo",
     "f=sF f=sC f=sP f=sV f=sN f=sM f=sS f=sF[] f=sC[] f=sP[] f=sV[] f=sN[] "
     "f=sM[] f=sS[]",
     nullptr,
     {},
     kMessage | kVaryingResult,
     0,
     "A fact about the ray that sees the point: 1 if known."},
    {"shadername",
     "s= s=s",
     nullptr,
     {},
     kMessage,
     0,
     "Name of this shader, or of the one of a kind."},
};

}  // namespace

std::span<const Builtin> builtins_message() {
    return kRows;
}

}  // namespace kinora::rsl
