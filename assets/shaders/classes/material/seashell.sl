/* seashell.sl: ribs that displacement() raises, growth lines between them, and a sheen of nacre.
   Parameters: ribs, depth, outer, inner. */
class seashell(float ribs = 26; float depth = 0.05; color outer = color(0.86, 0.66, 0.52);
               color inner = color(0.95, 0.9, 0.84);) {
    varying float rib = 0;    // 1 on a rib's back
    varying float growth = 0;  // age lines along the ribs

    public void displacement(output point P; output normal N) {
        float bend = 0.03 * (float noise(6 * s, 6 * t) - 0.5);
        rib = 0.5 + 0.5 * cos(2 * PI * ribs * (s + bend));
        float scales = mod(22 * t + 0.4 * rib, 1);
        growth = smoothstep(0, 0.9, scales) * (1 - smoothstep(0.9, 1, scales));
        P += depth * sin(PI * t) * (pow(rib, 0.7) + 0.25 * growth * rib) * normalize(N);
        N = calculatenormal(P);
    }
    public void surface(output color Ci, Oi) {
        normal Nf = faceforward(normalize(N), I);
        vector V = -normalize(I);
        float band = float noise(9 * t + 0.6 * float noise(4 * s, 4 * t));
        color base = mix(inner, outer, smoothstep(0.3, 0.75, band) * mix(0.5, 1, rib));
        base = mix(base, 0.5 * outer * outer, 0.5 * (1 - growth) * smoothstep(0.5, 0.8, band));
        float facing = Nf . V;
        color nacre = color "hsv" (mod(0.55 + 0.9 * facing + 0.15 * rib, 1), 0.3, 1);
        Ci = Oi * (base * (ambient() + diffuse(Nf)) + 0.35 * nacre * specular(Nf, V, 0.12) +
                   0.16 * nacre * pow(1 - facing, 2));
    }
}
