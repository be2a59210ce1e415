// illuminance(P), two-argument form, expressions as position
surface illuminance_all() {
    color c = 0;
    illuminance(P) { c += Cl * 0.5; }
    illuminance(P, N) c += Cl * 0.25;
    illuminance(P + 0.01 * N, N, PI) { c += Cl * 0.125; }
    Ci = c;
}
