// Output parameters stand for the variables given for them; other parameters are values.
void both(output float x, y; float z;) {
    y = 5 * z;
    x += z;
}
void through(output color c; output color d; float k;) {
    float i;
    for (i = 0; i < 3; i += 1) {
        c += color(k, i, 1);
        if (comp(d, 0) > 2) continue;
        d *= 2;
    }
}
void turn(output float x[3]; float y[3];) {
    x[0] = y[1];
    x[1] = y[2];
    x[2] = y[0];
}
surface output_arguments(float a = 0.25;) {
    float k = s, e[3];
    if (t > 0.3) both(k, k, k);
    float own(output float x;) {
        extern float k;
        x = x * 2 + 1;
        k += 0.5;
        return k;
    }
    float w = own(k) + own(a);
    e[0] = s; e[1] = t; e[2] = k;
    turn(e, e);
    both(e[0], e[1], e[2]);
    Ci = color(k, w, a);
    through(Ci, Ci, s);
    through(Ci, Oi, e[0] + e[1]);
    both(s, t, u);
    Ci += s - t;
}
