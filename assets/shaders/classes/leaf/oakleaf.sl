/* oakleaf.sl: one oak leaf on a card, opacity first: outside the lobes nothing else is computed.
   Parameters: lobes, green, autumn (0 green to 1 brown), translucence. */
class oakleaf(float lobes = 4; color green = color(0.14, 0.3, 0.05); float autumn = 0.35;
              float translucence = 0.6;) {
    varying float half_width = 0, across = 0;

    public void begin() {
        across = abs(s - 0.5) * 2;
        float lobe = 0.5 - 0.5 * cos(2 * PI * lobes * pow(t, 1.15));
        float outline = sqrt(max(0, sin(PI * clamp(1.06 * t - 0.06, 0, 1)))) * mix(0.55, 1, t);
        half_width = outline * mix(0.34, 0.92, pow(lobe, 0.8));
        half_width = max(half_width, 0.03 * step(t, 0.2));
    }
    public void opacity(output color Oi) { Oi = across < half_width ? 1 : 0; }
    public void surface(output color Ci, Oi) {
        float slant = mod(2 * lobes * (t - 0.42 * across), 1);
        float vein = 1 - smoothstep(0.02, 0.07, across);
        vein = max(vein, 0.7 * (1 - smoothstep(0.03, 0.11, min(slant, 1 - slant))));
        point Q = transform("world", P);
        float turned = smoothstep(0.2, 1, autumn + 0.5 * (float noise(1.5 * Q) - 0.5) +
                                              0.35 * across / max(0.05, half_width) - 0.2);
        color base = mix(green, color "hsv" (0.09 - 0.06 * float noise(2 * Q), 0.85, 0.55), turned);
        base *= mix(0.8, 1.15, float noise(30 * s, 30 * t));
        base = mix(base, base + color(0.16, 0.17, 0.06), vein);
        normal Nf = faceforward(normalize(N), I);
        Ci = Oi * base * (ambient() + diffuse(Nf) + translucence * diffuse(-Nf));
    }
}
