/* harlequin.sl: a jester's cloth of lozenges with a gold thread between them, in the manner of the
   pattern libraries: everything from the customary headers.
   Parameters: freq (lozenges along s), thread (its width), three cloth colours, Ka Kd Ks roughness. */
#include "filterwidth.h"
#include "material.h"
#include "noises.h"
#include "normals.h"
#include "patterns.h"

#define CLOTH(i) (i < 1 ? redcloth : i < 2 ? greencloth : bluecloth)

surface harlequin(float Ka = 1, Kd = 0.8, Ks = 0.25, roughness = 0.2, freq = 14, thread = 0.05;
                  color redcloth = color(0.55, 0.04, 0.05), greencloth = color(0.05, 0.30, 0.14),
                        bluecloth = color(0.06, 0.10, 0.38), goldthread = color(0.85, 0.62, 0.22);)
{
    float a = freq * s + freq / 2 * t;
    float b = freq * s - freq / 2 * t;
    float wa = filterwidth(a);
    float wb = filterwidth(b);
    float which = mod(floor(a) + 2 * floor(b), 3);
    color Ct = CLOTH(which);

    /* Threads along both diagonals; the weave in each lozenge runs its own way. */
    float gold = filteredpulsetrain(1 - thread, 1, a + thread / 2, wa);
    gold = max(gold, filteredpulsetrain(1 - thread, 1, b + thread / 2, wb));
    point Q = point(40 * a, 40 * b, which);
    float weave = filteredsnoise(Q, filterwidthp(Q));
    Ct *= 0.85 + 0.25 * weave;
    Ct *= 1 + 0.3 * fBm(4 * transform("shader", P), 4 * filterwidthp(P), 4, 2, 0.5);
    float worn = smoothpulse(0.45, 0.5, 0.55, 0.6, float noise(3 * transform("object", P)));
    Ct = mix(Ct, Ct * 1.25, worn);

    normal Nf = shadingnormal(N);
    color cloth = MaterialPlastic(Nf, Ct, Ka, Kd, 0.3 * Ks, 8 * roughness);
    color metal = MaterialRoughMetal(Nf, goldthread, Ka, 0.5 * Kd, 4 * Ks, 8 * roughness);
    Oi = Os;
    Ci = Os * mix(cloth, metal, clamp(gold, 0, 1));
}
