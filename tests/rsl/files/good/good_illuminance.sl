surface x(string category = "";) {
    normal Nf = faceforward(normalize(N), I);
    color c = 0;
    illuminance(P) c += Cl;
    illuminance(P, Nf, PI / 2) { c += Cl * (normalize(L) . Nf); }
    illuminance(category, P, Nf, PI / 2, "lightcache", "refresh") {
        float nondiffuse = 0;
        lightsource("__nondiffuse", nondiffuse);
        if (nondiffuse == 1) continue;
        c += Ol * Cl;
    }
    illuminance("-fill", P, (0, 0, 1), 1) c += 1;
    Ci = c;
}
