/* occlusion.sl: clay under an even sky: light comes from where nothing stands in the way, tinted
   from ground to sky by the mean open direction.
   Parameters: Kd, samples (rays a point), maxdist (what is farther hides nothing), sky, ground. */
surface occlusion(float Kd = 0.9; float samples = 64; float maxdist = 1e30;
                  color sky = color(0.95, 0.98, 1.0); color ground = color(0.45, 0.38, 0.32);) {
    normal Nf = faceforward(normalize(N), I);
    vector open = 0;
    float hidden = occlusion(P, Nf, samples, "maxdist", maxdist, "environmentdir", open);
    vector up = vtransform("world", open);
    color light = mix(ground, sky, smoothstep(-1, 1, ycomp(up)));
    Oi = Os;
    Ci = Oi * Cs * Kd * light * (1 - hidden);
}
