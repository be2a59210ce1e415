// rsl/reference/builtins.h: the plain, one-point meanings of built-ins that rows of the table name:
// KINORA_RSL_REF(ref::smoothstep). Defined in rsl/reference_*.cpp, for float and double.
#pragma once

#include "rsl/model/builtin.h"

// clang-format off
// Rows whose meaning is plain arithmetic on their arguments, the point and its surroundings.
#define KINORA_RSL_REFERENCES(F)                                                              \
    F(radians) F(degrees) F(sin) F(cos) F(tan) F(asin) F(acos) F(atan) F(exp) F(log) F(sqrt)  \
    F(inversesqrt) F(pow) F(mod) F(abs) F(sign) F(floor) F(ceil) F(round) F(min) F(max)       \
    F(clamp) F(mix) F(step) F(smoothstep) F(filterstep) F(spline) F(Du) F(Dv) F(Deriv)        \
    F(xcomp) F(ycomp) F(zcomp) F(setxcomp) F(setycomp) F(setzcomp) F(length) F(normalize)     \
    F(distance) F(ptlined) F(rotate) F(area) F(faceforward) F(reflect) F(refract) F(fresnel)  \
    F(transform) F(vtransform) F(ntransform) F(mtransform) F(depth) F(calculatenormal)        \
    F(comp) F(setcomp) F(ctransform) F(determinant) F(translate) F(scale)                     \
    F(random) F(noise) F(pnoise) F(cellnoise)                                                 \
    F(ambient) F(diffuse) F(specular) F(phong) F(specularbrdf)                                \
    F(trace) F(transmission) F(visibility) F(occlusion) F(indirectdiffuse) F(photonmap)       \
    F(caustic) F(subsurface) F(texture3d) F(bake3d) F(areashadow)                             \
    F(surface_message) F(displacement_message) F(atmosphere) F(incident) F(opposite)          \
    F(attribute) F(option) F(rendererinfo) F(rayinfo)                                         \
    F(raydepth) F(raylabel) F(rayorigin) F(raydirection) F(raylength) F(isshadowray)          \
    F(texture) F(environment) F(shadow) F(bump) F(textureinfo) F(bake)                        \
    F(concat) F(format) F(match) F(printf) F(lightsource) F(shadername)
// clang-format on

namespace kinora::rsl::ref {

#define KINORA_RSL_DECLARE(name) \
    template <class Real>        \
    void name(RefCall<Real>& c);
KINORA_RSL_REFERENCES(KINORA_RSL_DECLARE)
#undef KINORA_RSL_DECLARE

}  // namespace kinora::rsl::ref
