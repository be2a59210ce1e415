surface x(string space = "world";) {
    point p = point "shader" (0, 1, 0);
    vector v = vector "world" (p - P);
    color c = color "hsv" (0.1, 0.5, 1);
    matrix m = matrix "world" 1;
    float f = (float) s + float noise(P) + float(t);
    color n = color noise(P * 2);
    Ci = c * f + n + color(1) + transform(space, p) + v + transform(m, P);
}
