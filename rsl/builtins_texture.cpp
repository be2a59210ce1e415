// rsl/builtins_texture.cpp: rows of the built-in table: textures and maps.
#include "rsl/builtin.h"

namespace kinora::rsl {

namespace {

const Builtin kRows[] = {
    // Two rows: only the forms without coordinates read s and t.
    {"texture", "f=s~ c=s~", nullptr, {}, kService | kDerivative, 0,
     "Filtered texture at the surface's s, t; texture(name[channel]).", kAnyShader, "s t"},
    {"texture", "f=sff~ c=sff~ f=sffffffff~ c=sffffffff~", nullptr, {}, kService | kDerivative, 0,
     "Filtered texture at s, t or over a quadrilateral; texture(name[channel], s, t)."},
    {"environment",
     "f=sv~ c=sv~ f=svvvv~ c=svvvv~",
     nullptr,
     {},
     kService | kDerivative,
     0,
     "Environment map in a direction."},
    {"shadow",
     "f=sp~ c=sp~ f=spppp~ c=spppp~",
     nullptr,
     {},
     kService | kShadows | kVaryingResult,
     0,
     "Share of shadow at a point, by map or ray.",
     kSurface | kLight},
    {"bump",
     "n=snvv~ n=snvvff~",
     nullptr,
     {},
     kService | kDerivative,
     0,
     "Normal bent by a bump map.",
     kSurface | kDisplacement,
     "s t"},
    {"textureinfo",
     "f=ssF f=ssC f=ssP f=ssV f=ssN f=ssM f=ssS f=ssF[] f=ssC[] f=ssP[] "
     "f=ssV[] f=ssN[] f=ssM[] f=ssS[]",
     nullptr,
     {},
     kService,
     0,
     "A fact about a texture: 1 if known."},
    {"texture3d",
     "f=spn~",
     nullptr,
     {},
     kService | kVaryingResult,
     0,
     "Values from a point cloud.",
     kSurface | kLight | kDisplacement},
    {"bake3d",
     "f=spn~ f=sspn~",
     nullptr,
     {},
     kService | kPrints | kVaryingResult,
     0,
     "Writes values to a point cloud.",
     kSurface | kLight | kDisplacement},
    {"bake",
     "x=sfff x=sffc x=sffp x=sffv x=sffn",
     nullptr,
     {},
     kService | kPrints,
     0,
     "Writes a value at s, t to a file.",
     kSurface | kDisplacement},
};

}  // namespace

std::span<const Builtin> builtins_texture() {
    return kRows;
}

}  // namespace kinora::rsl
