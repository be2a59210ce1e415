// what lights read: P, N, Ps, Ns, L, E, s, t, time
light globals_light(float intensity = 1; color lightcolor = 1) {
    illuminate(P) {
        float toward = -normalize(L) . normalize(Ns);
        Cl = intensity * lightcolor * max(toward, 0) / (L . L) + color(Ps) * 0.01 + time;
        Ol = 0.5;
    }
}
