/* stonewall.sl: a dry wall of field stones of many sizes, mossy in the joints.
   Parameters: scale (stones per unit), depth of the joints, the stones' two colours, joint and moss
   colours, moss 0..1. */
surface stonewall(float Ka = 1; float Kd = 0.9; float scale = 3.2; float depth = 0.05;
                  float moss = 0.5; color stonecolor = color(0.46, 0.42, 0.37);
                  color othercolor = color(0.30, 0.29, 0.30); color jointcolor = color(0.07, 0.06, 0.05);
                  color mosscolor = color(0.13, 0.17, 0.04);) {
    point Q = scale * transform("world", P);
    setzcomp(Q, 1.5 * zcomp(Q));
    Q += 0.55 * (vector noise(0.9 * Q) - vector(0.5, 0.5, 0.5));
    point corner = point(floor(xcomp(Q)), floor(ycomp(Q)), floor(zcomp(Q)));
    float near[2] = {9, 9};
    float id = 0;
    uniform float i, j, k;
    for (i = -1; i <= 1; i += 1)
        for (j = -1; j <= 1; j += 1)
            for (k = -1; k <= 1; k += 1) {
                point cell = corner + vector(i + 0.5, j + 0.5, k + 0.5);
                float d = distance(Q, cell + 0.85 * (vector cellnoise(cell) -
                                                     vector(0.5, 0.5, 0.5)));
                if (d < near[0]) {
                    near[1] = near[0];
                    near[0] = d;
                    id = float cellnoise(cell + vector(31, 7, 13));
                } else if (d < near[1])
                    near[1] = d;
            }
    float gap = near[1] - near[0];
    float stone = smoothstep(0.02, 0.30, gap);
    float width = scale * sqrt(area(P));
    float rough = float noise(5 * Q) + 0.5 * float noise(11 * Q) * (1 - smoothstep(0.02, 0.08, width));
    normal Nn = calculatenormal(P + depth * (stone + 0.22 * rough) * normalize(N));
    normal Nf = faceforward(normalize(Nn), I);

    color Ct = mix(stonecolor, othercolor, smoothstep(0.3, 0.7, id));
    Ct *= 0.55 + 0.35 * id + 0.35 * rough;
    float lichen = smoothstep(0.60, 0.66, float noise(2.3 * Q + vector(4, 4, 4)));
    Ct = mix(Ct, color(0.55, 0.53, 0.38), 0.45 * lichen);
    Ct = mix(jointcolor, Ct, smoothstep(0, 0.12, gap));
    float green = moss * (1 - smoothstep(0.05, 0.35, gap)) *
                  smoothstep(0.4, 0.6, float noise(0.8 * Q + vector(1, 9, 2)));
    Ct = mix(Ct, mosscolor * (0.6 + 0.8 * float noise(19 * Q)), green);
    Oi = Os;
    Ci = Os * Ct * (0.55 + 0.45 * stone) * (Ka * ambient() + Kd * diffuse(Nf));
}
