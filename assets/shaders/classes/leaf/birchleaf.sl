/* birchleaf.sl: a toothed leaf, paler below, and bent by displacement(): the bend that it computes
   is the vein that surface() draws.
   Parameters: teeth, above, below, bend, translucence. */
class birchleaf(float teeth = 18; color above = color(0.2, 0.38, 0.06);
                color below = color(0.4, 0.5, 0.22); float bend = 0.05; float translucence = 0.7;) {
    varying float across = 0, rib = 0;

    public void begin() { across = abs(s - 0.5) * 2; }
    public void displacement(output point P; output normal N) {
        float slant = mod(9 * (t - 0.3 * across), 1);
        rib = max(1 - smoothstep(0, 0.05, across),
                  0.8 * (1 - smoothstep(0, 0.14, min(slant, 1 - slant))));
        P += bend * (0.35 * rib - across * across) * normalize(N);
        N = calculatenormal(P);
    }
    public void opacity(output color Oi) {
        float body = 0.9 * pow(max(0, sin(PI * pow(clamp((t - 0.14) / 0.86, 0, 1), 0.72))), 0.85);
        float tooth = mod(teeth * (t + 0.12 * across), 1);
        body *= 1 - 0.14 * tooth * step(0.05, body);
        Oi = across < body || (t < 0.16 && across < 0.03) ? 1 : 0;
    }
    public void surface(output color Ci, Oi) {
        normal Nn = normalize(N), Nf = faceforward(Nn, I);
        color base = (Nn . I < 0) ? above : below;
        base *= mix(0.85, 1.15, float noise(12 * s, 12 * t));
        base = mix(base, base + color(0.1, 0.12, 0.04), rib);
        vector V = -normalize(I);
        Ci = Oi * (base * (ambient() + diffuse(Nf) + translucence * diffuse(-Nf)) +
                   0.12 * specular(Nf, V, 0.15));
    }
}
