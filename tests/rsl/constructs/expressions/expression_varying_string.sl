// a string that differs from point to point
surface expression_varying_string() {
    string which = "left";
    if (s > 0.5) which = "right";
    Ci = which == "left" ? color(1, 0, 0) : color(0, 0, 1);
}
