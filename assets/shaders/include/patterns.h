// patterns.h: steps, pulses and tiles, sharp and filtered over a width.
#ifndef PATTERNS_H
#define PATTERNS_H

#include "filterwidth.h"

#define sqr(x) ((x) * (x))

// 1 between a and b.
#define pulse(a, b, x) (step(a, x) - step(b, x))
// 1 from `edge` to the end of each period.
#define pulsetrain(edge, period, x) pulse(edge, period, mod(x, period))
// A pulse with smooth flanks e0..e1 and e2..e3, once and in each period.
#define smoothpulse(e0, e1, e2, e3, x) (smoothstep(e0, e1, x) - smoothstep(e2, e3, x))
#define smoothpulsetrain(e0, e1, e2, e3, period, x) smoothpulse(e0, e1, e2, e3, mod(x, period))

// The mean of |x| over a box of width dx.
float filteredabs(float x, dx) {
    float integral(float a) { return 0.5 * a * abs(a); }
    float w = max(dx, MINFILTWIDTH);
    return (integral(x + 0.5 * w) - integral(x - 0.5 * w)) / w;
}

// The mean of smoothstep(edge0, edge1, .) over a box of width dx around x.
float filteredsmoothstep(float edge0, edge1, x, dx) {
    float integral(float a) {  // of 3a^2 - 2a^3 on 0..1 and of 1 beyond
        float c = clamp(a, 0, 1);
        return c * c * c * (1 - 0.5 * c) + max(a - 1, 0);
    }
    float range = max(edge1 - edge0, MINFILTWIDTH), w = max(dx, MINFILTWIDTH) / range;
    float at = (x - edge0) / range;
    return (integral(at + 0.5 * w) - integral(at - 0.5 * w)) / w;
}

// The mean of a pulse over a box of width dx: the covered part of it.
float filteredpulse(float edge0, edge1, x, dx) {
    float w = max(dx, MINFILTWIDTH), x0 = x - 0.5 * w, x1 = x0 + w;
    return max(0, (min(x1, edge1) - max(x0, edge0)) / w);
}

// The mean of a train of pulses.
float filteredpulsetrain(float edge, period, x, dx) {
    float on = edge / period, w = max(dx / period, MINFILTWIDTH);
    float integral(float a) { return (1 - on) * floor(a) + max(0, a - floor(a) - on); }
    float at = x / period;
    return (integral(at + 0.5 * w) - integral(at - 0.5 * w)) / w;
}

// Unit tiles with grooves between them: 1 on a tile, 0 in a groove; which tile it is.
float tilepattern(varying float ss, tt, ds, dt; uniform float groovewidth;
                  output float swhichtile, twhichtile) {
    swhichtile = floor(ss);
    twhichtile = floor(tt);
    return filteredpulsetrain(groovewidth, 1, ss + 0.5 * groovewidth, ds) *
           filteredpulsetrain(groovewidth, 1, tt + 0.5 * groovewidth, dt);
}

// Rows of bricks: which brick (column, row) the point is in, and where in it (0..1).
void basicbrick(float x, y; uniform float tilewidth, tileheight; uniform float rowstagger, rowstaggervary;
                uniform float jaggedfreq, jaggedamp; output float column, row; output float xtile, ytile) {
    point rough = point noise(x * jaggedfreq / tilewidth, y * jaggedfreq / tileheight);
    xtile = x / tilewidth + jaggedamp * (xcomp(rough) - 0.5);
    ytile = y / tileheight + jaggedamp * (ycomp(rough) - 0.5);
    row = floor(ytile);
    ytile -= row;
    xtile += mod(rowstagger * row, 1) + rowstaggervary * (float noise(row + 0.5) - 0.5);
    column = floor(xtile);
    xtile -= column;
}

#endif
