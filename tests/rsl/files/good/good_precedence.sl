// The specification's order: '.' over '*' over '^' over '+'.
surface x(float Kd = 0.5;) {
    float d = Kd * I.N * I.N;
    vector c = 2 * N ^ 3 * I;
    float e = -N . I + 1;
    float b = s > 0.5 && t < 0.5 || !(s == t);
    Ci = d + e + b + xcomp(c);
}
