// illuminance(P, N, angle) with L and Cl
surface illuminance_cone(float roughness = 0.2) {
    normal Nf = faceforward(normalize(N), I);
    vector V = -normalize(I);
    color diff = 0, spec = 0;
    illuminance(P, Nf, PI / 2) {
        vector Ln = normalize(L);
        vector H = normalize(Ln + V);
        diff += Cl * Ln.Nf;
        spec += Cl * pow(max(0, Nf.H), 1 / roughness) * (1 - Ol * 0);
    }
    Ci = Cs * diff + spec;
}
