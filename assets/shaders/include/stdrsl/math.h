// stdrsl/Math.h: constants.
#ifndef STDRSL_MATH_H
#define STDRSL_MATH_H

#define M_PI 3.14159265358979
#define M_TWOPI 6.28318530717959
#define M_FOURPI 12.5663706143592
#define M_PI_2 1.5707963267949
#define M_INVPI 0.318309886183791
#define M_INVTWOPI 0.159154943091895
#define M_INVFOURPI 0.0795774715459477
#define M_MAXDIST 1e30
#define M_EPSILON 1e-6

// Callers rely on each header to bring these.
#ifndef STDRSL_SHADINGCONTEXT_H
#include <stdrsl/fresnel.h>
#endif

#endif
