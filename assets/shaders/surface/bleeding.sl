/* bleeding.sl: matte that also reflects the light its surroundings send: colours bleed onto it.
   Parameters: Kd, Kbleed (of the surroundings), samples (rays a point, fewer behind the first),
   maxdist. */
surface bleeding(float Kd = 0.8; float Kbleed = 1; float samples = 64; float maxdist = 1e30;) {
    normal Nf = faceforward(normalize(N), I);
    float depth = 0;
    rayinfo("depth", depth);
    float rays = depth > 0 ? max(1, samples / 8) : samples;
    color around = indirectdiffuse(P, Nf, rays, "maxdist", maxdist);
    Oi = Os;
    Ci = Oi * Cs * Kd * (ambient() + diffuse(Nf) + Kbleed * around);
}
