/* crackedglaze.sl: a celadon glaze with fine cracks that dust has darkened. begin() finds the
   crack nearest to the point; displacement() cuts it, prelighting() colours it.
   Parameters: scale, width, glaze, deep, stain. */
class crackedglaze(float scale = 3.2; float width = 0.035; color glaze = color(0.6, 0.74, 0.64);
                   color deep = color(0.28, 0.46, 0.4); color stain = color(0.22, 0.13, 0.07);) {
    varying float crack = 0;   // 1 in the middle of a crack
    varying float pool = 0;    // how thick the glaze lies
    varying color base = 0;

    /* The distance to the border between the two nearest cells. */
    float border(point Q) {
        point cell = point(floor(Q[0]), floor(Q[1]), floor(Q[2])), first = 0, second = 0;
        float i, j, k, d, d1 = 9, d2 = 9;
        for (i = -1; i <= 1; i += 1)
            for (j = -1; j <= 1; j += 1)
                for (k = -1; k <= 1; k += 1) {
                    point at = cell + vector(i, j, k);
                    at += vector cellnoise(at);
                    d = distance(at, Q);
                    if (d < d1) {
                        d2 = d1;
                        second = first;
                        d1 = d;
                        first = at;
                    } else if (d < d2) {
                        d2 = d;
                        second = at;
                    }
                }
        vector across = second - first;
        return (Q - (first + 0.5 * across)) . normalize(-across);
    }
    public void begin() {
        point Q = scale * transform("object", P);
        Q += 0.35 * (vector noise(1.3 * Q) - vector(0.5, 0.5, 0.5));
        float coarse = border(Q), fine = border(2.6 * Q + vector(3, 1, 7));
        crack = max(1 - smoothstep(0, width, coarse), 0.55 * (1 - smoothstep(0, 1.6 * width, fine)));
        pool = float noise(0.8 * Q);
    }
    public void displacement(output point P; output normal N) {
        P -= 0.006 * crack * normalize(N);
        N = calculatenormal(P);
    }
    public void prelighting(output color Ci, Oi) {
        base = mix(glaze, deep, smoothstep(0.25, 0.75, pool));
        base = mix(base, stain, 0.85 * crack);
    }
    public void diffuselighting(output color Ci, Oi) {
        Ci = base * (ambient() + diffuse(faceforward(normalize(N), I)));
    }
    public void specularlighting(output color Ci, Oi) {
        normal Nf = faceforward(normalize(N), I);
        vector V = -normalize(I);
        float kr = 0.04 + 0.96 * pow(1 - Nf . V, 5);
        color coat = specular(Nf, V, 0.03) + kr * color trace(P, reflect(-V, Nf));
        Ci = Oi * (Ci + (1 - crack) * coat);
    }
}
