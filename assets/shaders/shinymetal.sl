/* shinymetal.sl: a metal that mirrors an environment map, or the broad lights where it has none. */
#include "broadlights.h"

surface shinymetal(float Ka = 1; float Ks = 1; float Kr = 1; float roughness = 0.1;
                   string texturename = ""; color surface_color = 1;) {
    normal Nf = faceforward(normalize(N), I);
    vector In = normalize(I);
    color env = Kr * broad_glow(P, Nf, reflect(In, Nf));
    if (texturename != "") {
        vector D = vtransform("world", reflect(In, Nf));
        env = Kr * color environment(texturename, D);
    }
    Oi = Os;
    Ci = Os * Cs * surface_color * (Ka * ambient() + Ks * specular(Nf, -In, roughness) + env);
}
