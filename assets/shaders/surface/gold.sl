/* gold.sl: polished gold: mirrors what is around it in its own colour, paler at grazing angles.
   Parameters: Kr, Ks, roughness, face and edge colours, Ka, scuffs (fine scratches). */
#include "broadlights.h"

surface gold(float Ka = 0.5; float Kr = 0.9; float Ks = 0.9; float roughness = 0.07;
             float scuffs = 0.03; color facecolor = color(0.98, 0.62, 0.20);
             color edgecolor = color(1, 0.90, 0.68);) {
    point Q = transform("object", P);
    vector wobble = vector noise(9 * Q) - vector(0.5, 0.5, 0.5);
    normal Nf = faceforward(normalize(normalize(N) + scuffs * wobble), I);
    vector In = normalize(I);
    float facing = clamp(-(Nf . In), 0, 1);
    color tint = mix(edgecolor, facecolor, smoothstep(0, 0.7, facing));
    vector R = reflect(In, Nf);
    color room = trace(P, R);
    /* Beyond the studio there is a warm ceiling and a dark floor. */
    float up = zcomp(vtransform("world", R));
    room += 0.16 * smoothstep(-0.4, 0.9, up) + broad_glow(P, Nf, R);
    Oi = Os;
    Ci = Os * tint * (Ka * ambient() + Kr * room + Ks * specular(Nf, -In, 8 * roughness));
}
