// read-only globals written, and globals of other kinds: warned of
surface globals_read_only() {
    E = point(0, 0, 0);
    Ng = N;
    dPdu *= 2;
    color outside = Cl + color(L);
    Ci = color(dPdu) * 0.1 + outside + alpha;
}
