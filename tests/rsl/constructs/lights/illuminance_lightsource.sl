// lightsource() in illuminance
surface illuminance_lightsource() {
    color c = 0;
    uniform float nondiff = 0, nonspec = 0, reach = 0;
    normal Nf = normalize(N);
    illuminance(P, Nf, PI / 2) {
        if (lightsource("__nondiffuse", nondiff) == 0) nondiff = 0;
        if (nondiff < 1) c += Cl * (1 - nondiff) * (normalize(L) . Nf);
        nonspec = 0;
        lightsource("__nonspecular", nonspec);
        c += Cl * (1 - nonspec) * 0.1;
        if (lightsource("intensity", reach) != 0) c += 0.01 * reach;
    }
    Ci = c;
}
