/* soapfilm.sl: a soap bubble: nearly nothing, but colours where the film's thickness makes light of
   one wave length cancel, in bands that flow down.
   Parameters: thickness at top and bottom (nanometres), swirl, Kr, ior of the film. */
surface soapfilm(float Kr = 1; float Ks = 1; float roughness = 0.015; float ior = 1.33;
                 float thintop = 180; float thickbottom = 680; float swirl = 220;) {
    /* How much of a wave length is mirrored by a film: the two faces' waves against each other. */
    float interference(float path; float wavelength;) {
        float x = sin(PI * path / wavelength);
        return x * x;
    }
    normal Nf = faceforward(normalize(N), I);
    vector In = normalize(I);
    vector V = -In;
    point Q = transform("object", P);

    /* The film drains: thin above, thick below, stirred by its own flow. */
    vector flow = vector noise(1.4 * Q + vector(0, 0, 0.4 * time)) - vector(0.5, 0.5, 0.5);
    float height = 0.5 + 0.5 * zcomp(Q) + 0.15 * zcomp(flow);
    float thickness = mix(thickbottom, thintop, smoothstep(0, 1, height));
    thickness += swirl * (float noise(2.6 * Q + 1.8 * flow) - 0.5);

    float cosi = clamp(Nf . V, 0.02, 1);
    float sint = sqrt(1 - cosi * cosi) / ior;
    float cost = sqrt(1 - sint * sint);
    float path = 2 * ior * thickness * cost;
    color band = color(interference(path, 650), interference(path, 545), interference(path, 450));

    float rim = 0.06 + 0.94 * pow(1 - cosi, 4);
    color mirrored = 0;
    float depth = 0;
    rayinfo("depth", depth);
    if (depth < 2)
        mirrored = trace(P, reflect(In, Nf));
    color film = Kr * (0.25 + 2.2 * rim) * band;
    Oi = clamp(0.35 * film + 0.12 * rim, 0, 1);
    Ci = film * (0.45 * mirrored + 0.25 * (ambient() + 0.25 * diffuse(Nf))) +
         Ks * specular(Nf, V, 8 * roughness);
}
