/* velvet.sl: cloth whose hairs stand up: dark where one looks into it, bright at its edges, with
   strokes where a hand went over it.
   Parameters: Ka Kd, sheen (brightness of the edge), backscatter (light that comes straight back),
   edginess (how narrow the edge), strokes, the cloth's and the sheen's colours. */
surface velvet(float Ka = 1; float Kd = 0.35; float sheen = 0.75; float backscatter = 0.35;
               float edginess = 6; float roughness = 0.12; float strokes = 0.6;
               color clothcolor = color(0.16, 0.012, 0.11);
               color sheencolor = color(0.95, 0.45, 0.75);) {
    normal Nn = faceforward(normalize(N), I);
    vector V = -normalize(I);
    point Q = transform("shader", P);

    /* Stroked one way and the other. */
    vector lay = vector noise(1.7 * Q) - vector(0.5, 0.5, 0.5);
    float brushed = smoothstep(-0.08, 0.08, float noise(2.1 * Q + lay) - 0.5);
    normal Nf = normalize(Nn + strokes * (0.22 * (brushed - 0.5) * vector "world" (0.3, 0, 1) +
                                          0.25 * lay));
    color total = 0;
    illuminance(P, Nn, radians(100)) {
        vector Ln = normalize(L);
        float cosine = max(Ln . V, 0);
        color shine = pow(cosine, 1 / roughness) * backscatter * clothcolor * 3;
        cosine = clamp(Nf . V, 0, 1);
        float sine = sqrt(1 - cosine * cosine);
        shine += pow(sine, edginess) * max(Ln . Nf, 0) * sheencolor;
        total += sheen * Cl * shine;
    }
    Oi = Os;
    Ci = Os * (clothcolor * (Ka * ambient() + Kd * diffuse(Nf)) + total);
}
