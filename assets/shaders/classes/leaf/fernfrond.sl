/* fernfrond.sl: a frond of many leaflets, each a small leaf of its own. opacity() comes first.
   Parameters: pairs of leaflets, young, old, translucence. */
class fernfrond(float pairs = 13; color young = color(0.35, 0.55, 0.12);
                color old = color(0.05, 0.22, 0.06); float translucence = 0.5;) {
    varying float along = 0;  // of the leaflet: 0 at the stalk, 1 at its tip
    varying float side = 0;   // of the leaflet's middle
    varying float stalk = 0;

    public void begin() {
        float x = abs(s - 0.5) * 2, reach = 0.95 * pow(max(0, 1 - t), 0.7) * smoothstep(-0.1, 0.22, t);
        float place = pairs * (t - 0.16 * x);  // leaflets rise towards their tips
        along = x / max(0.001, reach);
        side = 2 * mod(place, 1) - 1;
        stalk = x < 0.02 * (1.1 - t) ? 1 : 0;
    }
    public void opacity(output color Oi) {
        float width = 0.82 * sqrt(max(0, 1 - along)) * (0.88 + 0.12 * cos(44 * along));
        Oi = stalk > 0 || (along < 1 && abs(side) < width && t < 0.985) ? 1 : 0;
    }
    public void surface(output color Ci, Oi) {
        color base = mix(old, young, smoothstep(0.1, 1, 0.55 * along + 0.5 * t));
        float vein = 1 - smoothstep(0.04, 0.16, abs(side));
        base = mix(base, 1.5 * base + 0.03, 0.6 * vein);
        if (stalk > 0) base = color(0.24, 0.2, 0.07);
        normal Nf = faceforward(normalize(N), I);
        Ci = Oi * base * (ambient() + diffuse(Nf) + translucence * diffuse(-Nf));
    }
}
