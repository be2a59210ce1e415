// spline of floats, colors, points, by basis, with arrays
surface spline_forms() {
    color ramp[6] = {color 0, color 0, color(1, 0, 0), color(1, 1, 0), color 1, color 1};
    float knots[4] = {0, 0.25, 0.75, 1};
    Ci = spline(s, color(0, 0, 0), color(0, 0, 0), color(1, 0.5, 0), color(1, 1, 1), color(1, 1, 1));
    Ci += spline("linear", t, 0, 0.1, 0.9, 1) + spline("bspline", s, Cs, Os, Cs, Os) + spline(t, ramp);
    Ci += spline("catmull-rom", s, knots) + color(spline(s, P, P + 1, P + 2, P + 3)) * 0.01;
    Ci += spline("bezier", s, 0, 1, 0, 1) + spline("hermite", t, 0, 1, 1, 0);
}
