surface x() {
    color c = Cl;
    illuminance(P, N, PI / 2) { c += Cl * (normalize(L) . N); }
    Ci = c * length(L);
}
//! 2:15 warning RSL_ONLY_IN_ILLUMINANCE 'Cl' is only known inside illuminance
//! 4:21 warning RSL_ONLY_IN_ILLUMINANCE 'L' is only known inside illuminance
