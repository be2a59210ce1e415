surface flat(color c = 1) {
    Ci = c;
    Oi = 1;
}
