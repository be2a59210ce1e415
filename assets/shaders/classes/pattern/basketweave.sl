/* basketweave.sl: canes that pass over and under each other; between them one looks through.
   begin() finds the cane on top, displacement() rounds it, opacity() opens the gaps.
   Parameters: canes, gap, straw, dark. */
class basketweave(float canes = 16; float gap = 0.16; color straw = color(0.72, 0.52, 0.28);
                  color dark = color(0.32, 0.19, 0.09);) {
    varying float profile = 0;  // height of the upper cane: 1 in its middle
    varying float open = 0;
    varying float age = 0;

    /* Of a cane along x: how high it lies, over the even ones and under the odd. */
    float cane(float x, y) {
        float rise = cos(PI * (x - floor(y))), middle = 2 * mod(y, 1) - 1;
        float round = 1 - middle * middle / ((1 - gap) * (1 - gap));
        return round > 0 ? 0.6 + 0.4 * rise * sqrt(round) : -1;
    }
    public void begin() {
        float ss = 2 * canes * s, tt = canes * t;
        float flat = cane(ss - 0.5, tt), upright = cane(tt + 0.5, ss);
        profile = max(flat, upright);
        open = profile < 0 ? 1 : 0;
        grain(flat > upright, ss, tt);
    }
    void grain(float level; float ss, tt;) {
        float which = level > 0 ? floor(tt) : floor(ss) + 50;
        float fibre = level > 0 ? noise(0.7 * ss, 24 * tt) : noise(24 * ss, 0.7 * tt);
        age = 0.6 * cellnoise(which) + 0.4 * fibre;
    }
    public void displacement(output point P; output normal N) {
        P += 0.05 * profile * normalize(N);
        N = calculatenormal(P);
    }
    public void opacity(output color Oi) { Oi = 1 - open; }
    public void surface(output color Ci, Oi) {
        normal Nf = faceforward(normalize(N), I);
        color base = mix(dark, straw, clamp(0.25 + age, 0, 1)) * mix(0.45, 1, profile);
        Ci = Oi * (base * (ambient() + diffuse(Nf)) + 0.18 * specular(Nf, -normalize(I), 0.14));
    }
}
