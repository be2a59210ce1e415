// numbers of every spelling, joined strings, escapes
surface literals() {
    float a = 1, b = 1., c = .5, d = 1e-3, e = 1.5E+2, f = 2.f, g = 1e50, h = 00012;
    string q = "a" "b\
c\t\"\\\101";
    Ci = a * b * c * d * e * f * 0.01 + (g > 1e30) * 0.1 + h * 0.01;
    if (q == "abc\t\"\\A") Ci += 0.1;
}
