// bump: the old P comes back
displacement displacement_bump(float Km = 0.1; float truedisp = 0) {
    normal n = normalize(N), deltaN = n - normalize(Ng);
    point Pold = P;
    P = P + Km * sin(s * 20) * n;
    N = normalize(calculatenormal(P)) + deltaN;
    if (truedisp == 0) P = Pold;
}
