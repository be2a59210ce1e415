// Ci[0] read and written, of arrays of triples, of calls
surface expression_components() {
    color ramp[2] = {color(1, 0, 0), color(0, 1, 0)};
    float i = s > 0.5;
    Ci = Cs;
    Ci[0] = s;
    Ci[1] += t;
    Ci[2] *= Ci[0] + P[2] * 0.1;
    ramp[1][2] = 0.5;
    Ci += ramp[i] * ramp[1][2] + N[i] * 0.1 + (color noise(P))[1] + noise(P)[2] * 0.1;
    point q = P; q[i + 1] = 3;
    Ci += color q * 0.01;
}
