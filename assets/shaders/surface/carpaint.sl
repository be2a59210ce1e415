/* carpaint.sl: metallic car paint: a ground colour that shifts when seen from the side, aluminium
   flakes that glint, and a clear coat that mirrors the surroundings.
   Parameters: facecolor, edgecolor, flakes (per unit), sparkle, Kr of the coat, Ka Kd Ks roughness. */
surface carpaint(float Ka = 1; float Kd = 0.6; float Ks = 0.5; float roughness = 0.14;
                 float flakes = 120; float sparkle = 0.8; float Kr = 0.9;
                 color facecolor = color(0.55, 0.012, 0.03);
                 color edgecolor = color(0.10, 0.004, 0.045);
                 color flakecolor = color(1, 0.55, 0.35);) {
    normal Nf = faceforward(normalize(N), I);
    vector In = normalize(I);
    vector V = -In;
    float facing = clamp(Nf . V, 0, 1);

    /* Each cell is a flake that leans its own way; far away they melt into a rough sheen. */
    point Q = flakes * transform("object", P);
    float width = flakes * sqrt(area(P));
    float seen = 1 - smoothstep(0.5, 2, width);
    vector lean = vector cellnoise(Q) - vector(0.5, 0.5, 0.5);
    normal Nflake = normalize(Nf + 0.55 * lean);
    color glint = specular(Nflake, V, 0.28) * seen + 0.25 * specular(Nf, V, 2.4) * (1 - seen);

    color ground = mix(edgecolor, facecolor, pow(facing, 1.4));
    float kr = 0.04 + 0.96 * pow(1 - facing, 5);
    color coat = Kr * kr * trace(P, reflect(In, Nf));
    Oi = Os;
    Ci = Os * (ground * (Ka * ambient() + Kd * diffuse(Nf)) +
               Ks * ground * specular(Nf, V, 16 * roughness) + sparkle * flakecolor * glint +
               coat + 0.6 * specular(Nf, V, 0.096));
}
