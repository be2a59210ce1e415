// stdrsl/Colors.h: encodings and brightness of colors.
#ifndef STDRSL_COLORS_H
#define STDRSL_COLORS_H

// IEC 61966-2-1, a channel at a time.
float srgbToLinear(float x) {
    if (x <= 0.04045) return x / 12.92;
    return pow((x + 0.055) / 1.055, 2.4);
}
float linearToSrgb(float x) {
    if (x <= 0.0031308) return x * 12.92;
    return 1.055 * pow(x, 1 / 2.4) - 0.055;
}
color srgbToLinear(color c) {
    return color(srgbToLinear(c[0]), srgbToLinear(c[1]), srgbToLinear(c[2]));
}
color linearToSrgb(color c) {
    return color(linearToSrgb(c[0]), linearToSrgb(c[1]), linearToSrgb(c[2]));
}

// Callers rely on each header to bring these.
#ifndef STDRSL_SHADINGCONTEXT_H
#include <stdrsl/fresnel.h>
#endif

#endif
