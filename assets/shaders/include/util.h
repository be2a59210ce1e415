// util.h: small helpers that shaders define again and again.
#ifndef UTIL_H
#define UTIL_H

// a at x = 0, b at x = 1.
#define blend(a, b, x) ((a) * (1 - (x)) + (b) * (x))
#define lerp(a, b, x) blend(a, b, x)
// 0 below a, 1 above b, straight between.
#define boxstep(a, b, x) clamp(((x) - (a)) / ((b) - (a)), 0, 1)
// Set operations on opacities.
#define union(a, b) ((a) + (b) - (a) * (b))
#define intersection(a, b) ((a) * (b))
#define difference(a, b) ((a) * (1 - (b)))
#define complement(a) (1 - (a))
// x repeated freq times over 0..1, and which repetition it is in.
#define repeat(x, freq) mod((x) * (freq), 1)
#define whichtile(x, freq) floor((x) * (freq))
#define odd(x) (mod(x, 2) == 1)
#define even(x) (mod(x, 2) == 0)
// Schlick's curves through (0, 0) and (1, 1): bias moves the middle, gain the steepness there.
#define bias(b, x) pow(x, log(b) / log(0.5))
float gain(float g, x) {
    return x < 0.5 ? 0.5 * bias(1 - g, 2 * x) : 1 - 0.5 * bias(1 - g, 2 - 2 * x);
}
// (x, y) turned by an angle in radians around (ox, oy) into (rx, ry).
#define rotate2d(x, y, angle, ox, oy, rx, ry)                                   \
    rx = ((x) - (ox)) * cos(angle) - ((y) - (oy)) * sin(angle) + (ox);          \
    ry = ((x) - (ox)) * sin(angle) + ((y) - (oy)) * cos(angle) + (oy)
// (x, y) as distance from (0.5, 0.5) and angle 0..1.
#define topolar(x, y, r, theta)                                     \
    r = sqrt(((x) - 0.5) * ((x) - 0.5) + ((y) - 0.5) * ((y) - 0.5)); \
    theta = atan((y) - 0.5, (x) - 0.5) / (2 * PI) + 0.5
// How bright a color looks (Rec. 709).
float luminance(color c) { return 0.2126 * comp(c, 0) + 0.7152 * comp(c, 1) + 0.0722 * comp(c, 2); }

#endif
