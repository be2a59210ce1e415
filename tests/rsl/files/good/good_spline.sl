surface x(color ramp[4] = {0, 0.3, color(1, 0.5, 0), 1};) {
    color a = spline(s, 0, 0.2, 0.5, 1, color(1, 0, 0));
    color b = spline("bspline", s, Cs, Cs, Os, 1);
    color c = spline(t, ramp);
    float d = spline(s, 0, 0, 1, 1);
    Ci = a + b + c + d;
}
