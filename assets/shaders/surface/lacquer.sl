/* lacquer.sl: a black Chinese lacquer bowl: red brush strokes and gold flakes under many clear coats
   that mirror their surroundings.
   Parameters: strokes, flakes (per unit), Kr, eta of the coat, Ka Kd Ks roughness, the colours. */
#include "material.h"
#include "noises.h"
#include "normals.h"
#include "util.h"

surface lacquer(float Ka = 1, Kd = 0.7, Ks = 0.5, roughness = 0.04, Kr = 0.9, eta = 1.5;
                float strokes = 2.2, flakes = 34;
                color ground = color(0.012, 0.010, 0.012), paint = color(0.62, 0.05, 0.02),
                      flakecolor = color(0.85, 0.60, 0.20); DECLARE_DEFAULTED_ENVPARAMS;)
{
    point Q = transform("object", P);
    float r, theta, qx, qy;
    rotate2d(xcomp(Q), ycomp(Q), 2 * zcomp(Q), 0, 0, qx, qy);
    topolar(qx, qy, r, theta);

    /* Strokes: bands of one noise, with the hairs of the brush in them. */
    float field = VLNoise(strokes * Q, 0.7);
    float hairs = snoise(point(60 * field, 3 * theta, 2 * zcomp(Q)));
    float stroke = boxstep(0.12, 0.18, abs(field) + 0.06 * hairs);
    float gap = complement(stroke);

    point at;
    float f1;
    voronoi_f1_3d(flakes * Q, 1, f1, at);
    float size = 0.15 + 0.35 * float cellnoise(at);
    float gold = (1 - smoothstep(size - 0.05, size, f1)) *
                 step(0.55, float cellnoise(at + vector(5, 5, 5))) *
                 smoothstep(-0.2, 0.4, snoise(1.2 * Q));
    color Ct = blend(ground, paint * (0.8 + 0.3 * hairs), union(gap, 0.0));
    float shine = gain(0.7, clamp(luminance(Ct) + gold, 0, 1));
    Ct = blend(Ct, flakecolor, gold);
    normal Nf = shadingnormal(N);
    Oi = Os;
    Ci = Os * (MaterialShinyPlastic(Nf, Ct, Ka, Kd, Ks, 8 * roughness, Kr, 0, eta, 1, ENVPARAMS) +
               gold * shine * flakecolor * specular(Nf, -normalize(I), 1.6));
}
