/* clay.sl: a sculptor's clay as shown in a turntable: grey, dark where things are near each other
   (ambient occlusion), a little warm where light gets under the form.
   Parameters: samples, maxdist of the occlusion, Ka (occluded sky light), Kd, claycolor. */
surface clay(float Ka = 0.85; float Kd = 0.45; float samples = 32; float maxdist = 2.5;
             float fingerprints = 0.006; color claycolor = color(0.60, 0.55, 0.50);
             color creasecolor = color(0.45, 0.24, 0.14);) {
    point Q = transform("shader", P);
    float rub = float noise(point(3 * xcomp(Q), 3 * ycomp(Q), 26 * zcomp(Q) + 2 * float noise(3 * Q)));
    /* The bend of the faces, laid on the smooth normal. */
    normal Nn = normalize(N) - normalize(calculatenormal(P)) +
        normalize(calculatenormal(P + fingerprints * rub * normalize(N)));
    normal Nf = faceforward(normalize(Nn), I);
    float occ = occlusion(P, faceforward(normalize(N), I), samples, "maxdist", maxdist);
    color sky = mix(color(0.9, 0.95, 1), color(1, 0.95, 0.9), 0.5 - 0.5 * (Nf . vtransform("world", "current", vector(0, 0, 1))));
    color open = mix(sky, creasecolor, occ) * (1 - occ);
    Oi = Os;
    Ci = Os * claycolor * (Ka * open + Kd * diffuse(Nf));
}
