surface x() {
    P += 0.1 * N; N = calculatenormal(P); I = -I;
    s = 2 * s; t *= 2; u = s; v = t; Cs = 1;
    Ci = Oi = Cs;
}
displacement y(float Km = 0.1) {
    vector shift = Km * noise(P) * normalize(N);
    P += vtransform("shader", "current", shift);
    N = calculatenormal(P);
}
