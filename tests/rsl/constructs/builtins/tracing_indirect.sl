// occlusion and indirectdiffuse with their options
surface tracing_indirect(float samples = 16, maxdist = 10, maxvariation = 0.02) {
    normal Nf = faceforward(normalize(N), I);
    float occ = occlusion(P, Nf, samples, "maxdist", maxdist, "maxvariation", maxvariation);
    color ind = indirectdiffuse(P, Nf, samples, "maxdist", maxdist);
    Ci = Cs * (1 - occ) + Cs * ind;
}
