surface x() {
    float w = abs(Du(s) * du) + abs(Dv(s) * dv);
    float a = area(P) + filterstep(0.5, s) + filterstep(0.5, s, t, "filter", "box");
    vector d = Du(P) ^ Dv(P);
    Ci = w + a + length(d) + Deriv(s, t) + Du(Cs);
}
