// (float) x, color x, vector p, float(f(x)), casts of casts
surface expression_casts() {
    float a = (float) s * (float) noise(P);
    color c = color 0.5 + color(s, t, 0) + (color) P * 0.01;
    vector v = vector P + vector(1, 0, 0) + vector "world"(0, 1, 0);
    normal n = normal(v);
    point q = point (vector (normal (1, 2, 3)));
    float k = float noise(P) * float(noise(s)) + float (cellnoise(P * 4));
    Ci = c * a + color(v) * 0.01 + color n * k + color q * 0.01;
}
