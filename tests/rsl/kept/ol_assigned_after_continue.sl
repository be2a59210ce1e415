// What a loop over lights assigns to Ol stays inside, for lanes that a continue left out, too.
// world 12
surface fuzz() {
    color c = 0;
    illuminance(P) c += Cl;
    illuminance(P, N, 1.5) {
        if (xcomp(P) > 0) continue;
        c += Ol = color(ycomp(P), 0, 1);
        if (zcomp(P) > 0) c = normalize(vector(c)) * Cl;
    }
    Ci = c;
}
