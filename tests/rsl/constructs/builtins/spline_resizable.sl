// splines over resizable arrays whose length is known at run time
float curve(float x; float knots[]) { return spline("bspline", x, knots); }
surface spline_resizable(float count = 12; output varying float aov_sum = 0; output varying color aov_col = 0;) {
    float f[], rising[], b[];
    color c[];
    point p[];
    uniform float k;
    for (k = 0; k < count; k += 1) {
        push(f, mod(k * 0.37, 1));
        push(rising, k * k * 0.01);
        push(c, color(k * 0.1, s, 1 - k * 0.05));
    }
    float turn;
    for (turn = 0; turn < 4 + floor(t * 5); turn += 1) push(p, point(turn, turn * s, 1));
    for (turn = 0; turn < 7; turn += 1) if (turn < 4 || s > 0.5) push(b, turn);
    aov_sum = spline(s, f) + curve(t, f) + spline("linear", t, rising) + spline("bezier", t, b);
    aov_sum += spline("solvelinear", 0.3 * s, rising);
    aov_col = spline("catmull-rom", s, c) + color spline("hermite", t, p) * 0.25;
    Ci = aov_col * aov_sum;
    Oi = 1;
}
