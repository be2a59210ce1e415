/* planks.sl: a floor of oak boards along x: each board is cut from its own place in the tree. */
surface planks(float Ka = 1; float Kd = 0.9; float Ks = 0.25; float roughness = 0.09;
               float Kr = 0; float width = 0.16; float boardlength = 1.7; float gap = 0.0022;
               color lightwood = color(0.50, 0.28, 0.12);
               color darkwood = color(0.25, 0.115, 0.042);) {
    normal Nf = faceforward(normalize(N), I);
    vector In = normalize(I);
    point Pfloor = transform("world", P);

    /* Which board: rows along y, each shifted along x by its own amount. */
    float y = ycomp(Pfloor) / width;
    float row = floor(y);
    float x = xcomp(Pfloor) / boardlength + 7.3 * float cellnoise(row + 0.5);
    float board = floor(x);
    float tone = float cellnoise(board + 0.5, row + 0.5);
    vector cut = vector cellnoise(board + 0.5, row + 31.5);

    /* Growth rings of a trunk along x, met off its centre; fibres along the board. */
    point Q = point(0.35 * xcomp(Pfloor), (y - row - 0.5) * width, 0.05) + 9 * cut;
    point Qring = point(xcomp(Q), 14 * ycomp(Q), 2 * zcomp(Q));
    float r = 9 * (float noise(0.55 * Qring) + 0.25 * float noise(1.7 * Qring)) + 2 * tone;
    float ring = mod(r, 1);
    float late = smoothstep(0.25, 0.85, ring) * (1 - smoothstep(0.92, 1, ring));
    point Qgrain = point(7 * xcomp(Pfloor), 420 * ycomp(Pfloor), 5 * tone);
    float grain = float noise(Qgrain);
    color Ct = mix(lightwood, darkwood, 0.75 * late) * (0.62 + 0.5 * tone + 0.3 * (grain - 0.5));

    /* Joints between boards: dark, with worn edges. */
    float across = (0.5 - abs(y - row - 0.5)) * width;
    float along = (0.5 - abs(x - board - 0.5)) * boardlength;
    float edge = min(across, along);
    float joint = smoothstep(0.4 * gap, gap, edge);
    Ct *= mix(0.12, 1, joint) * mix(0.88, 1, smoothstep(gap, 5 * gap, edge));

    float grazing = pow(1 - clamp(-(Nf . In), 0, 1), 5);
    color mirrored = 0;
    if (Kr > 0)
        mirrored = Kr * mix(0.35, 1, grazing) * color trace(P, reflect(In, Nf));
    Oi = Os;
    Ci = Os * (Cs * Ct * (Ka * ambient() + Kd * diffuse(Nf)) +
               joint * (Ks * (1 - 0.5 * late) * specular(Nf, -In, 8 * roughness) + mirrored));
}
