// noises.h: signed noise, sums of octaves, and cell patterns.
#ifndef NOISES_H
#define NOISES_H

#include "filterwidth.h"

// Noise of range -1..1 instead of 0..1: of a float or point, of two floats, as a vector.
#define snoise(x) (2 * (float noise(x)) - 1)
#define snoisexy(x, y) (2 * (float noise(x, y)) - 1)
#define vsnoise(p) (2 * (vector noise(p)) - 1)

// The share of noise that survives a filter: none once its features are below one sample.
#define noise_fade(width) (1 - smoothstep(0.2, 0.75, width))
// Signed noise that fades to its mean before it would alias.
#define filteredsnoise(p, width) (snoise(p) * noise_fade(width))
#define filteredvsnoise(p, width) (vsnoise(p) * noise_fade(width))

// Noise stretched over its whole range and then mapped to lo..hi.
#ifndef udn
#define udn(x, lo, hi) (smoothstep(0.25, 0.75, float noise(x)) * ((hi) - (lo)) + (lo))
#define udn2(x, y, lo, hi) (smoothstep(0.25, 0.75, float noise(x, y)) * ((hi) - (lo)) + (lo))
#endif

// Fractional Brownian motion: octaves of signed noise, each finer and weaker than the last.
float fBm(point p; float filtwidth; uniform float octaves, lacunarity, gain) {
    float sum = 0, amp = 1, fw = filtwidth;
    point q = p;
    uniform float i;
    for (i = 0; i < octaves; i += 1) {
        sum += amp * filteredsnoise(q, fw);
        amp *= gain;
        q *= lacunarity;
        fw *= lacunarity;
    }
    return sum;
}
#define fBm_default(p) fBm(p, sqrt(area(p)), 4, 2, 0.5)

// The same of vectors.
vector vfBm(point p; float filtwidth; uniform float octaves, lacunarity, gain) {
    vector sum = 0;
    float amp = 1, fw = filtwidth;
    point q = p;
    uniform float i;
    for (i = 0; i < octaves; i += 1) {
        sum += amp * filteredvsnoise(q, fw);
        amp *= gain;
        q *= lacunarity;
        fw *= lacunarity;
    }
    return sum;
}
#define vfBm_default(p) vfBm(p, sqrt(area(p)), 4, 2, 0.5)

// Noise looked up where a vector noise has moved the point to ("variable lacunarity").
#define VLNoise(p, scale) (snoise(vsnoise(p) * (scale) + (p)))
#define filteredVLNoise(p, width, scale) (VLNoise(p, scale) * noise_fade(width))
float VLfBm(point p; float filtwidth; uniform float octaves, lacunarity, gain, scale) {
    float sum = 0, amp = 1, fw = filtwidth;
    point q = p;
    uniform float i;
    for (i = 0; i < octaves; i += 1) {
        sum += amp * filteredVLNoise(q, fw, scale);
        amp *= gain;
        q *= lacunarity;
        fw *= lacunarity;
    }
    return sum;
}
#define VLfBm_default(p) VLfBm(p, sqrt(area(p)), 4, 2, 0.5, 1)

// Octaves of |noise|: creases where the noise crosses 0. The mean of |snoise| stands for what the
// filter has removed.
float turbulence(point p; float filtwidth; uniform float octaves, lacunarity, gain) {
    float sum = 0, amp = 1, fw = filtwidth;
    point q = p;
    uniform float i;
    for (i = 0; i < octaves; i += 1) {
        sum += amp * mix(0.2, abs(snoise(q)), noise_fade(fw));
        amp *= gain;
        q *= lacunarity;
        fw *= lacunarity;
    }
    return sum;
}
#define turbulence_default(p) turbulence(p, sqrt(area(p)), 4, 2, 0.5)

// One jittered point for each unit cell: the distance f1 to the nearest one, and which it is.
void voronoi_f1_3d(point P; float jitter; output float f1; output point pos1) {
    point cell = point(floor(xcomp(P)) + 0.5, floor(ycomp(P)) + 0.5, floor(zcomp(P)) + 0.5);
    uniform float i, j, k;
    f1 = 1000;
    for (i = -1; i <= 1; i += 1)
        for (j = -1; j <= 1; j += 1)
            for (k = -1; k <= 1; k += 1) {
                point other = cell + vector(i, j, k);
                point pos = other + jitter * (vector cellnoise(other) - 0.5);
                vector offset = pos - P;
                float squared = offset . offset;
                if (squared < f1) {
                    f1 = squared;
                    pos1 = pos;
                }
            }
    f1 = sqrt(f1);
}

// The same with the second nearest point.
void voronoi_f1f2_3d(point P; float jitter; output float f1; output point pos1; output float f2;
                     output point pos2) {
    point cell = point(floor(xcomp(P)) + 0.5, floor(ycomp(P)) + 0.5, floor(zcomp(P)) + 0.5);
    uniform float i, j, k;
    f1 = 1000;
    f2 = 1000;
    for (i = -1; i <= 1; i += 1)
        for (j = -1; j <= 1; j += 1)
            for (k = -1; k <= 1; k += 1) {
                point other = cell + vector(i, j, k);
                point pos = other + jitter * (vector cellnoise(other) - 0.5);
                vector offset = pos - P;
                float squared = offset . offset;
                if (squared < f1) {
                    f2 = f1;
                    pos2 = pos1;
                    f1 = squared;
                    pos1 = pos;
                } else if (squared < f2) {
                    f2 = squared;
                    pos2 = pos;
                }
            }
    f1 = sqrt(f1);
    f2 = sqrt(f2);
}

// In the plane.
void voronoi_f1_2d(float ss, tt; float jitter; output float f1; output float spos1, tpos1) {
    float scell = floor(ss) + 0.5, tcell = floor(tt) + 0.5;
    uniform float i, j;
    f1 = 1000;
    for (i = -1; i <= 1; i += 1)
        for (j = -1; j <= 1; j += 1) {
            float sother = scell + i, tother = tcell + j;
            float spos = sother + jitter * (float cellnoise(sother, tother) - 0.5);
            float tpos = tother + jitter * (float cellnoise(sother + 23, tother - 87) - 0.5);
            float squared = (spos - ss) * (spos - ss) + (tpos - tt) * (tpos - tt);
            if (squared < f1) {
                f1 = squared;
                spos1 = spos;
                tpos1 = tpos;
            }
        }
    f1 = sqrt(f1);
}

// In the plane, with the second nearest point.
void voronoi_f1f2_2d(float ss, tt; float jitter; output float f1; output float spos1, tpos1;
                     output float f2; output float spos2, tpos2) {
    float scell = floor(ss) + 0.5, tcell = floor(tt) + 0.5;
    uniform float i, j;
    f1 = 1000;
    f2 = 1000;
    for (i = -1; i <= 1; i += 1)
        for (j = -1; j <= 1; j += 1) {
            float sother = scell + i, tother = tcell + j;
            float spos = sother + jitter * (float cellnoise(sother, tother) - 0.5);
            float tpos = tother + jitter * (float cellnoise(sother + 23, tother - 87) - 0.5);
            float squared = (spos - ss) * (spos - ss) + (tpos - tt) * (tpos - tt);
            if (squared < f1) {
                f2 = f1;
                spos2 = spos1;
                tpos2 = tpos1;
                f1 = squared;
                spos1 = spos;
                tpos1 = tpos;
            } else if (squared < f2) {
                f2 = squared;
                spos2 = spos;
                tpos2 = tpos;
            }
        }
    f1 = sqrt(f1);
    f2 = sqrt(f2);
}

#endif
