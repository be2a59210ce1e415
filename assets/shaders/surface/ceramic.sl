/* ceramic.sl: a glazed pot: celadon that pools in the lower parts, with a net of fine cracks
   (craquelure) under a mirror-smooth glaze.
   Parameters: glazecolor, thincolor (where the glaze ran thin), crackle (cells per unit; 0: none),
   Kr of the mirror, Ka Kd Ks roughness. */
surface ceramic(float Ka = 1; float Kd = 0.8; float Ks = 0.7; float roughness = 0.025;
                float Kr = 0.8; float crackle = 2.6; float crackwidth = 0.016;
                color glazecolor = color(0.30, 0.50, 0.42);
                color thincolor = color(0.62, 0.68, 0.55);
                color crackcolor = color(0.10, 0.08, 0.05);) {
    /* The way to the border between the nearest two of points strewn in space. */
    float border(point q) {
        point corner = point(floor(xcomp(q)), floor(ycomp(q)), floor(zcomp(q)));
        float near = 9;
        float second = 9;
        uniform float i, j, k;
        for (i = -1; i <= 1; i += 1)
            for (j = -1; j <= 1; j += 1)
                for (k = -1; k <= 1; k += 1) {
                    point cell = corner + vector(i + 0.5, j + 0.5, k + 0.5);
                    float d = distance(q, cell + 0.95 * (vector cellnoise(cell) -
                                                         vector(0.5, 0.5, 0.5)));
                    second = min(second, max(near, d));
                    near = min(near, d);
                }
        return second - near;
    }
    normal Nf = faceforward(normalize(N), I);
    vector In = normalize(I);
    point Q = transform("object", P);

    float pool = 0.5 + 0.5 * float noise(point(2 * xcomp(Q), 2 * ycomp(Q), 5 * zcomp(Q) + 3));
    pool -= 0.25 * zcomp(Q);
    color Ct = mix(thincolor, glazecolor, smoothstep(0.35, 0.95, pool));

    float crack = 0;
    if (crackle > 0) {
        /* Two nets of cracks, an old one and a finer one inside its cells. */
        uniform float level;
        for (level = 1; level <= 2; level += 1) {
            point q = crackle * level * Q + 0.35 * (vector noise(3 * Q) - vector(0.5, 0.5, 0.5));
            float d = border(q + vector(9, 4, 2) * level);
            float w = max(crackle * level * sqrt(area(P)), 0.001);
            float width = crackwidth / level * 2;
            float line = clamp((width - d) / w + 0.5, 0, 1) * min(1, 2 * width / w);
            crack = max(crack, line / level);
        }
    }
    Ct = mix(Ct, crackcolor, 0.7 * crack);
    float facing = clamp(-(In . Nf), 0, 1);
    float kr = Kr * (0.05 + 0.95 * pow(1 - facing, 5));
    Oi = Os;
    Ci = Os * (Ct * (Ka * ambient() + Kd * diffuse(Nf)) + kr * trace(P, reflect(In, Nf)) +
               Ks * specular(Nf, -In, 8 * roughness));
}
