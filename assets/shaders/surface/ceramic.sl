/* ceramic.sl: a glazed pot: celadon that pools in the lower parts, with a net of fine cracks
   (craquelure) under a mirror-smooth glaze.
   Parameters: glazecolor, thincolor (where the glaze ran thin), crackle (cells per unit; 0: none),
   Kr of the mirror, Ka Kd Ks roughness. */
surface ceramic(float Ka = 1; float Kd = 0.8; float Ks = 0.7; float roughness = 0.025;
                float Kr = 0.8; float crackle = 3.5; float crackwidth = 0.02;
                color glazecolor = color(0.30, 0.50, 0.42);
                color thincolor = color(0.62, 0.68, 0.55);
                color crackcolor = color(0.10, 0.08, 0.05);) {
    normal Nf = faceforward(normalize(N), I);
    vector In = normalize(I);
    point Q = transform("object", P);

    float pool = 0.5 + 0.5 * float noise(point(2 * xcomp(Q), 2 * ycomp(Q), 5 * zcomp(Q) + 3));
    pool -= 0.25 * zcomp(Q);
    color Ct = mix(thincolor, glazecolor, smoothstep(0.35, 0.95, pool));

    float crack = 0;
    if (crackle > 0) {
        /* Cracks are where two fields of cells meet: zero lines of a stretched noise. */
        point q = crackle * Q + 0.5 * (vector noise(2 * Q) - vector(0.5, 0.5, 0.5));
        uniform float level;
        for (level = 1; level <= 2; level += 1) {
            float field = float noise(level * q + vector(3, 1, 4) * level) - 0.5;
            float w = max(abs(Du(field) * du) + abs(Dv(field) * dv), 0.0001);
            float line = clamp((crackwidth + 0.5 * w - abs(field)) / w, 0, 1);
            crack = max(crack, line * min(1, 2 * crackwidth / w) / level);
        }
    }
    Ct = mix(Ct, crackcolor, 0.7 * crack);
    float facing = clamp(-(In . Nf), 0, 1);
    float kr = Kr * (0.05 + 0.95 * pow(1 - facing, 5));
    Oi = Os;
    Ci = Os * (Ct * (Ka * ambient() + Kd * diffuse(Nf)) + kr * trace(P, reflect(In, Nf)) +
               Ks * specular(Nf, -In, roughness));
}
