surface x(float a = 1, b = 2; color c = 0, d = color(1, 0, 0); uniform string e = "x",
          output varying color aov = 0; varying point Pref = (0, 0, 0); float f[2] = {1, 2};
          float g = a * 2 + radians(b); string names[] = {"p", "q", "r"};) {
    aov = c * d;
    Ci = aov + g + f[1] + Pref;
    if (e == names[2]) Oi = 1;
}
