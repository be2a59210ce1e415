// every global that surfaces read
surface globals_surface_read() {
    Ci = Cs * Os + color(P) * 0.01 + color(dPdu) * 0.01 + color(dPdv) * 0.01 + color(N) * 0.1 + color(Ng) * 0.1;
    Ci += color(s, t, 0) + color(u, v, 0) + du + dv + color(I) * 0.01 + color(E) * 0.01 + ncomps * 0.1;
    Ci += time * 0.1 + dtime + PI * 0.1 + color(dPdtime);
    Oi = Os;
}
