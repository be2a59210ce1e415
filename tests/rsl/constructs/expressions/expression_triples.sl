// (x, y, z) as every type; mixed triples in + - * /
surface expression_triples() {
    color c = (1, 0.5, 0.25);
    point p = (s, t, 1) + P;
    vector v = p - (1, 2, 3) * 0.5;
    normal n = N + v - I / (1, 2, 4);
    point q = p * v + c;
    color d = N * Cs + P / 4 - v * 0.1;
    Ci = c * d + color q * 0.01 + color n * 0.01;
    v = c; n = p; p = n; c = v;
    Ci += c * 0.01 + (0.1, 0.2, 0.3);
}
