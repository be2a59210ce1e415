surface x() {
    float a = noise(P);
    color b = noise(s, t);
    point c = noise(P, 1);
    vector d = vector noise(u);
    P += 0.1 * N * noise(P);
    color e = Cs * noise(P);
    float f = abs(0.5 - noise(2 * P));
    color g = mix(Cs, (1, 0, 0), noise(P));
    color h = cellnoise(s) + pnoise(P, (1, 2, 3)) + random();
    Ci = a * b * e + f + g + h + c + d;
}
