/* bakedclay.sl: terracotta whose slow part, the sky that each point sees, may be baked: with `write`
   it goes into a point file, with `read` it comes from there, otherwise it is computed.
   Parameters: pointfile, write, read, samples, Ka Kd, claycolor. */
surface bakedclay(float Ka = 0.8; float Kd = 0.55; float samples = 16; string pointfile = "";
                  float write = 0; float read = 0; color claycolor = color(0.62, 0.27, 0.13);) {
    normal Nf = faceforward(normalize(N), I);
    float open = 1;
    float found = 0;
    if (read != 0 && pointfile != "")
        found = texture3d(pointfile, P, Nf, "open", open);
    if (found == 0)
        open = 1 - occlusion(P, Nf, samples, "maxdist", 3);
    if (write != 0 && pointfile != "")
        bake3d(pointfile, "open", P, Nf, "open", open);
    point Q = transform("object", P);
    float sand = float noise(40 * Q) + 0.5 * float noise(12 * Q);
    float turned = float noise(point(0.5 * xcomp(Q), 0.5 * ycomp(Q), 30 * zcomp(Q)));
    color Ct = claycolor * (0.75 + 0.2 * sand + 0.2 * turned);
    Oi = Os;
    Ci = Os * Ct * (Ka * open * (ambient() * 2 + 0.15) + Kd * diffuse(Nf));
}
