// light loops in functions, with extern P
color lambert(normal Nn) {
    extern point P;
    color c = 0;
    illuminance(P, Nn, PI / 2) {
        extern vector L;
        extern color Cl;
        c += Cl * (normalize(L) . Nn);
    }
    return c;
}
surface illuminance_in_function() { Ci = Cs * lambert(faceforward(normalize(N), I)); }
