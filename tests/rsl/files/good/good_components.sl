surface x() {
    Ci[0] = Cs[1];
    Ci[1] += 0.5;
    float i;
    for (i = 0; i < 3; i += 1) Ci[i] = Cs[2 - i];
    vector v = I;
    setxcomp(v, 2);
    v[2] = P[0];
    Oi = v;
}
