// assignments as values, chained, compound on every type
surface expression_assignments() {
    float a, b, c;
    a = b = c = s;
    a += b -= c *= 2;
    color d = Cs;
    d *= 2; d /= 4; d += 0.1; d -= color(0.1, 0, 0); d *= d;
    point p = P; p += N; p -= 1; p *= 0.5; p /= 2;
    matrix m = 1; m *= translate(1, vector(1, 2, 3)); m /= scale(1, vector 2);
    if ((a = t) > 0.5) b += (c = 2);
    Ci = d * (a + b + c) * 0.2 + color p * 0.01 + comp(m, 3, 0) * 0.01;
}
