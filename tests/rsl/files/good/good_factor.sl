// A product by assignment: a call whose type its arguments decide is no float.
surface factor(color a = color(1, 0.5, 0.25); float k = 0.5;) {
    color c = Cs;
    c *= mix(a, color(1, 1, 1), k);
    c *= spline(k, a, a, Cs, a);
    c *= noise(P);
    vector d = dPdu;
    d *= noise(P);
    Ci = c * length(d);
}
