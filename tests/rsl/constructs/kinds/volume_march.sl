// a ray-marched volume with light loops
volume volume_march(float stepsize = 0.5, density = 0.2; uniform float limit = 8) {
    float end = length(I) - 0.0001;
    vector IN = normalize(I);
    color Cv = 0, Ov = 0;
    float d = 0, n = 0;
    while (d < end && n < limit) {
        point PP = P - I + d * IN;
        color li = 0;
        illuminance(PP) { li += Cl; }
        float dens = density * float noise(transform("shader", PP));
        Cv += (1 - Ov) * li * dens;
        Ov += (1 - Ov) * dens;
        d += stepsize;
        n += 1;
    }
    Ci = Cv + (1 - Ov) * Ci;
    Oi = Ov + (1 - Ov) * Oi;
}
