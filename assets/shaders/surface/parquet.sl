/* parquet.sl: a floor of oak staves in squares that turn by turns, waxed. In the floor's own x, y;
   walls get it too.
   Parameters: square (side, world units), staves (to a square), gap, the two wood colours, variation,
   Ka Kd Ks roughness, Kr of the wax. */
surface parquet(float Ka = 1; float Kd = 0.85; float Ks = 0.25; float roughness = 0.08;
                float Kr = 0.45; float square = 0.48; float staves = 5; float gap = 0.006;
                float variation = 0.55; color lightwood = color(0.55, 0.31, 0.13);
                color darkwood = color(0.24, 0.105, 0.035);) {
    normal Nf = faceforward(normalize(N), I);
    vector In = normalize(I);
    point Pw = transform("world", P);
    normal Nw = normalize(ntransform("world", Nf));
    float x = xcomp(Pw);
    float y = ycomp(Pw);
    if (abs(zcomp(Nw)) < 0.7) {
        x = xcomp(Nw) * ycomp(Pw) - ycomp(Nw) * xcomp(Pw);
        y = zcomp(Pw);
    }
    x /= square;
    y /= square;
    float w = max(abs(Du(x) * du) + abs(Dv(x) * dv), abs(Du(y) * du) + abs(Dv(y) * dv));

    /* Squares by turns lie across: swap the axes. */
    float tx = floor(x);
    float ty = floor(y);
    float along = y;
    float across = staves * (x - tx);
    if (mod(tx + ty, 2) >= 1) {
        along = x;
        across = staves * (y - ty);
    }
    float stave = floor(across) + 17 * tx + 131 * ty;
    float tone = float cellnoise(stave + 0.5);
    float cut = float cellnoise(stave + 0.5, 7.5);

    /* Rings of a tree met at a slant: stretched noise; fibres along the stave. */
    point Q = point(9 * cut + 1.6 * (across - floor(across)) / staves * 2, 0.8 * along + 40 * cut, cut);
    float ring = mod(5 * (float noise(1.4 * Q) + 0.4 * float noise(3.1 * Q)) + 2.4 * Q[0], 1);
    float late = smoothstep(0.2, 0.8, ring) * (1 - smoothstep(0.88, 1, ring));
    late = mix(late, 0.4, smoothstep(0.03, 0.15, w));
    float grain = mix(float noise(point(across * 40, along * 9, cut * 50)), 0.5,
                      smoothstep(0.01, 0.05, w));
    color Ct = mix(lightwood, darkwood, 0.6 * late) *
               (1 - 0.5 * variation + variation * tone + 0.25 * (grain - 0.5));

    /* Joints, filtered. */
    float dx = (0.5 - abs(across - floor(across) - 0.5)) / staves;
    float dy = 0.5 - abs(along - floor(along) - 0.5);
    float edge = min(dx, dy);
    float g = 0.5 * gap / square;
    float joint = clamp((edge - g) / max(w, 0.001) + 0.5, 0, 1);
    joint = mix(1, joint, min(1, 4 * g / max(w, 0.0001)));
    Ct *= mix(0.25, 1, joint);

    float kr = Kr * (0.04 + 0.96 * pow(1 - clamp(-(Nf . In), 0, 1), 5));
    Oi = Os;
    Ci = Os * (Ct * (Ka * ambient() + Kd * diffuse(Nf)) + joint * kr * trace(P, reflect(In, Nf)) +
               joint * Ks * specular(Nf, -In, 8 * roughness));
}
