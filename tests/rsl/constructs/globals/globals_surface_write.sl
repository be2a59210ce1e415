// surfaces write P, N, s, t, u, v, I, Cs, Os
surface globals_surface_write() {
    P += 0.1 * N;
    N = normalize(N + (0, 0.1, 0));
    s = mod(s * 2, 1); t = 1 - t; u = s; v = t;
    I = normalize(I);
    Cs *= 0.5; Os = 0.75;
    Ci = Cs * s + color(N) * 0.1 + color(P) * 0.01 + u * v * 0.1 + color(I) * 0.1;
    Oi = Os;
}
