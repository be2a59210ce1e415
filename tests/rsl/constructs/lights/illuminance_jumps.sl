// break and continue in a light loop
surface illuminance_jumps() {
    color c = 0;
    float n = 0;
    illuminance(P, N, PI / 2) {
        if (comp(Cl, 0) < s * 0.5) continue;
        c += Cl;
        n += 1;
        if (n > 1) break;
    }
    Ci = c;
}
