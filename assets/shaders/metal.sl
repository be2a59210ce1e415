/* metal.sl: highlights in the metal's own color; broad lights, which make none, are mirrored as a glow. */
#include "broadlights.h"

surface metal(float Ka = 1; float Ks = 1; float roughness = 0.1; color surface_color = 1;) {
    normal Nf = faceforward(normalize(N), I);
    vector V = -normalize(I);
    color mirrored = specular(Nf, V, roughness) + broad_glow(P, Nf, reflect(-V, Nf));
    Oi = Os;
    Ci = Os * Cs * surface_color * (Ka * ambient() + Ks * mirrored);
}
