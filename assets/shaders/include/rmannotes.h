// rmannotes.h: the names of Steve May's course notes on writing shaders in layers; found as
// rmannotes.sl too. Signed noise, antialiased shapes, and blending by opacity.
#ifndef RMANNOTES_H
#define RMANNOTES_H

#include "util.h"

#define MINFILTERWIDTH 1e-7
#define filterwidth(x) max(abs(Du(x) * du) + abs(Dv(x) * dv), MINFILTERWIDTH)
#define filterwidth_point(p) max(sqrt(area(p)), MINFILTERWIDTH)

#define snoise(x) (2 * (float noise(x)) - 1)
#define snoise2(x, y) (2 * (float noise(x, y)) - 1)

#ifndef udn
#define udn(x, lo, hi) (smoothstep(0.25, 0.75, float noise(x)) * ((hi) - (lo)) + (lo))
#define udn2(x, y, lo, hi) (smoothstep(0.25, 0.75, float noise(x, y)) * ((hi) - (lo)) + (lo))
#endif

// 1 between a and b, with flanks of width fuzz before each.
#define pulse(a, b, fuzz, x) (smoothstep((a) - (fuzz), a, x) - smoothstep((b) - (fuzz), b, x))
#define boxpulse(a, b, fuzz, x) (boxstep((a) - (fuzz), a, x) - boxstep((b) - (fuzz), b, x))

#define topolar2(x, y, r, theta) topolar(x, y, r, theta)
// x raised so that the middle grows brighter as g grows.
#define gamma(g, x) pow(x, 1 / (g))

#endif
