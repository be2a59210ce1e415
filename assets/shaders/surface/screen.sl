/* screen.sl: a fence of wire: bars along s and t, nothing between; far away it turns into a veil of
   the right density.
   Parameters: freq (bars along s, half as many in t), density (share that is wire), round (shading of
   the wires), wirecolor, Ka Kd Ks roughness. */
surface screen(float Ka = 1; float Kd = 0.6; float Ks = 0.5; float roughness = 0.1;
               float sfreq = 40; float tfreq = 20; float density = 0.28;
               color wirecolor = color(0.62, 0.64, 0.68);) {
    /* How much of a pixel of width w around x is wire. */
    float wires(float x; float w; output float bulge;) {
        float f = x - floor(x) - 0.5;
        float half = 0.5 * density;
        bulge = clamp(abs(f) / half, 0, 1);
        float near = clamp((half - abs(f)) / w + 0.5, 0, 1);
        return mix(near, density, smoothstep(0.4, 1, w));
    }
    float x = sfreq * s;
    float y = tfreq * t;
    float bx, by;
    float a = wires(x, max(abs(Du(x) * du) + abs(Dv(x) * dv), 0.0001), bx);
    float b = wires(y, max(abs(Du(y) * du) + abs(Dv(y) * dv), 0.0001), by);
    float covered = 1 - (1 - a) * (1 - b);
    if (covered < 0.003) {
        Oi = 0;
        Ci = 0;
    } else {
        float bulge = a > b ? bx : by;
        normal Nf = faceforward(normalize(N), I);
        Nf = normalize(Nf + 0.8 * bulge * (a > b ? sign(mod(x, 1) - 0.5) * normalize(dPdu)
                                                 : sign(mod(y, 1) - 0.5) * normalize(dPdv)));
        Oi = Os * covered;
        Ci = Oi * (wirecolor * (Ka * ambient() + Kd * diffuse(Nf)) +
                   Ks * specular(Nf, -normalize(I), 8 * roughness));
    }
}
