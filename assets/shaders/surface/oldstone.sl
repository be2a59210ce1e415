/* oldstone.sl: a pillar of dressed stone from a ruin: courses of blocks, chipped, stained by rain; one
   of the displacement-in-the-surface kind.
   Parameters: blocks (along s), courses (along t), groove, Km (chips), Ka Kd, the two stone colours. */
#include "displace.h"
#include "filterwidth.h"
#include "locillum.h"
#include "noises.h"
#include "patterns.h"

surface oldstone(float Ka = 1; float Kd = 0.95; float blocks = 9; float courses = 9;
                 float groove = 0.05; float Km = 0.05; float rough = 0.5;
                 color stonecolor = color(0.60, 0.54, 0.44); color staincolor = color(0.20, 0.18, 0.15);) {
    point Q = transform("shader", P);
    float dQ = filterwidthp(Q);
    float x = s + 0.004 * snoise(9 * Q);
    float y = t + 0.004 * snoise(9 * Q + vector(3, 9, 1));
    float row = floor(y * courses);
    float bx = x * blocks + 0.5 * mod(row, 2);
    float by = y * courses;
    float inblock = filteredpulsetrain(groove, 1, bx, filterwidth(bx)) *
                    filteredpulsetrain(groove, 1, by, filterwidth(by));
    float own = float cellnoise(floor(bx) + 0.5, row + 0.5);

    float chips = turbulence(5 * Q, 5 * dQ, 5, 2.1, 0.55);
    normal Nn = Displace(vector normalize(N), "shader", Km * (inblock * (0.6 + 0.2 * own) - 0.5 * chips), 0);
    normal Nf = faceforward(normalize(Nn), I);

    point where;
    float f1;
    voronoi_f1_3d(14 * Q, 1, f1, where);
    float pits = 1 - filteredsmoothstep(0.10, 0.25, f1, 14 * dQ);
    float streaks = fBm(point(3 * xcomp(Q), 3 * ycomp(Q), 0.6 * zcomp(Q)), 3 * dQ, 5, 2, 0.5);
    color Ct = stonecolor * (0.75 + 0.35 * own + 0.25 * chips);
    Ct = mix(Ct, staincolor, clamp(0.2 + 1.1 * streaks, 0, 0.8));
    Ct *= (1 - 0.4 * pits) * mix(0.4, 1, inblock);
    Oi = Os;
    Ci = Os * Ct * (Ka * ambient() + Kd * LocIllumOrenNayar(Nf, -normalize(I), rough));
}
