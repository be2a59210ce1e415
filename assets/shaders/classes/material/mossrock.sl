/* mossrock.sl: a rock with moss where it faces the sky and in its hollows.
   The height that displacement() computes decides in prelighting() where the moss holds on.
   Parameters: scale, depth, moss (0 to 1), stone, lichen, green, sky (where it is). */
class mossrock(float scale = 1.6; float depth = 0.14; float moss = 0.55;
               color stone = color(0.36, 0.34, 0.31); color lichen = color(0.62, 0.58, 0.38);
               color green = color(0.16, 0.27, 0.05);
               vector sky = vector "world" (0, 0, 1);) {
    varying float height = 0;
    varying float cover = 0;
    varying color base = 0;

    float ridges(point Q) {
        float sum = 0, weight = 0.55, k;
        point q = Q;
        for (k = 0; k < 6; k += 1) {
            sum += weight * abs(2 * float noise(q) - 1);
            q = 2.07 * q + vector(1.7, 3.1, 0.4);
            weight *= 0.5;
        }
        return sum;
    }
    public void displacement(output point P; output normal N) {
        height = ridges(scale * transform("object", P));
        P += depth * (height - 0.4) * normalize(N);
        N = calculatenormal(P);
    }
    public void prelighting(output color Ci, Oi) {
        point Q = transform("object", P);
        float up = normalize(N) . normalize(sky);
        float patches = float noise(3 * Q) + 0.4 * float noise(17 * Q);
        cover = smoothstep(0.75 - moss, 1.15 - moss, 0.55 * up + 0.5 * patches - 0.45 * height);
        float spots = smoothstep(0.68, 0.74, float noise(7 * Q + vector(9, 2, 5)));
        base = stone * mix(0.6, 1.3, float noise(23 * Q)) * mix(0.55, 1.1, height);
        base = mix(base, lichen, 0.7 * spots);
        base = mix(base, green * mix(0.5, 1.7, float noise(41 * Q)), cover);
    }
    public void lighting(output color Ci, Oi) {
        normal Nf = faceforward(normalize(N), I);
        /* Moss is soft: its tips catch the light that grazes it. */
        float rim = pow(1 - abs(Nf . normalize(I)), 3);
        Ci = Oi * base * (ambient() + diffuse(Nf) * (1 + 0.9 * rim * cover));
    }
}
