// broadlights.h: broad lights, which make no highlights, in metals and mirrors.
#ifndef BROADLIGHTS_H
#define BROADLIGHTS_H

// What a metal at P mirrors along R of the lights with __nonspecular, such as the default fill and rim
// lights: a glow as wide as they are. Other lights give nothing here; specular() has them. Light from
// other surfaces (--gi) gives nothing either: a ray along R finds it.
color broad_glow(point P; normal Nf; vector R) {
    color glow = 0;
    vector Rn = normalize(R);
    illuminance("-indirect", P, Nf, PI / 2) {
        float broad = 0;
        lightsource("__nonspecular", broad);
        vector Ln = normalize(L);
        float along = smoothstep(0.1, 1, Rn . Ln);
        if (broad > 0)
            glow += broad * Cl * sqrt(max(Nf . Ln, 0)) * (0.25 + 2.2 * along * along);
    }
    return glow;
}

#endif
