// an area-light style shader; __nondiffuse checks with helper macros
#define SHADINGMODEL(Nf) { \
    uniform float nd = 0; \
    illuminance(P, Nf, PI / 2) { \
        nd = 0; lightsource("__nondiffuse", nd); \
        if (nd < 1) { Cd += Cl * (1 - nd) * (Nf . normalize(L)); } \
    } }
surface style_bmrt_area(float Kd = 0.8) {
    color Cd = 0;
    normal Nf = faceforward(normalize(N), I);
    SHADINGMODEL(Nf);
    Ci = Cs * Kd * Cd; Oi = Os;
}
