/* brushedmetal.sl: steel that was turned on a lathe: fine scratches around it stretch every
   highlight across them (Ward's anisotropic model).
   Parameters: alongrough and acrossrough (width of the highlight in the two directions), scratches
   (per unit of t), metalcolor, Kr of the blurred room. */
#include "broadlights.h"

surface brushedmetal(float Ka = 0.9; float Ks = 0.5; float alongrough = 0.09;
                     float acrossrough = 0.34; float scratches = 260;
                     float Kr = 0.55; color metalcolor = color(0.72, 0.73, 0.76);) {
    normal Nf = faceforward(normalize(N), I);
    vector V = -normalize(I);
    vector X = normalize(dPdu);
    vector Y = normalize(Nf ^ X);

    float y = scratches * t;
    float w = abs(Du(y) * du) + abs(Dv(y) * dv);
    float score = mix(float noise(y, 8 * s), 0.5, smoothstep(0.4, 1.2, w));
    score += 0.35 * mix(float noise(0.31 * y, 3 * s), 0.5, smoothstep(0.8, 3, w)) - 0.175;
    normal Nb = normalize(Nf + 0.10 * (score - 0.5) * Y);

    color shine = 0;
    float cosr = max(Nb . V, 0.05);
    illuminance("-fill", P, Nf, PI / 2) {
        vector Ln = normalize(L);
        vector H = normalize(Ln + V);
        float cosi = max(Nb . Ln, 0.001);
        float hx = (H . X) / alongrough;
        float hy = (H . Y) / acrossrough;
        float hn = max(H . Nb, 0.001);
        float rho = exp(-2 * (hx * hx + hy * hy) / (1 + hn));
        shine += Cl * cosi * rho * inversesqrt(cosi * cosr) / (4 * PI * alongrough * acrossrough);
    }
    /* The room, smeared across the scratches: three looks at it; one in a mirror's mirror. */
    float depth = 0;
    rayinfo("depth", depth);
    color room = 0;
    float looks = 3;
    if (depth > 0)
        looks = 1;
    if (depth < 2) {
        float k;
        for (k = 0; k < looks; k += 1) {
            float slant = (k + float random()) / looks - 0.5;
            room += trace(P, reflect(-V, normalize(Nb + 1.4 * acrossrough * slant * Y)));
        }
        room /= looks;
    }
    room += 2 * broad_glow(P, Nb, reflect(-V, Nb));
    Oi = Os;
    Ci = Os * metalcolor * (1 - depth * 0.5 + depth * score) *
         (0.6 * Ka * ambient() + Ks * shine + Kr * room);
}
